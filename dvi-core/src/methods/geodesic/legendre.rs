//! Between velocities and momenta of a manifold.

use nalgebra::Vector3;

use super::memory::Square;
use super::node::{Between, By, Node};
use super::step::{correct, set_weights, subtract_momentum};
use crate::discrete::NodeWork;
use crate::error::StepFailure;
use crate::mechanics::manifold::sphere::GreatCircle;
use crate::mechanics::manifold::{Block, blocks, set, vector};
use crate::scalar::norm;
use crate::solve::{Convergence, Due, Stopping, iterate, sizes};
use crate::space::SquareMatrix;
use crate::state::Statistics;
use crate::system::{Factor, ManifoldSystem};
use crate::{ManifoldLagrangian, Real, Weights};

/// Sets `p` to ∂L/∂v as a covector of the manifold at `q`, from the derivative by the velocities; of a unit
/// vector to s × ∂L/∂ṡ.
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
pub(super) fn velocity<S: ManifoldSystem, T: Real>(system: &S, q: &[T], v: &mut [T]) {
    for block in blocks(system).filter(|block| block.factor == Factor::Sphere) {
        let rate = vector(v, block);
        set(v, block, rate.cross(&vector(q, block)));
    }
}

/// The equations ∂L/∂v = p for the velocity, as covectors of the manifold.
pub(super) struct Legendre<'a, S: ManifoldSystem, T: Real> {
    pub(super) node: &'a mut Node<S, T>,
    pub(super) matrix: &'a mut Square<S, T>,
    pub(super) residual: &'a mut [T],
    pub(super) weights: &'a mut [T],
}

impl<S: ManifoldLagrangian<T>, T: Real> Legendre<'_, S, T> {
    /// Sets the residual and the matrix at (`q`, `v`), and factors it.
    pub(super) fn linearize(&mut self, system: &S, [q, v, p]: [&[T]; 3], t: T) -> Result<(), StepFailure> {
        let Self { node, matrix, residual, .. } = self;
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
        let convergence = Convergence::new(stopping, stopping.max_iterations);
        iterate(convergence, &mut Statistics::default(), |due, _| {
            if core::mem::replace(due, Due::Nothing) == Due::Sizes {
                set_weights(system, self.weights, |block| norm::largest(&v[block.places()]));
            }
            self.linearize(system, [q, v, p], t)?;
            self.matrix.solve(self.residual);
            self.correct(system, q, v);
            norm::finite(v)?;
            Ok(sizes::largest(self.weights, self.residual))
        })
    }

    /// Takes the residual, which is a correction now, from the velocity.
    fn correct(&self, system: &S, q: &[T], v: &mut [T]) {
        for block in blocks(system) {
            correct(block, self.residual, v, |rate, [along, across]| {
                let circle = at_rest(block, q);
                rate - circle.direction * along - circle.axis * across
            });
        }
    }
}

/// The directions at a unit vector that stays where it is.
fn at_rest<T: Real>(block: Block, q: &[T]) -> GreatCircle<T> {
    GreatCircle::new(vector(q, block), Vector3::zeros())
}
