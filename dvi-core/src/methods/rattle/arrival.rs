//! One step of RATTLE, and the storage that it needs.

use core::ops::Deref;

use super::rows::{NEUTRAL, admit, combine, dot, fill, least, named, solve};
use crate::error::StepFailure;
use crate::mechanics::constraints::Multipliers;
use crate::mechanics::constraints::turning::is_along;
use crate::mechanics::mass::Mass;
use crate::memory::{Memory, lasting};
use crate::methods::constrained::Impulses;
use crate::methods::kicks::kick;
use crate::scalar::norm;
use crate::solve::{Course, Due, Iteration, Judge, Stopping, repeat, sizes};
use crate::space::sink::Places;
use crate::space::{SquareMatrix, linear};
use crate::state::Statistics;
use crate::{ConstrainedSystem, HolonomicLagrangian, Real, Scalar, Separable, Space, Vector};

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
    /// Those of the step that has led there.
    pub(super) impulses: Impulses<S, T>,
}

/// The end of a step as it is being found.
#[derive(Debug)]
pub(super) struct Arrival<S: ConstrainedSystem, T: Real> {
    pub(super) q: Vector<S, T>,
    pub(super) place: Place<S, T>,
    /// A displacement, or a velocity.
    pub(super) vector: Vector<S, T>,
    /// In which the iteration judges coordinates.
    pub(super) weights: Vector<S, T>,
    /// The size in these of the displacement by a unit of the impulse, if there is one constraint: it saves
    /// the size of each correction, 18 instructions in a step on a sphere.
    of_impulse: T,
    pub(super) values: Multipliers<S, T>,
    pub(super) gram: Gram<S, T>,
}

impl<S: ConstrainedSystem, T: Real> Memory<T> for Place<S, T> {
    lasting!(T; numbers p, numbers force, vectors rows, vectors solved, numbers squares, part impulses);
}

impl<S: ConstrainedSystem, T: Real> Place<S, T> {
    pub(super) fn new(system: &S) -> Self {
        let vector = || system.space().vector();
        let rows = || system.multipliers().array(vector);
        let (squares, impulses) = (system.multipliers().vector(), Impulses::new(system));
        Self { p: vector(), force: vector(), rows: rows(), solved: rows(), squares, impulses }
    }
}

impl<S: ConstrainedSystem, T: Real> Arrival<S, T> {
    pub(super) fn new(system: &S) -> Self {
        let vector = || system.space().vector();
        let m = system.multipliers().dimension();
        let all = |visit: &mut dyn FnMut(usize, usize)| {
            (0..m).for_each(|k| (0..m).for_each(|l| visit(k, l)));
        };
        Self {
            q: vector(),
            place: Place::new(system),
            vector: vector(),
            weights: vector(),
            of_impulse: T::lift(0.0),
            values: system.multipliers().vector(),
            gram: system.multipliers().square(all),
        }
    }

    /// Sets the guess of ι0 to `ratio` times `last`.
    pub(super) fn guess(&mut self, ratio: T, last: &[T]) {
        for (impulse, &last) in self.place.impulses.first.iter_mut().zip(last) {
            *impulse = ratio * last;
        }
    }
}

/// Where a step begins, and how long it is. A judge that gives no names looks at it quickly: what passes
/// would pass a close look too, except that numbers may not be finite, of which no later step makes finite
/// ones. What does not pass may, and is looked at closely then.
pub(super) struct Begin<'a, S: ConstrainedSystem, T: Real> {
    pub(super) system: &'a S,
    pub(super) mass: &'a Mass<S, T>,
    /// Whether M is diagonal and positive, so that the length of a displacement is known.
    pub(super) is_metric: bool,
    /// Whether the determinant of G M⁻¹ Gᵀ is positive, as it is along a run if it is where that begins.
    pub(super) is_positive: bool,
    /// Whether the pivots of Newton's method say enough of how far the gradient of the only constraint has
    /// turned, which is looked at quickly then. Such a pivot is the product of the gradients before and after
    /// the step, in the metric of M. It is held against half the square of the first, so that what the last
    /// correction changes of it does not matter.
    pub(super) trusts_pivot: bool,
    pub(super) q: &'a [T],
    pub(super) here: &'a Place<S, T>,
    pub(super) t: T,
    pub(super) h: T,
    pub(super) stopping: Stopping,
}

impl<S: HolonomicLagrangian<T> + Separable<T>, T: Real> Place<S, T> {
    /// Sets M⁻¹Gᵀ and the diagonal of G M⁻¹ Gᵀ.
    pub(super) fn measure(&mut self, mass: &Mass<S, T>) {
        let Self { rows, solved, squares, .. } = self;
        for ((row, solved), square) in rows.iter().zip(solved.iter_mut()).zip(squares.iter_mut()) {
            mass.solve(row, solved);
            *square = dot(row, solved);
        }
    }
}

/// Whether the solution of a step, with G(q1) = `rows`, lies on the branch of the motion: where no gradient
/// has turned by a right angle in the metric of M, the determinant of G(q1) M⁻¹ G(q0)ᵀ has the sign of that
/// of G(q0) M⁻¹ G(q0)ᵀ, and the displacement, h times the velocity v = M⁻¹p, makes no larger angle than 45°
/// with the constraints, if M is a metric and the constraints do not move.
///
/// # Errors
/// [`StepFailure::Turned`] and [`StepFailure::Branch`].
#[cfg_attr(not(debug_assertions), inline(always))]
fn is_on_branch<S: HolonomicLagrangian<T> + Separable<T>, T: Real>(
    begin: &Begin<'_, S, T>,
    gram: &mut Gram<S, T>,
    rows: &Rows<S, T>,
    [q1, p, v]: [&[T]; 3],
) -> Result<(), StepFailure> {
    let Begin { mass, is_metric, is_positive, trusts_pivot, here, h, .. } = *begin;
    let length = (is_metric && S::AUTONOMOUS).then(|| dot(p, v));
    for (constraint, (row, solved)) in rows.iter().zip(here.solved.iter()).enumerate() {
        let square = here.squares[constraint];
        // What is no number is no turn by less than a right angle either.
        let is_small = trusts_pivot || dot(row, solved) * square > T::lift(0.0);
        // Where a displacement may be rounding, both ends of it have one size; that of the first would be
        // evaluated in every step, as nothing in the loop around this changes it.
        let along = |length| is_along(dot(solved, p), square, length, || mass.squared(q1) / (h * h));
        if !(is_small && length.is_none_or(along)) {
            return Err(StepFailure::Turned { constraint });
        }
    }
    // Of one constraint that is the determinant.
    if rows.len() > 1 {
        fill(gram, [rows, &here.solved], &here.squares);
        gram.factor().map_err(named)?;
        if gram.is_positive() != is_positive {
            return Err(StepFailure::Branch);
        }
    }
    Ok(())
}

impl<S: HolonomicLagrangian<T> + Separable<T>, T: Real> Arrival<S, T> {
    /// Sets q1, which is on the constraints, ι0 and the momentum between both ends, from the guess of ι0.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn shake<J: Judge<T>>(
        &mut self,
        begin: &Begin<'_, S, T>,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Begin { system, mass, q, here, t, h, stopping, .. } = *begin;
        let Self { q: q1, place: Place { p, impulses: Impulses { first, .. }, .. }, vector, .. } = self;
        let (t1, half) = (t + h, T::lift(0.5) * h);
        for ((p, &p0), &f) in p.iter_mut().zip(here.p.iter()).zip(here.force.iter()) {
            *p = p0 + half * f;
        }
        first.iter_mut().for_each(|impulse| *impulse *= h);
        mass.displace(h, p, vector);
        combine(&here.solved, first, vector);
        for ((q1, &q), &delta) in q1.iter_mut().zip(q).zip(vector.iter()) {
            *q1 = q + delta;
        }
        let judge = J::of(Course::new(stopping, stopping.max_iterations));
        repeat(judge, statistics, Newton { begin, arrival: self })?;
        let Self { q: q1, place, vector, values, gram, .. } = self;
        constrain(system, q1, t1, values, &mut place.rows);
        place.measure(mass);
        let (reciprocal, Place { p, rows, impulses: Impulses { first, .. }, .. }) =
            (T::lift(1.0) / h, place);
        first.iter_mut().for_each(|impulse| *impulse *= reciprocal);
        combine(&here.rows, first, p);
        mass.solve(p, vector);
        let is_here = is_on_branch(begin, gram, rows, [q1, p, vector]);
        is_here.map_err(|failure| norm::finite(q1).err().unwrap_or(failure))
    }

    /// Sets p1, with its velocity along the constraints, and ι1.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn rattle<J: Judge<T>>(&mut self, begin: &Begin<'_, S, T>) -> Result<(), StepFailure> {
        let Begin { system, mass, t, h, .. } = *begin;
        let (t1, half) = (t + h, T::lift(0.5) * h);
        let Self { q, place, .. } = self;
        system.force(q, &[], t1, &mut place.force);
        kick(&mut place.p, half, &place.force);
        self.align::<J>((system, mass), t1)
    }

    /// Makes the velocity of p at q one along the constraints, which have been measured.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn align<J: Judge<T>>(
        &mut self,
        (system, mass): (&S, &Mass<S, T>),
        t: T,
    ) -> Result<(), StepFailure> {
        let Self { q, place, vector: v, values, gram, .. } = self;
        let Place { p, rows, solved, squares, impulses, .. } = place;
        if S::AUTONOMOUS {
            // G M⁻¹p, with the rows of G M⁻¹, which are here.
            for (value, solved) in values.iter_mut().zip(solved.iter()) {
                *value = dot(solved, p);
            }
        } else {
            mass.solve(p, v);
            system.constraint_rate(q, v, t, values);
        }
        // Of one constraint the matrix is its square. A quotient by what is no pivot goes no further than to
        // the end of this.
        if let ([value], [square]) = (&mut values[..], &squares[..]) {
            *value /= *square;
        } else {
            solve(gram, [rows, solved], squares, values)?;
        }
        for (impulse, &value) in impulses.last.iter_mut().zip(values.iter()) {
            *impulse = -value;
        }
        combine(rows, &impulses.last, p);
        if let [square] = squares[..] {
            if !J::NAMES && square > least() {
                return Ok(());
            }
            admit(square)?;
        }
        norm::finite(p)
    }
}

/// Newton's method for q1 and h ι0: M⁻¹Gᵀ times that is a displacement.
struct Newton<'a, 's, S: ConstrainedSystem, T: Real> {
    begin: &'a Begin<'s, S, T>,
    arrival: &'a mut Arrival<S, T>,
}

impl<S: HolonomicLagrangian<T> + Separable<T>, T: Real> Iteration<T> for Newton<'_, '_, S, T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn prepare(&mut self, due: &mut Due) {
        let Self { begin: Begin { system, q, here, .. }, arrival } = self;
        due.prepare_end(*system, &mut arrival.weights, q, &mut arrival.q);
        if let [only] = &here.solved[..] {
            arrival.of_impulse = sizes::size_of(*system, &arrival.weights, only);
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn improve(&mut self, due: &mut Due, _statistics: &mut Statistics) -> Result<T, StepFailure> {
        let Begin { system, q: q0, here, t, h, trusts_pivot, .. } = *self.begin;
        let Arrival { q, place, vector, weights, of_impulse, values, gram } = &mut *self.arrival;
        let Place { rows, impulses, .. } = place;
        constrain(system, q, t + h, values, rows);
        if *due == Due::Residual {
            return residual([q0, q], values, rows);
        }
        if trusts_pivot {
            let pivot = dot(&rows[0], &here.solved[0]);
            let is_small = pivot > T::lift(0.5) * here.squares[0];
            if !is_small {
                return Err(StepFailure::Turned { constraint: 0 });
            }
            values[0] /= pivot;
        } else {
            solve(gram, [rows, &here.solved], &here.squares, values)?;
        }
        impulses.first.iter_mut().zip(values.iter()).for_each(|(impulse, &change)| *impulse -= change);
        vector.fill(T::lift(NEUTRAL));
        combine(&here.solved, values, vector);
        let size = sizes::reduce(system, weights, q, vector);
        Ok(if let [only] = values[..] { Scalar::abs(only) * *of_impulse } else { size })
    }
}

/// How far q1 is off the constraints, g in `values`, relative to Σⱼ |Gⱼ| (|qⱼ| + |q1ⱼ|) for each of them
/// (Oettli & Prager 1964).
#[cold]
fn residual<T: Real, V: Deref<Target = [T]>>(
    [q, q1]: [&[T]; 2],
    values: &[T],
    rows: &[V],
) -> Result<T, StepFailure> {
    let sizes = rows.iter().map(|row| {
        let terms = row.iter().zip(q.iter().zip(q1));
        terms.fold(T::lift(0.0), |sum, (&entry, (&q, &q1))| {
            sum + Scalar::abs(entry) * (Scalar::abs(q) + Scalar::abs(q1))
        })
    });
    linear::relative(values.iter().copied().zip(sizes))
}

/// Sets `g` and the rows of G at (`q`, `t`).
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
