//! The polynomials of a cube at some of its bodies.

use alloc::vec::Vec;

use super::basis::{Chebyshev, set_polynomials};
use super::packs::{LANES, Pack, load};

/// Sets the polynomials at some bodies of a cube; for those from `past` on, to the ones in its middle.
#[inline(always)]
pub(super) fn at_bodies<const D: usize, const SLOPES: bool>(
    at: &mut [Chebyshev<Pack>; D],
    order: usize,
    places: &[Vec<f64>; D],
    (middle, half): ([f64; D], f64),
    first: usize,
    past: usize,
) {
    let mut u = [Pack::all(0.0); D];
    for axis in 0..D {
        u[axis] = load(&places[axis], first);
        for lane in 0..LANES {
            u[axis].0[lane] = if first + lane < past { (u[axis].0[lane] - middle[axis]) / half } else { 0.0 };
        }
    }
    set_polynomials::<Pack, D, SLOPES>(at, &u, order);
}
