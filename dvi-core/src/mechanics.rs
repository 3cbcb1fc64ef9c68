//! The equations of motion, and what can be asked of a system [at one state](AtState); and what methods need
//! beside them: the Legendre transform, matrices that are solved with, whether they keep their orientation,
//! the phase point of a run on T*Q.

mod at_state;
pub(crate) mod combination;
pub(crate) mod constraints;
pub(crate) mod legendre;
pub(crate) mod manifold;
pub(crate) mod mass;
#[cfg(feature = "random")]
pub(crate) mod mass_root;
pub(crate) mod motion;
pub(crate) mod orientation;
pub(crate) mod pattern;
pub(crate) mod phase;
mod span;
mod vector_field;

pub use at_state::{AtState, OnConstraints};
pub use motion::{FirstOrder, InLanes, Rates};
pub use span::{Interval, Span};
pub(crate) use vector_field::VectorField;
