//! A two-form Ω whose matrix is full, and has a lower rank, is refused in any units.

use dvi_core::prelude::*;
use dvi_tests::Numbers;

/// α with Ωⱼₖ = bⱼₖ − bₖⱼ, up to the sign, and oscillators that it couples.
#[degenerate_lagrangian(
    coordinates(q[4]),
    one_form = sum(0..4, |j| sum(0..4, |k| b[j][k] * q[j] * d(q[k]))),
    hamiltonian = sum(0..4, |j| (q[j] / unit[j]).powi(2)) / 2.0,
)]
#[derive(Clone, Debug)]
struct Full {
    b: [[f64; 4]; 4],
    unit: [f64; 4],
}

impl Full {
    /// A coordinate of unit u has entries of b that are smaller by 1/u.
    fn new(b: [[f64; 4]; 4], unit: [f64; 4]) -> Self {
        let b = core::array::from_fn(|j| core::array::from_fn(|k| b[j][k] / (unit[j] * unit[k])));
        Self { b, unit }
    }

    fn start(&self) -> FullState {
        FullState { q: core::array::from_fn(|j| (1.0 + j as f64) * self.unit[j]) }
    }
}

/// Powers of two change nothing but exponents, and the choice of pivots.
const EXPONENTS: [[i32; 4]; 4] = [[0; 4], [3, -60, 60, 9], [100, 100, -100, -100], [-150, 150, 10, -10]];

/// Ω = u ∧ v has rank 2.
#[test]
fn forms_of_a_lower_rank_are_singular_whatever_rounding_leaves_of_their_pivots() {
    for (seed, exponents) in (0..100).flat_map(|seed| EXPONENTS.map(|exponents| (seed, exponents))) {
        let mut numbers = Numbers(seed);
        let [u, v]: [[f64; 4]; 2] = core::array::from_fn(|_| core::array::from_fn(|_| numbers.next()));
        let b = core::array::from_fn(|j| core::array::from_fn(|k| u[j] * v[k]));
        let system = Full::new(b, exponents.map(|exponent| f64::from(exponent).exp2()));
        let field = system.vector_field(0.0, &system.start());
        assert!(
            matches!(field, Err(StartError::Dependent { matrix: "Ω = −dα", .. })),
            "seed {seed}, {exponents:?}: {field:?}"
        );
        let run = Integrator::new(&system, RungeKutta::classical(), 0.01, system.start()).map(|_| ());
        assert!(
            matches!(run, Err(StartError::Dependent { matrix: "Ω = −dα", .. })),
            "seed {seed}, {exponents:?}: {run:?}"
        );
    }
}
