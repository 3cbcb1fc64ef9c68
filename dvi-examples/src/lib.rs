//! The systems of the gallery, what it measures them by, and its figures, for those who use them elsewhere:
//! the tests and the benchmarks do.

#![allow(missing_docs, reason = "what models and figures are made of is named as in formulas and figures")]

#[cfg(feature = "gallery")]
pub mod figure;
pub mod models;
pub mod osculating;
#[cfg(feature = "gallery")]
pub mod output;
