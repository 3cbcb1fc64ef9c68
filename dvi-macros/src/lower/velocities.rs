//! Velocities: `dot(x)`, and `d(x)` of a one-form.

use syn::{Expr as Syntax, ExprCall};

use super::{Lowering, Role, Value};
use crate::errors::{here, text};
use crate::symbolic::{Expr, Node};
use crate::syntax::{Constrained, Kind, ident};
use crate::words::AREA;

impl Lowering<'_> {
    /// `d(x)` in a one-form, `dot(x)` in a Lagrangian.
    pub(super) fn velocity(&mut self, name: &str, call: &ExprCall) -> Option<Value> {
        if let ("dot", [x, y]) = (name, call.args.iter().collect::<Vec<_>>().as_slice()) {
            let [a, b] = [x, y].map(|side| text(*side));
            let meant = match self.quietly(x) {
                Some(Value::Vector(_)) => format!("{a}.dot({b})"),
                Some(Value::Number(_)) | None => format!("sum(0..n, |j| {a}[j] * {b}[j])"),
            };
            let message =
                format!("`dot` is the velocity of one coordinate; a scalar product is written `{meant}`");
            return self.refuse(call, message);
        }
        let wanted = match self.velocity_word() {
            Ok(wanted) => wanted,
            Err(reason) => return self.refuse(call, reason),
        };
        if name != wanted {
            let message = format!("in {} a velocity is written `{wanted}(x)`", self.role.name());
            return self.refuse(&call.func, message);
        }
        if call.args.len() != 1 {
            return self
                .refuse(&call.func, format!("`{name}` takes one coordinate; {}", here(call.args.len())));
        }
        if let Some(name_of) = root(&call.args[0]).filter(|name| self.binding_of(name).is_some()) {
            let message =
                format!("`{name}` takes a coordinate, and `{name_of}` is a name of this formula here");
            return self.refuse(&call.args[0], message);
        }
        let place = root(&call.args[0]);
        let block =
            self.model.blocks.iter().find(|block| place.as_ref().is_some_and(|name| block.name == name));
        if let Some(block) = block.filter(|block| block.is_spinor()) {
            let message = format!(
                "a unit vector has no `{name}(…)` here: its one-form is that of the area on the sphere, `{AREA}({})`",
                block.label()
            );
            return self.refuse(&call.args[0], message);
        }
        let value = self.value(&call.args[0])?;
        if place.is_none() {
            return self.no_coordinate(name, call);
        }
        value.map(|coordinate| self.velocity_of(name, call, coordinate))
    }

    fn no_coordinate<T>(&mut self, name: &str, call: &ExprCall) -> Option<T> {
        let message = format!("`{name}` takes a coordinate, as in `{name}(x)` or `{name}(x[j])`");
        self.refuse(&call.args[0], message)
    }

    fn velocity_of(&mut self, name: &str, call: &ExprCall, coordinate: Expr) -> Option<Expr> {
        let (true, Node::Coordinate(coordinate)) =
            (coordinate.scale == 1.0, self.graph.node(coordinate.node).clone())
        else {
            return self.no_coordinate(name, call);
        };
        if self.model.extended.is_some_and(|extended| extended.time == coordinate.block as usize) {
            let message = "`t` is the physical time: its velocity is the time transformation";
            return self.refuse(call, message);
        }
        Some(self.graph.intern(Node::Velocity(coordinate)).into())
    }

    /// How a velocity is written in this formula, or why it has none.
    pub(super) fn velocity_word(&self) -> Result<&'static str, String> {
        let reason = match self.role {
            Role::OneForm => return Ok("d"),
            Role::Lagrangian | Role::Dissipation | Role::Constraint(Constrained::Velocities) => {
                return Ok("dot");
            }
            Role::Momentum | Role::Event | Role::Force if self.model.kind == Kind::Regular => {
                return Ok("dot");
            }
            Role::Shared => return Ok(self.shared.velocity),
            Role::Constraint(Constrained::Positions) => {
                "a holonomic constraint has no velocities: it is a function g(q, t) of the positions and the time, and its rate of \
                 change is kept at zero with it; a constraint of the velocities is declared by `nonholonomic = …`"
            }
            Role::Constraint(Constrained::Gaps) => {
                "a gap has no velocities: it is a function g(q, t) of the positions and the time, which no motion makes negative"
            }
            role => {
                let advice = match role {
                    Role::Force => {
                        "so are the velocities of a degenerate system, by the equations of motion; write out the one that is meant"
                    }
                    Role::Component => {
                        "write the one-form as a sum of `… * d(x)`, or its components without `d`"
                    }
                    Role::Hamiltonian => "what is linear in velocities belongs to `one_form`",
                    _ => "no velocity may stand in it",
                };
                return Err(format!("{} is a function of the coordinates: {advice}", role.name()));
            }
        };
        Err(reason.to_string())
    }
}

/// The name in `x` and `x[i]`.
fn root(place: &Syntax) -> Option<String> {
    match place {
        Syntax::Paren(inner) => root(&inner.expr),
        Syntax::Index(index) => root(&index.expr),
        _ => ident(place).map(ToString::to_string),
    }
}
