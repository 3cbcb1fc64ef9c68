//! What an evaluation needs that does not depend on the places of the bodies.

use alloc::vec::Vec;
use core::ops::Range;

use super::basis::Basis;
use super::packs::Pack;
use super::subspace::Subspace;
use super::transfer::Transfer;

/// The functions of the basis that differ in their last degree only.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row<const D: usize> {
    /// Their other degrees.
    pub(super) degrees: [usize; D],
    pub(super) first: usize,
    pub(super) len: usize,
}

/// What stands in the rows of the cubes of one level, moments or local expansions.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stage<'w> {
    /// The functions of the level.
    pub(super) subspace: &'w Subspace,
    /// The first of its cubes.
    pub(super) first: usize,
    pub(super) rows: &'w [f64],
}

impl Stage<'_> {
    /// Where the row of a cube begins.
    pub(super) fn row(&self, cube: usize) -> usize {
        (cube - self.first) * self.subspace.stride
    }
}

/// Subspaces that are kept.
const MOST_KEPT: usize = 64;

/// The basis of all expansions, and the matrices that act on them.
#[derive(Clone, Debug)]
pub(super) struct Expansion<const D: usize> {
    pub(super) basis: Basis<D>,
    pub(super) rows: Vec<Row<D>>,
    tolerance: f64,
    /// By the binary logarithm of the edge; none where bodies are to be summed one by one.
    transfers: Vec<(i32, Option<Transfer>)>,
    subspaces: Vec<(Key, Subspace)>,
}

/// What a subspace depends on: that of larger cubes, the binary logarithm of the edge, and whether there are
/// matrices between these cubes.
type Key = (Option<usize>, i32, bool);

impl<const D: usize> Expansion<D> {
    /// Functions with a total degree below `order`, and matrices of functions of which there is more than
    /// `tolerance` times the largest.
    pub(super) fn new(order: usize, tolerance: f64) -> Self {
        let basis = Basis::new(order);
        let firsts = basis.degrees.iter().enumerate().filter(|(_, degrees)| degrees[D - 1] == 0);
        let row = |(first, degrees): (usize, &[usize; D])| {
            let len = order - degrees.iter().sum::<usize>();
            Row { degrees: *degrees, first, len }
        };
        let rows: Vec<Row<D>> = firsts.map(row).collect();
        Self { basis, rows, tolerance, transfers: Vec::new(), subspaces: Vec::new() }
    }

    /// Where the matrices between cubes with this edge are, if there are any; they are computed where they
    /// are needed first.
    pub(super) fn position(&mut self, edge: i32, kernel: &dyn Fn(Pack) -> Pack) -> Option<usize> {
        let known = self.transfers.iter().position(|(known, _)| *known == edge);
        let position = known.unwrap_or_else(|| {
            self.transfers.push((edge, Transfer::new(&self.basis, self.tolerance, edge, kernel)));
            self.transfers.len() - 1
        });
        self.transfers[position].1.is_some().then_some(position)
    }

    pub(super) fn transfer(&self, position: Option<usize>) -> Option<&Transfer> {
        self.transfers[position?].1.as_ref()
    }

    /// Where the functions are for cubes with this edge, within others with those at `above`, and with the
    /// matrices at `own`.
    pub(super) fn subspace_position(
        &mut self,
        above: Option<usize>,
        edge: i32,
        own: Option<usize>,
    ) -> usize {
        let key = (above, edge, own.is_some());
        self.subspaces.iter().position(|(known, _)| *known == key).unwrap_or_else(|| {
            let found = Subspace::new(&self.basis, self.subspace(above), self.transfer(own), self.tolerance);
            self.subspaces.push((key, found));
            self.subspaces.len() - 1
        })
    }

    pub(super) fn subspace(&self, position: Option<usize>) -> Option<&Subspace> {
        Some(&self.subspaces[position?].1)
    }

    /// Forgets the matrices of cubes that are far from these sizes.
    pub(super) fn keep(&mut self, edges: Range<i32>) {
        let kept = edges.start - 1..=edges.end;
        self.transfers.retain(|(edge, _)| kept.contains(edge));
        // Others depend on them.
        if self.subspaces.len() > MOST_KEPT
            || self.subspaces.iter().any(|((_, edge, _), _)| !kept.contains(edge))
        {
            self.subspaces.clear();
        }
    }
}
