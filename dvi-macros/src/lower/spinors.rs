//! Unit vectors of degenerate systems: s = z†σz of a spinor z, and the one-form of area.
//!
//! With z = (a + ib, c + id), s = (2(ac + bd), 2(ad − bc), a² + b² − c² − d²) is the Hopf map. The one-form
//! A = 2 (a db − b da + c dd − d dc) on the sphere |z| = 1 is one on the unit vectors but for the phase of z,
//! which no formula sees, and dA is their area element. So κ A − H dt makes κ ṡ = s × ∂H/∂s.

use syn::{Expr as Syntax, ExprCall};

use super::{Lowering, Value};
use crate::errors::{here, text};
use crate::model::SPINOR;
use crate::symbolic::{Coordinate, Expr, Graph, Id, Index, Node};
use crate::syntax::ident;
use crate::words::AREA;

impl Lowering<'_> {
    /// The unit vector at an index.
    pub(super) fn unit_vector(&mut self, first: usize, index: &Index) -> Value {
        let [a, b, c, d] = self.spinor(first, index, Node::Coordinate);
        let graph = &mut *self.graph;
        let mut two = |[a, b]: [Expr; 2], [c, d]: [Expr; 2]| {
            let products = [graph.multiply(a, b), graph.multiply(c, d)];
            graph.sum(&products).scaled(2.0)
        };
        let (x, y) = (two([a, c], [b, d]), two([a, d], [b.negated(), c]));
        let squares = [a, b, c, d].map(|part| self.graph.powi(part, 2));
        let [up, down] =
            [[squares[0], squares[1]], [squares[2], squares[3]]].map(|half| self.graph.sum(&half));
        Value::Vector(vec![x, y, self.graph.subtract(up, down)])
    }

    fn spinor(&mut self, first: usize, index: &Index, of: fn(Coordinate) -> Node) -> [Expr; SPINOR] {
        std::array::from_fn(|number| {
            let block = (first + number) as u32;
            self.graph.intern(of(Coordinate { block, index: index.clone() })).into()
        })
    }

    /// `area(s)`
    pub(super) fn area(&mut self, call: &ExprCall) -> Option<Value> {
        if let Err(reason) = self.velocity_word() {
            return self.refuse(call, reason);
        }
        let [of] = call.args.iter().collect::<Vec<_>>()[..] else {
            let message = format!("`{AREA}` takes one unit vector; {}", here(call.args.len()));
            return self.refuse(&call.func, message);
        };
        let (first, index) = self.place_of_spinor(of)?;
        let [a, b, c, d] = self.spinor(first, &index, Node::Coordinate);
        let [da, db, dc, dd] = self.spinor(first, &index, Node::Velocity);
        let terms = [(a, db), (b.negated(), da), (c, dd), (d.negated(), dc)];
        let terms = terms.map(|(part, rate)| self.graph.multiply(part, rate));
        Some(Value::Number(self.graph.sum(&terms).scaled(2.0)))
    }

    /// The first block and the index of `s` and `s[i]`.
    fn place_of_spinor(&mut self, of: &Syntax) -> Option<(usize, Index)> {
        let (name, index) = match of {
            Syntax::Paren(inner) => return self.place_of_spinor(&inner.expr),
            Syntax::Index(index) => (&*index.expr, Some(&*index.index)),
            other => (other, None),
        };
        let ident = ident(name).filter(|name| self.binding_of(&name.to_string()).is_none());
        let first = ident.and_then(|name| self.model.coordinate_of(name)).map(|blocks| blocks.start);
        let first = first.filter(|&first| self.model.blocks[first].is_spinor());
        match (first, index) {
            (Some(first), Some(index)) if self.model.blocks[first].array.is_some() => {
                Some((first, self.coordinate_index(first, index)?))
            }
            (Some(first), None) if self.model.blocks[first].array.is_none() => {
                Some((first, Index::literal(0)))
            }
            (Some(first), _) => {
                let name = self.model.blocks[first].label();
                let message = format!("`{AREA}` takes a unit vector as a whole: write `{AREA}({name})`");
                self.refuse(of, message)
            }
            (None, _) => {
                let names = self.model.blocks.iter().filter(|block| block.is_spinor());
                let name = names.map(|block| block.label()).next().unwrap_or_else(|| "s".to_string());
                let message = format!(
                    "`{AREA}` takes a unit vector, as in `{AREA}({name})`, and `{}` is none: the differential of a number is \
                     `d(x)`",
                    text(of)
                );
                self.refuse(of, message)
            }
        }
    }

    /// Reports a factor of an area that is not constant: `at` is what `factor` was written as.
    pub(super) fn check_strength(&mut self, area: Expr, (at, factor): (&Syntax, Expr)) -> Option<()> {
        if !self.model.has_spinors()
            || !has_area(self.graph, self.model, area.node)
            || is_constant(self.graph, factor.node)
        {
            return Some(());
        }
        self.refuse(at, STRENGTH)
    }
}

/// What is said of a factor of an area that is not constant.
pub(crate) const STRENGTH: &str = "the factor of an area is a constant, the strength of a vortex or the length of a spin: with coordinates or the \
                        time in it the lengths of unit vectors would not be kept";

fn has_area(graph: &Graph, model: &crate::model::Model, id: Id) -> bool {
    graph.depends(
        id,
        |node| matches!(node, Node::Velocity(of) if model.blocks[of.block as usize].is_spinor()),
    )
}

/// Whether neither coordinates nor the time stand in an expression.
pub(crate) fn is_constant(graph: &Graph, id: Id) -> bool {
    !graph.depends(id, |node| node.is_position() || node.is_time())
}
