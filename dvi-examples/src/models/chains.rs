//! Chains: a pendulum of many links, springs that are stiff and soft in turn, molecules of three atoms, and a
//! lattice of Schrödinger's equation.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, FRAC_PI_6, TAU};

use dvi_core::error::StartError;
use dvi_core::prelude::*;

use super::joined;

/// n equal masses on equal rods without mass, one below the other: in all of mass 1 and length 1, with g =
/// 1.
#[lagrangian(
    coordinates(r[n][2]),
    lagrangian = sum(0..n, |i| dot(r[i]).norm_squared() / 2.0 - r[i][1]) / (n as f64),
    constraint = r[0].norm_squared() - 1.0 / (n as f64).powi(2),
    constraint(i in 1..n) = (r[i] - r[i - 1]).norm_squared() - 1.0 / (n as f64).powi(2),
)]
#[derive(Clone, Debug)]
pub struct Links {
    pub n: usize,
}

impl Links {
    pub fn rod(&self) -> f64 {
        1.0 / self.n as f64
    }

    /// At rest, with angles from the vertical that grow from zero at the pivot to `angle` at the end.
    pub fn bent(&self, angle: f64) -> LinksState {
        let theta = |i: f64| angle * i * self.rod();
        let r = joined(self.n, |i| [theta(i).sin(), -theta(i).cos()]);
        LinksState { r, dot_r: vec![[0.0; 2]; self.n] }
    }
}

/// 2m equal masses between two walls (Hairer, Lubich & Wanner 2006, section I.5.1). Masses 2i and 2i + 1 are
/// joined by a stiff linear spring; the springs between these pairs and to the walls are soft, with the
/// potential r⁴. So x = (q_{2i+1} − q_{2i})/√2 is an oscillator of frequency ω but for the soft springs.
#[lagrangian(
    coordinates(q[2 * m]),
    lagrangian = sum(0..2 * m, |i| dot(q[i]).powi(2)) / 2.0
        - omega.powi(2) / 4.0 * sum(0..m, |i| (q[2 * i + 1] - q[2 * i]).powi(2))
        - q[0].powi(4) - sum(1..m, |i| (q[2 * i] - q[2 * i - 1]).powi(4)) - q[2 * m - 1].powi(4),
)]
#[derive(Clone, Debug)]
pub struct SpringChain {
    pub m: usize,
    pub omega: f64,
}

impl SpringChain {
    /// All energy is in the first pair: its centre (q₀ + q₁)/√2 is at `centre` with velocity 1, and its
    /// spring has the energy 1.
    pub fn first_pair(&self, centre: f64) -> SpringChainState {
        let (mut q, mut dot_q) = (vec![0.0; 2 * self.m], vec![0.0; 2 * self.m]);
        if let ([q0, q1, ..], [v0, v1, ..]) = (&mut q[..], &mut dot_q[..]) {
            let x = 1.0 / self.omega;
            [*q0, *q1] = [FRAC_1_SQRT_2 * (centre - x), FRAC_1_SQRT_2 * (centre + x)];
            [*v0, *v1] = [0.0, FRAC_1_SQRT_2 * 2.0];
        }
        SpringChainState { q, dot_q }
    }

    /// ½(x'² + sω²x²) of each stiff spring, for a factor s.
    pub fn oscillatory(&self, state: &SpringChainState, s: f64) -> Vec<f64> {
        let pairs = state.q.chunks_exact(2).zip(state.dot_q.chunks_exact(2));
        let energy = |(q, dot_q): (&[f64], &[f64])| {
            0.25 * ((dot_q[1] - dot_q[0]).powi(2) + s * (self.omega * (q[1] - q[0])).powi(2))
        };
        pairs.map(energy).collect()
    }
}

/// n rigid triangles in a row. The atoms 3m, 3m + 1 and 3m + 2 of molecule m have mass 1 and are joined by
/// rods of length 1. The last two of a molecule face the first two of the next one: each of these four pairs
/// has the potential (1 − e^{−β(r − r₀)})² of Morse, with r₀ = 1 or √2, so that at rest the four are the
/// corners of a square.
#[lagrangian(
    coordinates(r[3 * n][2]),
    lagrangian = sum(0..3 * n, |i| dot(r[i]).norm_squared()) / 2.0 - sum(0..n - 1, |m| sum(0..2, |a| {
        let bond = |i, j, rest| (1.0 - (-beta * ((r[i] - r[j]).norm() - rest)).exp()).powi(2);
        bond(3 * m + 3 + a, 3 * m + 1 + a, 1.0) + bond(3 * m + 4 - a, 3 * m + 1 + a, 2.0_f64.sqrt())
    })),
    constraint(m in 0..n) = (r[3 * m + 1] - r[3 * m]).norm_squared() - 1.0,
    constraint(m in 0..n) = (r[3 * m + 2] - r[3 * m + 1]).norm_squared() - 1.0,
    constraint(m in 0..n) = (r[3 * m] - r[3 * m + 2]).norm_squared() - 1.0,
    momenta(
        along = sum(0..3 * n, |i| dot(r[i]))[0],
        across = sum(0..3 * n, |i| dot(r[i]))[1],
        angular = sum(0..3 * n, |i| r[i][0] * dot(r[i][1]) - r[i][1] * dot(r[i][0])),
    ),
)]
#[derive(Clone, Debug)]
pub struct RigidMolecules {
    pub n: usize,
    pub beta: f64,
}

/// The same molecules with springs of the stiffness `k` in place of the rods.
#[lagrangian(
    coordinates(r[3 * n][2]),
    lagrangian = sum(0..3 * n, |i| dot(r[i]).norm_squared()) / 2.0 - sum(0..n - 1, |m| sum(0..2, |a| {
        let bond = |i, j, rest| (1.0 - (-beta * ((r[i] - r[j]).norm() - rest)).exp()).powi(2);
        bond(3 * m + 3 + a, 3 * m + 1 + a, 1.0) + bond(3 * m + 4 - a, 3 * m + 1 + a, 2.0_f64.sqrt())
    }))
        - k / 2.0 * sum(0..n, |m| sum(0..3, |a| {
            ((r[3 * m + (a + 1) % 3] - r[3 * m + a]).norm() - 1.0).powi(2)
        })),
    momenta(
        along = sum(0..3 * n, |i| dot(r[i]))[0],
        across = sum(0..3 * n, |i| dot(r[i]))[1],
        angular = sum(0..3 * n, |i| r[i][0] * dot(r[i][1]) - r[i][1] * dot(r[i][0])),
    ),
)]
#[derive(Clone, Debug)]
pub struct SpringMolecules {
    pub n: usize,
    pub beta: f64,
    /// The force of a spring over the change of its length.
    pub k: f64,
}

impl RigidMolecules {
    /// The straight chain, in which every other molecule is upside down, with velocities that are sines of
    /// the square of the number of the atom, of magnitude `speed` and then made those of rigid molecules.
    ///
    /// # Errors
    /// Those of [`projected`](dvi_core::mechanics::OnConstraints::projected).
    pub fn chain(&self, speed: f64) -> Result<RigidMoleculesState, StartError> {
        let radius = 1.0 / 3.0_f64.sqrt();
        let apart = 1.0 + radius;
        let atom = |i: usize| {
            let (m, a) = (i / 3, i % 3);
            let sign = if m % 2 == 0 { 1.0 } else { -1.0 };
            let along = (m as f64 - 0.5 * (self.n as f64 - 1.0)) * apart * FRAC_PI_6.cos();
            let angle = FRAC_PI_2 + (1.0 - a as f64) * TAU / 3.0;
            let square = ((i + 1) * (i + 1)) as f64;
            (
                [along + radius * angle.cos(), sign * (radius * angle.sin() - 0.25 * apart)],
                [speed * (2.1 * square).sin(), speed * (1.7 * square).cos()],
            )
        };
        let (r, dot_r) = (0..3 * self.n).map(atom).unzip();
        self.projected(0.0, &RigidMoleculesState { r, dot_r })
    }
}

impl From<RigidMoleculesState> for SpringMoleculesState {
    fn from(RigidMoleculesState { r, dot_r }: RigidMoleculesState) -> Self {
        Self { r, dot_r }
    }
}

/// The discrete nonlinear Schrödinger equation, i ψ' = −(ψ_{n+1} − 2ψ_n + ψ_{n−1}) − |ψ_n|²ψ_n, on a ring.
///
/// With ψ = (q + ip)/√2 it is the flow of L = p·q' − H with H = Σ |ψ_{n+1} − ψ_n|² − ½|ψ_n|⁴, and the norm
/// Σ|ψ_n|² is conserved.
#[degenerate_lagrangian(
    coordinates(q[N], p[N]),
    one_form    = sum(0..N, |n| p[n] * d(q[n])),
    hamiltonian = sum(0..N, |n| ((q[(n + 1) % N] - q[n]).powi(2) + (p[(n + 1) % N] - p[n]).powi(2)) / 2.0
        - (q[n] * q[n] + p[n] * p[n]).powi(2) / 8.0),
    momenta(norm = sum(0..N, |n| q[n] * q[n] + p[n] * p[n]) / 2.0),
)]
#[derive(Clone, Debug)]
pub struct SchroedingerLattice<const N: usize> {}

/// The breather of frequency ω at site N/2: ψ_n = u_n e^{iωt} with ω u = u_{n+1} − 2u_n + u_{n−1} + u³ and u
/// large at one site only. The equations are solved one after the other for u_n, in the centre for its
/// square, until nothing changes: that contracts where ω is larger than the coupling.
pub fn breather<const N: usize>(omega: f64) -> [f64; N] {
    let mut u = [0.0; N];
    u[N / 2] = (omega + 2.0).sqrt();
    for _ in 0..1000 {
        for n in 0..N {
            let neighbours = u[(n + 1) % N] + u[(n + N - 1) % N];
            u[n] = if n == N / 2 {
                (omega + 2.0 - neighbours / u[n]).sqrt()
            } else {
                (neighbours + u[n].powi(3)) / (omega + 2.0)
            };
        }
    }
    u
}
