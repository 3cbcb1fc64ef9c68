//! Configuration spaces with rotations and unit vectors: the product of ℝⁿ, of SO(3) and of S², a block of
//! coordinates each. An array of rotations or unit vectors is as many blocks, whose coordinates stand as
//! those of vectors do: all first entries before all second ones.
//!
//! A displacement has a place for each coordinate, as velocities have: of a rotation the first three hold
//! the rotation vector u in the body, R ↦ R exp(û); of a unit vector they hold the rotation vector w in
//! space, at right angles to it, s ↦ exp(ŵ) s. Along such a displacement times c, 0 ≤ c ≤ 1, both move on
//! geodesics with constant speed.

pub(crate) mod rotation;
pub(crate) mod series;
pub(crate) mod sphere;

use nalgebra::{Matrix3, Quaternion, Vector3, Vector4};

use crate::error::StartError;
use crate::scalar::{carries_derivatives, norm};
use crate::system::{Factor, ManifoldSystem};
use crate::{Real, Scalar};

pub(crate) use crate::system::blocks::{Block, blocks};

/// The three numbers at these places.
#[inline]
pub(crate) fn vector<T: Real>(numbers: &[T], block: Block) -> Vector3<T> {
    Vector3::from(block.vector().map(|place| numbers[place]))
}

/// Sets the three numbers at these places.
#[inline]
pub(crate) fn set<T: Real>(numbers: &mut [T], block: Block, value: Vector3<T>) {
    block.vector().into_iter().zip(value.iter()).for_each(|(place, &value)| numbers[place] = value);
}

/// Sets all numbers of a block.
#[inline]
pub(crate) fn fill<T: Copy>(numbers: &mut [T], block: Block, value: T) {
    block.places().for_each(|place| numbers[place] = value);
}

/// Copies the numbers of a block.
#[inline]
pub(crate) fn copy<T: Copy>(from: &[T], block: Block, to: &mut [T]) {
    block.places().for_each(|place| to[place] = from[place]);
}

/// The matrix with the numbers of a block, row by row.
#[inline]
pub(crate) fn matrix<T: Real>(numbers: &[T], block: Block) -> Matrix3<T> {
    Matrix3::from_fn(|row, column| numbers[block.place(3 * row + column)])
}

/// Sets the numbers of a block to the entries of a matrix, row by row.
#[inline]
pub(crate) fn set_matrix<T: Real>(numbers: &mut [T], block: Block, matrix: &Matrix3<T>) {
    for row in 0..3 {
        for column in 0..3 {
            numbers[block.place(3 * row + column)] = matrix[(row, column)];
        }
    }
}

/// What a run carries of the coordinates: of a rotation a quaternion, in the first four places, of a unit
/// vector one along it. Their lengths say nothing, so that rounding errors of many steps do not lead off the
/// manifold.
pub(crate) fn lift<S: ManifoldSystem, T: Real>(system: &S, q: &[T], lifted: &mut [T]) {
    lifted.copy_from_slice(q);
    for block in blocks(system).filter(|block| block.factor == Factor::Rotation) {
        fill(lifted, block, T::lift(0.0));
        set_quaternion(lifted, block, &rotation::quaternion(&matrix(q, block)));
    }
}

/// Sets the coordinates to those that belong to what is carried.
#[inline]
pub(crate) fn lower<S: ManifoldSystem, T: Real>(system: &S, lifted: &[T], q: &mut [T]) {
    for block in blocks(system) {
        match block.factor {
            Factor::Line => copy(lifted, block, q),
            Factor::Rotation => {
                set_matrix(q, block, &rotation::of_quaternion(&quaternion(lifted, block)));
            }
            Factor::Sphere => {
                let along = vector(lifted, block);
                set(q, block, along / along.norm());
            }
        }
    }
}

/// The quaternion that is carried of a rotation.
#[inline]
pub(crate) fn quaternion<T: Real>(lifted: &[T], block: Block) -> Quaternion<T> {
    Quaternion::from(Vector4::from_fn(|number, _| lifted[block.place(number)]))
}

/// Sets what is carried, or is added to it, of a rotation.
#[inline]
pub(crate) fn set_quaternion<T: Real>(lifted: &mut [T], block: Block, quaternion: &Quaternion<T>) {
    quaternion.coords.iter().enumerate().for_each(|(number, &entry)| lifted[block.place(number)] = entry);
}

/// Whether a state is on the manifold, and its velocity tangent to it.
///
/// # Errors
/// [`StartError::OffManifold`] with the first block that is not; [`StartError::Unsupported`] in numbers with
/// derivatives if a unit vector rests, where the direction of a great circle has none.
pub(crate) fn check<S: ManifoldSystem, T: Real>(system: &S, [q, v]: [&[T]; 2]) -> Result<(), StartError> {
    for block in blocks(system) {
        let defect = match block.factor {
            Factor::Line => continue,
            Factor::Rotation => rotation::defect(&matrix(q, block)),
            Factor::Sphere => {
                let (s, rate) = (vector(q, block), vector(v, block));
                let option = "a unit vector that rests at the start, in numbers with derivatives";
                let reason = "its great circle has no direction to be differentiated there; begin with a \
                              small velocity";
                let goes = !carries_derivatives::<T>() || rate != Vector3::zeros();
                StartError::unless_it(goes, option, reason)?;
                // 0 of a velocity that is zero.
                let along = Scalar::abs(s.dot(&rate)).over_root(rate.norm());
                norm::larger(Scalar::abs(s.dot(&s) - T::lift(1.0)), along)
            }
        };
        block.check(defect)?;
    }
    Ok(())
}
