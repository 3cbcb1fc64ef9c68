//! The equations of a step for Δ = x1 − x0 and ȳ, by Newton's method:
//!
//! r_x = Σⱼ wⱼ(ϑⱼ − h(1 − cⱼ) f_xⱼ) − p      r_y = −½h Σⱼ wⱼ f_yⱼ
//!
//! at the points (x0 + cⱼΔ, ȳ) with the velocity Δ/h along x. With R = 1 − cⱼ in rows of x and ½ in rows of y, and C = cⱼ in
//! columns of Δ and 1 in those of ȳ, the matrix is Σⱼ wⱼ(C L_vq − R L_qv − h R C L_qq).

use super::split::Split;
use crate::error::StepFailure;
use crate::mechanics::pattern::of_second_derivatives;
use crate::scalar::norm;
use crate::solve::{Convergence, Stopping, iterate};
use crate::space::sink::Scaled;
use crate::space::{LinearEquations, LinearSolver, Sink, Storing};
use crate::state::Statistics;
use crate::{Linear, ProperlyDegenerate, Real, Space, System, Vector, Weights};

/// A node of a rule.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Node {
    c: f64,
    weight: f64,
}

impl Node {
    pub(super) const BEGIN: Self = Self { c: 0.0, weight: 1.0 };
    pub(super) const CENTRE: Self = Self { c: 0.5, weight: 1.0 };
    pub(super) const END: Self = Self { c: 1.0, weight: 1.0 };
    pub(super) const ENDS: [Self; 2] = [Self { c: 0.0, weight: 0.5 }, Self { c: 1.0, weight: 0.5 }];
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
    solver: Linear<S, T>,
    point: Vector<S, T>,
    velocity: Vector<S, T>,
    correction: Vector<S, T>,
}

impl<S: ProperlyDegenerate<T>, T: Real> Stage<S, T> {
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
        }
    }

    /// Improves the guess `unknown` until the equations hold for `momentum`, from x in `q`; begins again from rest where
    /// that does not lead to a solution.
    ///
    /// # Errors
    /// [`StepFailure::NotConverged`], [`StepFailure::Singular`], [`StepFailure::NotFinite`].
    #[allow(clippy::too_many_arguments)]
    pub(super) fn solve(
        &mut self,
        system: &S,
        split: &Split<S, T>,
        q: &[T],
        [t, h]: [T; 2],
        nodes: &[Node],
        stopping: Stopping,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        self.improve(system, split, q, [t, h], nodes, stopping, statistics).or_else(|_| {
            // Where steps are long, extrapolation is off.
            for (i, unknown) in self.unknown.iter_mut().enumerate() {
                *unknown = if split.is_x(i) { T::lift(0.0) } else { q[i] };
            }
            self.improve(system, split, q, [t, h], nodes, stopping, statistics)
        })
    }

    #[allow(clippy::too_many_arguments)]
    fn improve(
        &mut self,
        system: &S,
        split: &Split<S, T>,
        q: &[T],
        [t, h]: [T; 2],
        nodes: &[Node],
        stopping: Stopping,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Self { unknown, momentum, gradient, one_form, solver, point, velocity, correction, .. } = self;
        let scale = norm::larger(norm::largest(q), norm::largest(unknown));
        let convergence = Convergence::new(stopping, scale, q, stopping.max_iterations);
        iterate(convergence, statistics, |statistics| {
            statistics.linearizations += nodes.len() as u64;
            statistics.factorisations += 1;
            let place = Place { split, q, unknown: &*unknown, h };
            let work = [&mut **point, &mut **velocity, &mut **gradient, &mut **one_form];
            let mut equations = Equations { system, place, t, nodes, momentum: &*momentum, work };
            solver.solve(&mut equations, correction)?;
            norm::finite(correction)?;
            for (unknown, &change) in unknown.iter_mut().zip(correction.iter()) {
                *unknown -= change;
            }
            Ok(norm::largest(correction))
        })
    }

    /// Adds h Σⱼ wⱼ f_xⱼ to `momentum`.
    pub(super) fn kick(
        &mut self,
        system: &S,
        split: &Split<S, T>,
        q: &[T],
        [t, h]: [T; 2],
        nodes: &[Node],
        statistics: &mut Statistics,
    ) {
        let Self { unknown, momentum, gradient, one_form, point, velocity, .. } = self;
        let place = Place { split, q, unknown, h };
        for node in nodes {
            place.at(node, point, velocity);
            system.gradient(point, velocity, t + T::lift(node.c) * h, gradient, one_form);
            statistics.gradients += 1;
            let weight = h * T::lift(node.weight);
            for i in (0..q.len()).filter(|&i| split.is_x(i)) {
                momentum[i] += weight * gradient[i];
            }
        }
    }
}

/// Where the nodes are.
#[derive(Clone, Copy)]
struct Place<'a, S: System, T: Real> {
    split: &'a Split<S, T>,
    q: &'a [T],
    unknown: &'a [T],
    h: T,
}

impl<S: ProperlyDegenerate<T>, T: Real> Place<'_, S, T> {
    /// Sets `point` and `velocity` to those of `node`.
    fn at(&self, node: &Node, point: &mut [T], velocity: &mut [T]) {
        let (c, per_h) = (T::lift(node.c), T::lift(1.0) / self.h);
        for i in 0..self.q.len() {
            [point[i], velocity[i]] = if self.split.is_x(i) {
                [self.q[i] + c * self.unknown[i], per_h * self.unknown[i]]
            } else {
                [self.unknown[i], T::lift(0.0)]
            };
        }
    }
}

struct Equations<'a, S: System, T: Real> {
    system: &'a S,
    place: Place<'a, S, T>,
    t: T,
    nodes: &'a [Node],
    momentum: &'a [T],
    /// A point, a velocity, and the first derivatives of L there.
    work: [&'a mut [T]; 4],
}

impl<S: ProperlyDegenerate<T>, T: Real> LinearEquations<T> for Equations<'_, S, T> {
    fn evaluate<K: Sink<T>>(&mut self, b: &mut [T], sink: &mut K) -> Result<(), StepFailure> {
        let Self { system, place, t, nodes, momentum, work: [point, velocity, gradient, one_form] } = self;
        let (split, h) = (place.split, place.h);
        let half = T::lift(0.5);
        for (i, b) in b.iter_mut().enumerate() {
            *b = -momentum[i];
        }
        for node in *nodes {
            let (weight, c) = (T::lift(node.weight), T::lift(node.c));
            place.at(node, point, velocity);
            let time = *t + c * h;
            let row = |row: usize| weight * if split.is_x(row) { T::lift(1.0) - c } else { half };
            let column = |column: usize| if split.is_x(column) { c } else { T::lift(1.0) };
            let zero = T::lift(0.0);
            let none = Weights { qq: zero, qv: zero, vq: zero, vv: zero };
            if *node == Node::CENTRE {
                // Of this node, R is ½ in all rows.
                let w = Weights { qq: -half * half * h, qv: -half, vq: half, vv: zero };
                let factor = |_: usize, column: usize| T::lift(if split.is_x(column) { 1.0 } else { 2.0 });
                system.linearize(point, velocity, time, w, gradient, one_form, &mut Scaled { sink, factor });
            } else {
                let mut add = |w: Weights<T>, factor: &dyn Fn(usize, usize) -> T| {
                    let mut scaled = Scaled { sink: &mut *sink, factor };
                    system.linearize(point, velocity, time, w, gradient, one_form, &mut scaled);
                };
                add(Weights { qq: -h, ..none }, &|i, j| row(i) * column(j));
                add(Weights { qv: -T::lift(1.0), ..none }, &|i, _| row(i));
                add(Weights { vq: weight, ..none }, &|_, j| column(j));
            }
            for i in 0..b.len() {
                b[i] += weight * one_form[i] - h * row(i) * gradient[i];
            }
        }
        Ok(())
    }
}
