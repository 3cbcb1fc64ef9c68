//! Records: what is in their columns, and that their files say the same.

mod bodies;
mod columns;
mod files;
mod page;
mod sizes;

use dvi_core::prelude::*;
use dvi_core::record::RecordError;

pub(crate) use bodies::bodies;

type Checked = Result<(), Box<dyn std::error::Error>>;

/// A planet around a fixed sun.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 + 1.0 / x.hypot(y),
    momenta(angular = x * dot(y) - y * dot(x)),
)]
struct Kepler;

/// At the aphelion of an ellipse.
const START: KeplerState = KeplerState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 0.8 };

fn bits(numbers: &[f64]) -> Vec<u64> {
    numbers.iter().map(|number| number.to_bits()).collect()
}

fn said<T>(result: Result<T, RecordError>) -> String {
    result.map_or_else(|error| error.to_string(), |_| "no error".into())
}
