//! Bodies in the coordinates of their cube.

use alloc::vec::Vec;

use super::packs::{LANES, Pack, load};

/// Where some bodies of a cube are in it, from −1 to 1 along each axis; those from `past` on count as in its
/// middle.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn coordinates<const D: usize>(
    places: &[Vec<f64>; D],
    (middle, half): ([f64; D], f64),
    first: usize,
    past: usize,
) -> [Pack; D] {
    // A power of two.
    let scale = Pack::all(1.0 / half);
    let mut u = [Pack::all(0.0); D];
    for axis in 0..D {
        u[axis] = (load(&places[axis], first) - Pack::all(middle[axis])) * scale;
        for lane in 0..LANES {
            u[axis].0[lane] = if first + lane < past { u[axis].0[lane] } else { 0.0 };
        }
    }
    u
}
