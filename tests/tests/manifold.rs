//! Rotations and unit vectors as coordinates: orders, structure and integrals of runs along geodesics,
//! against hand-written motion.

// Rotations are called R.
#![allow(non_snake_case)]

mod arrays;
mod ends;
mod motion;
mod reference;
mod structure;
