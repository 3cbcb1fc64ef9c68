//! A step from a guess: where its equations are posed, and where it ends.

use super::equations::{Rule, Step};
use super::split::{Split, is_x};
use super::stage::Stage;
use super::{OneStep, Point};
use crate::error::StepFailure;
use crate::methods::Scheme;
use crate::scalar::norm;
use crate::solve::{Guess, Judge, Stopping};
use crate::state::Statistics;
use crate::{ProperlyDegenerate, Real, Space, System, Vector};

/// What is written before it is read.
#[derive(Debug)]
pub(super) struct Work<S: System, T: Real> {
    stage: Stage<S, T>,
    split: Split<S, T>,
    /// The end of the step.
    next: Vector<S, T>,
    /// By how much the mean rate of y changes where it stands in the equations.
    turn: Vector<S, T>,
}

impl OneStep {
    /// Sets `work.next` to q1, `work.stage.momentum` to p1, and `work.stage.rates` to the rates of change,
    /// if q1 is on the branch of ϑ(x, y) = p that q0 is on.
    #[inline]
    pub(super) fn attempt<J: Judge<T>, S: ProperlyDegenerate<T>, T: Real>(
        &self,
        step: &Step<'_, S, T>,
        point: &mut Point<S, T>,
        work: &mut Work<S, T>,
        guess: Guess,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Step { system, q, t, h, .. } = *step;
        let half = T::lift(0.5);
        let until_y = if self.is_symmetric() { half } else { T::lift(1.0) };
        begin(point, step, guess, [step.part(), until_y], [&mut work.stage.unknown, &mut work.turn]);
        work.stage.momentum.copy_from_slice(&point.p);
        let begin = if self.is_symmetric() { t } else { self.depart(step, point, work, statistics) };
        let from = if self.is_symmetric() { q } else { &work.next };
        work.stage.solve::<J>(&Step { q: from, t: begin, ..*step }, self.stopping, statistics)?;
        let mut node = t + h;
        if self.is_symmetric() {
            node = work.stage.kick::<J>(step, statistics);
            if let Err(failure) = work.end::<J>(step, self.stopping, statistics) {
                // Where Ω is singular there may be no end.
                point.orientation.compare(system, &work.stage.point, node)?;
                return Err(failure);
            }
        } else {
            self.end(step, work);
        }
        let Work { stage, next, .. } = work;
        norm::finite(next)?;
        // Between two branches Ω changes its sign.
        let middle = &mut stage.gradient;
        norm::mean(q, next, middle);
        let within: [(&[T], T); 2] = [(middle, t + half * h), (&stage.point, node)];
        let within = if self.is_symmetric() { &within[..] } else { &within[..1] };
        point.orientation.pass(system, within, (next, t + h))
    }

    /// Sets `work.next` to where A and B begin and `work.stage.momentum` to the momentum there, and returns
    /// its time. The node of A is at the end, that of B at the beginning of the interval that comes next.
    fn depart<S: ProperlyDegenerate<T>, T: Real>(
        &self,
        step: &Step<'_, S, T>,
        point: &Point<S, T>,
        work: &mut Work<S, T>,
        statistics: &mut Statistics,
    ) -> T {
        let Step { system, q, t, h, .. } = *step;
        let Work { stage, next, .. } = work;
        next.copy_from_slice(q);
        // The velocity of x where the last step has ended; that along y is in no formula.
        let [velocity, _] = point.rates.latest();
        if self.rule == Rule::B {
            for i in (0..q.len()).filter(|&i| is_x(system, i)) {
                next[i] += h * velocity[i];
            }
            return t + h;
        }
        system.gradient(q, velocity, t, &mut stage.gradient, &mut stage.one_form);
        statistics.gradients += 1;
        for i in (0..q.len()).filter(|&i| is_x(system, i)) {
            stage.momentum[i] += h * stage.gradient[i];
        }
        t
    }

    /// Sets `work.next` to where A and B end, and the momentum and the rates.
    fn end<S: ProperlyDegenerate<T>, T: Real>(&self, step: &Step<'_, S, T>, work: &mut Work<S, T>) {
        let Step { system, q, t, h, .. } = *step;
        let Work { stage, next, .. } = work;
        for i in 0..q.len() {
            if is_x(system, i) {
                stage.rates[i] = stage.unknown[i] / h;
                if self.rule == Rule::A {
                    next[i] = q[i] + stage.unknown[i];
                }
            } else {
                next[i] = stage.unknown[i];
                stage.rates[i] = (next[i] - q[i]) / h;
            }
        }
        system.one_form(next, t + h, &mut stage.momentum);
    }
}

impl<S: ProperlyDegenerate<T>, T: Real> Work<S, T> {
    #[inline]
    pub(super) fn new(system: &S, q: &Vector<S, T>, t: T) -> Self {
        Self {
            stage: Stage::new(system, q, t),
            split: Split::new(system),
            next: system.space().vector(),
            turn: system.space().vector(),
        }
    }

    /// Sets `next` to the end of a symmetric scheme's step, and the momentum and the rates.
    #[inline]
    fn end<J: Judge<T>>(
        &mut self,
        step: &Step<'_, S, T>,
        stopping: Stopping,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Step { system, q, t, h, .. } = *step;
        let half = T::lift(0.5);
        let stage = &mut self.stage;
        for i in 0..q.len() {
            let unknown = stage.unknown[i];
            stage.rates[i] =
                if is_x(system, i) { unknown / step.part() } else { (unknown - q[i]) / half } / h;
        }
        // From ȳ on, as far again, and what the last steps have added; from there, if that is too far.
        let Self { stage, split, next, turn } = self;
        let mut again = T::lift(1.0);
        loop {
            for i in 0..q.len() {
                let unknown = stage.unknown[i];
                next[i] = if is_x(system, i) {
                    q[i] + unknown / step.part()
                } else {
                    unknown + again * ((unknown - q[i]) + half * h * turn[i])
                };
            }
            match split.solve_y::<J>(system, next, t + h, &stage.momentum, stopping, statistics) {
                Err(_) if again > T::lift(0.0) => again = T::lift(0.0),
                Err(failure) => return Err(failure),
                Ok(()) => break,
            }
        }
        for i in 0..q.len() {
            let rate = stage.rates[i];
            turn[i] =
                if is_x(system, i) { T::lift(0.0) } else { (next[i] - stage.unknown[i]) / half / h - rate };
        }
        Ok(())
    }

    /// Moves `q` and `point` to the end of the step.
    #[inline]
    pub(super) fn leave(&self, q: &mut Vector<S, T>, point: &mut Point<S, T>, h: T) {
        let Self { stage, next, turn, .. } = self;
        point.arrive(q, (next, &stage.momentum), h, [&stage.rates, turn]);
    }
}

/// Sets `unknown` to the guess: a `part` of Δ along x, and along y the place after the part `c` of the step.
#[cfg_attr(not(debug_assertions), inline(always))]
fn begin<S: ProperlyDegenerate<T>, T: Real>(
    point: &Point<S, T>,
    &Step { system, q, h, .. }: &Step<'_, S, T>,
    guess: Guess,
    [part, c]: [T; 2],
    [unknown, turn]: [&mut Vector<S, T>; 2],
) {
    point.rates.guess(h, guess, [unknown, turn]);
    for (i, unknown) in unknown.iter_mut().enumerate() {
        *unknown = if is_x(system, i) { part * h * *unknown } else { q[i] + c * h * *unknown };
    }
}
