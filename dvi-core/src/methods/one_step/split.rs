//! The two halves of the coordinates, α = ϑ(x, y)·dx, and the equation ϑ(x, y) = p for y.

use crate::error::StepFailure;
use crate::scalar::norm;
use crate::solve::{Convergence, Stopping, iterate};
use crate::space::elimination;
use crate::space::sink::Places;
use crate::state::Statistics;
use crate::{Matrix, Permutation, ProperlyDegenerate, Real, Space, System, Vector};

/// Which coordinates are x and which y, and storage for equations in y.
#[derive(Debug)]
pub(super) struct Split<S: System, T: Real> {
    /// The place of each coordinate in the order (x, y).
    places: Permutation<S>,
    /// ∂ϑ/∂y, the first (n/2)² entries.
    block: Matrix<S, T>,
    /// ϑ − p, and the change of y in its order.
    form: Vector<S, T>,
    change: Vector<S, T>,
}

/// Whether α has a component along coordinate `i`: the compiler knows it where sizes are literals.
#[inline(always)]
pub(super) fn is_x<S: ProperlyDegenerate<T>, T: Real>(system: &S, i: usize) -> bool {
    2 * system.place(i) < system.space().dimension()
}

/// Sets `to` to `from` along x, and to zero along y.
#[inline(always)]
pub(super) fn copy_x<S: ProperlyDegenerate<T>, T: Real>(system: &S, from: &[T], to: &mut [T]) {
    for (i, (&from, to)) in from.iter().zip(to).enumerate() {
        *to = if is_x(system, i) { from } else { T::lift(0.0) };
    }
}

impl<S: ProperlyDegenerate<T>, T: Real> Split<S, T> {
    pub(super) fn new(system: &S) -> Self {
        let space = system.space();
        let mut places = space.permutation();
        for (coordinate, place) in places.iter_mut().enumerate() {
            *place = system.place(coordinate);
        }
        Self { places, block: space.matrix(), form: space.vector(), change: space.vector() }
    }

    /// Improves y in `q` until ϑ(q, t) = `p`.
    ///
    /// # Errors
    /// [`StepFailure::Singular`] where ∂ϑ/∂y is, [`StepFailure::NotConverged`].
    pub(super) fn solve_y(
        &mut self,
        system: &S,
        q: &mut Vector<S, T>,
        t: T,
        p: &[T],
        stopping: Stopping,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let convergence = Convergence::new(stopping, norm::largest(q), q, stopping.max_iterations);
        let half = self.places.len() / 2;
        let solved = iterate(convergence, statistics, |statistics| {
            system.one_form(q, t, &mut self.form);
            for (form, &p) in self.form.iter_mut().zip(p) {
                *form -= p;
            }
            self.solve_once(system, q, t, statistics)?;
            for (i, q) in q.iter_mut().enumerate() {
                if let Some(y) = self.places[i].checked_sub(half) {
                    *q -= self.change[y];
                }
            }
            Ok(norm::largest(&self.change[..half]))
        });
        solved.or_else(|failure| {
            failure.unless_rounding(|| {
                self.form.copy_from_slice(p);
                self.solve_once(system, q, t, statistics)?;
                Ok(norm::largest(&self.change[..half]))
            })
        })
    }

    /// Sets `change` to (∂ϑ/∂y)⁻¹`form`.
    fn solve_once(
        &mut self,
        system: &S,
        q: &[T],
        t: T,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let half = self.places.len() / 2;
        if S::CANONICAL {
            self.divide(system, q, t)?;
        } else {
            self.eliminate(system, q, t, half, statistics)?;
        }
        norm::finite(&self.change[..half])
    }

    /// Sets `change` to (∂ϑ/∂y)⁻¹`form` where each row has one entry.
    fn divide(&mut self, system: &S, q: &[T], t: T) -> Result<(), StepFailure> {
        let half = self.places.len() / 2;
        let entries = &mut self.block[..self.places.len()];
        system.conjugate_entries(q, t, T::lift(1.0), T::lift(0.0), entries);
        for i in 0..self.places.len() {
            if 2 * self.places[i] < self.places.len() {
                let column = system.conjugate(i);
                let reciprocal = norm::reciprocal(entries[i], column)?;
                self.change[self.places[column] - half] = self.form[i] * reciprocal;
            }
        }
        Ok(())
    }

    /// The same by elimination.
    fn eliminate(
        &mut self,
        system: &S,
        q: &[T],
        t: T,
        half: usize,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Self { places, block, form, change } = self;
        let block = &mut block[..half * half];
        block.fill(T::lift(0.0));
        let mut sink = Places(|row: usize, column: usize, entry: T| {
            let (row, column) = (places[row], places[column]);
            if row < half && column >= half {
                block[row * half + (column - half)] += entry;
            }
        });
        system.one_form_jacobian(q, t, T::lift(1.0), T::lift(0.0), &mut sink);
        statistics.factorisations += 1;
        for (i, &form) in form.iter().enumerate() {
            if places[i] < half {
                change[places[i]] = form;
            }
        }
        elimination::eliminate(block, &mut change[..half])
    }
}
