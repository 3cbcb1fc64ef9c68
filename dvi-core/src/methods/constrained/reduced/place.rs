//! What is known of a point of a run for a step of RATTLE, and the storage that a step needs.

use super::rows::{NEUTRAL, dot};
use crate::mechanics::constraints::{ConstrainedLagrangian, Constraints, Multipliers};
use crate::mechanics::mass::Mass;
use crate::memory::lasting;
use crate::methods::constrained::memory::Impulses;
use crate::{ConstrainedSystem, Real, Space, Vector};

/// A vector of coordinates for each constraint.
pub(super) type Rows<S, T> = <<S as ConstrainedSystem>::Multipliers as Space>::Vector<Vector<S, T>>;
/// A square matrix over the constraints.
pub(super) type Gram<S, T> = <<S as ConstrainedSystem>::Multipliers as Space>::Square<T>;

/// What is kept of a point of the run.
#[derive(Debug)]
pub(in super::super) struct Place<S: ConstrainedSystem, T: Real> {
    pub(in super::super) p: Vector<S, T>,
    /// F
    pub(super) force: Vector<S, T>,
    /// The rows of G.
    pub(super) rows: Rows<S, T>,
    /// M⁻¹ times each of them.
    pub(super) solved: Rows<S, T>,
    /// The products of both, row by row: the diagonal of G M⁻¹ Gᵀ.
    pub(super) squares: Multipliers<S, T>,
    /// Those of the step that has led there.
    pub(in super::super) impulses: Impulses<S, T>,
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
    pub(super) of_impulse: T,
    pub(super) values: Multipliers<S, T>,
    pub(super) gram: Gram<S, T>,
}

lasting!([S: ConstrainedSystem, T: Real] Place<S, T>, T;
    numbers p, numbers force, vectors rows, vectors solved, numbers squares, vectors impulses);

impl<S: ConstrainedSystem, T: Real> Place<S, T> {
    #[inline]
    pub(super) fn new(system: &S) -> Self {
        let vector = || system.space().vector();
        let rows = || system.multipliers().array(vector());
        let (squares, impulses) = (system.multipliers().vector(), system.multipliers().vectors());
        Self { p: vector(), force: vector(), rows: rows(), solved: rows(), squares, impulses }
    }
}

impl<S: ConstrainedSystem, T: Real> Arrival<S, T> {
    #[inline]
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
}

impl<S: ConstrainedLagrangian<T>, T: Real> Place<S, T> {
    /// Sets g, in `values`, and the rows of G at (`q`, `t`).
    #[inline]
    pub(super) fn constrain(&mut self, system: &S, q: &[T], t: T, values: &mut [T]) {
        let rows = &mut self.rows;
        rows.iter_mut().for_each(|row| row.fill(T::lift(NEUTRAL)));
        S::Kind::forces(system, q, t, values, &mut |k: usize, j: usize, entry| rows[k][j] += entry);
    }

    /// Sets M⁻¹Gᵀ and the diagonal of G M⁻¹ Gᵀ.
    #[inline]
    pub(super) fn measure(&mut self, mass: &Mass<S, T>) {
        let Self { rows, solved, squares, .. } = self;
        for ((row, solved), square) in rows.iter().zip(solved.iter_mut()).zip(squares.iter_mut()) {
            mass.solve(row, solved);
            *square = dot(row, solved);
        }
    }
}
