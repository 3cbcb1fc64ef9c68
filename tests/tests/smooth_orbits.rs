//! Starts along the smooth orbit of the two-step map, and reinitialisation: where they agree with something known, and where
//! they cannot be done.

use dvi_core::methods::General;
use dvi_core::prelude::*;
use dvi_tests::configurations::{chaotic, leapfrogging, quasi_periodic};
use dvi_tests::larger;
use dvi_tests::systems::*;

type Outcome = Result<(), Box<dyn core::error::Error>>;

/// The root of t, so that there is nothing before t = 0.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form    = (x * d(y) - y * d(x)) / 2.0,
    hamiltonian = (1.0 + t.sqrt() / 10.0) * (x * x + y * y) / 2.0,
)]
struct Begins;

fn apart(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |largest: f64, (a, b)| larger(largest, (a - b).abs()))
}

#[test]
fn the_smooth_start_of_the_implicit_midpoint_rule_is_the_consistent_one() -> Outcome {
    let (vortices, start) = quasi_periodic();
    for reinitialisation in [Reinitialisation::Never, Reinitialisation::Every(5)] {
        let method = Sigma { start: Start::Smooth, reinitialisation, ..Sigma::midpoint() };
        let mut smooth = Integrator::new(&vortices, method, 0.1, start)?;
        let mut consistent = Integrator::new(&vortices, Sigma::midpoint(), 0.1, start)?;
        smooth.take_steps(100)?;
        consistent.take_steps(100)?;
        assert_eq!(smooth.q(), consistent.q());
        assert_eq!((smooth.parasitic_amplitude(), smooth.reinitialisations()), (0.0, 0));
    }
    // The mode of another start is a constant shift from step to step, and leaves as a whole.
    let reinitialisation = Reinitialisation::Every(5);
    let method =
        Sigma { start: Start::RungeKutta(RungeKutta::midpoint()), reinitialisation, ..Sigma::midpoint() };
    let mut run = Integrator::new(&vortices, method, 0.1, start)?;
    let first = run.parasitic_amplitude();
    assert!(first > 1e-6, "{first:e}");
    run.take_steps(6)?;
    assert_eq!((run.parasitic_amplitude(), run.reinitialisations()), (0.0, 1));
    // Five points of one orbit are what the mode is measured from.
    for (n, is_measured) in [(4, false), (5, true)] {
        let method = Sigma { reinitialisation: Reinitialisation::Every(n), ..Sigma::leapfrog() };
        let mut run = Integrator::new(&vortices, method, 0.1, start)?;
        let mut seen = false;
        for _ in 0..100 {
            run.advance()?;
            seen |= run.parasitic_mode().is_some();
        }
        assert_eq!(seen, is_measured, "{n}");
    }
    Ok(())
}

/// On z' = iωz the smooth orbit turns by the angle θ of one root of the scheme, and the second point is known.
#[test]
fn the_smooth_orbit_of_an_oscillator_is_its_principal_root() -> Outcome {
    let system = Oscillator { omega: 1.0 };
    for h in [0.1_f64, 0.2, 0.4] {
        // z₂ − z₀ = 2ih z₁ for σ = 0: sin θ = h.
        let method = Sigma { start: Start::Smooth, ..Sigma::leapfrog() };
        let mut run = Integrator::new(&system, method, h, OscillatorState { x: 1.0, y: 0.0 })?;
        run.advance()?;
        let theta = h.asin();
        let distance = apart(run.q(), &[theta.cos(), theta.sin()]);
        let order_nine = h * (h / 2.0).powi(8);
        assert!(distance > 0.5 * order_nine && distance < 2.0 * order_nine, "h = {h}: {distance:e}");
    }
    Ok(())
}

#[test]
fn reinitialisation_removes_a_mode_that_is_put_in_and_leaves_the_motion() -> Outcome {
    let system = Oscillator { omega: 1.0 };
    let h = 0.05_f64;
    for sigma in [0.0, 0.25, 0.5, 0.75, 1.0] {
        let start = OscillatorState { x: 1.0, y: 0.0 };
        let smooth = Sigma { start: Start::Smooth, ..Sigma::new(sigma) };
        let mut clean = Integrator::new(&system, smooth, h, start)?;
        clean.advance()?;
        let [x, y] = [clean.q()[0], clean.q()[1]];
        let a = 1e-4;
        // w + (−1)ᵏ(a, 0) with w = z − a at the start.
        let second = OscillatorState { x: x - 2.0 * a, y };
        let method = Sigma { reinitialisation: Reinitialisation::Every(8), ..smooth };
        let mut run = Integrator::from_two_points(&system, method, h, start, second)?;
        let start = OscillatorState { x: 1.0 - a, y: 0.0 };
        let mut expected = Integrator::new(&system, smooth, h, start)?;
        run.take_steps(8)?;
        expected.take_steps(8)?;
        let before = apart(run.q(), expected.q());
        run.take_steps(2)?;
        expected.take_steps(2)?;
        let after = apart(run.q(), expected.q());
        assert!(before > 0.8 * a && after < 0.1 * a, "σ = {sigma}: {before:e}, {after:e}");
        assert_eq!((run.reinitialisations(), run.time()), (1, expected.time()));
    }
    Ok(())
}

#[test]
fn a_smooth_point_stays_where_it_is() -> Outcome {
    let (vortices, start) = chaotic();
    for sigma in [0.0, 0.25, 1.0] {
        let once = Sigma { start: Start::Smooth, ..Sigma::new(sigma) };
        let mut plain = Integrator::new(&vortices, once, 0.05, start)?;
        let method = Sigma { reinitialisation: Reinitialisation::Every(1), ..once };
        let mut renewed = Integrator::new(&vortices, method, 0.05, start)?;
        plain.take_steps(20)?;
        renewed.take_steps(20)?;
        let distance = apart(plain.q(), renewed.q());
        assert!(distance < 1e-12, "σ = {sigma}: {distance:e}");
        assert_eq!(renewed.reinitialisations(), 19);
    }
    Ok(())
}

#[test]
fn what_cannot_be_begun_says_so() -> Outcome {
    let (vortices, start) = chaotic();
    let begin = |method: Sigma, h| Integrator::new(&vortices, method, h, start).err();
    for (reinitialisation, limit) in [
        (Reinitialisation::Every(0), Some(0.5)),
        (Reinitialisation::Above(0.0), Some(0.5)),
        (Reinitialisation::Above(-1.0), None),
        (Reinitialisation::Above(0.5), Some(0.5)),
        (Reinitialisation::Above(0.7), Some(0.5)),
        (Reinitialisation::Above(f64::NAN), None),
        (Reinitialisation::Above(f64::INFINITY), None),
    ] {
        for sigma in [0.0, 0.25, 0.5] {
            let error = begin(Sigma { reinitialisation, parasitic_limit: limit, ..Sigma::new(sigma) }, 0.1);
            assert!(
                matches!(error, Some(StartError::Parameter { name: "reinitialisation", .. })),
                "{reinitialisation:?}: {error:?}"
            );
        }
    }
    // A step that is too long.
    let smooth = |sigma| Sigma { start: Start::Smooth, ..Sigma::new(sigma) };
    for sigma in [0.0, 0.25, 1.0] {
        for h in [20.0, 1e3, 1e10] {
            let error = begin(smooth(sigma), h);
            assert!(matches!(error, Some(StartError::Starter(_))), "σ = {sigma}, h = {h}: {error:?}");
        }
    }
    // At the bound of linear stability the motion and the mode are one.
    let (system, state) = (Oscillator { omega: 1.0 }, OscillatorState { x: 1.0, y: 0.0 });
    for (sigma, h) in [(0.0, 1.0), (0.25, 2.0), (1.0, 1.0)] {
        let method = Sigma { reinitialisation: Reinitialisation::Every(10), ..smooth(sigma) };
        let failure = match Integrator::new(&system, method, h, state) {
            Ok(mut run) => run.take_steps(100).err().map(|error| error.failure),
            Err(StartError::Starter(failure)) => Some(failure),
            Err(other) => return Err(other.into()),
        };
        assert!(matches!(failure, Some(StepFailure::NotSmooth { .. })), "σ = {sigma}: {failure:?}");
        Integrator::new(&system, method, 0.6 * h, state)?.take_steps(100)?;
    }
    // A one-form without a component along one coordinate.
    for sigma in [0.0, 1.0] {
        let state = SphereFormState { phi: 0.4, z: 0.2 };
        let error = Integrator::new(&SphereForm { gamma: 1.0 }, smooth(sigma), 0.1, state).err();
        assert!(matches!(error, Some(StartError::Unsupported { .. })), "{error:?}");
    }
    // A step that is not that of a discrete Lagrangian.
    let method = Sigma { reinitialisation: Reinitialisation::Every(10), ..Sigma::midpoint() };
    let error = Integrator::new(&vortices, General::new(method), 0.1, start).err();
    assert!(
        matches!(error, Some(StartError::Unsupported { option: "Sigma::reinitialisation", .. })),
        "{error:?}"
    );
    let known = (method.is_symmetric(), method.preserved_form());
    assert_eq!(known, (false, dvi_core::methods::PreservedForm::Nothing));
    Ok(())
}

#[test]
fn what_cannot_be_reinitialised_keeps_its_state() -> Outcome {
    let start = BeginsState { x: 1.0, y: 0.0 };
    for sigma in [0.0, 0.25] {
        let method = Sigma { reinitialisation: Reinitialisation::Every(2), ..Sigma::new(sigma) };
        let error = Integrator::new(&Begins, Sigma { start: Start::Smooth, ..method }, 0.1, start).err();
        assert!(matches!(error, Some(StartError::Starter(_))), "{error:?}");
        // Backward from the second step, time would become negative.
        let mut run = Integrator::new(&Begins, method, 0.1, start)?;
        let error = run.take_steps(10).err();
        let Some(StepError { step: 2, .. }) = error else { return Err(format!("{error:?}").into()) };
        let mut same = Integrator::new(&Begins, Sigma::new(sigma), 0.1, start)?;
        same.take_steps(2)?;
        for _ in 0..2 {
            assert_eq!((run.q(), run.memory().defect()), (same.q(), same.memory().defect()));
            assert_eq!((run.steps(), run.reinitialisations()), (2, 0));
            // Of what is not a number, none is equal to another.
            assert_eq!(format!("{:?}", run.advance().err()), format!("{error:?}"));
        }
    }
    Ok(())
}

/// A fixed point of few iterations: sums that are carried on ask for more than the search for a smooth orbit does, so that there
/// are steps that fail after a reinitialisation that did not.
#[test]
fn a_step_that_fails_takes_its_reinitialisation_back() -> Outcome {
    let (vortices, start) = chaotic();
    let mut failed = 0;
    for max_iterations in 10..30 {
        for n in 2..30 {
            let method = Sigma {
                start: Start::RungeKutta(RungeKutta::midpoint()),
                solver: Solver::FixedPoint,
                stopping: Stopping { max_iterations, ..Stopping::default() },
                summation: Summation::Compensated,
                ..Sigma::new(0.25)
            };
            let reinitialisation = Reinitialisation::Every(n);
            let mut run = Integrator::new(&vortices, Sigma { reinitialisation, ..method }, 0.2, start)?;
            let mut same = Integrator::new(&vortices, method, 0.2, start)?;
            if same.take_steps(n).is_err() || run.take_steps(n).is_err() || run.advance().is_ok() {
                continue;
            }
            failed += 1;
            assert_eq!((run.q(), run.memory().defect()), (same.q(), same.memory().defect()));
            assert_eq!((run.steps(), run.reinitialisations()), (n, 0));
        }
    }
    assert!(failed > 0);
    Ok(())
}

/// A step that fails takes back what was done before it.
#[test]
fn a_limit_of_the_energy_takes_a_reinitialisation_back() -> Outcome {
    let (vortices, start) = leapfrogging();
    let start_by = Start::RungeKutta(RungeKutta::midpoint());
    let mut taken_back = 0;
    for n in 2..20 {
        let reinitialisation = Reinitialisation::Every(n);
        let method = Sigma { start: start_by, reinitialisation, ..Sigma::leapfrog() };
        let mut free = Integrator::new(&vortices, method, 1.0, start)?;
        let (initial, mut limit) = (free.energy(), 0.0);
        for _ in 0..n {
            free.advance()?;
            limit = larger(limit, (free.energy() - initial).abs());
        }
        let mut limited = Integrator::new(&vortices, EnergyLimit { method, limit }, 1.0, start)?;
        limited.take_steps(n)?;
        // The step that reinitialises is the first that leaves the limit, or it does not leave it.
        if limited.advance().is_err() {
            taken_back += 1;
            assert_eq!((limited.q(), limited.steps()), (free.q(), n));
            let memory = limited.memory().inner();
            assert_eq!((memory.defect(), memory.reinitialisations()), (free.memory().defect(), 0));
        }
    }
    assert!(taken_back > 0);
    Ok(())
}

/// One vortex, which rests, and a pair, on a circle.
#[test]
fn one_vortex_rests_and_two_turn() -> Outcome {
    let at_rest = PointVorticesState { x: [0.3], y: [-0.2] };
    let pair = PointVorticesState { x: [0.5, -0.5], y: [0.0, 0.0] };
    for sigma in [0.0, 0.25, 0.5, 1.0] {
        for reinitialisation in [Reinitialisation::Every(3), Reinitialisation::Above(0.1)] {
            let method = Sigma { start: Start::Smooth, reinitialisation, ..Sigma::new(sigma) };
            let one = PointVortices { gamma: [1.0] };
            let mut run = Integrator::new(&one, method, 0.1, at_rest)?;
            run.take_steps(50)?;
            assert!(apart(run.q(), &[0.3, -0.2]) < 1e-15, "σ = {sigma}");
            let two = PointVortices { gamma: [1.0, 1.0] };
            let mut run = Integrator::new(&two, method, 0.1, pair)?;
            let initial = run.energy();
            run.take_steps(500)?;
            assert!((run.energy() - initial).abs() < 1e-12, "σ = {sigma}: {:e}", run.energy() - initial);
        }
    }
    Ok(())
}
