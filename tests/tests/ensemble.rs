//! Ensembles: what their records say, that they are the same however they are computed, and what becomes of
//! mistakes.

mod files;
mod limits;
mod members;
mod mistakes;
mod resumed;
mod same;
mod tables;

use dvi_core::ensemble::{Draws, EnsembleError, Results};
use dvi_core::prelude::*;
use dvi_tests::zoo::regular::{HenonHeiles, HenonHeilesState};

type Verlet = Variational<dvi_core::discrete::Unfitted, dvi_core::discrete::Trapezoid>;
type Checked = Result<(), Box<dyn std::error::Error>>;

/// A planet that falls into the sun if it has no angular momentum.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 + mu / (x * x + y * y).sqrt(),
    momenta(angular = x * dot(y) - y * dot(x)),
)]
#[derive(Clone, Debug, PartialEq)]
struct Kepler<P = f64> {
    mu: P,
}

/// Some of them leave the well: the energy at which they can is 1/6.
fn wells(count: u64) -> Vec<HenonHeilesState> {
    let state = |draw: &mut dvi_core::ensemble::Draw| HenonHeilesState {
        x: draw.normal(0.0, 0.2),
        y: draw.normal(0.0, 0.2),
        dot_x: draw.uniform(-0.5, 0.5),
        dot_y: draw.normal(0.0, 0.2),
    };
    Draws::new(7).take(count, state).collect()
}

const LEFT: [&str; 1] = ["left the well"];

fn left(_: &HenonHeiles, state: &HenonHeilesState, _: f64) -> [f64; 1] {
    [state.x.hypot(state.y) - 3.0]
}

/// Planets, every third of which falls into the sun, and one of which begins there.
fn planets(count: u64) -> (Vec<Kepler>, Vec<KeplerState>) {
    let system = |draw: &mut dvi_core::ensemble::Draw| Kepler { mu: draw.uniform(0.9, 1.1) };
    let mut states: Vec<_> = (0..count)
        .map(|k| {
            let dot_y = if k % 3 == 2 { 0.0 } else { 0.9 + 0.005 * k as f64 };
            KeplerState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y }
        })
        .collect();
    if let Some(state) = states.get_mut(4) {
        state.x = 0.0;
    }
    (Draws::new(1).take(count, system).collect(), states)
}

/// The bytes of both tables.
fn bytes(results: &Results) -> Result<[Vec<u8>; 2], Box<dyn std::error::Error>> {
    let [mut csv, mut npy] = [Vec::new(), Vec::new()];
    let record = results.record()?;
    record.write_csv(&mut csv)?;
    record.write_npy(&mut npy)?;
    Ok([csv, npy])
}

/// A file of this name that is not there yet, in a folder for files of tests.
fn file(name: &str) -> std::path::PathBuf {
    let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    for shard in 0..9 {
        for of in 1..9 {
            if let Ok(shard) = dvi_core::ensemble::Shard::new(shard, of) {
                // It need not be there.
                let _ = std::fs::remove_file(shard.path(&path));
            }
        }
    }
    path
}

/// The text of an error.
fn said<T>(result: Result<T, EnsembleError>) -> String {
    match result {
        Ok(_) => "no error".into(),
        Err(error) => error.to_string(),
    }
}
