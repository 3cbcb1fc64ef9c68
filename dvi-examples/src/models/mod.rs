//! The systems of the gallery and the initial data of the papers.

mod beam;
mod chains;
mod disc;
mod field_lines;
mod heights;
mod impacts;
mod kepler;
mod oscillators;
mod predators;
mod rigid;
mod tokamak;
mod vortices;

pub use self::{
    beam::*, chains::*, disc::*, field_lines::*, heights::*, impacts::*, kepler::*, oscillators::*,
    predators::*, rigid::*, tokamak::*, vortices::*,
};
