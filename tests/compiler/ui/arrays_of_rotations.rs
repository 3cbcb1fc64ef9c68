//! Mistakes with arrays of rotations and of unit vectors.

use dvi_core::prelude::*;

mod declarations {
    use super::*;

    #[lagrangian(coordinates(s[N][3]: S2), lagrangian = sum(0..N, |i| dot(s[i]).norm_squared()))]
    struct S<const N: usize>;

    #[lagrangian(coordinates(s[]: S2), lagrangian = sum(0..2, |i| dot(s[i]).norm_squared()))]
    struct T;

    #[lagrangian(coordinates(R[M]: SO3), lagrangian = sum(0..M, |i| omega(R[i]).norm_squared()))]
    struct U<const N: usize>;

    #[lagrangian(coordinates(R[2]: SO3, omega_R), lagrangian = sum(0..2, |i| omega(R[i]).norm_squared()) + dot(omega_R).powi(2))]
    struct V;
}

mod unit_vectors {
    use super::*;

    #[lagrangian(coordinates(s[3]: S2), lagrangian = sum(0..3, |i| dot(s[i]).norm_squared()) - s[3][2])]
    struct S;

    #[lagrangian(coordinates(s[3]: S2), lagrangian = sum(0..3, |i| dot(s[i]).norm_squared()) - s[0][3])]
    struct T;

    #[lagrangian(coordinates(s[3]: S2), lagrangian = dot(s).norm_squared())]
    struct U;

    #[lagrangian(coordinates(s[3]: S2), lagrangian = sum(0..3, |i| dot(s[i]).norm_squared()) - s[0])]
    struct V;

    #[lagrangian(coordinates(s[3]: S2), lagrangian = sum(0..3, |i| dot(s[i]).norm_squared()) - s[0] * s[1])]
    struct W;

    #[lagrangian(coordinates(s[3]: S2), lagrangian = sum(0..3, |i| d(s[i]).norm_squared()))]
    struct X;

    #[lagrangian(coordinates(s[3]: S2), lagrangian = sum(0..3, |i| sum(0..N, |k| dot(s[i][k]).powi(2))))]
    struct Y<const N: usize>;

    #[lagrangian(coordinates(s[3]: S2), lagrangian = sum(0..3, |i| dot(s[i]).norm_squared() - dot_s[i][0]))]
    struct Z;
}

mod rotations {
    use super::*;

    #[lagrangian(coordinates(R[2]: SO3), lagrangian = omega(R).norm_squared())]
    struct S;

    #[lagrangian(coordinates(R[2]: SO3), lagrangian = sum(0..2, |i| omega(R[i]).norm_squared()) - R[0][2])]
    struct T;

    #[lagrangian(coordinates(R[2]: SO3), lagrangian = sum(0..2, |i| omega(R[i]).norm_squared()) - R[0].column(3)[2])]
    struct U;

    #[lagrangian(coordinates(R[2]: SO3), lagrangian = sum(0..2, |i| omega(R[i]).norm_squared()) - R.column(0)[2])]
    struct V;

    #[lagrangian(coordinates(R[2]: SO3), lagrangian = sum(0..2, |i| omega(R[i]).norm_squared()) - R[2][0][0])]
    struct W;

    #[lagrangian(coordinates(R[2]: SO3), lagrangian = sum(0..2, |i| omega(R[i]).norm_squared() - dot(R[i][0][0])))]
    struct X;

    #[lagrangian(coordinates(R[2]: SO3, s[2]: S2), lagrangian = sum(0..2, |i| omega(R[i]).norm_squared() + omega(s[i]).norm_squared()))]
    struct Y;

    #[lagrangian(coordinates(R[2]: SO3), lagrangian = sum(0..2, |i| omega_R[i].norm_squared()) + R[0][0][0][0])]
    struct Z;
}

mod masses {
    use super::*;

    #[lagrangian(coordinates(s[3]: S2), lagrangian = sum(0..2, |i| dot(s[i]).norm_squared()))]
    struct S;

    #[lagrangian(coordinates(R[n]: SO3), lagrangian = sum(0..n, |i| omega(R[i])[0].powi(2) + omega(R[i])[1].powi(2)))]
    struct T {
        n: usize,
    }

    #[lagrangian(coordinates(R[3]: SO3, x), lagrangian = dot(x).powi(2) - sum(0..3, |i| R[i][2][2]))]
    struct U;

    #[lagrangian(coordinates(R[3]: SO3), lagrangian = sum(0..2, |i| omega(R[i]).norm_squared()))]
    struct V;
}

mod beside {
    use super::*;

    #[lagrangian(
        coordinates(s[N]: S2),
        lagrangian = sum(0..N, |i| dot(s[i]).norm_squared()),
        constraint = s[0][2] - 0.5,
    )]
    struct S<const N: usize>;

    #[lagrangian(
        coordinates(s[N]: S2),
        lagrangian = sum(0..N, |i| dot(s[i]).norm_squared()),
        force(s) = |i| -dot(s[i]),
    )]
    struct T<const N: usize>;
}

fn main() {}
