//! Störmer and Verlet's steps of several runs in lanes: kick, drift, kick, as [`verlet`](super::verlet)
//! takes them one run at a time.

use super::Variational;
use crate::discrete::frequency::Frequency;
use crate::discrete::quadrature::Rule;
use crate::mechanics::phase::Arrival;
use crate::methods::Clock;
use crate::methods::together::{Companion, InStep, all_finite, load, load_if_all_have, of_lanes};
use crate::methods::walk::BLOCK;
use crate::scalar::Lanes;
use crate::scalar::lanes::read_lane;
use crate::scalar::simd::wide_if;
use crate::system::Packable;
use crate::{NondegenerateLagrangian, RegularLagrangian, Space, System, Vector};

/// q, p and the force, and where the last good ones are kept.
#[derive(Debug)]
pub struct Packs<const W: usize, S: System> {
    now: [Vector<S, Lanes<W>>; 3],
    kept: [Vector<S, Lanes<W>>; 3],
    /// 1/m.
    reciprocals: Vector<S, Lanes<W>>,
    one: [Vector<S, f64>; 3],
}

impl<const W: usize, S, F, R: Rule> InStep<W, S> for Variational<F, R>
where
    S: RegularLagrangian + Packable<W, Packed: RegularLagrangian<Lanes<W>>>,
    F: Frequency,
{
    type Packs = Packs<W, S>;

    fn packs(&self, system: &S) -> Packs<W, S> {
        let space = system.space();
        let one = space.vectors();
        Packs { now: space.vectors(), kept: space.vectors(), reciprocals: space.vector(), one }
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
        let is_separable = <S as NondegenerateLagrangian<f64>>::SEPARABLE;
        if !(self.is_verlet() && is_separable) {
            return 0;
        }
        let Packs { now, kept, reciprocals, one } = packs;
        let [q, p, force] = &mut *now;
        load(q, |run| &*runs[run].q, runs.len());
        load(p, |run| &runs[run].memory.carried.phase.p, runs.len());
        load(force, |run| &runs[run].memory.carried.phase.force, runs.len());
        let of_run = |run: usize| runs[run].memory.carried.inertial.mass.reciprocals();
        if !load_if_all_have(reciprocals, of_run, runs.len()) {
            return 0;
        }
        let [h, half] = [clock.step_size(), 0.5 * clock.step_size()].map(Lanes::all);
        let taken = S::packed(&of_lanes(systems), |system| {
            let mut taken = 0;
            while taken < count {
                let steps = BLOCK.min(count - taken);
                for (kept, now) in kept.iter_mut().zip(now.iter()) {
                    kept.copy_from_slice(now);
                }
                wide_if!(true, {
                    // Copies, and one pointer to all vectors: what is outside would be looked up again after
                    // each store.
                    let (clock, [h, half]) = (clock, [h, half]);
                    let [q, p, force] = &mut *now;
                    for step in taken..taken + steps {
                        for (((q, p), &force), &reciprocal) in
                            q.iter_mut().zip(p.iter_mut()).zip(force.iter()).zip(reciprocals.iter())
                        {
                            *p += half * force;
                            *q += *p * (h * reciprocal);
                        }
                        system.force(q, &[], Lanes::all(clock.after(step + 1).time()), force);
                        for (p, &force) in p.iter_mut().zip(force.iter()) {
                            *p += half * force;
                        }
                    }
                });
                // A collision shows in the force, which is in the momentum.
                let [q, p, _] = &*now;
                if !(all_finite(q) && all_finite(p)) {
                    for (now, kept) in now.iter_mut().zip(kept.iter()) {
                        now.copy_from_slice(kept);
                    }
                    break;
                }
                taken += steps;
            }
            taken
        });
        for (lane, run) in runs.iter_mut().enumerate() {
            for (one, packs) in one.iter_mut().zip(now.iter()) {
                read_lane(lane, packs, one);
            }
            let [q, p, force] = &*one;
            run.memory.carried.phase.set(run.q, &Arrival { q, p, force });
            run.statistics.gradients += taken;
            run.statistics.steps += taken;
        }
        taken
    }
}
