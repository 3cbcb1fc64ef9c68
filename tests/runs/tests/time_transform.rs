//! Long runs of systems whose time is transformed: what is gained on an orbit with a near passage, and that
//! it stays.

use approx::abs_diff_eq;
use core::f64::consts::TAU;
use dvi_tests::Outcome;

use dvi_core::prelude::*;

/// Kepler's problem in its phase space, with steps in proportion to r^(3/2).
#[degenerate_lagrangian(
    coordinates(x, y, p, q),
    one_form = p * d(x) + q * d(y),
    hamiltonian = (p * p + q * q) / 2.0 - 1.0 / x.hypot(y),
    momenta(angular = x * q - y * p),
    time_transform = x.hypot(y).powf(1.5),
)]
struct Comet;

/// The same with steps of equal length.
#[degenerate_lagrangian(
    coordinates(x, y, p, q),
    one_form = p * d(x) + q * d(y),
    hamiltonian = (p * p + q * q) / 2.0 - 1.0 / x.hypot(y),
)]
struct Plain;

/// The pericentre of an orbit with the semiaxis 1 and this eccentricity.
fn pericentre(eccentricity: f64) -> CometState {
    let (x, q) = (1.0 - eccentricity, ((1.0 + eccentricity) / (1.0 - eccentricity)).sqrt());
    CometState { x, y: 0.0, p: 0.0, q, t: 0.0, energy: 0.0 }
}

fn energy(q: &[f64]) -> f64 {
    (q[2] * q[2] + q[3] * q[3]) / 2.0 - 1.0 / q[0].hypot(q[1])
}

/// The largest energy error in the first and in the last tenth of a run.
fn errors<S: dvi_core::Lagrangian, M: dvi_core::methods::Method<S, f64>>(
    mut run: Integrator<&S, M>,
    steps: usize,
) -> Result<[f64; 2], StepError> {
    let mut largest = [0.0_f64; 2];
    for step in 0..steps {
        run.take_steps(1)?;
        let error = (energy(run.q()) + 0.5).abs();
        if step < steps / 10 {
            largest[0] = largest[0].max(error);
        } else if step >= steps - steps / 10 {
            largest[1] = largest[1].max(error);
        }
    }
    Ok(largest)
}

/// 210 steps a period at an eccentricity of 0.9. The energy error is the same after 1000 periods, to a
/// thousandth; steps of equal length, as many of them, are of no use.
#[test]
fn the_energy_of_a_comet_stays() -> Outcome {
    let start = Comet.with_energy(pericentre(0.9))?;
    let begin = || Integrator::new(&Comet, OneStep::midpoint(), 0.04, start);
    let mut period = begin()?;
    while period.state().t < TAU {
        period.take_steps(1)?;
    }
    let steps = period.steps() as usize;
    assert_eq!(steps, 210);
    let [first, last] = errors(begin()?, 1000 * steps)?;
    assert!(first < 6.2e-4 && (last / first - 1.0).abs() < 1e-3, "{first:e}, {last:e}");
    let mut run = begin()?;
    run.take_steps(1000 * steps as u64)?;
    assert_eq!(run.state().energy, -0.5);
    let angular = run.momentum(0).ok_or("it is declared")?;
    assert!(abs_diff_eq!(angular, start.x * start.q, epsilon = 1e-12), "{angular}");
    let CometState { x, y, p, q, .. } = start;
    let plain = Integrator::new(&Plain, OneStep::midpoint(), TAU / steps as f64, PlainState { x, y, p, q })?;
    let [first, _] = errors(plain, 100 * steps)?;
    assert!(first > 1.0, "{first:e}");
    Ok(())
}
