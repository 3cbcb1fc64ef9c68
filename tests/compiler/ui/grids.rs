//! Numbers with two indices.

use dvi_core::prelude::*;

#[lagrangian(
    coordinates(q[N][M]),
    lagrangian = sum(0..N, |i| sum(0..M, |j| dot(q[i][j]).powi(2) - q[i].powi(2) - q[i][j][0] - q[i][-1]))
        - q.powi(2) - dot(q) - sum(0..M, |j| q[j - 1][j]),
)]
struct NumberOfIndices<const N: usize, const M: usize>;

#[lagrangian(
    coordinates(q[4][20]),
    lagrangian = sum(0..4, |i| sum(0..20, |j| dot(q[i][j]).powi(2) - (q[i][j + 1] - q[i][j]).powi(2) - q[i + 1][j]))
        - q[0][20] - q[4][0],
)]
struct OutOfRange;

#[lagrangian(
    coordinates(q[N][M][2], p[N][], r[0][M], s[N][K], w[1000][2000]),
    lagrangian = dot(q[0][0]).powi(2),
)]
struct Sizes<const N: usize, const M: usize>;

#[lagrangian(
    coordinates(q[N][M], p[4]),
    lagrangian = sum(0..N, |i| sum(0..M, |j| dot(q[i][j]).powi(2))) + dot(p).norm_squared(),
    force(q) = |i| -dot(q[i][0]),
    force(p) = |i, j| -dot(p[i]),
)]
struct Forces<const N: usize, const M: usize>;

#[degenerate_lagrangian(
    coordinates(p[N][M], q[N][M]),
    one_form = [0.0, |i, j| p[i][j]],
    hamiltonian = sum(0..N, |i| sum(0..M, |j| q[i, j].powi(2))),
)]
struct Components<const N: usize, const M: usize>;

#[lagrangian(coordinates(q[n][m]), lagrangian = sum(0..n, |i| q[i][0].powi(2)))]
struct NoKineticEnergy {
    n: usize,
    m: usize,
}

fn main() {
    let _ = ForcesState { q: [[0.0; 3]; 2], p: [0.0; 4], dot_q: [[0.0; 3]; 2], dot_p: [0.0; 4] };
    let _ = NoKineticEnergyState { q: vec![vec![0.0; 3]; 2], dot_q: vec![vec![0.0; 3]; 2] };
}
