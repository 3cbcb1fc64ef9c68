//! Any number of bodies: N point vortices in the plane, declared once. Here two pairs that leapfrog past
//! each other.

use std::fs::{self, File};

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
    let start = VorticesState { x: [-1.0, 1.0, -1.0, 1.0], y: [2.0, 2.0, -2.0, -2.0] };
    let mut run = Integrator::new(&system, Sigma::midpoint(), 0.1, start)?;
    let record = run.record(1, 3000)?;

    println!("after t = {:.0}", run.time());
    for name in ["energy", "impulse_y", "angular"] {
        let values = record.numbers(name)?;
        println!("{name} changed by {:.0e}", (values[3000] - values[0]).abs());
    }
    println!("\nWhat the compiler saw:\n{}", Vortices::<4>::REPORT);
    fs::create_dir_all("results")?;
    record.write_csv(File::create("results/vortices.csv")?)?;
    record.write_page(File::create("results/vortices.html")?)?;
    println!("The table is results/vortices.csv, and results/vortices.html shows the motion.");
    Ok(())
}
