//! The experiments, a file each: one model and one picture.

mod accelerations;
mod accuracy_cost;
mod barnes;
mod beam;
mod billiard;
mod bounces;
mod chaotic;
mod disc;
mod double_pendulum;
mod drifts;
mod elliptic;
mod energy;
mod energy_momentum;
mod field_lines;
mod friction;
mod guiding_centre;
mod kepler;
mod kepler_frequency;
mod kepler_long;
mod kepler_steps;
mod kepler_work;
mod leapfrogging;
mod links;
mod lotka_volterra;
mod massless;
mod molecules;
mod momenta;
mod order;
mod oscillator;
mod parasitic;
mod phase_space;
mod quasi_periodic;
mod rigid_body;
mod rivals;
mod rk4;
mod round_off;
mod rounding;
mod schroedinger;
mod sections;
mod shadow;
mod shear_layer;
mod sphere_vortices;
mod spherical_pendulum;
mod spring_chain;
mod stability;
mod symmetry;
mod tabulated_field;
mod three_species;
mod top;
mod turnings;
mod watch;

use crate::gallery::Experiment;

/// All experiments, in the order of the papers: Rowley & Marsden, Kosmas & Vlachos, and what goes beyond.
pub const ALL: &[Experiment] = &[
    order::EXPERIMENT,
    stability::EXPERIMENT,
    energy::EXPERIMENT,
    symmetry::EXPERIMENT,
    leapfrogging::EXPERIMENT,
    quasi_periodic::EXPERIMENT,
    chaotic::EXPERIMENT,
    momenta::EXPERIMENT,
    parasitic::EXPERIMENT,
    oscillator::EXPERIMENT,
    kepler_steps::EXPERIMENT,
    kepler_long::EXPERIMENT,
    kepler_frequency::EXPERIMENT,
    kepler_work::EXPERIMENT,
    accuracy_cost::EXPERIMENT,
    barnes::EXPERIMENT,
    double_pendulum::EXPERIMENT,
    friction::EXPERIMENT,
    energy_momentum::EXPERIMENT,
    links::EXPERIMENT,
    molecules::EXPERIMENT,
    disc::EXPERIMENT,
    spring_chain::EXPERIMENT,
    beam::EXPERIMENT,
    bounces::EXPERIMENT,
    billiard::EXPERIMENT,
    top::EXPERIMENT,
    rigid_body::EXPERIMENT,
    spherical_pendulum::EXPERIMENT,
    round_off::EXPERIMENT,
    lotka_volterra::EXPERIMENT,
    guiding_centre::EXPERIMENT,
    tabulated_field::EXPERIMENT,
    field_lines::EXPERIMENT,
    phase_space::EXPERIMENT,
    massless::EXPERIMENT,
    schroedinger::EXPERIMENT,
    sphere_vortices::EXPERIMENT,
    shear_layer::EXPERIMENT,
    three_species::EXPERIMENT,
];
