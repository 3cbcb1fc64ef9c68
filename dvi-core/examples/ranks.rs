//! An ensemble over the processes of an MPI program: pendulums that begin at random angles, with a restoring
//! torque and a drive.
//!
//! `cargo build --release -p dvi-core --features mpi --example ranks`, and then
//! `mpirun -n 4 target/release/examples/ranks results.csv`. The table is the same, byte for byte, for every
//! number of processes. `tests/mpi/run` compares them.

use std::error::Error;
use std::fs::File;

use dvi_core::ensemble::{Draws, Ensemble};
use dvi_core::prelude::*;
use mpi::Threading;
use mpi::traits::Communicator;

#[lagrangian(
    coordinates(angle),
    lagrangian = dot(angle).powi(2) / 2.0 + angle.cos() + drive * angle * t.cos(),
)]
#[derive(Debug, PartialEq)]
struct Pendulum {
    drive: f64,
}

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).ok_or("the name of the table is missing")?;
    let (universe, _) = mpi::initialize_with_threading(Threading::Funneled).ok_or("MPI has begun before")?;
    let world = universe.world();
    let states = Draws::new(11).take(1001, |draw| PendulumState {
        angle: draw.uniform(-3.0, 3.0),
        dot_angle: draw.normal(0.0, 0.5),
    });
    let results = Ensemble::new(&Pendulum { drive: 0.5 }, Variational::trapezoid(), 0.05, states)
        .until(["has turned over"], |_, state, _| [state.angle.abs() - 10.0])
        .stride(10)
        .take_steps_on(&world, 5000)?;
    if let Some(results) = results {
        results.record()?.write_csv(File::create(&path)?)?;
        println!("{} members on {} processes: {path}", results.members().len(), world.size());
    }
    Ok(())
}
