//! One step along a geodesic: p0 = −D₁L_d for the displacement, and what it leads to.

use nalgebra::Vector3;

use super::kicks;
use super::memory::{GeodesicMemory, Kicks, Work};
use super::node::{Between, By, Forces, Node, Path};
use crate::discrete::NodeWork;
use crate::discrete::quadrature::Rule;
use crate::error::StepFailure;
use crate::mechanics::manifold::series::Series;
use crate::mechanics::manifold::sphere::GreatCircle;
use crate::mechanics::manifold::{self, Block, blocks, quaternion, rotation, set, vector};
use crate::scalar::norm;
use crate::scalar::norm::reported;
use crate::solve::{Convergence, Guess, Stopping, iterate};
use crate::space::{Sink, SquareMatrix};
use crate::state::Statistics;
use crate::state::summation::Carried;
use crate::system::{Factor, ManifoldSystem};
use crate::{ManifoldLagrangian, Real, Space, Weights};

/// One step: where it begins, and how long it is.
pub(super) struct Step<'a, S, T> {
    pub(super) system: &'a S,
    pub(super) q: &'a [T],
    pub(super) p: &'a [T],
    pub(super) t: T,
    pub(super) h: T,
}

/// The nodes cⱼ of a rule with h wⱼ.
pub(super) fn nodes<R: Rule, T: Real>(rule: &R, h: T) -> impl Iterator<Item = [T; 2]> {
    rule.nodes().iter().zip(rule.weights()).map(move |(&c, &weight)| [T::lift(c), h * T::lift(weight)])
}

impl<S: ManifoldLagrangian<T>, T: Real> GeodesicMemory<S, T> {
    /// Finds the end of a step from time t, of length h.
    #[inline(always)]
    pub(super) fn solve<R: Rule>(
        &mut self,
        rule: &R,
        (system, q): (&S, &[T]),
        [t, h]: [T; 2],
        stopping: Stopping,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Self { p, rates, lifted, carried, kicks, orientation, is_positive, p0, work } = self;
        let impulses = kicks::weights(rule, h);
        p0.copy_from_slice(p);
        if let Some(Kicks { force, .. }) = kicks {
            kicks::kick(p0, impulses[0], force);
        }
        let step = Step { system, q, p: p0, t, h };
        let mut attempt = |guess| {
            rates.guess(h, guess, &mut work.displacement);
            work.displacement.iter_mut().for_each(|displacement| *displacement *= h);
            work.solve(&step, stopping, statistics, |work, statistics| match kicks {
                None => work.linearize(&step, rule, statistics),
                Some(Kicks { mass, .. }) => work.linearize_drift(&step, rule, mass),
            })
        };
        attempt(Guess::Extrapolated).or_else(|_| attempt(Guess::Zero))?;
        work.check_branch(system, *is_positive, h)?;
        work.arrive(&step, lifted, carried);
        match kicks {
            None => work.balance(&step, rule, statistics),
            Some(Kicks { mass, .. }) => {
                work.balance_drift(&step, rule, mass);
                kicks::force(system, &work.q, t + h, &mut work.force);
                statistics.gradients += 1;
                kicks::kick(&mut work.p, impulses[1], &work.force);
            }
        }
        norm::finite(&work.q).and(norm::finite(&work.p))?;
        work.displacement.iter_mut().for_each(|displacement| *displacement /= h);
        if let Some(orientation) = orientation {
            let Work { node, displacement, q, v, .. } = work;
            v.copy_from_slice(displacement);
            velocity(system, q, v);
            orientation.check(system, node, [q, v], t + h)?;
        }
        Ok(())
    }

    /// Moves to the end of the step.
    #[inline(always)]
    pub(super) fn keep(&mut self, q: &mut [T], h: T) {
        let Self { p, rates, lifted, carried, kicks, work, .. } = self;
        if let Some(Kicks { force, .. }) = kicks {
            force.copy_from_slice(&work.force);
        }
        carried.advance(lifted, &work.increment, &work.lifted);
        q.copy_from_slice(&work.q);
        p.copy_from_slice(&work.p);
        rates.push(h, &work.displacement);
    }
}

impl<S: ManifoldLagrangian<T>, T: Real> Work<S, T> {
    /// Improves the displacement until p0 = −D₁L_d, whose residual and derivative `linearize` sets.
    #[inline(always)]
    pub(super) fn solve(
        &mut self,
        step: &Step<'_, S, T>,
        stopping: Stopping,
        statistics: &mut Statistics,
        mut linearize: impl FnMut(&mut Self, &mut Statistics),
    ) -> Result<(), StepFailure> {
        let scale = norm::largest(step.q) + norm::largest(&self.displacement);
        let convergence = Convergence::new(stopping, scale, step.q, stopping.max_iterations);
        iterate(convergence, statistics, |statistics| {
            linearize(self, statistics);
            statistics.factorisations += 1;
            self.matrix.factor()?;
            self.matrix.solve(&mut self.residual);
            for block in blocks(step.system) {
                correct(block, &self.residual, &mut self.displacement, |displacement, [along, across]| {
                    let circle = GreatCircle::new(vector(step.q, block), displacement);
                    circle.axis * (circle.angle - along) + circle.direction * across
                });
            }
            norm::finite(&self.displacement)?;
            Ok(norm::largest(&self.residual))
        })?;
        self.check_angles(step.system)
    }

    /// Sets the residual to −D₁L_d − p0 and the matrix to its derivative.
    pub(super) fn linearize<R: Rule>(
        &mut self,
        step: &Step<'_, S, T>,
        rule: &R,
        statistics: &mut Statistics,
    ) {
        statistics.linearizations += rule.nodes().len() as u64;
        let Self { node, matrix, residual, displacement, .. } = self;
        let path = Path { q: step.q, displacement, h: step.h };
        residual.fill(T::lift(0.0));
        for block in blocks(step.system) {
            subtract_momentum(block, step.p, residual, || path.circle(block));
        }
        let entries = matrix.cleared();
        for [c, weight] in nodes(rule, step.h) {
            node.place(step.system, path, c);
            node.second_derivatives(step.system, step.t + c * step.h, weight, entries);
            node.bend(step.system, path, [c, weight], Forces::Of, entries);
            node.project_force(weight, residual);
            node.project_momentum(step.system, weight, residual);
        }
    }

    /// Sets what is carried of the coordinates, and these, at the end of the displacement.
    pub(super) fn arrive(&mut self, step: &Step<'_, S, T>, lifted: &[T], carried: &Carried<S, T>) {
        let path = Path { q: step.q, displacement: &self.displacement, h: step.h };
        for block in blocks(step.system) {
            increment_of(block, path, lifted, &mut self.increment);
        }
        carried.add(lifted, &self.increment, &mut self.lifted);
        manifold::lower(step.system, &self.lifted, &mut self.q);
    }

    /// Sets the momentum at the end of the displacement.
    pub(super) fn balance<R: Rule>(&mut self, step: &Step<'_, S, T>, rule: &R, statistics: &mut Statistics) {
        let Self { node, displacement, p, .. } = self;
        let path = Path { q: step.q, displacement, h: step.h };
        for block in blocks(step.system) {
            depart(block, path, step.p, p);
        }
        for [c, weight] in nodes(rule, step.h) {
            node.place(step.system, path, c);
            let NodeWork { point, velocity, gradient, momentum } = &mut node.work;
            step.system.gradient(point, velocity, step.t + c * step.h, gradient, momentum);
            statistics.gradients += 1;
            for block in blocks(step.system) {
                push(block, path, &node.work, [c, weight], p);
            }
        }
    }

    /// Whether the equations of the step have the determinant of a short one, by its sign.
    ///
    /// # Errors
    /// [`StepFailure::Branch`].
    pub(super) fn check_branch(&self, system: &S, is_positive: bool, h: T) -> Result<(), StepFailure> {
        let is_odd = h < T::lift(0.0) && system.tangent().dimension() % 2 == 1;
        if self.matrix.is_positive() == (is_positive ^ is_odd) { Ok(()) } else { Err(StepFailure::Branch) }
    }

    /// Beyond half a turn a geodesic is not the shortest way.
    fn check_angles(&self, system: &S) -> Result<(), StepFailure> {
        let turned = |block: &Block| vector(&self.displacement, *block).norm();
        let half = T::lift(core::f64::consts::PI);
        let blocks = blocks(system).filter(|block| block.factor != Factor::Line);
        let far = blocks.map(|block| (block, turned(&block))).find(|(_, angle)| *angle >= half);
        // That an angle is a number was seen where it was solved for.
        match far {
            Some((block, angle)) => Err(StepFailure::HalfTurn { block: block.name, angle: reported(angle) }),
            None => Ok(()),
        }
    }
}

impl<S: ManifoldLagrangian<T>, T: Real> Node<S, T> {
    /// Evaluates L with its derivatives, and adds `weight` times the second ones, by the first point and the displacement.
    fn second_derivatives<K: Sink<T>>(&mut self, system: &S, t: T, weight: T, sink: &mut K) {
        let Self { work: NodeWork { point, velocity, gradient, momentum }, first, displacement, tangents } =
            self;
        let zero = T::lift(0.0);
        let none = Weights { qq: zero, qv: zero, vq: zero, vv: zero };
        let all = [
            ([By::Point, By::Point], Weights { qq: weight, ..none }),
            ([By::Velocity, By::Velocity], Weights { vv: weight, ..none }),
            ([By::Point, By::Velocity], Weights { qv: weight, ..none }),
            ([By::Velocity, By::Point], Weights { vq: weight, ..none }),
        ];
        // Where M is constant, positions and velocities do not mix.
        let mixed = if S::CONSTANT_MASS { 2 } else { 4 };
        for (by, weights) in &all[..mixed] {
            let mut between = Between::<S, T, K>::new(first, displacement, tangents, *by, sink);
            system.linearize(point, velocity, t, *weights, gradient, momentum, &mut between);
        }
    }
}

/// The directions at a unit vector that stays where it is.
fn at_rest<T: Real>(block: Block, q: &[T]) -> GreatCircle<T> {
    GreatCircle::new(vector(q, block), Vector3::zeros())
}

/// Subtracts a momentum from the residual, of a unit vector in the directions of a circle.
pub(super) fn subtract_momentum<T: Real>(
    block: Block,
    p: &[T],
    residual: &mut [T],
    circle: impl FnOnce() -> GreatCircle<T>,
) {
    let slots = block.slot..block.slot + block.dimension();
    match block.factor {
        Factor::Line | Factor::Rotation => {
            for (residual, &p) in residual[slots].iter_mut().zip(&p[block.places()]) {
                *residual -= p;
            }
        }
        Factor::Sphere => {
            // With the turning s × p, p·d = (s × p)·n and p·n = −(s × p)·d.
            let (circle, turning) = (circle(), vector(p, block));
            residual[block.slot] -= turning.dot(&circle.axis);
            residual[block.slot + 1] += turning.dot(&circle.direction);
        }
    }
}

/// Subtracts a correction in tangent vectors from `numbers`; `on_sphere` does it for a unit vector.
fn correct<T: Real>(
    block: Block,
    correction: &[T],
    numbers: &mut [T],
    on_sphere: impl FnOnce(Vector3<T>, [T; 2]) -> Vector3<T>,
) {
    let correction = &correction[block.slot..block.slot + block.dimension()];
    match block.factor {
        Factor::Line | Factor::Rotation => {
            for (number, &change) in numbers[block.places()].iter_mut().zip(correction) {
                *number -= change;
            }
        }
        Factor::Sphere => {
            let corrected = on_sphere(vector(numbers, block), [correction[0], correction[1]]);
            set(numbers, block, corrected);
        }
    }
}

/// Sets what a displacement adds to what is carried of the coordinates.
fn increment_of<T: Real>(block: Block, path: Path<'_, T>, lifted: &[T], increment: &mut [T]) {
    match block.factor {
        Factor::Line => increment[block.places()].copy_from_slice(&path.displacement[block.places()]),
        Factor::Rotation => {
            let turn = rotation::increment(&quaternion(lifted, block), vector(path.displacement, block));
            increment[block.places()][..4].copy_from_slice(turn.coords.as_slice());
        }
        Factor::Sphere => set(increment, block, path.circle(block).increment()),
    }
}

/// Sets `p` to p0, seen from the end of the step.
pub(super) fn depart<T: Real>(block: Block, path: Path<'_, T>, p0: &[T], p: &mut [T]) {
    match block.factor {
        Factor::Line | Factor::Sphere => p[block.places()].copy_from_slice(&p0[block.places()]),
        Factor::Rotation => {
            p[block.places()].fill(T::lift(0.0));
            let back = Series::exp(-vector(path.displacement, block));
            set(p, block, back.of(&vector(p0, block)));
        }
    }
}

/// Adds what L at a node does to the momentum in the step, as it is seen from there.
fn push<S: crate::System, T: Real>(
    block: Block,
    path: Path<'_, T>,
    work: &NodeWork<S, T>,
    [c, weight]: [T; 2],
    p: &mut [T],
) {
    let NodeWork { point, velocity, gradient, momentum } = work;
    match block.factor {
        Factor::Line => {
            for i in block.places() {
                p[i] += weight * gradient[i];
            }
        }
        Factor::Rotation => {
            let here = rotation::matrix(&point[block.places()]);
            let torque = rotation::torque(&(here.transpose() * rotation::matrix(&gradient[block.places()])));
            let rest = Series::exp(vector(path.displacement, block) * (c - T::lift(1.0)));
            let sum = vector(p, block) + rest.of(&torque) * weight;
            set(p, block, sum);
        }
        Factor::Sphere => {
            let torque: Vector3<T> = vector(point, block).cross(&vector(gradient, block))
                + vector(velocity, block).cross(&vector(momentum, block));
            let sum = vector(p, block) + torque * weight;
            set(p, block, sum);
        }
    }
}

/// Sets `p` to ∂L/∂v as a covector of the manifold at `q`, from the derivative by the velocities; of a unit vector to s × ∂L/∂ṡ.
pub(super) fn momentum<S: ManifoldSystem, T: Real>(system: &S, q: &[T], l_v: &[T], p: &mut [T]) {
    for block in blocks(system) {
        match block.factor {
            Factor::Line => p[block.places()].copy_from_slice(&l_v[block.places()]),
            Factor::Rotation => {
                p[block.places()].fill(T::lift(0.0));
                set(p, block, vector(l_v, block));
            }
            Factor::Sphere => {
                let turning = vector(q, block).cross(&vector(l_v, block));
                set(p, block, turning);
            }
        }
    }
}

/// Sets the rates of displacement of a motion with velocity `v` at `q`.
pub(super) fn rates<S: ManifoldSystem, T: Real>(system: &S, q: &[T], v: &[T], rates: &mut [T]) {
    for block in blocks(system) {
        match block.factor {
            Factor::Line => rates[block.places()].copy_from_slice(&v[block.places()]),
            Factor::Rotation => {
                rates[block.places()].fill(T::lift(0.0));
                set(rates, block, vector(v, block));
            }
            Factor::Sphere => set(rates, block, vector(q, block).cross(&vector(v, block))),
        }
    }
}

/// Sets `v` to the velocity at `q` of a motion with these rates of displacement.
fn velocity<S: ManifoldSystem, T: Real>(system: &S, q: &[T], v: &mut [T]) {
    for block in blocks(system).filter(|block| block.factor == Factor::Sphere) {
        let rate = vector(v, block);
        set(v, block, rate.cross(&vector(q, block)));
    }
}

/// The equations ∂L/∂v = p for the velocity, as covectors of the manifold.
pub(super) struct Legendre<'a, S: ManifoldSystem, T: Real> {
    pub(super) node: &'a mut Node<S, T>,
    pub(super) matrix: &'a mut super::memory::Square<S, T>,
    pub(super) residual: &'a mut [T],
}

impl<S: ManifoldLagrangian<T>, T: Real> Legendre<'_, S, T> {
    /// Sets the residual and the matrix at (`q`, `v`), and factors it.
    pub(super) fn linearize(&mut self, system: &S, [q, v, p]: [&[T]; 3], t: T) -> Result<(), StepFailure> {
        let Self { node, matrix, residual } = self;
        node.rest(system, q, v);
        let mass = Weights::mass();
        let entries = matrix.cleared();
        let Node { work: NodeWork { point, velocity, gradient, momentum }, first, tangents, .. } =
            &mut **node;
        let mut between = Between::<S, T, _>::new(first, first, tangents, [By::Velocity; 2], entries);
        system.linearize(point, velocity, t, mass, gradient, momentum, &mut between);
        residual.fill(T::lift(0.0));
        for block in blocks(system) {
            subtract_momentum(block, p, residual, || at_rest(block, q));
        }
        node.project_momentum(system, T::lift(1.0), residual);
        matrix.factor()
    }

    /// Improves `v`, which begins as rates of displacement, until ∂L/∂v = p.
    pub(super) fn solve(
        &mut self,
        system: &S,
        [q, p]: [&[T]; 2],
        t: T,
        v: &mut [T],
    ) -> Result<(), StepFailure> {
        velocity(system, q, v);
        let stopping = Stopping::default();
        let convergence = Convergence::new(stopping, norm::largest(v), v, stopping.max_iterations);
        iterate(convergence, &mut Statistics::default(), |_| {
            self.linearize(system, [q, v, p], t)?;
            self.matrix.solve(self.residual);
            for block in blocks(system) {
                correct(block, self.residual, v, |rate, [along, across]| {
                    let circle = at_rest(block, q);
                    rate - circle.direction * along - circle.axis * across
                });
            }
            norm::finite(v)?;
            Ok(norm::largest(self.residual))
        })
    }
}
