//! Every method on every kind of system, interrupted at each look: the same as without.

use std::fmt::Debug;
use std::time::Duration;

use dvi_core::ensemble::Ensemble;
use dvi_core::methods::Method;
use dvi_core::prelude::*;
use dvi_tests::zoo::constrained::{Pendulum, PendulumState};
use dvi_tests::zoo::gauges::{OneSided, OneSidedState};
use dvi_tests::zoo::impacts::{Ball, BallState};
use dvi_tests::zoo::manifold::{Body, BodyState};

use crate::ensemble::{Checked, HenonHeiles, HenonHeilesState, bytes, file, wells};

/// The second half of the states leads to failures, or is meant to.
fn check<S, M>(name: &str, system: &S, method: M, h: f64, states: &[S::State<f64>]) -> Checked
where
    S: Lagrangian + Debug + Sync,
    S::State<f64>: Sync,
    M: Method<S, f64> + Clone + Sync + Debug,
{
    let ensemble = || Ensemble::new(system, method.clone(), h, states.iter().cloned());
    let plain = ensemble().stride(3).take_steps(31)?;
    let path = file(&format!("{name}.ckpt"));
    let interrupted = ensemble().stride(3).checkpoints(&path, Duration::ZERO).take_steps(31)?;
    let [plain, interrupted] = [bytes(&plain)?, bytes(&interrupted)?];
    assert!(
        plain == interrupted,
        "{name}:\n{}{}",
        String::from_utf8_lossy(&plain[0]),
        String::from_utf8_lossy(&interrupted[0])
    );
    Ok(())
}

#[test]
fn of_regular_systems() -> Checked {
    let mut states = wells(2);
    // They fall without end, until numbers end.
    states.extend((0..5).map(|k| HenonHeilesState {
        x: -10.0_f64.powi(k),
        y: -2.0,
        dot_x: 0.0,
        dot_y: 0.1,
    }));
    let (system, h, states) = (&HenonHeiles, 0.3, &states[..]);
    check("trapezoid", system, Variational::trapezoid(), h, states)?;
    check("midpoint", system, Variational::midpoint(), h, states)?;
    check("simpson", system, Variational::simpson(), -h, states)?;
    check("galerkin", system, Galerkin::<3>::new(), h, states)?;
    check("galerkin-nine", system, Galerkin::<9>::new(), h, states)?;
    check("galerkin-lanes", system, Galerkin::<9>::new().in_lanes(), h, states)?;
    check("newmark", system, Newmark::new(0.25), h, states)?;
    check("gauss", system, Gauss::<2>::new(), h, states)?;
    check("gauss-lanes", system, Gauss::<4>::new().in_lanes(), h, states)?;
    check("heun", system, RungeKutta::heun(), h, states)?;
    check("classical", system, RungeKutta::classical(), h, states)?;
    check("composition", system, Composition::kahan_li_8(Variational::trapezoid()), h, states)?;
    check("langevin", system, Langevin { friction: 1.0, temperature: 0.01, seed: 3 }, h, states)?;
    let compensated = Variational { summation: Summation::Compensated, ..Variational::trapezoid() };
    check("compensated", system, compensated, h, states)?;
    check("limit", system, EnergyLimit { method: Variational::midpoint(), limit: 0.1 }, h, states)?;
    check("fitted", system, Variational::simpson().phase_fitted(Constant(1.0)), h, states)
}

#[test]
fn of_degenerate_systems() -> Checked {
    #[degenerate_lagrangian(
        coordinates(x, y),
        one_form = y.ln() / x * d(x),
        hamiltonian = x + y - x.ln() - 2.0 * y.ln(),
        time_transform = 1.0 / (x + y),
    )]
    #[derive(Debug)]
    struct Slow;
    let predators = OneSided { a: [1.0; 2], b: [-1.0, -2.0] };
    let state = |k: u32| OneSidedState { x: 1.0 + 0.5 * f64::from(k), y: 1.0 - 0.24 * f64::from(k) };
    let states: Vec<_> = (0..6).map(state).collect();
    check("one-step", &predators, OneStep::midpoint(), 0.3, &states)?;
    check("one-step-gauss", &predators, OneStepGauss::<2>::new(), 0.3, &states)?;
    check("projected", &predators, Projected::symmetric(), 0.1, &states)?;
    check("sigma", &predators, Sigma::midpoint(), 0.1, &states)?;
    check("degenerate-gauss", &predators, Gauss::<3>::new(), 0.3, &states)?;
    let state = |k: u32| SlowState { x: 1.0 + f64::from(k), y: 0.9, t: 0.0, energy: 0.0 };
    let mut states = (0..4).map(|k| Slow.with_energy(state(k))).collect::<Result<Vec<_>, _>>()?;
    states.push(state(5));
    check("transformed", &Slow, OneStep::midpoint(), 0.3, &states)?;
    check("transformed-gauss", &Slow, OneStepGauss::<3>::new(), 0.3, &states)
}

#[test]
fn with_constraints_impacts_and_rotations() -> Checked {
    let bob = Pendulum { m: 1.0, g: 1.0, length: 1.0 };
    let state =
        |k: u32| PendulumState { x: f64::from(k).sin(), y: f64::from(k).cos(), dot_x: 0.0, dot_y: 0.0 };
    let mut states: Vec<_> = (0..4).map(state).collect();
    states.push(PendulumState { x: 2.0, y: 0.0, dot_x: 0.0, dot_y: 0.0 });
    states.push(PendulumState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 40.0 });
    check("rattle", &bob, Rattle::default(), 0.1, &states)?;
    check("constrained", &bob, Constrained::new(Variational::midpoint()), 0.1, &states)?;

    let states: Vec<_> = (0..5).map(|k| BallState { y: -0.5 + 0.3 * f64::from(k), dot_y: 0.1 }).collect();
    check("impacts", &Ball { m: 1.0 }, Impacts::reflecting(Variational::trapezoid()), 0.1, &states)?;
    check(
        "restitution",
        &Ball { m: 1.0 },
        Impacts { restitution: 0.5, ..Impacts::new(Variational::midpoint()) },
        0.1,
        &states,
    )?;

    let top = Body { inertia: [1.0, 2.0, 3.0], tip: [0.0, 0.0, 1.0], weight: -1.0 };
    let state = |k: u32| {
        let rotation = dvi_core::rotations::exp([0.1 * f64::from(k), 0.2, 0.3]);
        BodyState { R: rotation, omega_R: [0.1, f64::from(k), 1.0] }
    };
    let states: Vec<_> = (0..4).map(state).collect();
    check("geodesic", &top, Geodesic::midpoint(), 0.1, &states)?;
    check("geodesic-trapezoid", &top, Geodesic::trapezoid(), 0.1, &states)?;

    #[lagrangian(
        coordinates(s[2]: S2, R[2]: SO3),
        lagrangian = sum(0..2, |i| dot(s[i]).norm_squared() + omega(R[i]).norm_squared()) - s[0].dot(s[1]) - R[0].column(1).dot(s[1]),
    )]
    #[derive(Debug)]
    struct Rotors;
    let state = |k: u32| {
        let rotation = dvi_core::rotations::exp([0.1 * f64::from(k), 0.2, 0.3]);
        RotorsState {
            s: [[0.6, 0.0, 0.8], [0.0, 1.0, 0.0]],
            R: [rotation; 2],
            dot_s: [[0.0, f64::from(k), 0.0], [0.5, 0.0, 0.0]],
            omega_R: [[0.1, 0.2, f64::from(k)], [1.0, 0.0, 0.0]],
        }
    };
    let states: Vec<_> = (0..4).map(state).collect();
    check("geodesic-arrays", &Rotors, Geodesic::trapezoid(), 0.1, &states)
}
