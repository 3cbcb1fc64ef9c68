//! Products of Chebyshev polynomials on a cube, of a total degree below the order.

use alloc::vec::Vec;

use super::packs::{NOTHING, Pack};

/// Above all orders.
pub(super) const MOST: usize = 32;

/// T_m at some u in −1..1, and T_m'.
#[derive(Clone, Copy)]
pub(super) struct Chebyshev {
    pub(super) value: [Pack; MOST],
    pub(super) slope: [Pack; MOST],
}

impl Chebyshev {
    /// Not yet known.
    pub(super) const NONE: Self = Self { value: [NOTHING; MOST], slope: [NOTHING; MOST] };
}

/// Sets the polynomials at u along each axis, and their derivatives, by the recurrence T_{m+1} = 2u T_m −
/// T_{m−1} and its derivative, for m < `order`.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn set_polynomials<const D: usize>(at: &mut [Chebyshev; D], u: &[Pack; D], order: usize) {
    let (one, two) = (Pack::all(1.0), Pack::all(2.0));
    for (Chebyshev { value, slope }, u) in at.iter_mut().zip(u) {
        (value[0], value[1], slope[1]) = (one, *u, one);
    }
    // One axis does not wait for the other.
    for m in 2..order {
        for (Chebyshev { value, slope }, &u) in at.iter_mut().zip(u) {
            value[m] = two * u * value[m - 1] - value[m - 2];
            slope[m] = two * (value[m - 1] + u * slope[m - 1]) - slope[m - 2];
        }
    }
}

/// The functions T_{m₁}(u₁) … T_{m_D}(u_D) with m₁ + … + m_D below the order.
#[derive(Clone, Debug)]
pub(super) struct Basis<const D: usize> {
    pub(super) order: usize,
    /// The degrees of each function; those of the last coordinate run fastest.
    pub(super) degrees: Vec<[usize; D]>,
}

impl<const D: usize> Basis<D> {
    pub(super) fn new(order: usize) -> Self {
        let mut degrees = Vec::new();
        let mut next = [0; D];
        loop {
            degrees.push(next);
            // Counts up, with the sum of the digits below the order.
            let Some(axis) = (0..D).rev().find(|&axis| {
                let above: usize = next[..=axis].iter().sum();
                above + 1 < order
            }) else {
                return Self { order, degrees };
            };
            next[axis] += 1;
            next[axis + 1..].fill(0);
        }
    }

    pub(super) fn len(&self) -> usize {
        self.degrees.len()
    }

    /// Where the function of these degrees stands.
    pub(super) fn place(&self, degrees: [usize; D]) -> usize {
        self.degrees.partition_point(|other| *other < degrees)
    }
}

/// T_m((c + side)/2) = Σ_n a_{mn} T_n(c), by the recurrence in m.
pub(super) fn half(order: usize, side: f64) -> Vec<[f64; MOST]> {
    let mut rows: Vec<[f64; MOST]> = Vec::with_capacity(order);
    for m in 0..order {
        let mut row = [0.0; MOST];
        if m == 0 {
            row[0] = 1.0;
        } else {
            // (c + side) T_{m−1}, halved for m = 1, with c T_0 = T_1 and c T_n = (T_{n+1} + T_{n−1})/2.
            let factor = if m == 1 { 0.5 } else { 1.0 };
            let last = rows[m - 1];
            for n in 0..m {
                let entry = factor * last[n];
                row[n] += side * entry;
                if n == 0 {
                    row[1] += entry;
                } else {
                    row[n + 1] += entry / 2.0;
                    row[n - 1] += entry / 2.0;
                }
            }
            if m >= 2 {
                (0..m).for_each(|n| row[n] -= rows[m - 2][n]);
            }
        }
        rows.push(row);
    }
    rows
}

/// The zeros of T_order.
pub(super) fn nodes(order: usize) -> Vec<f64> {
    (0..order).map(|i| angle(order, i).cos()).collect()
}

/// The matrix, row by row, that makes the values of a function at the [`nodes`] the coefficients of its
/// interpolant.
pub(super) fn coefficients(order: usize) -> Vec<f64> {
    let entry = |m: usize, i: usize| {
        let weight = if m == 0 { 1.0 } else { 2.0 };
        weight / order as f64 * (m as f64 * angle(order, i)).cos()
    };
    (0..order).flat_map(|m| (0..order).map(move |i| entry(m, i))).collect()
}

fn angle(order: usize, i: usize) -> f64 {
    (i as f64 + 0.5) / order as f64 * core::f64::consts::PI
}
