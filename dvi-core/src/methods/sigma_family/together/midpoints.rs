//! The fixed point of σ = ½ in lanes.

use super::{Packed, Packs, look};
use crate::methods::Clock;
use crate::methods::sigma_family::Sigma;
use crate::methods::together::{Companion, all_finite, load, of_lanes};
use crate::scalar::lanes::read_lane;
use crate::scalar::passes::lanes_stay_together;
use crate::scalar::simd::wide_if;
use crate::scalar::{Comparison, Lanes, smallest_normal};
use crate::solve::{Convergences, Stopping, Verdict, sizes};
use crate::state::history::{DEPTH, extrapolate};
use crate::system::Packable;
use crate::{DegenerateLagrangian, Scalar, System};

/// Up to `count` steps; returns how many.
pub(super) fn midpoints<const W: usize, S>(
    method: &Sigma,
    systems: &[&S],
    packs: &mut Packs<W, S>,
    runs: &mut [Companion<'_, S, Sigma>],
    clock: Clock<f64>,
    count: u64,
) -> u64
where
    S: DegenerateLagrangian + Packable<W, Packed: DegenerateLagrangian<Lanes<W>>>,
{
    let Packs { q, other: increment, kept, gradient, point, history, reciprocals, one, .. } = packs;
    let Some(first) = runs.first().map(|run| &*run.memory) else { return 0 };
    let Some(mut place) = first.carried.history.place_if_full() else { return 0 };
    let budget = method.budget(&first.ladder, one.len());
    let are_alike = runs.iter().map(|run| &*run.memory).all(|run| {
        run.carried.history.place_if_full() == Some(place)
            && run.carried.defect_vanishes
            && run.ladder.tries_fixed_point()
    });
    if !are_alike {
        return 0;
    }
    load(q, |run| &*runs[run].q, runs.len());
    for (entry, packs) in history.iter_mut().enumerate() {
        load(packs, |run| &*runs[run].memory.carried.history.ring[entry], runs.len());
    }
    let taken = S::packed(&of_lanes(systems), |system| {
        let mut taken = 0;
        while taken < count {
            let steps = look(runs, q, one, count - taken);
            let [corrected, weights] = &mut *kept;
            let midpoints = Midpoints {
                system,
                stopping: method.stopping,
                budget,
                reciprocals,
                clock,
                q,
                increment,
                corrected,
                point,
                gradient,
                weights,
                history,
                place: &mut place,
            };
            let (mut done, mut iterations) = (0, [0; W]);
            wide_if!(true, {
                let mut midpoints = midpoints;
                while done < steps && midpoints.step(taken + done, &mut iterations) {
                    done += 1;
                }
            });
            taken += done;
            for (run, iterations) in runs.iter_mut().zip(iterations) {
                run.memory.monitor.steps += done;
                run.statistics.iterations += iterations;
                run.statistics.gradients += iterations;
            }
            if done < steps || steps == 0 {
                break;
            }
        }
        taken
    });
    for (lane, run) in runs.iter_mut().enumerate() {
        read_lane(lane, q, run.q);
        for (entry, packs) in history.iter().enumerate() {
            read_lane(lane, packs, &mut run.memory.carried.history.ring[entry]);
        }
        run.memory.carried.history.next = place;
        run.statistics.steps += taken;
    }
    taken
}

/// Steps with σ = ½: s ← −½h K⁻¹∇H(q0 + ½s), q1 = q0 + s.
struct Midpoints<'a, const W: usize, S: System> {
    system: &'a S,
    stopping: Stopping,
    budget: usize,
    reciprocals: &'a Packed<W, S>,
    clock: Clock<f64>,
    q: &'a mut Packed<W, S>,
    increment: &'a mut Packed<W, S>,
    /// The increment that is to take its place.
    corrected: &'a mut Packed<W, S>,
    point: &'a mut Packed<W, S>,
    gradient: &'a mut Packed<W, S>,
    /// In which the iteration judges coordinates.
    weights: &'a mut Packed<W, S>,
    history: &'a mut [Packed<W, S>; DEPTH],
    /// Where the next increment goes in the history.
    place: &'a mut usize,
}

impl<const W: usize, S: DegenerateLagrangian<Lanes<W>>> Midpoints<'_, W, S> {
    /// Takes a step and counts the iterations of each run. Returns whether there is one that all runs agree
    /// on; nothing has moved else.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn step(&mut self, number: u64, iterations: &mut [u64; W]) -> bool {
        extrapolate(self.history, *self.place, self.increment);
        let mut convergence = Convergences::fixed_point(self.stopping, self.budget);
        let time = self.clock.after(number);
        let time = Lanes::all(time.time() + 0.5 * time.step_size());
        loop {
            if convergence.takes_sizes() {
                // As `Due` does.
                for block in sizes::blocks(self.system) {
                    let of = |k: usize| Scalar::abs(self.q[k]) + Scalar::abs(self.increment[k]);
                    let size = block.clone().map(of).fold(Lanes::all(0.0), Lanes::larger);
                    let weight = Lanes::all(1.0) / (size + Lanes::all(smallest_normal::<f64>()));
                    self.weights[block].fill(weight);
                }
            }
            let correction = self.iterate(time, convergence.active());
            match convergence.judge(correction) {
                Verdict::Continue => {}
                Verdict::Accept => break,
                Verdict::GiveUp => return false,
            }
        }
        for ((next, &q), &s) in self.point.iter_mut().zip(self.q.iter()).zip(self.increment.iter()) {
            lanes_stay_together::<Lanes<W>>();
            *next = q + s;
        }
        if !(all_finite(self.increment) && all_finite(self.point)) {
            return false;
        }
        self.q.copy_from_slice(self.point);
        self.history[*self.place].copy_from_slice(self.increment);
        *self.place = (*self.place + 1) % DEPTH;
        for (sum, of_step) in iterations.iter_mut().zip(convergence.iterations()) {
            *sum += of_step;
        }
        true
    }

    /// Applies a correction in the lanes that are `active`, and returns its size.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn iterate(&mut self, time: Lanes<W>, active: Lanes<W>) -> Lanes<W> {
        let half = Lanes::all(0.5);
        for ((point, &q), &s) in self.point.iter_mut().zip(self.q.iter()).zip(self.increment.iter()) {
            lanes_stay_together::<Lanes<W>>();
            *point = q + half * s;
        }
        self.system.hamiltonian_gradient(self.point, time, self.gradient);
        let mut correction = Lanes::all(0.0);
        let increments = self.increment.iter().zip(self.corrected.iter_mut());
        for ((j, &reciprocal), (&s, corrected)) in self.reciprocals.iter().enumerate().zip(increments) {
            lanes_stay_together::<Lanes<W>>();
            let trial = self.gradient[self.system.conjugate(j)] * reciprocal;
            correction = correction.larger(Scalar::abs(trial - s) * self.weights[j]);
            *corrected = Lanes::choose(active, Comparison::Greater, Lanes::all(0.0), trial, s);
        }
        // In another place, as what is stored with a mask is slow to load.
        core::mem::swap(&mut self.increment, &mut self.corrected);
        correction
    }
}
