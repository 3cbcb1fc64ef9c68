//! The step of a rule with nodes at the two ends only, where L = ½ v·M v − V(q, t): a kick, a drift along a
//! geodesic, a kick.
//!
//! p½ = p0 + h w0 f0      p½ = −D₁K_d for the displacement      p1 = D₂K_d + h w1 f1
//!
//! with the forces f as p is, the torque in the body of a rotation and s × ∂L/∂s of a unit vector, and K_d
//! the discrete Lagrangian of ½ v·M v. It is the general step, because there the forces of the first end do
//! not depend on the displacement, and those of the last do no work where the last point is held. It
//! evaluates one force.

use super::memory::Work;
use super::node::{Between, By, Forces, Node, Path};
use super::step::{Step, depart, nodes, subtract_momentum};
use crate::discrete::NodeWork;
use crate::discrete::quadrature::Rule;
use crate::mechanics::manifold::{Block, blocks, rotation, set, vector};
use crate::space::{Sink, SquareMatrix};
use crate::system::{CoordinateBlock, Factor};
use crate::{ManifoldLagrangian, Matrix, Real, Space, Weights};

/// Whether a coordinate of `S` is a unit vector. Without these what a drift needs is the same at all its
/// nodes.
pub(super) fn has_spheres<S: ManifoldLagrangian<T>, T: Real>() -> bool {
    S::REPORT.coordinates.iter().any(|&CoordinateBlock { factor, .. }| factor == Factor::Sphere)
}

/// The nodes of a drift with their weights.
fn drifts<S: ManifoldLagrangian<T>, R: Rule, T: Real>(rule: &R, h: T) -> impl Iterator<Item = [T; 2]> {
    let once = (!has_spheres::<S, T>()).then(|| [T::lift(0.0), h]);
    let each = has_spheres::<S, T>().then(|| nodes(rule, h));
    once.into_iter().chain(each.into_iter().flatten())
}

/// M.
pub(super) fn mass<S: ManifoldLagrangian<T>, T: Real>(system: &S, q: &[T], v: &[T], t: T) -> Matrix<S, T> {
    let space = system.space();
    let (mut mass, mut l_q, mut l_v) = (space.matrix(), space.vector(), space.vector());
    system.linearize(q, v, t, Weights::mass(), &mut l_q, &mut l_v, &mut mass);
    mass
}

/// Sets `force` to f at `q`.
pub(super) fn force<S: ManifoldLagrangian<T>, T: Real>(system: &S, q: &[T], t: T, force: &mut [T]) {
    system.force(q, &[], t, force);
    for block in blocks(system) {
        match block.factor {
            Factor::Line => {}
            Factor::Rotation => {
                let places = &mut force[block.places()];
                let m = rotation::matrix(&q[block.places()]).transpose() * rotation::matrix(places);
                places.fill(T::lift(0.0));
                set(force, block, rotation::torque(&m));
            }
            Factor::Sphere => {
                let torque = vector(q, block).cross(&vector(force, block));
                set(force, block, torque);
            }
        }
    }
}

/// Adds `weight` f to p.
pub(super) fn kick<T: Real>(p: &mut [T], weight: T, force: &[T]) {
    for (p, &force) in p.iter_mut().zip(force) {
        *p += weight * force;
    }
}

/// The weights h w of the two ends.
pub(super) fn weights<R: Rule, T: Real>(rule: &R, h: T) -> [T; 2] {
    let [mut first, mut last] = [T::lift(0.0); 2];
    for [c, weight] in nodes(rule, h) {
        if c == T::lift(0.0) { first += weight } else { last += weight }
    }
    [first, last]
}

impl<S: ManifoldLagrangian<T>, T: Real> Node<S, T> {
    /// Sets ∂L/∂v to M v.
    #[inline]
    fn set_momentum(&mut self, system: &S, mass: &Matrix<S, T>) {
        let NodeWork { velocity, momentum, .. } = &mut self.work;
        let dimension = velocity.len();
        let places = || blocks(system).flat_map(Block::velocities);
        for row in places() {
            let of_row = &mass[row * dimension..];
            momentum[row] =
                places().fold(T::lift(0.0), |sum, column| sum + of_row[column] * velocity[column]);
        }
    }
}

impl<S: ManifoldLagrangian<T>, T: Real> Work<S, T> {
    /// Sets the residual to −D₁K_d − p½ and the matrix to its derivative.
    pub(super) fn linearize_drift<R: Rule>(&mut self, step: &Step<'_, S, T>, rule: &R, mass: &Matrix<S, T>) {
        let Self { node, matrix, residual, displacement, .. } = self;
        let path = Path { q: step.q, displacement, h: step.h };
        residual.fill(T::lift(0.0));
        for block in blocks(step.system) {
            subtract_momentum(block, step.p, residual, || path.circle(block));
        }
        let entries = matrix.cleared();
        for [c, weight] in drifts::<S, R, T>(rule, step.h) {
            node.swing(step.system, path, c);
            node.set_momentum(step.system, mass);
            let Node { first, displacement, tangents, .. } = &*node;
            let by = [By::Velocity; 2];
            let mut between = Between::<S, T, _>::new(first, displacement, tangents, by, entries);
            let dimension = step.system.space().dimension();
            let places = || blocks(step.system).flat_map(Block::velocities);
            for (row, column) in places().flat_map(|row| places().map(move |column| (row, column))) {
                between.add(row, column, weight * mass[row * dimension + column]);
            }
            node.bend(step.system, path, [c, weight], Forces::Without, entries);
            node.project_momentum(step.system, weight, residual);
        }
    }

    /// Sets the momentum at the end of the drift.
    pub(super) fn balance_drift<R: Rule>(&mut self, step: &Step<'_, S, T>, rule: &R, mass: &Matrix<S, T>) {
        let Self { node, displacement, p, .. } = self;
        let path = Path { q: step.q, displacement, h: step.h };
        for block in blocks(step.system) {
            depart(block, path, step.p, p);
        }
        if has_spheres::<S, T>() {
            for [c, weight] in nodes(rule, step.h) {
                node.swing(step.system, path, c);
                node.set_momentum(step.system, mass);
                let NodeWork { velocity, momentum, .. } = &node.work;
                for block in blocks(step.system).filter(|block| block.factor == Factor::Sphere) {
                    let torque = vector(velocity, block).cross(&vector(momentum, block));
                    let sum = vector(p, block) + torque * weight;
                    set(p, block, sum);
                }
            }
        }
    }
}
