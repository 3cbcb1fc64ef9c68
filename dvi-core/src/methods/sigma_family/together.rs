//! Steps of several runs in lanes, for affine α that couples the coordinates in pairs: σ = 0 as in
//! [`leapfrog`](super::leapfrog), and the fixed point of σ = ½ as in [`affine`](super::affine).

mod leaps;
mod midpoints;

use leaps::leaps;
use midpoints::midpoints;

use super::Sigma;
use crate::methods::Clock;
use crate::methods::together::{Companion, InStep, load_if_all_have};
use crate::scalar::Lanes;
use crate::scalar::lanes::read_lane;
use crate::state::history::DEPTH;
use crate::state::summation::Summation;
use crate::system::Packable;
use crate::{DegenerateLagrangian, Space, System, Vector};

type Packed<const W: usize, S> = Vector<S, Lanes<W>>;

/// The points of the runs, and what their steps work on.
#[derive(Debug)]
pub struct Packs<const W: usize, S: System> {
    q: Packed<W, S>,
    /// The point ahead, if σ = 0; the increment s if σ = ½.
    other: Packed<W, S>,
    kept: [Packed<W, S>; 2],
    gradient: Packed<W, S>,
    point: Packed<W, S>,
    history: [Packed<W, S>; DEPTH],
    reciprocals: Packed<W, S>,
    /// Of one run.
    one: Vector<S, f64>,
    increment: Vector<S, f64>,
}

impl<const W: usize, S> InStep<W, S> for Sigma
where
    S: DegenerateLagrangian + Packable<W, Packed: DegenerateLagrangian<Lanes<W>>>,
{
    type Packs = Packs<W, S>;

    fn packs(&self, system: &S) -> Packs<W, S> {
        let space = system.space();
        let [q, other, gradient, point, reciprocals] = space.vectors();
        let ([one, increment], kept, history) = (space.vectors(), space.vectors(), space.vectors());
        Packs { q, other, kept, gradient, point, history, reciprocals, one, increment }
    }

    fn fit(a: &S, b: &S) -> Option<bool> {
        a.fits(b)
    }

    fn steps_together(
        &self,
        systems: &[&S],
        packs: &mut Packs<W, S>,
        runs: &mut [Companion<'_, S, Self>],
        clock: Clock<f64>,
        count: u64,
    ) -> u64 {
        let is_affine = <S as DegenerateLagrangian<f64>>::AFFINE;
        if !(is_affine && self.summation == Summation::Plain) {
            return 0;
        }
        let of_run = |run: usize| runs[run].memory.carried.inverse.reciprocals();
        if !load_if_all_have(&mut packs.reciprocals, of_run, runs.len()) {
            return 0;
        }
        if self.sigma == 0.0 {
            leaps(systems, packs, runs, clock, count)
        } else if self.is_midpoint() {
            midpoints(self, systems, packs, runs, clock, count)
        } else {
            0
        }
    }
}

/// Looks at the points `q` of the runs, and returns the number of steps that may follow, at most `most`,
/// before that is to be done again; none if a run is to go on alone.
fn look<const W: usize, S: DegenerateLagrangian>(
    runs: &mut [Companion<'_, S, Sigma>],
    q: &[Lanes<W>],
    one: &mut Vector<S, f64>,
    most: u64,
) -> u64 {
    let mut steps = most;
    for (lane, run) in runs.iter_mut().enumerate() {
        read_lane(lane, q, one);
        match run.memory.monitor.look(one) {
            Ok(unseen) => steps = steps.min(unseen),
            Err(_) => return 0,
        }
    }
    steps
}
