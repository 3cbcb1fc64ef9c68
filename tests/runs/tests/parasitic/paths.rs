//! Paths that seem to alternate, and are no parasitic mode.

use dvi_core::prelude::*;

use super::{Outcome, bounded, course, fourth_order};

/// A one-form that is affine for e = 0, and a potential whose force changes its sign within a width w.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form    = (1.0 + e * (x * x + y * y)) * (x * d(y) - y * d(x)) / 2.0,
    hamiltonian = x * x / 2.0 + g * (y * y + w * w).sqrt(),
)]
struct Ridge {
    e: f64,
    g: f64,
    w: f64,
}

/// The same with a bump.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form    = (1.0 + e * (x * x + y * y)) * (x * d(y) - y * d(x)) / 2.0,
    hamiltonian = x * x / 2.0 + g * (-(y / w).powi(2)).exp() + k * y * y / 2.0,
)]
struct Bump {
    e: f64,
    g: f64,
    w: f64,
    k: f64,
}

/// A path whose curvature changes within a step seems to alternate for as long as the place is seen.
#[test]
fn a_path_with_kinks_goes_on() -> Outcome {
    for h in [0.1, 0.02, 0.005] {
        for (e, w) in [(0.05, 1e-9), (0.0, 1e-9), (0.01, 0.03)] {
            let ridge = (Ridge { e, g: 0.05, w }, RidgeState { x: 0.5, y: -1.0 });
            bounded(&ridge, Sigma::midpoint(), &[h], 80.0, 0.05)?;
        }
    }
    let bump = (Bump { e: 0.01, g: 0.02, w: 0.1, k: 0.1 }, BumpState { x: 1.0, y: -1.0 });
    bounded(&bump, Sigma::midpoint(), &[0.1], 100.0, 0.05)
}

/// A straight path with one bend.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form    = (x * d(y) - y * d(x)) / 2,
    hamiltonian = -y + a * (-((x - 5) / w).powi(2)).exp() * y.cos(),
)]
struct Bend {
    a: f64,
    w: f64,
}

/// What the bend leaves of the mode stays as it was, and the position is as good as that of the midpoint
/// rule, which has no mode.
#[test]
fn a_mode_that_stays_as_it_was_on_a_straight_path_goes_on() -> Outcome {
    let start = BendState { x: 0.0, y: 0.3 };
    for (w, h) in [(1.0, 0.5), (1.0, 0.35), (0.3, 0.1)] {
        for sigma in [0.0, fourth_order(), 0.25, 0.75] {
            let bend = Bend { a: 0.1, w };
            let run = Integrator::new(&bend, Sigma::new(sigma), h, start)?;
            let course = course(run, 3000.0)?;
            assert_eq!(course.error, None, "σ = {sigma}, h = {h}, w = {w}");
        }
    }
    Ok(())
}
