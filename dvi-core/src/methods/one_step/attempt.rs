//! A step from a guess: where its equations are posed, and where it ends.

use super::Point;
use super::equations::Step;
use super::split::{Split, is_x};
use super::stage::Stage;
use crate::error::StepFailure;
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

    /// Sets `next` to q1, `stage.momentum` to p1, and `stage.rates` to the rates of change, if q1 is on the
    /// branch of ϑ(x, y) = p that q0 is on.
    #[inline]
    pub(super) fn attempt<J: Judge<T>>(
        &mut self,
        step: &Step<'_, S, T>,
        point: &mut Point<S, T>,
        (guess, stopping): (Guess, Stopping),
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Step { system, q, t, h, .. } = *step;
        begin(point, step, guess, [&mut self.stage.unknown, &mut self.turn]);
        self.stage.momentum.copy_from_slice(&point.p);
        self.stage.solve::<J>(step, stopping, statistics)?;
        let node = self.stage.kick::<J>(step, statistics);
        if let Err(failure) = self.end::<J>(step, stopping, statistics) {
            // Where Ω is singular there may be no end.
            point.orientation.compare(system, &self.stage.point, node)?;
            return Err(failure);
        }
        let Self { stage, next, .. } = self;
        norm::finite(next)?;
        // Between two branches Ω changes its sign.
        let middle = &mut stage.gradient;
        norm::mean(q, next, middle);
        let within: [(&[T], T); 2] = [(middle, t + T::lift(0.5) * h), (&stage.point, node)];
        point.orientation.pass(system, &within, (next, t + h))
    }

    /// Sets `next` to the end of the step, and the momentum and the rates.
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

/// Sets `unknown` to the guess: of what is solved for of Δ along x, and of ȳ along y.
#[cfg_attr(not(debug_assertions), inline(always))]
fn begin<S: ProperlyDegenerate<T>, T: Real>(
    point: &Point<S, T>,
    step: &Step<'_, S, T>,
    guess: Guess,
    [unknown, turn]: [&mut Vector<S, T>; 2],
) {
    let Step { system, q, h, .. } = *step;
    let (part, half) = (step.part(), T::lift(0.5));
    point.rates.guess(h, guess, [unknown, turn]);
    for (i, unknown) in unknown.iter_mut().enumerate() {
        *unknown = if is_x(system, i) { part * h * *unknown } else { q[i] + half * h * *unknown };
    }
}
