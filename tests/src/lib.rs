//! Systems shared by the tests.

use dvi_core::methods::Method;
use dvi_core::prelude::*;

pub mod steps;
pub mod systems;
pub mod zoo;

/// The larger of two numbers; not a number if one of them is not, so that no bound holds for it.
pub fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}

/// The largest difference of two vectors, entry by entry.
pub fn apart(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, larger)
}

/// Numbers as bits, so that zeros have signs and what is no number is equal to itself.
pub fn bits(x: &[f64]) -> Vec<u64> {
    x.iter().map(|x| x.to_bits()).collect()
}

/// Numbers in (−1, 1) from a linear congruential generator.
#[derive(Clone, Copy, Debug)]
pub struct Numbers(pub u64);

impl Numbers {
    /// The next one.
    #[expect(clippy::should_implement_trait)]
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// The coordinates at `time`.
///
/// # Errors
/// Those of the run.
pub fn run<S: Lagrangian, M: Method<S, f64>>(
    system: &S,
    method: M,
    start: S::State<f64>,
    time: f64,
    steps: u64,
) -> Result<Vec<f64>, Box<dyn core::error::Error>> {
    let mut run = Integrator::new(system, method, time / steps as f64, start)?;
    run.take_steps(steps)?;
    Ok(run.q().to_vec())
}

/// The vortex configurations of the literature.
pub mod configurations {
    use dvi_examples::models::{self, Case};

    use crate::systems::{PointVortices, PointVorticesState};

    fn pair(Case { vortices, start }: Case) -> (PointVortices<4>, PointVorticesState<4>) {
        (vortices, start)
    }

    /// Two leapfrogging pairs.
    pub fn leapfrogging() -> (PointVortices<4>, PointVorticesState<4>) {
        pair(models::leapfrogging())
    }

    /// Four equal vortices, quasi-periodic.
    pub fn quasi_periodic() -> (PointVortices<4>, PointVorticesState<4>) {
        pair(models::quasi_periodic())
    }

    /// Four equal vortices, chaotic.
    pub fn chaotic() -> (PointVortices<4>, PointVorticesState<4>) {
        pair(models::chaotic())
    }
}

/// Oracles that do not use the integrators.
pub mod oracle {
    use dvi_core::discrete::Rule;
    use dvi_core::{Lagrangian, Real};
    use nalgebra::{DMatrix, DVector};

    /// A point at which a gradient vanishes, from zero by Newton's method with its differences, up to
    /// rounding; nothing where its matrix is singular.
    pub fn stationary(size: usize, gradient: impl Fn(&DVector<f64>) -> DVector<f64>) -> Option<Vec<f64>> {
        let mut x = DVector::zeros(size);
        for _ in 0..20 {
            let column = |j: usize| {
                let shifted = |by: f64| {
                    let mut x = x.clone();
                    x[j] += by;
                    gradient(&x)
                };
                (shifted(1e-4) - shifted(-1e-4)) / 2e-4
            };
            let columns: Vec<DVector<f64>> = (0..size).map(column).collect();
            let change = DMatrix::from_columns(&columns).lu().solve(&gradient(&x))?;
            x -= &change;
            if change.amax() < 1e-16 * x.amax() {
                break;
            }
        }
        Some(x.as_slice().to_vec())
    }

    /// L_d(q0, q1) = h L(q_σ, (q1 − q0)/h, t + σh).
    pub fn discrete_lagrangian<S: Lagrangian<T>, T: Real>(
        system: &S,
        sigma: f64,
        t: f64,
        h: f64,
        q0: &[T],
        q1: &[T],
    ) -> T {
        let (b, b_bar, step) = (T::lift(1.0 - sigma), T::lift(sigma), T::lift(h));
        let point: Vec<T> = q0.iter().zip(q1).map(|(&q0, &q1)| b * q0 + b_bar * q1).collect();
        let velocity: Vec<T> = q0.iter().zip(q1).map(|(&q0, &q1)| (q1 - q0) / step).collect();
        step * system.lagrangian(&point, &velocity, T::lift(t + sigma * h))
    }

    /// L_d(q0, q1, δ) = h Σⱼ wⱼ L(qʲ, q̇ʲ, t + cⱼh) on the Lobatto nodes, with interpolation by sin u and
    /// cos u and displacements of the interior nodes, node by node. The derivatives of the Lagrange
    /// polynomials are those of their factors.
    pub fn displaced_lagrangian<S: Lagrangian<T>, T: Real, const NODES: usize>(
        system: &S,
        u: f64,
        [t, h]: [f64; 2],
        [q0, q1]: [&[T]; 2],
        displacements: &[T],
    ) -> T {
        let Ok(rule) = dvi_core::discrete::Quadrature::lobatto(NODES) else { return T::lift(f64::NAN) };
        let (c, n) = (rule.nodes(), q0.len());
        let derivative = |k: usize, at: f64| {
            let others = || (0..NODES).filter(move |&m| m != k);
            let product = |without: usize| {
                others().filter(|&m| m != without).map(|m| (at - c[m]) / (c[k] - c[m])).product::<f64>()
            };
            others().map(|m| product(m) / (c[k] - c[m])).sum::<f64>()
        };
        let mut sum = T::lift(0.0);
        for (j, (&c, &w)) in rule.nodes().iter().zip(rule.weights()).enumerate() {
            let [b, b_bar, d, d_bar] = if u == 0.0 {
                [1.0 - c, c, -1.0, 1.0]
            } else {
                let (left, right, sine) = ((1.0 - c) * u, c * u, u.sin());
                [left.sin() / sine, right.sin() / sine, -u * left.cos() / sine, u * right.cos() / sine]
            };
            let combine = |x: f64, y: f64, i: usize| T::lift(x) * q0[i] + T::lift(y) * q1[i];
            let (mut point, mut velocity): (Vec<T>, Vec<T>) =
                (0..n).map(|i| (combine(b, b_bar, i), combine(d, d_bar, i))).unzip();
            for (k, displacement) in displacements.chunks(n).enumerate().map(|(k, x)| (k + 1, x)) {
                let derivative = T::lift(derivative(k, c));
                for i in 0..n {
                    velocity[i] += derivative * displacement[i];
                    if k == j {
                        point[i] += displacement[i];
                    }
                }
            }
            velocity.iter_mut().for_each(|v| *v *= T::lift(1.0 / h));
            sum += T::lift(w) * system.lagrangian(&point, &velocity, T::lift(t + c * h));
        }
        T::lift(h) * sum
    }
}

/// The examples in the documentation of the attributes run. They are tested here because they need
/// `dvi-core`: with that as a dependency of the attributes' own tests, cargo builds it once more, as code
/// for the compiler.
#[cfg(doctest)]
pub mod attributes {
    #[doc = include_str!("../../dvi-macros/docs/degenerate_lagrangian.md")]
    pub struct DegenerateLagrangian;
    #[doc = include_str!("../../dvi-macros/docs/lagrangian.md")]
    pub struct Lagrangian;
}

/// The README's example runs.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
pub struct Readme;
