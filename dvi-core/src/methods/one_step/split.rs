//! The two halves of the coordinates, α = ϑ(x, y)·dx, and the end of a step, where ϑ(x1, y1) = p1.

use crate::error::StepFailure;
use crate::scalar::norm;
use crate::scalar::passes::subtract;
use crate::solve::{Course, Judge, Linearize, Stopping, residual, solve_by_newton};
use crate::space::{LinearEquations, LinearSolver, Sink, elimination, linear};
use crate::state::Statistics;
use crate::{Matrix, ProperlyDegenerate, Real, Space, System, Vector};

/// Storage for equations in y.
#[derive(Debug)]
pub(super) struct Split<S: System, T: Real> {
    /// ∂ϑ/∂y, the first (n/2)² entries.
    block: Matrix<S, T>,
    /// What an elimination takes: the change of y in its order, and scales.
    change: Vector<S, T>,
    scales: Vector<S, T>,
    form: Vector<S, T>,
    correction: Vector<S, T>,
    /// In which the iteration judges coordinates, from zero on.
    weights: Vector<S, T>,
    zero: Vector<S, T>,
}

/// Whether α has a component along coordinate `i`: the compiler knows it where sizes are literals.
pub(super) fn is_x<S: ProperlyDegenerate<T>, T: Real>(system: &S, i: usize) -> bool {
    2 * system.place(i) < system.space().dimension()
}

impl<S: ProperlyDegenerate<T>, T: Real> Split<S, T> {
    #[inline]
    pub(super) fn new(system: &S) -> Self {
        let space = system.space();
        let [change, scales, form, correction, weights, zero] = space.vectors();
        Self { block: space.matrix(), change, scales, form, correction, weights, zero }
    }

    /// Improves y in `q` until ϑ(q, t) = `p`, which is zero along y.
    ///
    /// # Errors
    /// [`StepFailure::Singular`] where ∂ϑ/∂y is, [`StepFailure::NotConverged`].
    #[inline]
    pub(super) fn solve_y<J: Judge<T>>(
        &mut self,
        system: &S,
        q: &mut Vector<S, T>,
        t: T,
        p: &Vector<S, T>,
        stopping: Stopping,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Self { block, change, scales, form, correction, weights, zero } = self;
        let judge = J::of(Course::new(stopping, stopping.max_iterations));
        let mut by_halves = ByHalves { system, block, work: [change, scales], names: J::NAMES };
        let storage = (&mut by_halves, [correction, weights]);
        solve_by_newton(&mut End { system, t, form }, system, [zero, p], q, storage, judge, statistics)
    }
}

/// p − ϑ(q, t) = 0.
struct End<'a, S: System, T: Real> {
    system: &'a S,
    t: T,
    form: &'a mut Vector<S, T>,
}

impl<S: ProperlyDegenerate<T>, T: Real> Linearize<T> for End<'_, S, T> {
    #[inline]
    fn linearize<K: Sink<T>>(
        &mut self,
        q: &[T],
        r: &mut [T],
        sink: &mut K,
        _statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Self { system, t, form } = self;
        system.one_form(q, *t, form);
        subtract(r, form);
        system.one_form_jacobian(q, *t, T::lift(-1.0), T::lift(0.0), sink);
        Ok(())
    }

    fn residual(&mut self, at: [&[T]; 3], storage: [&mut [T]; 2]) -> Result<T, StepFailure> {
        residual(&mut End { form: &mut *self.form, ..*self }, at, storage)
    }

    fn cost(&self) -> [u64; 2] {
        [0, u64::from(!S::CANONICAL)]
    }
}

/// Solves for y alone.
struct ByHalves<'a, S: System, T: Real> {
    system: &'a S,
    block: &'a mut Matrix<S, T>,
    work: [&'a mut Vector<S, T>; 2],
    /// [`Judge::NAMES`].
    names: bool,
}

impl<S: ProperlyDegenerate<T>, T: Real> LinearSolver<T> for ByHalves<'_, S, T> {
    #[inline]
    fn solve(
        &mut self,
        equations: &mut impl LinearEquations<T>,
        weights: &[T],
        x: &mut [T],
    ) -> Result<(), StepFailure> {
        if !S::CANONICAL {
            return self.eliminate(equations, weights, x);
        }
        // Each row has one entry.
        let Self { system, work: [entries, _], names, .. } = self;
        entries.fill(T::lift(-0.0));
        let in_row = |row: usize, column: usize, entry: T| {
            if !is_x(*system, column) {
                entries[row] += entry;
            }
        };
        equations.evaluate(x, &mut { in_row })?;
        for i in (0..x.len()).filter(|&i| is_x(*system, i)) {
            let (y, pivot) = (system.conjugate(i), entries[i]);
            let reciprocal = if *names { norm::reciprocal(pivot, y)? } else { T::lift(1.0) / pivot };
            (x[i], x[y]) = (T::lift(0.0), x[i] * reciprocal);
        }
        Ok(())
    }
}

impl<S: ProperlyDegenerate<T>, T: Real> ByHalves<'_, S, T> {
    #[inline(never)]
    fn eliminate(
        &mut self,
        equations: &mut impl LinearEquations<T>,
        weights: &[T],
        x: &mut [T],
    ) -> Result<(), StepFailure> {
        let Self { system, block, work: [change, scales], .. } = self;
        // As many as the compiler knows of, in a function of its own.
        let n = system.space().dimension();
        let (half, weights, x) = (n / 2, &weights[..n], &mut x[..n]);
        let (block, change) = (&mut block[..half * half], &mut change[..half]);
        block.fill(T::lift(0.0));
        let mut places = |row: usize, column: usize, entry: T| {
            if let Some(column) = system.place(column).checked_sub(half) {
                block[system.place(row) * half + column] += entry;
            }
        };
        equations.evaluate(x, &mut places)?;
        // A row has the unit of the action over that of its x.
        let (scales, of_rows) = scales.split_at_mut(half);
        for i in (0..x.len()).filter(|&i| is_x(*system, i)) {
            (change[system.place(i)], of_rows[system.place(i)]) = (x[i], weights[i]);
        }
        elimination::eliminate_two(block, of_rows, change).unwrap_or_else(|| {
            linear::set_scales(scales, of_rows);
            elimination::eliminate(block, scales, change)
        })?;
        for (i, x) in x.iter_mut().enumerate() {
            *x = system.place(i).checked_sub(half).map_or(T::lift(0.0), |y| change[y]);
        }
        norm::finite(change)
    }
}
