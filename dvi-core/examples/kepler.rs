//! Steps that follow the motion: a comet with eccentricity 0.95, with steps in proportion to r^(3/2) that
//! can be taken backwards, and with as many steps of equal length.

use std::f64::consts::TAU;
use std::fs::{self, File};

use dvi_core::prelude::*;
use dvi_core::record::{Column, Recorder};

/// A comet around a fixed sun.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 + mu / (x * x + y * y).sqrt(),
    momenta(angular = x * dot(y) - y * dot(x)),
)]
struct Kepler {
    mu: f64,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let kepler = Kepler { mu: 1.0 };
    // The pericentre of an orbit of semi-major axis 1 and period 2π.
    let start = KeplerState { x: 0.05, y: 0.0, dot_x: 0.0, dot_y: 39.0_f64.sqrt() };
    let method = Variational::trapezoid();
    let mut run = Integrator::controlled(&kepler, method, Reversible::power(0.02, 1.5), start)?;
    let energy = run.energy();

    let (mut recorder, mut steps) = (Recorder::new(&kepler), Vec::new());
    while run.time() < 100.0 * TAU {
        recorder.push(&kepler, run.time(), &run.state())?;
        steps.push(run.step_size());
        run.advance()?;
    }
    let record = recorder.finish().with_column(Column::new("step", steps))?;
    let largest = record.numbers("energy")?.iter().map(|now| (now - energy).abs()).fold(0.0, f64::max);
    println!("{} steps for 100 orbits", run.steps());
    println!("largest energy error with steps that follow the motion: {largest:.1e}");

    let h = 100.0 * TAU / run.steps() as f64;
    let mut fixed = Integrator::new(&kepler, method, h, start)?;
    let mut largest = 0.0_f64;
    for _ in 0..run.steps() {
        fixed.advance()?;
        largest = largest.max((fixed.energy() - energy).abs());
    }
    println!("the same with as many steps of equal length: {largest:.1e}");
    fs::create_dir_all("results")?;
    record.write_csv(File::create("results/kepler.csv")?)?;
    record.write_page(File::create("results/kepler.html")?)?;
    println!("The table is results/kepler.csv, and results/kepler.html shows it.");
    Ok(())
}
