//! One step along a geodesic: p0 = −D₁L_d for the displacement, and what it leads to.

use nalgebra::Vector3;

use super::kicks;
use super::legendre::velocity;
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
use crate::solve::{Convergence, Due, Guess, Stopping, iterate, sizes};
use crate::space::{Sink, SquareMatrix};
use crate::state::Statistics;
use crate::state::rates::Rates;
use crate::state::summation::Carried;
use crate::system::{Factor, ManifoldSystem};
use crate::{ManifoldLagrangian, Real, Scalar, Space, System, Vector, Weights};

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
    #[cfg_attr(not(debug_assertions), inline(always))]
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
            begin(rates, h, guess, &mut work.displacement);
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
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn keep(&mut self, q: &mut [T], h: T) {
        let Self { p, rates, lifted, carried, kicks, work, .. } = self;
        if let Some(Kicks { force, .. }) = kicks {
            force.copy_from_slice(&work.force);
        }
        carried.advance(lifted, &work.increment, &work.lifted);
        q.copy_from_slice(&work.q);
        p.copy_from_slice(&work.p);
        rates.push(h, [&work.displacement]);
    }
}

impl<S: ManifoldLagrangian<T>, T: Real> Work<S, T> {
    /// Improves the displacement until p0 = −D₁L_d, whose residual and derivative `linearize` sets.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn solve(
        &mut self,
        step: &Step<'_, S, T>,
        stopping: Stopping,
        statistics: &mut Statistics,
        mut linearize: impl FnMut(&mut Self, &mut Statistics),
    ) -> Result<(), StepFailure> {
        let convergence = Convergence::new(stopping, stopping.max_iterations);
        iterate(convergence, statistics, |due, statistics| {
            self.prepare(due, step);
            linearize(self, statistics);
            statistics.factorisations += 1;
            self.matrix.factor()?;
            self.matrix.solve(&mut self.residual);
            self.correct(step);
            norm::finite(&self.displacement)?;
            Ok(sizes::largest(&self.weights, &self.residual))
        })?;
        self.check_angles(step.system)
    }

    /// Does what is `due` before an iteration. Angles are judged as they are.
    fn prepare(&mut self, due: &mut Due, step: &Step<'_, S, T>) {
        if core::mem::replace(due, Due::Nothing) == Due::Sizes {
            set_weights(step.system, &mut self.weights, |block| match block.factor {
                Factor::Line => {
                    let place = block.places().start;
                    Scalar::abs(step.q[place]) + Scalar::abs(self.displacement[place])
                }
                Factor::Rotation | Factor::Sphere => T::lift(1.0),
            });
        }
    }

    /// Takes the residual, which is a correction now, from the displacement.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn correct(&mut self, step: &Step<'_, S, T>) {
        for block in blocks(step.system) {
            correct(block, &self.residual, &mut self.displacement, |displacement, [along, across]| {
                let circle = GreatCircle::new(vector(step.q, block), displacement);
                circle.axis * (circle.angle - along) + circle.direction * across
            });
        }
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
    /// Evaluates L with its derivatives, and adds `weight` times the second ones, by the first point and the
    /// displacement.
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

/// Sets the weights of all entries of each block to one over its size.
pub(super) fn set_weights<S: ManifoldSystem, T: Real>(
    system: &S,
    weights: &mut [T],
    size: impl Fn(&Block) -> T,
) {
    for block in blocks(system) {
        weights[block.slot..block.slot + block.dimension()].fill(sizes::weight_of(size(&block)));
    }
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
pub(super) fn correct<T: Real>(
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

/// Sets `displacement` to the guess. Inlined, it would take registers from the iterations.
#[inline(never)]
fn begin<S: System, T: Real>(rates: &Rates<S, T>, h: T, guess: Guess, displacement: &mut Vector<S, T>) {
    rates.guess(h, guess, [&mut *displacement]);
    displacement.iter_mut().for_each(|displacement| *displacement *= h);
}

/// Adds what L at a node does to the momentum in the step, as it is seen from there.
fn push<S: System, T: Real>(
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
