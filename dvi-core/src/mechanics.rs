//! What methods need of a system: the vector field, the Legendre transform, matrices that are solved with, and whether they
//! keep their orientation; and the phase point of a run on T*Q.

pub(crate) mod combination;
pub(crate) mod legendre;
pub(crate) mod mass;
pub(crate) mod orientation;
pub(crate) mod pattern;
pub(crate) mod phase;
mod vector_field;

pub use vector_field::VectorField;
