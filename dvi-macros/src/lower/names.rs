//! Names: coordinates, parameters, constants, time; and indices into arrays.

use std::f64::consts;

use syn::{Expr as Syntax, Path};

use super::habits::as_receiver;
use super::{Binding, Lowering, Value, all};
use crate::errors::here;
use crate::model::{Axis, Block, Grid, Shape, are_components};
use crate::symbolic::{Coordinate, Expr, Index, Node};
use crate::syntax::{ident, indexed, name_of, own_field};
use crate::words;

impl Lowering<'_> {
    pub(super) fn path(&mut self, path: &Path) -> Option<Value> {
        let Some(ident) = path.get_ident() else {
            let segments: Vec<String> = path.segments.iter().map(|part| part.ident.to_string()).collect();
            match segments.iter().map(String::as_str).collect::<Vec<_>>().as_slice() {
                // Written out in full: a shorter path may lead to a module of the user's own.
                ["std" | "core", "f64", "consts", name] => {
                    if let Some((value, _)) = words::constant(name) {
                        return Some(Expr::number(value).into());
                    }
                }
                [.., "f64", "NAN" | "INFINITY" | "NEG_INFINITY"] => {
                    let message = "a formula has finite values: write a number in the place of this, or \
                                   leave out what is infinitely far";
                    return self.refuse(path, message);
                }
                _ => {}
            }
            let field = self.model.path_parameter(path);
            return Some(self.parameter_node(field, Vec::new()).into());
        };
        let name = ident.to_string();
        let position = self.position_of(&name);
        match position.map(|position| &self.scope[position].1) {
            Some(Binding::Value { value, .. }) => {
                let value = value.clone()?;
                let is_shared = position.is_some_and(|position| self.is_shared(position));
                return if is_shared { self.used(path, &name, value) } else { Some(value) };
            }
            Some(Binding::Function(_)) => {
                return self.refuse(path, format!("`{name}` is a function: write `{name}(…)`"));
            }
            Some(Binding::Index { .. }) => {
                return self.refuse(
                    path,
                    format!("`{name}` is an index: as a number it is written `{name} as f64`"),
                );
            }
            None => {}
        }
        if let Some(block) = self.model.blocks.iter().position(|block| block.name == name) {
            if let Some(size) = self.model.whole(block) {
                let components =
                    (0..size).map(|component| self.coordinate_node(block, Index::literal(component)));
                return Some(Value::Vector(components.collect()));
            }
            let Block { array, axis, .. } = &self.model.blocks[block];
            if array.is_none() && axis.is_some() {
                return Some(self.unit_vector(block, &Index::literal(0)));
            }
            if array.is_some() {
                let entries = if axis.is_some() { "vectors" } else { "coordinates" };
                let written = self.model.blocks[block].letters();
                let message = format!("`{name}` is an array of {entries}: write `{name}{written}`");
                return self.refuse(path, message);
            }
            if self.model.extended.is_some_and(|extended| extended.energy == block) {
                let message = "`energy` is the value that H has in a run, which the time transformation adds as a coordinate: \
                               formulas do without it";
                return self.refuse(path, message);
            }
            return Some(self.coordinate_node(block, Index::literal(0)).into());
        }
        if let Some(field) = self.parameter(ident) {
            return self.whole_parameter(path, field);
        }
        if let Some(size) = self.model.named_size(&name) {
            return Some(self.graph.count(size).into());
        }
        if name == words::PI {
            return Some(Expr::number(consts::PI).into());
        }
        if name == words::TIME {
            return Some(Expr::from(self.graph.intern(Node::Time)).into());
        }
        if self.stands_behind(path, &name) {
            return None;
        }
        if self.index_names.contains(&name) {
            return self.outside_of_sum(path, &name);
        }
        if words::constant(&name).is_some() {
            let message =
                format!("write `std::f64::consts::{name}`, or `self::{name}` for a constant of your own");
            return self.refuse(path, message);
        }
        self.unknown_name(path, &name, "unknown name")
    }

    /// Reports the name of an index where there is no such index.
    pub(super) fn outside_of_sum<T>(&mut self, at: impl quote::ToTokens, name: &str) -> Option<T> {
        self.refuse(at, format!("the index `{name}` is used outside of its sum"))
    }

    /// What is wrong with a call of a name that is that of numbers.
    pub(super) fn number_called(&mut self, name: &str, listed: &str) -> Option<String> {
        let block = self.model.blocks.iter().find(|block| block.name == name);
        let field = self.model.parameters.iter().find(|parameter| parameter.text == name);
        let is_array = match (self.binding_of(name), block, field.map(|field| &field.shape)) {
            (Some(Binding::Index { .. }), ..) => {
                return Some(format!(
                    "`{name}` is an index: a product is written `{name} as f64 * ({listed})`"
                ));
            }
            (Some(Binding::Function(_)), ..) => {
                return Some(format!("a function of your own is called as `{name}({listed})`"));
            }
            (Some(Binding::Value { value, .. }), ..) => matches!(value, Some(Value::Vector(_))),
            (None, Some(block), _) => block.array.is_some(),
            (None, None, Some(Shape::Unknown | Shape::Other)) => return None,
            (None, None, Some(shape)) => matches!(shape, Shape::Array(..)),
            (None, None, None) => {
                let is_number =
                    [words::PI, words::TIME].contains(&name) || self.model.named_size(name).is_some();
                return is_number.then(|| product(name, listed));
            }
        };
        Some(match is_array {
            true => format!("an entry of `{name}` is written `{name}[{listed}]`"),
            false => product(name, listed),
        })
    }

    fn whole_parameter(&mut self, at: &impl quote::ToTokens, field: u32) -> Option<Value> {
        let name = &self.model.parameters[field as usize].text;
        match self.shape_of(field) {
            Shape::Array(Some(length), entry) if are_components(*length, entry) => {
                Some(self.vector_parameter(field, *length, &[]))
            }
            Shape::Array(..) => {
                self.refuse(at, format!("`{name}` is an array of parameters: write `{name}[i]`"))
            }
            Shape::Other => self.errors.refuse_once(
                &format!("field {name}"),
                at,
                format!("the field `{name}` is not a number"),
            ),
            _ => Some(self.parameter_node(field, Vec::new()).into()),
        }
    }

    /// The entries of a parameter behind these indices, which are the components of a vector.
    fn vector_parameter(&mut self, field: u32, length: i64, indices: &[Index]) -> Value {
        let component = |component| {
            let indices = indices.iter().cloned().chain([Index::literal(component)]);
            self.entry_node(field, indices.collect())
        };
        Value::Vector((0..length).map(component).collect())
    }

    fn coordinate_node(&mut self, block: usize, index: Index) -> Expr {
        self.graph.intern(Node::Coordinate(Coordinate { block: block as u32, index })).into()
    }

    /// `self.name` is `name`; `self.p.m` is a field of a field.
    pub(super) fn field(&mut self, syntax: &Syntax) -> Option<Value> {
        if let Some(name) = own_field(syntax) {
            let Some(parameter) = self.parameter(name) else {
                return self.unknown_name(name, &name.to_string(), "the struct has no field");
            };
            return self.whole_parameter(syntax, parameter);
        }
        let Some(parameter) = self.nested_parameter(syntax) else {
            return self.unsupported(syntax);
        };
        Some(self.parameter_node(parameter, Vec::new()).into())
    }

    /// The parameter at `p.m`, where `p` is no name of an inner scope.
    fn nested_parameter(&mut self, syntax: &Syntax) -> Option<u32> {
        if self.is_bound_root(syntax) { None } else { self.model.nested_parameter(syntax) }
    }

    /// Whether the first name of `p.m.n` is one of an inner scope.
    fn is_bound_root(&self, syntax: &Syntax) -> bool {
        match syntax {
            Syntax::Field(field) => self.is_bound_root(&field.base),
            _ => ident(syntax).is_some_and(|name| self.binding_of(&name.to_string()).is_some()),
        }
    }

    /// `x[i]`, `r[i]` of vectors, `r[i][k]`, `gamma[i]`, `coupling[i][j]`; `v[k]` of another vector.
    pub(super) fn indexed(&mut self, syntax: &Syntax) -> Option<Value> {
        let (base, indices) = indexed(syntax);
        let Some(name) = name_of(base) else {
            if let Some(field) = self.nested_parameter(base) {
                let lowered = all(indices.iter().map(|index| self.index(index)))?;
                return Some(self.entry_node(field, lowered).into());
            }
            return self.component(base, &indices);
        };
        if matches!(base, Syntax::Path(_)) {
            match self.binding_of(&name.to_string()) {
                Some(Binding::Value { .. }) => return self.component(base, &indices),
                Some(Binding::Index { .. } | Binding::Function(_)) => {
                    let message = format!("`{name}` is a name of this formula here: it takes no index");
                    return self.refuse(base, message);
                }
                None => {}
            }
        }
        let function = name.to_string().to_lowercase();
        if words::is_method(&function) && !self.is_declared(&name.to_string()) {
            let message =
                format!("functions are written as methods: `{}.{function}()`", as_receiver(indices[0]));
            return self.refuse(syntax, message);
        }
        if let Some(block) = self.model.blocks.iter().position(|block| block.name == *name) {
            let declared = &self.model.blocks[block];
            return match declared.axis {
                Some(_) if declared.array.is_none() => {
                    let vector = self.unit_vector(block, &Index::literal(0));
                    self.component_of(vector, base, &indices)
                }
                Some(axis) => self.indexed_vector(syntax, block, axis, &indices),
                None => self.indexed_coordinate(syntax, block, &indices).map(Value::Number),
            };
        }
        let lowered = all(indices.iter().map(|index| self.index(index)));
        let Some(field) = self.parameter(name) else {
            return self.unknown_name(name, &name.to_string(), "unknown name");
        };
        let lowered = lowered?;
        let name = name.to_string();
        let mut shape = self.shape_of(field).clone();
        if shape == Shape::Number || shape == Shape::Count {
            return self.refuse(syntax, format!("`{name}` is a single number: it takes no index"));
        }
        for (syntax, index) in indices.iter().zip(&lowered) {
            shape = match shape {
                Shape::Array(length, entry) => {
                    self.check_range(syntax, index, length, &name)?;
                    *entry
                }
                Shape::Unknown => Shape::Unknown,
                _ => return self.refuse(syntax, format!("this is one index too many for `{name}`")),
            };
        }
        match shape {
            Shape::Array(Some(length), entry) if are_components(length, &entry) => {
                Some(self.vector_parameter(field, length, &lowered))
            }
            Shape::Array(..) => {
                let message = format!("the entries of `{name}` are arrays: write one index more");
                self.refuse(syntax, message)
            }
            Shape::Other => self.errors.refuse_once(
                &format!("field {name}"),
                syntax,
                format!("the entries of `{name}` are not numbers"),
            ),
            _ => Some(self.entry_node(field, lowered).into()),
        }
    }

    /// `r[i]` and `r[i][k]` of an array of vectors that begins with this block.
    fn indexed_vector(
        &mut self,
        syntax: &Syntax,
        first: usize,
        axis: Axis,
        indices: &[&Syntax],
    ) -> Option<Value> {
        let name = self.model.blocks[first].name.to_string();
        if let [_, _, ..] = &indices[1..] {
            return self
                .refuse(syntax, format!("`{name}` takes two indices: the second is that of a component"));
        }
        let index = self.coordinate_index(first, indices[0]);
        if self.model.blocks[first].is_spinor() {
            let vector = self.unit_vector(first, &index?);
            return match indices.get(1) {
                Some(component) => {
                    let place = self.axis(component, vector.entries().len(), &format!("{name}[i]"))?;
                    Some(vector.entries()[place].into())
                }
                None => Some(vector),
            };
        }
        let component = indices.get(1).map(|component| self.axis(component, axis.of, &format!("{name}[i]")));
        match component {
            Some(component) => {
                let block = first + component?;
                Some(self.coordinate_node(block, index?).into())
            }
            None => {
                let index = index?;
                let components =
                    (0..axis.of).map(|number| self.coordinate_node(first + number, index.clone()));
                Some(Value::Vector(components.collect()))
            }
        }
    }

    fn indexed_coordinate(&mut self, syntax: &Syntax, block: usize, indices: &[&Syntax]) -> Option<Expr> {
        let name = self.model.blocks[block].name.to_string();
        if self.model.blocks[block].array.is_none() {
            return self.refuse(syntax, format!("`{name}` is a single coordinate: it takes no index"));
        }
        let index = match (indices, self.model.blocks[block].grid.clone()) {
            ([index], None) => self.coordinate_index(block, index)?,
            ([row, column], Some(Grid { sizes: [rows, length], .. })) => {
                let row = self.index_below(row, &name, &rows);
                let column = self.index_below(column, &format!("{name}[i]"), &length);
                let (row, column) = (row?, column?);
                let is_inside = self.is_inside(&row, &[rows]) && self.is_inside(&column, &[length]);
                let place = self.model.blocks[block].place(&[row, column]);
                if is_inside { place } else { self.tied_to_loops(place) }
            }
            (_, grid) => return self.number_of_indices(syntax, &name, grid.is_some(), indices.len()),
        };
        Some(self.coordinate_node(block, index))
    }

    /// Reports another number of indices than that of an array of numbers.
    fn number_of_indices<T>(&mut self, at: &Syntax, name: &str, is_grid: bool, found: usize) -> Option<T> {
        // What was declared may be another array.
        if self.model.lost_coordinates {
            return None;
        }
        let message = match (is_grid, found) {
            (false, _) => format!("`{name}` takes one index"),
            (true, 1) => format!(
                "`{name}` takes two indices: write `{name}[i][j]`; rows that are vectors have a literal for \
                 their length, as \
                 `{name}[n][3]`"
            ),
            (true, _) => format!("`{name}` takes two indices; {}", here(found)),
        };
        self.refuse(at, message)
    }

    pub(super) fn coordinate_index(&mut self, block: usize, syntax: &Syntax) -> Option<Index> {
        let (size, name) = (self.model.block_size(block), self.model.blocks[block].name.to_string());
        let index = self.index_below(syntax, &name, &size)?;
        Some(self.tied(index, &[size]))
    }

    /// An index of an array of coordinates of this size.
    fn index_below(&mut self, syntax: &Syntax, name: &str, size: &Index) -> Option<Index> {
        let index = self.index(syntax)?;
        let literal = size.as_literal().filter(|_| !self.model.lost_coordinates);
        self.check_range(syntax, &index, literal, name)?;
        Some(index)
    }

    /// An entry of a parameter.
    fn entry_node(&mut self, field: u32, indices: Vec<Index>) -> Expr {
        let indices = indices.into_iter().enumerate().map(|(level, index)| {
            let lengths = self.model.lengths(field, level);
            self.tied(index, &lengths)
        });
        let indices = indices.collect();
        self.parameter_node(field, indices)
    }
}

fn product(number: &str, listed: &str) -> String {
    let written = if listed.is_empty() { number.to_string() } else { format!("{number} * ({listed})") };
    format!("`{number}` is a number, it is no function: a product is written `{written}`")
}
