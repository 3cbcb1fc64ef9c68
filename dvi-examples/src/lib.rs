//! The systems of the gallery and its figures, for those who use them elsewhere: the tests and the
//! benchmarks do.

#[cfg(feature = "gallery")]
#[allow(missing_docs, reason = "what a figure is made of is named as in any figure")]
pub mod figure;
pub mod models;
#[cfg(feature = "gallery")]
pub mod output;
