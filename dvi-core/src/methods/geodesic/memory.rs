//! What a run along geodesics carries, and work space.

use super::tangents::{TangentMass, Tangents};
use crate::mechanics::manifold::{Block, blocks};
use crate::mechanics::pattern::mass_entries;
use crate::memory::lasting;
use crate::scalar::carries_derivatives;
use crate::space::inertia::inertia;
use crate::space::{RowMatrix, Sink};
use crate::state::rates::Rates;
use crate::state::summation::{Carried, Summation};
use crate::system::{Factor, ManifoldSystem};
use crate::{ManifoldLagrangian, Real, Scalar, Space, System, Vector};

/// The momentum of a run of [`Geodesic`](super::Geodesic), what its next step is guessed from, and work
/// space.
#[derive(Debug)]
pub struct GeodesicMemory<S: ManifoldSystem, T: Real> {
    /// ∂L/∂v, as a covector of the manifold: of a unit vector s × ∂L/∂ṡ, whose sums round without a bias.
    pub(super) p: Vector<S, T>,
    /// The rates of displacement of the last steps.
    pub(super) rates: Rates<S, T>,
    /// The coordinates, of rotations as quaternions, and what rounding has left out of them.
    pub(super) lifted: Vector<S, T>,
    pub(super) carried: Carried<S, T>,
    /// Where kicks are steps.
    pub(super) kicks: Option<Kicks<S, T>>,
    /// If the mass matrix depends on the state.
    pub(super) orientation: Option<TangentMass<S, T>>,
    /// Whether the determinant of the mass matrix is positive.
    pub(super) is_positive: bool,
    /// Storage for p at the beginning of a drift.
    pub(super) p0: Vector<S, T>,
    pub(super) tangents: Tangents<S, T>,
    pub(super) arrival: Arrival<S, T>,
}

/// The rows of M, where it is the same everywhere.
pub(super) type MassRows<S, T> = <<S as System>::Space as Space>::Rows<<S as System>::Space, T>;

/// What a step by kicks needs of L.
#[derive(Debug)]
pub(super) struct Kicks<S: System, T: Real> {
    pub(super) mass: MassRows<S, T>,
    /// 1/m for each velocity, where drifts are [free](inverse_masses).
    pub(super) free: Option<Vector<S, T>>,
    /// The force at the current point, as a covector of the manifold.
    pub(super) force: Vector<S, T>,
}

/// M, from its entries at a point.
pub(super) fn mass_at<S: ManifoldLagrangian<T>, T: Real>(system: &S, at: [&[T]; 2], t: T) -> MassRows<S, T> {
    let space = system.space();
    let mut rows: MassRows<S, T> =
        space.rows(space, |visit| mass_entries(system, at, t, |row, column, _| visit(row, column)));
    mass_entries(system, at, t, |row, column, entry| rows.add(row, column, entry));
    rows
}

/// 1/m for each velocity, where M couples no two of them, and those of a rotation or a unit vector have one
/// mass. Then a drift does not change the momentum: its displacement is h p/m. In numbers with derivatives
/// masses that are the same may not remain so.
pub(super) fn inverse_masses<S: ManifoldLagrangian<T>, T: Real>(
    system: &S,
    mass: &MassRows<S, T>,
) -> Option<Vector<S, T>> {
    let mut inverses: Vector<S, T> = system.space().vector();
    let mut is_free = !carries_derivatives::<T>();
    for block in blocks(system) {
        for place in block.velocities() {
            mass.row(place, |column, entry| {
                if column == place {
                    inverses[place] = T::lift(1.0) / entry;
                } else {
                    is_free &= entry == T::lift(0.0);
                }
            });
        }
        is_free &= block.factor == Factor::Line
            || block.vector().map(|place| inverses[place]) == [inverses[block.place(0)]; 3];
    }
    is_free.then_some(inverses)
}

/// Whether M is positive, and with it that of the tangent vectors at all points.
pub(super) fn is_positive<S: ManifoldLagrangian<T>, T: Real>(system: &S, mass: &MassRows<S, T>) -> bool {
    let places = || blocks(system).flat_map(Block::velocities);
    // Each row has more on the diagonal than beside it.
    let is_dominant = |row: usize| {
        let mut sum = T::lift(0.0);
        mass.row(row, |column, entry| sum += if column == row { entry } else { -Scalar::abs(entry) });
        sum > T::lift(0.0)
    };
    places().all(is_dominant) || {
        let (mut matrix, mut removed) = (system.space().matrix(), system.space().vector());
        // What has no velocity counts as positive.
        (0..removed.len()).for_each(|place| matrix.add(place, place, T::lift(1.0)));
        for row in places() {
            matrix.add(row, row, -T::lift(1.0));
            mass.row(row, |column, entry| matrix.add(row, column, entry));
        }
        inertia(&mut matrix, &mut removed).is_ok_and(|inertia| inertia.negative == 0)
    }
}

lasting!([S: System, T: Real] Kicks<S, T>, T; numbers force);

/// The end of a step as it is being found.
#[derive(Debug)]
pub(super) struct Arrival<S: System, T: Real> {
    pub(super) displacement: Vector<S, T>,
    /// Of what is carried of the coordinates.
    pub(super) increment: Vector<S, T>,
    pub(super) lifted: Vector<S, T>,
    pub(super) q: Vector<S, T>,
    /// About the velocity there.
    pub(super) v: Vector<S, T>,
    pub(super) p: Vector<S, T>,
    /// The force there, where kicks are steps.
    pub(super) force: Vector<S, T>,
}

impl<S: ManifoldLagrangian<T>, T: Real> GeodesicMemory<S, T> {
    /// For a run from (`q`, `v`) at time t, with the rates of displacement there.
    pub(super) fn new(system: &S, at: [&[T]; 2], t: T, seed: Vector<S, T>) -> Self {
        let space = system.space();
        let [p, lifted, p0, displacement, increment, next, q, v, p1, force] = space.vectors();
        Self {
            p,
            rates: Rates::new(system, [seed]),
            lifted,
            carried: Carried::new(system, Summation::Compensated),
            kicks: None,
            orientation: None,
            is_positive: true,
            p0,
            tangents: Tangents::new(system, at, t),
            arrival: Arrival { displacement, increment, lifted: next, q, v, p: p1, force },
        }
    }

    /// The discrete momentum at the current point, with a place for each coordinate: of a rotation the first
    /// three hold the angular momentum in the body, ∂L/∂ω, and the others are zero; of a unit vector it is
    /// the angular momentum about the centre, s × ∂L/∂ṡ.
    pub fn p(&self) -> &[T] {
        &self.p
    }
}

lasting!([S: ManifoldSystem, T: Real] GeodesicMemory<S, T>, T;
    numbers p, part rates, numbers lifted, part carried, parts kicks, parts orientation, flag is_positive);
