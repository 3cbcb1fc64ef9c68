//! Second derivatives over the coordinates as those over the tangent vectors of their blocks.

use super::variation::Rows;
use crate::mechanics::manifold::blocks;
use crate::mechanics::pattern::visit_second_derivatives;
use crate::space::Sink;
use crate::system::{Factor, ManifoldSystem};
use crate::{ManifoldLagrangian, Real, Space, System, Vector};

/// The first tangent vector of the block of each coordinate, and how many the block has.
pub(super) type Slots<S> = Vector<S, [usize; 2]>;

pub(super) fn slots<S: ManifoldSystem>(system: &S) -> Slots<S> {
    let mut slots = system.space().array([0; 2]);
    for block in blocks(system) {
        for (number, place) in block.places().enumerate() {
            slots[place] = match block.factor {
                Factor::Line => [block.slot + number, 1],
                Factor::Rotation | Factor::Sphere => [block.slot, block.dimension()],
            };
        }
    }
    slots
}

/// Visits the tangent vectors that depend on one another in the equations of a step: those of coordinates
/// that a second derivative of L at a point couples, and those of one block.
pub(super) fn visit_coupled<S: ManifoldLagrangian<T>, T: Real>(
    system: &S,
    slots: &Slots<S>,
    at: [&[T]; 2],
    t: T,
    visit: &mut dyn FnMut(usize, usize),
) {
    let mut all = |[first, rows]: [usize; 2], [second, columns]: [usize; 2]| {
        (0..rows).for_each(|i| (0..columns).for_each(|j| visit(first + i, second + j)));
    };
    for &slots in slots.iter() {
        all(slots, slots);
    }
    visit_second_derivatives(system, at, t, &mut |row, column| all(slots[row], slots[column]));
}

/// Passes the entries of a matrix over the coordinates on as those of Aᵀ M B, where the rows of A and B are
/// variations.
pub(super) struct Between<'a, S: System, T: Real, K> {
    pub(super) left: &'a Rows<S, T>,
    pub(super) right: &'a Rows<S, T>,
    pub(super) slots: &'a Slots<S>,
    pub(super) sink: &'a mut K,
}

impl<S: System, T: Real, K: Sink<T>> Sink<T> for Between<'_, S, T, K> {
    #[inline]
    fn add(&mut self, row: usize, column: usize, entry: T) {
        // Blocks of weight zero come with the others.
        if entry == T::lift(0.0) {
            return;
        }
        let ([first, rows], [second, columns]) = (self.slots[row], self.slots[column]);
        for i in 0..rows {
            for j in 0..columns {
                self.sink.add(first + i, second + j, self.left[row][i] * entry * self.right[column][j]);
            }
        }
    }
}
