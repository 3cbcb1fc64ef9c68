//! RATTLE as it was written by hand, and the fast step against the general
//! one.

use approx::{abs_diff_eq, assert_abs_diff_eq};
use dvi_core::prelude::*;
use dvi_tests::larger;
use dvi_tests::zoo::constrained::*;

use super::Outcome;

/// RATTLE for a mass on a rod, from its textbook equations.
struct ByHand {
    system: Pendulum,
    q: [f64; 2],
    p: [f64; 2],
}

impl ByHand {
    /// A step; returns the multipliers at both ends, times h.
    fn step(&mut self, h: f64) -> [f64; 2] {
        let Pendulum { m, g, length } = self.system;
        let (force, start) = ([0.0, -m * g], self.q);
        let half = [0, 1].map(|i| self.p[i] + h / 2.0 * force[i]);
        let mut impulse = 0.0;
        let mut q = start;
        for _ in 0..50 {
            q = [0, 1].map(|i| start[i] + h / m * (half[i] + 2.0 * start[i] * impulse));
            let g = q[0] * q[0] + q[1] * q[1] - length * length;
            let slope = 4.0 * h / m * (q[0] * start[0] + q[1] * start[1]);
            impulse -= g / slope;
        }
        let p = [0, 1].map(|i| half[i] + 2.0 * start[i] * impulse + h / 2.0 * force[i]);
        let across = (q[0] * p[0] + q[1] * p[1]) / (q[0] * q[0] + q[1] * q[1]);
        (self.q, self.p) = (q, [0, 1].map(|i| p[i] - across * q[i]));
        [impulse, -across / 2.0]
    }
}

#[test]
fn rattle_by_hand() -> Outcome {
    let system = Pendulum { m: 1.7, g: 2.0, length: 1.3 };
    let start = PendulumState { x: 1.3, y: 0.0, dot_x: 0.0, dot_y: -0.4 };
    let mut by_hand = ByHand { system, q: [1.3, 0.0], p: [0.0, -0.4 * 1.7] };
    let mut rattle = Integrator::new(&system, Rattle::default(), 0.1, start)?;
    let mut general =
        Integrator::new(&system, Constrained::new(Variational::new(Quadrature::trapezoid())), 0.1, start)?;
    for _ in 0..100 {
        let [first, last] = by_hand.step(0.1);
        rattle.advance()?;
        general.advance()?;
        let found = [
            (rattle.q(), rattle.memory().p(), rattle.memory().impulses()),
            (general.q(), general.memory().p(), general.memory().impulses()),
        ];
        for (q, p, impulses) in found {
            for i in 0..2 {
                assert!((q[i] - by_hand.q[i]).abs() < 1e-12 && (p[i] - by_hand.p[i]).abs() < 1e-12);
            }
            assert!(abs_diff_eq!(impulses[0][0], first, epsilon = 1e-12), "{impulses:?} {first}");
            assert!(abs_diff_eq!(impulses[1][0], last, epsilon = 1e-12), "{impulses:?} {last}");
        }
    }
    Ok(())
}

/// Both steps of the trapezoidal rule, forward and back.
fn check_rattle<S>(system: &S, start: &S::State<f64>, h: f64) -> Outcome
where
    S: HolonomicLagrangian + dvi_core::Separable,
{
    for h in [h, -h] {
        let mut fast = Integrator::new_at(system, Rattle::default(), 0.3, h, start.clone())?;
        let method = Constrained::new(Variational::new(Quadrature::trapezoid()));
        let mut general = Integrator::new_at(system, method, 0.3, h, start.clone())?;
        for _ in 0..40 {
            fast.advance()?;
            general.advance()?;
            let (found, expected) = (fast.state(), general.state());
            let apart = system
                .values(&found)?
                .zip(system.values(&expected)?)
                .map(|(a, b)| (a - b).abs())
                .fold(0.0, larger);
            assert!(apart < 1e-12, "{}, step {}: {apart:e}", S::REPORT.system, fast.steps());
            let multipliers = fast.memory().multipliers().zip(general.memory().multipliers());
            let apart = multipliers.map(|(a, b)| (a - b).abs()).fold(0.0, larger);
            assert!(apart < 1e-10, "{}, multipliers: {apart:e}", S::REPORT.system);
        }
    }
    Ok(())
}

#[test]
fn rattle_is_the_general_step_of_the_trapezoidal_rule() -> Outcome {
    let angles = DoubleAngles { m: [1.0, 2.5], rod: 0.7 };
    let begin = DoubleAnglesState { a: 1.0, b: -0.4, dot_a: 0.3, dot_b: 1.1 };
    // With the longer step the inner rod whips around, and the equations of a step have a second solution
    // not far away.
    for h in [0.05, 0.1] {
        check_rattle(&Double { m: angles.m, rod: angles.rod }, &angles.masses(&begin), h)?;
    }
    check_rattle(&Spherical, &SphericalState { r: [0.6, 0.0, -0.8], dot_r: [0.4, 1.0, 0.3] }, 0.05)?;
    let (links, start) = links(6);
    check_rattle(&links, &start, 0.02)?;
    let (ring, start) = ring()?;
    check_rattle(&ring, &start, 0.02)
}

/// Rods of many lengths, stretched out to one side.
pub(crate) fn links(n: usize) -> (Links, LinksState) {
    let rod: Vec<f64> = (0..n).map(|i| 0.5 + 0.1 * (i % 4) as f64).collect();
    let x = rod.iter().scan(0.0, |sum, rod| {
        *sum += rod;
        Some(*sum)
    });
    let x: Vec<f64> = x.collect();
    (Links { rod }, LinksState { x, y: vec![0.0; n], dot_x: vec![0.0; n], dot_y: vec![0.0; n] })
}

/// A pentagon in rotation.
pub(crate) fn ring() -> Result<(Ring<5>, RingState<5>), dvi_core::error::StartError> {
    let system = Ring { mass: [1.0, 1.2, 0.8, 1.5, 1.0] };
    let angle = |i: usize| i as f64 * std::f64::consts::TAU / 5.0;
    let [cos, sin] = [f64::cos, f64::sin].map(|f| core::array::from_fn(|i| f(angle(i))));
    let (dot_x, dot_y) = (core::array::from_fn(|i: usize| -angle(i).sin() + 0.3 * i as f64), cos);
    let state = system.projected(0.0, &RingState { x: cos, y: sin, dot_x, dot_y })?;
    Ok((system, state))
}

/// Masses, and rods between as many of them as is said.
#[lagrangian(
    coordinates(x[2]),
    lagrangian = sum(0..2, |i| (1.0 + i as f64) * dot(x[i]).powi(2) / 2.0 - x[i].powi(4) / 4.0),
    constraint(k in 0..rods) = x[k] - x[k + 1] - 1.0,
)]
#[derive(Clone, Copy, Debug)]
struct Rods {
    rods: usize,
}

/// The same masses without any.
#[lagrangian(
    coordinates(x[2]),
    lagrangian = sum(0..2, |i| (1.0 + i as f64) * dot(x[i]).powi(2) / 2.0 - x[i].powi(4) / 4.0),
)]
#[derive(Clone, Copy, Debug)]
struct Free;

/// With no constraint among those that are declared, a step is that of Störmer and Verlet, bit by bit.
#[test]
fn without_a_constraint_rattle_is_verlet() -> Outcome {
    let (x, dot_x) = ([0.3, -0.8], [1.0, 0.7]);
    let mut rattle = Integrator::new(&Rods { rods: 0 }, Rattle::default(), 0.1, RodsState { x, dot_x })?;
    let mut verlet = Integrator::new(&Free, Variational::trapezoid(), 0.1, FreeState { x, dot_x })?;
    for _ in 0..100 {
        rattle.advance()?;
        verlet.advance()?;
        assert_eq!(rattle.q(), verlet.q());
        assert_eq!(rattle.state().dot_x, verlet.state().dot_x);
    }
    let start = RodsState { x: [0.3, -0.7], dot_x: [1.0, 1.0] };
    let mut bound = Integrator::new(&Rods { rods: 1 }, Rattle::default(), 0.1, start)?;
    bound.take_steps(10)?;
    let apart: f64 = bound.q()[0] - bound.q()[1];
    assert_abs_diff_eq!(apart, 1.0, epsilon = 1e-15);
    Ok(())
}
