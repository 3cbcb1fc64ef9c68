//! One-forms and forces by their components, as they are written.

use std::ops::Range as Blocks;

use syn::Expr;

use super::super::jet::Jet;
use super::super::point::{Directions, Variable};
use super::{Evaluation, Quantity, Value, unknown};
use crate::syntax::{Attribute, Force};

impl Evaluation<'_> {
    /// α·v of a list of components.
    pub(in super::super) fn components(&mut self, list: &syn::ExprArray) -> Value<Jet> {
        let mut total = Jet::number(0.0);
        for (blocks, component) in self.model.coordinates().into_iter().zip(&list.elems) {
            for (block, index, component) in self.entries(blocks, component)? {
                let velocity = self.variable(Variable::Velocity, block, index)?;
                total = total.plus(&component.times(&velocity));
            }
        }
        Ok(total)
    }

    /// The forces times the displacements along both directions: the work of a displacement.
    pub(in super::super) fn work(&mut self, attribute: &Attribute) -> Value<[Jet; 2]> {
        let dissipated = match &attribute.dissipation {
            Some(function) => self.number(function)?.slopes(),
            None => [Jet::number(0.0), Jet::number(0.0)],
        };
        let mut work = dissipated.map(|dissipated| dissipated.scaled(-1.0));
        for force in &attribute.forces {
            let components: Vec<(Blocks<usize>, &Expr)> = match force {
                Force::Components(list) => self.model.coordinates().into_iter().zip(&list.elems).collect(),
                Force::On(name, formula) => match self.block(&name.to_string()) {
                    Some(block) => vec![(self.model.coordinate_at(block), formula)],
                    None => unknown(name),
                },
            };
            for (blocks, component) in components {
                for (block, index, value) in self.entries(blocks, component)? {
                    let Directions { first, second } = self.directions;
                    for (work, (support, is_second)) in work.iter_mut().zip([(first, false), (second, true)])
                    {
                        let displacement = self.point.direction(support, is_second, block, index);
                        *work = work.clone().plus(&value.clone().scaled(displacement));
                    }
                }
            }
        }
        Ok(work)
    }

    /// The components of a covector along a coordinate, each with its block and the index there.
    fn entries(&mut self, blocks: Blocks<usize>, component: &Expr) -> Value<Vec<(usize, i64, Jet)>> {
        let first = blocks.start;
        let Expr::Closure(closure) = component else {
            return Ok(match self.quantity(component)? {
                Quantity::Vector(components) => {
                    components.into_iter().zip(0..).map(|(value, index)| (first, index, value)).collect()
                }
                Quantity::Number(value) | Quantity::Empty(value) => vec![(first, 0, value)],
            });
        };
        let mut entries = Vec::new();
        let mut passes = vec![Vec::new()];
        for size in self.model.blocks[first].sizes() {
            let visited = self.point.visited(0, self.length(&size));
            let further = |pass: &Vec<i64>, index: i64| pass.iter().copied().chain([index]).collect();
            passes = passes
                .iter()
                .flat_map(|pass| visited.clone().map(move |index| further(pass, index)))
                .collect();
        }
        for indices in passes {
            let index = self.flat(first, &indices)?;
            match self.closure(closure, &indices)? {
                Quantity::Vector(components) => {
                    entries
                        .extend(blocks.clone().zip(components).map(|(block, value)| (block, index, value)));
                }
                Quantity::Number(value) | Quantity::Empty(value) => {
                    entries.extend(blocks.clone().map(|block| (block, index, value.clone())));
                }
            }
        }
        Ok(entries)
    }
}
