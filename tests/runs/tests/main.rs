//! Runs of many steps.
//!
//! They are one program, so that what several of them run is compiled once, and the long ones run beside the
//! others.

mod constrained;
mod continuation;
mod drift;
mod error_control;
mod events;
mod exponents;
mod impacts;
mod langevin;
mod nonholonomic;
mod one_step;
mod parasitic;
mod projected;
mod redundant;
mod round_off;
mod second_order;
mod spins;
mod splines;
mod step_control;
mod time_transform;
