//! How large the rounding errors of a long run may be.

use crate::claim::Bound;

/// The standard deviation of a sum of so many independent errors of one unit of rounding.
pub fn random_walk(steps: u64) -> Bound {
    Bound::AtMost(f64::EPSILON * (steps as f64).sqrt())
}

/// What a few operations leave that are not repeated: the errors of a matrix of products, or of the square
/// of a length.
pub fn few_units() -> Bound {
    Bound::AtMost(8.0 * f64::EPSILON)
}
