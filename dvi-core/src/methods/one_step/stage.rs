//! The equations of a step for Δ = x1 − x0 and ȳ, by Newton's method:
//!
//! r_x = Σⱼ wⱼ(ϑⱼ − h(1 − cⱼ) f_xⱼ) − p      r_y = −½h Σⱼ wⱼ f_yⱼ
//!
//! at the points (x0 + cⱼΔ, ȳ) with the velocity Δ/h along x. With R = 1 − cⱼ in rows of x and ½ in rows of
//! y, and C = cⱼ in columns of Δ and 1 in those of ȳ, the matrix is Σⱼ wⱼ(C L_vq − R L_qv − h R C L_qq). Of
//! the midpoint scheme, solved for (½Δ, ȳ), it is Dα − (Dα)ᵀ − ½h L_qq.

use super::split::is_x;
use crate::error::StepFailure;
use crate::mechanics::pattern::of_second_derivatives;
use crate::scalar::norm;
use crate::solve::{Course, Due, Iteration, Judge, Stopping, repeat};
use crate::space::sink::{Product, Scaled};
use crate::space::{LinearEquations, LinearSolver, Sink, Storing, linear};
use crate::state::Statistics;
use crate::{Linear, ProperlyDegenerate, Real, Scalar, Space, System, Vector, Weights};

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Rule {
    A,
    B,
    Midpoint,
    Trapezoid,
}

impl Rule {
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn nodes(self) -> &'static [Node] {
        match self {
            Self::A => &[Node::END],
            Self::B => &[Node::BEGIN],
            Self::Midpoint => &[Node::CENTRE],
            Self::Trapezoid => &Node::ENDS,
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
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
    /// Δ along x, ȳ along y.
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
    solver: Linear<S, T>,
    velocity: Vector<S, T>,
    correction: Vector<S, T>,
    /// In which the iteration judges unknowns.
    weights: Vector<S, T>,
}

impl<S: ProperlyDegenerate<T>, T: Real> Stage<S, T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn new(system: &S, q: &Vector<S, T>, t: T) -> Self {
        let vector = || system.space().vector();
        let rest: Vector<S, T> = vector();
        Self {
            unknown: vector(),
            momentum: vector(),
            rates: vector(),
            gradient: vector(),
            one_form: vector(),
            solver: of_second_derivatives(system, q, &rest, t, Storing::Always),
            point: vector(),
            velocity: vector(),
            correction: vector(),
            weights: vector(),
        }
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
        repeat(
            J::of(Course::new(stopping, stopping.max_iterations)),
            statistics,
            Newton { step, stage: self },
        )
    }

    /// The residual at the unknowns, against what it is made of.
    #[cold]
    fn residual(&mut self, step: &Step<'_, S, T>) -> Result<T, StepFailure> {
        let (mut equations, _, [correction, weights]) = self.equations(step);
        let Equations { unknown, momentum, .. } = equations;
        let size = |j: usize| Scalar::abs(step.q[j]) + Scalar::abs(unknown[j]);
        let residual = linear::residual(&mut equations, size, |i| momentum[i], [&mut *correction, weights]);
        // What has been evaluated is at the unknowns, and what is left of the equations there is rounding:
        // no kick.
        correction.fill(T::lift(0.0));
        let half = T::lift(0.5) * step.h;
        for i in 0..self.one_form.len() {
            self.one_form[i] = self.momentum[i] + half * self.gradient[i];
        }
        residual
    }

    /// The equations at the unknowns.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn equations<'a>(&'a mut self, step: &'a Step<'a, S, T>) -> Posed<'a, S, T> {
        let Self {
            unknown, momentum, gradient, one_form, solver, point, velocity, correction, weights, ..
        } = self;
        (
            Equations { step, unknown, momentum, work: [point, velocity, gradient, one_form] },
            solver,
            [correction, weights],
        )
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
    /// half of the kick is ½h f + r − Dα d.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn kick_at_centre(&mut self, step: &Step<'_, S, T>) -> T {
        let Self { momentum, gradient, one_form, point, velocity, correction, .. } = self;
        let Step { system, t, h, .. } = *step;
        let (half, centre) = (T::lift(0.5) * h, t + T::lift(0.5) * h);
        // r − Dα d, which is small: what p has rounded off does not come back.
        let rest = velocity;
        for i in 0..rest.len() {
            rest[i] = one_form[i] - momentum[i] - half * gradient[i];
        }
        let mut product = Product { x: correction, sum: rest };
        system.one_form_jacobian(point, centre, T::lift(-1.0), T::lift(0.0), &mut product);
        for i in (0..momentum.len()).filter(|&i| is_x(system, i)) {
            momentum[i] += T::lift(2.0) * (half * gradient[i] + rest[i]);
        }
        centre
    }
}

impl<S: ProperlyDegenerate<T>, T: Real> Step<'_, S, T> {
    /// Whether the only node is the centre: its equations are solved for the point and not for Δ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn is_centred(&self) -> bool {
        self.nodes == [Node::CENTRE]
    }

    /// What an entry of the solution is multiplied by to give the change of the unknown.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn stretch(&self, i: usize) -> T {
        T::lift(if self.is_centred() && is_x(self.system, i) { 2.0 } else { 1.0 })
    }

    /// Sets `point` and `velocity` to those of `node`, and returns its time.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn place(
        &self,
        unknown: &Vector<S, T>,
        node: &Node,
        point: &mut Vector<S, T>,
        velocity: &mut Vector<S, T>,
    ) -> T {
        let (c, per_h) = (T::lift(node.c), T::lift(1.0) / self.h);
        for i in 0..unknown.len() {
            [point[i], velocity[i]] = if is_x(self.system, i) {
                [self.q[i] + c * unknown[i], per_h * unknown[i]]
            } else {
                [unknown[i], T::lift(0.0)]
            };
        }
        self.t + c * self.h
    }
}

/// Newton's method for the unknowns.
struct Newton<'a, S: System, T: Real> {
    step: &'a Step<'a, S, T>,
    stage: &'a mut Stage<S, T>,
}

impl<S: ProperlyDegenerate<T>, T: Real> Iteration<T> for Newton<'_, S, T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn prepare(&mut self, due: &mut Due) {
        due.prepare(self.step.system, &mut self.stage.weights, self.step.q, &mut self.stage.unknown);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn improve(&mut self, due: &mut Due, _statistics: &mut Statistics) -> Result<T, StepFailure> {
        let Self { step, stage } = self;
        if *due == Due::Residual {
            return stage.residual(step);
        }
        let (mut equations, solver, [correction, weights]) = stage.equations(step);
        solver.solve(&mut equations, weights, correction)?;
        let mut size = T::lift(0.0);
        let Stage { unknown, correction, weights, .. } = &mut **stage;
        for (i, (unknown, &correction)) in unknown.iter_mut().zip(correction.iter()).enumerate() {
            let change = step.stretch(i) * correction;
            *unknown -= change;
            size = norm::larger(size, Scalar::abs(change) * weights[i]);
        }
        Ok(size)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn count(&self, times: u64, statistics: &mut Statistics) {
        statistics.linearizations += times * self.step.nodes.len() as u64;
        statistics.factorisations += times;
    }
}

/// Equations, what solves them, where the solution goes, and the weights of its entries.
type Posed<'a, S, T> = (Equations<'a, S, T>, &'a mut Linear<S, T>, [&'a mut Vector<S, T>; 2]);

struct Equations<'a, S: System, T: Real> {
    step: &'a Step<'a, S, T>,
    unknown: &'a Vector<S, T>,
    momentum: &'a Vector<S, T>,
    /// A point, a velocity, and the first derivatives of L there.
    work: [&'a mut Vector<S, T>; 4],
}

impl<S: ProperlyDegenerate<T>, T: Real> LinearEquations<T> for Equations<'_, S, T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn evaluate<K: Sink<T>>(&mut self, b: &mut [T], sink: &mut K) -> Result<(), StepFailure> {
        let Self { step, unknown, momentum, work: [point, velocity, gradient, one_form] } = self;
        let Step { system, h, nodes, .. } = **step;
        let half = T::lift(0.5);
        if step.is_centred() {
            let time = step.place(unknown, &Node::CENTRE, point, velocity);
            let (one, zero) = (T::lift(1.0), T::lift(0.0));
            let weights = Weights { qq: -half * h, qv: -one, vq: one, vv: zero };
            system.linearize(point, velocity, time, weights, gradient, one_form, sink);
            for (i, b) in b.iter_mut().enumerate() {
                let impulse = half * h * gradient[i];
                *b = if is_x(system, i) { one_form[i] - momentum[i] - impulse } else { -impulse };
            }
            return Ok(());
        }
        for (i, b) in b.iter_mut().enumerate() {
            *b = -momentum[i];
        }
        for node in nodes {
            let (weight, c) = (T::lift(node.weight), T::lift(node.c));
            let time = step.place(unknown, node, point, velocity);
            let row = |row: usize| weight * if is_x(system, row) { T::lift(1.0) - c } else { half };
            let column = |column: usize| if is_x(system, column) { c } else { T::lift(1.0) };
            let zero = T::lift(0.0);
            let none = Weights { qq: zero, qv: zero, vq: zero, vv: zero };
            let mut add = |w: Weights<T>, factor: &dyn Fn(usize, usize) -> T| {
                let mut scaled = Scaled { sink: &mut *sink, factor };
                system.linearize(point, velocity, time, w, gradient, one_form, &mut scaled);
            };
            add(Weights { qq: -h, ..none }, &|i, j| row(i) * column(j));
            add(Weights { qv: -T::lift(1.0), ..none }, &|i, _| row(i));
            add(Weights { vq: weight, ..none }, &|_, j| column(j));
            for i in 0..b.len() {
                b[i] += weight * one_form[i] - h * row(i) * gradient[i];
            }
        }
        Ok(())
    }
}
