//! Numbers of the stages of a step in the lanes of packs, and what is combined of them.
//!
//! Σⱼ aⱼ xⱼ, where a number x of each stage has a lane, is a sum of columns aⱼ. It is taken of several
//! numbers at once, so that each column is read once for all of them while their sums stay in registers.

use core::hint::black_box;

use crate::scalar::passes::lanes_stay_together;
use crate::scalar::{Lanes, norm};
use crate::solve::sizes;
use crate::{Real, Scalar, System};

/// How many numbers of a point are combined at once.
const BLOCK: usize = 4;

/// From nothing: for [`combine`], as the next three, none of which knows a system.
#[inline]
pub(in crate::methods) fn nothing<const STAGES: usize, T: Real>(_: usize) -> (T, Lanes<STAGES, T>) {
    (T::lift(0.0), Lanes::all(T::lift(0.0)))
}

/// From numbers.
#[inline]
pub(in crate::methods) fn at<const STAGES: usize, T: Real>(
    y: &[T],
) -> impl Fn(usize) -> (T, Lanes<STAGES, T>) {
    |k| (y[k], Lanes::all(T::lift(0.0)))
}

/// From numbers, with what rounding has left out of them.
#[inline]
pub(in crate::methods) fn beside<const STAGES: usize, T: Real>(
    y: &[T],
    rest: &[T],
) -> impl Fn(usize) -> (T, Lanes<STAGES, T>) {
    |k| (y[k], Lanes::all(rest[k]))
}

/// From numbers that are moved freely.
#[inline]
pub(in crate::methods) fn moved<const STAGES: usize, T: Real>(
    q: &[T],
    free: &[Lanes<STAGES, T>],
) -> impl Fn(usize) -> (T, Lanes<STAGES, T>) {
    |k| (q[k], free[k])
}

/// Sets pack k of `out` to y + (e + Σⱼ `columns`ⱼ xⱼ), for the numbers x in the first lanes of that pack of
/// `packs` and `from`(k) = (y, e), where y is the same for all stages.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(in crate::methods) fn combine<const STAGES: usize, T: Real>(
    columns: &[Lanes<STAGES, T>],
    packs: &[Lanes<STAGES, T>],
    from: impl Fn(usize) -> (T, Lanes<STAGES, T>),
    out: &mut [Lanes<STAGES, T>],
) {
    let (blocks, left) = packs.as_chunks::<BLOCK>();
    let (outs, out_left) = out.as_chunks_mut::<BLOCK>();
    let mut first = 0;
    for (packs, out) in blocks.iter().zip(outs) {
        *out =
            combine_block(columns, packs, [from(first), from(first + 1), from(first + 2), from(first + 3)]);
        first += BLOCK;
    }
    for (k, (pack, out)) in left.iter().zip(out_left).enumerate() {
        [*out] = combine_block(columns, &[*pack], [from(first + k)]);
    }
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn combine_block<const STAGES: usize, const N: usize, T: Real>(
    columns: &[Lanes<STAGES, T>],
    packs: &[Lanes<STAGES, T>; N],
    from: [(T, Lanes<STAGES, T>); N],
) -> [Lanes<STAGES, T>; N] {
    let mut sums = [Lanes::all(T::lift(0.0)); N];
    for k in 0..N {
        sums[k] = from[k].1;
    }
    for j in 0..columns.len() {
        for k in 0..N {
            sums[k] += columns[j] * Lanes::all(packs[k].0[j]);
        }
    }
    for k in 0..N {
        sums[k] = Lanes::all(from[k].0) + sums[k];
    }
    sums
}

/// What stages of q'' = f(q, t) are moved by, with their velocities eliminated.
///
/// Qᵢ = q + h cᵢ M⁻¹p + Σⱼ νᵢⱼ xⱼ,   q⁺ = q + h M⁻¹p + Σⱼ βⱼ xⱼ,   xⱼ = h M⁻¹Lⱼ, βⱼ = 1 − cⱼ
///
/// Steps are symplectic in the arithmetic if νᵢⱼ − νⱼᵢ = βⱼ − βᵢ exactly (Antoñana, Makazaga & Murua 2025).
#[derive(Clone, Copy, Debug)]
pub(in crate::methods) struct Nystrom<const STAGES: usize, T> {
    /// Column j of ν.
    pub(in crate::methods) nu: [Lanes<STAGES, T>; STAGES],
    pub(in crate::methods) beta: Lanes<STAGES, T>,
    /// 1 − β.
    pub(in crate::methods) nodes: Lanes<STAGES, T>,
}

/// Sets packs to new ones, each of which it shows to `see` with its place, and returns the largest change of
/// a number in units of `weights`, which are those of blocks.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(in crate::methods) fn replace<const STAGES: usize, S: System, T: Real>(
    system: &S,
    weights: &[T],
    packs: &mut [Lanes<STAGES, T>],
    new: &[Lanes<STAGES, T>],
    mut see: impl FnMut(usize, Lanes<STAGES, T>),
) -> T {
    let none = Lanes::all(T::lift(0.0));
    let mut largest = none;
    for block in sizes::blocks(system) {
        if block.is_empty() {
            continue;
        }
        let (mut changes, weight) = (none, weights[block.start]);
        for (k, (pack, new)) in block.clone().zip(packs[block.clone()].iter_mut().zip(&new[block])) {
            lanes_stay_together::<Lanes<STAGES, T>>();
            changes = changes.larger(Scalar::abs(*new - *pack));
            // Number by number, so that none is loaded once more.
            #[allow(clippy::manual_memcpy)]
            for stage in 0..STAGES {
                pack.0[stage] = new.0[stage];
            }
            see(k, *new);
        }
        largest = largest.larger(changes * Lanes::all(weight));
    }
    // Packs are whole up to here: the compiler would take halves of all, by which their lanes are joined.
    black_box(largest).largest()
}

/// The sum over stages.
#[inline]
pub(in crate::methods) fn sum<T: Real>(stages: &[T]) -> T {
    stages.iter().fold(T::lift(0.0), |sum, &number| sum + number)
}

/// So far the polynomial of a step is continued, in units of that step: to the end of one that is twice as
/// long, and back over it and as far beyond.
const REACH: [f64; 2] = [-3.0, 2.0];

/// The Lagrange polynomials through `N` stages, in columns: where the stages of the next step are whose
/// nodes are `c` and whose length is `ratio` times that of the step before. Row k of `lagrange` is in terms
/// of the Legendre polynomial of degree k.
#[inline]
pub(in crate::methods) fn continuation<const STAGES: usize, const N: usize, T: Real>(
    lagrange: &[[T; N]; N],
    c: Lanes<STAGES, T>,
    ratio: T,
) -> [Lanes<STAGES, T>; N] {
    let [back, ahead] = REACH.map(T::lift);
    let ratio = if ratio > ahead { ahead } else { norm::larger(back, ratio) };
    lagrange_at(lagrange, Lanes::all(T::lift(1.0)) + Lanes::all(ratio) * c)
}

/// The Lagrange polynomials at points `x` of the step, whose ends are 0 and 1, or beyond.
#[inline]
pub(in crate::methods) fn lagrange_at<const STAGES: usize, const N: usize, T: Real>(
    lagrange: &[[T; N]; N],
    x: Lanes<STAGES, T>,
) -> [Lanes<STAGES, T>; N] {
    let number = |value: f64| Lanes::all(T::lift(value));
    let z = number(2.0) * x - number(1.0);
    let (mut last, mut legendre) = (number(0.0), number(1.0));
    let mut columns = [number(0.0); N];
    for k in 0..N {
        for j in 0..N {
            columns[j] += Lanes::all(lagrange[k][j]) * legendre;
        }
        let degree = k as f64;
        let next = number((2.0 * degree + 1.0) / (degree + 1.0)) * z * legendre
            - number(degree / (degree + 1.0)) * last;
        (last, legendre) = (legendre, next);
    }
    columns
}
