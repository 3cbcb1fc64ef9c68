//! The class of one-step schemes: a half of the coordinates along which the one-form has no component.
//!
//! With α = ϑ(x, y)·dx the discrete equations of such schemes couple two points and not three (Ellison et al. 2018). It is
//! a property of the one-form as it is written: α and α + dF have the same motion.

use crate::model::Model;
use crate::program::{Variable, variable};
use crate::symbolic::{Expr, Graph, Index, Loop};

/// Along which coordinates of a block the one-form has components.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Components {
    /// All, or none.
    Block(bool),
    /// Index by index, for an array of literal size.
    Entries(Vec<bool>),
}

/// Where the one-form has components.
#[derive(Clone, Debug)]
pub(crate) struct Class {
    /// One for each block.
    pub(crate) components: Vec<Components>,
    /// Whether the coordinates without a component are half of all.
    pub(crate) is_proper: bool,
}

impl Class {
    /// From α·v.
    pub(crate) fn new(graph: &mut Graph, model: &Model, one_form: Expr) -> Self {
        let mut components: Vec<Components> = vec![Components::Block(false); model.blocks.len()];
        for contribution in graph.gradient(one_form, &[]) {
            let (Variable::Velocity, coordinate) = variable(graph, contribution.target) else { continue };
            let block = coordinate.block as usize;
            let size = model.block_size(block).as_literal().filter(|_| model.blocks[block].array.is_some());
            let indices = size.and_then(|size| {
                let indices = visited(&coordinate.index, &contribution.loops)?;
                indices.iter().all(|&index| (0..size).contains(&index)).then_some((size as usize, indices))
            });
            match (indices, &mut components[block]) {
                (_, Components::Block(true)) => {}
                (Some((_, indices)), Components::Entries(entries)) => {
                    indices.into_iter().for_each(|index| entries[index as usize] = true);
                }
                (Some((size, indices)), whole) => {
                    let entries = (0..size).map(|index| indices.contains(&(index as i64)));
                    *whole = Components::Entries(entries.collect());
                }
                (None, whole) => *whole = Components::Block(true),
            }
        }
        for known in &mut components {
            if let Components::Entries(entries) = known
                && entries.iter().all(|&entry| entry)
            {
                *known = Components::Block(true);
            }
        }
        let mut class = Self { components, is_proper: false };
        class.is_proper = class.size(model, true) == class.size(model, false);
        class
    }

    /// Whether α has no component along some coordinate.
    pub(crate) fn lacks_components(&self) -> bool {
        self.components.iter().any(|known| *known != Components::Block(true))
    }

    /// The number of coordinates of a block with components, or without.
    pub(crate) fn size_in(&self, model: &Model, block: usize, with: bool) -> Index {
        match &self.components[block] {
            Components::Block(known) if *known == with => model.block_size(block),
            Components::Block(_) => Index::default(),
            Components::Entries(entries) => {
                Index::literal(entries.iter().filter(|&&entry| entry == with).count() as i64)
            }
        }
    }

    /// The number of all such coordinates.
    pub(crate) fn size(&self, model: &Model, with: bool) -> Index {
        let blocks = 0..self.components.len();
        blocks.fold(Index::default(), |sum, block| sum.plus(&self.size_in(model, block, with), 1))
    }

    /// The names of the coordinates with components, or without, as `x` and `z[0]`.
    pub(crate) fn names(&self, model: &Model, with: bool) -> Vec<String> {
        let mut names = Vec::new();
        for (block, known) in model.blocks.iter().zip(&self.components) {
            match known {
                Components::Block(known) if *known == with => names.push(format!("`{}`", block.name)),
                Components::Block(_) => {}
                Components::Entries(entries) => {
                    let these = entries.iter().enumerate().filter(|(_, entry)| **entry == with);
                    names.extend(these.map(|(index, _)| format!("`{}[{index}]`", block.name)));
                }
            }
        }
        names
    }

    /// What is said of the class in reports.
    pub(crate) fn sentence(&self, model: &Model) -> String {
        let [with, without] = [true, false].map(|with| self.names(model, with).join(", "));
        match self.is_proper {
            true => format!("α has no component along {without}: one-step schemes can be used."),
            false => format!(
                "α has components along {with}, more than half of the coordinates: no one-step schemes."
            ),
        }
    }
}

/// The values of an index, where they are literal.
fn visited(index: &Index, loops: &[Loop]) -> Option<Vec<i64>> {
    if let Some(index) = index.as_literal() {
        return Some(vec![index]);
    }
    let only = loops.iter().find(|only| *index == Index::open(only.depth))?;
    let (lower, upper) = (only.range.lower.as_literal()?, only.range.upper.as_literal()?);
    (upper - lower <= 64 && only.range.left_out().next().is_none()).then(|| (lower..upper).collect())
}
