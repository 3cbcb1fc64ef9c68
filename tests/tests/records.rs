//! Records: what is in their columns, and that their files say the same.

mod bodies;
mod columns;
mod files;
mod page;
mod sizes;

use dvi_core::record::RecordError;
use dvi_tests::bits;
use dvi_tests::zoo::regular::{KEPLER, KeplerState};

pub(crate) use bodies::bodies;

type Checked = Result<(), Box<dyn std::error::Error>>;

/// At the aphelion of an ellipse.
const START: KeplerState = KeplerState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 0.8 };

fn said<T>(result: Result<T, RecordError>) -> String {
    result.map_or_else(|error| error.to_string(), |_| "no error".into())
}
