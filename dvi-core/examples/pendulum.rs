//! Why variational: the energy of a pendulum, by a variational integrator and by the classical Runge–Kutta
//! method with four times as long steps, so that both evaluate the force equally often.

use std::fs::{self, File};

use dvi_core::prelude::*;
use dvi_core::record::{Column, Record, RecordError};

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
    let start = PendulumState { angle: 2.5, dot_angle: 0.0 };
    let mut variational = Integrator::new(&pendulum, Variational::trapezoid(), 0.025, start)?;
    let mut runge_kutta = Integrator::new(&pendulum, RungeKutta::classical(), 0.1, start)?;
    let energy = variational.energy();
    let error = |name: &str, record: &Record| -> Result<Column, RecordError> {
        let errors: Vec<f64> = record.numbers("energy")?.iter().map(|now| now - energy).collect();
        Ok(Column::new(name, errors))
    };
    let [ours, theirs] = [variational.record(400, 1000)?, runge_kutta.record(100, 1000)?];
    let record = Record::new("Energy errors of a pendulum")
        .with_column(theirs.column("time")?.clone())?
        .with_column(error("variational", &ours)?)?
        .with_column(error("runge_kutta", &theirs)?)?;

    println!("energy error at time t");
    println!("{:>8} {:>12} {:>12}", "t", "variational", "Runge-Kutta");
    let [t, a, b] = ["time", "variational", "runge_kutta"].map(|name| record.numbers(name));
    let (t, a, b) = (t?, a?, b?);
    for row in [1, 10, 100, 1000] {
        println!("{:>8.0} {:>12.5} {:>12.5}", t[row], a[row], b[row]);
    }
    fs::create_dir_all("results")?;
    record.write_csv(File::create("results/pendulum.csv")?)?;
    record.write_page(File::create("results/pendulum.html")?)?;
    println!("The table is results/pendulum.csv, and results/pendulum.html shows it.");
    Ok(())
}
