//! Steps of different lengths, and that they can be undone.

use dvi_core::Space;
use dvi_core::methods::{Method, Step};
use dvi_core::prelude::*;
use dvi_core::state::Statistics;
use dvi_tests::zoo::regular::KEPLER;
use dvi_tests::{apart, larger};

use super::Outcome;
use super::systems::{chain, double_pendulum};

/// Steps of these lengths there, and of their negatives back.
fn check_variable<S: RegularLagrangian, const NODES: usize>(
    system: &S,
    method: Galerkin<NODES>,
    [q, v]: [&[f64]; 2],
) -> Outcome {
    let mut point = Space::vector(system.space());
    point.copy_from_slice(q);
    let mut memory = method.begin(system, &point, v, 0.0, 0.1)?;
    let momentum = memory.p().to_vec();
    let mut statistics = Statistics::default();
    let (lengths, mut t) = ([0.1, 0.09, 0.1, 0.03, 0.2, 0.01], 0.0);
    let back = lengths.iter().rev().map(|h| -h);
    for h in lengths.iter().copied().chain(back) {
        method.step(Step { system, q: &mut point, t, h, statistics: &mut statistics }, &mut memory)?;
        t += h;
    }
    let error = larger(apart(&point, q), apart(memory.p(), &momentum));
    assert!(error < 1e-12, "{}: {error:e}", S::REPORT.system);
    Ok(())
}

#[test]
fn steps_of_different_lengths_may_follow_one_another() -> Outcome {
    check_variable(&KEPLER, Galerkin::<4>::new(), [&[1.0, 0.1], &[-0.2, 1.1]])?;
    check_variable(&KEPLER, Galerkin::<9>::new(), [&[1.0, 0.1], &[-0.2, 1.1]])?;
    check_variable(&double_pendulum().0, Galerkin::<4>::new(), [&[1.1, -0.4], &[0.3, 0.9]])?;
    check_variable(&double_pendulum().0, Galerkin::<9>::new(), [&[1.1, -0.4], &[0.3, 0.9]])?;
    check_variable(&chain().0, Galerkin::<9>::new(), [&[0.1, -0.2, 0.4, 0.3], &[0.5, 0.0, -0.1, 0.2]])
}
