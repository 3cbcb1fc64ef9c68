//! Steps of a method on flat coordinates, in any numbers, and what they do to neighbouring points.

use dvi_core::methods::{Method, Step};
use dvi_core::state::Statistics;
use dvi_core::{Lagrangian, Real, Space};
use nalgebra::DMatrix;
use num_dual::Dual64;

use crate::Outcome;
pub use crate::apart;

/// The flat coordinates after steps of length `h` from `t` on.
///
/// # Errors
/// Those of the run.
pub fn stepped<S: Lagrangian<T>, T: Real, M: Method<S, T>>(
    system: &S,
    method: &M,
    q0: &[T],
    [t, h]: [f64; 2],
    steps: u64,
) -> Outcome<Vec<T>> {
    let mut q = system.space().vector();
    q.copy_from_slice(q0);
    let mut memory = method.begin(system, &q, &[], T::lift(t), T::lift(h))?;
    let mut statistics = Statistics::default();
    for taken in 0..steps {
        let now = T::lift(t + taken as f64 * h);
        let step = Step { system, q: &mut q, t: now, h: T::lift(h), statistics: &mut statistics };
        method.step(step, &mut memory)?;
    }
    Ok(q.to_vec())
}

/// The matrix of the derivative of a function of q with `rows` values, by dual numbers.
///
/// # Errors
/// Those of the function.
pub fn jacobian(
    q: &[f64],
    rows: usize,
    f: impl Fn(&[Dual64]) -> Outcome<Vec<Dual64>>,
) -> Outcome<DMatrix<f64>> {
    let mut matrix = DMatrix::zeros(rows, q.len());
    for column in 0..q.len() {
        let seeded = q.iter().enumerate().map(|(i, &x)| Dual64::new(x, if i == column { 1.0 } else { 0.0 }));
        let image = f(&seeded.collect::<Vec<_>>())?;
        for row in 0..rows {
            matrix[(row, column)] = image[row].eps;
        }
    }
    Ok(matrix)
}
