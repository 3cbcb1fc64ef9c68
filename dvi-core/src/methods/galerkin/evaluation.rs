//! How the forces at the interior nodes of a step are evaluated: one by one, or in the lanes of packs.

use super::interior::Interior;
use crate::mechanics::motion::{Evaluation, InLanes, OneByOne};
use crate::memory::Memory;
use crate::scalar::Lanes;
use crate::scalar::lanes::{read_lane, write_lane};
use crate::{NondegenerateLagrangian, Real, System, Vector};

/// In which packs the interior nodes of a step stand.
#[diagnostic::on_unimplemented(
    message = "the forces of {NODES} nodes cannot be evaluated in lanes",
    label = "lanes are for 4 to 9 nodes"
)]
pub trait NodeEvaluation<const NODES: usize, S: System, T: Real>: Evaluation {
    /// The interior nodes.
    type Interior: Memory<T>;
}

impl<const NODES: usize, S: System, T: Real> NodeEvaluation<NODES, S, T> for OneByOne {
    type Interior = Interior<NODES, NODES, S, T, Self>;
}

macro_rules! in_lanes {
    ($($nodes:literal $lanes:literal),*) => {$(
        impl<S: System, T: Real> NodeEvaluation<$nodes, S, T> for InLanes {
            type Interior = Interior<$nodes, $lanes, S, T, Self>;
        }
    )*};
}

in_lanes!(4 2, 5 4, 6 4, 7 8, 8 8, 9 8);

/// How the forces at up to `W` nodes are evaluated.
pub trait NodeForces<const W: usize, S: System, T: Real> {
    /// Sets the first `count` lanes of `forces` to those at `places` and `times`; `work` is storage.
    fn evaluate(
        system: &S,
        count: usize,
        places: &[Lanes<W, T>],
        times: Lanes<W, T>,
        forces: &mut [Lanes<W, T>],
        work: [&mut Vector<S, T>; 2],
    );
}

impl<const W: usize, S: NondegenerateLagrangian<T>, T: Real> NodeForces<W, S, T> for OneByOne {
    #[inline]
    fn evaluate(
        system: &S,
        count: usize,
        places: &[Lanes<W, T>],
        times: Lanes<W, T>,
        forces: &mut [Lanes<W, T>],
        [place, force]: [&mut Vector<S, T>; 2],
    ) {
        for lane in 0..count {
            read_lane(lane, places, place);
            system.force(place, &[], times.0[lane], force);
            write_lane(lane, force, forces);
        }
    }
}

impl<const W: usize, S: NondegenerateLagrangian<Lanes<W, T>>, T: Real> NodeForces<W, S, T> for InLanes {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn evaluate(
        system: &S,
        _count: usize,
        places: &[Lanes<W, T>],
        times: Lanes<W, T>,
        forces: &mut [Lanes<W, T>],
        _work: [&mut Vector<S, T>; 2],
    ) {
        system.force(places, &[], times, forces);
    }
}
