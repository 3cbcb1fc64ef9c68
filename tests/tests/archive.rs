//! Long runs in one file: each state again, bit for bit, after anything that may happen to process and file.

mod damaged;
mod killed;
mod same;

use std::path::PathBuf;

use dvi_core::archive::{Archive, ArchiveError, Every};
use dvi_core::prelude::*;
use dvi_tests::zoo::regular::{Kepler, KeplerState};
use dvi_tests::{Outcome, bits};

type Verlet = Variational<Unfitted, Trapezoid>;

/// A run on a system of its own.
fn planet() -> Result<Integrator<Kepler, Verlet>, StartError> {
    let start = KeplerState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 0.8 };
    Integrator::new(Kepler { mu: 1.0 }, Variational::trapezoid(), 0.05, start)
}

/// A path at which there is no file.
fn file(name: &str) -> Outcome<PathBuf> {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    match std::fs::remove_file(&path) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => Err(error.into()),
        _ => Ok(path),
    }
}

/// All that can be said of where a run is, numbers as bits.
fn place<R: Run<Scalar = f64>>(run: &R) -> (Vec<u64>, Checkpoint) {
    (bits(&[run.q(), &run.v(), &[run.time(), run.energy()]].concat()), run.checkpoint())
}

/// The run after so many steps, without an archive.
fn alone<R: Run<Scalar = f64>>(mut run: R, steps: u64) -> Result<(Vec<u64>, Checkpoint), StepError> {
    run.take_steps(steps)?;
    Ok(place(&run))
}

/// The number of steps of each checkpoint.
fn kept<H, M, C>(archive: &Archive<Integrator<H, M, f64, C>>) -> Vec<u64>
where
    H: Held<System: Lagrangian> + Clone,
    M: Method<H::System, f64> + Clone + core::fmt::Debug,
    C: StepControl<H::System, f64> + Clone,
{
    archive.checkpoints().map(|(steps, _)| steps).collect()
}
