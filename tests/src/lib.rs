//! Systems shared by the tests.

use dvi_core::methods::Method;
use dvi_core::prelude::*;
use dvi_core::{Real, Scalar, State};

pub mod fields;
pub mod laws;
pub mod steps;
pub mod systems;
pub mod zoo;

/// What a test comes to: a value, or what is wrong.
pub type Outcome<T = ()> = Result<T, Box<dyn core::error::Error>>;

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

/// What adds entries to a row-major matrix with so many columns.
pub fn filling<T: Scalar>(matrix: &mut [T], columns: usize) -> impl FnMut(usize, usize, T) {
    move |row, column, entry| matrix[row * columns + column] += entry
}

/// A state from flat coordinates, and velocities if there are any.
pub fn state<S: System, T: Real>(system: &S, q: &[T], v: &[T]) -> S::State<T> {
    S::State::read(&|block| system.block_len(block), q, v)
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

    /// One in [`from`, `to`).
    pub fn between(&mut self, [from, to]: [f64; 2]) -> f64 {
        from + (to - from) * (1.0 + self.next()) / 2.0
    }
}

/// A run that must fail, and its error: it ends at the last good state, and the same step fails again.
///
/// # Errors
/// That of the start, and that no step fails.
///
/// # Panics
/// If the run is elsewhere.
pub fn failing<S: Lagrangian, M: Method<S, f64>>(
    system: &S,
    method: M,
    h: f64,
    start: S::State<f64>,
) -> Outcome<(Integrator<&S, M>, StepError)> {
    let mut run = Integrator::new(system, method, h, start)?;
    for _ in 0..100_000 {
        let before = (bits(run.q()), bits(&run.v()), run.steps(), run.time());
        let Err(error) = run.advance() else { continue };
        for _ in 0..2 {
            assert_eq!((bits(run.q()), bits(&run.v()), run.steps(), run.time()), before, "{error}");
            assert_eq!((error.step, error.time), (run.steps(), run.time()));
            // What is no number is equal to nothing.
            assert_eq!(format!("{:?}", run.advance().err()), format!("{:?}", Some(error)));
        }
        assert!(run.next().is_none());
        return Ok((run, error));
    }
    Err("no step fails".into())
}

/// The parameter or the option that is why a run does not begin.
///
/// # Panics
/// If it begins, or something else is why.
#[track_caller]
pub fn refused_option<R>(begun: Result<R, StartError>) -> &'static str {
    match begun.map(drop) {
        Err(StartError::Parameter { name, .. }) => name,
        Err(StartError::Unsupported { option, .. }) => option,
        other => panic!("{other:?}"),
    }
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
    use nalgebra::{DMatrix, DVector};

    /// y after a step of length h from time t, by the classical method of Runge and Kutta.
    pub fn runge_kutta(rates: impl Fn(&[f64], f64) -> Vec<f64>, y: &[f64], [t, h]: [f64; 2]) -> Vec<f64> {
        let moved = |by: f64, k: &[f64]| -> Vec<f64> { y.iter().zip(k).map(|(y, k)| y + by * k).collect() };
        let a = rates(y, t);
        let b = rates(&moved(h / 2.0, &a), t + h / 2.0);
        let c = rates(&moved(h / 2.0, &b), t + h / 2.0);
        let d = rates(&moved(h, &c), t + h);
        (0..y.len()).map(|i| y[i] + h / 6.0 * (a[i] + 2.0 * (b[i] + c[i]) + d[i])).collect()
    }

    /// Where a function vanishes, from `x` by Newton's method with its differences of about `apart`, up to
    /// rounding; nothing where its matrix is singular. A matrix is kept as long as it brings a digit.
    pub fn root(
        mut x: DVector<f64>,
        apart: f64,
        f: impl Fn(&DVector<f64>) -> DVector<f64>,
    ) -> Option<DVector<f64>> {
        let (mut last, mut matrix) = (f64::INFINITY, None);
        for _ in 0..if x.is_empty() { 0 } else { 30 } {
            let column = |k: usize| {
                let by = apart * (1.0 + f64::abs(x[k]));
                let at = |sign: f64| {
                    let mut moved = x.clone();
                    moved[k] += sign * by;
                    f(&moved)
                };
                (at(1.0) - at(-1.0)) / (2.0 * by)
            };
            let inverse = matrix.take().unwrap_or_else(|| {
                let columns: Vec<DVector<f64>> = (0..x.len()).map(column).collect();
                DMatrix::from_columns(&columns).lu()
            });
            let change = inverse.solve(&f(&x))?;
            x -= &change;
            let (now, size) = (change.amax(), x.amax());
            if now <= 1e-16 * size || now < 1e-10 * size && now >= last {
                break;
            }
            matrix = (now < 0.1 * last).then_some(inverse);
            last = now;
        }
        Some(x)
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
