//! Rotation matrices: SO(3).

use nalgebra::{Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector3};

use super::series::lambda;
use crate::scalar::norm;
use crate::{Real, Scalar};

/// A quaternion of a rotation.
pub(crate) fn quaternion<T: Real>(rotation: &Matrix3<T>) -> Quaternion<T> {
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(*rotation)).into_inner()
}

/// The rotation of a quaternion of any length.
#[inline]
pub(crate) fn of_quaternion<T: Real>(quaternion: &Quaternion<T>) -> Matrix3<T> {
    let axis = quaternion.imag();
    let once = axis.cross_matrix();
    let scale = T::lift(2.0) / quaternion.norm_squared();
    Matrix3::identity() + (once * quaternion.w + once * once) * scale
}

/// What a turn by u in the body adds to a quaternion of the length one.
#[inline]
pub(crate) fn increment<T: Real>(quaternion: &Quaternion<T>, u: Vector3<T>) -> Quaternion<T> {
    let half = u * T::lift(0.5);
    let square = half.dot(&half);
    let [sine, versine] = lambda::<1, 2, T>(square);
    quaternion * Quaternion::from_parts(-square * versine, half * sine)
}

/// f with f·η = A : R η̂, from M = RᵀA: what a derivative A with respect to the entries of R is as a torque
/// in the body.
#[inline]
pub(crate) fn torque<T: Real>(m: &Matrix3<T>) -> Vector3<T> {
    Vector3::new(m[(2, 1)] - m[(1, 2)], m[(0, 2)] - m[(2, 0)], m[(1, 0)] - m[(0, 1)])
}

/// How that torque changes with η where A is the same: ∂fᵢ/∂ηⱼ = A : R êⱼ êᵢ = Mᵢⱼ − δᵢⱼ tr M.
#[inline]
pub(crate) fn torque_change<T: Real>(m: &Matrix3<T>) -> Matrix3<T> {
    m - Matrix3::identity() * m.trace()
}

/// How far a matrix is from a rotation: max |RᵀR − 1|, or 2 if it is a reflection.
pub(crate) fn defect<T: Real>(rotation: &Matrix3<T>) -> T {
    let difference = rotation.transpose() * rotation - Matrix3::identity();
    if rotation.determinant() < T::lift(0.0) {
        return T::lift(2.0);
    }
    let sum = difference.iter().fold(T::lift(0.0), |sum, &entry| sum + Scalar::abs(entry));
    // A sum sees what is no number.
    if sum.is_finite() { norm::largest(difference.as_slice()) } else { sum }
}
