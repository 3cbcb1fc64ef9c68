//! Steps that follow the motion: a comet with eccentricity 0.95, with steps in proportion to r^(3/2) that
//! can be taken backwards, and with as many steps of equal length.

use std::f64::consts::TAU;
use std::fs::{self, File};
use std::io::{BufWriter, Write as _};

use dvi_core::prelude::*;

/// A comet around a fixed sun.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 + mu / x.hypot(y),
    momenta(angular = x * dot(y) - y * dot(x)),
)]
struct Kepler {
    mu: f64,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let kepler = Kepler { mu: 1.0 };
    // The pericentre of an orbit of semi-major axis 1 and period 2π.
    let start: KeplerState = KeplerState { x: 0.05, y: 0.0, dot_x: 0.0, dot_y: 39.0_f64.sqrt() };
    let method = Variational::trapezoid();
    let mut run = ControlledIntegrator::new(&kepler, method, Reversible::power(0.02, 1.5), start)?;
    let energy = run.energy();

    fs::create_dir_all("results")?;
    let mut table = BufWriter::new(File::create("results/kepler.csv")?);
    writeln!(table, "t,step,x,y,energy_error")?;
    let mut largest = 0.0_f64;
    while run.time() < 100.0 * TAU {
        let (t, h, error) = (run.time(), run.step_size(), run.energy() - energy);
        largest = largest.max(error.abs());
        writeln!(table, "{t},{h},{},{},{error:e}", run.q()[0], run.q()[1])?;
        run.advance()?;
    }
    table.flush()?;
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
    println!("The table is results/kepler.csv.");
    Ok(())
}
