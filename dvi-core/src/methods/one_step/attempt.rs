//! A step from a guess: Newton's method for its equations, the kick of the momentum, and where it ends.

use super::Point;
use super::equations::{Equations, Rule, Step};
use super::split::{Split, is_x};
use crate::error::StepFailure;
use crate::mechanics::pattern::of_second_derivatives;
use crate::scalar::norm;
use crate::solve::{Course, Guess, Judge, Stopping, solve_by_newton};
use crate::space::Storing;
use crate::state::Statistics;
use crate::{Linear, ProperlyDegenerate, Real, Space, System, Vector};

/// What is written before it is read.
#[derive(Debug)]
pub(super) struct Work<S: System, T: Real> {
    /// Δ along x, or that part of it that leads to the only node; ȳ along y.
    unknown: Vector<S, T>,
    /// p0, and after the step p1; zero along y.
    momentum: Vector<S, T>,
    /// The rates of change of a completed step.
    rates: Vector<S, T>,
    /// f and α at a node.
    gradient: Vector<S, T>,
    one_form: Vector<S, T>,
    /// The last node.
    point: Vector<S, T>,
    velocity: Vector<S, T>,
    solver: Linear<S, T>,
    correction: Vector<S, T>,
    /// In which the iteration judges unknowns.
    weights: Vector<S, T>,
    split: Split<S, T>,
    /// The end of the step.
    next: Vector<S, T>,
    /// By how much the mean rate of y changes where it stands in the equations.
    turn: Vector<S, T>,
}

impl<S: ProperlyDegenerate<T>, T: Real> Work<S, T> {
    #[inline]
    pub(super) fn new(system: &S, q: &Vector<S, T>, t: T) -> Self {
        let [unknown, momentum, rates, gradient, one_form, point, velocity, correction, weights, next, turn] =
            system.space().vectors();
        let solver = of_second_derivatives(system, q, &velocity, t, Storing::Always);
        let split = Split::new(system);
        Self {
            unknown,
            momentum,
            rates,
            gradient,
            one_form,
            point,
            velocity,
            solver,
            correction,
            weights,
            split,
            next,
            turn,
        }
    }

    /// Sets `next` to q1, `momentum` to p1, and `rates` to the rates of change, if q1 is on the
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
        // Of what is solved for of Δ along x, and of ȳ along y.
        let (part, half) = (step.part(), T::lift(0.5));
        point.rates.guess(h, guess, [&mut self.unknown, &mut self.turn]);
        for (i, unknown) in self.unknown.iter_mut().enumerate() {
            *unknown = if is_x(system, i) { part * h * *unknown } else { q[i] + half * h * *unknown };
        }
        self.momentum.copy_from_slice(&point.p);
        self.solve::<J>(step, stopping, statistics)?;
        let node = self.kick::<J>(step, statistics);
        if let Err(failure) = self.end::<J>(step, stopping, statistics) {
            // Where Ω is singular there may be no end.
            point.orientation.compare(system, &self.point, node)?;
            return Err(failure);
        }
        let Self { next, gradient: middle, point: last, .. } = self;
        norm::finite(next)?;
        // Between two branches Ω changes its sign.
        norm::mean(q, next, middle);
        let within: [(&[T], T); 2] = [(middle, t + half * h), (last, node)];
        point.orientation.pass(system, &within, (next, t + h))
    }

    /// Improves the guess `unknown` until the equations hold for `momentum`.
    ///
    /// # Errors
    /// [`StepFailure::NotConverged`], [`StepFailure::Singular`], [`StepFailure::NotFinite`].
    #[inline]
    fn solve<J: Judge<T>>(
        &mut self,
        step: &Step<'_, S, T>,
        stopping: Stopping,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Self { unknown, momentum, gradient, one_form, point, velocity, solver, .. } = self;
        let (correction, weights) = (&mut self.correction, &mut self.weights);
        let mut equations = Equations { step, work: [point, velocity, gradient, one_form] };
        let (points, storage): ([&[T]; 2], _) = ([step.q, momentum], (solver, [correction, weights]));
        let judge = J::of(Course::new(stopping, stopping.max_iterations));
        solve_by_newton(&mut equations, step.system, points, unknown, storage, judge, statistics)
    }

    /// Adds h Σⱼ wⱼ f_xⱼ to `momentum`, and returns the time of `point`.
    #[inline]
    fn kick<J: Judge<T>>(&mut self, step: &Step<'_, S, T>, statistics: &mut Statistics) -> T {
        if step.rule == Rule::Midpoint {
            return self.kick_at_centre::<J>(step);
        }
        let Self { unknown, momentum, gradient, one_form, point, velocity, .. } = self;
        let (mut time, weight) = (step.t, step.h * T::lift(0.5));
        for c in [0.0, 1.0] {
            time = step.place(unknown, T::lift(c), point, velocity);
            step.system.gradient(point, velocity, time, gradient, one_form);
            statistics.gradients += 1;
            for i in (0..momentum.len()).filter(|&i| is_x(step.system, i)) {
                momentum[i] += weight * gradient[i];
            }
        }
        time
    }

    /// The same at the centre, from Newton's last iterate and its correction d, up to terms of the order d²,
    /// as of the unknowns themselves: along x his equations are (Dα − ½h Df)d = r = ϑ − ½h f − p, and so the
    /// half of the kick is ½h f + r − Dα d. Without a correction, as the residual was asked for, r is
    /// nothing but rounding; a quick look does not ask for it.
    #[inline]
    fn kick_at_centre<J: Judge<T>>(&mut self, step: &Step<'_, S, T>) -> T {
        let Self { momentum, gradient, one_form, point, velocity, correction: d, .. } = self;
        let Step { system, t, h, .. } = *step;
        let (half, centre) = (T::lift(0.5) * h, t + T::lift(0.5) * h);
        let is_moved = !J::NAMES || d.iter().any(|&d| d != T::lift(0.0));
        // r − Dα d, which is small: what p has rounded off does not come back.
        let rest = velocity;
        for i in 0..rest.len() {
            let r = one_form[i] - momentum[i] - half * gradient[i];
            rest[i] = if is_moved { r } else { T::lift(0.0) };
        }
        let mut product = |i: usize, j: usize, entry: T| rest[i] += entry * d[j];
        system.one_form_jacobian(point, centre, T::lift(-1.0), T::lift(0.0), &mut product);
        for i in (0..momentum.len()).filter(|&i| is_x(system, i)) {
            momentum[i] += T::lift(2.0) * (half * gradient[i] + rest[i]);
        }
        centre
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
        let Self { unknown: unknowns, momentum, rates, split, next, turn, .. } = self;
        for i in 0..q.len() {
            let unknown = unknowns[i];
            rates[i] = if is_x(system, i) { unknown / step.part() } else { (unknown - q[i]) / half } / h;
        }
        // From ȳ on, as far again, and what the last steps have added; from there, if that is too far.
        let mut again = T::lift(1.0);
        loop {
            for i in 0..q.len() {
                let unknown = unknowns[i];
                next[i] = if is_x(system, i) {
                    q[i] + unknown / step.part()
                } else {
                    unknown + again * ((unknown - q[i]) + half * h * turn[i])
                };
            }
            match split.solve_y::<J>(system, next, t + h, momentum, stopping, statistics) {
                Err(_) if again > T::lift(0.0) => again = T::lift(0.0),
                Err(failure) => return Err(failure),
                Ok(()) => break,
            }
        }
        for i in 0..q.len() {
            let rate = rates[i];
            turn[i] = if is_x(system, i) { T::lift(0.0) } else { (next[i] - unknowns[i]) / half / h - rate };
        }
        Ok(())
    }

    /// Moves `q` and `point` to the end of the step.
    #[inline]
    pub(super) fn leave(&self, q: &mut Vector<S, T>, point: &mut Point<S, T>, h: T) {
        point.arrive(q, (&self.next, &self.momentum), h, [&self.rates, &self.turn]);
    }
}
