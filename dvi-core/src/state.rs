//! What a run carries from step to step, how it is added up, and what it has cost.

#[cfg(feature = "alloc")]
pub(crate) mod fingerprint;
pub(crate) mod history;
pub(crate) mod rates;
mod statistics;
pub(crate) mod summation;

pub use crate::memory::Memory;
#[cfg(feature = "alloc")]
pub use crate::memory::Record;
pub use statistics::Statistics;
pub use summation::Summation;
