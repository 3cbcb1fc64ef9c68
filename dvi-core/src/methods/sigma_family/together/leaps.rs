//! The explicit steps of σ = 0 in lanes.

use super::{Packed, Packs, look};
use crate::methods::Clock;
use crate::methods::sigma_family::Sigma;
use crate::methods::sigma_family::memory::{Ahead, SigmaMemory};
use crate::methods::sigma_family::monitor::Monitor;
use crate::methods::together::{Companion, all_finite, load, load_if_all_have, of_lanes};
use crate::methods::walk::BLOCK;
use crate::scalar::Lanes;
use crate::scalar::lanes::read_lane;
use crate::scalar::simd::{Task, widest};
use crate::system::Packable;
use crate::{DegenerateLagrangian, System};

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
    let Packs { q, ahead, other: before, kept, gradient, reciprocals, factors, one, increment, .. } = packs;
    let is_reversal = |run: &Companion<'_, S, Sigma>| matches!(run.memory.ahead, Some(Ahead::Reversal));
    let of_run = |run: usize| match &runs[run].memory.ahead {
        Some(Ahead::Diagonal(factors)) => Some(&**factors),
        Some(Ahead::Reversal | Ahead::General(_)) | None => None,
    };
    let factors = if runs.iter().all(is_reversal) {
        None
    } else if load_if_all_have(factors, of_run, runs.len()) {
        Some(&*factors)
    } else {
        return 0;
    };
    load(q, |run| &*runs[run].q, runs.len());
    load(ahead, |run| &*runs[run].memory.work.ahead, runs.len());
    let taken = S::packed(&of_lanes(systems), |system| {
        let mut taken = 0;
        while taken < count {
            let steps = look(runs, q, one, BLOCK.min(count - taken), Monitor::look_before_leaps);
            if steps == 0 {
                break;
            }
            for (kept, now) in kept.iter_mut().zip([&*q, &*ahead, &*before]) {
                kept.copy_from_slice(now);
            }
            let clock = clock.after(taken);
            widest(Leaps { system, reciprocals, factors, clock, steps, q, ahead, before, gradient });
            if !(all_finite(q) && all_finite(before)) {
                for (now, kept) in [&mut *q, ahead, before].into_iter().zip(kept.iter()) {
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
        let SigmaMemory { defect, product, work, .. } = &mut *run.memory;
        read_lane(lane, q, run.q);
        read_lane(lane, ahead, &mut work.ahead);
        read_lane(lane, before, one);
        for ((delta, &now), &before) in increment.iter_mut().zip(run.q.iter()).zip(one.iter()) {
            *delta = now - before;
        }
        if let Some(product) = product {
            product.apply(system, increment, defect);
        }
        run.statistics.gradients += taken;
        run.statistics.steps += taken;
    }
    taken
}

/// Some steps with σ = 0.
struct Leaps<'a, const W: usize, S: System> {
    system: &'a S,
    // Of the type of a vector, so that where a size is known the loops have no ends of their own.
    reciprocals: &'a Packed<W, S>,
    /// What K⁻¹c1 is of Δ in each coordinate, if that is not −1.
    factors: Option<&'a Packed<W, S>>,
    clock: Clock<f64>,
    steps: u64,
    q: &'a mut Packed<W, S>,
    ahead: &'a mut Packed<W, S>,
    before: &'a mut Packed<W, S>,
    gradient: &'a mut Packed<W, S>,
}

impl<const W: usize, S: DegenerateLagrangian<Lanes<W>>> Task for Leaps<'_, W, S> {
    type Output = ();

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) {
        let Self { system, reciprocals, factors, clock, steps, q, ahead, before, gradient } = self;
        for step in 0..steps {
            system.hamiltonian_gradient(q, Lanes::all(clock.after(step).time()), gradient);
            let points = q.iter_mut().zip(ahead.iter_mut()).zip(before.iter_mut());
            for (j, (((q, ahead), before), &reciprocal)) in points.zip(reciprocals.iter()).enumerate() {
                let now = *q;
                *q = *ahead + gradient[system.conjugate(j)] * reciprocal;
                *ahead = now;
                *before = now;
            }
            let Some(factors) = factors else { continue };
            for (((ahead, &before), &q), &factor) in
                ahead.iter_mut().zip(before.iter()).zip(q.iter()).zip(factors.iter())
            {
                *ahead = q + factor * (q - before);
            }
        }
    }
}
