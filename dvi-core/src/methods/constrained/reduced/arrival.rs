//! One step of RATTLE.

use super::place::{Arrival, Gram, Place, Rows};
use super::rows::{NEUTRAL, combine, dot, fill, solve};
use crate::error::StepFailure;
use crate::mechanics::constraints::turning::is_along;
use crate::mechanics::constraints::{ConstrainedLagrangian, Constraints};
use crate::mechanics::mass::Mass;
use crate::scalar::passes::{kick, multiply, subtract};
use crate::solve::{Course, Due, Iteration, Judge, Quick, Stopping, repeat, sizes};
use crate::space::SquareMatrix;
use crate::state::Statistics;
use crate::{ConstrainedSystem, Real, Scalar};

/// Where a step begins, and how long it is.
pub(super) struct Begin<'a, S: ConstrainedSystem, T: Real> {
    pub(super) system: &'a S,
    pub(super) mass: &'a Mass<S, T>,
    /// Whether the determinant of G M⁻¹ Gᵀ is positive, as it is along a run if it is where that begins.
    pub(super) is_positive: bool,
    pub(super) q: &'a [T],
    pub(super) here: &'a Place<S, T>,
    pub(super) t: T,
    pub(super) h: T,
    pub(super) stopping: Stopping,
}

impl<S: ConstrainedLagrangian<T>, T: Real> Begin<'_, S, T> {
    /// Whether the pivots of Newton's method say enough of how far the gradient of the only constraint has
    /// turned. Such a pivot is the product of the gradients before and after the step, in the metric of M.
    /// It is held against half the square of the first, so that what the last correction changes of it does
    /// not matter.
    #[inline]
    fn trusts_pivot(&self) -> bool {
        S::DIAGONAL_MASS && self.here.rows.len() == 1
    }
}

/// Whether the solution of a step, with G(q1) = `rows`, lies on the branch of the motion: where no gradient
/// has turned by a right angle in the metric of M, the determinant of G(q1) M⁻¹ G(q0)ᵀ has the sign of that
/// of G(q0) M⁻¹ G(q0)ᵀ, and the displacement, h times the velocity v = M⁻¹p, makes no larger angle than 45°
/// with the constraints, if M is a metric and the constraints do not move.
#[inline]
fn is_on_branch<S: ConstrainedLagrangian<T>, T: Real>(
    begin: &Begin<'_, S, T>,
    gram: &mut Gram<S, T>,
    rows: &Rows<S, T>,
    [q1, p, v]: [&[T]; 3],
) -> bool {
    let Begin { mass, here, h, .. } = *begin;
    let length = (S::DIAGONAL_MASS && S::AUTONOMOUS).then(|| dot(p, v));
    for ((row, solved), &square) in rows.iter().zip(here.solved.iter()).zip(here.squares.iter()) {
        // What is no number is no turn by less than a right angle either.
        let is_small = begin.trusts_pivot() || dot(row, solved) * square > T::lift(0.0);
        // Where a displacement may be rounding, both ends of it have one size; that of the first would be
        // evaluated in every step, as nothing in the loop around this changes it.
        let along = |length| is_along(dot(solved, p), square, length, || mass.squared(q1) / (h * h));
        if !(is_small && length.is_none_or(along)) {
            return false;
        }
    }
    // Of one constraint that is the determinant.
    rows.len() <= 1 || {
        fill(gram, [rows, &here.solved], &here.squares);
        gram.factor().is_ok() && gram.is_positive() == begin.is_positive
    }
}

impl<S: ConstrainedLagrangian<T>, T: Real> Arrival<S, T> {
    /// Sets q1, which is on the constraints, ι0 and the momentum between both ends, from the guess of ι0.
    #[inline]
    pub(super) fn shake(&mut self, begin: &Begin<'_, S, T>, statistics: &mut Statistics) -> Option<()> {
        let Begin { system, mass, q, here, t, h, stopping, .. } = *begin;
        let Self { q: q1, place: Place { p, impulses: [first, _], .. }, vector, .. } = self;
        let half = T::lift(0.5) * h;
        for ((p, &p0), &f) in p.iter_mut().zip(here.p.iter()).zip(here.force.iter()) {
            *p = p0 + half * f;
        }
        multiply(first, h);
        mass.displace(h, p, vector);
        combine(&here.solved, first, vector);
        for ((q1, &q), &delta) in q1.iter_mut().zip(q).zip(vector.iter()) {
            *q1 = q + delta;
        }
        let judge = Quick::of(Course::new(stopping, stopping.max_iterations));
        repeat(judge, statistics, Newton { begin, arrival: self }).ok()?;
        let Self { q: q1, place, vector, values, gram, .. } = self;
        place.constrain(system, q1, t + h, values);
        place.measure(mass);
        let (reciprocal, Place { p, rows, impulses: [first, _], .. }) = (T::lift(1.0) / h, place);
        multiply(first, reciprocal);
        combine(&here.rows, first, p);
        mass.solve(p, vector);
        is_on_branch(begin, gram, rows, [q1, p, vector]).then_some(())
    }

    /// Sets p1, with its velocity along the constraints, and ι1.
    #[inline]
    pub(super) fn rattle(&mut self, begin: &Begin<'_, S, T>) -> Option<()> {
        let Begin { system, mass, t, h, .. } = *begin;
        let (t, half) = (t + h, T::lift(0.5) * h);
        let Self { q, place, vector: v, values, gram, .. } = self;
        let Place { p, force, rows, solved, squares, impulses } = place;
        system.force(q, &[], t, force);
        kick(p, half, force);
        if S::AUTONOMOUS {
            // −G M⁻¹p, with the rows of G M⁻¹, which are here.
            for (value, solved) in values.iter_mut().zip(solved.iter()) {
                *value = -dot(solved, p);
            }
        } else {
            mass.solve(p, v);
            S::Kind::of_velocity(system, q, v, t, values, &mut |_, _, _: T| ());
            values.iter_mut().for_each(|value| *value = -*value);
        }
        // Of one constraint the matrix is its square. A quotient by zero is no number, which is seen where
        // the stride ends.
        if let ([value], [square]) = (&mut values[..], &squares[..]) {
            *value /= *square;
        } else {
            solve(gram, [rows, solved], squares, values)?;
        }
        impulses[1].copy_from_slice(values);
        combine(rows, &impulses[1], p);
        Some(())
    }
}

/// Newton's method for q1 and h ι0: M⁻¹Gᵀ times that is a displacement.
struct Newton<'a, 's, S: ConstrainedSystem, T: Real> {
    begin: &'a Begin<'s, S, T>,
    arrival: &'a mut Arrival<S, T>,
}

impl<S: ConstrainedLagrangian<T>, T: Real> Iteration<T> for Newton<'_, '_, S, T> {
    #[inline]
    fn prepare(&mut self, due: &mut Due) {
        let Self { begin: Begin { system, q, here, .. }, arrival } = self;
        due.prepare(*system, &mut arrival.weights, q, &mut arrival.q);
        if let [only] = &here.solved[..] {
            arrival.of_impulse = sizes::size_of(*system, &arrival.weights, only);
        }
    }

    #[inline]
    fn improve(&mut self, _due: &mut Due, _statistics: &mut Statistics) -> Result<T, StepFailure> {
        let Begin { system, here, t, h, .. } = *self.begin;
        let Arrival { q, place, vector, weights, of_impulse, values, gram } = &mut *self.arrival;
        place.constrain(system, q, t + h, values);
        let Place { rows, impulses, .. } = place;
        if self.begin.trusts_pivot() {
            let pivot = dot(&rows[0], &here.solved[0]);
            let is_small = pivot > T::lift(0.5) * here.squares[0];
            if !is_small {
                return Err(StepFailure::Turned { constraint: 0 });
            }
            values[0] /= pivot;
        } else {
            // What a quick look cannot solve is no failure of the step.
            solve(gram, [rows, &here.solved], &here.squares, values).ok_or(StepFailure::Branch)?;
        }
        subtract(&mut impulses[0], values);
        vector.fill(T::lift(NEUTRAL));
        combine(&here.solved, values, vector);
        let size = sizes::reduce(system, weights, q, vector);
        Ok(if let [only] = values[..] { Scalar::abs(only) * *of_impulse } else { size })
    }
}
