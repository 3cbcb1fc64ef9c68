//! Steps whose length keeps the discrete energy: conservation, refusals, and where there is no such step.

use approx::assert_abs_diff_eq;
use dvi_core::discrete::Rule;
use dvi_core::prelude::*;
use dvi_tests::zoo::regular::{DrivenOscillator, DrivenOscillatorState, Sliding, SlidingState};
use dvi_tests::{Outcome, larger};

/// A spring that becomes stiffer.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 - (x * x + y * y) / 2.0 - (x * x + y * y).powi(2) / 4.0,
    momenta(l = x * dot(y) - y * dot(x)),
)]
#[derive(Clone, Debug)]
struct Spring;

const SPRING: SpringState = SpringState { x: 1.0, y: 0.3, dot_x: 0.0, dot_y: 0.5 };

/// E_d of a step of a rule with linear interpolation, by hand.
fn discrete_energy(rule: &Quadrature, h: f64, q0: [f64; 2], q1: [f64; 2]) -> f64 {
    let velocity: [f64; 2] = core::array::from_fn(|i| (q1[i] - q0[i]) / h);
    let kinetic = (velocity[0].powi(2) + velocity[1].powi(2)) / 2.0;
    let potential = |c: f64| {
        let [x, y]: [f64; 2] = core::array::from_fn(|i| (1.0 - c) * q0[i] + c * q1[i]);
        let s = x * x + y * y;
        s / 2.0 + s * s / 4.0
    };
    let nodes = rule.nodes().iter().zip(rule.weights());
    kinetic + nodes.map(|(&c, &weight)| weight * potential(c)).sum::<f64>()
}

#[test]
fn discrete_energy_and_momentum_are_conserved_to_rounding() -> Outcome {
    for rule in [Quadrature::gauss(1)?, Quadrature::gauss(2)?] {
        for h in [0.1, -0.05] {
            let mut run =
                Integrator::controlled(&Spring, Variational::new(rule), EnergyMomentum::new(h), SPRING)?;
            let momentum = run.momentum(0).ok_or("a momentum")?;
            let (mut first, mut lengths, mut worst, mut ratio) =
                (None, [f64::INFINITY, 0.0_f64], 0.0, 1.0_f64);
            let mut last = h;
            for _ in 0..3000 {
                let (q0, t) = ([run.q()[0], run.q()[1]], run.time());
                run.advance()?;
                let step = run.step_size();
                assert_abs_diff_eq!(run.time() - t, step, epsilon = 1e-12);
                let energy = discrete_energy(&rule, step, q0, [run.q()[0], run.q()[1]]);
                worst = larger(worst, (energy - *first.get_or_insert(energy)).abs());
                ratio = ratio.max(step / last).max(last / step);
                last = step;
                lengths = [lengths[0].min(step.abs()), lengths[1].max(step.abs())];
            }
            // Δ/h is known to the rounding of q over h.
            assert!(worst < 3e-14 / h.abs(), "{worst:e}");
            assert!(ratio < 1.5, "lengths change little from step to step: {ratio}");
            assert!(lengths[0] > 0.9 * h.abs() && lengths[1] < 4.0 * h.abs(), "{lengths:?}");
            assert!(lengths[1] > 1.05 * lengths[0], "steps differ: {lengths:?}");
            let change = run.momentum(0).ok_or("a momentum")? - momentum;
            assert!(change.abs() < 1e-12, "{change:e}");
        }
    }
    Ok(())
}

#[test]
fn where_no_length_keeps_the_energy_the_run_ends_at_the_last_good_state() -> Outcome {
    let mut run =
        Integrator::controlled(&Spring, Variational::trapezoid(), EnergyMomentum::new(0.1), SPRING)?;
    let (before, error) = loop {
        let before = run.state();
        if let Err(error) = run.advance() {
            break (before, error);
        }
    };
    assert!(matches!(error.failure, StepFailure::EnergyStep { .. }), "{error}");
    assert_eq!((run.state(), error.step, error.time), (before, run.steps(), run.time()));
    assert!(run.steps() > 0);
    // It fails again in the same way.
    assert_eq!(run.advance().err().map(|again| again.failure), Some(error.failure));
    Ok(())
}

/// On a quartic spring lengths grow without end, and the limit ends the run.
#[test]
fn a_limit_of_the_energy_goes_around_the_method() -> Outcome {
    let method = Variational::midpoint();
    let limited = EnergyLimit { method, limit: 0.05 };
    let control = EnergyMomentum::new(0.1);
    let mut run = Integrator::controlled(&Spring, method, control, SPRING)?;
    let mut watched = Integrator::controlled(&Spring, limited, control, SPRING)?;
    run.take_steps(500)?;
    watched.take_steps(500)?;
    assert_eq!((watched.state(), watched.time()), (run.state(), run.time()));

    #[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0 - x.powi(4) / 4.0)]
    #[derive(Clone, Debug)]
    struct Quartic;
    let start = QuarticState { x: 1.0, dot_x: 0.0 };
    let mut run = Integrator::controlled(&Quartic, method, EnergyMomentum::new(0.01), start)?;
    let (mut longest, mut energy) = (0.0, 0.0);
    for _ in 0..3000 {
        run.advance()?;
        (longest, energy) = (larger(longest, run.step_size()), larger(energy, run.energy()));
    }
    assert!((5.0..7.0).contains(&longest) && (10.0..12.0).contains(&energy), "{longest} {energy}");
    let mut run = Integrator::controlled(&Quartic, limited, EnergyMomentum::new(0.01), start)?;
    assert!(run.take_steps(3000).is_err());
    assert_abs_diff_eq!(run.energy(), 0.25, epsilon = 0.05);
    Ok(())
}

#[test]
fn what_has_no_conserved_energy_is_refused() {
    let control = EnergyMomentum::new(0.1);
    let friction = SlidingState { x: 1.0, dot_x: 0.0 };
    let (driven, pushed) =
        (DrivenOscillator { depth: 0.3, omega: 2.0 }, DrivenOscillatorState { x: 1.0, dot_x: 0.0 });
    let unsupported = |error: Option<StartError>| matches!(error, Some(StartError::Unsupported { .. }));
    assert!(unsupported(Integrator::controlled(&Sliding, Variational::midpoint(), control, friction).err()));
    assert!(unsupported(Integrator::controlled(&driven, Variational::midpoint(), control, pushed).err()));
    let fitted = Variational::midpoint().phase_fitted(Constant(1.0));
    assert!(unsupported(Integrator::controlled(&Spring, fitted, control, SPRING).err()));
    assert!(unsupported(Integrator::controlled(&Spring, RungeKutta::classical(), control, SPRING).err()));
    for first_step in [0.0, f64::NAN] {
        let control = EnergyMomentum::new(first_step);
        let error = Integrator::controlled(&Spring, Variational::midpoint(), control, SPRING).err();
        assert!(matches!(error, Some(StartError::Step { .. })));
    }
}

#[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0 - g * x - k * (x - x0).powi(2) / 2.0)]
#[derive(Clone, Debug)]
struct Particle {
    g: f64,
    k: f64,
    x0: f64,
}

/// The smallest and the largest of `steps` lengths over the first one.
fn lengths(system: &Particle, [x, dot_x, h]: [f64; 3], steps: usize) -> Outcome<[f64; 2]> {
    let start = ParticleState { x, dot_x };
    let mut run = Integrator::controlled(system, Variational::midpoint(), EnergyMomentum::new(h), start)?;
    let mut found = [1.0_f64; 2];
    for _ in 0..steps {
        run.advance()?;
        let ratio = run.step_size() / h;
        found = [found[0].min(ratio), found[1].max(ratio)];
    }
    Ok(found)
}

/// Rounding is no defect: energies of zero, that grow, of coordinates far from the origin, of short steps.
#[test]
fn what_rounding_leaves_of_the_energy_ends_no_run() -> Outcome {
    let fall = Particle { g: 1.0, k: 0.0, x0: 0.0 };
    for [x, v] in [[0.0, 0.0], [0.0, 1e-6], [1.0, 0.0], [-1.0, 2.0_f64.sqrt()]] {
        lengths(&fall, [x, v, 0.1], 2000)?;
    }
    for x0 in [0.0, 100.0, 1000.0] {
        let oscillator = Particle { g: 0.0, k: 4.0, x0 };
        for h in [0.1, 0.01, 1e-4] {
            lengths(&oscillator, [x0 + 1.0, 0.2, h], 1000)?;
        }
    }
    Ok(())
}

/// On an oscillator E_d of the midpoint rule does not depend on the point.
#[test]
fn an_oscillator_is_stepped_by_steps_of_one_length() -> Outcome {
    let found = lengths(&Particle { g: 0.0, k: 4.0, x0: 0.0 }, [1.0, 0.2, 0.1], 200)?;
    assert!((found[0] - 1.0).abs() < 1e-9 && (found[1] - 1.0).abs() < 1e-9, "{found:?}");
    Ok(())
}

/// Where every length is a solution, the last one is taken.
#[test]
fn at_rest_steps_keep_their_length() -> Outcome {
    for h in [0.125, 0.3, 0.01, 0.1] {
        for k in [0.0, 1.0] {
            let found = lengths(&Particle { g: 0.0, k, x0: 0.0 }, [0.0, 0.0, h], 1000)?;
            assert!((found[0] - 1.0).abs() < 1e-12 && (found[1] - 1.0).abs() < 1e-12, "{h} {k}: {found:?}");
        }
    }
    Ok(())
}
