//! The two halves of the coordinates, α = ϑ(x, y)·dx, and the equation ϑ(x, y) = p for y.

use crate::error::StepFailure;
use crate::scalar::norm;
use crate::solve::{Course, Due, Iteration, Judge, Stopping, repeat};
use crate::space::sink::Places;
use crate::space::{elimination, linear, scratch};
use crate::state::Statistics;
use crate::{Matrix, ProperlyDegenerate, Real, Scalar, Space, System, Vector};

/// Storage for equations in y.
#[derive(Debug)]
pub(super) struct Split<S: System, T: Real> {
    /// ∂ϑ/∂y, the first (n/2)² entries.
    block: Matrix<S, T>,
    /// ϑ − p, of which an elimination leaves nothing, and the change of y in its order.
    form: Vector<S, T>,
    change: Vector<S, T>,
    /// In which the iteration judges coordinates.
    weights: Vector<S, T>,
}

/// Whether α has a component along coordinate `i`: the compiler knows it where sizes are literals.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn is_x<S: ProperlyDegenerate<T>, T: Real>(system: &S, i: usize) -> bool {
    2 * system.place(i) < system.space().dimension()
}

/// Sets `to` to `from` along x, and to zero along y.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn copy_x<S: ProperlyDegenerate<T>, T: Real>(system: &S, from: &[T], to: &mut [T]) {
    for (i, (&from, to)) in from.iter().zip(to).enumerate() {
        *to = if is_x(system, i) { from } else { T::lift(0.0) };
    }
}

impl<S: ProperlyDegenerate<T>, T: Real> Split<S, T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn new(system: &S) -> Self {
        let space = system.space();
        Self { block: space.matrix(), form: space.vector(), change: space.vector(), weights: space.vector() }
    }

    /// Improves y in `q` until ϑ(q, t) = `p`.
    ///
    /// # Errors
    /// [`StepFailure::Singular`] where ∂ϑ/∂y is, [`StepFailure::NotConverged`].
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn solve_y<J: Judge<T>>(
        &mut self,
        system: &S,
        q: &mut Vector<S, T>,
        t: T,
        p: &Vector<S, T>,
        stopping: Stopping,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        repeat(
            J::of(Course::new(stopping, stopping.max_iterations)),
            statistics,
            Newton { split: self, system, q, t, p, names: J::NAMES },
        )
    }

    /// Sets `change` to (∂ϑ/∂y)⁻¹`form`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn solve_once(
        &mut self,
        system: &S,
        q: &[T],
        t: T,
        names: bool,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let half = q.len() / 2;
        if S::CANONICAL {
            return self.divide(system, q, t, names);
        }
        self.eliminate(system, q, t, half, statistics)?;
        norm::finite(&self.change[..half])
    }

    /// The same where each row has one entry.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn divide(&mut self, system: &S, q: &[T], t: T, names: bool) -> Result<(), StepFailure> {
        let half = q.len() / 2;
        scratch!(entries = system, self.block[..q.len()]);
        system.conjugate_entries(q, t, T::lift(1.0), T::lift(0.0), entries);
        let rows = || (0..q.len()).filter(|&i| is_x(system, i)).map(|i| (i, system.conjugate(i)));
        for (i, column) in rows() {
            self.change[system.place(column) - half] = self.form[i] * (T::lift(1.0) / entries[i]);
        }
        if !names {
            return Ok(());
        }
        let finite = norm::finite(&self.change[..half]);
        // A quotient by a number without a reciprocal is not finite, unless its numerator is as small as
        // that.
        if finite.is_err() {
            for (i, column) in rows() {
                norm::reciprocal(entries[i], column)?;
            }
        }
        finite
    }

    /// The same by elimination.
    #[inline(never)]
    fn eliminate(
        &mut self,
        system: &S,
        q: &[T],
        t: T,
        half: usize,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Self { block, form, change, weights } = self;
        let block = &mut block[..half * half];
        block.fill(T::lift(0.0));
        let mut sink = Places(|row: usize, column: usize, entry: T| {
            let (row, column) = (system.place(row), system.place(column));
            if row < half && column >= half {
                block[row * half + (column - half)] += entry;
            }
        });
        system.one_form_jacobian(q, t, T::lift(1.0), T::lift(0.0), &mut sink);
        statistics.factorisations += 1;
        for (i, &form) in form.iter().enumerate() {
            if system.place(i) < half {
                change[system.place(i)] = form;
            }
        }
        // A row has the unit of the action over that of its x.
        let (scales, of_rows) = form.split_at_mut(half);
        for (i, &weight) in weights.iter().enumerate() {
            if let Some(of_row) = of_rows.get_mut(system.place(i)) {
                *of_row = weight;
            }
        }
        linear::set_scales(scales, of_rows);
        elimination::eliminate(block, scales, &mut change[..half])
    }
}

impl<S: ProperlyDegenerate<T>, T: Real> Split<S, T> {
    /// The residual ϑ − p, which is in `form`, relative to |pᵢ| + Σⱼ |∂ϑᵢ/∂yⱼ yⱼ| (Oettli & Prager 1964).
    #[cold]
    fn residual(&mut self, system: &S, q: &[T], t: T, p: &[T]) -> Result<T, StepFailure> {
        let sums = &mut self.change;
        sums.iter_mut().zip(p).for_each(|(sum, &p)| *sum = Scalar::abs(p));
        let mut sink = Places(|row: usize, column: usize, entry: T| {
            if !is_x(system, column) {
                sums[row] += Scalar::abs(entry * q[column]);
            }
        });
        system.one_form_jacobian(q, t, T::lift(1.0), T::lift(0.0), &mut sink);
        let rows = self.form.iter().copied().zip(self.change.iter().copied()).enumerate();
        linear::relative(rows.filter(|&(i, _)| is_x(system, i)).map(|(_, row)| row))
    }
}

/// Newton's method for y.
struct Newton<'a, S: System, T: Real> {
    split: &'a mut Split<S, T>,
    system: &'a S,
    q: &'a mut Vector<S, T>,
    t: T,
    p: &'a Vector<S, T>,
    /// [`Judge::NAMES`].
    names: bool,
}

impl<S: ProperlyDegenerate<T>, T: Real> Iteration<T> for Newton<'_, S, T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn prepare(&mut self, due: &mut Due) {
        due.prepare_alone(self.system, &mut self.split.weights, self.q);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn improve(&mut self, due: &mut Due, statistics: &mut Statistics) -> Result<T, StepFailure> {
        let Self { split, system, q, t, p, names } = self;
        system.one_form(q, *t, &mut split.form);
        for (form, &p) in split.form.iter_mut().zip(p.iter()) {
            *form -= p;
        }
        if *due == Due::Residual {
            return split.residual(system, q, *t, p);
        }
        split.solve_once(system, q, *t, *names, statistics)?;
        let (half, mut size) = (q.len() / 2, T::lift(0.0));
        for (i, q) in q.iter_mut().enumerate() {
            if let Some(y) = system.place(i).checked_sub(half) {
                *q -= split.change[y];
                size = norm::larger(size, Scalar::abs(split.change[y]) * split.weights[i]);
            }
        }
        Ok(size)
    }
}
