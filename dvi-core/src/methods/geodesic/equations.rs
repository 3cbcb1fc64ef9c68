//! The equations p0 = −D₁L_d of a step for its displacement, and the momentum at its end.

use nalgebra::Vector3;

use super::covectors::{depart, push, subtract_momentum};
use super::memory::MassRows;
use super::node::{Forces, Node, Path};
use super::tangents::{Equations, Tangents};
use crate::discrete::quadrature::Rule;
use crate::discrete::{Interval, NodeWork};
use crate::mechanics::manifold::series::Series;
use crate::mechanics::manifold::sphere::GreatCircle;
use crate::mechanics::manifold::{Block, blocks, vector};
use crate::scalar::norm;
use crate::space::{RowMatrix, Sink};
use crate::state::Statistics;
use crate::system::{CoordinateBlock, Factor};
use crate::{ManifoldLagrangian, Real, Scalar, System};

/// Where a step begins, and what is integrated along it.
pub(super) struct Begin<'a, S: System, R, T: Real> {
    pub(super) system: &'a S,
    pub(super) rule: &'a R,
    pub(super) interval: Interval<T>,
    pub(super) q: &'a [T],
    pub(super) p: &'a [T],
    /// M, where L is ½ v·M v alone.
    pub(super) mass: Option<&'a MassRows<S, T>>,
}

/// Whether a coordinate of `S` is a unit vector. Without these what a drift needs is the same at all its
/// nodes.
#[inline]
pub(super) fn has_spheres<S: ManifoldLagrangian<T>, T: Real>() -> bool {
    S::REPORT.coordinates.iter().any(|&CoordinateBlock { factor, .. }| factor == Factor::Sphere)
}

/// The nodes cⱼ of a rule with h wⱼ.
#[inline]
pub(super) fn nodes<R: Rule, T: Real>(rule: &R, h: T) -> impl Iterator<Item = [T; 2]> {
    rule.nodes().iter().zip(rule.weights()).map(move |(&c, &weight)| [T::lift(c), h * T::lift(weight)])
}

impl<S: ManifoldLagrangian<T>, R: Rule, T: Real> Begin<'_, S, R, T> {
    #[inline]
    pub(super) fn path<'b>(&'b self, displacement: &'b [T]) -> Path<'b, T> {
        Path { q: self.q, displacement, h: self.interval.h }
    }

    /// Without unit vectors, −D₁K_d = J(−u)⁻¹ M u/h of rotations, and M Δ/h of numbers. M u/h = J(−u) p0 has
    /// the same solution, and M/h as its derivative but for that of J.
    #[inline]
    fn linearize_drift<K: Sink<T>>(
        &self,
        mass: &MassRows<S, T>,
        displacement: &[T],
        Node { work, slots, .. }: &mut Node<S, T>,
        residual: &mut [T],
        entries: &mut K,
    ) {
        let (system, per_h) = (self.system, T::lift(1.0) / self.interval.h);
        let NodeWork { point, velocity, momentum, .. } = work;
        for place in blocks(system).flat_map(Block::velocities) {
            velocity[place] = per_h * displacement[place];
        }
        system.conjugate_momentum(point, velocity, self.interval.t, momentum);
        for block in blocks(system) {
            for (slot, place) in block.slots().zip(block.places()) {
                residual[slot] = momentum[place] - self.p[place];
                mass.row(place, |column, entry| {
                    if entry != T::lift(0.0) {
                        let [first, _, number] = slots[column];
                        entries.add(slot, first + number, per_h * entry);
                    }
                });
            }
            if block.factor == Factor::Rotation {
                let (mean, p) = (Series::mean(-vector(displacement, block)), vector(self.p, block));
                let (turn, change) = (mean.of(&p) - p, mean.derivative(&p));
                for (row, slot) in block.slots().enumerate() {
                    residual[slot] -= turn[row];
                    (0..3).for_each(|column| entries.add(slot, block.slot + column, change[(row, column)]));
                }
            }
        }
    }

    /// Sets `p` to the momentum at the end of the displacement.
    #[inline]
    pub(super) fn balance(
        &self,
        displacement: &[T],
        Tangents { node, .. }: &mut Tangents<S, T>,
        p: &mut [T],
        statistics: &mut Statistics,
    ) {
        let (system, path) = (self.system, self.path(displacement));
        for block in blocks(system) {
            depart(block, path, self.p, p);
        }
        if self.mass.is_some() && !has_spheres::<S, T>() {
            return;
        }
        for [c, weight] in nodes(self.rule, self.interval.h) {
            let forces = match self.mass {
                Some(_) => {
                    node.drift(system, path, self.interval.time(c), c);
                    Forces::Without
                }
                None => {
                    node.place(system, path, c);
                    let NodeWork { point, velocity, gradient, momentum } = &mut node.work;
                    system.gradient(point, velocity, self.interval.time(c), gradient, momentum);
                    statistics.gradients += 1;
                    Forces::Of
                }
            };
            for block in blocks(system) {
                push(block, path, &node.work, [c, weight], forces, p);
            }
        }
    }
}

impl<S: ManifoldLagrangian<T>, R: Rule, T: Real> Equations<S, T> for Begin<'_, S, R, T> {
    /// Angles are judged as they are.
    #[inline]
    fn size(&self, block: Block, displacement: &[T]) -> T {
        match block.factor {
            Factor::Line => block.places().fold(T::lift(0.0), |largest, place| {
                norm::larger(largest, Scalar::abs(self.q[place]) + Scalar::abs(displacement[place]))
            }),
            Factor::Rotation | Factor::Sphere => T::lift(1.0),
        }
    }

    #[inline]
    fn given(&self) -> &[T] {
        self.p
    }

    /// The residual is −D₁L_d − p0, or that of a [drift](Begin::linearize_drift).
    #[inline]
    fn linearize<K: Sink<T>>(
        &self,
        displacement: &[T],
        node: &mut Node<S, T>,
        residual: &mut [T],
        entries: &mut K,
        statistics: &mut Statistics,
    ) {
        let (system, path) = (self.system, self.path(displacement));
        if let Some(mass) = self.mass
            && !has_spheres::<S, T>()
        {
            return self.linearize_drift(mass, displacement, node, residual, entries);
        }
        residual.fill(T::lift(0.0));
        for block in blocks(system) {
            subtract_momentum(block, self.p, residual, || path.circle(block));
        }
        let Some(mass) = self.mass else {
            statistics.linearizations += self.rule.nodes().len() as u64;
            for [c, weight] in nodes(self.rule, self.interval.h) {
                node.place(system, path, c);
                node.add_second_derivatives(system, self.interval.time(c), weight, entries);
                node.bend(system, path, [c, weight], Forces::Of, entries);
                node.project_force(weight, residual);
                node.project_momentum(system, weight, residual);
            }
            return;
        };
        for [c, weight] in nodes(self.rule, self.interval.h) {
            node.drift(system, path, self.interval.time(c), c);
            node.add_kinetic(system, mass, weight, entries);
            node.bend(system, path, [c, weight], Forces::Without, entries);
            node.project_momentum(system, weight, residual);
        }
    }

    fn corrected(&self, block: Block, displacement: Vector3<T>, [along, across]: [T; 2]) -> Vector3<T> {
        let circle = GreatCircle::new(vector(self.q, block), displacement);
        circle.axis * (circle.angle - along) + circle.direction * across
    }
}
