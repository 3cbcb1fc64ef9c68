//! Where a run stands, the energy is a number: steps whose ends lie outside of the domain of a formula are
//! taken back.

use dvi_core::Scalar;
use dvi_core::prelude::*;
use dvi_tests::systems::{LotkaVolterra, PointVortices};
use dvi_tests::zoo::regular::Kepler;
use dvi_tests::{Outcome, bits, failing};

use crate::together::same_as_alone;

/// A fall into the end of the domain at x = 0, where the force is finite beyond it: 1/x is known where ln x
/// is not.
#[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0 - x.ln())]
#[derive(Clone, PartialEq)]
struct Falling;

/// The same with a mass that is not constant.
#[lagrangian(coordinates(x), lagrangian = (1.0 + x * x) * dot(x).powi(2) / 2.0 - x.ln())]
struct Heavy;

/// The same as a one-form and a Hamiltonian.
#[degenerate_lagrangian(coordinates(x, p), one_form = (p * d(x) - x * d(p)) / 2.0, hamiltonian = p * p / 2.0 + x.ln())]
#[derive(Clone, PartialEq)]
struct Flow;

/// Here the force is not known outside either.
#[degenerate_lagrangian(coordinates(x, p), one_form = p * d(x), hamiltonian = p * p / 2.0 + x.sqrt())]
struct Root;

/// Here L is known everywhere, and friction is not.
#[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0 - x, force(x) = -0.1 * x.sqrt() * dot(x))]
struct Rubbing;

/// The same in a loop.
#[lagrangian(
    coordinates(x[N]),
    lagrangian = sum(0..N, |j| dot(x[j]).powi(2) / 2.0 - x[j]),
    force(x) = |j| 0.1 * x[j].ln(),
)]
struct Pushed<const N: usize>;

/// A function of the user's, whose derivative is known beyond the end of its domain.
#[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0 - x - 0.1 * g(x), functions(g = [ln, reciprocal, slope]))]
struct Given;

fn ln<T: Scalar>(x: T) -> T {
    x.ln()
}

fn reciprocal<T: Scalar>(x: T) -> T {
    T::lift(1.0) / x
}

fn slope<T: Scalar>(x: T) -> T {
    -T::lift(1.0) / (x * x)
}

/// A power whose exponent is a parameter: an integer is one of negative numbers too.
#[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0 - x.powf(a) / 2.0)]
struct Powers {
    a: f64,
}

/// A domain on one side of a choice that velocities make.
#[lagrangian(
    coordinates(x),
    lagrangian = dot(x).powi(2) / 2.0 - x,
    force(x) = if dot(x) > -1.4 { 0.1 } else { (-1.0 - x * x).sqrt() },
)]
struct Chosen;

/// A start for each number.
type StartOf<S> = fn(f64) -> <S as System>::State<f64>;

/// From 40 starts, whose last steps end at all distances beyond x = 0; returns how many needed nothing of
/// that end.
fn keeps_to_the_domain<S: Lagrangian, M: Method<S, f64>>(
    name: &str,
    (system, start): (&S, StartOf<S>),
    method: impl Fn() -> M,
) -> Outcome<usize> {
    let mut left = 0;
    for number in 1..=40 {
        let start = || start(0.2 + 0.013 * f64::from(number));
        // A step close by the end may lead far away.
        let (run, error) = failing(system, method(), 0.1, start())?;
        left += usize::from(error.failure == StepFailure::LeftDomain);
        let mut one_by_one = Integrator::new(system, method(), 0.1, start())?;
        while one_by_one.advance().is_ok() {
            let is_inside = one_by_one.energy().is_finite() && one_by_one.q()[0] > 0.0;
            assert!(is_inside, "{name}, {number}: {:?}", one_by_one.q());
        }
        // All at once, a run ends at the same state.
        let mut at_once = Integrator::new(system, method(), 0.1, start())?;
        let error = at_once.take_steps(run.steps() + 10).err().ok_or("no error")?;
        assert_eq!((bits(at_once.q()), at_once.steps()), (bits(run.q()), run.steps()), "{name}, {number}");
        assert_eq!(error.step, run.steps(), "{name}, {number}");
    }
    Ok(left)
}

#[test]
fn no_run_stands_where_its_energy_is_no_number() -> Outcome {
    let falling = (&Falling, (|x| FallingState { x, dot_x: -0.3 }) as fn(f64) -> _);
    let heavy = (&Heavy, (|x| HeavyState { x, dot_x: -0.3 }) as fn(f64) -> _);
    let rubbing = (&Rubbing, (|x| RubbingState { x, dot_x: -0.3 }) as fn(f64) -> _);
    let pushed = (&Pushed::<2>, (|x| PushedState { x: [x, 3.0], dot_x: [-0.3, 0.0] }) as fn(f64) -> _);
    let flow = (&Flow, (|x| FlowState { x, p: -0.3 }) as fn(f64) -> _);
    let root = (&Root, (|x| RootState { x: x / 2.0, p: -1.0 }) as fn(f64) -> _);
    let left = [
        keeps_to_the_domain("midpoint", falling, Variational::midpoint)?,
        keeps_to_the_domain("Verlet", falling, Variational::trapezoid)?,
        keeps_to_the_domain("Runge-Kutta", falling, RungeKutta::classical)?,
        keeps_to_the_domain("midpoint, heavy", heavy, Variational::midpoint)?,
        keeps_to_the_domain("midpoint, force", rubbing, Variational::midpoint)?,
        keeps_to_the_domain("Gauss 4, forces", pushed, Gauss::<2>::new)?,
        keeps_to_the_domain("sigma = 0", flow, Sigma::leapfrog)?,
        keeps_to_the_domain("sigma = 1/2", flow, Sigma::midpoint)?,
        keeps_to_the_domain("one step, root", root, OneStep::midpoint)?,
    ];
    assert!(left.iter().all(|&left| left > 0), "{left:?}");
    let given = (&Given, (|x| GivenState { x, dot_x: -0.3 }) as fn(f64) -> _);
    assert!(keeps_to_the_domain("midpoint, function", given, Variational::midpoint)? > 0);
    // The end of its step is one of its nodes.
    assert_eq!(keeps_to_the_domain("projected, root", root, Projected::symmetric)?, 0);
    Ok(())
}

#[test]
fn a_power_with_an_integer_for_a_parameter_has_no_end() -> Outcome {
    for (a, h) in [(2.0, 0.05), (4.0, 0.05)] {
        let system = Powers { a };
        let mut run =
            Integrator::new(&system, Variational::midpoint(), h, PowersState { x: 1.0, dot_x: 0.0 })?;
        run.take_steps(200)?;
        assert!(run.q()[0].abs() < 1.01);
    }
    let start = PowersState { x: 0.3, dot_x: -1.0 };
    let system = Powers { a: 2.5 };
    let (run, error) = failing(&system, Variational::midpoint(), 0.05, start)?;
    assert!(run.q()[0] > 0.0, "{error}");
    Ok(())
}

#[test]
fn what_velocities_choose_has_a_step() -> Outcome {
    let mut run =
        Integrator::new(&Chosen, Variational::midpoint(), 0.1, ChosenState { x: 1.0, dot_x: 0.0 })?;
    run.take_steps(10)?;
    Ok(())
}

/// x falls with one unit a second onto the end of the logarithm, where H is infinite.
#[test]
fn no_run_stands_at_the_end_of_a_logarithm() -> Outcome {
    #[degenerate_lagrangian(coordinates(x, p), one_form = p * d(x), hamiltonian = -p + 0.1 * x.ln())]
    struct Uniform;
    let (run, error) = failing(&Uniform, Sigma::midpoint(), 0.125, UniformState { x: 1.0, p: 0.0 })?;
    assert_eq!((error.step, error.failure), (7, StepFailure::LeftDomain));
    assert_eq!(run.q()[0], 0.125);
    Ok(())
}

/// What the guide says of poles: no evaluation falls on one that a step of the midpoint rule ends at.
#[test]
fn a_pole_that_a_step_ends_at_may_be_left_again() -> Outcome {
    #[degenerate_lagrangian(coordinates(x, p), one_form = p * d(x), hamiltonian = -p + 0.1 / x)]
    struct Uniform;
    let start = UniformState { x: 1.0, p: 0.0 };
    let mut run = Integrator::new(&Uniform, Sigma::midpoint(), 0.125, start)?;
    run.take_steps(8)?;
    assert!(run.q()[0] == 0.0 && run.energy().is_infinite(), "{:?}", run.q());
    run.take_steps(2)?;
    assert!(run.q()[0] == -0.25 && run.energy().is_finite(), "{:?}", run.q());
    Ok(())
}

/// What the guide says of domains that velocities decide.
#[test]
fn a_force_that_velocities_end_fails_in_the_next_step() -> Outcome {
    #[lagrangian(
        coordinates(x),
        lagrangian = dot(x).powi(2) / 2.0 - x,
        force(x) = 0.1 * (1.0 - dot(x).powi(2)).sqrt(),
    )]
    struct Fast;
    let start = FastState { x: 1.0, dot_x: -0.6 };
    let mut run = Integrator::new(&Fast, Variational::midpoint(), 0.09, start)?;
    while run.state().dot_x.abs() <= 1.0 {
        run.advance()?;
    }
    assert!(matches!(run.advance(), Err(error) if matches!(error.failure, StepFailure::NotFinite { .. })));
    Ok(())
}

/// A relativistic charge, which turns in a magnetic field with the rate b/γ.
#[lagrangian(
    coordinates(x, y),
    lagrangian = -(1.0 - dot(x).powi(2) - dot(y).powi(2)).sqrt() + b / 2.0 * (x * dot(y) - y * dot(x)),
)]
struct Charge {
    b: f64,
}

fn turns(method: impl Method<Charge, f64>, gamma: f64, steps: f64) -> bool {
    let v = (1.0 - gamma.powi(-2)).sqrt();
    let start = ChargeState { x: v, y: 0.0, dot_x: 0.0, dot_y: -v };
    let run = Integrator::new(Charge { b: gamma }, method, core::f64::consts::TAU / (steps * gamma), start);
    run.is_ok_and(|mut run| run.take_steps(100).is_ok())
}

#[test]
fn a_guess_is_slower_than_light_if_the_steps_are_short() {
    for gamma in [10.0, 100.0] {
        let [few, many] = [8.0, 9.0].map(|steps| turns(Variational::midpoint(), gamma, steps));
        assert!(!few && many, "midpoint, {gamma}: {few} {many}");
        let [few, many] = [1.2, 2.0].map(|steps| turns(Gauss::<4>::new(), gamma, steps));
        assert!(!few && many, "Gauss, {gamma}: {few} {many}");
    }
}

#[test]
fn a_matrix_that_is_no_number_is_not_called_singular() -> Outcome {
    #[degenerate_lagrangian(coordinates(x, y), one_form = y.sqrt() * d(x), hamiltonian = x * x / 2.0 + y)]
    struct Falls;
    let (_, error) = failing(&Falls, OneStep::midpoint(), -0.2, FallsState { x: -1.5, y: 0.1 })?;
    assert!(!matches!(error.failure, StepFailure::Singular { .. }), "{error}");
    Ok(())
}

/// How a run ends that stands in its domain after each step.
fn ends_inside<R: Run<System = Falling, Scalar = f64>>(mut run: R) -> Outcome<StepFailure> {
    for _ in 0..100_000 {
        let advanced = run.advance();
        assert!(run.energy().is_finite() && run.q()[0] > 0.0, "{:?}", run.q());
        if let Err(error) = advanced {
            assert_eq!(error.step, run.steps());
            return Ok(error.failure);
        }
    }
    Err("no error".into())
}

#[test]
fn a_step_control_keeps_to_the_domain() -> Outcome {
    let start = FallingState { x: 0.5, dot_x: -0.3 };
    let control = ErrorControl::new(1e-6, 0.1);
    ends_inside(Integrator::controlled(&Falling, Gauss::<2>::new(), control, start)?)?;
    let control = Reversible::power(0.1, 0.0);
    let run = Integrator::controlled(&Falling, Variational::trapezoid(), control, start)?;
    assert_eq!(ends_inside(run)?, StepFailure::LeftDomain);
    Ok(())
}

#[test]
fn runs_that_share_lanes_keep_to_the_domain() -> Outcome {
    let runs = [0.4, 3.0, 0.55, 2.0].map(|x| (&Flow, FlowState { x, p: -0.3 }));
    same_as_alone::<4, _, _>(&runs, &Sigma::midpoint(), 0.1, &[12])?;
    same_as_alone::<4, _, _>(&runs, &Sigma::leapfrog(), 0.1, &[12])?;
    Ok(())
}

#[test]
fn what_has_no_end_of_its_domain_is_not_looked_at() {
    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 - (k / m).sqrt() * (1.0 + x * x + y.powi(4)).ln() - x.hypot(y).powf(a)
            - y.abs().sqrt() + (-x).exp().ln() - x.sin().atan(),
    )]
    struct Everywhere {
        k: f64,
        m: f64,
        a: f64,
    }
    #[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0 - (1.0 - x * x).sqrt())]
    struct Somewhere;
    #[lagrangian(coordinates(x), lagrangian = -(1.0 - dot(x).powi(2)).sqrt())]
    struct Fast;
    const { assert!(!Everywhere::HAS_DOMAIN && !Kepler::HAS_DOMAIN && !PointVortices::<4>::HAS_DOMAIN) };
    const { assert!(Rubbing::HAS_DOMAIN && Pushed::<2>::HAS_DOMAIN) };
    const { assert!(Somewhere::HAS_DOMAIN && LotkaVolterra::HAS_DOMAIN && Root::HAS_DOMAIN && !Fast::HAS_DOMAIN) };
}
