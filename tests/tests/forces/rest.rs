//! Friction whose derivative is infinite at rest, in runs that begin there.

use dvi_core::prelude::*;
use dvi_tests::oracle;

use super::Outcome;

/// A mass that depends on the position, and R = |v|^(3/2): ∂F/∂v is infinite at rest.
#[lagrangian(
    coordinates(x),
    lagrangian = (1.0 + x * x) * dot(x).powi(2) / 2.0 - x,
    dissipation = dot(x).abs().powf(1.5),
)]
struct Bead;

/// The same force, and one more whose derivative at rest is 0·∞ as it is written.
#[lagrangian(
    coordinates(x),
    lagrangian = (1.0 + x * x) * dot(x).powi(2) / 2.0 - x,
    force = [-1.5 * dot(x).abs().sqrt() * dot(x).signum() - dot(x).abs().sqrt() * dot(x)],
)]
struct Dragged;

/// A rod around the origin.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 - y,
    constraint = x * x + y * y - 1.0,
    dissipation = (dot(x).powi(2) + dot(y).powi(2)).powf(0.75),
)]
struct Rod;

/// x(1) of x'' = a(x, x') from `x`, at rest, in 20,000 steps.
fn reference(x: f64, a: impl Fn(f64, f64) -> f64) -> f64 {
    let rates = |y: &[f64], _| vec![y[1], a(y[0], y[1])];
    (0..20_000).fold(vec![x, 0.0], |y, _| oracle::runge_kutta(rates, &y, [0.0, 5e-5]))[0]
}

fn friction(v: f64) -> f64 {
    -1.5 * v.abs().sqrt() * v.signum()
}

#[test]
fn a_run_with_a_varying_mass_begins_at_rest() -> Outcome {
    let bead = reference(1.0, |x, v| (friction(v) - 1.0 - x * v * v) / (1.0 + x * x));
    let drag = |v: f64| friction(v) - v.abs().sqrt() * v;
    let dragged = reference(1.0, |x, v| (drag(v) - 1.0 - x * v * v) / (1.0 + x * x));
    macro_rules! check {
        ($system:ident, $state:ident, $expected:expr, $($method:expr),*) => {$({
            let mut run = Integrator::new(&$system, $method, 1e-3, $state { x: 1.0, dot_x: 0.0 })?;
            run.take_steps(1000)?;
            assert!((run.state().x - $expected).abs() < 1e-6, "{:?} {}", run.state(), $expected);
        })*};
    }
    let newton = Gauss { solver: Solver::Newton, ..Gauss::<2>::new() };
    check!(Bead, BeadState, bead, Variational::midpoint(), Variational::trapezoid(), Galerkin::<3>::new());
    check!(Dragged, DraggedState, dragged, Variational::midpoint(), Gauss::<2>::new(), newton);
    Ok(())
}

#[test]
fn a_run_with_constraints_begins_at_rest() -> Outcome {
    let angle = reference(0.0, |angle, v| friction(v) - angle.cos());
    let start = RodState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 0.0 };
    let mut run = Integrator::new(&Rod, Constrained::new(Midpoint), 1e-3, start)?;
    run.take_steps(1000)?;
    assert!((run.state().y - angle.sin()).abs() < 1e-6, "{:?} {angle}", run.state());
    Ok(())
}

/// Coulomb friction: the force has no value at rest.
#[lagrangian(coordinates(r[2]), lagrangian = dot(r).norm_squared() / 2.0 - r[1], dissipation = dot(r).norm())]
struct Block;

#[test]
fn a_force_that_is_not_defined_at_rest_is_named() {
    let start = BlockState { r: [1.0, 0.0], dot_r: [0.0; 2] };
    let message = Integrator::new(&Block, Variational::midpoint(), 0.1, start).err().map(|e| e.to_string());
    let expected =
        "the applied force (`force`, and −∂R/∂v of `dissipation`) along `r[0]` is NaN at the initial state";
    assert!(message.as_ref().is_some_and(|message| message.starts_with(expected)), "{message:?}");
}
