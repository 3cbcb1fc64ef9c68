//! Steps of variable length: how many the reversible control takes on Kepler's problem, that it runs
//! backwards, that undone steps leave no trace, and how controls fail.

use approx::{abs_diff_eq, relative_eq};
use core::f64::consts::{PI, TAU};
use dvi_core::methods::VariableStep;
use dvi_core::prelude::*;
use dvi_examples::osculating::Osculating;
use dvi_tests::zoo::regular::{KEPLER, Kepler, KeplerState, Relativistic, RelativisticState, pericentre};
use dvi_tests::{Outcome, larger};

fn lobatto4() -> Result<Variational<Radial>, StartError> {
    Ok(Variational::new(Quadrature::lobatto(4)?).phase_fitted(Radial(Reading::Variational)))
}

#[test]
fn the_number_of_steps_is_the_integral_of_the_density() -> Outcome {
    // dt = r dE on the orbit of semi-axis 1, r = 1 − e cos E, E the eccentric anomaly.
    for (e, exponent) in [(0.95, 1.5), (0.8, 1.0), (0.5, 2.0), (0.9, 0.0)] {
        let nodes = 10_000;
        let density = |anomaly: f64| (1.0_f64 - e * anomaly.cos()).powf(1.0 - exponent);
        let integral: f64 = (0..nodes).map(|k| density(TAU * f64::from(k) / f64::from(nodes))).sum();
        let expected = integral * TAU / f64::from(nodes) / 0.001;
        let control = Reversible::power(0.001, exponent);
        let mut run = Integrator::controlled(&KEPLER, Variational::trapezoid(), control, pericentre(e))?;
        while run.time() < TAU {
            run.advance()?;
        }
        // The period of the discrete orbit is a little off.
        assert!(
            relative_eq!(run.steps() as f64, expected, epsilon = 0.0, max_relative = 1e-3),
            "{e}, {exponent}: {}, {expected}",
            run.steps()
        );
    }
    Ok(())
}

/// Runs `steps` steps, turns round, and runs as many; returns how far from the start that ends, in any
/// coordinate or velocity, and by how much the lengths of corresponding steps differ, as a ratio.
fn there_and_back<S, M>(
    system: &S,
    method: M,
    control: Reversible,
    start: &S::State<f64>,
    turn: impl Fn(S::State<f64>) -> S::State<f64>,
    steps: usize,
) -> Outcome<[f64; 2]>
where
    S: RegularLagrangian,
    M: VariableStep<S, f64> + Copy,
{
    let mut there = Integrator::controlled(system, method, control, start.clone())?;
    let mut lengths = Vec::new();
    for _ in 0..steps {
        there.advance()?;
        lengths.push(there.step_size());
    }
    let control = Reversible { start: Some(there.density()), ..control };
    let mut back = Integrator::controlled(system, method, control, turn(there.state()))?;
    let mut ratio = 0.0_f64;
    for length in lengths.iter().rev() {
        back.advance()?;
        ratio = larger(ratio, (back.step_size() / length - 1.0).abs());
    }
    let flat = |state: S::State<f64>| {
        let (mut q, mut v) = (vec![0.0; back.q().len()], vec![0.0; back.q().len()]);
        dvi_core::State::write(&state, &|block| system.block_len(block), &mut q, &mut v)
            .map(|()| [q, v].concat())
    };
    let (end, start) = (flat(turn(back.state()))?, flat(start.clone())?);
    let distance = end.iter().zip(&start).fold(0.0, |largest: f64, (a, b)| larger(largest, (a - b).abs()));
    Ok([distance, ratio])
}

#[test]
fn a_run_with_its_velocity_reversed_comes_back_by_the_same_steps() -> Outcome {
    let turn = |s: KeplerState| KeplerState { dot_x: -s.dot_x, dot_y: -s.dot_y, ..s };
    let control = Reversible::power(0.02, 1.5);
    let start = KeplerState { dot_x: 0.3, ..pericentre(0.8) };
    let averaged = Variational::simpson().phase_fitted(Radial(Reading::Averaged));
    for [distance, ratio] in [
        there_and_back(&KEPLER, Variational::trapezoid(), control, &start, turn, 1000)?,
        there_and_back(&KEPLER, averaged, control, &start, turn, 1000)?,
        there_and_back(&KEPLER, lobatto4()?, control, &start, turn, 1000)?,
        there_and_back(&KEPLER, Composition::suzuki(Variational::trapezoid()), control, &start, turn, 1000)?,
    ] {
        assert!(distance < 1e-9 && ratio < 1e-9, "{distance:e} {ratio:e}");
    }
    // Not at all if the method is not symmetric.
    let frozen = Variational::simpson().phase_fitted(Radial(Reading::LeftFrozen));
    let [distance, _] = there_and_back(&KEPLER, frozen, control, &start, turn, 1000)?;
    assert!(distance > 1e-4, "{distance:e}");
    Ok(())
}

#[test]
fn a_run_on_a_system_that_is_not_separable_comes_back_too() -> Outcome {
    let system = Relativistic { m: 1.0 };
    let start = RelativisticState { x: 1.0, y: 0.2, dot_x: 0.3, dot_y: 0.6 };
    let turn = |s: RelativisticState| RelativisticState { dot_x: -s.dot_x, dot_y: -s.dot_y, ..s };
    let control = Reversible::power(0.02, 0.5);
    let [distance, ratio] = there_and_back(&system, Variational::midpoint(), control, &start, turn, 1000)?;
    assert!(distance < 1e-9 && ratio < 1e-9, "{distance:e} {ratio:e}");
    let mut run = Integrator::controlled(&system, Variational::midpoint(), control, start)?;
    for _ in 0..10_000 {
        run.advance()?;
        // The density that is carried along stays that of the position, up to O(ε²).
        let ratio = run.density() * run.q()[0].hypot(run.q()[1]).sqrt();
        assert!(abs_diff_eq!(ratio, 1.0, epsilon = 5e-3), "{ratio}");
    }
    Ok(())
}

#[test]
fn negative_epsilon_runs_back_in_time() -> Outcome {
    let forward = Reversible::power(0.02, 1.5);
    let mut there = Integrator::controlled(&KEPLER, lobatto4()?, forward, pericentre(0.8))?;
    there.take_steps(500)?;
    let control = Reversible { epsilon: -0.02, start: Some(there.density()), ..forward };
    let mut back = Integrator::controlled_at(&KEPLER, lobatto4()?, control, there.time(), there.state())?;
    back.take_steps(500)?;
    assert!(back.time().abs() < 1e-10 && (back.q()[0] - 0.2).abs() < 1e-9 && back.q()[1].abs() < 1e-9);
    Ok(())
}

#[test]
fn steps_that_are_undone_leave_no_trace() -> Outcome {
    fn check<M: VariableStep<Kepler, f64> + Copy>(method: M) -> Outcome {
        let run = |first_step, steps| -> Outcome<_> {
            let control = Osculating::new(1e-3, first_step);
            let mut run = Integrator::controlled(&KEPLER, method, control, pericentre(0.5))?;
            run.advance()?;
            let length = run.step_size();
            run.take_steps(steps)?;
            Ok((length, run.state(), run.time()))
        };
        // Too long a step is cut by the estimate or, where u = ωh is near a resonance, because it fails.
        let (length, state, time) = run(10.0, 20)?;
        assert!(length < 0.5, "{length}");
        assert_eq!(run(length, 20)?, (length, state, time));
        Ok(())
    }
    check(Variational::trapezoid())?;
    check(Variational::simpson().phase_fitted(Radial(Reading::Averaged)))?;
    check(Composition::suzuki(Variational::midpoint()))
}

/// What a run that cannot start says.
fn refusal<C: StepControl<Kepler, f64>>(control: C, start: KeplerState) -> Option<StartError> {
    Integrator::controlled(&KEPLER, Variational::trapezoid(), control, start).err()
}

#[test]
fn options_out_of_range_are_refused() {
    let start = || pericentre(0.5);
    for epsilon in [0.0, f64::NAN, f64::INFINITY] {
        let error = refusal(Reversible::power(epsilon, 1.5), start());
        assert!(matches!(error, Some(StartError::Parameter { name: "epsilon", .. })), "{error:?}");
    }
    for density in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = refusal(Reversible { start: Some(density), ..Reversible::power(0.02, 1.5) }, start());
        assert!(matches!(error, Some(StartError::Parameter { name: "start", .. })), "{error:?}");
    }
    let error = refusal(Reversible::power(0.02, f64::NAN), start());
    assert!(matches!(error, Some(StartError::Starter(StepFailure::Density { .. }))), "{error:?}");
    // No epsilon makes a density of one that is none where the run begins.
    assert!(error.is_some_and(|error| error.to_string().contains("unless the density is zero or infinite")));
    let sun = KeplerState { x: 0.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 };
    let error = refusal(Reversible::power(0.02, 1.5), sun);
    assert!(
        matches!(error, Some(StartError::Undefined { quantity: "the force ∂L/∂q", coordinate: Some(x), .. })
            if x.to_string() == "x"),
        "{error:?}"
    );

    let at_rest = KeplerState { dot_y: 0.0, ..start() };
    let error = refusal(Osculating::new(1e-3, 0.1), at_rest);
    assert!(matches!(error, Some(StartError::Unsupported { option: "Osculating", .. })), "{error:?}");
    let relativistic = RelativisticState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 0.5 };
    let (system, control) = (Relativistic { m: 1.0 }, Osculating::new(1e-3, 0.1));
    let error = Integrator::controlled(&system, Variational::midpoint(), control, relativistic).err();
    assert!(matches!(error, Some(StartError::Unsupported { option: "Osculating", .. })), "{error:?}");
}

#[test]
fn a_fall_into_the_sun_ends_with_an_error_at_the_last_good_state() -> Outcome {
    let start = KeplerState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 0.0 };
    let averaged = Variational::simpson().phase_fitted(Radial(Reading::Averaged));
    let mut run = Integrator::controlled(&KEPLER, averaged, Reversible::power(0.02, 1.5), start)?;
    let mut last = run.state();
    let error = loop {
        match run.next().ok_or("an error comes first")? {
            Ok(state) => last = state,
            Err(error) => break error,
        }
    };
    assert!(run.next().is_none());
    assert_eq!(run.state(), last);
    assert!(matches!(error.failure, StepFailure::StepLength { h } if h > 0.0 && h < 1e-15), "{error}");
    assert_eq!((error.step, error.time), (run.steps(), run.time()));
    // Half the period of the orbit of semi-axis ½.
    let fall = PI * 0.5_f64.powf(1.5);
    assert!((run.time() - fall).abs() < 1e-6 && last.x < 1e-8, "{}, {last:?}", run.time());
    Ok(())
}

#[test]
fn a_density_that_does_not_stay_positive_is_an_error() -> Outcome {
    let start = KeplerState { dot_x: 0.4, ..pericentre(0.5) };
    let mut run =
        Integrator::controlled(&KEPLER, Variational::trapezoid(), Reversible::power(1.0, 1.5), start)?;
    let error = run.take_steps(1000).err().ok_or("fails")?;
    assert!(matches!(error.failure, StepFailure::Density { density } if density <= 0.0), "{error}");
    assert!(run.q().iter().all(|q| q.is_finite()) && run.energy().is_finite());
    Ok(())
}
