//! The parasitic mode is measured for every σ, and a run in which it has taken over ends with an error.

mod amplitude;
mod paths;

use dvi_core::prelude::*;
use dvi_tests::configurations::{chaotic, leapfrogging, quasi_periodic};
use dvi_tests::systems::*;
use dvi_tests::{Outcome, larger};

/// The σ of fourth order on linear systems.
fn fourth_order() -> f64 {
    (3.0 - 3.0_f64.sqrt()) / 6.0
}

fn prey() -> (LotkaVolterra, LotkaVolterraState) {
    (LotkaVolterra { a: [1.0, 1.0], b: [-1.0, -2.0] }, LotkaVolterraState { x: 1.3, y: 1.6 })
}

fn curved() -> (Curved, CurvedState) {
    (Curved { kappa: 0.3 }, CurvedState { x: 0.8, y: 0.3 })
}

/// A one-form that is not affine, and circles.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form    = (x.powi(3) / 3 + x) / 2 * d(y) - (y.powi(3) / 3 + y) / 2 * d(x),
    hamiltonian = (x * x + y * y) / 2,
)]
struct Cubic;

/// A one-form that is affine for b = 0, and a flow that stands still where q̈ does.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form    = (x + b * x * x / 2) / 2 * d(y) - (y + b * x * y) / 2 * d(x),
    hamiltonian = (x.powi(4) + y.powi(4)) / 4,
)]
struct Quartic {
    b: f64,
}

/// An affine one-form, and a quartic oscillator.
#[degenerate_lagrangian(
    coordinates(q, p),
    one_form    = (q * d(p) - p * d(q)) / 2,
    hamiltonian = p * p / 2 + q.powi(4) / 4,
)]
struct Spring;

/// The chaotic four, and a pair that turns faster far away.
fn beside_a_fast_pair() -> (PointVortices<6>, PointVorticesState<6>) {
    let PointVorticesState { x, y } = chaotic().1;
    let far = |near: [f64; 4], fifth: f64, sixth: f64| {
        core::array::from_fn(|i| near.get(i).copied().unwrap_or(if i == 4 { fifth } else { sixth }))
    };
    (PointVortices { gamma: [1.0; 6] }, PointVorticesState { x: far(x, 50.0, 50.3), y: far(y, 0.0, 0.0) })
}

/// How far a run goes up to time `end`.
struct Course {
    steps: u64,
    time: f64,
    /// The largest |H − H(0)|.
    energy_error: f64,
    error: Option<StepError>,
}

fn course<S: DegenerateLagrangian, M: Method<S, f64>>(
    mut run: Integrator<&S, M>,
    end: f64,
) -> Outcome<Course> {
    let (initial, mut energy_error, mut error) = (run.energy(), 0.0_f64, None);
    for _ in 0..(end / run.step_size()).round() as u64 {
        error = run.advance().err();
        if error.is_some() {
            break;
        }
        energy_error = larger(energy_error, (run.energy() - initial).abs());
    }
    Ok(Course { steps: run.steps(), time: run.time(), energy_error, error })
}

/// A run that keeps its motion to time `end`, for some steps.
fn healthy<S: DegenerateLagrangian>(
    system_and_start: &(S, S::State<f64>),
    method: Sigma,
    steps: &[f64],
    end: f64,
) -> Outcome {
    bounded(system_and_start, method, steps, end, 0.015)
}

/// A run that goes on to time `end`, for some steps, with an energy error below this fraction of the energy.
fn bounded<S: DegenerateLagrangian>(
    (system, start): &(S, S::State<f64>),
    method: Sigma,
    steps: &[f64],
    end: f64,
    bound: f64,
) -> Outcome {
    for &h in steps {
        let run = Integrator::new(system, method, h, start.clone())?;
        let initial = run.energy();
        let Course { error, energy_error, .. } = course(run, end)?;
        let name = S::REPORT.system;
        assert_eq!(error, None, "{name}, σ = {}, h = {h}", method.sigma);
        assert!(energy_error < bound * initial.abs(), "{name}, h = {h}: not healthy: {energy_error:e}");
    }
    Ok(())
}

#[test]
fn healthy_runs_go_on() -> Outcome {
    let runge_kutta = Start::RungeKutta(RungeKutta::midpoint());
    for start in [runge_kutta, Start::Consistent] {
        let leapfrog = Sigma { start, ..Sigma::leapfrog() };
        // 10⁵ steps of the longest.
        healthy(&leapfrogging(), leapfrog, &[2.5, 2.0, 1.0, 0.5], 2e5)?;
        healthy(&quasi_periodic(), Sigma { start, ..Sigma::midpoint() }, &[0.1, 0.2, 0.25], 2e3)?;
        healthy(&quasi_periodic(), Sigma { start, ..Sigma::new(0.25) }, &[0.1, 0.05, 0.02], 2e3)?;
    }
    for sigma in [0.25, fourth_order()] {
        let shorter = if sigma == 0.25 { 2e3 } else { 500.0 };
        healthy(&quasi_periodic(), Sigma::new(sigma), &[0.1, 0.05, 0.02], shorter)?;
        healthy(&chaotic(), Sigma::new(sigma), &[0.1, 0.05, 0.02], 500.0)?;
    }
    healthy(&chaotic(), Sigma::midpoint(), &[0.1, 0.2, 0.5], 2e3)?;
    healthy(&prey(), Sigma::midpoint(), &[0.1, 0.05, 0.02], 200.0)?;
    healthy(&curved(), Sigma::midpoint(), &[0.1, 0.05, 0.02], 200.0)?;
    let cubic = (Cubic, CubicState { x: 0.8, y: 0.3 });
    healthy(&cubic, Sigma::midpoint(), &[0.5, 0.2, 0.1], 2e3)?;
    // Long steps: the energy error is larger, and bounded; the mode is large from the start and stays as it
    // is.
    bounded(&cubic, Sigma::midpoint(), &[1.0], 2e4, 0.08)?;
    let oscillator = (Oscillator { omega: 1.0 }, OscillatorState { x: 1.0, y: 0.2 });
    // Paths that are straight at times, all coordinates together.
    for b in [0.0, 0.1, 0.3] {
        let quartic = (Quartic { b }, QuarticState { x: 1.0, y: 0.3 });
        bounded(&quartic, Sigma::midpoint(), &[0.3, 0.1, 0.05, 0.02], 2e3, 0.05)?;
    }
    for sigma in [0.25, fourth_order()] {
        let spring = (Spring, SpringState { q: 1.0, p: 0.0 });
        bounded(&spring, Sigma::new(sigma), &[0.3, 0.2, 0.1, 0.05, 0.02], 2e3, 0.1)?;
    }
    bounded(&oscillator, Sigma::leapfrog(), &[0.5, 0.7], 1e4, 0.5)?;
    bounded(&oscillator, Sigma::new(0.25), &[0.7, 0.9, 1.05, 1.3], 1e4, 0.7)?;
    bounded(&oscillator, Sigma::new(fourth_order()), &[0.7, 0.9, 1.05, 1.3], 1e4, 0.7)
}

/// A run that loses its motion before `end`, for some steps.
fn spoilt<S: DegenerateLagrangian>(
    (system, start): &(S, S::State<f64>),
    sigma: f64,
    steps: &[f64],
    end: f64,
) -> Outcome {
    for &h in steps {
        let name = format!("{}, σ = {sigma}, h = {h}", S::REPORT.system);
        let begin = |method| Integrator::new(system, method, h, start.clone());
        // The implicit midpoint rule has one step, and no parasitic mode.
        let clean = course(Integrator::new(system, Gauss::<1>::new(), h, start.clone())?, end)?;
        assert_eq!(clean.error, None, "{name}");
        // What an energy error has to be compared with: that of a clean run, or of the first four steps, in
        // which an alternation cannot be seen yet.
        let unseen = course(begin(Sigma::new(sigma))?, 4.0 * h)?.energy_error;
        let usual = clean.energy_error.max(unseen);
        let free = course(begin(Sigma { parasitic_limit: None, ..Sigma::new(sigma) })?, end)?;
        let lost = free.error.is_some() || free.energy_error > 10.0 * usual;
        assert!(lost, "{name}: not spoilt: {:e} of {usual:e}", free.energy_error);
        let found = course(begin(Sigma::new(sigma))?, end)?;
        let Some(StepError { step, time, failure, .. }) = found.error else {
            return Err(format!("{name}: not found").into());
        };
        let StepFailure::ParasiticMode { amplitude, relative, limit } = failure else {
            return Err(format!("{name}: {failure}").into());
        };
        assert_eq!((step, time), (found.steps, found.time), "{name}");
        assert!(limit == 0.5 && relative > limit && amplitude > 0.0, "{name}: {failure}");
        assert!(found.energy_error < 10.0 * usual, "{name}: {:e} of {usual:e}", found.energy_error);
    }
    Ok(())
}

#[test]
fn spoilt_runs_end_before_their_energy_tells() -> Outcome {
    spoilt(&chaotic(), 0.0, &[1.0, 0.7, 0.5, 0.2, 0.1, 0.05, 0.02], 300.0)?;
    spoilt(&quasi_periodic(), 0.0, &[0.25, 0.2, 0.1], 2e3)?;
    for sigma in [0.25, fourth_order()] {
        spoilt(&leapfrogging(), sigma, &[4.0, 3.0, 2.0, 1.0, 0.5, 0.25, 0.125], 2000.0)?;
    }
    let far = (prey().0, LotkaVolterraState { x: 2.5, y: 2.0 });
    spoilt(&far, 0.5, &[0.1, 0.05, 0.02], 40.0)?;
    spoilt(&beside_a_fast_pair(), 0.0, &[0.02, 0.01, 0.005], 300.0)
}

#[test]
fn the_last_state_is_kept_and_the_limit_can_be_moved_or_switched_off() -> Outcome {
    let (system, start) = chaotic();
    let mut run = Integrator::new(&system, Sigma::leapfrog(), 0.1, start)?;
    let error = run.take_steps(10_000).err();
    let (state, steps) = (run.state(), run.steps());
    assert!(steps % 4 == 0 && run.energy().is_finite(), "{steps}");
    let Some(StepError {
        step,
        time,
        failure: StepFailure::ParasiticMode { amplitude, relative, limit },
        ..
    }) = error
    else {
        return Err(format!("{error:?}").into());
    };
    assert_eq!((step, time, limit), (steps, run.time(), 0.5));
    let mode = run.memory().parasitic_mode().ok_or("measured")?;
    assert_eq!(mode, ParasiticMode { amplitude, relative, is_significant: true });
    // The step fails again.
    assert_eq!((run.advance().err(), run.state(), run.steps()), (error, state, steps));
    let mut free =
        Integrator::new(&system, Sigma { parasitic_limit: None, ..Sigma::leapfrog() }, 0.1, start)?;
    free.take_steps(steps)?;
    assert_eq!(free.state(), state);
    free.take_steps(1000)?;
    let tolerant = Sigma { parasitic_limit: Some(2.0 * relative), ..Sigma::leapfrog() };
    Integrator::new(&system, tolerant, 0.1, start)?.take_steps(steps + 1)?;
    for value in [0.0, -1.0, f64::NAN] {
        let method = Sigma { parasitic_limit: Some(value), ..Sigma::leapfrog() };
        let error = Integrator::new(&system, method, 0.1, start).err();
        assert!(matches!(error, Some(StartError::Parameter { name: "parasitic_limit", .. })), "{error:?}");
    }
    Ok(())
}
