//! What the blocks of coordinates do with displacements, velocities, momenta and torques: each factor of the
//! manifold in its own way.

use nalgebra::Vector3;

use super::node::{Forces, Path};
use crate::discrete::NodeWork;
use crate::mechanics::manifold::series::Series;
use crate::mechanics::manifold::sphere::GreatCircle;
use crate::mechanics::manifold::{
    Block, blocks, copy, fill, matrix, quaternion, rotation, set, set_quaternion, vector,
};
use crate::system::{Factor, ManifoldSystem};
use crate::{Real, System};

/// Sets `p` to ∂L/∂v as a covector of the manifold at `q`, from the derivative by the velocities; of a unit
/// vector to s × ∂L/∂ṡ. Rates of displacement are made of velocities in the same way.
pub(super) fn momentum<S: ManifoldSystem, T: Real>(system: &S, q: &[T], l_v: &[T], p: &mut [T]) {
    for block in blocks(system) {
        match block.factor {
            Factor::Line => copy(l_v, block, p),
            Factor::Rotation => {
                fill(p, block, T::lift(0.0));
                set(p, block, vector(l_v, block));
            }
            Factor::Sphere => set(p, block, torque(block, q, l_v)),
        }
    }
}

/// Sets `v` to the velocity at `q` of a motion with these rates of displacement.
#[inline]
pub(super) fn velocity<S: ManifoldSystem, T: Real>(system: &S, q: &[T], v: &mut [T]) {
    for block in blocks(system).filter(|block| block.factor == Factor::Sphere) {
        let rate = vector(v, block);
        set(v, block, rate.cross(&vector(q, block)));
    }
}

/// What a derivative by the coordinates is as a torque: in the body of a rotation, about the centre of a
/// unit vector.
#[inline]
fn torque<T: Real>(block: Block, q: &[T], l_q: &[T]) -> Vector3<T> {
    if block.factor == Factor::Sphere {
        return vector(q, block).cross(&vector(l_q, block));
    }
    rotation::torque(&(matrix(q, block).transpose() * matrix(l_q, block)))
}

/// Makes a force the covector of the manifold that it is at `q`.
#[inline]
pub(super) fn force<S: ManifoldSystem, T: Real>(system: &S, q: &[T], force: &mut [T]) {
    for block in blocks(system).filter(|block| block.factor != Factor::Line) {
        let torque = torque(block, q, force);
        fill(force, block, T::lift(0.0));
        set(force, block, torque);
    }
}

/// Subtracts a momentum from the residual, of a unit vector in the directions of a circle.
#[inline]
pub(super) fn subtract_momentum<T: Real>(
    block: Block,
    p: &[T],
    residual: &mut [T],
    circle: impl FnOnce() -> GreatCircle<T>,
) {
    match block.factor {
        Factor::Line | Factor::Rotation => {
            for (residual, place) in residual[block.slots()].iter_mut().zip(block.places()) {
                *residual -= p[place];
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

/// Sets what a displacement adds to what is carried of the coordinates.
#[inline]
pub(super) fn increment_of<T: Real>(block: Block, path: Path<'_, T>, lifted: &[T], increment: &mut [T]) {
    match block.factor {
        Factor::Line => copy(path.displacement, block, increment),
        Factor::Rotation => {
            let turn = rotation::increment(&quaternion(lifted, block), vector(path.displacement, block));
            set_quaternion(increment, block, &turn);
        }
        Factor::Sphere => set(increment, block, path.circle(block).increment()),
    }
}

/// Sets `p` to p0, seen from the end of the step.
#[inline]
pub(super) fn depart<T: Real>(block: Block, path: Path<'_, T>, p0: &[T], p: &mut [T]) {
    match block.factor {
        Factor::Line | Factor::Sphere => copy(p0, block, p),
        Factor::Rotation => {
            fill(p, block, T::lift(0.0));
            let back = Series::exp(-vector(path.displacement, block));
            set(p, block, back.of(&vector(p0, block)));
        }
    }
}

/// Adds what L at a node does to the momentum in the step, as it is seen from its end; ∂L/∂v alone, which
/// turns with unit vectors only, where `forces` are none.
#[inline]
pub(super) fn push<S: System, T: Real>(
    block: Block,
    path: Path<'_, T>,
    NodeWork { point, velocity, gradient, momentum }: &NodeWork<S, T>,
    [c, weight]: [T; 2],
    forces: Forces,
    p: &mut [T],
) {
    let seen = match (block.factor, forces) {
        (Factor::Line | Factor::Rotation, Forces::Without) => return,
        (Factor::Line, Forces::Of) => {
            for i in block.places() {
                p[i] += weight * gradient[i];
            }
            return;
        }
        (Factor::Rotation, Forces::Of) => {
            let rest = Series::exp(vector(path.displacement, block) * (c - T::lift(1.0)));
            rest.of(&torque(block, point, gradient))
        }
        (Factor::Sphere, forces) => {
            let turned: Vector3<T> = vector(velocity, block).cross(&vector(momentum, block));
            match forces {
                Forces::Of => torque(block, point, gradient) + turned,
                Forces::Without => turned,
            }
        }
    };
    let sum = vector(p, block) + seen * weight;
    set(p, block, sum);
}
