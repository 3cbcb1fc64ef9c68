//! Records: what a run was, as named columns, written as CSV, for NumPy, or as a page that shows it.
//!
//! [`record`](Recorded::record) takes steps and writes down the time, the state, the energy and the momenta:
//!
//! ```
//! use dvi_core::prelude::*;
//!
//! /// A planet around a fixed sun.
//! #[lagrangian(
//!     coordinates(x, y),
//!     lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 + 1.0 / (x * x + y * y).sqrt(),
//!     momenta(angular = x * dot(y) - y * dot(x)),
//! )]
//! struct Kepler;
//!
//! let start = KeplerState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.2 };
//! let mut run = Integrator::new(&Kepler, Variational::trapezoid(), 0.01, start)?;
//! let record = run.record(10, 200)?; // now, and 200 times after 10 steps each
//! let names: Vec<&str> = record.columns().iter().map(|column| &column.name[..]).collect();
//! assert_eq!(names, ["time", "x", "y", "dot_x", "dot_y", "energy", "angular"]);
//! assert_eq!((record.rows(), record.numbers("x")?.len()), (201, 201));
//! # let mut files: [Vec<u8>; 3] = Default::default();
//! # let [csv, npy, page] = &mut files;
//! # /*
//! let [csv, npy, page] =
//!     ["kepler.csv", "kepler.npy", "kepler.html"].map(std::fs::File::create);
//! let (csv, npy, page) = (csv?, npy?, page?);
//! # */
//! record.write_csv(csv)?;
//! record.write_npy(npy)?;
//! record.write_page(page)?; // to be opened in a browser
//! # assert!(files[0].starts_with(b"time,x,y,") && files[1].starts_with(b"\x93NUMPY"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # What columns there are
//!
//! | column | what is in it |
//! |---|---|
//! | `time` | the time of the run |
//! | `x`, `x[0]`, `dot_x`, … | the entries of the state, by their [names](crate::System::names) |
//! | `energy` | the energy v·∂L/∂v − L; H for a degenerate system |
//! | the names of the declared momenta | their values |
//! | names of yours | values of [functions](Recorder::with_function) of yours |
//!
//! Where a coordinate has the name of one of the others already, that one stands as `run.time`, `run.energy`
//! or `run.` and the name of the momentum.
//!
//! A [`Recorder`] takes functions of yours along, and states one by one, wherever they come from: from
//! [events](crate::run::Events), from [given times](crate::run::Run::states_at), or from a loop of yours.

mod body;
mod column;
mod csv;
mod error;
mod npy;
mod page;
mod recorder;
mod table;

pub use column::{Column, Quantity, Values};
pub use error::RecordError;
pub use recorder::{Recorded, Recorder};
pub use table::Record;
