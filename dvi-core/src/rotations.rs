//! Rotation matrices as states have them: nine entries, row by row.

use nalgebra::{Matrix3, Vector3};

use crate::Real;
use crate::mechanics::manifold::rotation;
use crate::mechanics::manifold::series::Series;

/// The rotation about the direction of `u` by its length, in radians: exp(û).
///
/// ```
/// use dvi_core::rotations;
///
/// // A quarter turn about the third axis takes the first axis to the second.
/// let quarter = rotations::exp([0.0, 0.0, std::f64::consts::FRAC_PI_2]);
/// let [x, y, z] = rotations::apply(&quarter, [1.0, 0.0, 0.0]);
/// assert!(x.abs() < 1e-15 && (y - 1.0).abs() < 1e-15 && z == 0.0);
/// ```
pub fn exp<T: Real>(u: [T; 3]) -> [T; 9] {
    entries(&Series::exp(Vector3::from(u)).matrix())
}

/// The rotation by `second` after that by `first`: the product `second` · `first`.
pub fn product<T: Real>(second: &[T; 9], first: &[T; 9]) -> [T; 9] {
    entries(&(matrix(second) * matrix(first)))
}

/// The vector of space that `rotation` takes a vector of the body to.
pub fn apply<T: Real>(rotation: &[T; 9], of_body: [T; 3]) -> [T; 3] {
    (matrix(rotation) * Vector3::from(of_body)).into()
}

/// How far a matrix is from a rotation: max |RᵀR − 1| over its entries, or 2 if its determinant is negative.
pub fn defect<T: Real>(rotation: &[T; 9]) -> T {
    rotation::defect(&matrix(rotation))
}

fn matrix<T: Real>(entries: &[T; 9]) -> Matrix3<T> {
    Matrix3::from_row_slice(entries)
}

fn entries<T: Real>(matrix: &Matrix3<T>) -> [T; 9] {
    core::array::from_fn(|place| matrix[(place / 3, place % 3)])
}
