//! Rotations and unit vectors as coordinates: where they may stand, and how a rotation is written.
//!
//! Of `R: SO3` formulas have the entries `R[i][j]`, the axes of the body `R.column(j)`, and the angular
//! velocity in the body `omega(R)`, both vectors. Nine coordinates `R[3 i + j]` and three velocities take
//! their places here, once, so that no later stage knows of matrices.

use proc_macro2::{Ident, Literal};
use syn::spanned::Spanned;
use syn::visit_mut::{self, VisitMut};
use syn::{Block, Expr, ExprClosure, Lit, Local, Pat, parse_quote_spanned};

use super::declared::no_array;
use super::{Attribute, Declaration, Factor, Kind};
use crate::errors::Errors;

/// The angular velocity of a rotation, in the body.
const ANGULAR_VELOCITY: &str = "omega";
/// The velocity of another coordinate.
const VELOCITY: &str = "dot";

impl Attribute {
    /// Reports rotations and unit vectors where there are none, and replaces the entries of rotations in all
    /// formulas.
    pub(super) fn admit_factors(&mut self, errors: &mut Errors) {
        let is_array = |of: &&Declaration| of.factor == Factor::Sphere && of.size.is_some();
        let is_regular = self.kind == Kind::Regular;
        for Declaration { name, .. } in self.coordinates.iter().filter(is_array).filter(|_| is_regular) {
            errors.push(name, no_array(name, "S2"));
            self.lost_coordinates = true;
        }
        let is_special = |declaration: &&Declaration| match declaration.factor {
            Factor::Line => false,
            Factor::Rotation => true,
            Factor::Sphere => is_regular,
        };
        let Some(first) = self.coordinates.iter().find(is_special) else { return };
        let name = &first.name;
        let refused = if !is_regular {
            let regular = Kind::Regular.attribute();
            Some(format!("rotations are coordinates of regular systems, in `{regular}`"))
        } else if let Some(of) = self.constrained {
            let numbers = match first.factor {
                Factor::Rotation => format!("a rotation as numbers is `{name}[9]`, with six constraints"),
                Factor::Sphere | Factor::Line => {
                    format!("a unit vector as numbers is `{name}[3]`, with its length as a constraint")
                }
            };
            Some(format!("a system with rotations or unit vectors has no `{}` yet: {numbers}", of.word()))
        } else if !self.forces.is_empty() {
            Some("a system with rotations or unit vectors has no forces yet: leave `force` out".to_string())
        } else {
            None
        };
        if let Some(message) = refused {
            errors.push(name, message);
        }
        let rotations = self.coordinates.iter().filter(|declaration| declaration.factor == Factor::Rotation);
        let rotations: Vec<Ident> = rotations.map(|Declaration { name, .. }| name.clone()).collect();
        let others = self.coordinates.iter().filter(|declaration| declaration.factor != Factor::Rotation);
        let others: Vec<Ident> = others.map(|Declaration { name, .. }| name.clone()).collect();
        let mut entries = Entries { rotations: &rotations, others: &others, hidden: Vec::new(), errors };
        self.formulas_mut().for_each(|formula| entries.visit_expr_mut(formula));
    }
}

/// Replaces what is written of rotations by coordinates and velocities. What cannot be is reported, and
/// replaced by a number, so that it is not reported again.
struct Entries<'a> {
    rotations: &'a [Ident],
    /// The other coordinates.
    others: &'a [Ident],
    /// The names that a `let` or a closure around has given to something else.
    hidden: Vec<Ident>,
    errors: &'a mut Errors,
}

/// An expression without the parentheses around it.
pub(super) fn unwrapped(syntax: &Expr) -> &Expr {
    match syntax {
        Expr::Paren(inner) => unwrapped(&inner.expr),
        other => other,
    }
}

/// The name that an expression is.
fn name(syntax: &Expr) -> Option<&Ident> {
    match unwrapped(syntax) {
        Expr::Path(path) => path.path.get_ident(),
        _ => None,
    }
}

/// The arguments of a call of `function`.
fn called<'a>(function: &str, syntax: &'a Expr) -> Option<Vec<&'a Expr>> {
    match unwrapped(syntax) {
        Expr::Call(call) if name(&call.func).is_some_and(|name| name == function) => {
            Some(call.args.iter().collect())
        }
        _ => None,
    }
}

/// What an index is taken of, and the index.
fn indexed(syntax: &Expr) -> Option<[&Expr; 2]> {
    match unwrapped(syntax) {
        Expr::Index(index) => Some([&index.expr, &index.index]),
        _ => None,
    }
}

impl Entries<'_> {
    /// The rotation that this is the name of.
    fn rotation<'b>(&self, syntax: &'b Expr) -> Option<&'b Ident> {
        name(syntax).filter(|name| self.rotations.contains(name) && !self.hidden.contains(name))
    }

    /// The rotation that this is the angular velocity of.
    fn angular_velocity<'b>(&self, syntax: &'b Expr) -> Option<&'b Ident> {
        match called(ANGULAR_VELOCITY, syntax)?.as_slice() {
            [of] => self.rotation(of),
            _ => None,
        }
    }

    /// The rotation that this is an entry of, with its indices.
    fn entry<'b>(&self, syntax: &'b Expr) -> Option<(&'b Ident, [&'b Expr; 2])> {
        let [row_of, column] = indexed(syntax)?;
        let [rotation, row] = indexed(row_of)?;
        Some((self.rotation(rotation)?, [row, column]))
    }

    /// The rotation that this is a column of, with its index.
    fn column<'b>(&self, syntax: &'b Expr) -> Option<(&'b Ident, &'b Expr)> {
        match unwrapped(syntax) {
            Expr::MethodCall(call) if call.method == "column" && call.args.len() == 1 => {
                Some((self.rotation(&call.receiver)?, &call.args[0]))
            }
            _ => None,
        }
    }

    /// An index of a matrix or vector of three; 0 where it is reported as none.
    fn index(&mut self, syntax: &Expr) -> usize {
        let value = match unwrapped(syntax) {
            Expr::Lit(literal) => match &literal.lit {
                Lit::Int(value) => value.base10_parse().ok(),
                _ => None,
            },
            _ => None,
        };
        value.filter(|value| *value < 3).unwrap_or_else(|| {
            let message = "an index of a rotation or of its angular velocity is 0, 1 or 2, as a literal";
            self.errors.push(syntax, message);
            0
        })
    }

    /// What takes the place of this, if that is written of a rotation.
    fn replaced(&mut self, syntax: &Expr) -> Option<Expr> {
        let span = syntax.span();
        if let Some((name, [row, column])) = self.entry(syntax) {
            let entry = Literal::usize_unsuffixed(3 * self.index(row) + self.index(column));
            return Some(parse_quote_spanned!(span=> #name[#entry]));
        }
        if let Some([of, index]) = indexed(syntax) {
            if let Some(name) = self.angular_velocity(of) {
                let index = Literal::usize_unsuffixed(self.index(index));
                return Some(parse_quote_spanned!(span=> dot(#name[#index])));
            }
            if let Some((name, _)) = self.entry(of) {
                self.errors.push(syntax, format!("an entry of `{name}` has two indices, `{name}[i][j]`"));
                return Some(parse_quote_spanned!(span=> 0.0));
            }
            if let Some(name) = self.rotation(of) {
                return Some(self.refused(of, name));
            }
        }
        if let Some((name, column)) = self.column(syntax) {
            let column = self.index(column);
            let [x, y, z] = [column, 3 + column, 6 + column].map(Literal::usize_unsuffixed);
            return Some(parse_quote_spanned!(span=> [#name[#x], #name[#y], #name[#z]]));
        }
        if let Some(name) = self.angular_velocity(syntax) {
            return Some(parse_quote_spanned!(span=> [dot(#name[0]), dot(#name[1]), dot(#name[2])]));
        }
        if let Some([of]) = called(VELOCITY, syntax).as_deref()
            && let Some((name, _)) = self.entry(of)
        {
            let message = format!(
                "the velocity of a rotation is `{ANGULAR_VELOCITY}({name})[k]`, the angular velocity in the body; the rates of its \
                 entries are products with it, as `{name}[0][1] * {ANGULAR_VELOCITY}({name})[2] - {name}[0][2] * {ANGULAR_VELOCITY}({name})[1]` \
                 is that of `{name}[0][0]`"
            );
            self.errors.push(of, message);
            return Some(parse_quote_spanned!(span=> 0.0));
        }
        if let Some(of) = self.no_rotation(syntax) {
            let message =
                format!("`{of}` is no rotation, of which `{ANGULAR_VELOCITY}` is the angular velocity");
            self.errors.push(syntax, message);
            return Some(parse_quote_spanned!(span=> 0.0));
        }
        let (at, name) = self.whole(syntax)?;
        Some(self.refused(at, name))
    }

    /// The coordinate that is taken for a rotation in `omega(x)` or `omega(x)[k]`.
    fn no_rotation<'b>(&self, syntax: &'b Expr) -> Option<&'b Ident> {
        let whole = indexed(syntax).map_or(syntax, |[of, _]| of);
        match called(ANGULAR_VELOCITY, whole)?.as_slice() {
            [of] => name(of).filter(|name| self.others.contains(name) && !self.hidden.contains(name)),
            _ => None,
        }
    }

    /// A rotation that has no index: this, or what this is made of.
    fn whole<'b>(&self, syntax: &'b Expr) -> Option<(&'b Expr, &'b Ident)> {
        if let Some(name) = self.rotation(syntax) {
            return Some((syntax, name));
        }
        let used = |part: &'b Expr| self.rotation(part).map(|name| (part, name));
        match unwrapped(syntax) {
            Expr::Call(call) => call.args.iter().find_map(used),
            Expr::MethodCall(call) => used(&call.receiver),
            Expr::Index(index) => used(&index.index),
            _ => None,
        }
    }

    fn hide(&mut self, pattern: &Pat) {
        match pattern {
            Pat::Ident(name) => self.hidden.push(name.ident.clone()),
            Pat::Type(typed) => self.hide(&typed.pat),
            Pat::Tuple(names) => names.elems.iter().for_each(|name| self.hide(name)),
            // Refused where formulas are read.
            _ => {}
        }
    }

    fn refused(&mut self, at: &Expr, name: &Ident) -> Expr {
        let message = format!(
            "`{name}` is a rotation: its entries are written `{name}[i][j]`, its angular velocity in the body \
             `{ANGULAR_VELOCITY}({name})[k]`"
        );
        self.errors.push(at, message);
        parse_quote_spanned!(at.span()=> 0.0)
    }
}

impl VisitMut for Entries<'_> {
    fn visit_expr_mut(&mut self, syntax: &mut Expr) {
        match self.replaced(syntax) {
            Some(replacement) => *syntax = replacement,
            None => visit_mut::visit_expr_mut(self, syntax),
        }
    }

    fn visit_block_mut(&mut self, block: &mut Block) {
        let outside = self.hidden.len();
        visit_mut::visit_block_mut(self, block);
        self.hidden.truncate(outside);
    }

    /// Its name is hidden from here on, not in its value.
    fn visit_local_mut(&mut self, local: &mut Local) {
        visit_mut::visit_local_mut(self, local);
        self.hide(&local.pat);
    }

    fn visit_expr_closure_mut(&mut self, closure: &mut ExprClosure) {
        let outside = self.hidden.len();
        closure.inputs.iter().for_each(|input| self.hide(input));
        visit_mut::visit_expr_closure_mut(self, closure);
        self.hidden.truncate(outside);
    }
}
