//! Runs taken together, one in each lane of a pack.
//!
//! Several runs of one method, on systems that share packs, with the same step and at the same time, are
//! loaded into packs, moved on by the steps of the method, and stored again. Where one of them has to be
//! looked at or decides otherwise than the others do, it goes on alone from the last point that all have
//! reached: so each run is, bit by bit, what it would have been alone.

use crate::methods::{Carries, Clock, Method};
use crate::scalar::Lanes;
use crate::shown::shown;
use crate::state::Statistics;
#[cfg(doc)]
use crate::system::Packable;
use crate::{Lagrangian, System, Vector};

/// One of several runs that are taken together.
pub struct Companion<'a, S: System, M: Carries<S, f64>> {
    pub(crate) memory: &'a mut M::Memory,
    pub(crate) q: &'a mut Vector<S, f64>,
    pub(crate) statistics: &'a mut Statistics,
}

shown!([S: System, M: Carries<S, f64>] Companion<'_, S, M>, |run| q: run.q, statistics: run.statistics);

/// A method whose runs can be taken together, `W` at a time.
///
/// `Sigma` where α is affine and couples the coordinates in pairs, with σ = 0 if Dα is antisymmetric and with
/// σ = ½ if a run has no parasitic mode, and `Variational::trapezoid` where it is explicit and the mass
/// matrix diagonal, take steps in lanes. Of other systems and options each run is taken alone.
#[diagnostic::on_unimplemented(
    message = "runs of `{Self}` on `{S}` cannot be taken together in lanes",
    label = "it is neither `Sigma` nor `Variational`, or a parameter of the system is not of one type in \
        all lanes"
)]
pub trait InStep<const W: usize, S: Lagrangian>: Method<S, f64> {
    /// What is loaded.
    type Packs;

    /// Room for the runs.
    fn packs(&self, system: &S) -> Self::Packs;

    /// Whether two systems differ in nothing but what may differ from lane to lane: [`Packable::fits`].
    fn fit(a: &S, b: &S) -> Option<bool>;

    /// Takes up to `count` steps of all `runs`, of which there are 1 to `W`, from the present time of
    /// `clock`, bit for bit as each would alone. Their `systems` share packs. Returns how many: fewer, or
    /// none, where one of the runs has to go on alone.
    fn steps_together(
        &self,
        systems: &[&S],
        packs: &mut Self::Packs,
        runs: &mut [Companion<'_, S, Self>],
        clock: Clock<f64>,
        count: u64,
    ) -> u64
    where
        Self: Sized;
}

/// Loads a vector of each run into the lanes of `packs`; lanes without a run repeat the first.
pub(crate) fn load<'a, const W: usize>(
    packs: &mut [Lanes<W>],
    vector: impl Fn(usize) -> &'a [f64],
    runs: usize,
) {
    for lane in 0..W {
        crate::scalar::lanes::write_lane(lane, vector(run_in(lane, runs)), packs);
    }
}

/// The same of a vector that runs may not have. Returns whether all have it.
#[must_use]
pub(crate) fn load_if_all_have<'a, const W: usize>(
    packs: &mut [Lanes<W>],
    vector: impl Fn(usize) -> Option<&'a [f64]>,
    runs: usize,
) -> bool {
    (0..W).all(|lane| {
        vector(run_in(lane, runs))
            .map(|vector| crate::scalar::lanes::write_lane(lane, vector, packs))
            .is_some()
    })
}

/// The run in a lane.
fn run_in(lane: usize, runs: usize) -> usize {
    if lane < runs { lane } else { 0 }
}

/// The system in each lane; lanes without a run repeat the first.
pub(crate) fn of_lanes<'a, const W: usize, S>(systems: &[&'a S]) -> [&'a S; W] {
    core::array::from_fn(|lane| systems[run_in(lane, systems.len())])
}

/// Whether all lanes of `packs` are finite.
pub(crate) fn all_finite<const W: usize>(packs: &[Lanes<W>]) -> bool {
    let zero = Lanes::all(0.0);
    let mut sum = zero;
    for &pack in packs {
        sum += pack * zero;
    }
    sum == zero
}
