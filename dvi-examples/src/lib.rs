//! The systems of the gallery, for those who run them elsewhere: the tests and the benchmarks do.

pub mod models;
