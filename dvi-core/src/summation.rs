//! How increments are added up over a run: plainly, or with what rounding leaves out carried on.
//!
//! s = x + (Δ + e)      e' = (x − s) + (Δ + e), the rounding error of that sum, or (Δ + e − s) + x if |x| is the smaller
//!
//! (Kahan 1965; Neumaier 1974). A plain sum rounds x, a compensated one Δ, which is smaller by a factor of order h.

use crate::{Lagrangian, Real, Scalar, Space, Vector};

/// How the increments of the steps are added to coordinates and momenta.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Summation {
    /// x + Δ, rounded in each step. The errors of 10⁸ steps add up to some 10⁴ units of rounding if they are
    /// independent, and to more where they are not.
    #[default]
    Plain,
    /// What rounding leaves out of x + Δ is carried on and added to the next increment (Kahan 1965), so that only Δ itself is
    /// rounded: worth it for long runs with small steps. It costs two vectors, and some eight additions a step and
    /// coordinate. What a run then shows are the sums rounded; steps are taken from these.
    Compensated,
}

/// What rounding has left out of a vector that moves by increments; nothing where sums are plain.
#[derive(Debug)]
pub(crate) struct Carried<S: Lagrangian, T: Real>(Option<Rest<S, T>>);

#[derive(Debug)]
struct Rest<S: Lagrangian, T: Real> {
    rest: Vector<S, T>,
    increment: Vector<S, T>,
}

impl<S: Lagrangian, T: Real> Carried<S, T> {
    #[inline(always)]
    pub(crate) fn new(system: &S, summation: Summation) -> Self {
        let vector = || system.space().vector();
        Self(match summation {
            Summation::Plain => None,
            Summation::Compensated => Some(Rest { rest: vector(), increment: vector() }),
        })
    }

    /// Moves `x` by an increment to `sum`, which is x + Δ rounded; with what is carried added to Δ if sums are compensated.
    #[inline(always)]
    pub(crate) fn advance(&mut self, x: &mut [T], increment: &[T], sum: &[T]) {
        match &mut self.0 {
            None => x.copy_from_slice(sum),
            Some(rest) => {
                // A copy, so that the increment itself may stay in registers.
                rest.increment.copy_from_slice(increment);
                rest.advance(x);
            }
        }
    }

    pub(crate) fn restore(&mut self, from: &Self) {
        if let (Some(Rest { rest, .. }), Some(from)) = (&mut self.0, &from.0) {
            rest.copy_from_slice(&from.rest);
        }
    }
}

impl<S: Lagrangian, T: Real> Rest<S, T> {
    #[inline(never)]
    fn advance(&mut self, x: &mut [T]) {
        for ((x, rest), &delta) in x.iter_mut().zip(self.rest.iter_mut()).zip(self.increment.iter()) {
            let added = delta + *rest;
            let sum = *x + added;
            let x_is_larger = Scalar::abs(*x) >= Scalar::abs(added);
            *rest = if x_is_larger { (*x - sum) + added } else { (added - sum) + *x };
            *x = sum;
        }
    }
}
