//! Langevin dynamics: distributions, limits.

use approx::{abs_diff_eq, assert_abs_diff_eq};
use dvi_core::prelude::*;
use dvi_tests::Outcome;
use num_dual::Dual64;

/// Two masses on springs, of which the kinetic energies are coupled.
#[lagrangian(
    coordinates(x, y),
    lagrangian = dot(x).powi(2) + dot(y).powi(2) / 2.0 + 0.4 * dot(x) * dot(y)
        - 3.0 * x * x / 2.0 - 2.0 * y * y / 2.0 - 0.5 * x * y,
)]
#[derive(Clone, Debug)]
struct Springs;

#[lagrangian(coordinates(x), lagrangian = mass * dot(x).powi(2) / 2.0 - x.powi(4) / 4.0 + x * x / 2.0)]
#[derive(Clone, Debug)]
struct DoubleWell {
    mass: f64,
}

#[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0 - k * x * x / 2.0, force(x) = push)]
#[derive(Clone, Debug)]
struct Pushed {
    k: f64,
    push: f64,
}

/// The mean of `read` over a run, and its error by the scatter of a hundred parts.
fn mean<S: dvi_core::Separable + RegularLagrangian>(
    system: &S,
    method: Langevin,
    (h, steps): (f64, u64),
    start: S::State<f64>,
    read: impl Fn(&S::State<f64>) -> f64,
) -> Outcome<[f64; 2]> {
    let mut run = Integrator::new(system, method, h, start)?;
    run.take_steps(steps / 100)?;
    let mut parts = Vec::new();
    for _ in 0..100 {
        let mut sum = 0.0;
        for _ in 0..steps / 100 {
            run.advance()?;
            sum += read(&run.state());
        }
        parts.push(sum / (steps / 100) as f64);
    }
    let mean = parts.iter().sum::<f64>() / 100.0;
    let scatter = parts.iter().map(|part| (part - mean).powi(2)).sum::<f64>() / 99.0;
    Ok([mean, (scatter / 100.0).sqrt()])
}

/// Whether a mean is what it has to be, to four of its errors, which are no larger than `most`.
fn agrees([mean, error]: [f64; 2], expected: f64, most: f64) {
    assert!(error < most && (mean - expected).abs() < 4.0 * error, "{mean} ± {error}, expected {expected}");
}

/// The covariance of the positions is θK⁻¹ at every stable step, whatever the mass matrix.
#[test]
fn positions_on_springs_have_the_exact_distribution() -> Outcome {
    let method = Langevin { friction: 0.8, temperature: 0.7, seed: 11 };
    let start = SpringsState { x: 0.0, y: 0.0, dot_x: 0.0, dot_y: 0.0 };
    let determinant = 3.0 * 2.0 - 0.5 * 0.5;
    for h in [0.1, 0.8] {
        let mean = |read: fn(&SpringsState) -> f64| mean(&Springs, method, (h, 400_000), start, read);
        agrees(mean(|s| s.x * s.x)?, 0.7 * 2.0 / determinant, 0.005);
        agrees(mean(|s| s.y * s.y)?, 0.7 * 3.0 / determinant, 0.006);
        agrees(mean(|s| s.x * s.y)?, -0.7 * 0.5 / determinant, 0.004);
    }
    Ok(())
}

/// The mean of p² is θm(1 − (ωh)²/4).
#[test]
fn the_kinetic_energy_on_a_spring_is_too_small_by_what_is_documented() -> Outcome {
    let start = PushedState { x: 0.0, dot_x: 0.0 };
    let system = Pushed { k: 4.0, push: 1.2 };
    for (h, friction) in [(0.2, 1.0), (0.7, 3.0)] {
        let method = Langevin { friction, temperature: 0.5, seed: 3 };
        let velocities = mean(&system, method, (h, 400_000), start, |s| s.dot_x * s.dot_x)?;
        let exact = 0.5 * (1.0 - 4.0 * h * h / 4.0);
        agrees(velocities, exact, 0.003);
        agrees(mean(&system, method, (h, 400_000), start, |s| s.x)?, 1.2 / 4.0, 0.003);
    }
    Ok(())
}

/// With γh so large that nothing is kept, a kick-free particle gets new normal momenta in each step.
#[test]
fn noise_is_normal_and_independent() -> Outcome {
    #[lagrangian(coordinates(x, y), lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0)]
    #[derive(Clone, Debug)]
    struct Free;
    let method = Langevin { friction: 1e3, temperature: 1.0, seed: 1 };
    let start = FreeState { x: 0.0, y: 0.0, dot_x: 0.0, dot_y: 0.0 };
    let mut run = Integrator::new(&Free, method, 1.0, start)?;
    let count = 200_000;
    let (mut moments, mut products, mut before) = ([0.0; 4], [0.0; 3], [0.0; 2]);
    for _ in 0..count {
        run.advance()?;
        let FreeState { dot_x: u, dot_y: v, .. } = run.state();
        for (moment, power) in moments.iter_mut().zip(1..) {
            *moment += u.powi(power) / f64::from(count);
        }
        for (sum, product) in products.iter_mut().zip([u * v, u * before[0], v * before[0]]) {
            *sum += product / f64::from(count);
        }
        before = [u, v];
    }
    // Standard errors: of the mean of x^k, the root of the variance of x^k over the number.
    let error = f64::from(count).sqrt().recip();
    for (moment, expected, deviation) in [
        (moments[0], 0.0, 1.0),
        (moments[1], 1.0, 2.0_f64.sqrt()),
        (moments[2], 0.0, 15.0_f64.sqrt()),
        (moments[3], 3.0, 96.0_f64.sqrt()),
    ] {
        assert!(abs_diff_eq!(moment, expected, epsilon = 4.0 * deviation * error), "{moments:?}");
    }
    assert!(products.iter().all(|product| product.abs() < 4.0 * error), "{products:?}");
    Ok(())
}

#[test]
fn the_limits_are_the_trapezoidal_integrator_and_friction_alone() -> Outcome {
    let start = DoubleWellState { x: 1.3, dot_x: 0.2 };
    let system = DoubleWell { mass: 0.5 };
    let mut without =
        Integrator::new(&system, Langevin { friction: 0.0, temperature: 2.0, seed: 1 }, 0.05, start)?;
    let mut verlet = Integrator::new(&system, Variational::trapezoid(), 0.05, start)?;
    without.take_steps(1000)?;
    verlet.take_steps(1000)?;
    assert_abs_diff_eq!(without.q()[0], verlet.q()[0], epsilon = 1e-11);

    // x″ = −γx′ − kx, from (1, 0): the closed form, to the order two.
    let (spring, gamma) = (Pushed { k: 4.0, push: 0.0 }, 0.6);
    let mut errors = Vec::new();
    for steps in [50, 75, 100, 150] {
        let h = 3.0 / steps as f64;
        let method = Langevin { friction: gamma, temperature: 0.0, seed: 1 };
        let mut run = Integrator::new(&spring, method, h, PushedState { x: 1.0, dot_x: 0.0 })?;
        run.take_steps(steps)?;
        let omega = (4.0 - gamma * gamma / 4.0_f64).sqrt();
        let (sin, cos) = (omega * 3.0).sin_cos();
        let exact = (-gamma * 1.5).exp() * (cos + gamma / (2.0 * omega) * sin);
        errors.push((h, (run.q()[0] - exact).abs()));
    }
    let order = convergence_order(&errors).ok_or("no slope")?;
    assert!(abs_diff_eq!(order, 2.0, epsilon = 0.05), "{order}");
    Ok(())
}

#[test]
fn what_is_no_bath_is_refused() {
    let start = SpringsState { x: 0.1, y: 0.0, dot_x: 0.0, dot_y: 0.3 };
    let error = |friction: f64, temperature: f64, h: f64| {
        Integrator::new(&Springs, Langevin { friction, temperature, seed: 0 }, h, start).err()
    };
    for wrong in [-0.1, f64::NAN, f64::INFINITY] {
        assert!(matches!(error(wrong, 1.0, 0.1), Some(StartError::Parameter { name: "friction", .. })));
        assert!(matches!(error(1.0, wrong, 0.1), Some(StartError::Parameter { name: "temperature", .. })));
    }
    assert!(matches!(error(1.0, 1.0, -0.1), Some(StartError::Unsupported { .. })));
    assert_eq!(error(0.0, 0.0, 0.1), None);
    // A mass that is not positive has no root.
    let system = DoubleWell { mass: -1.0 };
    let start = DoubleWellState { x: 1.3, dot_x: 0.2 };
    let error =
        Integrator::new(&system, Langevin { friction: 1.0, temperature: 1.0, seed: 0 }, 0.1, start).err();
    let Some(StartError::Starter(StepFailure::Singular { matrix, pivot: -1.0, .. })) = error else {
        panic!("{error:?}");
    };
    assert_eq!(matrix, "the root of the mass matrix");
}

/// Without noise a run has derivatives, and any mass that is not zero.
#[test]
fn without_noise_it_is_a_deterministic_method() -> Outcome {
    let system = DoubleWell { mass: 0.5 };
    for (friction, temperature) in [(1.0, 0.0), (0.0, 0.5), (0.0, 0.0)] {
        let method = Langevin { friction, temperature, seed: 1 };
        let end = |x: f64| {
            let mut run = Integrator::new(&system, method, 0.1, DoubleWellState { x, dot_x: 0.2 })?;
            run.take_steps(20)?;
            Ok::<f64, Box<dyn core::error::Error>>(run.q()[0])
        };
        let [x, dot_x] = [Dual64::new(1.2, 1.0), Dual64::from(0.2)];
        let mut run = Integrator::new(&system, method, Dual64::from(0.1), DoubleWellStateOf { x, dot_x })?;
        run.take_steps(20)?;
        let quotient = (end(1.2 + 1e-5)? - end(1.2 - 1e-5)?) / 2e-5;
        assert!(abs_diff_eq!(run.q()[0].eps, quotient, epsilon = 1e-7), "{} {quotient}", run.q()[0].eps);
        let negative = DoubleWell { mass: -0.5 };
        Integrator::new(&negative, method, 0.1, DoubleWellState { x: 1.0, dot_x: 0.2 })?.take_steps(3)?;
    }
    Ok(())
}

/// A run that goes on from its start has other noise than at its start, also where its energy is limited.
#[test]
fn noise_that_has_been_used_up_does_not_come_again() -> Outcome {
    fn check<M: Method<DoubleWell, f64>>(method: M) -> Outcome {
        let start = DoubleWellState { x: 1.0, dot_x: 0.0 };
        let mut run = Integrator::new(DoubleWell { mass: 1.0 }, method, 0.1, start)?;
        let mut places = Vec::new();
        for _ in 0..20 {
            run.set_state(0.0, start)?;
            run.advance()?;
            places.push(run.state().x);
        }
        places.sort_by(f64::total_cmp);
        assert!(places.windows(2).all(|pair| pair[0] < pair[1]), "{places:?}");
        Ok(())
    }
    let method = Langevin { friction: 1.0, temperature: 0.5, seed: 3 };
    check(method)?;
    check(EnergyLimit { method, limit: 1e3 })
}
