//! Where the formulas of the motion are not smooth: where `abs` and `signum` are taken of zero, and where
//! what a condition, `min` or `max` compares is equal.

use super::{Lowering, Role};
use crate::symbolic::{Expr, Free};

impl Lowering<'_> {
    /// Notes that the formula is not smooth where `a` is `b`. What depends on an index differs from term to
    /// term of a sum, and is left out.
    pub(super) fn note_seam(&mut self, a: Expr, b: Expr) {
        // A formula of the motion may use a name that formulas share.
        let is_of_motion =
            !matches!(self.role, Role::Gauge | Role::Constraint(_) | Role::Momentum | Role::Event);
        let is_one = [a, b].iter().all(|side| self.graph.free(side.node) == Free::default());
        if is_of_motion && is_one && !self.seams.contains(&[a, b]) {
            self.seams.push([a, b]);
        }
    }
}
