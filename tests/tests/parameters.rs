//! Systems that are generic over the type of their parameters.

use approx::{abs_diff_eq, assert_abs_diff_eq};
use dvi_core::Varied;
use dvi_core::prelude::*;
use dvi_tests::Outcome;
use num_dual::{Dual3_64, Dual64, HyperDual64};

/// α and H with a parameter each.
#[degenerate_lagrangian(coordinates(x, y), one_form = a * x * d(y), hamiltonian = b / 2.0 * (x * x + y * y))]
struct Oscillator<P> {
    a: P,
    b: P,
}

#[lagrangian(
    coordinates(y),
    lagrangian = dot(y).powi(2) / 2.0 - g * y,
    impact = y,
    derive(serde::Serialize, serde::Deserialize)
)]
struct Ball<P> {
    g: P,
}

/// The circulations of vortices are the parameters of α and of H.
#[degenerate_lagrangian(
    coordinates(x[n], y[n]),
    one_form = sum(0..n, |i| gamma[i] * x[i] * d(y[i])),
    hamiltonian = -sum_pairs(0..n, |i, j| gamma[i] * gamma[j] * ((x[i] - x[j]).powi(2) + (y[i] - y[j]).powi(2)).ln())
        / (4.0 * PI)
)]
struct Vortices<'a, P> {
    n: usize,
    gamma: &'a [P],
}

fn constant(value: f64) -> Varied<Dual64> {
    Varied(Dual64::from_re(value))
}

fn varied(value: f64) -> Varied<Dual64> {
    Varied(Dual64::from_re(value).derivative())
}

fn dual(value: f64) -> Dual64 {
    Dual64::from_re(value)
}

/// A ball after one bounce, against the closed form: an order less with the discrete energy.
#[test]
fn behind_an_impact_the_derivative_is_of_first_order() -> Outcome {
    let (g, t): (f64, f64) = (1.3, 2.0);
    let (fall, speed) = ((2.0 / g).sqrt(), (2.0 * g).sqrt());
    let (since, rate) = (t - fall, fall / (2.0 * g));
    let exact = since / speed + speed * rate - since.powi(2) / 2.0 - g * since * rate;
    let errors = |collision, n: u16| -> Result<[f64; 2], Box<dyn std::error::Error>> {
        let method = Impacts { collision, ..Impacts::new(Variational::midpoint()) };
        let system = Ball { g: varied(g) };
        let start = BallStateOf { y: dual(1.0), dot_y: dual(0.0) };
        let mut run = Integrator::new(&system, method, dual(t / f64::from(n)), start)?;
        run.take_steps(n.into())?;
        assert_eq!(run.memory().total(), 1);
        let y = run.state().y;
        Ok([y.re - (speed * since - g * since.powi(2) / 2.0), y.eps - exact])
    };
    let [[_, coarse], [value, fine]] =
        [errors(Collision::Variational, 20)?, errors(Collision::Variational, 2000)?];
    assert!((90.0..110.0).contains(&(coarse / fine)), "{coarse} {fine}");
    assert!(fine > 5e-5 && value.abs() < 1e-6, "{fine} {value}");
    let [value, derivative] = errors(Collision::Reflection, 20)?;
    assert!(value.abs() < 1e-12 && derivative.abs() < 1e-12, "{value} {derivative}");
    Ok(())
}

/// Against differences of fourth order, for methods of all families and storage at run time.
#[test]
fn runs_are_differentiated_in_a_circulation() -> Outcome {
    fn check<M>(method: M) -> Outcome
    where
        M: for<'a> Method<Vortices<'a, f64>, f64>
            + for<'a> Method<Vortices<'a, Varied<Dual64>>, Dual64>
            + Clone
            + core::fmt::Debug,
    {
        let (x, y) = (vec![1.0, -0.5, 0.2], vec![0.0, 0.3, -0.9]);
        let end = |first: f64| -> Outcome<Vec<f64>> {
            let system = Vortices { n: 3, gamma: &[first, 0.8, -0.4] };
            let start = VorticesState { x: x.clone(), y: y.clone() };
            let mut run = Integrator::new(&system, method.clone(), 0.02, start)?;
            run.take_steps(50)?;
            Ok(run.q().to_vec())
        };
        let dx = 1e-3;
        let [a, b, c, d] = [end(1.0 - 2.0 * dx)?, end(1.0 - dx)?, end(1.0 + dx)?, end(1.0 + 2.0 * dx)?];
        let gamma = [varied(1.0), constant(0.8), constant(-0.4)];
        let system = Vortices { n: 3, gamma: &gamma };
        let lifted = |values: &[f64]| values.iter().map(|&value| dual(value)).collect::<Vec<_>>();
        let start = VorticesStateOf { x: lifted(&x), y: lifted(&y) };
        let mut run = Integrator::new(&system, method.clone(), dual(0.02), start)?;
        run.take_steps(50)?;
        let same = end(1.0)?;
        for i in 0..same.len() {
            let slope = (a[i] - 8.0 * b[i] + 8.0 * c[i] - d[i]) / (12.0 * dx);
            let Dual64 { re, eps, .. } = run.q()[i];
            assert!(abs_diff_eq!(re, same[i], epsilon = 1e-12), "{method:?}: {re} {}", same[i]);
            assert!(abs_diff_eq!(eps, slope, epsilon = 1e-9), "{method:?}: {eps} {slope}");
        }
        Ok(())
    }
    check(RungeKutta::classical())?;
    check(Gauss::<3>::new())?;
    Ok(())
}

/// At an equilibrium values have converged before the first iteration, and derivatives have not: those of
/// Newton's method of all orders, those of a fixed point to what its rate leaves of them after many
/// iterations.
#[test]
fn runs_at_an_equilibrium_are_differentiated_too() -> Outcome {
    #[lagrangian(coordinates(x), lagrangian = (dot(x).powi(2) - (x - a).powi(2)) / 2.0 - (x - a).powi(3) / 3.0)]
    struct Well<P> {
        a: P,
    }
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = ((x - a).powi(2) + y * y) / 2.0)]
    struct Turn<P> {
        a: P,
    }
    // The midpoint rule turns by 2 atan(h/2) a step, about (a, 0).
    let (h, n) = (0.5, 7);
    let turned = 1.0 - (2.0 * n as f64 * f64::atan(h / 2.0)).cos();
    let one = |x: f64| dual(x);
    for solver in [Solver::Automatic, Solver::FixedPoint, Solver::Newton, Solver::NewtonKrylov] {
        let start = WellStateOf { x: one(0.0), dot_x: one(0.0) };
        let system = Well { a: varied(0.0) };
        let method = Variational { solver, ..Variational::midpoint() };
        let mut run = Integrator::new(&system, method, one(h), start)?;
        run.take_steps(n)?;
        let error = run.q()[0].eps - turned;
        assert!(error.abs() < 1e-13, "{solver:?}: {error:e}");
        let start = TurnStateOf { x: one(0.0), y: one(0.0) };
        let system = Turn { a: varied(0.0) };
        let method = Sigma { solver, ..Sigma::new(one(0.5)) };
        let mut run = Integrator::new(&system, method, one(h), start)?;
        run.take_steps(n)?;
        let error = run.q()[0].eps - turned;
        assert!(error.abs() < 1e-13, "{solver:?}: {error:e}");
    }
    let start = TurnStateOf { x: one(0.0), y: one(0.0) };
    let system = Turn { a: varied(0.0) };
    let mut run = Integrator::new(&system, Gauss::<1>::new(), one(h), start)?;
    run.take_steps(n)?;
    assert_abs_diff_eq!(run.q()[0].eps, turned, epsilon = 1e-13);

    macro_rules! end {
        ($a:expr) => {{
            let zero = $a - $a;
            let start = WellStateOf { x: zero, dot_x: zero };
            let system = Well { a: Varied($a) };
            let mut run = Integrator::new(&system, Variational::midpoint(), zero + h, start)?;
            run.take_steps(n)?;
            run.q()[0]
        }};
    }
    // Second and third derivatives, against differences of those of one order less.
    let first = |a: f64| -> Outcome<f64> { Ok(end!(Dual64::new(a, 1.0)).eps) };
    let second = |a: f64| -> Outcome<f64> { Ok(end!(HyperDual64::new(a, 1.0, 1.0, 0.0)).eps1eps2) };
    let slope = |f: &dyn Fn(f64) -> Outcome<f64>| -> Outcome<f64> {
        Ok((f(-2e-3)? - 8.0 * f(-1e-3)? + 8.0 * f(1e-3)? - f(2e-3)?) / 12e-3)
    };
    let third = end!(Dual3_64::new(0.0, 1.0, 0.0, 0.0)).v3;
    for (found, expected) in [(second(0.0)?, slope(&first)?), (third, slope(&second)?)] {
        assert!((found - expected).abs() < 1e-8 * expected.abs(), "{found} {expected}");
    }
    Ok(())
}

/// A generic system in numbers of Rust is the same, bit by bit, as one with their type.
#[test]
fn numbers_as_generic_parameters_change_nothing() -> Outcome {
    #[degenerate_lagrangian(coordinates(x, y), one_form = a * x * d(y), hamiltonian = b / 2.0 * (x * x + y * y))]
    struct Plain {
        a: f64,
        b: f64,
    }
    let mut plain =
        Integrator::new(&Plain { a: 2.0, b: 0.5 }, Sigma::midpoint(), 0.1, PlainState { x: 1.0, y: 0.2 })?;
    let start = OscillatorState { x: 1.0, y: 0.2 };
    let mut double = Integrator::new(&Oscillator { a: 2.0, b: 0.5 }, Sigma::midpoint(), 0.1, start)?;
    let mut single = Integrator::new(&Oscillator { a: 2.0_f32, b: 0.5 }, Sigma::midpoint(), 0.1, start)?;
    for _ in 0..1000 {
        plain.advance()?;
        double.advance()?;
        single.advance()?;
        assert_eq!(plain.q(), double.q());
        assert_eq!(plain.q(), single.q());
    }
    Ok(())
}

#[test]
fn states_derive_what_they_are_asked_to() -> Outcome {
    let state = BallState { y: 2.0, dot_y: -1.0 / 3.0 };
    let text = serde_json::to_string(&state)?;
    assert_eq!(serde_json::from_str::<BallState>(&text)?, state);
    Ok(())
}
