//! The oracle: formulas written by hand, differentiated by `num-dual`.
//!
//! Tolerance: one unit in the last place of a coordinate changes a k-th derivative by about ε times the
//! (k+1)-th, and adding up its terms changes it by about ε times its own size. So a k-th derivative may
//! be off by [`UNITS`]·ε·(the largest entry of it and of the (k+1)-th derivative; for k = 2, of it and
//! of the first).

use dvi_core::{DegenerateLagrangian, Lagrangian, Space, Weights};
use dvi_tests::{Numbers, filling, larger};
use num_dual::{DualNum, HyperDual64};

pub(crate) const UNITS: f64 = 16.0;
const POINTS: usize = 25;

/// `f64` and the dual numbers over it.
pub(crate) trait Number: DualNum<Primitive = f64> + Copy {}
impl<D: DualNum<Primitive = f64> + Copy> Number for D {}

/// A degenerate system and its formulas, written a second time.
pub(crate) trait ByHand: DegenerateLagrangian + Lagrangian<f32> + Lagrangian<HyperDual64> {
    fn alpha<D: Number>(&self, q: &[D], t: D) -> Vec<D>;
    fn energy<D: Number>(&self, q: &[D], t: D) -> D;
    /// α·v − H, or L as it is declared.
    fn whole<D: Number>(&self, q: &[D], v: &[D], t: D) -> D {
        self.alpha(q, t).iter().zip(v).map(|(&a, &v)| a * v).sum::<D>() - ByHand::energy(self, q, t)
    }
    /// A point in the domain of the formulas.
    fn point(&self, random: &mut Numbers) -> Vec<f64> {
        self.within(random, -1.0, 1.0)
    }
    fn within(&self, random: &mut Numbers, low: f64, high: f64) -> Vec<f64> {
        (0..self.space().dimension()).map(|_| low + (high - low) * (1.0 + random.next()) / 2.0).collect()
    }
}

/// L with its first derivatives and its second ones, row-major, by (q, v).
pub(crate) struct Expansion {
    pub(crate) value: f64,
    pub(crate) gradient: Vec<f64>,
    pub(crate) hessian: Vec<f64>,
}

pub(crate) fn expanded(variables: &[f64], f: &dyn Fn(&[HyperDual64]) -> HyperDual64) -> Expansion {
    let n = variables.len();
    let unit = |on: bool| f64::from(u8::from(on));
    let mut expansion = Expansion { value: 0.0, gradient: vec![0.0; n], hessian: vec![0.0; n * n] };
    for i in 0..n {
        for j in 0..=i {
            let seed = |k: usize| HyperDual64::new(variables[k], unit(k == i), unit(k == j), 0.0);
            let value = f(&(0..n).map(seed).collect::<Vec<_>>());
            expansion.value = value.re;
            expansion.gradient[i] = value.eps1;
            expansion.hessian[n * i + j] = value.eps1eps2;
            expansion.hessian[n * j + i] = value.eps1eps2;
        }
    }
    expansion
}

pub(crate) fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |largest, value| larger(value.abs(), largest))
}

/// What is being compared, and at which point.
pub(crate) struct Place<'a> {
    pub(crate) system: &'a str,
    pub(crate) q: &'a [f64],
    pub(crate) epsilon: f64,
}

impl Place<'_> {
    pub(crate) fn compare(&self, what: &str, found: &[f64], expected: &[f64], scale: f64) {
        assert_eq!(found.len(), expected.len());
        assert!(scale.is_finite(), "{} {what}: the oracle is not finite at {:?}", self.system, self.q);
        for (entry, (found, expected)) in found.iter().zip(expected).enumerate() {
            let units = (found - expected).abs() / (self.epsilon * scale);
            assert!(
                *found == *expected || units <= UNITS,
                "{} {what}[{entry}] = {found:e}, expected {expected:e}, off by {units:.1} units at {:?}",
                self.system,
                self.q
            );
        }
    }
}

/// Compares all of `system` with the oracle on random points.
pub(crate) fn agrees<S: ByHand>(system: &S) {
    assert_eq!(system.check(), Ok(()));
    let mut random = Numbers(20_021_023);
    for _ in 0..POINTS {
        let q = system.point(&mut random);
        let v: Vec<f64> = q.iter().map(|_| random.next()).collect();
        let t = 2.0 * random.next();
        let place = Place { system: S::REPORT.system, q: &q, epsilon: f64::EPSILON };
        lagrangian(system, &place, &v, t, &mut random);
        single_precision(system, &place, &v, t);
    }
}

/// Value, gradient and all four blocks of the second derivative of L.
pub(crate) fn lagrangian<S: ByHand>(system: &S, place: &Place<'_>, v: &[f64], t: f64, random: &mut Numbers) {
    let (q, n) = (place.q, place.q.len());
    let variables = [q, v].concat();
    let expected = expanded(&variables, &|z| system.whole(&z[..n], &z[n..], HyperDual64::from(t)));
    let [second, first] = [largest(&expected.hessian), largest(&expected.gradient)];
    let value = system.lagrangian(q, v, t);
    place.compare("L", &[value], &[expected.value], larger(first, expected.value.abs()));

    let (mut l_q, mut l_v) = (vec![f64::NAN; n], vec![f64::NAN; n]);
    system.gradient(q, v, t, &mut l_q, &mut l_v);
    place.compare("gradient", &[l_q, l_v].concat(), &expected.gradient, larger(first, second));

    let mut weight = || random.next();
    let w = Weights { qq: weight(), qv: weight(), vq: weight(), vv: weight() };
    let before: Vec<f64> = (0..n * n).map(|_| weight()).collect();
    let (mut l_q, mut l_v, mut matrix) = (vec![f64::NAN; n], vec![f64::NAN; n], before.clone());
    system.linearize(q, v, t, w, &mut l_q, &mut l_v, &mut filling(&mut matrix, n));
    place.compare("gradient of linearize", &[l_q, l_v].concat(), &expected.gradient, larger(first, second));
    let block = |i: usize, j: usize| expected.hessian[2 * n * i + j];
    let sum = |at: usize| {
        let (i, j) = (at / n, at % n);
        let blocks = w.qq * block(i, j) + w.qv * block(i, n + j) + w.vq * block(n + i, j);
        before[at] + blocks + w.vv * block(n + i, n + j)
    };
    let sum: Vec<f64> = (0..n * n).map(sum).collect();
    place.compare("linearize", &matrix, &sum, larger(larger(second, first), 1.0));

    // The generated formula itself on dual numbers: the graph before differentiation against after.
    let itself = expanded(&variables, &|z| system.lagrangian(&z[..n], &z[n..], HyperDual64::from(t)));
    place.compare("L on dual numbers, first", &itself.gradient, &expected.gradient, larger(first, second));
    place.compare("L on dual numbers, second", &itself.hessian, &expected.hessian, larger(second, first));
}

/// The same at f32. Coordinates are rounded first, so that both sides see the same point.
pub(crate) fn single_precision<S: ByHand>(system: &S, place: &Place<'_>, v: &[f64], t: f64) {
    let n = place.q.len();
    let single = |values: &[f64]| values.iter().map(|&value| value as f32).collect::<Vec<f32>>();
    let double = |values: &[f32]| values.iter().map(|&value| f64::from(value)).collect::<Vec<f64>>();
    let (q, v, t) = (single(place.q), single(v), t as f32);
    let place = Place { q: &double(&q), epsilon: f64::from(f32::EPSILON), ..*place };
    let variables = [double(&q), double(&v)].concat();
    let expected =
        expanded(&variables, &|z| system.whole(&z[..n], &z[n..], HyperDual64::from(f64::from(t))));
    let scale = larger(largest(&expected.hessian), largest(&expected.gradient));
    let (mut l_q, mut l_v, mut matrix) = (vec![0.0; n], vec![0.0; n], vec![0.0; n * n]);
    let w = Weights { qq: 1.0, qv: 0.0, vq: 0.0, vv: 0.0 };
    system.linearize(&q, &v, t, w, &mut l_q, &mut l_v, &mut filling(&mut matrix, n));
    place.compare("gradient in f32", &double(&[l_q, l_v].concat()), &expected.gradient, scale);
    let block: Vec<f64> = (0..n * n).map(|at| expected.hessian[2 * n * (at / n) + at % n]).collect();
    place.compare("linearize in f32", &double(&matrix), &block, scale);
}
