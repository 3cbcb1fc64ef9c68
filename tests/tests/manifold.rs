//! Rotations and unit vectors as coordinates: structure and integrals of runs along geodesics, and
//! their motion against that on constraints.

// Rotations are called R.
#![allow(non_snake_case)]

mod arrays;
mod ends;
mod motion;
mod structure;
