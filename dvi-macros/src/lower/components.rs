//! One-forms and forces by their components, one for each block of coordinates.

use std::ops::Range as Blocks;

use syn::{Expr as Syntax, Ident};

use super::{Lowering, Role, Value, all};
use crate::errors::{here, listed, nearest};
use crate::model::Block;
use crate::symbolic::{Atom, Contribution, Coordinate, Expr, Fold, Index, Loop, Node, Range};
use crate::syntax::{Factor, Force};
use crate::words::AREA;

/// A component of a covector: its value at the entry `index` of a block, in the loop over that block if it
/// is an array, or in both where it has two indices.
#[derive(Clone)]
struct Component {
    block: usize,
    index: Index,
    over: Vec<Loop>,
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
        let loops = component.over.into_iter().rev();
        loops.fold(term, |term, over| self.graph.fold(Fold::Sum, Atom::Open(over.depth), over.range, term))
    }

    /// The components of a force that do not vanish, each at the coordinate that it acts on.
    pub(crate) fn forces(&mut self, forces: &[Force]) -> Option<Vec<Contribution>> {
        let parts = all(forces.iter().map(|force| match force {
            Force::Components(list) => self.listed(list, Role::Force),
            Force::On(name, formula) => {
                let blocks = self.declared_blocks(name)?;
                self.along(blocks, formula, Role::Force)
            }
        }))?;
        let acting = parts.into_iter().flatten().filter(|part| !part.value.is_zero());
        let contribution = |part: Component| Contribution {
            target: self.graph.intern(Node::Coordinate(part.coordinate())),
            loops: part.over,
            value: part.value,
        };
        Some(acting.map(contribution).collect())
    }

    /// The force −∂R/∂v of a dissipation function R.
    pub(crate) fn dissipation(&mut self, formula: &Syntax) -> Option<Vec<Contribution>> {
        let function = self.formula(formula, Role::Dissipation)?;
        let mut force = Vec::new();
        for part in self.graph.gradient(function, &[]) {
            if let Node::Velocity(on) = self.graph.node(part.target).clone() {
                let target = self.graph.intern(Node::Coordinate(on));
                force.push(Contribution { target, value: part.value.negated(), ..part });
            }
        }
        if force.is_empty() {
            let message = "no velocity `dot(x)` stands in this dissipation function, or none is left: it makes no force";
            return self.refuse(formula, message);
        }
        Some(force)
    }

    fn declared_blocks(&mut self, name: &Ident) -> Option<Blocks<usize>> {
        let declared = self.declared();
        let found = declared.iter().find(|blocks| self.model.blocks[blocks.start].name == *name).cloned();
        if found.is_none() && !self.model.lost_coordinates {
            let names = self.names(&declared);
            let hint = match nearest(&name.to_string(), names.iter().map(String::as_str)) {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("the coordinates are {}", listed(&names)),
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
        let declared = self.declared();
        let (expected, found) = (declared.len(), list.elems.len());
        if found != expected {
            if !self.model.lost_coordinates {
                let names = listed(self.names(&declared));
                let message =
                    format!("expected {expected} components, one for each of {names}; {}", here(found));
                self.errors.push(list, message);
            }
            return None;
        }
        let components = declared.into_iter().zip(&list.elems);
        Some(all(components.map(|(blocks, component)| self.along(blocks, component, role)))?.concat())
    }

    /// The blocks of each coordinate that the attribute declares.
    fn declared(&self) -> Vec<Blocks<usize>> {
        let declared = self.model.declared_blocks();
        self.model.coordinates().into_iter().filter(|blocks| blocks.start < declared).collect()
    }

    fn names(&self, coordinates: &[Blocks<usize>]) -> Vec<String> {
        coordinates.iter().map(|blocks| self.model.blocks[blocks.start].name.to_string()).collect()
    }

    /// The components along a coordinate: one, or those of a vector.
    fn along(&mut self, blocks: Blocks<usize>, component: &Syntax, role: Role) -> Option<Vec<Component>> {
        let first = blocks.start;
        let Block { name, array, axis, grid, .. } = &self.model.blocks[first];
        let (name, axis, is_grid) = (name.to_string(), *axis, grid.is_some());
        let whole = self.model.whole(first);
        if self.model.blocks[first].factor == Factor::Rotation {
            return None; // refused where it is declared
        }
        if self.model.blocks[first].is_spinor() {
            let message = match role {
                Role::Force => format!(
                    "no force acts on the unit vector `{name}`: forces are on numbers, such as its height \
                     z and its longitude phi, with `-kappa * z * d(phi)` for the area; a force on one \
                     number is `force(x) = …`"
                ),
                _ => format!(
                    "the one-form along a unit vector is an area: write the one-form as a sum of terms, with `{AREA}({})` in it",
                    self.model.blocks[first].label()
                ),
            };
            return self.refuse(component, message);
        }
        match (array.clone(), component) {
            (None, Syntax::Closure(_)) => {
                let message = format!("`{name}` is a single coordinate: write its component without `|…|`");
                self.refuse(component, message)
            }
            (None, _) => {
                let value = self.formula(component, role)?;
                Some(vec![Component { block: first, index: Index::literal(0), over: Vec::new(), value }])
            }
            (Some(_), Syntax::Closure(closure)) => {
                self.begin(component, role);
                let names = match is_grid {
                    true => self.closure_indices::<2>(closure)?.to_vec(),
                    false => self.closure_indices::<1>(closure)?.to_vec(),
                };
                let over = |(size, depth)| Loop { depth, range: Range::up_to(size) };
                let over: Vec<Loop> =
                    self.model.blocks[first].sizes().into_iter().zip(0..).map(over).collect();
                let indices: Vec<Index> = over.iter().map(|over| Index::open(over.depth)).collect();
                let index = self.model.blocks[first].place(&indices);
                let bound = names.into_iter().zip(indices).zip(&over);
                let bound: Vec<_> = bound.map(|((name, form), over)| (name, form, over)).collect();
                let value = self.inside(&bound, &closure.body)?;
                let values = match axis {
                    Some(axis) => {
                        self.vector_of(&closure.body, axis.of, [&format!("{name}[i]"), ""], value)?
                    }
                    None => vec![self.number_of(&closure.body, role, value)?],
                };
                let part =
                    |(block, value)| Component { block, index: index.clone(), over: over.clone(), value };
                Some(blocks.zip(values).map(part).collect())
            }
            (Some(_), _) => {
                let Some(size) = whole else {
                    let (of, entry) = if is_grid { ("|i, j|", "i, j") } else { ("|i|", "i") };
                    let message =
                        format!("`{name}` is an array: write its component as `{of} …`, for entry {entry}");
                    return self.refuse(component, message);
                };
                self.begin(component, role);
                let value = self.value(component)?;
                let each = ", or a component for each entry, as `|i| …`";
                let values = self.vector_of(component, size as usize, [&name, each], value)?;
                let values = values.into_iter().zip(0..);
                let part = |(value, entry)| Component {
                    block: first,
                    index: Index::literal(entry),
                    over: Vec::new(),
                    value,
                };
                Some(values.map(part).collect())
            }
        }
    }

    /// The components of what acts on a vector of so many, or else what there is to write, and what instead.
    fn vector_of(
        &mut self,
        at: &Syntax,
        count: usize,
        [name, instead]: [&str; 2],
        value: Value,
    ) -> Option<Vec<Expr>> {
        match value {
            Value::Vector(components) if components.len() == count => Some(components),
            Value::Vector(components) => {
                let message =
                    format!("`{name}` has {count} components, and this is a vector of {}", components.len());
                self.refuse(at, message)
            }
            Value::Number(_) => {
                let components = vec!["…"; count].join(", ");
                let message = format!(
                    "`{name}` is a vector of {count} components, and this is a number: write a vector, as `[{components}]`{instead}"
                );
                self.refuse(at, message)
            }
        }
    }
}
