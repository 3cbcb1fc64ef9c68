//! The smallest program: a pendulum, a page with its first swings, and its energy after a million steps.

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
    let mut run = Integrator::new(&pendulum, Variational::trapezoid(), 0.01, start)?;
    let energy = run.energy();

    let record = run.record(1, 600)?; // the state now, and after each of 600 steps
    record.write_page(std::fs::File::create("pendulum.html")?)?; // opens in a browser

    run.take_steps(1_000_000)?;
    let state = run.state();
    println!("t = {:.2}: angle {:.6}, velocity {:.6}", run.time(), state.angle, state.dot_angle);
    println!("the energy is {:.4}; it was {energy:.4}", run.energy());
    Ok(())
}
