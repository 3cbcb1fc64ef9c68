//! Any number of bodies: N point vortices in the plane, declared once. Here two pairs that leapfrog past
//! each other.

use std::fs::{self, File};
use std::io::{BufWriter, Write as _};

use dvi_core::prelude::*;

/// Point vortices in the plane.
#[degenerate_lagrangian(
    coordinates(x[N], y[N]),
    one_form    = sum(0..N, |j| gamma[j] / 2.0 * (x[j] * d(y[j]) - y[j] * d(x[j]))),
    hamiltonian = sum_pairs(0..N, |j, k| gamma[j] * gamma[k]
                      * ((x[j] - x[k]).powi(2) + (y[j] - y[k]).powi(2)).ln()) / (4.0 * PI),
    momenta(
        impulse_y = sum(0..N, |j| gamma[j] * y[j]),
        angular   = sum(0..N, |j| gamma[j] * (x[j].powi(2) + y[j].powi(2))),
    ),
)]
struct Vortices<const N: usize> {
    gamma: [f64; N],
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let system = Vortices { gamma: [1.0, 1.0, -1.0, -1.0] };
    let start: VorticesState<4> = VorticesState { x: [-1.0, 1.0, -1.0, 1.0], y: [2.0, 2.0, -2.0, -2.0] };
    let mut run = Integrator::new(&system, Sigma::midpoint(), 0.1, start)?;
    let (energy, momenta) = (run.energy(), run.momenta().collect::<Vec<_>>());

    fs::create_dir_all("results")?;
    let mut table = BufWriter::new(File::create("results/vortices.csv")?);
    let names: Vec<String> = system.names().map(|name| name.to_string()).collect();
    writeln!(table, "t,{}", names.join(","))?;
    for _ in 0..3000 {
        let row: Vec<String> = system.values(&run.state())?.map(|value| value.to_string()).collect();
        writeln!(table, "{:.1},{}", run.time(), row.join(","))?;
        run.advance()?;
    }
    table.flush()?;
    println!("after t = {:.0}", run.time());
    println!("energy changed by {:.0e}", (run.energy() - energy).abs());
    for ((name, now), (_, before)) in run.momenta().zip(momenta) {
        println!("{name} changed by {:.0e}", (now - before).abs());
    }
    println!("\nWhat the compiler saw:\n{}", Vortices::<4>::REPORT);
    println!("The table is results/vortices.csv.");
    Ok(())
}
