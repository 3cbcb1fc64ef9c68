//! The discrete nonlinear Schrödinger equation, i ψ' = −(ψ_{n+1} − 2ψ_n + ψ_{n−1}) − |ψ_n|²ψ_n, on a ring.

use dvi_core::prelude::*;

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
