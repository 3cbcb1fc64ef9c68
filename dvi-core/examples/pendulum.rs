//! Why variational: the energy of a pendulum, by a variational integrator and by the classical Runge–Kutta
//! method with four times as long steps, so that both evaluate the force equally often.

use std::fs::{self, File};
use std::io::{BufWriter, Write as _};

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
    let start: PendulumState = PendulumState { angle: 2.5, dot_angle: 0.0 };
    let mut variational = Integrator::new(&pendulum, Variational::trapezoid(), 0.025, start)?;
    let mut runge_kutta = Integrator::new(&pendulum, RungeKutta::classical(), 0.1, start)?;
    let energy = variational.energy();

    fs::create_dir_all("results")?;
    let mut table = BufWriter::new(File::create("results/pendulum.csv")?);
    writeln!(table, "t,variational,runge_kutta")?;
    println!("energy error at time t");
    println!("{:>8} {:>12} {:>12}", "t", "variational", "Runge-Kutta");
    for row in 1..=1000 {
        variational.take_steps(400)?;
        runge_kutta.take_steps(100)?;
        let t = runge_kutta.time();
        let errors = [variational.energy() - energy, runge_kutta.energy() - energy];
        writeln!(table, "{t},{:e},{:e}", errors[0], errors[1])?;
        if [1, 10, 100, 1000].contains(&row) {
            println!("{t:>8.0} {:>12.5} {:>12.5}", errors[0], errors[1]);
        }
    }
    table.flush()?;
    println!("The table is results/pendulum.csv.");
    Ok(())
}
