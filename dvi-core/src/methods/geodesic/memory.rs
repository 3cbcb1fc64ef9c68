//! What a run along geodesics carries, and work space.

use alloc::vec::Vec;

use super::covectors::force;
use super::tangents::{TangentMass, Tangents};
use crate::memory::{Memory, lasting};
use crate::space::sink::Places;
use crate::state::rates::Rates;
use crate::state::summation::{Carried, Summation};
use crate::system::ManifoldSystem;
use crate::{ManifoldLagrangian, Real, Space, System, Vector, Weights};

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

/// What a step by kicks needs of L.
#[derive(Debug)]
pub(super) struct Kicks<S: System, T: Real> {
    /// M, without what is zero.
    pub(super) mass: Vec<MassEntry<T>>,
    /// The force at the current point, as a covector of the manifold.
    pub(super) force: Vector<S, T>,
}

/// An entry of M.
#[derive(Clone, Copy, Debug)]
pub(super) struct MassEntry<T> {
    /// Its row and column.
    pub(super) place: [usize; 2],
    pub(super) value: T,
}

impl<S: ManifoldLagrangian<T>, T: Real> Kicks<S, T> {
    /// At a point, where M is the same as everywhere.
    pub(super) fn new(system: &S, [q, v]: [&[T]; 2], t: T) -> Self {
        let [mut l_q, mut l_v, mut f0]: [Vector<S, T>; 3] = system.space().vectors();
        let mut mass: Vec<MassEntry<T>> = Vec::new();
        let mut sink = Places(|row: usize, column: usize, value: T| {
            if value != T::lift(0.0) {
                mass.push(MassEntry { place: [row, column], value });
            }
        });
        system.linearize(q, v, t, Weights::mass(), &mut l_q, &mut l_v, &mut sink);
        mass.sort_by_key(|entry| entry.place);
        mass.dedup_by(|other, entry| {
            let is_same = other.place == entry.place;
            if is_same {
                entry.value += other.value;
            }
            is_same
        });
        system.force(q, &[], t, &mut f0);
        force(system, q, &mut f0);
        Self { mass, force: f0 }
    }
}

impl<S: System, T: Real> Memory<T> for Kicks<S, T> {
    lasting!(T; numbers force);
}

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

impl<S: ManifoldSystem, T: Real> Memory<T> for GeodesicMemory<S, T> {
    lasting!(T; numbers p, part rates, numbers lifted, part carried, parts kicks, parts orientation, flag is_positive);
}
