//! The coefficients of Gauss collocation in packs over the stages, and what is combined with them.
//!
//! Σⱼ aⱼ xⱼ, where a number x of each stage has a lane, is a sum of columns aⱼ. It is taken of several numbers at once, so that each
//! column is read once for all of them while their sums stay in registers.

use crate::Real;
use crate::methods::collocation::Collocation;
use crate::scalar::Lanes;

/// Coefficients in packs over the stages that they lead to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Coefficients<const STAGES: usize, T> {
    /// Column j of μ.
    pub(super) mu: [Lanes<STAGES, T>; STAGES],
    /// Column j of the continuation.
    pub(super) continuation: [Lanes<STAGES, T>; STAGES],
    pub(super) b: Lanes<STAGES, T>,
    pub(super) c: Lanes<STAGES, T>,
}

impl<const STAGES: usize, T: Real> Coefficients<STAGES, T> {
    pub(super) fn new() -> Self {
        let tableau = Collocation::<STAGES>::gauss();
        let columns = |rows: [[f64; STAGES]; STAGES]| {
            core::array::from_fn(|j| Lanes(core::array::from_fn(|i| T::lift(rows[i][j]))))
        };
        let [b, c] = [tableau.b, tableau.c].map(|numbers| Lanes(numbers.map(T::lift)));
        Self { mu: columns(tableau.mu), continuation: columns(tableau.continuation()), b, c }
    }
}

/// How many numbers of a point are combined at once.
const BLOCK: usize = 4;

/// Sets pack k of `out` to y + (e + Σⱼ `columns`ⱼ xⱼ), for the numbers x in the lanes of that pack of `packs` and `from`(k) = (y, e).
#[inline(always)]
pub(super) fn combine<const STAGES: usize, T: Real>(
    columns: &[Lanes<STAGES, T>; STAGES],
    packs: &[Lanes<STAGES, T>],
    from: impl Fn(usize) -> [T; 2],
    out: &mut [Lanes<STAGES, T>],
) {
    let (blocks, left) = packs.as_chunks::<BLOCK>();
    let (outs, out_left) = out.as_chunks_mut::<BLOCK>();
    let mut first = 0;
    for (packs, out) in blocks.iter().zip(outs) {
        *out = combine_block(columns, packs, core::array::from_fn(|k| from(first + k)));
        first += BLOCK;
    }
    for (k, (pack, out)) in left.iter().zip(out_left).enumerate() {
        [*out] = combine_block(columns, &[*pack], [from(first + k)]);
    }
}

#[inline(always)]
fn combine_block<const STAGES: usize, const N: usize, T: Real>(
    columns: &[Lanes<STAGES, T>; STAGES],
    packs: &[Lanes<STAGES, T>; N],
    from: [[T; 2]; N],
) -> [Lanes<STAGES, T>; N] {
    let mut sums = [Lanes::all(T::lift(0.0)); N];
    for k in 0..N {
        sums[k] = Lanes::all(from[k][1]);
    }
    for j in 0..STAGES {
        for k in 0..N {
            sums[k] += columns[j] * Lanes::all(packs[k].0[j]);
        }
    }
    for k in 0..N {
        sums[k] = Lanes::all(from[k][0]) + sums[k];
    }
    sums
}
