//! What is taken in few steps, or in none, without optimisation.
//!
//! It is one program, so that what several tests run is compiled once, and the long tests run beside the
//! others. Apart from it is a test that is compiled under other lints.

mod archive;
mod at_state;
mod baselines;
#[path = "../src/browser.rs"]
mod browser;
mod checkpoints;
mod constrained;
mod constraints;
mod derivatives;
mod discrete_equations;
mod documentation;
mod domains;
mod energy_momentum;
mod ensemble;
mod error_control;
mod events;
mod failures;
mod forces;
mod galerkin;
mod gauges;
mod gauss_guesses;
mod gauss_newton;
mod grids;
mod impacts;
mod imports;
mod lanes;
mod manifold;
mod many_coordinates;
mod many_steps;
mod networks;
mod nonholonomic;
mod one_step;
mod owned;
mod packs;
mod pages;
mod parameters;
mod projected;
mod records;
mod restoring;
mod scalar_fields;
mod shared_names;
mod singular;
mod sizes;
mod smallest_numbers;
mod spins;
mod splines;
mod structure;
mod time_transform;
mod together;
mod units;
mod variational;
mod vectors;
