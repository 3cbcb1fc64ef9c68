//! Gradients and forces.

use dvi_core::DegenerateLagrangian;
use dvi_core::fast_sum::FastSum;
use dvi_core::prelude::*;

use crate::systems::{ManyVortices, ManyVorticesState};

/// A chain of Fermi, Pasta, Ulam and Tsingou.
#[lagrangian(
    coordinates(q[n]),
    lagrangian = sum(0..n, |j| dot(q[j]).powi(2)) / 2.0
        - sum(1..n, |j| (q[j] - q[j - 1]).powi(2) / 2.0 + alpha / 3.0 * (q[j] - q[j - 1]).powi(3)),
)]
pub(super) struct Chain {
    pub(super) n: usize,
    pub(super) alpha: f64,
}

/// Numbers between −1 and 1, no two of which are equal.
pub(super) fn numbers(count: usize, seed: usize) -> Vec<f64> {
    (0..count).map(|j| ((31 * j + 17 * seed) * 631 % 10_007) as f64 / 5003.5 - 1.0).collect()
}

/// Vortices, some stronger than others.
pub(super) fn vortices(count: usize) -> ManyVortices {
    ManyVortices { gamma: numbers(count, 1).into_iter().map(|gamma| 1.5 + gamma).collect() }
}

/// Those of many vortices and of few, of a chain, and of more vortices by a fast sum.
pub(super) fn add_to(all: &mut Vec<f64>) {
    for count in [600, 21] {
        let mut gradient = vec![0.0; 2 * count];
        vortices(count).hamiltonian_gradient(&numbers(2 * count, 2), 0.0, &mut gradient);
        all.extend(gradient);
    }
    let (chain, mut force) = (Chain { n: 301, alpha: 0.25 }, vec![0.0; 301]);
    chain.force(&numbers(301, 3), &[], 0.0, &mut force);
    all.extend(force);
    let (count, system) = (2000, vortices(2000));
    let fast = FastSum::<_, 2>::new(&system, 1e-6).expect("a tolerance in range");
    let state = ManyVorticesState { x: numbers(count, 5), y: numbers(count, 6) };
    let operations = fast.operations(&state).expect("arrays of the declared length");
    assert!(operations.products > 0, "no cube acts as a whole");
    let mut gradient = vec![0.0; 2 * count];
    fast.hamiltonian_gradient(&[state.x, state.y].concat(), 0.0, &mut gradient);
    all.extend(gradient);
}
