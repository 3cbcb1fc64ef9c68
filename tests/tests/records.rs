//! Records: what is in their columns, and that their files say the same.

mod bodies;
mod columns;
mod files;
mod page;
mod sizes;

use dvi_core::Lagrangian;
use dvi_core::record::{Record, RecordError};
use dvi_tests::bits;
use dvi_tests::zoo::regular::{KEPLER, KeplerState};

pub(crate) use bodies::bodies;

type Checked = Result<(), Box<dyn std::error::Error>>;

/// At the aphelion of an ellipse.
const START: KeplerState = KeplerState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 0.8 };

/// A state as a table with its names, read again.
pub(crate) fn read_again<S: Lagrangian>(
    system: &S,
    state: &S::State<f64>,
) -> Result<Vec<S::State<f64>>, Box<dyn std::error::Error>> {
    let names: Vec<String> = system.names().map(|name| name.to_string()).collect();
    let values: Vec<String> = system.values(state)?.map(|value: f64| value.to_string()).collect();
    let table = format!("{}\n{}\n", names.join(","), values.join(","));
    Ok(Record::read_csv(table.as_bytes())?.states(system)?)
}

fn said<T>(result: Result<T, RecordError>) -> String {
    result.map_or_else(|error| error.to_string(), |_| "no error".into())
}
