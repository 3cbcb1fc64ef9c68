//! The explicit steps of σ = 0 in lanes, where the point ahead is the point before.

use super::{Packs, look};
use crate::DegenerateLagrangian;
use crate::methods::Clock;
use crate::methods::sigma_family::Sigma;
use crate::methods::sigma_family::memory::{Carried, Leaps};
use crate::methods::together::{Companion, all_finite, load, load_if_all_have, of_lanes};
use crate::methods::walk::BLOCK;
use crate::scalar::Lanes;
use crate::scalar::lanes::read_lane;
use crate::scalar::simd::wide_if;
use crate::system::Packable;

/// Up to `count` steps; returns how many.
pub(super) fn leaps<const W: usize, S>(
    systems: &[&S],
    packs: &mut Packs<W, S>,
    runs: &mut [Companion<'_, S, Sigma>],
    clock: Clock<f64>,
    count: u64,
) -> u64
where
    S: DegenerateLagrangian + Packable<W, Packed: DegenerateLagrangian<Lanes<W>>>,
{
    let Packs { q, other: ahead, kept, gradient, reciprocals, one, increment, .. } = packs;
    if !load_if_all_have(ahead, |run| Some(&*runs[run].memory.carried.leaps.as_ref()?.before), runs.len()) {
        return 0;
    }
    load(q, |run| &*runs[run].q, runs.len());
    let taken = S::packed(&of_lanes(systems), |system| {
        let mut taken = 0;
        while taken < count {
            let steps = look(runs, q, one, BLOCK.min(count - taken));
            if steps == 0 {
                break;
            }
            for (kept, now) in kept.iter_mut().zip([&*q, &*ahead]) {
                kept.copy_from_slice(now);
            }
            wide_if!(true, {
                for step in taken..taken + steps {
                    system.hamiltonian_gradient(q, Lanes::all(clock.after(step).time()), gradient);
                    let points = q.iter_mut().zip(ahead.iter_mut());
                    for (j, ((q, ahead), &reciprocal)) in points.zip(reciprocals.iter()).enumerate() {
                        let now = *q;
                        *q = *ahead + gradient[system.conjugate(j)] * reciprocal;
                        *ahead = now;
                    }
                }
            });
            if !(all_finite(q) && all_finite(ahead)) {
                for (now, kept) in [&mut *q, ahead].into_iter().zip(kept.iter()) {
                    now.copy_from_slice(kept);
                }
                break;
            }
            taken += steps;
            for run in runs.iter_mut() {
                run.memory.monitor.steps += steps;
            }
        }
        taken
    });
    if taken == 0 {
        return 0;
    }
    for (lane, (run, &system)) in runs.iter_mut().zip(systems).enumerate() {
        read_lane(lane, q, run.q);
        let Carried { defect, leaps, .. } = &mut run.memory.carried;
        // All have them: the point ahead has been loaded from there.
        if let Some(Leaps { product, before }) = leaps {
            read_lane(lane, ahead, before);
            for ((delta, &now), &before) in increment.iter_mut().zip(run.q.iter()).zip(before.iter()) {
                *delta = now - before;
            }
            product.apply(system, increment, defect);
        }
        run.statistics.gradients += taken;
        run.statistics.steps += taken;
    }
    taken
}
