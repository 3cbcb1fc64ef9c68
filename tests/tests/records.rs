//! Records: what is in their columns, and that their files say the same.

mod bodies;
mod columns;
mod files;
mod page;
pub(crate) mod sizes;

use dvi_core::Lagrangian;
use dvi_core::record::RecordError;
use dvi_tests::bits;
use dvi_tests::zoo::regular::{KEPLER, KeplerState};

pub(crate) use bodies::bodies;

type Checked = Result<(), Box<dyn std::error::Error>>;

/// At the aphelion of an ellipse.
const START: KeplerState = KeplerState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 0.8 };

/// The state with the entries of this one, in the order of their names.
pub(crate) fn read_again<S: Lagrangian>(
    system: &S,
    state: &S::State<f64>,
) -> Result<Vec<S::State<f64>>, Box<dyn std::error::Error>> {
    let values: Vec<f64> = system.values(state)?.collect();
    Ok(vec![system.state_of(values)])
}

fn said<T>(result: Result<T, RecordError>) -> String {
    result.map_or_else(|error| error.to_string(), |_| "no error".into())
}
