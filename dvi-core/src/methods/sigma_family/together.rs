//! Steps of several runs in lanes, for affine α that couples the coordinates in pairs: σ = 0 as in [`leapfrog`](super::leapfrog), and
//! the fixed point of σ = ½ as in [`affine`](super::affine).

use super::Sigma;
use super::memory::{Ahead, TwoStep};
use super::monitor::Monitor;
use crate::error::StepFailure;
use crate::methods::Clock;
use crate::methods::together::{Companion, InStep, all_finite, load};
use crate::methods::walk::BLOCK;
use crate::scalar::lanes::read_lane;
use crate::scalar::simd::{Task, widest};
use crate::scalar::{Comparison, Lanes};
use crate::solve::{Convergence, Stopping, Verdict};
use crate::state::history::{DEPTH, extrapolate};
use crate::state::summation::Summation;
use crate::{DegenerateLagrangian, Scalar, Space, System, Vector};

type Packed<const W: usize, S> = Vector<S, Lanes<W>>;

/// The points of the runs, and what their steps work on.
#[derive(Debug)]
pub struct Packs<const W: usize, S: System> {
    q: Packed<W, S>,
    /// q0 + K⁻¹c0 if σ = 0; q0 + ½K⁻¹c0 if σ = ½.
    ahead: Packed<W, S>,
    /// The point before, if σ = 0; the increment s if σ = ½.
    other: Packed<W, S>,
    kept: [Packed<W, S>; 3],
    gradient: Packed<W, S>,
    point: Packed<W, S>,
    /// K⁻¹c0, if σ = ½.
    shift: Packed<W, S>,
    history: [Packed<W, S>; DEPTH],
    /// Of all runs.
    reciprocals: Vector<S, f64>,
    factors: Vector<S, f64>,
    /// Of one run.
    one: Vector<S, f64>,
    increment: Vector<S, f64>,
}

impl<const W: usize, S> InStep<W, S> for Sigma
where
    S: DegenerateLagrangian + DegenerateLagrangian<Lanes<W>>,
{
    type Packs = Packs<W, S>;

    fn packs(&self, system: &S) -> Packs<W, S> {
        let space = system.space();
        Packs {
            q: space.vector(),
            ahead: space.vector(),
            other: space.vector(),
            kept: core::array::from_fn(|_| space.vector()),
            gradient: space.vector(),
            point: space.vector(),
            shift: space.vector(),
            history: core::array::from_fn(|_| space.vector()),
            reciprocals: space.vector(),
            factors: space.vector(),
            one: space.vector(),
            increment: space.vector(),
        }
    }

    fn steps_together(
        &self,
        system: &S,
        packs: &mut Packs<W, S>,
        runs: &mut [Companion<'_, S, Self>],
        clock: Clock<f64>,
        count: u64,
    ) -> u64 {
        let is_affine = <S as DegenerateLagrangian<f64>>::AFFINE;
        let are_free = runs.iter().all(|run| run.memory.renewal.is_none());
        if !(is_affine && are_free && self.summation == Summation::Plain) {
            return 0;
        }
        let Some(reciprocals) = runs.first().and_then(|run| run.memory.run.inverse.reciprocals()) else {
            return 0;
        };
        packs.reciprocals.copy_from_slice(reciprocals);
        if self.sigma == 0.0 {
            leaps(system, packs, runs, clock, count)
        } else if self.is_midpoint() {
            midpoints(self, system, packs, runs, clock, count)
        } else {
            0
        }
    }
}

/// Looks at the points `q` of the runs, and returns the number of steps that may follow, at most `most`, before that is to be done
/// again; none if a run is to go on alone. `of_run` says as much of one run.
fn look<const W: usize, S: DegenerateLagrangian>(
    runs: &mut [Companion<'_, S, Sigma>],
    q: &[Lanes<W>],
    one: &mut Vector<S, f64>,
    most: u64,
    of_run: impl Fn(&mut Monitor<S, f64>, &[f64]) -> Result<u64, StepFailure>,
) -> u64 {
    let mut steps = most;
    for (lane, run) in runs.iter_mut().enumerate() {
        read_lane(lane, q, one);
        match of_run(&mut run.memory.run.monitor, one) {
            Ok(unseen) => steps = steps.min(unseen),
            Err(_) => return 0,
        }
    }
    steps
}

/// σ = 0.
fn leaps<const W: usize, S: DegenerateLagrangian + DegenerateLagrangian<Lanes<W>>>(
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

/// σ = ½.
fn midpoints<const W: usize, S: DegenerateLagrangian + DegenerateLagrangian<Lanes<W>>>(
    method: &Sigma,
    system: &S,
    packs: &mut Packs<W, S>,
    runs: &mut [Companion<'_, S, Sigma>],
    clock: Clock<f64>,
    count: u64,
) -> u64 {
    let Packs { q, ahead, other, gradient, point, shift, history, reciprocals, one, .. } = packs;
    let Some(first) = runs.first().map(|run| &run.memory.run) else { return 0 };
    let (Some(mut place), vanishes) = (first.history.place_if_full(), first.defect_vanishes) else {
        return 0;
    };
    let budget = first.ladder.budget(method.stopping.max_iterations, 12 + one.len());
    let are_alike = runs.iter().map(|run| &run.memory.run).all(|run| {
        run.history.place_if_full() == Some(place)
            && run.defect_vanishes == vanishes
            && run.ladder.tries_fixed_point()
    });
    if !are_alike {
        return 0;
    }
    load(q, |run| &*runs[run].q, runs.len());
    for (entry, packs) in history.iter_mut().enumerate() {
        load(packs, |run| &*runs[run].memory.run.history.ring()[entry], runs.len());
    }
    for run in runs.iter_mut().filter(|_| !vanishes) {
        run.memory.run.shift_by_defect(system);
    }
    load(shift, |run| &*runs[run].memory.run.work.shift, runs.len());
    let mut taken = 0;
    while taken < count {
        let steps = look(runs, q, one, count - taken, |monitor, q| {
            monitor.look(q)?;
            Ok(monitor.steps_unseen().max(1))
        });
        let (done, iterations) = widest(Midpoints {
            system,
            stopping: method.stopping,
            budget,
            reciprocals,
            clock: clock.after(taken),
            steps,
            has_shift: !vanishes,
            q,
            origin: ahead,
            increment: other,
            point,
            gradient,
            shift,
            history,
            place: &mut place,
        });
        taken += done;
        for (run, iterations) in runs.iter_mut().zip(iterations) {
            run.memory.run.monitor.steps += done;
            run.statistics.iterations += iterations;
            run.statistics.gradients += iterations;
        }
        if done < steps || steps == 0 {
            break;
        }
    }
    for (lane, run) in runs.iter_mut().enumerate() {
        read_lane(lane, q, run.q);
        for (entry, packs) in history.iter().enumerate() {
            read_lane(lane, packs, &mut run.memory.run.history.ring_mut()[entry]);
        }
        run.memory.run.history.set_place(place);
        if taken % 2 == 1 {
            run.memory.run.defect.iter_mut().for_each(|c| *c = 0.0 - *c);
        }
        run.statistics.steps += taken;
    }
    taken
}

/// Some steps with σ = ½: s ← −½h K⁻¹∇H(q0 + ½K⁻¹c0 + ½s), q1 = q0 + K⁻¹c0 + s.
struct Midpoints<'a, const W: usize, S: System> {
    system: &'a S,
    stopping: Stopping,
    budget: usize,
    reciprocals: &'a [f64],
    clock: Clock<f64>,
    steps: u64,
    has_shift: bool,
    q: &'a mut Packed<W, S>,
    origin: &'a mut Packed<W, S>,
    increment: &'a mut Packed<W, S>,
    point: &'a mut Packed<W, S>,
    gradient: &'a mut Packed<W, S>,
    shift: &'a mut Packed<W, S>,
    history: &'a mut [Packed<W, S>; DEPTH],
    /// Where the next increment goes in the history.
    place: &'a mut usize,
}

impl<const W: usize, S: DegenerateLagrangian<Lanes<W>>> Task for Midpoints<'_, W, S> {
    /// How many steps all runs have taken, and the iterations of each in these.
    type Output = (u64, [u64; W]);

    #[inline(always)]
    fn run(mut self) -> (u64, [u64; W]) {
        let mut iterations = [0; W];
        for step in 0..self.steps {
            let Some(of_step) = self.step(step) else { return (step, iterations) };
            for (sum, of_step) in iterations.iter_mut().zip(of_step) {
                *sum += of_step;
            }
        }
        (self.steps, iterations)
    }
}

impl<const W: usize, S: DegenerateLagrangian<Lanes<W>>> Midpoints<'_, W, S> {
    /// Takes a step and returns the iterations; nothing has moved if there is none that all runs agree on.
    #[inline(always)]
    fn step(&mut self, number: u64) -> Option<[u64; W]> {
        let half = Lanes::all(0.5);
        extrapolate(self.history, *self.place, self.increment);
        let mut scale = largest(self.q) + largest(self.increment);
        if self.has_shift {
            scale += largest(self.shift);
            for ((origin, &q), &shift) in self.origin.iter_mut().zip(self.q.iter()).zip(self.shift.iter()) {
                *origin = q + half * shift;
            }
        } else {
            self.origin.copy_from_slice(self.q);
        }
        let smallest = smallest(self.q, scale);
        let mut convergence: [Convergence<f64>; W] = core::array::from_fn(|lane| {
            Convergence::of_fixed_point(self.stopping, scale.0[lane], smallest.0[lane], self.budget)
        });
        let time = self.clock.after(number);
        let time = Lanes::all(time.time() + 0.5 * time.step_size());
        let mut active = [true; W];
        while active != [false; W] {
            let correction = self.iterate(time, &active);
            for lane in 0..W {
                if active[lane] {
                    match convergence[lane].judge(correction.0[lane]) {
                        Verdict::Continue => {}
                        Verdict::Accept => active[lane] = false,
                        Verdict::GiveUp => return None,
                    }
                }
            }
        }
        for ((next, &q), (&shift, &s)) in
            self.point.iter_mut().zip(self.q.iter()).zip(self.shift.iter().zip(self.increment.iter()))
        {
            *next = q + if self.has_shift { shift + s } else { s };
        }
        if !(all_finite(self.increment) && all_finite(self.point)) {
            return None;
        }
        self.q.copy_from_slice(self.point);
        self.shift.iter_mut().for_each(|shift| *shift = -*shift);
        self.history[*self.place].copy_from_slice(self.increment);
        *self.place = (*self.place + 1) % DEPTH;
        Some(convergence.map(|convergence| convergence.iterations as u64))
    }

    /// Applies a correction in the active lanes, and returns its size.
    #[inline(always)]
    fn iterate(&mut self, time: Lanes<W>, active: &[bool; W]) -> Lanes<W> {
        let half = Lanes::all(0.5);
        for ((point, &origin), &s) in self.point.iter_mut().zip(self.origin.iter()).zip(self.increment.iter())
        {
            *point = origin + half * s;
        }
        self.system.hamiltonian_gradient(self.point, time, self.gradient);
        let mut correction = Lanes::all(0.0);
        let all_active = *active == [true; W];
        for ((j, &reciprocal), s) in self.reciprocals.iter().enumerate().zip(self.increment.iter_mut()) {
            let trial = self.gradient[self.system.conjugate(j)] * Lanes::all(reciprocal);
            correction = larger(correction, Scalar::abs(trial - *s));
            // Stores with a mask are slow, and needed in the last iterations only.
            if all_active {
                *s = trial;
            } else {
                for lane in 0..W {
                    s.0[lane] = if active[lane] { trial.0[lane] } else { s.0[lane] };
                }
            }
        }
        correction
    }
}

/// As [`norm::larger`](crate::scalar::norm::larger).
#[inline(always)]
fn larger<const W: usize>(a: Lanes<W>, b: Lanes<W>) -> Lanes<W> {
    Lanes::choose(b, Comparison::Greater, a, b, a)
}

/// As [`norm::largest`](crate::scalar::norm::largest).
#[inline(always)]
fn largest<const W: usize>(x: &[Lanes<W>]) -> Lanes<W> {
    let mut largest = Lanes::all(0.0);
    for &x in x {
        largest = larger(largest, Scalar::abs(x));
    }
    largest
}

/// As [`norm::smallest`](crate::scalar::norm::smallest).
#[inline(always)]
fn smallest<const W: usize>(x: &[Lanes<W>], bound: Lanes<W>) -> Lanes<W> {
    let mut smallest = bound;
    for &x in x {
        let x = Scalar::abs(x);
        let if_positive = Lanes::choose(x, Comparison::Greater, Lanes::all(0.0), x, smallest);
        smallest = Lanes::choose(x, Comparison::Less, smallest, if_positive, smallest);
    }
    smallest
}
