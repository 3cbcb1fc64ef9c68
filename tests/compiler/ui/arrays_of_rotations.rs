//! Mistakes with arrays of rotations and of unit vectors.

use dvi_core::prelude::*;

#[lagrangian(coordinates(s[N][3]: S2), lagrangian = sum(0..N, |i| dot(s[i]).norm_squared()))]
struct DeclarationsS<const N: usize>;

#[lagrangian(coordinates(s[]: S2), lagrangian = sum(0..2, |i| dot(s[i]).norm_squared()))]
struct DeclarationsT;

#[lagrangian(coordinates(R[2]: SO3, omega_R), lagrangian = sum(0..2, |i| omega(R[i]).norm_squared()) + dot(omega_R).powi(2))]
struct DeclarationsV;

#[lagrangian(coordinates(s[3]: S2), lagrangian = sum(0..3, |i| dot(s[i]).norm_squared()) - s[3][2])]
struct UnitVectorsS;

#[lagrangian(coordinates(s[3]: S2), lagrangian = sum(0..3, |i| dot(s[i]).norm_squared()) - s[0][3])]
struct UnitVectorsT;

#[lagrangian(coordinates(s[3]: S2), lagrangian = sum(0..3, |i| dot(s[i]).norm_squared()) - s[0])]
struct UnitVectorsV;

#[lagrangian(coordinates(R[2]: SO3), lagrangian = omega(R).norm_squared())]
struct RotationsS;

#[lagrangian(coordinates(R[2]: SO3), lagrangian = sum(0..2, |i| omega(R[i]).norm_squared()) - R[0][2])]
struct RotationsT;

#[lagrangian(coordinates(R[2]: SO3), lagrangian = sum(0..2, |i| omega(R[i]).norm_squared()) - R[2][0][0])]
struct RotationsW;

#[lagrangian(coordinates(s[3]: S2), lagrangian = sum(0..2, |i| dot(s[i]).norm_squared()))]
struct MassesS;

#[lagrangian(coordinates(R[n]: SO3), lagrangian = sum(0..n, |i| omega(R[i])[0].powi(2) + omega(R[i])[1].powi(2)))]
struct MassesT {
    n: usize,
}

#[lagrangian(coordinates(R[3]: SO3, x), lagrangian = dot(x).powi(2) - sum(0..3, |i| R[i][2][2]))]
struct MassesU;

fn main() {}
