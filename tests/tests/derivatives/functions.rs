//! Every function of the language on a compiled system, against the formulas by hand, differentiated by
//! `num-dual`. Formulas of every form are held against the oracle of `dvi-macros`.
//!
//! Tolerance: one unit in the last place of a coordinate changes a k-th derivative by about ε times the
//! (k+1)-th, and adding up its terms changes it by about ε times its own size. So a k-th derivative may
//! be off by [`UNITS`]·ε·(the largest entry of it and of the (k+1)-th derivative; for k = 2, of it and
//! of the first).

use std::f64::consts::PI;

use dvi_core::{Lagrangian, Weights};
use dvi_tests::laws::formula::{hyper, unit};
use dvi_tests::laws::subject::size;
use dvi_tests::zoo::functions::EveryFunction;
use dvi_tests::{Numbers, filling, larger};
use num_dual::{DualNum as _, HyperDual64};

const UNITS: f64 = 16.0;

/// L = α·v − H.
#[rustfmt::skip]
fn by_hand(z: &[HyperDual64]) -> HyperDual64 {
    type D = HyperDual64;
    let (x, y) = (z[0], z[1]);
    let (s, r, e) = (x * y, x + y + y + 1.0, x - y);
    let alpha = [s.sin() + r.ln() + s.exp() * y.sqrt(), s.atan() - r.recip() + x.tanh()];
    let sign = |on: bool| D::from(if on { 1.0 } else { -1.0 });
    let energy: D = [
        r.sqrt(), s.cbrt(), r.cbrt(),
        s.exp(), e.exp2(), (-s).exp() - 1.0,
        r.ln(), s.ln_1p(), r.log2(), (s * 2.0).log10(),
        e.sin(), (y - x - x).cos(), s.tan(),
        s.asin(), -(s / 2.0).asin(), e.acos(), (x / y).atan(),
        -s.sinh(), e.cosh(), r.tanh(),
        e.asinh(), r.acosh(), (s - x).atanh(),
        sign(x.re > y.re) * e * s, sign(y.re > x.re) * (x + s), -x + 2.0,
        // Both angles from the arc tangent: above the axis, and left of the origin.
        D::from(PI / 2.0) - (e / r).atan(), (e / r).atan() + sign(y.re > x.re) * PI,
        (x * x + y * y * 4.0).sqrt(),
        r * r * r, (s * s).recip(), D::from(1.0), r, (x + y).powi(4) * (x + y).powi(3),
        r * r, (s * s * s).sqrt().recip(), r.sqrt(), s.recip(), r.powf(0.3), (s.ln() * y).exp(),
        (x * 2.0_f64.ln()).exp(), (r * x.ln()).exp(), r.powf(-2.7),
        (s * 3.0).sph_j0(), s.recip(), s + r, x * 100.0 * (PI / 180.0), y * (180.0 / PI), r.sin(), x * 3.0,
    ].into_iter().sum();
    alpha[0] * z[2] + alpha[1] * z[3] - energy
}

/// A function of (q, v) with its first derivatives and its second ones, row-major.
fn expanded(z: &[f64], f: impl Fn(&[HyperDual64]) -> HyperDual64) -> (f64, Vec<f64>, Vec<f64>) {
    let n = z.len();
    let at = |i: usize, j: usize| f(&hyper(z, unit(i), unit(j)));
    let second = (0..n * n).map(|k| at(k / n, k % n).eps1eps2).collect();
    (at(0, 0).re, (0..n).map(|i| at(i, i).eps1).collect(), second)
}

fn compare(what: &str, z: &[f64], found: &[f64], expected: &[f64], scale: f64) {
    assert!(found.len() == expected.len() && scale.is_finite(), "{what}: {scale} at {z:?}");
    for (entry, (found, expected)) in found.iter().zip(expected).enumerate() {
        let units = (found - expected).abs() / (f64::EPSILON * scale);
        assert!(
            units <= UNITS,
            "{what}[{entry}] = {found:e}, not {expected:e}, by {units:.1} units at {z:?}"
        );
    }
}

/// Value, gradient and all four blocks of the second derivative.
#[test]
fn every_function() {
    let (system, mut random) = (EveryFunction {}, Numbers(20_021_023));
    for _ in 0..25 {
        let [x, y] = [0, 1].map(|_| random.between([0.2, 0.8]));
        let z = [x, y, random.next(), random.next()];
        let (q, v) = z.split_at(2);
        let (value, gradient, hessian) = expanded(&z, by_hand);
        let [first, second] = [size(&gradient), size(&hessian)];
        let found = [system.lagrangian(q, v, 0.0)];
        compare("L", &z, &found, &[value], larger(first, value.abs()));

        let [qq, qv, vq, vv] = [0, 1, 2, 3].map(|_| random.next());
        let [mut l_q, mut l_v, mut matrix] = [vec![f64::NAN; 2], vec![f64::NAN; 2], vec![0.0; 4]];
        let weights = Weights { qq, qv, vq, vv };
        system.linearize(q, v, 0.0, weights, &mut l_q, &mut l_v, &mut filling(&mut matrix, 2));
        compare("gradient", &z, &[l_q, l_v].concat(), &gradient, larger(first, second));
        let block = |i: usize, j: usize| hessian[4 * i + j];
        let sum =
            |i, j| qq * block(i, j) + qv * block(i, 2 + j) + vq * block(2 + i, j) + vv * block(2 + i, 2 + j);
        let expected = [sum(0, 0), sum(0, 1), sum(1, 0), sum(1, 1)];
        compare("linearize", &z, &matrix, &expected, larger(second, first));

        // The generated formula itself on dual numbers.
        let (_, itself, twice) =
            expanded(&z, |z| system.lagrangian(&z[..2], &z[2..], HyperDual64::from(0.0)));
        compare("L on dual numbers, first", &z, &itself, &gradient, larger(first, second));
        compare("L on dual numbers, second", &z, &twice, &hessian, larger(second, first));
    }
}
