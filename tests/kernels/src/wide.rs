//! Gradients and forces that in release builds use the widest instructions of the processor, and in others those of all processors.

use dvi_core::DegenerateLagrangian;
use dvi_core::prelude::*;
use dvi_tests::systems::ManyVortices;

/// A chain of Fermi, Pasta, Ulam and Tsingou.
#[lagrangian(
    coordinates(q[n]),
    lagrangian = sum(0..n, |j| dot(q[j]).powi(2)) / 2.0
        - sum(1..n, |j| (q[j] - q[j - 1]).powi(2) / 2.0 + alpha / 3.0 * (q[j] - q[j - 1]).powi(3)),
)]
struct Chain {
    n: usize,
    alpha: f64,
}

/// Numbers between −1 and 1, no two of which are equal.
fn numbers(count: usize, seed: usize) -> Vec<f64> {
    (0..count).map(|j| ((31 * j + 17 * seed) * 631 % 10_007) as f64 / 5003.5 - 1.0).collect()
}

/// The bits of gradients and forces: of many vortices, whose pairs are taken in halves, of few, and of a chain.
pub fn bits() -> Vec<u64> {
    let mut bits = Vec::new();
    for count in [600, 21] {
        let gamma = numbers(count, 1).into_iter().map(|gamma| 1.5 + gamma).collect();
        let mut gradient = vec![0.0; 2 * count];
        ManyVortices { gamma }.hamiltonian_gradient(&numbers(2 * count, 2), 0.0, &mut gradient);
        bits.extend(gradient.into_iter().map(f64::to_bits));
    }
    let (chain, mut force) = (Chain { n: 301, alpha: 0.25 }, vec![0.0; 301]);
    chain.force(&numbers(301, 3), &[], 0.0, &mut force);
    bits.extend(force.into_iter().map(f64::to_bits));
    bits
}
