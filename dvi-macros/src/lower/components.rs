//! One-forms and forces by their components, one for each block of coordinates.

use syn::{Expr as Syntax, Ident};

use super::{Lowering, Role};
use crate::errors::{here, listed, nearest};
use crate::symbolic::{Atom, Contribution, Coordinate, Expr, Fold, Index, Loop, Node, Range};
use crate::syntax::Force;

/// A component of a covector: its value at the entry `index` of a block, in the loop over that block if it
/// is an array.
struct Component {
    block: usize,
    index: Index,
    over: Option<Loop>,
    value: Expr,
}

impl Component {
    fn coordinate(&self) -> Coordinate {
        Coordinate { block: self.block as u32, index: self.index.clone() }
    }
}

impl Lowering<'_> {
    /// The one-form with these components: Σ_b Σ_i αᵇᵢ·d(xᵇᵢ).
    pub(crate) fn components(&mut self, list: &syn::ExprArray) -> Option<Expr> {
        let components = self.listed(list, Role::Component)?;
        let terms: Vec<Expr> = components.into_iter().map(|component| self.term(component)).collect();
        Some(self.graph.sum(&terms))
    }

    fn term(&mut self, component: Component) -> Expr {
        let velocity = self.graph.intern(Node::Velocity(component.coordinate())).into();
        let term = self.graph.multiply(component.value, velocity);
        match component.over {
            Some(over) => self.graph.fold(Fold::Sum, Atom::Open(over.depth), over.range, term),
            None => term,
        }
    }

    /// The components of a force that do not vanish, each at the coordinate that it acts on.
    pub(crate) fn forces(&mut self, forces: &[Force]) -> Option<Vec<Contribution>> {
        let parts: Vec<Option<Vec<Component>>> = forces
            .iter()
            .map(|force| match force {
                Force::Components(list) => self.listed(list, Role::Force),
                Force::On(name, formula) => {
                    let block = self.declared_block(name)?;
                    Some(vec![self.component(block, formula, Role::Force)?])
                }
            })
            .collect();
        let parts: Vec<Vec<Component>> = parts.into_iter().collect::<Option<_>>()?;
        let acting = parts.into_iter().flatten().filter(|part| !part.value.is_zero());
        let contribution = |part: Component| Contribution {
            target: self.graph.intern(Node::Coordinate(part.coordinate())),
            loops: part.over.into_iter().collect(),
            value: part.value,
        };
        Some(acting.map(contribution).collect())
    }

    fn declared_block(&mut self, name: &Ident) -> Option<usize> {
        let blocks = &self.model.blocks[..self.model.declared_blocks()];
        let found = blocks.iter().position(|block| block.name == *name);
        if found.is_none() && !self.model.lost_coordinates {
            let names: Vec<String> = blocks.iter().map(|block| block.name.to_string()).collect();
            let hint = match nearest(&name.to_string(), names.iter().map(String::as_str)) {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("the coordinates are {}", listed(names.iter().map(String::as_str))),
            };
            self.errors.push(
                name,
                format!("a force acts on a coordinate, and there is no coordinate `{name}`; {hint}"),
            );
        }
        found
    }

    /// A list of components, one for each block.
    fn listed(&mut self, list: &syn::ExprArray, role: Role) -> Option<Vec<Component>> {
        let (expected, found) = (self.model.declared_blocks(), list.elems.len());
        if found != expected {
            if !self.model.lost_coordinates {
                let blocks = &self.model.blocks[..expected];
                let names: Vec<String> = blocks.iter().map(|b| b.name.to_string()).collect();
                let names = listed(names.iter().map(String::as_str));
                let message =
                    format!("expected {expected} components, one for each of {names}; {}", here(found));
                self.errors.push(list, message);
            }
            return None;
        }
        let components = list.elems.iter().enumerate();
        let components: Vec<Option<Component>> =
            components.map(|(block, component)| self.component(block, component, role)).collect();
        components.into_iter().collect()
    }

    fn component(&mut self, block: usize, component: &Syntax, role: Role) -> Option<Component> {
        let name = self.model.blocks[block].name.clone();
        match (self.model.blocks[block].array.clone(), component) {
            (None, Syntax::Closure(_)) => {
                self.errors.push(
                    component,
                    format!("`{name}` is a single coordinate: write its component without `|…|`"),
                );
                None
            }
            (None, _) => {
                let value = self.formula(component, role)?;
                Some(Component { block, index: Index::literal(0), over: None, value })
            }
            (Some((size, _)), Syntax::Closure(closure)) => {
                self.begin(component, role);
                let [index] = self.closure_indices::<1>(closure)?;
                let over = Loop { depth: 0, range: Range::up_to(size) };
                let value = self.inside(&[(index, Index::open(0), &over)], &closure.body)?;
                Some(Component { block, index: Index::open(0), over: Some(over), value })
            }
            (Some(_), _) => {
                self.errors.push(
                    component,
                    format!("`{name}` is an array: write its component as `|i| …`, for entry i"),
                );
                None
            }
        }
    }
}
