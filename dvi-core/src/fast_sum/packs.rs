//! Several bodies, or several cubes, in lanes.

use alloc::vec::Vec;

use crate::scalar::Lanes;

/// Bodies, or cubes, that are computed at once.
pub(super) const LANES: usize = 8;
pub(super) type Pack = Lanes<LANES>;
pub(super) const NOTHING: Pack = Lanes([0.0; LANES]);

/// Some numbers.
#[inline]
pub(super) fn load(from: &[f64], first: usize) -> Pack {
    let mut pack = [0.0; LANES];
    pack.copy_from_slice(&from[first..first + LANES]);
    Lanes(pack)
}

/// Some numbers, zero from `past` on.
#[inline]
pub(super) fn load_before(past: usize, from: &[f64], first: usize) -> Pack {
    let mut pack = load(from, first);
    for lane in 0..LANES {
        if first + lane >= past {
            pack.0[lane] = 0.0;
        }
    }
    pack
}

/// The places of some bodies, one in each lane.
#[inline]
pub(super) fn load_places<const D: usize>(places: &[Vec<f64>; D], first: usize) -> [Pack; D] {
    let mut found = [NOTHING; D];
    for axis in 0..D {
        found[axis] = load(&places[axis], first);
    }
    found
}

/// The same for those before `past`, and the place of the last one for the others.
#[inline]
pub(super) fn load_places_before<const D: usize>(
    past: usize,
    places: &[Vec<f64>; D],
    first: usize,
) -> [Pack; D] {
    if first + LANES <= past {
        return load_places(places, first);
    }
    let mut found = [NOTHING; D];
    for axis in 0..D {
        for lane in 0..LANES {
            found[axis].0[lane] = places[axis][(first + lane).min(past - 1)];
        }
    }
    found
}

/// The place of a body in all lanes.
#[inline]
pub(super) fn repeat_place<const D: usize>(places: &[Vec<f64>; D], body: usize) -> [Pack; D] {
    let mut found = [NOTHING; D];
    for axis in 0..D {
        found[axis] = Pack::all(places[axis][body]);
    }
    found
}

/// Where some bodies of a cube are in it, from −1 to 1 along each axis; those from `past` on count as in its
/// middle.
#[inline]
pub(super) fn coordinates<const D: usize>(
    places: &[Vec<f64>; D],
    (middle, half): ([f64; D], f64),
    first: usize,
    past: usize,
) -> [Pack; D] {
    // A power of two.
    let scale = Pack::all(1.0 / half);
    let mut u = [NOTHING; D];
    for axis in 0..D {
        u[axis] = (load(&places[axis], first) - Pack::all(middle[axis])) * scale;
        for lane in 0..LANES {
            u[axis].0[lane] = if first + lane < past { u[axis].0[lane] } else { 0.0 };
        }
    }
    u
}

/// Adds the components of what was found for some bodies, those before `past`.
#[inline]
pub(super) fn add_before<const D: usize>(
    past: usize,
    sums: &mut [&mut [f64]; D],
    first: usize,
    found: &[Pack],
) {
    let count = LANES.min(past - first);
    if count == LANES {
        for (sums, found) in sums.iter_mut().zip(found) {
            let sum = load(sums, first) + *found;
            sums[first..first + LANES].copy_from_slice(&sum.0);
        }
        return;
    }
    for (sums, found) in sums.iter_mut().zip(found) {
        for (sum, found) in sums[first..first + count].iter_mut().zip(&found.0) {
            *sum += found;
        }
    }
}

/// Adds to each number the sum of the lanes of a pack.
///
/// It is no part of what calls it: the compiler would take packs apart long before, and put them together
/// again.
#[inline(never)]
pub(super) fn add_lanes<'a>(packs: impl Iterator<Item = &'a Pack>, to: &mut [f64]) {
    for (pack, to) in packs.zip(to) {
        let [a, b, c, d, e, f, g, h] = pack.0;
        *to += ((a + e) + (c + g)) + ((b + f) + (d + h));
    }
}
