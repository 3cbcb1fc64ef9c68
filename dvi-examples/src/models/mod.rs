//! The systems of the gallery and the initial data of the papers.

mod beam;
mod chains;
mod disc;
mod drift;
mod field_lines;
mod heights;
mod impacts;
mod kepler;
mod lattice;
mod oscillators;
mod predators;
mod rigid;
mod solar_system;
mod tokamak;
mod vortices;

pub use self::{
    beam::*, chains::*, disc::*, drift::*, field_lines::*, heights::*, impacts::*, kepler::*, lattice::*,
    oscillators::*, predators::*, rigid::*, solar_system::*, tokamak::*, vortices::*,
};
