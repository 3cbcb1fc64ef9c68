//! The explicit steps of σ = 0 in lanes.

use super::{Packed, Packs, look};
use crate::methods::Clock;
use crate::methods::sigma_family::Sigma;
use crate::methods::sigma_family::memory::{Ahead, TwoStep};
use crate::methods::sigma_family::monitor::Monitor;
use crate::methods::together::{Companion, all_finite, load};
use crate::methods::walk::BLOCK;
use crate::scalar::Lanes;
use crate::scalar::lanes::read_lane;
use crate::scalar::simd::{Task, widest};
use crate::{DegenerateLagrangian, System};

/// Up to `count` steps; returns how many.
pub(super) fn leaps<const W: usize, S: DegenerateLagrangian + DegenerateLagrangian<Lanes<W>>>(
    system: &S,
    packs: &mut Packs<W, S>,
    runs: &mut [Companion<'_, S, Sigma>],
    clock: Clock<f64>,
    count: u64,
) -> u64 {
    let Packs { q, ahead, other: before, kept, gradient, reciprocals, factors, one, increment, .. } = packs;
    let factors = match runs.first().and_then(|run| run.memory.run.ahead.as_ref()) {
        Some(Ahead::Reversal) => None,
        Some(Ahead::Diagonal(of_all)) => {
            factors.copy_from_slice(of_all);
            Some(&**factors)
        }
        Some(Ahead::General(_)) | None => return 0,
    };
    load(q, |run| &*runs[run].q, runs.len());
    load(ahead, |run| &*runs[run].memory.run.work.ahead, runs.len());
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
            run.memory.run.monitor.steps += steps;
        }
    }
    if taken == 0 {
        return 0;
    }
    for (lane, run) in runs.iter_mut().enumerate() {
        let TwoStep { defect, product, work, .. } = &mut run.memory.run;
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
    reciprocals: &'a [f64],
    /// What K⁻¹c1 is of Δ in each coordinate, if that is not −1.
    factors: Option<&'a [f64]>,
    clock: Clock<f64>,
    steps: u64,
    q: &'a mut Packed<W, S>,
    ahead: &'a mut Packed<W, S>,
    before: &'a mut Packed<W, S>,
    gradient: &'a mut Packed<W, S>,
}

impl<const W: usize, S: DegenerateLagrangian<Lanes<W>>> Task for Leaps<'_, W, S> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { system, reciprocals, factors, clock, steps, q, ahead, before, gradient } = self;
        for step in 0..steps {
            system.hamiltonian_gradient(q, Lanes::all(clock.after(step).time()), gradient);
            let points = q.iter_mut().zip(ahead.iter_mut()).zip(before.iter_mut());
            for (j, (((q, ahead), before), &reciprocal)) in points.zip(reciprocals).enumerate() {
                *before = *q;
                *q = *ahead + gradient[system.conjugate(j)] * Lanes::all(reciprocal);
                *ahead = *before;
            }
            for (((ahead, &before), &q), &factor) in
                ahead.iter_mut().zip(before.iter()).zip(q.iter()).zip(factors.unwrap_or_default())
            {
                *ahead = q + Lanes::all(factor) * (q - before);
            }
        }
    }
}
