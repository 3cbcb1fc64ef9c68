//! The class of one-step schemes: a half of the coordinates along which the one-form has no component.
//!
//! With α = ϑ(x, y)·dx the discrete equations of such schemes couple two points and not three (Ellison et
//! al. 2018). It is a property of the one-form as it is written: α and α + dF have the same motion.

use super::gauge::{self, Effort, Found, Search};
use crate::model::Model;
use crate::symbolic::{Coordinate, Expr, Graph, Index, Loop, Variable};

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
    /// Out of class, what is said of the gauge that would help, if one is known.
    pub(crate) advice: Option<String>,
}

/// Takes note of a coordinate that is touched in some loops.
fn touch(touched: &mut [Components], model: &Model, coordinate: &Coordinate, loops: &[Loop]) {
    let block = coordinate.block as usize;
    let size = model.block_size(block).as_literal().filter(|_| model.blocks[block].array.is_some());
    let indices = size.and_then(|size| {
        let indices = visited(&coordinate.index, loops)?;
        indices.iter().all(|index| (0..size).contains(index)).then_some((size as usize, indices))
    });
    let known = &mut touched[block];
    match (indices, &mut *known) {
        (_, Components::Block(true)) => {}
        (Some((_, indices)), Components::Entries(entries)) => {
            indices.into_iter().for_each(|index| entries[index as usize] = true);
        }
        (Some((size, indices)), Components::Block(false)) => {
            let entries = (0..size).map(|index| indices.contains(&(index as i64)));
            *known = Components::Entries(entries.collect());
        }
        (None, _) => *known = Components::Block(true),
    }
    if let Components::Entries(entries) = known
        && entries.iter().all(|&entry| entry)
    {
        *known = Components::Block(true);
    }
}

impl Class {
    /// From α·v.
    pub(crate) fn new(graph: &mut Graph, model: &Model, one_form: Expr) -> Self {
        let mut components: Vec<Components> = vec![Components::Block(false); model.blocks.len()];
        for contribution in graph.gradient(one_form, &[]) {
            if let (Variable::Velocity, coordinate) = graph.variable(contribution.target) {
                touch(&mut components, model, coordinate, &contribution.loops);
            }
        }
        let mut class = Self { components, is_proper: false, advice: None };
        class.is_proper = class.size(model, true) == class.size(model, false);
        class
    }

    /// The same with advice, where α is out of class and a gauge would help in place of that which there is,
    /// if any.
    pub(crate) fn with_advice(
        mut self,
        graph: &Graph,
        model: &Model,
        declared: Expr,
        has_gauge: bool,
    ) -> Self {
        if !self.is_proper {
            self.advice = match gauge::search(graph, model, declared, Effort::Advice) {
                Search::Found(Found { text, without, .. }) => {
                    let instead = if has_gauge { " in place of the gauge that is written" } else { "" };
                    Some(format!("`gauge = {text}`{instead} would leave none along {}", without.join(", ")))
                }
                Search::NotNeeded => Some("`gauge` left out would leave it in class".to_string()),
                Search::None(_) => None,
            };
        }
        self
    }

    /// Whether α has components along less than half of the coordinates, so that Ω has no inverse.
    pub(crate) fn is_too_small(&self, model: &Model) -> bool {
        let [with, without] = [true, false].map(|with| self.size(model, with).as_literal());
        matches!((with, without), (Some(with), Some(without)) if with < without)
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
                Components::Block(known) if *known == with => {
                    let name = format!("`{}`", block.label().replace("r#", ""));
                    // That of a vector is said once for the four coordinates of its spinor.
                    if !(block.is_spinor() && names.contains(&name)) {
                        names.push(name);
                    }
                }
                Components::Block(_) => {}
                Components::Entries(entries) => {
                    let these = entries.iter().enumerate().filter(|(_, entry)| **entry == with);
                    names.extend(these.map(|(index, _)| format!("`{}`", block.at(index as i64))));
                }
            }
        }
        names
    }

    /// What is said of the class in reports.
    pub(crate) fn sentence(&self, model: &Model) -> String {
        let [with, without] = [true, false].map(|with| self.names(model, with).join(", "));
        let advice = self.advice.as_ref().map_or_else(String::new, |advice| format!(" {advice}."));
        match self.is_proper {
            true => format!("α has no component along {without}: one-step schemes can be used."),
            false => format!(
                "α has components along {with}, more than half of the coordinates: no one-step schemes.{advice}"
            ),
        }
    }
}

/// More values of an index than these are not enumerated.
const MOST: usize = 4096;

/// The values of an index in its loops, where all bounds are literal.
fn visited(index: &Index, loops: &[Loop]) -> Option<Vec<i64>> {
    let mut found = Vec::new();
    visit(index, loops, &mut Vec::new(), &mut found)?;
    Some(found)
}

fn visit(index: &Index, loops: &[Loop], open: &mut Vec<(u32, i64)>, found: &mut Vec<i64>) -> Option<()> {
    let Some((outer, inner)) = loops.split_first() else {
        found.push(index.value_in(open)?);
        return (found.len() <= MOST).then_some(());
    };
    let (lower, upper) = (outer.range.lower.value_in(open)?, outer.range.upper.value_in(open)?);
    let left_out = outer.range.left_out().map(|index| index.value_in(open)).collect::<Option<Vec<i64>>>()?;
    for at in (lower..upper).filter(|at| !left_out.contains(at)) {
        open.push((outer.depth, at));
        visit(index, inner, open, found)?;
        open.pop();
    }
    Some(())
}
