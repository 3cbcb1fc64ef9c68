//! Kick–drift–kick on Barnes's second-order systems, against the values of independent programs.

use super::Outcome;
use approx::{abs_diff_eq, assert_abs_diff_eq};
use core::f64::consts::TAU;
use dvi_core::prelude::*;
use dvi_tests::larger;

/// a = k x
#[lagrangian(coordinates(x), lagrangian = (dot(x).powi(2) + k * x * x) / 2.0)]
#[derive(Clone, Debug)]
struct Linear {
    k: f64,
}

/// a = −sin x
#[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0 + x.cos())]
#[derive(Clone, Debug)]
struct Pendulum;

const STEP: f64 = 1.0 / 32.0;

/// (x, v) after `steps` steps.
macro_rules! flow {
    ($system:expr, $state:ident, $x:expr, $v:expr, $steps:expr) => {{
        let (system, start) = ($system, $state { x: $x, dot_x: $v });
        let mut run = Integrator::new(&system, Variational::trapezoid(), STEP, start)?;
        run.take_steps($steps)?;
        (run.state().x, run.state().dot_x)
    }};
}

#[test]
fn the_three_flows_end_where_they_should() -> Outcome {
    let inward = flow!(Linear { k: -1.0 }, LinearState, 1.0, 0.0, 256);
    let outward = flow!(Linear { k: 1.0 }, LinearState, 1.0, 0.0, 256);
    let pendulum = flow!(Pendulum, PendulumState, 2.0, 0.0, 256);
    for (found, exact, size) in [
        (inward, (-0.145_822_118_200_617_4, -0.989_190_052_844_622), 1.0),
        (outward, (1_489.994_111_581_187, 1_490.175_648_915_25), 1e3),
        (pendulum, (1.944_208_266_518_613, 0.320_490_725_558_128_6), 1.0),
    ] {
        let error = larger((found.0 - exact.0).abs(), (found.1 - exact.1).abs());
        assert!(error < 1e-12 * size, "{found:?}, not {exact:?}: {error:e}");
    }
    Ok(())
}

/// The area of the polygon through the images of n points of a circle of radius ½ about (0, 1).
macro_rules! area {
    ($system:expr, $state:ident, $points:expr, $steps:expr) => {{
        let mut corners = Vec::new();
        for k in 0..$points {
            let angle = TAU * f64::from(k) / f64::from($points);
            corners.push(flow!($system, $state, 0.5 * angle.cos(), 1.0 + 0.5 * angle.sin(), $steps));
        }
        let next = corners.iter().cycle().skip(1);
        let twice: f64 = corners.iter().zip(next).map(|(a, b)| a.0 * b.1 - a.1 * b.0).sum();
        twice / 2.0
    }};
}

#[test]
fn a_polygon_keeps_its_area_under_linear_flows_and_loses_only_its_corners_under_others() -> Outcome {
    let exact = 50.0 * 0.25 * (TAU / 100.0).sin();
    assert_abs_diff_eq!(exact, 0.784_881_494_116_417_2, epsilon = 1e-15);
    for k in [-1.0, 1.0] {
        let found: f64 = area!(Linear { k }, LinearState, 100, 128);
        assert!(abs_diff_eq!(found, exact, epsilon = 1e-12), "{k}: {found}");
    }
    // At t = 2.
    let found = area!(Pendulum, PendulumState, 100, 64);
    assert!(abs_diff_eq!(found, 0.784_858_871_043, epsilon = 1e-12), "{found}");
    let circle = core::f64::consts::PI / 4.0;
    let coarse = circle - area!(Pendulum, PendulumState, 100, 128);
    let fine = circle - area!(Pendulum, PendulumState, 400, 128);
    assert!(
        abs_diff_eq!(coarse / fine / 16.0, 1.0, epsilon = 0.01),
        "the deficit falls by {}",
        coarse / fine
    );
    Ok(())
}
