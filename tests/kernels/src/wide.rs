//! Gradients and forces that in release builds use the widest instructions of the processor, and in others those of all processors.

use dvi_core::DegenerateLagrangian;
use dvi_core::fast_sum::FastSum;
use dvi_core::prelude::*;
use dvi_tests::systems::{ManyVortices, ManyVorticesState};

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

/// The bits of gradients and forces: of many vortices, whose pairs are taken in halves, of few, of a chain, and of more vortices by a
/// fast sum.
///
/// # Panics
/// If the fast sum refuses its tolerance, or takes all pairs.
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
    let count = 2000;
    let system = ManyVortices { gamma: numbers(count, 4).into_iter().map(|gamma| 1.5 + gamma).collect() };
    let fast = FastSum::<_, 2>::new(&system, 1e-6).expect("a tolerance in range");
    let state = ManyVorticesState { x: numbers(count, 5), y: numbers(count, 6) };
    let operations = fast.operations(&state).expect("arrays of the declared length");
    assert!(operations.products > 0, "no cube acts as a whole");
    let mut gradient = vec![0.0; 2 * count];
    fast.hamiltonian_gradient(&[state.x, state.y].concat(), 0.0, &mut gradient);
    bits.extend(gradient.into_iter().map(f64::to_bits));
    bits
}
