//! The values that an index is known to take.
//!
//! An index is refused when there is a pass of the loops around it in which it leaves its array, and only
//! then: the passes are walked, so that `x[k - j]` for k in j..n is seen to stay at or above 0. Of a long
//! range the ends are walked, where an affine index is largest and smallest. What is not found here, or
//! depends on a size that only the run knows, is left to the check before the first step.

use syn::Expr as Syntax;

use super::{Binding, Lowering};
use crate::symbolic::{Index, Loop};

/// Ranges up to this length are walked as a whole, longer ones at their ends.
const WHOLE: i64 = 16;

/// So many values at each end.
const END: i64 = 4;

/// So many passes at most.
const PASSES: u32 = 4096;

/// A loop of the walk.
struct Around<'a> {
    over: &'a Loop,
    /// Whether its index decides anything but whether there is a pass at all.
    walked: bool,
}

struct Walk<'a> {
    loops: Vec<Around<'a>>,
    index: &'a Index,
    reached: Option<(i64, i64)>,
    left: u32,
}

impl Lowering<'_> {
    /// The smallest and the largest value of an index in the passes that were walked, if there is one.
    pub(super) fn reach(&self, index: &Index) -> Option<(i64, i64)> {
        if let Some(value) = index.as_literal() {
            return Some((value, value));
        }
        let around = self.loops_around();
        let mut walk = Walk { loops: loops(&around, index), index, reached: None, left: PASSES };
        walk.passes(0, &mut Vec::new())?;
        walk.reached
    }

    /// Reports an index that is known to leave 0..length, or to be negative.
    pub(super) fn check_range(
        &mut self,
        at: &Syntax,
        index: &Index,
        length: Option<i64>,
        name: &str,
    ) -> Option<()> {
        let Some((least, largest)) = self.reach(index) else { return Some(()) };
        let length = length.unwrap_or(i64::MAX);
        let outside = if least < 0 { least } else { largest };
        if (0..length).contains(&outside) {
            return Some(());
        }
        let reached = match index.as_literal() {
            Some(_) => format!("index {outside} is out of range"),
            None => format!("this index reaches {outside}"),
        };
        let range = match length {
            i64::MAX => format!("the first entry of `{name}` is number 0"),
            _ => format!("the entries of `{name}` are numbered 0 to {}", length - 1),
        };
        self.refuse(at, format!("{reached}: {range}"))
    }

    /// The loops around the place that is read, from the outermost.
    pub(super) fn loops_around(&self) -> Vec<&Loop> {
        let bindings = self.scope.iter().map(|(_, binding)| binding);
        bindings
            .filter_map(|binding| match binding {
                Binding::Index { over, .. } => over.as_ref(),
                Binding::Value { .. } | Binding::Function(_) => None,
            })
            .collect()
    }
}

/// The loops that the index depends on, ranges of ranges included, and those that may be empty because
/// of them; from the outermost.
fn loops<'a>(around: &[&'a Loop], index: &Index) -> Vec<Around<'a>> {
    let needed = needed(around, index);
    let kept = around.iter().filter(|over| (over.range.free().open | 1 << over.depth) & needed != 0);
    kept.map(|over| Around { over, walked: needed & (1 << over.depth) != 0 }).collect()
}

/// The loops that an index depends on, ranges of ranges included, a bit each.
pub(super) fn needed(around: &[&Loop], index: &Index) -> u64 {
    around.iter().rev().fold(index.free().open, |needed, over| {
        if needed & (1 << over.depth) != 0 { needed | over.range.free().open } else { needed }
    })
}

impl Walk<'_> {
    /// `None` if something is not known: a size, or a loop that was left out.
    fn passes(&mut self, depth: usize, values: &mut Vec<(u32, i64)>) -> Option<()> {
        let Some(Around { over, walked }) = self.loops.get(depth) else {
            let value = self.index.value_in(values)?;
            let (least, largest) = self.reached.unwrap_or((value, value));
            self.reached = Some((least.min(value), largest.max(value)));
            self.left = self.left.saturating_sub(1);
            return Some(());
        };
        let (own, walked) = (over.depth, *walked);
        let (lower, upper) = (over.range.lower.value_in(values)?, over.range.upper.value_in(values)?);
        let except = match &over.range.except {
            Some(except) => Some(except.value_in(values)?),
            None => None,
        };
        let whole = upper.saturating_sub(lower) <= WHOLE;
        let (first, last) =
            if whole { (lower..upper, upper..upper) } else { (lower..lower + END, upper - END..upper) };
        for value in first.chain(last).filter(|value| Some(*value) != except) {
            values.push((own, value));
            self.passes(depth + 1, values)?;
            values.pop();
            if !walked || self.left == 0 {
                break;
            }
        }
        Some(())
    }
}
