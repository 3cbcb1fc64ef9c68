//! The smallest program: a pendulum, the first three of its states, and its energy after a million steps.

use dvi_core::prelude::*;

/// A pendulum; its coordinate is the angle from the vertical, in radians.
#[lagrangian(
    coordinates(angle),
    lagrangian = dot(angle).powi(2) / 2.0 + g / length * angle.cos(),
)]
struct Pendulum {
    g: f64,
    length: f64,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let pendulum = Pendulum { g: 9.81, length: 1.0 };
    let start = PendulumState { angle: 2.0, dot_angle: 0.0 };
    let step = 0.01;
    let mut run = Integrator::new(&pendulum, Variational::trapezoid(), step, start)?;
    let energy = run.energy();
    for state in run.by_ref().take(3) {
        let state = state?;
        println!("angle {:.6}, velocity {:.6}", state.angle, state.dot_angle);
    }
    run.take_steps(1_000_000)?;
    println!("at t = {:.2} the energy is {:.4}; it was {energy:.4}", run.time(), run.energy());
    Ok(())
}
