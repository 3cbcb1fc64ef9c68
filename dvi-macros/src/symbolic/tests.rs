//! The symbolic core against arithmetic that knows nothing of it.
//!
//! A formula is written as a [`tree`], which is evaluated as it stands, without simplification, on
//! numbers, on bounds of their rounding errors, and on dual numbers over these. The same formula goes
//! through the constructors of the graph, which [`evaluate`] interprets on the same point.

use proptest::test_runner::{Config, RngSeed};

mod evaluate;
mod extremes;
mod field;
mod instructions;
mod properties;
mod rules;
mod streams;
mod tree;

/// The same cases every time. Those whose rounding errors cannot be bounded are rejected.
fn configuration(cases: u32) -> Config {
    Config {
        max_global_rejects: 4 * cases,
        rng_seed: RngSeed::Fixed(2002),
        failure_persistence: None,
        ..Config::with_cases(cases)
    }
}
