//! A two-form Ω whose matrix is full: regular ones run in any units, and those of a lower rank are refused.

use approx::abs_diff_eq;
use dvi_core::prelude::*;
use dvi_tests::{Numbers, Outcome};

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

#[test]
fn regular_forms_are_regular_in_any_units() -> Outcome {
    fn path(system: &Full) -> Outcome<[f64; 8]> {
        let field = system.vector_field(0.0, &system.start())?.q;
        let mut run = Integrator::new(system, RungeKutta::classical(), 0.01, system.start())?;
        run.take_steps(100)?;
        let end = run.state().q;
        Ok(core::array::from_fn(|k| {
            if k < 4 { field[k] / system.unit[k] } else { end[k - 4] / system.unit[k - 4] }
        }))
    }
    for seed in 0..50 {
        let mut numbers = Numbers(seed);
        let b: [[f64; 4]; 4] = core::array::from_fn(|_| core::array::from_fn(|_| numbers.next()));
        let w = |i: usize, k: usize| b[i][k] - b[k][i];
        // Its square is the determinant.
        let pfaffian = w(0, 1) * w(2, 3) - w(0, 2) * w(1, 3) + w(0, 3) * w(1, 2);
        if pfaffian.abs() < 0.1 {
            continue;
        }
        let expected = path(&Full::new(b, [1.0; 4]))?;
        for exponents in EXPONENTS {
            let found = path(&Full::new(b, exponents.map(|exponent| f64::from(exponent).exp2())))
                .map_err(|error| format!("seed {seed}, {exponents:?}: {error}"))?;
            for (found, expected) in found.iter().zip(expected) {
                assert!(
                    abs_diff_eq!(*found, expected, epsilon = 1e-11),
                    "seed {seed}, {exponents:?}: {found} and {expected}"
                );
            }
        }
    }
    Ok(())
}

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
            matches!(field, Err(StartError::Undetermined(StepFailure::Singular { .. }))),
            "seed {seed}, {exponents:?}: {field:?}"
        );
        let run = Integrator::new(&system, RungeKutta::classical(), 0.01, system.start());
        let run = run.and_then(|mut run| {
            run.advance().map(|_| ()).map_err(|error| StartError::Starter(error.failure))
        });
        assert!(matches!(run, Err(StartError::Starter(_))), "seed {seed}, {exponents:?}: {run:?}");
    }
}
