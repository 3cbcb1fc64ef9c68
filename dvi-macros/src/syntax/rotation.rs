//! Rotations and unit vectors as coordinates: where they may stand, and how a rotation is written.
//!
//! Of `R: SO3` formulas have the entries `R[j][k]`, the axes of the body `R.column(k)`, and the angular
//! velocity in the body `omega(R)`, both vectors, and of an array `R[n]: SO3` the same of each `R[i]`. Nine
//! coordinates `R[3 j + k]` or `R[i][3 j + k]` and three velocities take their places here, once, so that no
//! later stage knows of matrices.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{ToTokens, quote};
use syn::spanned::Spanned;
use syn::visit_mut::{self, VisitMut};
use syn::{Block, Expr, ExprClosure, Local, Pat, parse_quote_spanned};

use super::{Attribute, Constrained, Declaration, Factor, Kind, bound, ident, literal};
use crate::errors::{Errors, text};

/// The angular velocity of a rotation, in the body.
const ANGULAR_VELOCITY: &str = "omega";
/// The velocity of another coordinate.
const VELOCITY: &str = "dot";

impl Attribute {
    /// Reports rotations and unit vectors where there are none, and replaces the entries of rotations in all
    /// formulas.
    pub(super) fn admit_factors(&mut self, errors: &mut Errors) {
        let is_regular = self.kind == Kind::Regular;
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
        } else {
            let force = (!self.forces.is_empty()).then_some("force");
            let acting = force.or(self.dissipation.as_ref().map(|_| "dissipation"));
            self.constrained.map(|of| of.words().word).or(acting).map(|word| {
                let (what, size, constraints, angles) = match first.factor {
                    Factor::Rotation => ("a rotation", 9, "six constraints", "three"),
                    Factor::Sphere | Factor::Line => {
                        ("a unit vector", 3, "its length as a constraint", "two")
                    }
                };
                let numbers = match self.constrained {
                    Some(Constrained::Gaps) => format!("{angles} angles"),
                    Some(Constrained::Velocities) => format!(
                        "`{first}[{size}]`, with {constraints}, of which the rate of change is declared by \
                         `{word} = …` too"
                    ),
                    Some(Constrained::Positions) | None => format!("`{first}[{size}]`, with {constraints}"),
                };
                format!(
                    "a system with rotations or unit vectors has no `{word}` yet: {what} as numbers is \
                     {numbers}"
                )
            })
        };
        if let Some(message) = refused {
            errors.push(name, message);
        }
        let known = |declared: &Declaration| (declared.name.clone(), Known::of(declared));
        let coordinates: Vec<(Ident, Known)> = self.coordinates.iter().map(known).collect();
        let mut entries = Entries { coordinates: &coordinates, hidden: Vec::new(), errors };
        self.formulas_mut().for_each(|formula| entries.visit_expr_mut(formula));
    }
}

/// What is known of a coordinate.
#[derive(Clone, Copy, PartialEq)]
enum Known {
    Rotation,
    Rotations,
    Other,
}

impl Known {
    fn of(Declaration { size, factor, .. }: &Declaration) -> Self {
        match (factor, size) {
            (Factor::Rotation, None) => Self::Rotation,
            (Factor::Rotation, Some(_)) => Self::Rotations,
            (Factor::Line | Factor::Sphere, _) => Self::Other,
        }
    }
}

/// Replaces what is written of rotations by coordinates and velocities. What cannot be is reported, and
/// replaced by nothing, of which nothing is reported.
struct Entries<'a> {
    coordinates: &'a [(Ident, Known)],
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

/// The name that an expression is, in parentheses or not.
fn name(syntax: &Expr) -> Option<&Ident> {
    ident(unwrapped(syntax))
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

/// A rotation of a formula: `R`, or `R[i]` of an array.
#[derive(Clone, Copy)]
struct Rotation<'a> {
    name: &'a Ident,
    index: Option<&'a Expr>,
}

impl ToTokens for Rotation<'_> {
    fn to_tokens(&self, tokens: &mut TokenStream) {
        let Self { name, index } = self;
        let index = index.map(|index| quote!([#index]));
        tokens.extend(quote!(#name #index));
    }
}

impl Entries<'_> {
    /// What is known of a coordinate of this name.
    fn coordinate(&self, name: &Ident) -> Option<Known> {
        let (_, known) = self.coordinates.iter().find(|(known, _)| known == name)?;
        (!self.hidden.contains(name)).then_some(*known)
    }

    /// The rotation that this is.
    fn rotation<'b>(&self, syntax: &'b Expr) -> Option<Rotation<'b>> {
        let (of, index) = indexed(syntax).map_or((syntax, None), |[of, index]| (of, Some(index)));
        let name = name(of)?;
        let written = if index.is_some() { Known::Rotations } else { Known::Rotation };
        (self.coordinate(name)? == written).then_some(Rotation { name, index })
    }

    /// The array of rotations that this is the name of.
    fn array<'b>(&self, syntax: &'b Expr) -> Option<&'b Ident> {
        name(syntax).filter(|name| self.coordinate(name) == Some(Known::Rotations))
    }

    /// The rotation that this is the angular velocity of.
    fn angular_velocity<'b>(&self, syntax: &'b Expr) -> Option<Rotation<'b>> {
        match called(ANGULAR_VELOCITY, syntax)?.as_slice() {
            [of] => self.rotation(of),
            _ => None,
        }
    }

    /// The rotation that this is an entry of, with its indices.
    fn entry<'b>(&self, syntax: &'b Expr) -> Option<(Rotation<'b>, [&'b Expr; 2])> {
        let [row_of, column] = indexed(syntax)?;
        let [rotation, row] = indexed(row_of)?;
        Some((self.rotation(rotation)?, [row, column]))
    }

    /// The rotation that this is a column of, with its index.
    fn column<'b>(&self, syntax: &'b Expr) -> Option<(Rotation<'b>, &'b Expr)> {
        match unwrapped(syntax) {
            Expr::MethodCall(call) if call.method == "column" && call.args.len() == 1 => {
                Some((self.rotation(&call.receiver)?, &call.args[0]))
            }
            _ => None,
        }
    }

    /// An index of a matrix or vector of three; 0 where it is reported as none.
    fn index(&mut self, syntax: &Expr) -> usize {
        let value = literal(syntax).filter(|value| *value < 3);
        value.map_or_else(
            || {
                let message = "an index of a rotation or of its angular velocity is 0, 1 or 2, as a literal";
                self.errors.push(syntax, message);
                0
            },
            |value| value as usize,
        )
    }

    /// What takes the place of this, if that is written of a rotation.
    fn replaced(&mut self, syntax: &Expr) -> Option<Expr> {
        let span = syntax.span();
        if let Some((of, [row, column])) = self.entry(syntax) {
            let entry = Literal::usize_unsuffixed(3 * self.index(row) + self.index(column));
            return Some(parse_quote_spanned!(span=> #of[#entry]));
        }
        if let Some([inner, index]) = indexed(syntax) {
            if let Some(of) = self.angular_velocity(inner) {
                let index = Literal::usize_unsuffixed(self.index(index));
                return Some(parse_quote_spanned!(span=> dot(#of[#index])));
            }
            if let Some((of, _)) = self.entry(inner) {
                let of = text(&of);
                return Some(
                    self.refused(syntax, format!("an entry of `{of}` has two indices, `{of}[j][k]`")),
                );
            }
            if let Some(of) = self.rotation(inner) {
                return Some(self.refused(inner, is_whole(of)));
            }
        }
        if let Some((of, column)) = self.column(syntax) {
            let column = self.index(column);
            let [x, y, z] = [column, 3 + column, 6 + column].map(Literal::usize_unsuffixed);
            return Some(parse_quote_spanned!(span=> [#of[#x], #of[#y], #of[#z]]));
        }
        if let Some(of) = self.angular_velocity(syntax) {
            return Some(parse_quote_spanned!(span=> [dot(#of[0]), dot(#of[1]), dot(#of[2])]));
        }
        if let Some([inner]) = called(VELOCITY, syntax).as_deref()
            && let Some((of, _)) = self.entry(inner)
        {
            let of = text(&of);
            let message = format!(
                "the velocity of a rotation is `{ANGULAR_VELOCITY}({of})[k]`, the angular velocity in the body; the rates of its \
                 entries are products with it, as `{of}[0][1] * {ANGULAR_VELOCITY}({of})[2] - {of}[0][2] * {ANGULAR_VELOCITY}({of})[1]` \
                 is that of `{of}[0][0]`"
            );
            return Some(self.refused(inner, message));
        }
        let (at, message) = self.no_rotation(syntax).or_else(|| self.whole(syntax))?;
        Some(self.refused(at, message))
    }

    /// What is wrong with `omega(x)` or `omega(x)[k]` of another coordinate.
    fn no_rotation<'b>(&self, syntax: &'b Expr) -> Option<(&'b Expr, String)> {
        let whole = indexed(syntax).map_or(syntax, |[of, _]| of);
        let [of] = *called(ANGULAR_VELOCITY, whole)?.as_slice() else { return None };
        let name = name(indexed(of).map_or(of, |[array, _]| array))?;
        let of = text(of);
        let message =
            format!("`{of}` is no rotation, of which `{ANGULAR_VELOCITY}` is the angular velocity");
        (self.coordinate(name)? == Known::Other).then_some((syntax, message))
    }

    /// A rotation as a whole, or an array of them without an index: this, or what this is made of, and what
    /// is wrong with it.
    fn whole<'b>(&self, syntax: &'b Expr) -> Option<(&'b Expr, String)> {
        let used = |part: &'b Expr| {
            let of_array = |name: &Ident| format!("`{name}` is an array of rotations: write `{name}[i]`");
            let message = self.rotation(part).map(is_whole).or_else(|| self.array(part).map(of_array));
            message.map(|message| (part, message))
        };
        used(syntax).or_else(|| match unwrapped(syntax) {
            Expr::Call(call) => call.args.iter().find_map(used),
            Expr::MethodCall(call) => used(&call.receiver),
            Expr::Index(index) => used(&index.index),
            _ => None,
        })
    }

    fn hide(&mut self, pattern: &Pat) {
        self.hidden.extend(bound(pattern).into_iter().cloned());
    }

    fn refused(&mut self, at: &Expr, message: String) -> Expr {
        self.errors.push(at, message);
        Expr::Verbatim(TokenStream::new())
    }
}

/// What is said of a rotation as a whole.
fn is_whole(of: Rotation<'_>) -> String {
    let of = text(&of);
    format!(
        "`{of}` is a rotation: its entries are written `{of}[j][k]`, its angular velocity in the body \
         `{ANGULAR_VELOCITY}({of})[k]`"
    )
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
