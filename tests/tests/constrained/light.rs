//! Coordinates that are light against the others, and systems far from the origin.

use dvi_core::prelude::*;
use dvi_tests::{Numbers, larger};

use super::Outcome;

/// A light joint between two masses, of which the first is on a rod: x₀, y₀ and x₁, y₁.
#[lagrangian(
    coordinates(x[2], y[2]),
    lagrangian = sum(0..2, |i| m[i] * (dot(x[i]).powi(2) + dot(y[i]).powi(2)) / 2.0 - m[i] * y[i]),
    constraint = [
        (x[0] - far).powi(2) + (y[0] - far).powi(2) - 1.0,
        (x[1] - x[0]).powi(2) + (y[1] - y[0]).powi(2) - 1.0,
    ],
)]
#[derive(Clone, Copy, Debug)]
struct Joint {
    m: [f64; 2],
    far: f64,
}

/// The largest constraint, and the largest of its rates of change.
fn off(system: &Joint, state: &JointState) -> [f64; 2] {
    let JointState { x, y, dot_x, dot_y } = *state;
    let q = [x[0], x[1], y[0], y[1]];
    let v = [dot_x[0], dot_x[1], dot_y[0], dot_y[1]];
    let (mut g, mut rate) = ([0.0; 2], [0.0; 2]);
    system.constraint(&q, 0.0, &mut g);
    system.constraint_rate(&q, &v, 0.0, &mut rate);
    [larger(g[0].abs(), g[1].abs()), larger(rate[0].abs(), rate[1].abs())]
}

fn follow<M: Method<Joint, f64>>(system: &Joint, method: M, start: JointState) -> Outcome<[f64; 2]> {
    let mut run = Integrator::new(system, method, 1e-3, start)?;
    let mut most = [0.0; 2];
    for _ in 0..1000 {
        run.advance()?;
        let [g, rate] = off(system, &run.state());
        most = [larger(most[0], g), larger(most[1], rate)];
    }
    Ok(most)
}

#[test]
fn a_light_joint_stays_on_its_rods() -> Outcome {
    for mass in [1.0, 1e-3, 1e-6, 1e-9, 1e-12, 1e-15] {
        for m in [[mass, 1.0], [1.0, mass]] {
            let system = Joint { m, far: 0.0 };
            let near = JointState { x: [0.9, 1.5], y: [0.1, 0.8], dot_x: [0.3, -0.2], dot_y: [0.5, 0.4] };
            let start = system.projected(0.0, &near)?;
            let trapezoid = follow(&system, Constrained::new(Quadrature::trapezoid()), start)?;
            let midpoint = follow(&system, Constrained::new(Midpoint), start)?;
            for found in
                [off(&system, &start), trapezoid, midpoint, follow(&system, Rattle::default(), start)?]
            {
                assert!(found[0] < 2e-15 && found[1] < 2e-15, "{m:?} {found:?}");
            }
        }
    }
    Ok(())
}

/// What is projected is a start of every method with every step, wherever the joint is and however slow it
/// is.
#[test]
fn what_is_projected_is_a_start() -> Outcome {
    let (mut numbers, mut missed) = (Numbers(11), 0);
    for number in 0..2000 {
        let m = [0, 1].map(|_| (20.0 * numbers.next()).exp());
        let far = 10.0_f64.powf(5.0 + 5.0 * numbers.next());
        let speed = if number % 5 == 0 { 0.0 } else { 10.0_f64.powf(20.0 * numbers.next()) };
        let [a, b] = [0, 1].map(|_| 3.0 * numbers.next());
        let (radial, other) =
            (speed * numbers.next(), if number % 2 == 0 { 0.0 } else { speed * numbers.next() });
        let near = JointState {
            x: [far + 1.1 * a.cos(), far + 1.1 * a.cos() + 0.9 * b.cos()],
            y: [far + 1.1 * a.sin(), far + 1.1 * a.sin() + 0.9 * b.sin()],
            dot_x: [radial * a.cos(), radial * a.cos() + other],
            dot_y: [radial * a.sin(), radial * a.sin() - other],
        };
        let system = Joint { m, far };
        // Between masses that differ by factors of 10¹⁰ Newton's method may lead away.
        let Ok(start) = system.projected(0.0, &near) else {
            missed += 1;
            continue;
        };
        for h in [1e-6, 1.0, 1e6] {
            Integrator::new(&system, Rattle::default(), h, start)?;
            Integrator::new(&system, Constrained::new(Midpoint), h, start)?;
        }
        system.multipliers_at(0.0, &start)?;
    }
    assert!(missed < 10, "{missed}");
    Ok(())
}
