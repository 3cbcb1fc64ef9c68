//! What is summed for each body: the potential of all others, or its gradient.

use super::basis::Chebyshev;
use super::packs::{NOTHING, Pack};

/// What is summed for each body: Σ w f over all others, where f is a factor of a pair, K or K', times what
/// depends on the direction of the other.
pub(super) trait Quantity<const D: usize>: Sync {
    /// Its components.
    type Sums: Copy + AsRef<[Pack]> + AsMut<[Pack]>;
    const NONE: Self::Sums;
    /// What f becomes where two bodies are exchanged, as a part of it.
    const EXCHANGED: f64;
    /// f, for bodies seen in the direction `difference`.
    fn of_pair(factor: Pack, difference: &[Pack; D]) -> Self::Sums;
    /// Adds that of one row of a local expansion: the polynomials at the place and the degrees of the row in
    /// all coordinates but the last, the sums of coefficients times T and times T' over the degrees of the
    /// last, and du/dx.
    fn add_row(sums: &mut Self::Sums, at: &[Chebyshev; D], degrees: &[usize; D], row: [Pack; 2], scale: f64);
}

/// Σ w K.
pub(super) enum Potential {}
/// Half its gradient, Σ w K' (xᵢ − xⱼ).
pub(super) enum Gradient {}

impl<const D: usize> Quantity<D> for Potential {
    type Sums = [Pack; 1];
    const NONE: Self::Sums = [NOTHING; 1];
    const EXCHANGED: f64 = 1.0;
    #[inline]
    fn of_pair(factor: Pack, _difference: &[Pack; D]) -> Self::Sums {
        [factor]
    }
    #[inline]
    fn add_row(
        sums: &mut Self::Sums,
        at: &[Chebyshev; D],
        degrees: &[usize; D],
        row: [Pack; 2],
        _scale: f64,
    ) {
        let mut value = row[0];
        for axis in 0..D - 1 {
            value = value * at[axis].value[degrees[axis]];
        }
        sums[0] += value;
    }
}

impl<const D: usize> Quantity<D> for Gradient {
    type Sums = [Pack; D];
    const NONE: Self::Sums = [NOTHING; D];
    const EXCHANGED: f64 = -1.0;
    #[inline]
    fn of_pair(factor: Pack, difference: &[Pack; D]) -> Self::Sums {
        let mut parts = *difference;
        for axis in 0..D {
            parts[axis] = factor * difference[axis];
        }
        parts
    }
    #[inline]
    fn add_row(
        sums: &mut Self::Sums,
        at: &[Chebyshev; D],
        degrees: &[usize; D],
        row: [Pack; 2],
        scale: f64,
    ) {
        for axis in 0..D {
            let mut slope = if axis == D - 1 { row[1] } else { row[0] };
            for other in 0..D - 1 {
                let factor = if other == axis { &at[other].slope } else { &at[other].value };
                slope = slope * factor[degrees[other]];
            }
            sums[axis] += slope * Pack::all(0.5 * scale);
        }
    }
}
