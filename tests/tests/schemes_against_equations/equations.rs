//! The discrete Lagrangian of the quadrature family and its derivatives, by dual numbers.

use dvi_tests::larger;
use nalgebra::{RealField, convert};
use num_dual::Dual64;

/// A Lagrangian in plain Rust.
pub(crate) trait Formula {
    fn lagrangian<T: RealField + Copy>(&self, q: &[T], v: &[T], t: T) -> T;

    /// The forces on the first coordinates; there are none on the others.
    fn force(&self, _q: &[f64], _v: &[f64], _t: f64) -> Vec<f64> {
        Vec::new()
    }
}

/// Nodes, weights, and the frequency of the interpolation, 0 for a linear one.
#[derive(Clone, Debug)]
pub(crate) struct Rule {
    pub(crate) nodes: Vec<f64>,
    pub(crate) weights: Vec<f64>,
    pub(crate) omega: f64,
}

impl Rule {
    pub(crate) fn new(nodes: &[f64], weights: &[f64]) -> Self {
        Self { nodes: nodes.to_vec(), weights: weights.to_vec(), omega: 0.0 }
    }

    pub(crate) fn fitted(&self, omega: f64) -> Self {
        Self { omega, ..self.clone() }
    }

    /// With the weights that make the momenta of the oscillator exact too.
    pub(crate) fn with_fitted_momenta(&self, h: f64) -> Self {
        let u = self.omega * h;
        let sum: f64 =
            self.nodes.iter().zip(&self.weights).map(|(c, w)| w * ((1.0 - 2.0 * c) * u).cos()).sum();
        let weights = self.weights.iter().map(|w| w * (u.sin() / u) / sum);
        Self { weights: weights.collect(), ..self.clone() }
    }
}

/// The coefficients of q0 and q1 in q and in h q̇ at node c: linear, or sines of u (Kosmas & Vlachos, eq.
/// 15).
pub(crate) fn interpolation(c: f64, u: f64) -> [f64; 4] {
    if u == 0.0 {
        return [1.0 - c, c, -1.0, 1.0];
    }
    let (left, right, sine) = ((1.0 - c) * u, c * u, u.sin());
    [left.sin() / sine, right.sin() / sine, -u * left.cos() / sine, u * right.cos() / sine]
}

/// h Σ w L(b q0 + b̄ q1, (B q0 + B̄ q1)/h, t + ch)
pub(crate) fn discrete_lagrangian<F: Formula, T: RealField + Copy>(
    formula: &F,
    rule: &Rule,
    [t, h]: [f64; 2],
    [q0, q1]: [&[T]; 2],
) -> T {
    let mut sum = T::zero();
    for (&c, &w) in rule.nodes.iter().zip(&rule.weights) {
        let [b0, b1, d0, d1] = interpolation(c, rule.omega * h);
        let combine = |x: f64, y: f64| -> Vec<T> {
            q0.iter()
                .zip(q1)
                .map(|(&q0, &q1)| convert::<f64, T>(x) * q0 + convert::<f64, T>(y) * q1)
                .collect()
        };
        let (point, velocity) = (combine(b0, b1), combine(d0 / h, d1 / h));
        sum += convert::<f64, T>(h * w) * formula.lagrangian(&point, &velocity, convert(t + c * h));
    }
    sum
}

pub(crate) fn dual(q: &[f64], direction: Option<usize>) -> Vec<Dual64> {
    let unit = |i| if Some(i) == direction { 1.0 } else { 0.0 };
    q.iter().enumerate().map(|(i, &q)| Dual64::new(q, unit(i))).collect()
}

/// (D₁L_d, D₂L_d)
pub(crate) fn slots<F: Formula>(
    formula: &F,
    rule: &Rule,
    th: [f64; 2],
    [q0, q1]: [&[f64]; 2],
) -> [Vec<f64>; 2] {
    let value = |a, b| {
        let (q0, q1) = (dual(q0, a), dual(q1, b));
        discrete_lagrangian(formula, rule, th, [&q0, &q1]).eps
    };
    let n = q0.len();
    [(0..n).map(|i| value(Some(i), None)).collect(), (0..n).map(|i| value(None, Some(i))).collect()]
}

/// The largest entry.
pub(crate) fn size(vector: &[f64]) -> f64 {
    vector.iter().fold(0.0, |size: f64, entry| larger(size, entry.abs()))
}

/// The largest entry of a + sign·b.
pub(crate) fn defect(a: &[f64], sign: f64, b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |size: f64, (a, b)| larger(size, (a + sign * b).abs()))
}
