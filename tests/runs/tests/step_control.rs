//! Steps of variable length: what the reversible control reaches on Kepler's problem, that it runs
//! backwards, what the control of Kosmas & Vlachos measures, and how both fail.

use approx::{abs_diff_eq, relative_eq};
use core::f64::consts::{PI, TAU};
use dvi_core::methods::VariableStep;
use dvi_core::prelude::*;
use dvi_core::run::StepControl;
use dvi_examples::osculating::{CentreSpeed, Osculating};
use dvi_tests::Outcome;
use dvi_tests::larger;
use dvi_tests::zoo::regular::{KEPLER, Kepler, KeplerState, Relativistic, RelativisticState, pericentre};

fn lobatto4() -> Result<Variational<Radial>, StartError> {
    Ok(Variational::new(Quadrature::lobatto(4)?).phase_fitted(Radial(Reading::Variational)))
}

/// Steps a period and max |ΔE| of 100 periods at e = 0.95 with ε = 0.02.
fn hundred_periods<M: VariableStep<Kepler, f64>>(method: M) -> Result<[f64; 2], StepError> {
    let mut run = Integrator::controlled(&KEPLER, method, Reversible::power(0.02, 1.5), pericentre(0.95))
        .expect("starts");
    let (initial, mut largest) = (run.energy(), 0.0_f64);
    while run.time() < 100.0 * TAU {
        run.advance()?;
        largest = larger(largest, (run.energy() - initial).abs());
    }
    let momentum = run.momentum(0).unwrap_or(f64::NAN);
    assert!(abs_diff_eq!(momentum, (1.0 - 0.95_f64.powi(2)).sqrt(), epsilon = 2e-10), "{momentum}");
    Ok([run.steps() as f64 / 100.0, largest])
}

#[test]
fn a_highly_eccentric_orbit_has_the_reference_errors() -> Outcome {
    // The values of independent programs. With the variational reading, 9.527e-8 is for the mean of ω at
    // both ends; 9.498e-8 belongs to ω at the mean position.
    let averaged = Variational::simpson().phase_fitted(Radial(Reading::Averaged));
    let found = [
        (hundred_periods(Variational::trapezoid())?, 1.542e-3),
        (hundred_periods(Variational::simpson())?, 1.299e-3),
        (hundred_periods(averaged)?, 4.506e-7),
        (hundred_periods(lobatto4()?)?, 9.527e-8),
    ];
    for ([steps, energy], expected) in found {
        assert!(
            relative_eq!(energy, expected, epsilon = 0.0, max_relative = 5e-4),
            "{energy:e}, expected {expected:e}"
        );
        assert!(abs_diff_eq!(steps, 464.0, epsilon = 2.0), "{steps}");
    }
    assert!(found[3].0[1] < 1e-7);
    Ok(())
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
fn there_and_back<S, M, D>(
    system: &S,
    method: M,
    control: Reversible<D>,
    start: &S::State<f64>,
    turn: impl Fn(S::State<f64>) -> S::State<f64>,
    steps: usize,
) -> Outcome<[f64; 2]>
where
    S: RegularLagrangian,
    M: VariableStep<S, f64> + Copy,
    D: Density<f64> + Copy,
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

/// Short steps where the particle is far out, and fast.
#[derive(Clone, Copy, Debug)]
struct FarOut;

impl Density<f64> for FarOut {
    fn value(&self, q: &[f64]) -> f64 {
        (0.5 + q[0] * q[0] + 2.0 * q[1] * q[1]).sqrt()
    }
    fn growth(&self, q: &[f64], v: &[f64]) -> f64 {
        (q[0] * v[0] + 2.0 * q[1] * v[1]) / self.value(q).powi(2)
    }
}

#[test]
fn a_density_of_ones_own_on_a_system_that_is_not_separable() -> Outcome {
    let system = Relativistic { m: 1.0 };
    let start = RelativisticState { x: 1.0, y: 0.2, dot_x: 0.3, dot_y: 0.6 };
    let turn = |s: RelativisticState| RelativisticState { dot_x: -s.dot_x, dot_y: -s.dot_y, ..s };
    let control = Reversible::new(0.05, FarOut);
    let [distance, ratio] = there_and_back(&system, Variational::midpoint(), control, &start, turn, 1000)?;
    assert!(distance < 1e-9 && ratio < 1e-9, "{distance:e} {ratio:e}");
    let mut run = Integrator::controlled(&system, Variational::midpoint(), control, start)?;
    for _ in 0..10_000 {
        run.advance()?;
        // The density that is carried along stays that of the position, up to O(ε²).
        let ratio = run.density() / FarOut.value(run.q());
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

/// R and Ṙ on a Kepler orbit: c = l/r³, so that R = (rv)³/l with (rv)² = 2r + 2E r².
fn osculating_circle(s: &KeplerState) -> [f64; 3] {
    let (r, speed) = (s.x.hypot(s.y), s.dot_x.hypot(s.dot_y));
    let momentum = s.x * s.dot_y - s.y * s.dot_x;
    let energy = speed * speed / 2.0 - 1.0 / r;
    let radial = (s.x * s.dot_x + s.y * s.dot_y) / r;
    [(r * speed).powi(3) / momentum, 3.0 * r * speed * (1.0 + 2.0 * energy * r) * radial / momentum, speed]
}

#[test]
fn steps_by_osculating_circles_keep_to_the_tolerance_in_both_readings() -> Outcome {
    for centre in [CentreSpeed::PerArcLength, CentreSpeed::AsPrinted] {
        let mut steps = [0.0; 2];
        for (steps, tolerance) in steps.iter_mut().zip([1e-3, 1e-5]) {
            let control = Osculating { centre, ..Osculating::new(tolerance, 1.0) };
            let mut run =
                Integrator::controlled(&KEPLER, Variational::trapezoid(), control, pericentre(0.5))?;
            let mut near = 0;
            while run.time() < TAU {
                let [radius, rate, speed] = osculating_circle(&run.state());
                run.advance()?;
                let [next, ..] = osculating_circle(&run.state());
                let moved = match centre {
                    CentreSpeed::PerArcLength => (rate * run.step_size()).abs(),
                    CentreSpeed::AsPrinted => (rate / speed * run.step_size()).abs(),
                };
                let estimate = ((next - radius).abs() - moved).abs();
                assert!(estimate <= tolerance + 1e-12, "{centre:?}: {estimate:e}");
                near += u64::from(estimate > 0.1 * tolerance);
            }
            *steps = run.steps() as f64;
            assert!(run.statistics().linearizations > run.steps(), "some steps are rejected");
            assert!(2 * near > run.steps(), "{centre:?}: {near} of {}", run.steps());
            let momentum = run.momentum(0).ok_or("declared")?;
            assert!(abs_diff_eq!(momentum, 0.75_f64.sqrt(), epsilon = 1e-12), "{momentum}");
        }
        // The estimate is of second order, as printed of first.
        let order = (100.0_f64).ln() / (steps[1] / steps[0]).ln();
        let expected = if centre == CentreSpeed::PerArcLength { 2.0 } else { 1.0 };
        assert!(abs_diff_eq!(order, expected, epsilon = 0.25), "{centre:?}: {order}, {steps:?}");
    }
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
