//! Configuration spaces with rotations and unit vectors: the product of ℝⁿ, of SO(3) and of S², a block of
//! coordinates each.
//!
//! A displacement has a place for each coordinate, as velocities have: of a rotation the first three hold
//! the rotation vector u in the body, R ↦ R exp(û); of a unit vector they hold the rotation vector w in
//! space, at right angles to it, s ↦ exp(ŵ) s. Along such a displacement times c, 0 ≤ c ≤ 1, both move on
//! geodesics with constant speed.

pub(crate) mod rotation;
pub(crate) mod series;
pub(crate) mod sphere;

use core::ops::Range;

use nalgebra::{Quaternion, Vector3, Vector4};

use crate::error::StartError;
use crate::scalar::carries_derivatives;
use crate::scalar::norm::{self, reported};
use crate::system::{Factor, ManifoldSystem};
use crate::{Real, Scalar};

/// Where the numbers of a block of coordinates stand.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Block {
    pub(crate) name: &'static str,
    pub(crate) factor: Factor,
    /// Its first coordinate.
    at: usize,
    coordinates: usize,
    /// Its first tangent vector in a basis of the tangent space.
    pub(crate) slot: usize,
}

impl Block {
    /// The places of its coordinates.
    pub(crate) fn places(self) -> Range<usize> {
        self.at..self.at + self.coordinates
    }

    /// The places of its velocities.
    pub(crate) fn velocities(self) -> Range<usize> {
        self.at..self.at + self.factor.velocities(self.coordinates)
    }

    /// The places of the first three of them, of a rotation or a unit vector.
    pub(crate) fn vector(self) -> Range<usize> {
        self.at..self.at + 3
    }

    /// Its tangent vectors in that basis.
    pub(crate) fn slots(self) -> Range<usize> {
        self.slot..self.slot + self.dimension()
    }

    /// The number of its tangent vectors.
    pub(crate) fn dimension(self) -> usize {
        self.factor.dimension(self.coordinates)
    }
}

/// The blocks of coordinates of `system`.
pub(crate) fn blocks<S: ManifoldSystem>(system: &S) -> impl Iterator<Item = Block> {
    let (mut at, mut slot) = (0, 0);
    S::REPORT.coordinates.iter().enumerate().map(move |(number, declared)| {
        let coordinates = system.block_len(number);
        let block = Block { name: declared.name, factor: declared.factor, at, coordinates, slot };
        at += coordinates;
        slot += block.dimension();
        block
    })
}

/// The three numbers at these places.
pub(crate) fn vector<T: Real>(numbers: &[T], block: Block) -> Vector3<T> {
    Vector3::from_column_slice(&numbers[block.vector()])
}

/// Sets the three numbers at these places.
pub(crate) fn set<T: Real>(numbers: &mut [T], block: Block, value: Vector3<T>) {
    numbers[block.vector()].copy_from_slice(value.as_slice());
}

/// What a run carries of the coordinates: of a rotation a quaternion, in the first four places, of a unit
/// vector one along it. Their lengths say nothing, so that rounding errors of many steps do not lead off the
/// manifold.
pub(crate) fn lift<S: ManifoldSystem, T: Real>(system: &S, q: &[T], lifted: &mut [T]) {
    lifted.copy_from_slice(q);
    for block in blocks(system).filter(|block| block.factor == Factor::Rotation) {
        let quaternion = rotation::quaternion(&rotation::matrix(&q[block.places()]));
        let places = &mut lifted[block.places()];
        places.fill(T::lift(0.0));
        places[..4].copy_from_slice(quaternion.coords.as_slice());
    }
}

/// Sets the coordinates to those that belong to what is carried.
pub(crate) fn lower<S: ManifoldSystem, T: Real>(system: &S, lifted: &[T], q: &mut [T]) {
    for block in blocks(system) {
        match block.factor {
            Factor::Line => q[block.places()].copy_from_slice(&lifted[block.places()]),
            Factor::Rotation => {
                rotation::set(&mut q[block.places()], &rotation::of_quaternion(&quaternion(lifted, block)));
            }
            Factor::Sphere => {
                let along = vector(lifted, block);
                set(q, block, along / along.norm());
            }
        }
    }
}

/// The quaternion that is carried of a rotation.
pub(crate) fn quaternion<T: Real>(lifted: &[T], block: Block) -> Quaternion<T> {
    Quaternion::from(Vector4::from_column_slice(&lifted[block.places()][..4]))
}

/// How far a state may be off the manifold, in units of rounding.
const TOLERANCE: f64 = 4096.0;

/// Whether a state is on the manifold, and its velocity tangent to it.
///
/// # Errors
/// [`StartError::OffManifold`] with the first block that is not.
pub(crate) fn check<S: ManifoldSystem, T: Real>(system: &S, [q, v]: [&[T]; 2]) -> Result<(), StartError> {
    let tolerance = T::lift(TOLERANCE) * T::default_epsilon();
    for block in blocks(system) {
        let defect = match block.factor {
            Factor::Line => continue,
            Factor::Rotation => rotation::defect(&rotation::matrix(&q[block.places()])),
            Factor::Sphere => {
                let (s, rate) = (vector(q, block), vector(v, block));
                // 0 of a velocity that is zero.
                let along = Scalar::abs(s.dot(&rate)).over_root(rate.norm());
                norm::larger(Scalar::abs(s.dot(&s) - T::lift(1.0)), along)
            }
        };
        let is_small = defect <= tolerance;
        if !is_small {
            let (block, defect) = (block.name, reported(defect));
            return Err(StartError::OffManifold { block, defect, tolerance: reported(tolerance) });
        }
    }
    Ok(())
}

/// Whether a run can begin with a velocity `v` in numbers with derivatives.
///
/// # Errors
/// [`StartError::Unsupported`] if a unit vector rests, where the direction of a great circle has no
/// derivative.
pub(crate) fn admit_numbers<S: ManifoldSystem, T: Real>(system: &S, v: &[T]) -> Result<(), StartError> {
    let mut spheres = blocks(system).filter(|block| block.factor == Factor::Sphere);
    if carries_derivatives::<T>() && spheres.any(|block| vector(v, block) == Vector3::zeros()) {
        return Err(StartError::Unsupported {
            option: "a unit vector that rests at the start, in numbers with derivatives",
            reason: "its great circle has no direction to be differentiated there; begin with a small velocity",
        });
    }
    Ok(())
}
