//! The energy of Gauss collocation on q'' = f(q, t), where the velocities of the stages are eliminated, does
//! not drift; nor does that of as many interior nodes, or where L has terms that are linear in the velocity.

use dvi_core::prelude::*;
use dvi_tests::zoo::regular::{KEPLER, Kepler, pericentre};
use dvi_tests::{Outcome, larger};

/// a x x' is the derivative of a function of x: the motion is cos t, and the momentum is v + a x.
#[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0 - x * x / 2.0 + a * x * dot(x))]
struct Gauge {
    a: f64,
}

/// Stages are consistent where forces depend on velocities, and velocities that cancel in the momentum have
/// their rounding.
#[test]
fn terms_linear_in_the_velocity_do_not_matter() -> Outcome {
    let start = GaugeState { x: 1.0, dot_x: 0.0 };
    // The energy does not drift, however small a drift per step.
    let system = Gauge { a: 1.0 };
    let mut run = Integrator::new(&system, Gauss::<2>::new(), 0.01, start)?;
    run.take_steps(200_000)?;
    let off = run.energy() - 0.5;
    assert!(off.abs() < 1e-12, "{off:e}");
    for (a, h, bound) in [(1.0, 0.01, 1e-13), (100.0, 0.01, 1e-11), (1e3, 0.1, 1e-9), (1e4, 0.01, 1e-9)] {
        let system = Gauge { a };
        let mut run = Integrator::new(&system, Gauss::<3>::new(), h, start)?;
        run.take_steps((1.0 / h) as u64)?;
        let off = run.state().x - run.time().cos();
        assert!(off.abs() < bound, "a = {a}, h = {h}: {off:e}");
    }
    // With a tolerance, the midpoint rule on the oscillator turns by 2 atan(h/2) a step.
    let mut method = Gauss::<1>::new();
    method.stopping.tolerance = 1e-10;
    let system = Gauge { a: 1e6 };
    let mut run = Integrator::new(&system, method, 0.1, start)?;
    run.take_steps(20)?;
    let off = run.state().x - (40.0 * 0.05_f64.atan()).cos();
    assert!(off.abs() < 1e-7, "{off:e}");
    Ok(())
}

/// The largest energy error of Kepler's orbit in `count` hundreds of steps, and the slope of it over the
/// run.
fn energy_error<M: Method<Kepler, f64>>(method: M, count: u32) -> Outcome<[f64; 2]> {
    let mut run = Integrator::new(&KEPLER, method, 0.2, pericentre(0.3))?;
    let before = run.energy();
    let (mut worst, mut moments) = (0.0, [0.0; 2]);
    for k in 0..count {
        run.take_steps(100)?;
        let error = run.energy() - before;
        worst = larger(worst, error.abs());
        // Against time from −½ to ½.
        let at = (f64::from(k) + 0.5) / f64::from(count) - 0.5;
        moments = [moments[0] + at * error, moments[1] + at * at];
    }
    Ok([worst, (moments[0] / moments[1]).abs()])
}

/// The energy error of the method with eight stages is that of rounding.
#[test]
fn eight_stages_keep_the_energy_to_rounding() -> Outcome {
    let [worst, _] = energy_error(Gauss::<8>::new().in_lanes(), 300)?;
    assert!(worst < 1e-14, "{worst:e}");
    Ok(())
}

/// The energy error of nine nodes is that of rounding, and has no slope that rounding does not explain.
#[test]
fn nine_nodes_keep_the_energy_to_rounding() -> Outcome {
    let method = Galerkin { summation: Summation::Compensated, ..Galerkin::<9>::new() };
    let [worst, drift] = energy_error(method.in_lanes(), 600)?;
    // With six eccentricities from 0.2 to 0.35 the largest are 3e-15 to 1.2e-14.
    assert!(worst < 2e-14 && drift < 2e-14, "{worst:e}, {drift:e}");
    Ok(())
}
