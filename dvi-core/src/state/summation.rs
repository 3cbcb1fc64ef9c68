//! How increments are added up over a run: plainly, or with what rounding leaves out carried on.
//!
//! s = x + (Δ + e) e' = (x − s) + (Δ + e), the rounding error of that sum, or (Δ + e − s) + x if |x| is the
//! smaller
//!
//! (Kahan 1965; Neumaier 1974). A plain sum rounds x, a compensated one Δ, which is smaller by a factor of
//! order h.

use crate::error::StepFailure;
use crate::memory::lasting;
use crate::scalar::norm;
use crate::{Lagrangian, Real, Scalar, Space, System, Vector};

/// How the increments of the steps are added to coordinates and momenta.
///
/// ```
#[doc = include_str!("../../docs/hidden/pendulum.txt")]
/// let error = |summation| -> Result<f64, Box<dyn std::error::Error>> {
///     let method = Variational { summation, ..Variational::trapezoid() };
///     let mut run = Integrator::new(&Pendulum, method, 0.001, start.clone())?;
///     run.take_steps(100_000)?;
///     let mut back = Integrator::new(&Pendulum, method, -0.001, run.state())?;
///     back.take_steps(100_000)?;
///     Ok((back.state().angle - start.angle).abs())
/// };
/// assert!(error(Summation::Compensated)? < 0.1 * error(Summation::Plain)?); // what rounding leaves
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Summation {
    /// x + Δ, rounded in each step. The errors of 10⁸ steps add up to some 10⁴ units of rounding if they are
    /// independent, and to more where they are not.
    #[default]
    Plain,
    /// What rounding leaves out of x + Δ is carried on and added to the next increment (Kahan 1965), so that
    /// only Δ itself is rounded: worth it for long runs with small steps. It costs two vectors, some eight
    /// additions a step and coordinate, and the fast path of explicit steps. What a run shows are the sums
    /// rounded; forces are evaluated at these. The fixed point of [`Sigma`](crate::methods::Sigma) takes one
    /// gradient more, for what rounding of its node leaves out of Δ. Newton's method rounds as much as a
    /// plain sum.
    Compensated,
}

/// What rounding has left out of a vector that moves by increments; nothing where sums are plain.
#[derive(Debug)]
pub(crate) struct Carried<S: System, T: Real> {
    rest: Option<Vector<S, T>>,
}

impl<S: Lagrangian<T>, T: Real> Carried<S, T> {
    #[inline]
    pub(crate) fn new(system: &S, summation: Summation) -> Self {
        let rest = match summation {
            Summation::Plain => None,
            Summation::Compensated => Some(system.space().vector()),
        };
        Self { rest }
    }

    /// What rounding has left out of number `k`.
    #[inline]
    pub(crate) fn left_out_of(&self, k: usize) -> T {
        match &self.rest {
            Some(rest) => rest[k],
            None => T::lift(0.0),
        }
    }

    /// Sets `sum` to x + Δ, or x + (Δ + e).
    #[inline]
    pub(crate) fn add(&self, x: &[T], increment: &[T], sum: &mut [T]) {
        for i in 0..x.len() {
            let delta = self.rest.as_ref().map_or(increment[i], |rest| increment[i] + rest[i]);
            sum[i] = x[i] + delta;
        }
    }

    /// Moves `x` to `sum`, as [`add`](Self::add) has made it, and takes note of what rounding has left out.
    #[inline]
    pub(crate) fn advance(&mut self, x: &mut [T], increment: &[T], sum: &[T]) {
        if let Some(rest) = &mut self.rest {
            carry(rest, x, increment, sum);
        }
        x.copy_from_slice(sum);
    }

    /// Moves `x` by an increment in two parts, of which the second is below the rounding of the first, if
    /// the sum is finite.
    #[inline(never)]
    pub(crate) fn move_by(
        &mut self,
        x: &mut [T],
        [increment, small]: [&[T]; 2],
        sum: &mut [T],
    ) -> Result<(), StepFailure> {
        for (k, (sum, &x)) in sum.iter_mut().zip(x.iter()).enumerate() {
            *sum = x + (increment[k] + (small[k] + self.left_out_of(k)));
        }
        norm::finite(sum)?;
        for (k, rest) in self.rest.iter_mut().flat_map(|rest| rest.iter_mut()).enumerate() {
            let small = small[k] + *rest;
            let added = increment[k] + small;
            *rest = left_out(x[k], added, sum[k]) + left_out(increment[k], small, added);
        }
        x.copy_from_slice(sum);
        Ok(())
    }
}

lasting!([S: System, T: Real] Carried<S, T>, T; vectors rest);

/// Sets `rest` to what rounding has left out of `sum`, that of x and of (Δ + `rest`).
#[inline(never)]
fn carry<T: Real>(rest: &mut [T], x: &[T], increment: &[T], sum: &[T]) {
    for (((&sum, &x), &delta), rest) in sum.iter().zip(x).zip(increment).zip(rest) {
        *rest = left_out(x, delta + *rest, sum);
    }
}

/// What rounding has left out of `sum`, that of x and `added`.
#[inline]
pub(crate) fn left_out<T: Real>(x: T, added: T, sum: T) -> T {
    let x_is_larger = Scalar::abs(x) >= Scalar::abs(added);
    if x_is_larger { (x - sum) + added } else { (added - sum) + x }
}
