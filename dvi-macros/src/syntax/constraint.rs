//! Constraints as they are declared: of the positions, g(q, t) = 0, of the velocities, a(q, v, t) = 0, and
//! the gaps of impacts, g(q, t) ≥ 0.

use proc_macro2::Ident;
use quote::ToTokens;
use syn::parse::ParseStream;
use syn::{BinOp, Expr, Lit, Token};

use super::cut::{expression, read_by, value_of};
use super::rotation::unwrapped;
use super::{Attribute, Kind, Value, form_of};
use crate::errors::{Errors, text};

/// What the constraints of a system are functions of; the word of the argument says it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Constrained {
    /// `constraint`: g(q, t) = 0.
    Positions,
    /// `nonholonomic`: a(q, v, t) = A(q, t) v + b(q, t) = 0.
    Velocities,
    /// `impact`: g(q, t) ≥ 0.
    Gaps,
}

/// What is said of one kind of constraints.
#[derive(Debug)]
pub(crate) struct Words {
    /// The word that declares them.
    pub(crate) word: &'static str,
    /// Words that mean it.
    others: &'static [&'static str],
    pub(crate) adjective: &'static str,
    /// What one of them is called, and several.
    pub(crate) nouns: [&'static str; 2],
    /// All of them, with the adjective.
    plural: &'static str,
    /// The function that is zero, or not negative.
    pub(crate) letter: &'static str,
    /// That function of its variables.
    pub(crate) function: &'static str,
    /// What it is to be.
    pub(crate) relation: &'static str,
    /// The generated functions of it: its value, its Jacobian, and its rate.
    pub(crate) generated: [&'static str; 3],
}

/// In the order of the variants.
#[rustfmt::skip]
const WORDS: [Words; 3] = [
    Words {
        word: "constraint",
        others: &["algebraic", "bond", "bonds", "constrain", "constrained", "constraints", "equality", "holonomic", "rod",
            "rods"],
        adjective: "holonomic", nouns: ["constraint", "constraints"], plural: "holonomic constraints",
        letter: "g", function: "g(q, t)", relation: "= 0",
        generated: ["constraint", "constraint_jacobian", "constraint_rate"],
    },
    Words {
        word: "nonholonomic",
        others: &["anholonomic", "no_slip", "non_holonomic", "nonholonomic_constraint", "nonholonomic_constraints",
            "rolling", "slip", "velocity_constraint", "velocity_constraints", "without_slip"],
        adjective: "nonholonomic", nouns: ["constraint", "constraints"], plural: "nonholonomic constraints",
        letter: "a", function: "a(q, v, t)", relation: "= 0",
        generated: ["velocity_constraint", "velocity_constraint_jacobian", "velocity_constraint_rate"],
    },
    Words {
        word: "impact",
        others: &["barrier", "bounce", "boundary", "collision", "collisions", "contact", "floor", "gap", "impacts",
            "inequality", "obstacle", "unilateral", "wall", "walls"],
        adjective: "unilateral", nouns: ["gap function", "gap functions"], plural: "impacts",
        letter: "g", function: "g(q, t)", relation: "≥ 0",
        generated: ["gap", "gap_jacobian", "gap_rate"],
    },
];

/// `constraint = g`, an entry of `constraint = [g, …]`, or `constraint(i in 0..n, j in i + 1..n) = g`; or the
/// same by `nonholonomic` or `impact`.
#[derive(Debug)]
pub(crate) struct Constraint {
    /// The indices of a family, from the outermost; none of a single one.
    pub(crate) family: Vec<Member>,
    pub(crate) formula: Expr,
}

/// `i in 0..n`: an index of a family, which has a constraint for each of its values.
#[derive(Debug)]
pub(crate) struct Member {
    pub(crate) index: Ident,
    pub(crate) range: Expr,
}

impl Constrained {
    const ALL: [Self; 3] = [Self::Positions, Self::Velocities, Self::Gaps];

    pub(crate) fn words(self) -> &'static Words {
        &WORDS[self as usize]
    }

    /// What is constrained by an argument of this name, or of one like it.
    pub(super) fn named_like(name: &str) -> Option<Self> {
        Self::named(name).or_else(|| Self::ALL.into_iter().find(|of| of.words().others.contains(&name)))
    }

    /// What is constrained by an argument of this very name.
    pub(super) fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|of| of.words().word == name)
    }

    /// How a family is written.
    fn family(self) -> String {
        format!("`{}(i in 0..n) = {}(i)`", self.words().word, self.words().letter)
    }

    /// What is said of a family that is not.
    pub(super) fn no_family(self) -> String {
        format!("a family of {} is written {}", self.words().nouns[1], self.family())
    }

    /// How one of two indices is.
    fn family_of_pairs(self) -> String {
        format!("`{}(i in 0..n, j in i + 1..n) = {}(i, j)`", self.words().word, self.words().letter)
    }
}

impl Attribute {
    /// The constraints of an argument whose name says that it declares some.
    pub(super) fn accept_constraints(
        &mut self,
        of: Constrained,
        name: &Ident,
        value: Value,
        errors: &mut Errors,
    ) {
        if self.kind == Kind::Degenerate {
            let reason = match of {
                Constrained::Positions => {
                    "the coordinates of a degenerate one are to be chosen so that they hold"
                }
                Constrained::Velocities => {
                    "the velocities of a degenerate one are what its equations of motion make of the positions"
                }
                Constrained::Gaps => {
                    "a degenerate one has no momentum of its own that could jump at a surface"
                }
            };
            let (what, regular) = (of.words().plural, Kind::Regular.attribute());
            let message = format!("{what} are for regular systems, in `{regular}`: {reason}");
            errors.push_once("constraints", name, message);
            return;
        }
        let Words { word, function, letter, .. } = *of.words();
        let before = *self.constrained.get_or_insert(of);
        if name != word {
            let what = match of {
                Constrained::Positions => "a constraint",
                Constrained::Velocities => "a constraint of the velocities",
                Constrained::Gaps => "a surface of impacts, which the motion does not pass,",
            };
            let message = format!(
                "unknown argument `{name}`; {what} is written `{word} = {function}`, and more of them \
                 `{word} = [{letter}1, {letter}2]`, or {}",
                of.family()
            );
            errors.push(name, message);
            return;
        }
        if before != of {
            let either = "a system has either constraints or impacts";
            let (what, advice) = match (before, of) {
                (Constrained::Gaps, Constrained::Velocities)
                | (Constrained::Velocities, Constrained::Gaps) => (
                    either,
                    "declare the surface by `events(name = g)`, and change the state where it is met",
                ),
                (Constrained::Gaps, _) | (_, Constrained::Gaps) => {
                    (either, "choose the coordinates so that the constraints hold")
                }
                (Constrained::Positions | Constrained::Velocities, _) => (
                    "a system has constraints of one kind",
                    "choose the coordinates so that the constraints of the positions hold, or declare \
                     their rates of change by `nonholonomic = …` too",
                ),
            };
            let message = format!(
                "{what}, and those before this one are declared by `{}`: {advice}",
                before.words().word
            );
            errors.push_once("constraints of two kinds", name, message);
            return;
        }
        match value {
            Value::Assigned(tokens) => {
                if let Some(value) = value_of(name, tokens, errors) {
                    let declared = Constraint::of_value(of, value);
                    self.constraints.extend(declared.into_iter().filter_map(|one| errors.taken(one)));
                }
            }
            Value::AssignedTo { of: index, value, parentheses } => {
                let family = match index.is_empty() {
                    true => Err(syn::Error::new(parentheses, of.no_family())),
                    false => read_by(index, |input| family(input, of)),
                };
                let formula = value_of(name, value, errors);
                if let Some((family, formula)) = errors.taken(family).zip(formula) {
                    let declared = Constraint::of_formula(of, family, formula);
                    self.constraints.extend(errors.taken(declared));
                }
            }
            Value::List(_) | Value::Neither => {
                errors.push(name, format!("`{word}` is written `{}`", form_of(word)));
            }
        }
    }
}

/// `i in 0..n`, or `i in 0..n, j in i + 1..n`.
fn family(input: ParseStream<'_>, of: Constrained) -> syn::Result<Vec<Member>> {
    let mut family: Vec<Member> = vec![Member::parse(input, of)?];
    while !input.is_empty() {
        input.parse::<Token![,]>()?;
        if input.is_empty() {
            break;
        }
        let member = Member::parse(input, of)?;
        if family.len() == 2 {
            let message = format!(
                "a family of {} has two indices at most, {}",
                of.words().nouns[1],
                of.family_of_pairs()
            );
            return Err(syn::Error::new(member.index.span(), message));
        }
        if family[0].index == member.index {
            let message = format!("two indices have this name: write {}", of.family_of_pairs());
            return Err(syn::Error::new(member.index.span(), message));
        }
        family.push(member);
    }
    Ok(family)
}

impl Member {
    fn parse(input: ParseStream<'_>, of: Constrained) -> syn::Result<Self> {
        let (form, Words { word, function, .. }) = (of.family(), of.words());
        let at = input.span();
        let index: Ident = input.parse().map_err(|_| syn::Error::new(at, of.no_family()))?;
        if input.is_empty() {
            let message = format!(
                "a {} is one of the whole system, not of `{index}` alone: write `{word} = {function}`; one for each value of an index \
                 is {form}",
                of.words().nouns[0]
            );
            return Err(syn::Error::new(index.span(), message));
        }
        if !input.peek(Token![in]) {
            return Err(input.error(of.no_family()));
        }
        input.parse::<Token![in]>()?;
        let range = expression(input)?;
        if !input.is_empty() && !input.peek(Token![,]) {
            return Err(input.error(of.no_family()));
        }
        Ok(Self { index, range })
    }
}

impl Constraint {
    /// The constraints of `constraint = …` or `nonholonomic = …`, and what is wrong with the others.
    pub(super) fn of_value(of: Constrained, value: Expr) -> Vec<syn::Result<Self>> {
        match value {
            Expr::Array(list) if list.elems.is_empty() => {
                let Words { word, letter, .. } = of.words();
                let message = format!(
                    "there is no {} in this list: write `{word} = [{letter}1, {letter}2]`, or leave it out",
                    of.words().nouns[0]
                );
                vec![Err(syn::Error::new_spanned(list, message))]
            }
            Expr::Array(list) => {
                list.elems.into_iter().map(|formula| Self::of_formula(of, Vec::new(), formula)).collect()
            }
            formula => vec![Self::of_formula(of, Vec::new(), formula)],
        }
    }

    /// A constraint with this formula, if it may be one.
    pub(super) fn of_formula(of: Constrained, family: Vec<Member>, formula: Expr) -> syn::Result<Self> {
        let refused = |at: &dyn ToTokens, message: String| Err(syn::Error::new_spanned(at, message));
        match unwrapped(&formula) {
            Expr::Assign(equation) => {
                refused(&equation.eq_token, one_side(of, &family, &equation.left, &equation.right))
            }
            Expr::Binary(binary) => match binary.op {
                BinOp::Ge(_) | BinOp::Gt(_) if of == Constrained::Gaps => {
                    refused(&binary.op, one_side(of, &family, &binary.left, &binary.right))
                }
                BinOp::Le(_) | BinOp::Lt(_) if of == Constrained::Gaps => {
                    refused(&binary.op, one_side(of, &family, &binary.right, &binary.left))
                }
                BinOp::Eq(_) => refused(&binary.op, one_side(of, &family, &binary.left, &binary.right)),
                BinOp::Ne(_) if of == Constrained::Gaps => {
                    let message = "of the condition g(q, t) ≥ 0 of a surface, g is written: `impact = g`";
                    refused(&binary.op, message.to_string())
                }
                BinOp::Lt(_) | BinOp::Le(_) | BinOp::Gt(_) | BinOp::Ge(_) | BinOp::Ne(_) => {
                    let message = format!(
                        "a {} constraint is an equation {} = 0, of which {} is written: no inequality is one; that a motion does not \
                         pass a surface is written `impact = g(q, t)`",
                        of.words().adjective,
                        of.words().function,
                        of.words().letter
                    );
                    refused(&binary.op, message)
                }
                _ => Ok(Self { family, formula }),
            },
            Expr::Closure(closure) => refused(
                closure,
                format!("one {} for each value of an index is written {}", of.words().nouns[0], of.family()),
            ),
            Expr::Array(list) => {
                let (what, message) = match family.as_slice() {
                    [] => ("list", "holds formulas: write them without these brackets"),
                    [..] => ("family", "has one formula: write a family for each of these"),
                };
                refused(list, format!("a {what} of {} {message}", of.words().nouns[1]))
            }
            _ => Ok(Self { family, formula }),
        }
    }
}

/// What to write for the equation left = right.
fn one_side(of: Constrained, family: &[Member], left: &Expr, right: &Expr) -> String {
    let members = family.iter().map(|Member { index, range }| format!("{index} in {}", text(range)));
    let head = match members.collect::<Vec<_>>().join(", ") {
        none if none.is_empty() => of.words().word.to_string(),
        members => format!("{}({members})", of.words().word),
    };
    let left = text(left);
    let all = match right {
        right if is_zero(right) => left,
        Expr::Binary(sum) if matches!(sum.op, BinOp::Add(_) | BinOp::Sub(_)) => {
            format!("{left} - ({})", text(right))
        }
        right => format!("{left} - {}", text(right)),
    };
    let Words { function, letter, relation, .. } = of.words();
    let what = match of {
        Constrained::Positions | Constrained::Velocities => "a constraint",
        Constrained::Gaps => "a surface that the motion does not pass",
    };
    format!(
        "{what} is {function} {relation}, of which {letter} is written: bring all to one side, `{head} = {all}`"
    )
}

fn is_zero(value: &Expr) -> bool {
    let Expr::Lit(literal) = value else { return false };
    match &literal.lit {
        Lit::Int(value) => value.base10_digits() == "0",
        Lit::Float(value) => value.base10_parse::<f64>().is_ok_and(|value| value == 0.0),
        _ => false,
    }
}
