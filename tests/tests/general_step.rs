//! The fast steps of the methods against the general step of the same discrete Lagrangian.

use approx::assert_abs_diff_eq;
use dvi_core::Lagrangian;
use dvi_core::methods::InnerScheme;
use dvi_core::methods::{General, Method};
use dvi_core::prelude::*;
use dvi_core::system::Unconstrained;
use dvi_tests::configurations::quasi_periodic;
use dvi_tests::larger;
use dvi_tests::systems::*;
use dvi_tests::zoo::regular::*;

type Outcome = Result<(), Box<dyn core::error::Error>>;

/// Twenty steps of both, forward and back.
fn check<
    S: Lagrangian + System<Kind: Unconstrained>,
    M: Method<S, f64> + InnerScheme<S, f64> + Copy + core::fmt::Debug,
>(
    system: &S,
    method: M,
    start: &S::State<f64>,
) -> Outcome {
    compare(system, [method, method], start)
}

/// The same of a method with options that the general step refuses, and of one without.
fn compare<
    S: Lagrangian + System<Kind: Unconstrained>,
    M: Method<S, f64> + InnerScheme<S, f64> + Copy + core::fmt::Debug,
>(
    system: &S,
    [method, inner]: [M; 2],
    start: &S::State<f64>,
) -> Outcome {
    for h in [0.05, -0.05] {
        let mut fast = Integrator::new_at(system, method, 0.3, h, start.clone())?;
        let mut general = Integrator::new_at(system, General::new(inner), 0.3, h, start.clone())?;
        for _ in 0..20 {
            fast.advance()?;
            general.advance()?;
            let apart = fast.q().iter().zip(general.q()).map(|(a, b)| (a - b).abs()).fold(0.0, larger);
            assert!(apart < 1e-13, "{}, {method:?}, step {}: {apart:e}", S::REPORT.system, fast.steps());
            assert_abs_diff_eq!(fast.energy(), general.energy(), epsilon = 1e-12);
        }
    }
    Ok(())
}

#[test]
fn steps_on_degenerate_systems_equal_the_general_step() -> Outcome {
    let (vortices, start) = quasi_periodic();
    let prey = LotkaVolterra { a: [1.0, 1.0], b: [-1.0, -2.0] };
    for solver in [Solver::FixedPoint, Solver::Newton] {
        // The affine midpoint, which starts from p = α(q) as the general step does.
        let both = [Sigma { solver, ..Sigma::midpoint() }, Sigma::midpoint()];
        compare(&vortices, both, &start)?;
        compare(&Oscillator { omega: 1.3 }, both, &OscillatorState { x: 0.3, y: 1.0 })?;
        let refused = Integrator::new(&vortices, General::new(both[0]), 0.1, start).map(drop);
        assert!(matches!(refused, Err(StartError::Unsupported { .. })), "{refused:?}");
    }
    // With a start of their own: the explicit leapfrog, other σ, a nonlinear α.
    for sigma in [0.0, 0.25, 1.0] {
        from_its_momentum(&vortices, Sigma { parasitic_limit: None, ..Sigma::new(sigma) }, &start)?;
    }
    for sigma in [0.25, 0.5] {
        let method = Sigma { parasitic_limit: None, ..Sigma::new(sigma) };
        from_its_momentum(&prey, method, &LotkaVolterraState { x: 1.3, y: 1.6 })?;
    }
    Ok(())
}

/// The same from the second point of the fast run: both preserve the pair (q0, q1) as the state of a
/// two-step map.
fn from_its_momentum<S: DegenerateLagrangian>(system: &S, method: Sigma, start: &S::State<f64>) -> Outcome {
    use dvi_core::methods::Carries;
    use dvi_core::state::Statistics;
    let h = 0.02;
    let mut fast = Integrator::new(system, method, h, start.clone())?;
    let general = General::new(method);
    let mut q = dvi_core::Space::vector(system.space());
    q.copy_from_slice(fast.q());
    let mut memory: <General<Sigma> as Carries<S, f64>>::Memory = general.begin(system, &q, &[], 0.0, h)?;
    // p = α(q) + c.
    let mut p = q.clone();
    system.one_form(fast.q(), 0.0, &mut p);
    for (p, &c) in p.iter_mut().zip(fast.memory().defect()) {
        *p += c;
    }
    memory.set_p(&p);
    for step in 0..20 {
        general.step(system, &mut memory, &mut q, f64::from(step) * h, h, &mut Statistics::default())?;
        fast.advance()?;
        let apart = fast.q().iter().zip(q.iter()).map(|(a, b)| (a - b).abs()).fold(0.0, larger);
        // The parasitic mode of a nonlinear α grows by some 3 a step, and with it the difference of their
        // roundings.
        let bound = if S::AFFINE { 1e-12 } else { 1e-14 * 4.0_f64.powi(step + 3) };
        assert!(apart < bound, "{}, σ = {}, step {step}: {apart:e}", S::REPORT.system, method.sigma);
    }
    Ok(())
}

#[test]
fn steps_on_regular_systems_equal_the_general_step() -> Outcome {
    let kepler = Kepler { mu: 1.0 };
    let start = KeplerState { x: 0.8, y: 0.1, dot_x: -0.1, dot_y: 1.1 };
    // Störmer–Verlet, and the fixed point that needs forces only.
    check(&kepler, Variational::trapezoid(), &start)?;
    check(&kepler, Variational::midpoint(), &start)?;
    check(&kepler, Variational::simpson(), &start)?;
    check(&kepler, Variational::sigma(0.0), &start)?;
    check(&kepler, Variational::simpson().phase_fitted(Constant(1.3)), &start)?;
    let compensated = Variational { summation: Summation::Compensated, ..Variational::simpson() };
    compare(&kepler, [compensated, Variational::simpson()], &start)?;
    let pendulums = DoublePendulum { mass: [1.0, 0.7], length: [1.0, 0.8], g: 1.0 };
    check(
        &pendulums,
        Variational::midpoint(),
        &DoublePendulumState { a: 0.5, b: 0.2, dot_a: 0.4, dot_b: -0.7 },
    )?;
    let driven = DrivenOscillator { depth: 0.3, omega: 2.0 };
    check(&driven, Variational::trapezoid(), &DrivenOscillatorState { x: 0.4, dot_x: 0.9 })
}

/// The displacements are solved for with q1 by the methods, and before it by their discrete Lagrangian.
#[test]
fn steps_with_interior_displacements_equal_the_general_step() -> Outcome {
    let kepler = Kepler { mu: 1.0 };
    let start = KeplerState { x: 0.8, y: 0.1, dot_x: -0.1, dot_y: 1.1 };
    check(&kepler, Galerkin::<3>::new(), &start)?;
    check(&kepler, Galerkin::<4>::new(), &start)?;
    check(&kepler, Galerkin::<5>::new(), &start)?;
    check(&kepler, Galerkin::<9>::new(), &start)?;
    check(&kepler, Galerkin::<4>::new().phase_fitted(Constant(1.3)), &start)?;
    let driven = DrivenOscillator { depth: 0.3, omega: 2.0 };
    check(&driven, Galerkin::<4>::new(), &DrivenOscillatorState { x: 0.4, dot_x: 0.9 })?;
    let pendulums = DoublePendulum { mass: [1.0, 0.7], length: [1.0, 0.8], g: 1.0 };
    check(&pendulums, Galerkin::<3>::new(), &DoublePendulumState { a: 0.5, b: 0.2, dot_a: 0.4, dot_b: -0.7 })
}

/// L = ẋ²/2 + kẏ²/2 − (x² + y²)/2.
#[lagrangian(
    coordinates(x, y),
    lagrangian = dot(x).powi(2) / 2.0 + k * dot(y).powi(2) / 2.0 - (x * x + y * y) / 2.0,
)]
struct TwoSprings {
    k: f64,
}

#[test]
fn what_no_step_can_take_is_refused_at_the_start() {
    let start = TwoSpringsState { x: 1.0, y: 0.5, dot_x: 0.0, dot_y: 0.0 };
    for alpha in [-1.0, 2.0, f64::NAN] {
        let inner = General::new(Variational::sigma(alpha));
        let refused = Integrator::new(&TwoSprings { k: 1.0 }, inner, 0.1, start).err();
        assert!(matches!(refused, Some(StartError::Parameter { .. })), "{refused:?}");
        let (vortices, start) = quasi_periodic();
        let refused = Integrator::new(&vortices, General::new(Sigma::new(alpha)), 0.1, start).err();
        assert!(matches!(refused, Some(StartError::Parameter { name: "sigma", .. })), "{refused:?}");
    }
    let singular =
        Integrator::new(&TwoSprings { k: 0.0 }, General::new(Variational::sigma(0.3)), 0.1, start).err();
    assert!(
        matches!(singular, Some(StartError::Singular { matrix: "the mass matrix", entry, .. })
            if entry.to_string() == "y"),
        "{singular:?}"
    );
}
