//! What solves the equations with multipliers, in units in which their matrix has entries of about one.
//!
//! A and G have units of their own, and so has each row of G. With A of the size of M/α, what is solved are
//!
//! ```text
//! ( α D A D   D GᵀS ) (   D⁻¹ x )   ( α D b )
//! ( S G D       0   ) ( α S⁻¹ ν ) = (   S c )
//! ```
//!
//! with the [`scales`](super::scales) D and S.

use super::residuals::Residuals;
use super::{At, Augmented, Bordered, ConstrainedLagrangian, Constraints, Multipliers, scales};
use crate::error::StepFailure;
use crate::mechanics::pattern::visit_second_derivatives;
use crate::mechanics::{Interval, Span};
use crate::memory::lasting;
use crate::scalar::norm;
use crate::space::{LinearEquations, Sink, SquareMatrix, linear};
use crate::{ConstrainedSystem, Real, Space, Vector};

/// What solves equations with multipliers on a system, with the storage that it needs.
#[derive(Debug)]
pub(crate) struct ConstraintSolver<S: ConstrainedSystem, T: Real> {
    matrix: <S::Augmented as Space>::Square<T>,
    /// The last solution: x, then the change of ν.
    pub(super) solution: Augmented<S, T>,
    /// D, then S.
    pub(super) scales: Augmented<S, T>,
    /// Of velocities.
    pub(super) residuals: Residuals<S, T>,
    /// What the rows of a residual are made of.
    sums: Augmented<S, T>,
    /// In which iterations judge velocities.
    pub(super) weights: Vector<S, T>,
}

/// The unit that the constraints give a coordinate is smaller by this factor than that of its mass, if it is
/// light. Rounding errors grow by the square of it.
const LIGHT: f64 = 1.0 / 32.0;

// In other units a run would be rounded in another way.
lasting!([S: ConstrainedSystem, T: Real] ConstraintSolver<S, T>, T; numbers scales);

impl<S: ConstrainedLagrangian<T>, T: Real> ConstraintSolver<S, T> {
    /// For equations whose A has the entries of second derivatives of L, near (`q`, `v`, `t`).
    pub(crate) fn new(system: &S, q: &[T], v: &[T], t: T) -> Self {
        let (n, space) = (q.len(), system.augmented());
        let mut values: Multipliers<S, T> = system.multipliers().vector();
        let matrix = space.square(|visit| {
            visit_second_derivatives(system, [q, v], t, visit);
            let mut work: [Vector<S, T>; 2] = system.space().vectors();
            let [point, velocity] = &mut work;
            let interval = Interval { t, h: T::lift(1.0) };
            let span = Span { system, interval, q0: q, delta: v };
            let mut below = |k: usize, j: usize, _: T| visit(n + k, j);
            S::Kind::of_step(system, span, [point, velocity], &mut values, &mut below);
            let mut both = |k: usize, j: usize, _: T| {
                visit(n + k, j);
                visit(j, n + k);
            };
            S::Kind::forces(system, q, t, &mut values, &mut both);
            (n..space.dimension()).for_each(|k| visit(k, k));
        });
        let mut scales: Augmented<S, T> = space.vector();
        scales::balance(system, At { q, t }, v, scales.split_at_mut(n));
        Self {
            matrix,
            solution: space.vector(),
            sums: space.vector(),
            scales,
            residuals: Residuals::new(system),
            weights: system.space().vector(),
        }
    }

    /// Takes the units that belong to another point.
    pub(super) fn balance(&mut self, system: &S, at: At<'_, T>, v: &[T]) {
        self.scales.fill(T::lift(0.0));
        scales::balance(system, at, v, self.scales.split_at_mut(at.q.len()));
    }

    /// Whether the constraints give a coordinate a much smaller unit than its mass does, near (`q`, `v`, `t`):
    /// it is light against others.
    pub(crate) fn has_light_coordinates(&self, system: &S, at: [&[T]; 2], t: T) -> bool {
        let mut of_masses: Vector<S, T> = system.space().vector();
        scales::scale_coordinates(system, at, t, &mut of_masses);
        let mut units = self.scales.iter().zip(of_masses.iter());
        units.any(|(&unit, &of_mass)| unit < T::lift(LIGHT) * of_mass)
    }

    /// Solves the equations, whose A is of the size of M/`alpha` with a positive `alpha`; the solution is
    /// here, x in its first n entries.
    ///
    /// # Errors
    /// [`StepFailure::RedundantConstraint`] names the first constraint that depends on those before it;
    /// [`StepFailure::Singular`] where A is singular.
    #[inline]
    pub(crate) fn solve<U: LinearEquations<T>>(
        &mut self,
        equations: &mut Bordered<'_, S, T, U>,
        alpha: T,
    ) -> Result<(), StepFailure> {
        let result = self.eliminate(equations, alpha);
        result.map_err(|failure| self.blamed(failure, equations, alpha))
    }

    /// The residual of the equations, as [`linear::residual`].
    pub(crate) fn residual<U: LinearEquations<T>>(
        &mut self,
        equations: &mut Bordered<'_, S, T, U>,
        size: impl Fn(usize) -> T,
        given: impl Fn(usize) -> T,
    ) -> Result<T, StepFailure> {
        linear::residual(equations, size, given, [&mut self.solution, &mut self.sums])
    }

    fn eliminate<U: LinearEquations<T>>(
        &mut self,
        equations: &mut Bordered<'_, S, T, U>,
        alpha: T,
    ) -> Result<(), StepFailure> {
        let Self { matrix, solution, scales, .. } = self;
        let n = solution.len() - equations.multipliers.len();
        let factor = |row: usize, column: usize| {
            let scale = scales[row] * scales[column];
            match (row < n, column < n) {
                (true, true) => scale * alpha,
                (true, false) | (false, true) => scale,
                (false, false) => scale / alpha,
            }
        };
        let entries = matrix.cleared();
        let mut scaled = |i: usize, j: usize, entry: T| entries.add(i, j, factor(i, j) * entry);
        equations.evaluate(solution, &mut scaled)?;
        norm::finite(solution).map_err(|failure| of_row(failure, n))?;
        matrix.factor()?;
        for (k, (entry, &scale)) in solution.iter_mut().zip(scales.iter()).enumerate() {
            *entry *= if k < n { scale * alpha } else { scale };
        }
        matrix.solve(solution);
        for (k, (entry, &scale)) in solution.iter_mut().zip(scales.iter()).enumerate() {
            *entry *= if k < n { scale } else { scale / alpha };
        }
        Ok(())
    }

    /// The failure, with the name of the constraint if one is to blame.
    #[cold]
    fn blamed<U: LinearEquations<T>>(
        &mut self,
        failure: StepFailure,
        equations: &mut Bordered<'_, S, T, U>,
        alpha: T,
    ) -> StepFailure {
        let StepFailure::Singular { pivot, .. } = failure else { return failure };
        let (mut regular, mut singular) = (0, equations.multipliers.len());
        let mut is_regular = |active: usize| {
            equations.active = active;
            self.eliminate(equations, alpha).is_ok()
        };
        // Without constraints: is it A that is singular?
        if !is_regular(0) {
            return failure;
        }
        while singular - regular > 1 {
            let middle = regular + (singular - regular) / 2;
            if is_regular(middle) { regular = middle } else { singular = middle }
        }
        StepFailure::RedundantConstraint { constraint: regular, pivot }
    }

    /// Whether the determinant of the equations that were solved last is positive.
    pub(crate) fn is_positive(&self) -> bool {
        self.matrix.is_positive()
    }

    /// x and the change of the multipliers.
    pub(crate) fn parts(&self, n: usize) -> (&[T], &[T]) {
        self.solution.split_at(n)
    }

    /// Takes the solution from unknowns and multipliers.
    pub(crate) fn reduce(&self, x: &mut [T], multipliers: &mut [T]) {
        let unknowns = x.iter_mut().chain(multipliers);
        unknowns.zip(self.solution.iter()).for_each(|(unknown, &change)| *unknown -= change);
    }
}

/// The failure of a row beyond the first `n`, with the name of its constraint.
#[cold]
fn of_row(failure: StepFailure, n: usize) -> StepFailure {
    match failure {
        StepFailure::NotFinite { coordinate, value } if coordinate >= n => {
            StepFailure::UndefinedConstraint { constraint: coordinate - n, value }
        }
        other => other,
    }
}
