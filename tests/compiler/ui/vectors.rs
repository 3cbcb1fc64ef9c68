//! Vectors.

use dvi_core::prelude::*;

#[lagrangian(coordinates(r[N][3]), lagrangian = sum(0..N, |i| dot(r[i]).norm_squared() + r[i] + 1.0))]
struct SumWithNumber<const N: usize>;

#[lagrangian(
    coordinates(r[3], q[2]),
    lagrangian = dot(r).norm_squared() + dot(q).norm_squared() - (r - q).norm() - r.dot(q) - r.dot(2.0),
)]
struct OtherLengths;

#[lagrangian(
    coordinates(q[2], w[4]),
    lagrangian = dot(q).norm_squared() + dot(w).norm_squared() + q.cross(dot(q)) - w.cross(w)[0],
)]
struct CrossInThePlane;

#[lagrangian(
    coordinates(r[N][3]),
    lagrangian = sum(0..N, |i| dot(r[i]).norm_squared() - r[i][3] - r[i][i] - r[i][0][1])
        + { let gap = r[0] - r[1]; gap[3] + gap[0][0] },
)]
struct IndexOfComponent<const N: usize>;

#[lagrangian(coordinates(r[3]), lagrangian = dot(r))]
struct VectorForLagrangian;

#[lagrangian(
    coordinates(r[3]),
    lagrangian = dot(r).norm_squared() - r.sin() - r.powi(2) - r.length() - r.normalize()[0] - r.dot(),
)]
struct MethodsOfNumbers;

#[lagrangian(
    coordinates(r[3], x),
    lagrangian = dot(r).norm_squared() + dot(x).powi(2) - x.norm() - x.norm_squared() - x.dot(r) - x.atan2(r),
)]
struct MethodsOfVectors;

#[lagrangian(coordinates(r[3], q[3]), lagrangian = dot(r) * dot(r) + dot(q).norm_squared() - 1.0 / q - q / r)]
struct ProductOfTwoVectors;

#[lagrangian(
    coordinates(r[3]),
    lagrangian = dot(r).norm_squared() - if r < 1.0 { 1.0 } else { r } - if t < 1.0 { r } else { [0.0, 1.0] }[0],
)]
struct ChoicesOfVectors;

#[lagrangian(
    coordinates(r[N][3]),
    lagrangian = sum(0..N, |i| dot(r[i]).norm_squared()) - r.norm() - dot(r).norm() - r.x[0] - r[0].y,
)]
struct WholeArray<const N: usize>;

#[lagrangian(
    coordinates(r[3]),
    lagrangian = dot(r).norm_squared() - [1.0][0] - product(0..2, |i| r) - dot(r, r) - dot(2.0 * r)[0],
)]
struct ListsAndProducts;

#[lagrangian(coordinates(x[n]), lagrangian = sum(0..n, |i| dot(x[i]).powi(2)) - x.norm() - x.dot(x) - norm(x))]
struct LongArray {
    n: usize,
}

#[lagrangian(coordinates(r[4][1], q[2][3][3], p[2][]), lagrangian = dot(r[0]).norm_squared())]
struct Declared;

#[lagrangian(
    coordinates(r[N][3], q[3]),
    lagrangian = sum(0..N, |i| dot(r[i]).norm_squared()) + dot(q).norm_squared(),
    force(r) = |i| -friction,
    force(q) = [1.0, 2.0],
    momenta(p = sum(0..N, |i| dot(r[i]))),
)]
struct Acting<const N: usize> {
    friction: f64,
}

#[degenerate_lagrangian(coordinates(r[2]), one_form = [r], hamiltonian = r.norm_squared(), gauge = r)]
struct VectorsElsewhere;

#[lagrangian(coordinates(r[N][3]), lagrangian = m.dot(r[0]))]
struct NoKineticEnergy<const N: usize> {
    m: [f64; 3],
}

fn main() {
    let _ = SumWithNumberState { r: [[0.0; 3]; 2], dot_r: [[0.0; 3]; 2] };
    let _ = OtherLengthsState { r: [0.0; 3], q: [0.0; 2], dot_r: [0.0; 3], dot_q: [0.0; 2] };
    let _ = ActingState { r: [[0.0; 3]; 2], q: [0.0; 3], dot_r: [[0.0; 3]; 2], dot_q: [0.0; 3] };
}
