//! What an evaluation needs that does not depend on the places of the bodies.

use alloc::vec::Vec;
use core::ops::Range;

use super::basis::Basis;
use super::refinement::Refinement;
use super::transfer::Transfer;

/// The functions of the basis that differ in their last degree only.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row<const D: usize> {
    /// Their other degrees.
    pub(super) degrees: [usize; D],
    pub(super) first: usize,
    pub(super) len: usize,
}

/// The basis of all expansions, and the matrices that act on them.
#[derive(Clone, Debug)]
pub(super) struct Expansion<const D: usize> {
    pub(super) basis: Basis<D>,
    pub(super) rows: Vec<Row<D>>,
    pub(super) refinement: Refinement,
    tolerance: f64,
    /// By the binary logarithm of the edge; none where bodies are to be summed one by one.
    transfers: Vec<(i32, Option<Transfer>)>,
}

impl<const D: usize> Expansion<D> {
    /// Functions with a total degree below `order`, and matrices without singular values below `tolerance` times the largest.
    pub(super) fn new(order: usize, tolerance: f64) -> Self {
        let basis = Basis::new(order);
        let firsts = basis.degrees.iter().enumerate().filter(|(_, degrees)| degrees[D - 1] == 0);
        let row = |(first, degrees): (usize, &[usize; D])| {
            let len = order - degrees.iter().sum::<usize>();
            Row { degrees: *degrees, first, len }
        };
        let rows: Vec<Row<D>> = firsts.map(row).collect();
        let refinement = Refinement::new(&basis, &rows);
        Self { basis, rows, refinement, tolerance, transfers: Vec::new() }
    }

    /// Where the matrices between cubes with this edge are, if there are any; they are computed where they are needed first.
    pub(super) fn position(&mut self, edge: i32, kernel: impl Fn(f64) -> f64) -> Option<usize> {
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

    /// Forgets the matrices of cubes that are far from these sizes.
    pub(super) fn keep(&mut self, edges: Range<i32>) {
        self.transfers.retain(|(edge, _)| (edges.start - 1..=edges.end).contains(edge));
    }
}
