//! Systems of each kind that the macro supports, for more than one test. Most are small enough to be
//! differentiated by an oracle.

pub mod constrained;
pub mod functions;
pub mod gauges;
pub mod impacts;
pub mod language;
pub mod manifold;
pub mod nonholonomic;
pub mod particles;
pub mod regular;
pub mod shapes;
