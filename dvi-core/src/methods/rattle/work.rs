//! One step of RATTLE, and the storage that it needs.

use crate::error::StepFailure;
use crate::mechanics::constraints::Multipliers;
use crate::mechanics::constraints::turning::is_along;
use crate::mechanics::mass::Mass;
use crate::methods::constrained::Impulses;
use crate::scalar::norm;
use crate::solve::{Convergence, Stopping, iterate};
use crate::space::sink::Places;
use crate::space::{Sink, SquareMatrix};
use crate::state::Statistics;
use crate::state::memory::{Memory, lasting};
use crate::{ConstrainedSystem, HolonomicLagrangian, Real, Separable, Space, Vector};
/// Sums begin here: added to any number it leaves that number, so that the compiler may drop the first addition.
const NEUTRAL: f64 = -0.0;

/// A vector of coordinates for each constraint.
type Rows<S, T> = <<S as ConstrainedSystem>::Multipliers as Space>::Array<Vector<S, T>>;
/// A square matrix over the constraints.
type Gram<S, T> = <<S as ConstrainedSystem>::Multipliers as Space>::Square<T>;

/// What is kept of a point of the run.
#[derive(Debug)]
pub(super) struct Place<S: ConstrainedSystem, T: Real> {
    pub(super) p: Vector<S, T>,
    /// F
    pub(super) force: Vector<S, T>,
    /// The rows of G.
    pub(super) rows: Rows<S, T>,
    /// M⁻¹ times each of them.
    pub(super) solved: Rows<S, T>,
    /// The products of both, row by row: the diagonal of G M⁻¹ Gᵀ.
    pub(super) squares: Multipliers<S, T>,
    /// Whether the determinant of that matrix is positive, as it is along a run if it is where that begins.
    pub(super) is_positive: bool,
}

/// The end of a step as it is being found.
#[derive(Debug)]
pub(super) struct Work<S: ConstrainedSystem, T: Real> {
    pub(super) q: Vector<S, T>,
    pub(super) place: Place<S, T>,
    pub(super) impulses: Impulses<S, T>,
    pub(super) increment: Vector<S, T>,
    /// A correction of the increment, or the velocity at the end.
    pub(super) vector: Vector<S, T>,
    pub(super) values: Multipliers<S, T>,
    pub(super) gram: Gram<S, T>,
}

impl<S: ConstrainedSystem, T: Real> Memory<T> for Place<S, T> {
    lasting!(T; numbers p, numbers force, vectors rows, vectors solved, numbers squares, flag is_positive);
}

impl<S: ConstrainedSystem, T: Real> Place<S, T> {
    #[inline(always)]
    pub(super) fn new(system: &S) -> Self {
        let vector = || system.space().vector();
        let rows = || system.multipliers().array(vector);
        let squares = system.multipliers().vector();
        Self { p: vector(), force: vector(), rows: rows(), solved: rows(), squares, is_positive: true }
    }
}

impl<S: ConstrainedSystem, T: Real> Work<S, T> {
    #[inline(always)]
    pub(super) fn new(system: &S) -> Self {
        let vector = || system.space().vector();
        let m = system.multipliers().dimension();
        let all = |visit: &mut dyn FnMut(usize, usize)| {
            (0..m).for_each(|k| (0..m).for_each(|l| visit(k, l)));
        };
        Self {
            q: vector(),
            place: Place::new(system),
            impulses: Impulses::new(system),
            increment: vector(),
            vector: vector(),
            values: system.multipliers().vector(),
            gram: system.multipliers().square(all),
        }
    }
}

/// Adds Σ `factors`ₖ `rows`ₖ to `sum`.
#[inline(always)]
fn combine<T: Real, V: core::ops::Deref<Target = [T]>>(rows: &[V], factors: &[T], sum: &mut [T]) {
    for (row, &factor) in rows.iter().zip(factors) {
        for (sum, &entry) in sum.iter_mut().zip(row.iter()) {
            *sum += factor * entry;
        }
    }
}

#[inline(always)]
fn dot<T: Real>(a: &[T], b: &[T]) -> T {
    a.iter().zip(b).fold(T::lift(NEUTRAL), |sum, (&a, &b)| sum + a * b)
}

/// Sets a matrix to `factor` A Bᵀ, where A and B have these rows.
#[inline(always)]
pub(super) fn fill<T: Real, V: core::ops::Deref<Target = [T]>, Q: SquareMatrix<T>>(
    gram: &mut Q,
    [a, b]: [&[V]; 2],
    factor: T,
) {
    let entries = gram.cleared();
    for (k, a) in a.iter().enumerate() {
        for (l, b) in b.iter().enumerate() {
            entries.add(k, l, factor * dot(a, b));
        }
    }
}

/// Overwrites `x` with the solution of (`factor` A Bᵀ) y = x, where A and B have these rows.
///
/// # Errors
/// [`StepFailure::RedundantConstraint`].
#[inline(always)]
fn solve<T: Real, V: core::ops::Deref<Target = [T]>, Q: SquareMatrix<T>>(
    gram: &mut Q,
    rows: [&[V]; 2],
    factor: T,
    x: &mut [T],
) -> Result<(), StepFailure> {
    fill(gram, rows, factor);
    gram.eliminate(x).map_err(named)
}

/// The failure of a matrix over the constraints, with the name of one.
#[cold]
pub(super) fn named(failure: StepFailure) -> StepFailure {
    match failure {
        StepFailure::Singular { column, pivot } if pivot.is_nan() => {
            StepFailure::UndefinedConstraint { constraint: column, value: pivot }
        }
        StepFailure::Singular { column, pivot } => {
            StepFailure::RedundantConstraint { constraint: column, pivot }
        }
        other => other,
    }
}

/// Whether the solution of a step, with G(q1) = `rows`, lies on the branch of the motion: where no gradient has turned by a right
/// angle in the metric of M, the determinant of G(q1) M⁻¹ G(q0)ᵀ has the sign of that of G(q0) M⁻¹ G(q0)ᵀ, and the displacement makes no
/// larger angle than 45° with the constraints, if M is a metric and the constraints do not move.
///
/// # Errors
/// [`StepFailure::Turned`] and [`StepFailure::Branch`].
#[inline(always)]
fn is_on_branch<S: HolonomicLagrangian<T> + Separable<T>, T: Real>(
    step: &Step<'_, S, T>,
    gram: &mut Gram<S, T>,
    rows: &Rows<S, T>,
    [q1, increment]: [&[T]; 2],
) -> Result<(), StepFailure> {
    let Step { mass, is_metric, here, .. } = *step;
    let length = (is_metric && S::AUTONOMOUS).then(|| mass.squared(increment));
    for (constraint, (row, solved)) in rows.iter().zip(here.solved.iter()).enumerate() {
        let square = here.squares[constraint];
        // What is no number is no turn by less than a right angle either.
        let is_small = dot(row, solved) * square > T::lift(0.0);
        let along = |length| {
            let product = dot(&here.rows[constraint], increment);
            // Where a displacement may be rounding, both ends of it have one size; that of the first would be evaluated in every step,
            // as nothing in the loop around this changes it.
            is_along(product, square, length, || mass.squared(q1))
        };
        if !(is_small && length.is_none_or(along)) {
            return Err(StepFailure::Turned { constraint });
        }
    }
    // Of one constraint that is the determinant.
    if rows.len() > 1 {
        fill(gram, [rows, &here.solved], T::lift(1.0));
        gram.factor().map_err(named)?;
        if gram.is_positive() != here.is_positive {
            return Err(StepFailure::Branch);
        }
    }
    Ok(())
}

/// One step: where it begins, and how long it is.
pub(super) struct Step<'a, S: ConstrainedSystem, T: Real> {
    pub(super) system: &'a S,
    pub(super) mass: &'a Mass<S, T>,
    /// Whether M is diagonal and positive, so that the length of a displacement is known.
    pub(super) is_metric: bool,
    pub(super) q: &'a [T],
    pub(super) here: &'a Place<S, T>,
    pub(super) t: T,
    pub(super) h: T,
    pub(super) stopping: Stopping,
}

impl<S: HolonomicLagrangian<T> + Separable<T>, T: Real> Work<S, T> {
    /// Sets ι0, Δ and q1, with q1 on the constraints, from a guess of ι0: `ratio` times `last`.
    #[inline(always)]
    pub(super) fn shake(
        &mut self,
        step: &Step<'_, S, T>,
        (ratio, last): (T, &[T]),
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Step { system, mass, q, here, t, h, stopping, .. } = *step;
        let Self { q: q1, place, impulses, increment, vector, values, gram } = self;
        let half = T::lift(0.5) * h;
        for ((p, &p0), &f) in place.p.iter_mut().zip(here.p.iter()).zip(here.force.iter()) {
            *p = p0 + half * f;
        }
        mass.solve(&place.p, increment);
        for ((impulse, value), &last) in impulses.first.iter_mut().zip(values.iter_mut()).zip(last) {
            *impulse = ratio * last;
            *value = *impulse;
        }
        combine(&here.solved, values, increment);
        increment.iter_mut().for_each(|delta| *delta *= h);
        let scale = norm::largest(q) + norm::largest(increment);
        let convergence = Convergence::new(stopping, scale, q, stopping.max_iterations);
        iterate(convergence, statistics, |_| {
            add(q, increment, q1);
            constrain(system, q1, t + h, values, &mut place.rows);
            solve(gram, [&place.rows, &here.solved], h, values)?;
            for (impulse, value) in impulses.first.iter_mut().zip(values.iter_mut()) {
                *impulse -= *value;
                *value *= h;
            }
            vector.fill(T::lift(NEUTRAL));
            combine(&here.solved, values, vector);
            for (delta, &change) in increment.iter_mut().zip(vector.iter()) {
                *delta -= change;
            }
            Ok(norm::largest(vector))
        })?;
        add(q, increment, q1);
        constrain(system, q1, t + h, values, &mut place.rows);
        let is_here = is_on_branch(step, gram, &place.rows, [q1, increment]);
        is_here.map_err(|failure| norm::finite(q1).err().unwrap_or(failure))
    }

    /// Sets p1, with its velocity along the constraints, and ι1.
    #[inline(always)]
    pub(super) fn rattle(&mut self, step: &Step<'_, S, T>) -> Result<(), StepFailure> {
        let Step { system, mass, here, t, h, .. } = *step;
        let Self { q, place, impulses, .. } = self;
        let (t1, half) = (t + h, T::lift(0.5) * h);
        combine(&here.rows, &impulses.first, &mut place.p);
        place.is_positive = here.is_positive;
        system.force(q, &[], t1, &mut place.force);
        for (p, &f) in place.p.iter_mut().zip(place.force.iter()) {
            *p += half * f;
        }
        self.align(system, mass, t1)
    }

    /// Makes the velocity of p at q one along the constraints, of which the gradients are here.
    #[inline(always)]
    pub(super) fn align(&mut self, system: &S, mass: &Mass<S, T>, t: T) -> Result<(), StepFailure> {
        let Self {
            q, place: Place { p, rows, solved, squares, .. }, impulses, vector: v, values, gram, ..
        } = self;
        for (row, solved) in rows.iter().zip(solved.iter_mut()) {
            mass.solve(row, solved);
        }
        for (square, (row, solved)) in squares.iter_mut().zip(rows.iter().zip(solved.iter())) {
            *square = dot(row, solved);
        }
        mass.solve(p, v);
        if S::AUTONOMOUS {
            for (value, row) in values.iter_mut().zip(rows.iter()) {
                *value = dot(row, v);
            }
        } else {
            system.constraint_rate(q, v, t, values);
        }
        solve(gram, [rows, solved], T::lift(1.0), values)?;
        for (impulse, value) in impulses.last.iter_mut().zip(values.iter_mut()) {
            *value = -*value;
            *impulse = *value;
        }
        combine(rows, values, p);
        norm::finite(p)
    }
}

/// Sets `g` and the rows of G at (`q`, `t`).
#[inline(always)]
pub(super) fn constrain<S: HolonomicLagrangian<T>, T: Real>(
    system: &S,
    q: &[T],
    t: T,
    g: &mut [T],
    rows: &mut [Vector<S, T>],
) {
    rows.iter_mut().for_each(|row| row.fill(T::lift(NEUTRAL)));
    system.constraint_jacobian(q, t, g, &mut Places(|k: usize, j: usize, entry| rows[k][j] += entry));
}

/// Sets `sum` to q + Δ.
#[inline(always)]
fn add<T: Real>(q: &[T], increment: &[T], sum: &mut [T]) {
    for ((sum, &q), &delta) in sum.iter_mut().zip(q).zip(increment) {
        *sum = q + delta;
    }
}
