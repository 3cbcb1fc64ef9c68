//! Expansions of a cube and of its parts: B_m(u) = Σ_n A_{mn} B_n(c) with u = (c ± 1)/2, where the cube of c
//! is the half of that of u on these sides. It is exact, because the degree of a term does not grow.
//!
//! A is a product of triangular matrices, one for each axis, and is applied so.

use alloc::vec::Vec;

use super::basis::{Basis, MOST, half};
use super::expansion::Row;

/// The matrices of all sides.
#[derive(Clone, Debug)]
pub(super) struct Refinement {
    /// T_m((c ± 1)/2) = Σ_n a_{mn} T_n(c), first for the lower half: by rows.
    halves: [Vec<[f64; MOST]>; 2],
    /// For all axes but the last: which row of functions is made of which; first those that are made of
    /// most.
    mixtures: Vec<Mixture>,
}

/// The functions of one row take part in those of another, which differ by their degrees along one axis.
#[derive(Clone, Copy, Debug)]
struct Mixture {
    axis: usize,
    degrees: [usize; 2],
    firsts: [usize; 2],
    /// The length of the row of higher degree.
    len: usize,
}

impl Refinement {
    pub(super) fn new<const D: usize>(basis: &Basis<D>, rows: &[Row<D>]) -> Self {
        let halves = [-1.0, 1.0].map(|side| half(basis.order, side));
        let mut mixtures = Vec::new();
        for axis in 0..D - 1 {
            for row in rows.iter().rev() {
                for degree in (0..=row.degrees[axis]).rev() {
                    let mut degrees = row.degrees;
                    degrees[axis] = degree;
                    let other = rows.iter().find(|other| other.degrees == degrees);
                    let first = other.map_or(row.first, |other| other.first);
                    mixtures.push(Mixture {
                        axis,
                        degrees: [row.degrees[axis], degree],
                        firsts: [row.first, first],
                        len: row.len,
                    });
                }
            }
        }
        Self { halves, mixtures }
    }

    /// Makes the local expansion of a cube that of its part: Aᵀ times it.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn narrow<const D: usize>(&self, rows: &[Row<D>], side: [bool; D], local: &mut [f64]) {
        along_rows(rows, &self.halves[usize::from(side[D - 1])], local);
        for Mixture { axis, degrees: [m, n], firsts: [from, to], len } in self.mixtures.iter().rev() {
            let factor = self.halves[usize::from(side[*axis])][*m][*n];
            let (others, own) = local.split_at_mut(*from);
            let own = &mut own[..*len];
            if from == to {
                own.iter_mut().for_each(|coefficient| *coefficient *= factor);
            } else {
                add_scaled(&mut others[*to..to + len], factor, own);
            }
        }
    }
}

/// Replaces each row by Σ_k (entry k) (vector k).
#[cfg_attr(not(debug_assertions), inline(always))]
fn along_rows<const D: usize>(rows: &[Row<D>], vectors: &[[f64; MOST]], coefficients: &mut [f64]) {
    for Row { first, len, .. } in rows {
        let row = &mut coefficients[*first..first + len];
        let mut sum = [0.0; MOST];
        for (entry, vector) in row.iter().zip(vectors) {
            add_scaled(&mut sum[..*len], *entry, &vector[..*len]);
        }
        row.copy_from_slice(&sum[..*len]);
    }
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn add_scaled(to: &mut [f64], factor: f64, from: &[f64]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to += factor * from;
    }
}
