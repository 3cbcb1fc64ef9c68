//! The cubes of one level with what belongs to them, and how threads share them, with the feature `threads`.

use alloc::vec::Vec;
use core::ops::Range;

use super::tree::Tree;
use crate::threads::{at_once, largest_part};

/// Some cubes of one level, and the numbers that are computed for them.
#[derive(Debug)]
pub(super) struct Piece<'w, T, const D: usize> {
    pub(super) cubes: Range<usize>,
    /// For the bodies of these cubes, from the first one on.
    pub(super) sums: [&'w mut [f64]; D],
    /// For each cube a row, one after the other.
    pub(super) rows: &'w mut [T],
    /// Room for expansions in the basis, one for each cube.
    pub(super) room: &'w mut [f64],
}

impl<'w, T, const D: usize> Piece<'w, T, D> {
    /// All cubes of a level.
    pub(super) fn new(
        tree: &Tree<D>,
        level: usize,
        sums: &'w mut [Vec<f64>; D],
        rows: &'w mut [T],
        room: &'w mut [f64],
    ) -> Self {
        let cubes = tree.levels[level].clone();
        let bodies = tree.cubes[cubes.start].first..tree.cubes[cubes.end - 1].past;
        Self { cubes, sums: sums.each_mut().map(|sums| &mut sums[bodies.clone()]), rows, room }
    }
}

/// Runs through the cubes of a level, cut into parts. `begin` says where the row and the room of a cube
/// begin, counted from anywhere.
pub(super) fn share<T: Send, const D: usize>(
    whole: Piece<'_, T, D>,
    tree: &Tree<D>,
    begin: &(dyn Fn(usize) -> [usize; 2] + Sync),
    run: &(dyn Fn(Piece<'_, T, D>) + Sync),
) {
    fn cut<T: Send, const D: usize>(
        piece: Piece<'_, T, D>,
        largest: usize,
        tree: &Tree<D>,
        begin: &(dyn Fn(usize) -> [usize; 2] + Sync),
        run: &(dyn Fn(Piece<'_, T, D>) + Sync),
    ) {
        let Range { start, end } = piece.cubes;
        if piece.sums[0].len() <= largest || end - start < 2 {
            return run(piece);
        }
        let middle = start + (end - start) / 2;
        let bodies = tree.cubes[middle].first - tree.cubes[start].first;
        let [begins, middles] = [begin(start), begin(middle)];
        let Piece { mut sums, rows, room, .. } = piece;
        let others = sums.each_mut().map(|sums| {
            let (own, other) = core::mem::take(sums).split_at_mut(bodies);
            *sums = own;
            other
        });
        let rows = rows.split_at_mut(middles[0] - begins[0]);
        let room = room.split_at_mut(middles[1] - begins[1]);
        let one = Piece { cubes: start..middle, sums, rows: rows.0, room: room.0 };
        let other = Piece { cubes: middle..end, sums: others, rows: rows.1, room: room.1 };
        at_once(|| cut(one, largest, tree, begin, run), || cut(other, largest, tree, begin, run));
    }

    /// Fewer bodies are not worth handing over.
    const LEAST: usize = 64;
    let largest = largest_part(whole.sums[0].len(), LEAST);
    cut(whole, largest, tree, begin, run);
}

/// Sorts numbers of which no two are equal.
pub(super) fn sort<T: Ord + Send>(numbers: &mut [T]) {
    #[cfg(feature = "threads")]
    rayon::slice::ParallelSliceMut::par_sort_unstable(numbers);
    #[cfg(not(feature = "threads"))]
    numbers.sort_unstable();
}
