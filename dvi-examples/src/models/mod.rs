//! The systems of the gallery and the initial data of the papers.

mod double_pendulum;
mod drift;
mod field_lines;
mod friction;
mod kepler;
mod lattice;
mod links;
mod molecules;
mod oscillators;
mod predators;
mod sphere;
mod spring;
mod tabulated;
mod tokamak;
mod vortices;

pub use double_pendulum::*;
pub use drift::*;
pub use field_lines::*;
pub use friction::*;
pub use kepler::*;
pub use lattice::*;
pub use links::*;
pub use molecules::*;
pub use oscillators::*;
pub use predators::*;
pub use sphere::*;
pub use spring::*;
pub use tabulated::*;
pub use tokamak::*;
pub use vortices::*;
