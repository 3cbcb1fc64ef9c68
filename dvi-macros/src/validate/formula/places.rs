//! Places of the text: coordinates, entries of parameters, and components of vectors.

use std::rc::Rc;

use syn::Expr;

use super::super::jet::Jet;
use super::super::point::Variable;
use super::{Evaluation, NoValue, Quantity, Value, place_text, unknown};
use crate::internal::internal;
use crate::model::Shape;

impl Evaluation<'_> {
    /// A coordinate, an entry of a parameter, or a component of another vector.
    pub(super) fn entry(&mut self, syntax: &Expr) -> Value<Quantity> {
        if let Some((name, indices)) = self.place(syntax)? {
            return self.at_place(Variable::Position, syntax, &name, &indices);
        }
        let Expr::Index(index) = syntax else { unknown(syntax) };
        let (vector, component) = (self.quantity(&index.expr)?, self.index(&index.index)?);
        Ok(Quantity::Number(vector.component(component).unwrap_or_else(|| unknown(syntax))))
    }

    /// What stands at a place: the kind of thing that `d(·)` may stand around.
    pub(super) fn at_place(
        &self,
        kind: Variable,
        syntax: &Expr,
        name: &str,
        indices: &[i64],
    ) -> Value<Quantity> {
        let Some(block) = self.block(name) else {
            let Some(name) = self.parameter(name) else { unknown(syntax) };
            if indices.iter().any(|index| *index < 0) {
                return Err(NoValue::OutOfRange);
            }
            let entry = |indices: &[i64]| Jet::number(self.point.parameter(name, indices));
            return Ok(match self.parameter_components(name, indices.len()) {
                Some(count) => {
                    let component = |component| entry(&[indices, &[component]].concat());
                    Quantity::Vector((0..count).map(component).collect())
                }
                None => Quantity::Number(entry(indices)),
            });
        };
        if self.model.blocks[block].is_spinor() {
            return self.unit_vector(block, indices).map(|value| value.unwrap_or_else(|| unknown(syntax)));
        }
        let components = self.model.coordinate_at(block);
        let entry = |block, index| self.variable(kind, block, index);
        match (components.len(), indices) {
            (1, []) => match &self.model.blocks[block].array {
                Some(_) => {
                    let entries = (0..self.block_size(block)).map(|index| entry(block, index));
                    Ok(Quantity::Vector(entries.collect::<Result<_, _>>()?))
                }
                None => Ok(Quantity::Number(entry(block, 0)?)),
            },
            (1, _) => Ok(Quantity::Number(entry(block, self.flat(block, indices)?)?)),
            (2.., [index]) => {
                let entries = components.map(|block| entry(block, *index));
                Ok(Quantity::Vector(entries.collect::<Result<_, _>>()?))
            }
            (2.., [index, component]) => {
                let Some(block) =
                    usize::try_from(*component).ok().and_then(|number| components.clone().nth(number))
                else {
                    unknown(syntax)
                };
                Ok(Quantity::Number(entry(block, *index)?))
            }
            _ => unknown(syntax),
        }
    }

    /// The place of an entry in its block: the index, or of two the first times the length of the rows plus
    /// the second, which stays below that length.
    pub(super) fn flat(&self, block: usize, indices: &[i64]) -> Value<i64> {
        let length = self.model.blocks[block].row_length().map(|length| self.length(length));
        match (indices, length) {
            ([index], None) => Ok(*index),
            ([row, column], Some(length)) if (0..length).contains(column) => Ok(row * length + column),
            ([_, _], Some(_)) => Err(NoValue::OutOfRange),
            _ => internal("another number of indices"),
        }
    }

    /// The name of `x`, `self.x`, `x[i]`, `x[i][j]`, with its indices, if it is no name of an inner scope.
    pub(super) fn place(&mut self, syntax: &Expr) -> Value<Option<(Rc<str>, Vec<i64>)>> {
        match syntax {
            Expr::Path(_) | Expr::Field(_) => {
                let name = self.texts.of(syntax, || place_text(syntax));
                let is_place = matches!(syntax, Expr::Field(_)) || self.bound(&name).is_none();
                Ok(is_place.then_some((name, Vec::new())))
            }
            Expr::Index(index) => {
                let Some((name, mut indices)) = self.place(&index.expr)? else { return Ok(None) };
                indices.push(self.index(&index.index)?);
                Ok(Some((name, indices)))
            }
            Expr::Paren(inner) => self.place(&inner.expr),
            _ => Ok(None),
        }
    }

    pub(super) fn variable(&self, kind: Variable, block: usize, index: i64) -> Value<Jet> {
        if !(0..self.block_size(block)).contains(&index) {
            return Err(NoValue::OutOfRange);
        }
        if kind == Variable::Velocity && self.is_still {
            return Ok(Jet::number(0.0));
        }
        let value = self.point.variable(kind, block, index);
        let a = self.point.direction(self.directions.first, false, block, index);
        let b = self.point.direction(self.directions.second, true, block, index);
        Ok(match kind {
            Variable::Position => {
                let a = if self.follows { self.point.variable(Variable::Velocity, block, index) } else { a };
                let position = Jet::variable(value, [a, 0.0, 0.0, 0.0], [b, 0.0]);
                if self.moves {
                    position.moving(self.variable(Variable::Velocity, block, index)?)
                } else {
                    position
                }
            }
            Variable::Velocity => Jet::variable(value, [0.0, a, 0.0, value], [0.0, b]),
        })
    }

    /// How many components a parameter has behind so many indices, if it is a vector there.
    fn parameter_components(&self, name: &str, indices: usize) -> Option<i64> {
        let parameter = self.model.parameters.iter().find(|parameter| parameter.text == name)?;
        let mut shape = &parameter.shape;
        for _ in 0..indices {
            match shape {
                Shape::Array(_, entry) => shape = entry,
                _ => return None,
            }
        }
        match shape {
            Shape::Array(length, _) => *length,
            _ => None,
        }
    }
}
