//! Unit vectors of degenerate systems, in the oracle: by the matrices of Pauli.
//!
//! The four blocks of a spinor stand for its vector. A coordinate in one of them is the component of that
//! number, of which there are three; a velocity is `area(s)`, and a vector is the unit vector.

use super::evaluate::{Oracle, Outside};
use super::formula::{Formula, Index};
use super::jet::Jet;
use super::system::{Block, System};
use super::write::{ONE, Writer};
use crate::syntax::Factor;

/// The number of coordinates of a spinor; the generator makes no other vectors of so many.
pub(super) const SPINOR: usize = 4;

/// Re z†σ w of both parts of z and w, as sums of these products: (sign, part of z, part of w).
#[rustfmt::skip]
const PAULI: [[(f64, usize, usize); 4]; 3] = [
    [(1.0, 0, 2), (1.0, 1, 3), ( 1.0, 2, 0), ( 1.0, 3, 1)],
    [(1.0, 0, 3), (1.0, 3, 0), (-1.0, 1, 2), (-1.0, 2, 1)],
    [(1.0, 0, 0), (1.0, 1, 1), (-1.0, 2, 2), (-1.0, 3, 3)],
];
/// 2 Im z†w
const AREA: [(f64, usize, usize); 4] = [(2.0, 0, 1), (-2.0, 1, 0), (2.0, 2, 3), (-2.0, 3, 2)];

fn sum(terms: &[(f64, usize, usize)], z: &[Jet], w: &[Jet]) -> Jet {
    let terms = terms.iter().map(|&(factor, i, j)| z[i].times(&w[j]).scaled(factor));
    terms.fold(Jet::constant(0.0), |sum, term| sum.plus(&term))
}

impl System {
    pub(super) fn is_spinor(&self, block: usize) -> bool {
        self.blocks[block].axis.is_some_and(|[_, of]| of == SPINOR)
    }

    pub(super) fn has_spinors(&self) -> bool {
        (0..self.blocks.len()).any(|block| self.is_spinor(block))
    }

    /// What is declared of a coordinate beside its name.
    pub(super) fn kind_text(&self, first: usize) -> String {
        let Block { size, axis, factor, .. } = self.blocks[first];
        let size = size.filter(|_| !self.is_single_factor(first));
        let size = size.map_or_else(String::new, |size| self.bracketed(first, &self.size_text(size), ONE));
        match (factor, axis) {
            (Factor::Rotation, _) => size + ": SO3",
            (Factor::Sphere, _) => size + ": S2",
            (Factor::Line, Some([_, of])) => format!("{size}[{of}]"),
            (Factor::Line, None) => size,
        }
    }
}

impl Writer<'_> {
    pub(super) fn rate(&self, block: usize, index: Option<&Index>) -> String {
        match (self.system.is_spinor(block), self.system.is_rotation(block)) {
            (true, _) => format!("area({})", self.whole(block, index)),
            (_, true) => self.angular_velocity(block, index),
            _ => format!("{}({})", self.velocity, self.place(block, index)),
        }
    }
}

impl Oracle<'_> {
    /// A coordinate, or its velocity.
    pub(super) fn variable(
        &self,
        block: usize,
        index: Option<&Index>,
        is_velocity: bool,
    ) -> Result<Jet, Outside> {
        let (place, n) = (self.coordinate(block, index)?, self.point.q.len());
        Ok(match is_velocity {
            true => Jet::variable(self.point.v[place], n + place, self.variables()),
            false => Jet::variable(self.point.q[place], place, self.variables()),
        })
    }

    /// The coordinates of a spinor, or their velocities.
    fn spinor(&self, block: usize, index: Option<&Index>, is_velocity: bool) -> Result<Vec<Jet>, Outside> {
        let first = block - self.number(block);
        (first..first + SPINOR).map(|block| self.variable(block, index, is_velocity)).collect()
    }

    fn number(&self, block: usize) -> usize {
        self.system.blocks[block].axis.map_or(0, |[number, _]| number)
    }

    pub(super) fn unit_vector(&self, block: usize, index: Option<&Index>) -> Result<Vec<Jet>, Outside> {
        let z = self.spinor(block, index, false)?;
        Ok(PAULI.iter().map(|terms| sum(terms, &z, &z)).collect())
    }

    /// A component of a unit vector, or its area.
    pub(super) fn of_spinor(&self, formula: &Formula) -> Result<Jet, Outside> {
        match formula {
            Formula::Coordinate(block, index) => {
                let mut vector = self.unit_vector(*block, index.as_ref())?;
                Ok(vector.swap_remove(self.number(*block)))
            }
            Formula::Velocity(block, index) => {
                let z = self.spinor(*block, index.as_ref(), false)?;
                Ok(sum(&AREA, &z, &self.spinor(*block, index.as_ref(), true)?))
            }
            _ => Err(Outside::Index),
        }
    }
}
