//! Solves the equations of a step by Newton's method, and kicks the momentum.

use super::equations::{Equations, Rule, Step};
use super::split::is_x;
use crate::error::StepFailure;
use crate::mechanics::pattern::of_second_derivatives;
use crate::solve::{Course, Judge, Stopping, solve_by_newton};
use crate::space::Storing;
use crate::state::Statistics;
use crate::{Linear, ProperlyDegenerate, Real, Space, System, Vector};

/// The unknowns, with the storage that solving for them needs.
#[derive(Debug)]
pub(super) struct Stage<S: System, T: Real> {
    /// Δ along x, or that part of it that leads to the only node; ȳ along y.
    pub(super) unknown: Vector<S, T>,
    /// p0, and after the step p1; zero along y.
    pub(super) momentum: Vector<S, T>,
    /// The rates of change of a completed step.
    pub(super) rates: Vector<S, T>,
    /// f and α at a node.
    pub(super) gradient: Vector<S, T>,
    one_form: Vector<S, T>,
    /// The last node.
    pub(super) point: Vector<S, T>,
    velocity: Vector<S, T>,
    solver: Linear<S, T>,
    correction: Vector<S, T>,
    /// In which the iteration judges unknowns.
    weights: Vector<S, T>,
}

impl<S: ProperlyDegenerate<T>, T: Real> Stage<S, T> {
    #[inline]
    pub(super) fn new(system: &S, q: &Vector<S, T>, t: T) -> Self {
        let [unknown, momentum, rates, gradient, one_form, point, velocity, correction, weights] =
            system.space().vectors();
        let solver = of_second_derivatives(system, q, &velocity, t, Storing::Always);
        Self { unknown, momentum, rates, gradient, one_form, point, velocity, solver, correction, weights }
    }

    /// Improves the guess `unknown` until the equations hold for `momentum`.
    ///
    /// # Errors
    /// [`StepFailure::NotConverged`], [`StepFailure::Singular`], [`StepFailure::NotFinite`].
    #[inline]
    pub(super) fn solve<J: Judge<T>>(
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
    pub(super) fn kick<J: Judge<T>>(&mut self, step: &Step<'_, S, T>, statistics: &mut Statistics) -> T {
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
}
