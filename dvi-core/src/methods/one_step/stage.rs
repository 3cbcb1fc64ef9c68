//! The equations of a step for Δ = x1 − x0 and ȳ, by Newton's method:
//!
//! r_x = Σⱼ wⱼ(ϑⱼ − h(1 − cⱼ) f_xⱼ) − p      r_y = −½h Σⱼ wⱼ f_yⱼ
//!
//! at the points (x0 + cⱼΔ, ȳ) with the velocity Δ/h along x. With R = 1 − cⱼ in rows of x and ½ in rows of
//! y, and C = cⱼ in columns of Δ and 1 in those of ȳ, the matrix is Σⱼ wⱼ(C L_vq − R L_qv − h R C L_qq). Of
//! the midpoint scheme, solved for (½Δ, ȳ), it is Dα − (Dα)ᵀ − ½h L_qq. Both stand in the code with the sign
//! of p.

use super::split::is_x;
use crate::error::StepFailure;
use crate::mechanics::pattern::of_second_derivatives;
use crate::solve::{Course, Judge, Linearize, Stopping, residual, solve_by_newton};
use crate::space::sink::{Product, Scaled};
use crate::space::{Sink, Storing};
use crate::state::Statistics;
use crate::{Linear, ProperlyDegenerate, Real, Space, System, Vector, Weights};

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Rule {
    A,
    B,
    Midpoint,
    Trapezoid,
}

impl Rule {
    pub(super) fn nodes(self) -> &'static [Node] {
        match self {
            Self::A => &[Node::END],
            Self::B => &[Node::BEGIN],
            Self::Midpoint => &[Node::CENTRE],
            Self::Trapezoid => &Node::ENDS,
        }
    }

    pub(super) fn is_symmetric(self) -> bool {
        matches!(self, Self::Midpoint | Self::Trapezoid)
    }
}

/// A node of a rule.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Node {
    c: f64,
    weight: f64,
}

impl Node {
    const BEGIN: Self = Self { c: 0.0, weight: 1.0 };
    const CENTRE: Self = Self { c: 0.5, weight: 1.0 };
    const END: Self = Self { c: 1.0, weight: 1.0 };
    const ENDS: [Self; 2] = [Self { c: 0.0, weight: 0.5 }, Self { c: 1.0, weight: 0.5 }];
}

/// A step from x in `q` at `t`.
#[derive(Debug)]
pub(super) struct Step<'a, S: System, T: Real> {
    pub(super) system: &'a S,
    pub(super) q: &'a Vector<S, T>,
    pub(super) t: T,
    pub(super) h: T,
    pub(super) nodes: &'a [Node],
}

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
    pub(super) one_form: Vector<S, T>,
    /// The last node.
    pub(super) point: Vector<S, T>,
    velocity: Vector<S, T>,
    solver: Linear<S, T>,
    correction: Vector<S, T>,
    /// In which the iteration judges unknowns.
    weights: Vector<S, T>,
}

impl<S: ProperlyDegenerate<T>, T: Real> Stage<S, T> {
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
    #[cfg_attr(not(debug_assertions), inline(always))]
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
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn kick(&mut self, step: &Step<'_, S, T>, statistics: &mut Statistics) -> T {
        if step.is_centred() {
            return self.kick_at_centre(step);
        }
        let Self { unknown, momentum, gradient, one_form, point, velocity, .. } = self;
        let mut time = step.t;
        for node in step.nodes {
            time = step.place(unknown, node, point, velocity);
            step.system.gradient(point, velocity, time, gradient, one_form);
            statistics.gradients += 1;
            let weight = step.h * T::lift(node.weight);
            for i in (0..momentum.len()).filter(|&i| is_x(step.system, i)) {
                momentum[i] += weight * gradient[i];
            }
        }
        time
    }

    /// The same at the centre, from Newton's last iterate and its correction d, up to terms of the order d²,
    /// as of the unknowns themselves: along x his equations are (Dα − ½h Df)d = r = ϑ − ½h f − p, and so the
    /// half of the kick is ½h f + r − Dα d. Without a correction, r is nothing but rounding.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn kick_at_centre(&mut self, step: &Step<'_, S, T>) -> T {
        let Self { momentum, gradient, one_form, point, velocity, correction: d, .. } = self;
        let Step { system, t, h, .. } = *step;
        let (half, centre) = (T::lift(0.5) * h, t + T::lift(0.5) * h);
        let is_moved = d.iter().any(|&d| d != T::lift(0.0));
        // r − Dα d, which is small: what p has rounded off does not come back.
        let rest = velocity;
        for i in 0..rest.len() {
            let r = one_form[i] - momentum[i] - half * gradient[i];
            rest[i] = if is_moved { r } else { T::lift(0.0) };
        }
        let mut product = Product { x: d, sum: rest };
        system.one_form_jacobian(point, centre, T::lift(-1.0), T::lift(0.0), &mut product);
        for i in (0..momentum.len()).filter(|&i| is_x(system, i)) {
            momentum[i] += T::lift(2.0) * (half * gradient[i] + rest[i]);
        }
        centre
    }
}

impl<S: ProperlyDegenerate<T>, T: Real> Step<'_, S, T> {
    /// The part of Δ that is solved for.
    pub(super) fn part(&self) -> T {
        T::lift(if self.is_centred() { 0.5 } else { 1.0 })
    }

    fn is_centred(&self) -> bool {
        self.nodes == [Node::CENTRE]
    }

    /// Sets `point` and `velocity` to those of `node`, and returns its time.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn place(&self, unknown: &[T], node: &Node, point: &mut [T], velocity: &mut [T]) -> T {
        let c = T::lift(node.c);
        let (by, per_time) = (c / self.part(), T::lift(1.0) / (self.part() * self.h));
        for i in 0..unknown.len() {
            [point[i], velocity[i]] = if is_x(self.system, i) {
                [self.q[i] + by * unknown[i], per_time * unknown[i]]
            } else {
                [unknown[i], T::lift(0.0)]
            };
        }
        self.t + c * self.h
    }
}

struct Equations<'a, S: System, T: Real> {
    step: &'a Step<'a, S, T>,
    /// A point, a velocity, and the first derivatives of L there.
    work: [&'a mut Vector<S, T>; 4],
}

impl<S: ProperlyDegenerate<T>, T: Real> Linearize<T> for Equations<'_, S, T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn linearize<K: Sink<T>>(
        &mut self,
        unknown: &[T],
        r: &mut [T],
        sink: &mut K,
        _statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Self { step, work: [point, velocity, gradient, one_form] } = self;
        let Step { system, h, nodes, .. } = **step;
        let (zero, half, one) = (T::lift(0.0), T::lift(0.5), T::lift(1.0));
        let none = Weights { qq: zero, qv: zero, vq: zero, vv: zero };
        if step.is_centred() {
            let time = step.place(unknown, &Node::CENTRE, point, velocity);
            let weights = Weights { qq: half * h, qv: one, vq: -one, vv: zero };
            system.linearize(point, velocity, time, weights, gradient, one_form, sink);
            for i in 0..r.len() {
                r[i] -= one_form[i] - half * h * gradient[i];
            }
            return Ok(());
        }
        for node in nodes {
            let (weight, c) = (T::lift(node.weight), T::lift(node.c));
            let time = step.place(unknown, node, point, velocity);
            let row = |row: usize| weight * if is_x(system, row) { one - c } else { half };
            let column = |column: usize| if is_x(system, column) { c } else { one };
            let mut add = |w: Weights<T>, factor: &dyn Fn(usize, usize) -> T| {
                let mut scaled = Scaled { sink: &mut *sink, factor };
                system.linearize(point, velocity, time, w, gradient, one_form, &mut scaled);
            };
            add(Weights { qq: h, ..none }, &|i, j| row(i) * column(j));
            add(Weights { qv: one, ..none }, &|i, _| row(i));
            add(Weights { vq: -weight, ..none }, &|_, j| column(j));
            for i in 0..r.len() {
                r[i] -= weight * one_form[i] - h * row(i) * gradient[i];
            }
        }
        Ok(())
    }

    fn residual(&mut self, at: [&[T]; 3], storage: [&mut [T]; 2]) -> Result<T, StepFailure> {
        // A copy: what another function sees has no place in registers.
        let Self { step, work: [point, velocity, gradient, one_form] } = self;
        residual(&mut Equations { step, work: [point, velocity, gradient, one_form] }, at, storage)
    }

    fn cost(&self) -> [u64; 2] {
        [self.step.nodes.len() as u64, 1]
    }
}
