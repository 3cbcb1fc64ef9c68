//! A node of a step: where L is evaluated on the geodesic of a displacement, and how that varies with its
//! ends.

use core::fmt::Debug;

use nalgebra::{Matrix3, Vector3};

use super::memory::MassRows;
use super::variation::{Between, Slots, Variation, slots};
use crate::discrete::NodeWork;
use crate::mechanics::manifold::sphere::GreatCircle;
use crate::mechanics::manifold::{Block, blocks, fill, vector};
use crate::space::{RowMatrix, Sink};
use crate::system::Factor;
use crate::{ManifoldLagrangian, Real, System, Weights};

/// A node, with L evaluated there.
#[derive(Debug)]
pub(super) struct Node<S: System, T: Real> {
    pub(super) work: NodeWork<S, T>,
    /// With the first point of the step, where the last one is held, and the sign changed: what D₁L_d is
    /// made with.
    pub(super) first: Variation<S, T>,
    /// With the displacement.
    pub(super) displacement: Variation<S, T>,
    pub(super) slots: Slots<S>,
}

/// Whether the derivative of L by the point counts at a node.
#[derive(Clone, Copy, Debug)]
pub(super) enum Forces {
    Of,
    Without,
}

/// The interval of a node from `q`, along `displacement`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Path<'a, T> {
    pub(super) q: &'a [T],
    pub(super) displacement: &'a [T],
    pub(super) h: T,
}

impl<T: Real> Path<'_, T> {
    /// The great circle of a unit vector.
    #[inline]
    pub(super) fn circle(&self, block: Block) -> GreatCircle<T> {
        GreatCircle::new(vector(self.q, block), vector(self.displacement, block))
    }
}

impl<S: ManifoldLagrangian<T>, T: Real> Node<S, T> {
    pub(super) fn new(system: &S) -> Self {
        Self {
            work: NodeWork::new(system),
            first: Variation::new(system),
            displacement: Variation::new(system),
            slots: slots(system),
        }
    }

    /// Goes to the part `c` of a step, with all that varies there.
    #[inline]
    pub(super) fn place(&mut self, system: &S, path: Path<'_, T>, c: T) {
        self.swing(system, path, c);
        for block in blocks(system) {
            match block.factor {
                Factor::Line => self.stand_on_line(block, path, c),
                Factor::Rotation => self.stand_on_rotations(block, path, c),
                Factor::Sphere => self.stand_on_sphere(block, path, c),
            }
        }
    }

    /// Goes to the part `c` of a step, at time `t`, with the velocity and ∂L/∂v alone, of a separable L.
    #[inline]
    pub(super) fn drift(&mut self, system: &S, path: Path<'_, T>, t: T, c: T) {
        self.swing(system, path, c);
        let NodeWork { point, velocity, momentum, .. } = &mut self.work;
        system.conjugate_momentum(point, velocity, t, momentum);
    }

    /// Sets the velocity at the part `c` of a step, and how it varies.
    #[inline]
    fn swing(&mut self, system: &S, path: Path<'_, T>, c: T) {
        for block in blocks(system) {
            match block.factor {
                Factor::Line => self.swing_on_line(block, path),
                Factor::Rotation => self.swing_on_rotations(block, path),
                Factor::Sphere => self.swing_on_sphere(block, path, c),
            }
        }
    }

    /// Adds `weight` times what the derivatives of L are multiplied with in D₁L_d, varied with the
    /// displacement, to the rows and columns of `sink`, after L was evaluated at [`place`](Self::place); of
    /// ∂L/∂v alone where `forces` are none.
    #[inline]
    pub(super) fn bend<K: Sink<T>>(
        &self,
        system: &S,
        path: Path<'_, T>,
        [c, weight]: [T; 2],
        forces: Forces,
        sink: &mut K,
    ) {
        for block in blocks(system) {
            let change = match block.factor {
                Factor::Line => continue,
                Factor::Rotation => self.bend_of_rotation(block, path, c, forces),
                Factor::Sphere => {
                    let force = match forces {
                        Forces::Of => vector(&self.work.gradient, block),
                        Forces::Without => Vector3::zeros(),
                    };
                    let momentum = vector(&self.work.momentum, block) / path.h;
                    path.circle(block).bend(c, [force, momentum]).fixed_resize::<3, 3>(T::lift(0.0))
                }
            };
            for row in 0..block.dimension() {
                for column in 0..block.dimension() {
                    sink.add(block.slot + row, block.slot + column, weight * change[(row, column)]);
                }
            }
        }
    }

    /// Evaluates L with its derivatives, and adds `weight` times the second ones, by the first point and the
    /// displacement.
    #[inline]
    pub(super) fn add_second_derivatives<K: Sink<T>>(&mut self, system: &S, t: T, weight: T, sink: &mut K) {
        let Self { work: NodeWork { point, velocity, gradient, momentum }, first, displacement, slots } =
            self;
        let none = Weights::none();
        let all = [
            (&first.point, &displacement.point, Weights { qq: weight, ..none }),
            (&first.velocity, &displacement.velocity, Weights { vv: weight, ..none }),
            (&first.point, &displacement.velocity, Weights { qv: weight, ..none }),
            (&first.velocity, &displacement.point, Weights { vq: weight, ..none }),
        ];
        // Where M is constant, positions and velocities do not mix.
        let mixed = if S::CONSTANT_MASS { 2 } else { 4 };
        for &(left, right, weights) in &all[..mixed] {
            let mut between = Between::<S, T, K> { left, right, slots, sink };
            system.linearize(point, velocity, t, weights, gradient, momentum, &mut between);
        }
    }

    /// Adds `weight` times the second derivatives of ½ v·M v.
    #[inline]
    pub(super) fn add_kinetic<K: Sink<T>>(&self, system: &S, mass: &MassRows<S, T>, weight: T, to: &mut K) {
        let Self { first, displacement, slots, .. } = self;
        let (left, right) = (&first.velocity, &displacement.velocity);
        let mut between = Between::<S, T, K> { left, right, slots, sink: to };
        for row in blocks(system).flat_map(Block::velocities) {
            mass.row(row, |column, entry| {
                if entry != T::lift(0.0) {
                    between.add(row, column, weight * entry);
                }
            });
        }
    }

    /// Adds the mass matrix of the tangent vectors at a point, and leaves ∂L/∂v.
    pub(super) fn add_mass<K: Sink<T>>(&mut self, system: &S, [q, v]: [&[T]; 2], t: T, sink: &mut K) {
        self.rest(system, q, v);
        let Self { work: NodeWork { point, velocity, gradient, momentum }, first, slots, .. } = self;
        let mut between = Between::<S, T, K> { left: &first.velocity, right: &first.velocity, slots, sink };
        system.linearize(point, velocity, t, Weights::mass(), gradient, momentum, &mut between);
    }

    /// Makes the tangent vectors at a point those of its velocities: for p = ∂L/∂v.
    fn rest(&mut self, system: &S, q: &[T], v: &[T]) {
        let (one, set) = (T::lift(1.0), Variation::<S, T>::set);
        self.work.point.copy_from_slice(q);
        self.work.velocity.copy_from_slice(v);
        for block in blocks(system) {
            match block.factor {
                Factor::Line => {
                    fill(&mut self.first.velocity, block, [one, T::lift(0.0), T::lift(0.0)]);
                }
                Factor::Rotation => {
                    block.places().skip(3).for_each(|place| self.work.velocity[place] = T::lift(0.0));
                    set(&mut self.first.velocity, block, &Matrix3::identity());
                }
                Factor::Sphere => {
                    let circle = GreatCircle::new(vector(q, block), Vector3::zeros());
                    let columns = [circle.direction, circle.axis, Vector3::zeros()];
                    set(&mut self.first.velocity, block, &Matrix3::from_columns(&columns));
                }
            }
        }
    }

    /// Adds `factor` times the derivative of L by the point, by the variation of that, to `sum`.
    #[inline]
    pub(super) fn project_force(&self, factor: T, sum: &mut [T]) {
        let rows = self.work.gradient.iter().zip(self.first.point.iter());
        for (&[slot, count, _], (&l_q, by_point)) in self.slots.iter().zip(rows) {
            for (sum, &entry) in sum[slot..slot + count].iter_mut().zip(by_point) {
                *sum += factor * (l_q * entry);
            }
        }
    }

    /// Adds `factor` times ∂L/∂v by the variation of the velocity to `sum`.
    #[inline]
    pub(super) fn project_momentum(&self, system: &S, factor: T, sum: &mut [T]) {
        for place in blocks(system).flat_map(Block::velocities) {
            let ([slot, count, _], l_v) = (self.slots[place], self.work.momentum[place]);
            for (sum, &entry) in sum[slot..slot + count].iter_mut().zip(&self.first.velocity[place]) {
                *sum += factor * (l_v * entry);
            }
        }
    }
}
