//! Systems whose time is transformed: the motion is that of the untransformed system, with its time; what
//! the schemes preserve is preserved; and a time that would stand still is an error.

use approx::assert_abs_diff_eq;
use dvi_core::prelude::*;
use dvi_core::system::TimeTransform;
use dvi_core::{ProperlyDegenerate, Space};
use dvi_tests::laws::systems::Belt;
use dvi_tests::steps::{apart, jacobian, stepped};
use dvi_tests::{Outcome, failing};
use nalgebra::DMatrix;
use num_dual::Dual64;

/// [`Belt`] of two: no component of α is affine, and both α and H depend on time.
#[degenerate_lagrangian(
    coordinates(x[2], y[2]),
    one_form = sum(0..2, |j| ((1.0 + t / 4.0) * y[j] + y[j].powi(3) / 6.0 + x[j] * y[(j + 1) % 2] / 8.0) * d(x[j])),
    hamiltonian = sum(0..2, |j| (x[j].powi(2) + y[j].powi(2)) / 2.0) + (x[1] - x[0]).powi(4) / 2.0 + x[0] * t.sin(),
    time_transform = (1.0 + 0.2 * t.cos()) / (0.7 + x[0] * x[0] + y[1] * y[1]),
)]
#[derive(Clone, Debug)]
struct Transformed;

/// The same, as L, with a gauge that depends on time.
#[degenerate_lagrangian(
    coordinates(x[2], y[2]),
    lagrangian = sum(0..2, |j| ((1.0 + t / 4.0) * y[j] + y[j].powi(3) / 6.0 + x[j] * y[(j + 1) % 2] / 8.0) * dot(x[j]))
        - sum(0..2, |j| (x[j].powi(2) + y[j].powi(2)) / 2.0) - (x[1] - x[0]).powi(4) / 2.0 - x[0] * t.sin(),
    gauge = x[0].powi(3) * t.sin() + x[0] * x[1],
    time_transform = (1.0 + 0.2 * t.cos()) / (0.7 + x[0] * x[0] + y[1] * y[1]),
)]
#[derive(Clone, Debug)]
struct WithGauge;

const PLAIN: Belt = Belt { n: 2 };

const START: TransformedState = TransformedState { x: [0.3, -0.4], y: [0.5, 0.2], t: 0.2, energy: 0.0 };

/// The flat coordinates of the start, with their energy.
fn start() -> Result<Vec<f64>, StartError> {
    let state = Transformed.with_energy(START)?;
    Ok(vec![state.x[0], state.x[1], state.y[0], state.y[1], state.t, state.energy])
}

/// Gauss collocation of order eight with short steps, on either: after a time of 3 in τ, and after as much
/// physical time.
#[test]
fn the_motion_is_that_of_the_untransformed_system() -> Outcome {
    let end = stepped(&Transformed, &Gauss::<4>::new(), &start()?, [0.0, 3.0 / 256.0], 256)?;
    let (q, [t, energy]) = (&end[..4], [end[4], end[5]]);
    let plain = stepped(&PLAIN, &Gauss::<4>::new(), &start()?[..4], [0.2, (t - 0.2) / 256.0], 256)?;
    assert!(apart(q, &plain) < 1e-13, "{q:?}, {plain:?}");
    let hamiltonian = PLAIN.hamiltonian(&plain, t);
    assert_abs_diff_eq!(energy, hamiltonian, epsilon = 1e-13);
    let TimeTransform { rate, hamiltonian: untransformed } =
        dvi_core::Lagrangian::time_transform(&Transformed, &end).ok_or("its time is transformed")?;
    assert_abs_diff_eq!(untransformed, hamiltonian, epsilon = 1e-13);
    assert_abs_diff_eq!(rate, (1.0 + 0.2 * t.cos()) / (0.7 + q[0] * q[0] + q[3] * q[3]), epsilon = 1e-13);
    // ρ is far from constant on the way: an untransformed run of as many steps would not be the same one.
    assert!((t - 0.2 - 3.0 * rate).abs() > 0.1, "{t}, {rate}");
    Ok(())
}

#[test]
fn a_gauge_leaves_the_motion_as_it_is() -> Outcome {
    let after = |h: f64, steps: u64| -> Outcome<f64> {
        let one = stepped(&Transformed, &OneStep::midpoint(), &start()?, [0.0, h], steps)?;
        let other = stepped(&WithGauge, &OneStep::midpoint(), &start()?, [0.0, h], steps)?;
        Ok(apart(&one, &other))
    };
    // The energy has no gauge: both runs begin with the same one.
    let [coarse, fine] = [after(0.04, 50)?, after(0.02, 100)?];
    assert!(fine > 1e-9 && (3.5..4.5).contains(&(coarse / fine)), "{coarse:e}, {fine:e}");
    Ok(())
}

/// Ω of α·dq − e dt.
fn omega(q: &[f64]) -> Outcome<DMatrix<f64>> {
    let d = jacobian(q, q.len(), |q| {
        let (mut point, mut form) = (Transformed.space().vector(), Transformed.space().vector());
        point.copy_from_slice(q);
        Transformed.one_form(&point, Dual64::from(0.0), &mut form);
        Ok(form.to_vec())
    })?;
    Ok(d.transpose() - d)
}

#[test]
fn schemes_preserve_omega_of_the_extended_phase_space() -> Outcome {
    fn check<M: Method<Transformed, f64> + Method<Transformed, Dual64>>(method: &M, least: f64) -> Outcome
    where
        Transformed: ProperlyDegenerate<Dual64>,
    {
        for h in [0.05, 0.1, 0.5] {
            let tangent = jacobian(&start()?, 6, |q| stepped(&Transformed, method, q, [0.0, h], 20))?;
            let end = stepped(&Transformed, method, &start()?, [0.0, h], 20)?;
            let (before, after) = (omega(&start()?)?, omega(&end)?);
            let defect = (tangent.transpose() * after * &tangent - &before).amax() / before.amax();
            assert!(if least == 0.0 { defect < 1e-12 } else { defect > least }, "h = {h}: {defect:e}");
        }
        Ok(())
    }
    check(&OneStep::midpoint(), 0.0)?;
    // What the test can see: a method that does not preserve it.
    check(&RungeKutta::classical(), 1e-9)
}

/// Kepler's problem on the line, in canonical coordinates: a fall from rest at 1, with steps as short as the
/// distance.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = y * d(x),
    hamiltonian = y * y / 2.0 - 1.0 / x,
    time_transform = x.powi(2) - floor,
)]
struct Fall {
    floor: f64,
}

fn fall(energy: f64) -> FallState {
    FallState { x: 1.0, y: 0.0, t: 0.0, energy }
}

/// Without explicit time, `energy` is a constant of the run to the last bit, and the fall takes the time
/// that it takes: t(x) = √(1/2) (√(x(1 − x)) + arccos √x).
#[test]
fn a_fall_takes_its_time() -> Outcome {
    let system = Fall { floor: 0.0 };
    let mut run = Integrator::new(&system, OneStepGauss::<3>::new(), 0.01, system.with_energy(fall(0.0))?)?;
    while run.q()[0] > 0.01 {
        run.take_steps(1)?;
    }
    let FallState { x, t, energy, .. } = run.state();
    assert_eq!(energy, -1.0);
    let expected = 0.5_f64.sqrt() * ((x * (1.0 - x)).sqrt() + x.sqrt().acos());
    assert_abs_diff_eq!(t, expected, epsilon = 1e-8);
    Ok(())
}

#[test]
fn what_is_wrong_is_said() -> Outcome {
    let system = Fall { floor: 0.0 };
    let error =
        Integrator::new(&system, OneStep::midpoint(), 0.1, fall(0.5)).err().ok_or("not consistent")?;
    assert_eq!(error, StartError::EnergyCoordinate { energy: 0.5, hamiltonian: -1.0 });
    let high = Fall { floor: 1.5 };
    let start = high.with_energy(fall(0.0))?;
    let error = Integrator::new(&high, OneStep::midpoint(), 0.1, start).err().ok_or("backwards")?;
    assert_eq!(error, StartError::TimeRate { rate: -0.5 });
    // A motion never reaches ρ = 0; long steps do.
    let low = Fall { floor: 0.25 };
    let (run, error) = failing(&low, OneStep::midpoint(), 1.5, low.with_energy(fall(0.0))?)?;
    let StepFailure::TimeRate { rate } = error.failure else { return Err(error.into()) };
    assert!(rate <= 0.0, "{error}");
    let state = run.state();
    assert!(state.x * state.x > 0.25, "{state:?}");
    // A parameter that is not a number is said to be one.
    let nowhere = Fall { floor: f64::NAN };
    let error = nowhere.with_energy(fall(0.0)).err();
    assert!(matches!(error, Some(StartError::Undefined { value, .. }) if value.is_nan()), "{error:?}");
    Ok(())
}

/// ρ is negative for |x| < √0.2: a long step jumps across, and ends where ρ is positive. The physical time
/// has run backwards in it.
#[degenerate_lagrangian(
    coordinates(x, p),
    one_form = p * d(x),
    hamiltonian = p * p / 2.0 + x * x / 2.0,
    time_transform = x * x - gap,
)]
struct Gap {
    gap: f64,
}

#[test]
fn the_physical_time_does_not_run_backwards() -> Outcome {
    let system = Gap { gap: 0.2 };
    let mut failed = 0;
    for x in [2.64, 1.7, 0.9] {
        for p in [4.0, -3.0, -8.0] {
            for h in [0.1, -0.1, 0.5] {
                let start = system.with_energy(GapState { x, p, t: 0.0, energy: 0.0 })?;
                let mut run = Integrator::new(&system, OneStep::midpoint(), h, start)?;
                let mut last = 0.0;
                for _ in 0..200 {
                    match run.take_steps(1) {
                        Ok(()) => {
                            let t = run.state().t;
                            assert!((t - last) * h > 0.0, "{x}, {p}, {h}");
                            last = t;
                        }
                        Err(error) => {
                            failed += u32::from(matches!(error.failure, StepFailure::TimeRate { .. }));
                            break;
                        }
                    }
                }
            }
        }
    }
    assert!(failed > 0, "no step jumps");
    Ok(())
}

/// The limit is one of H − `energy`, which grows where a fall gets to the centre, and not of ρ times that.
#[test]
fn an_energy_limit_sees_the_energy() -> Outcome {
    let system = Fall { floor: 0.0 };
    let start = system.with_energy(fall(0.0))?;
    let limited = EnergyLimit { method: OneStep::midpoint(), limit: 0.01 };
    let (_, error) = failing(&system, limited, 0.1, start)?;
    assert!(matches!(error.failure, StepFailure::Energy { .. }), "{error}");
    Ok(())
}

/// The terms of H may cancel: then H is known up to the rounding of these.
#[test]
fn an_energy_of_zero_may_be_typed() -> Outcome {
    let system = Fall { floor: 0.0 };
    let start = FallState { x: 0.7, y: (2.0 / 0.7_f64).sqrt(), t: 0.0, energy: 0.0 };
    Integrator::new(&system, OneStep::midpoint(), 0.1, start)?;
    Ok(())
}
