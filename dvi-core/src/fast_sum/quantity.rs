//! What is summed for each body: the potential of all others, or its gradient.

use super::basis::Chebyshev;
use super::packs::Pack;
use crate::PairSum;

/// What is summed for each body.
pub(super) trait Quantity<const D: usize>: Sync {
    /// Its components.
    type Sums: Copy + AsRef<[Pack]> + AsMut<[Pack]>;
    fn none() -> Self::Sums;
    /// Adds that of a body with `weight` at a squared distance `r2`, seen in the direction `difference`.
    fn add_pair(&self, sums: &mut Self::Sums, weight: Pack, difference: &[Pack; D], r2: Pack);
    /// Adds that of bodies with the first of the weights, and to the `reactions` on them that of the bodies
    /// in the lanes of `sums`, with the other.
    fn add_both(
        &self,
        sums: &mut Self::Sums,
        reactions: &mut [Pack],
        weights: [Pack; 2],
        difference: &[Pack; D],
        r2: Pack,
    );
    /// Adds that of one row of a local expansion: the polynomials at the place and the degrees of the row in
    /// all coordinates but the last, the sums of coefficients times T and times T' over the degrees of the
    /// last, and du/dx.
    fn add_row(
        sums: &mut Self::Sums,
        at: &[Chebyshev<Pack>; D],
        degrees: &[usize; D],
        row: [Pack; 2],
        scale: f64,
    );
}

/// Σ w K.
pub(super) struct Potential<'s, S>(pub(super) &'s S);
/// Half its gradient, Σ w K' (xᵢ − xⱼ).
pub(super) struct Gradient<'s, S>(pub(super) &'s S);

impl<const D: usize, S: PairSum<Pack, D> + Sync> Quantity<D> for Potential<'_, S> {
    type Sums = [Pack; 1];
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn none() -> Self::Sums {
        [Pack::all(0.0)]
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add_pair(&self, sums: &mut Self::Sums, weight: Pack, _difference: &[Pack; D], r2: Pack) {
        sums[0] += weight * self.0.kernel(r2);
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add_both(
        &self,
        sums: &mut Self::Sums,
        reactions: &mut [Pack],
        weights: [Pack; 2],
        _difference: &[Pack; D],
        r2: Pack,
    ) {
        let kernel = self.0.kernel(r2);
        sums[0] += weights[0] * kernel;
        reactions[0] += weights[1] * kernel;
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add_row(
        sums: &mut Self::Sums,
        at: &[Chebyshev<Pack>; D],
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

impl<const D: usize, S: PairSum<Pack, D> + Sync> Quantity<D> for Gradient<'_, S> {
    type Sums = [Pack; D];
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn none() -> Self::Sums {
        [Pack::all(0.0); D]
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add_pair(&self, sums: &mut Self::Sums, weight: Pack, difference: &[Pack; D], r2: Pack) {
        let slope = weight * self.0.kernel_slope(r2);
        for axis in 0..D {
            sums[axis] += slope * difference[axis];
        }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add_both(
        &self,
        sums: &mut Self::Sums,
        reactions: &mut [Pack],
        weights: [Pack; 2],
        difference: &[Pack; D],
        r2: Pack,
    ) {
        let slope = self.0.kernel_slope(r2);
        let slopes = [weights[0] * slope, weights[1] * slope];
        for (axis, reaction) in reactions.iter_mut().enumerate() {
            sums[axis] += slopes[0] * difference[axis];
            *reaction -= slopes[1] * difference[axis];
        }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add_row(
        sums: &mut Self::Sums,
        at: &[Chebyshev<Pack>; D],
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
