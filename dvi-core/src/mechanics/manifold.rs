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

use core::ops::Range;

use nalgebra::{Matrix3, Quaternion, Vector3, Vector4};

use crate::error::StartError;
use crate::scalar::carries_derivatives;
use crate::scalar::norm::{self, reported};
use crate::system::CoordinateBlock;
use crate::system::manifold::TOLERANCE;
use crate::system::{Axis, Factor, ManifoldSystem};
use crate::{Real, Scalar};

/// Where the numbers of a block of coordinates stand.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Block {
    pub(crate) name: &'static str,
    /// Its number in an array of rotations or unit vectors.
    pub(crate) index: Option<usize>,
    pub(crate) factor: Factor,
    /// The place of its first coordinate, and how far from each other they are.
    at: usize,
    stride: usize,
    coordinates: usize,
    /// Its first tangent vector in a basis of the tangent space.
    pub(crate) slot: usize,
}

impl Block {
    /// The place of its coordinate of this number.
    fn place(self, number: usize) -> usize {
        self.at + number * self.stride
    }

    /// The places of its coordinates.
    pub(crate) fn places(self) -> impl Iterator<Item = usize> {
        (0..self.coordinates).map(move |number| self.place(number))
    }

    /// The places of its velocities.
    pub(crate) fn velocities(self) -> impl Iterator<Item = usize> {
        (0..self.factor.velocities(self.coordinates)).map(move |number| self.place(number))
    }

    /// The places of the first three coordinates, of a rotation or a unit vector.
    pub(crate) fn vector(self) -> [usize; 3] {
        [0, 1, 2].map(|number| self.place(number))
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
pub(crate) fn blocks<S: ManifoldSystem>(system: &S) -> Blocks<'_, S> {
    Blocks { system, number: 0, index: 0, at: 0, slot: 0 }
}

/// Stands before a block. As a chain of adapters, a step of a heavy top takes 400 instructions more
/// (`cargo bench -p dvi-kernels --bench instructions`).
pub(crate) struct Blocks<'a, S> {
    system: &'a S,
    /// The coordinates as they are declared, and the number in an array of these.
    number: usize,
    index: usize,
    /// The first place of what is declared, and the next tangent vector.
    at: usize,
    slot: usize,
}

impl<S: ManifoldSystem> Iterator for Blocks<'_, S> {
    type Item = Block;

    #[inline]
    fn next(&mut self) -> Option<Block> {
        loop {
            let &CoordinateBlock { name, axis, factor, .. } = S::REPORT.coordinates.get(self.number)?;
            let len = self.system.block_len(self.number);
            // An array has its first coordinates in the first of the blocks that are declared.
            let (count, coordinates, stride) = match axis {
                Some(Axis { number: 0, of }) if factor != Factor::Line => (len, usize::from(of), len),
                Some(Axis { .. }) if factor != Factor::Line => (0, 0, len),
                Some(Axis { .. }) | None => (1, len, 1),
            };
            if self.index == count {
                (self.number, self.index, self.at) = (self.number + 1, 0, self.at + len);
                continue;
            }
            let index = axis.filter(|_| factor != Factor::Line).map(|_| self.index);
            let (at, slot) = (self.at + self.index, self.slot);
            let block = Block { name, index, factor, at, stride, coordinates, slot };
            self.index += 1;
            self.slot += block.dimension();
            return Some(block);
        }
    }
}

/// The three numbers at these places.
pub(crate) fn vector<T: Real>(numbers: &[T], block: Block) -> Vector3<T> {
    Vector3::from(block.vector().map(|place| numbers[place]))
}

/// Sets the three numbers at these places.
pub(crate) fn set<T: Real>(numbers: &mut [T], block: Block, value: Vector3<T>) {
    block.vector().into_iter().zip(value.iter()).for_each(|(place, &value)| numbers[place] = value);
}

/// Sets all numbers of a block.
pub(crate) fn fill<T: Copy>(numbers: &mut [T], block: Block, value: T) {
    block.places().for_each(|place| numbers[place] = value);
}

/// Copies the numbers of a block.
pub(crate) fn copy<T: Copy>(from: &[T], block: Block, to: &mut [T]) {
    block.places().for_each(|place| to[place] = from[place]);
}

/// The matrix with the numbers of a block, row by row.
pub(crate) fn matrix<T: Real>(numbers: &[T], block: Block) -> Matrix3<T> {
    Matrix3::from_fn(|row, column| numbers[block.place(3 * row + column)])
}

/// Sets the numbers of a block to the entries of a matrix, row by row.
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
pub(crate) fn quaternion<T: Real>(lifted: &[T], block: Block) -> Quaternion<T> {
    Quaternion::from(Vector4::from_fn(|number, _| lifted[block.place(number)]))
}

/// Sets what is carried, or is added to it, of a rotation.
pub(crate) fn set_quaternion<T: Real>(lifted: &mut [T], block: Block, quaternion: &Quaternion<T>) {
    quaternion.coords.iter().enumerate().for_each(|(number, &entry)| lifted[block.place(number)] = entry);
}

/// Whether a state is on the manifold, and its velocity tangent to it.
///
/// # Errors
/// [`StartError::OffManifold`] with the first block that is not.
pub(crate) fn check<S: ManifoldSystem, T: Real>(system: &S, [q, v]: [&[T]; 2]) -> Result<(), StartError> {
    let tolerance = T::lift(TOLERANCE) * T::default_epsilon();
    for block in blocks(system) {
        let defect = match block.factor {
            Factor::Line => continue,
            Factor::Rotation => rotation::defect(&matrix(q, block)),
            Factor::Sphere => {
                let (s, rate) = (vector(q, block), vector(v, block));
                // 0 of a velocity that is zero.
                let along = Scalar::abs(s.dot(&rate)).over_root(rate.norm());
                norm::larger(Scalar::abs(s.dot(&s) - T::lift(1.0)), along)
            }
        };
        let is_small = defect <= tolerance;
        if !is_small {
            let (defect, tolerance) = (reported(defect), reported(tolerance));
            return Err(StartError::OffManifold {
                block: block.name,
                index: block.index,
                defect,
                tolerance,
            });
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
