//! A system of first order, and a question to its run: predators and prey, and the period of their cycle,
//! from the times at which the prey passes its equilibrium.

use std::fs::{self, File};

use dvi_core::prelude::*;

/// Prey x and predators y: x' = x (1 - y), y' = y (x - rate).
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form    = -y.ln() / x * d(x),
    hamiltonian = x - rate * x.ln() + y - y.ln(),
)]
struct LotkaVolterra {
    rate: f64,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let system = LotkaVolterra { rate: 2.0 };
    let start = LotkaVolterraState { x: 1.0, y: 0.5 };
    let rates = system.vector_field(0.0, &start)?;
    println!("at the start x' = {} and y' = {}", rates.x, rates.y);

    let mut run = Integrator::new(&system, Gauss::<2>::new(), 0.01, start)?;
    let energy = run.energy();
    let record = run.record(1, 2000)?;

    let equilibrium = system.rate;
    let passes = run.events([Direction::Rising], |_, state| [state.x - equilibrium])?;
    let mut times = Vec::new();
    for pass in passes.take(101) {
        times.push(pass?.time);
    }
    println!("period of the cycle: {:.10}", (times[100] - times[0]) / 100.0);
    println!("energy changed by {:.0e} until t = {:.0}", (run.energy() - energy).abs(), run.time());
    fs::create_dir_all("results")?;
    record.write_csv(File::create("results/lotka-volterra.csv")?)?;
    record.write_page(File::create("results/lotka-volterra.html")?)?;
    println!("The table is results/lotka-volterra.csv, and results/lotka-volterra.html shows it.");
    Ok(())
}
