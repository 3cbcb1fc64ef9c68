//! The experiments, a file each: one model and one picture.

mod chaotic;
mod energy;
mod leapfrogging;
mod momenta;
mod order;
mod parasitic;
mod quasi_periodic;
mod sections;
mod stability;

use crate::gallery::Experiment;

/// All experiments, in the order of the paper.
pub const ALL: &[Experiment] = &[
    order::EXPERIMENT,
    stability::EXPERIMENT,
    energy::EXPERIMENT,
    leapfrogging::EXPERIMENT,
    quasi_periodic::EXPERIMENT,
    chaotic::EXPERIMENT,
    momenta::EXPERIMENT,
    parasitic::EXPERIMENT,
];
