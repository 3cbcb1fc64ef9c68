//! An ensemble of motions in the potential of Hénon and Heiles: which of them leave the well, and when.
//!
//! `cargo run --release -p dvi-core --features ensembles --example ensemble` takes all cores. A run that was
//! killed goes on where it was. With `--shard 0/4`, …, `--shard 3/4` four processes share the members;
//! without `--shard` and after them, `--merge 4` puts their results together. `--out folder` says where the
//! files go.

use std::error::Error;
use std::fs::{File, create_dir_all};
use std::path::{Path, PathBuf};
use std::time::Duration;

use dvi_core::ensemble::{Draws, Ensemble, EnsembleError, Outcome, Results, Shard};
use dvi_core::prelude::*;

/// Hénon & Heiles 1964. A motion can leave the well if its energy is above 1/6.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0
        - (x * x + y * y) / 2.0 - x * x * y + y.powi(3) / 3.0,
)]
#[derive(Debug, PartialEq)]
struct HenonHeiles;

fn run(shard: Shard, checkpoint: &Path) -> Result<Results, EnsembleError> {
    let states = Draws::new(1964).take(10_000, |draw| HenonHeilesState {
        x: draw.normal(0.0, 0.2),
        y: draw.normal(0.0, 0.2),
        dot_x: draw.normal(0.0, 0.4),
        dot_y: draw.normal(0.0, 0.4),
    });
    Ensemble::new(&HenonHeiles, Variational::trapezoid(), 0.05, states)
        .until(["left the well"], |_, state, _| [state.x.hypot(state.y) - 3.0])
        .checkpoints(checkpoint, Duration::from_secs(10))
        .shard(shard)
        .on_progress(|p| eprintln!("{} of {} have ended", p.ended, p.members))
        .take_steps(20_000)
}

fn main() -> Result<(), Box<dyn Error>> {
    let (mut shard, mut merged, mut folder) = (Shard::WHOLE, None, PathBuf::from("results"));
    let mut arguments = std::env::args().skip(1);
    while let Some(name) = arguments.next() {
        let value = arguments.next().ok_or_else(|| format!("{name} needs a value"))?;
        match name.as_str() {
            "--shard" => shard = value.parse()?,
            "--merge" => merged = Some(value.parse::<u64>()?),
            "--out" => folder = value.into(),
            other => {
                return Err(format!("{other}: there are --shard i/n, --merge n and --out folder").into());
            }
        }
    }
    create_dir_all(&folder)?;
    let checkpoint = folder.join("ensemble.ckpt");
    let results = match merged {
        Some(of) => {
            let read = |index| Ok(Results::read(Shard::new(index, of)?.path(&checkpoint))?);
            Results::merge((0..of).map(read).collect::<Result<Vec<_>, Box<dyn Error>>>()?)?
        }
        None => run(shard, &checkpoint)?,
    };
    let left = results.members().iter().filter(|member| matches!(member.outcome, Outcome::Exited { .. }));
    println!("{} of {} have left the well", left.count(), results.members().len());
    let record = results.record()?;
    let file = |name: &str| File::create(shard.path(folder.join(name)));
    record.write_csv(file("ensemble.csv")?)?;
    record.write_npy(file("ensemble.npy")?)?;
    record.write_page(file("ensemble.html")?)?;
    Ok(())
}
