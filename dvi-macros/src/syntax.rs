//! Tokens to tree: the arguments of the attribute and the struct below it.

use proc_macro2::{Ident, TokenStream};
use syn::spanned::Spanned;
use syn::{Expr, ExprArray, Local, Path};

use crate::errors::{Errors, listed, nearest};

mod argument;
mod closures;
mod constraint;
mod cut;
mod declared;
pub(crate) mod depth;
mod elsewhere;
mod rotation;
mod shared;
pub(crate) mod tidy;
mod unsaid;

use argument::{Argument, Value};
pub(crate) use closures::{
    bound, closure, elements, ident, indexed, last_value, literal, name_of, own_field,
};
pub(crate) use constraint::{Constrained, Constraint, Member};
use cut::{list, named, read, read_by, split_at_commas, value_of};
use declared::Declared;

pub(crate) use declared::{
    Declaration, Factor, Force, Function, Gauge, Named, ScalarFieldPath, TimeTransform,
};
pub(crate) use shared::value;

/// Which of the two attributes stands on a struct.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Kind {
    /// `#[degenerate_lagrangian]`
    #[default]
    Degenerate,
    /// `#[lagrangian]`
    Regular,
}

/// The arguments as written; what was not given is empty.
#[derive(Debug, Default)]
pub(crate) struct Attribute {
    pub(crate) kind: Kind,
    pub(crate) coordinates: Vec<Declaration>,
    pub(crate) one_form: Option<Expr>,
    pub(crate) hamiltonian: Option<Expr>,
    pub(crate) gauge: Option<Gauge>,
    pub(crate) time_transform: Option<TimeTransform>,
    pub(crate) lagrangian: Option<Expr>,
    pub(crate) forces: Vec<Force>,
    /// R of the force −∂R/∂v.
    pub(crate) dissipation: Option<Expr>,
    pub(crate) constraints: Vec<Constraint>,
    /// What the constraints are of, if some were declared, readable or not.
    pub(crate) constrained: Option<Constrained>,
    pub(crate) momenta: Vec<Named>,
    /// The functions whose zeros are events.
    pub(crate) events: Vec<Named>,
    pub(crate) functions: Vec<Function>,
    pub(crate) scalar_fields: Vec<ScalarFieldPath>,
    /// The names that all formulas share.
    pub(crate) shared: Vec<Local>,
    /// What the state derives beside what every state does.
    pub(crate) derives: Vec<Path>,
    pub(crate) crate_path: Option<Path>,
    /// Whether a coordinate was declared that could not be read.
    pub(crate) lost_coordinates: bool,
    /// Whether a function was declared that could not be read.
    pub(crate) lost_functions: bool,
    /// Whether a shared name was defined that could not be read.
    pub(crate) lost_names: bool,
}

/// The arguments, and how they are written.
#[rustfmt::skip]
const ARGUMENTS: [(&str, &str); 17] = [
    ("coordinates", "coordinates(x, y[n], r[n][3], R: SO3, s[n]: S2)"),
    ("one_form",    "one_form = … * d(x) + …"),
    ("hamiltonian", "hamiltonian = …"),
    ("gauge",       "gauge = F(q)"),
    ("time_transform", "time_transform = ρ(q)"),
    ("lagrangian",  "lagrangian = …"),
    ("force",       "force = [F_x, |i| F_y(i)]`, or `force(x) = F_x"),
    ("dissipation", "dissipation = R(q, v, t)"),
    ("constraint",  "constraint = g(q, t)`, or `constraint(i in 0..n) = g(i)"),
    ("nonholonomic", "nonholonomic = a(q, v, t)`, or `nonholonomic(i in 0..n) = a(i)"),
    ("impact",      "impact = g(q, t)`, or `impact(i in 0..n) = g(i)"),
    ("momenta",     "momenta(p = …)"),
    ("events",      "events(name = g(q, v, t))"),
    ("functions",   "functions(f = [f, df, d2f])"),
    ("let",         "let = { let r2 = x * x + y * y; let gap = |a, b| …; }"),
    ("derive",      "derive(Trait, path::Trait)"),
    ("crate",       "crate = ::path"),
];

/// Other words, and the argument that is meant.
#[rustfmt::skip]
const OTHER_WORDS: [(&str, &[&str]); 9] = [
    ("coordinates", &["coords", "variables", "vars", "q", "positions", "unknowns"]),
    ("lagrangian",  &["L", "l", "lagrange", "kinetic", "potential", "T", "V", "U"]),
    ("hamiltonian", &["H", "h", "energy"]),
    ("one_form",    &["alpha", "theta", "vartheta", "α", "ϑ", "θ", "symplectic"]),
    ("force",       &["damping", "drag", "drive", "forces", "forcing", "friction"]),
    ("dissipation", &["rayleigh", "R"]),
    ("momenta",     &["conserved", "integrals", "invariants", "momentum"]),
    ("let",         &["abbreviations", "define", "definitions", "lets", "locals", "shared", "terms", "where", "with"]),
    ("events",      &["condition", "conditions", "crossings", "event", "section", "sections"]),
];

/// Words for what stands in the struct.
const FIELDS: [&str; 5] = ["constants", "parameter", "parameters", "params", "fields"];

/// The arguments that a regular system does not have.
const DEGENERATE_ONLY: [&str; 4] = ["one_form", "hamiltonian", "gauge", "time_transform"];

/// The arguments that a degenerate system does not have.
const REGULAR_ONLY: [&str; 4] = ["constraint", "nonholonomic", "impact", "dissipation"];

impl Kind {
    pub(crate) const BOTH: [Self; 2] = [Self::Degenerate, Self::Regular];

    /// The attribute as it is written.
    pub(crate) fn attribute(self) -> &'static str {
        match self {
            Self::Degenerate => "#[degenerate_lagrangian]",
            Self::Regular => "#[lagrangian]",
        }
    }

    /// The name of the attribute.
    pub(crate) fn name(self) -> &'static str {
        self.attribute().trim_start_matches("#[").trim_end_matches(']')
    }

    fn takes(self, argument: &str) -> bool {
        match self {
            Self::Degenerate => !REGULAR_ONLY.contains(&argument),
            Self::Regular => !DEGENERATE_ONLY.contains(&argument),
        }
    }

    /// What is meant by an argument that is none.
    fn meant(self, keyword: &str) -> String {
        let other = other_word(keyword);
        if self == Self::Degenerate && ["kinetic", "potential", "T", "V", "U"].contains(&keyword) {
            return "write `one_form = …` and `hamiltonian = …`, or all of L as `lagrangian = …`"
                .to_string();
        }
        if other == "force" && other != keyword {
            return "a force is written `force(x) = …`".to_string();
        }
        if other != keyword {
            return format!("write `{}`", form_of(other));
        }
        if FIELDS.contains(&keyword) {
            return "parameters are the fields of the struct, and formulas know them by their names"
                .to_string();
        }
        if let Some(instead) = unsaid::instead_of(keyword) {
            return instead.to_string();
        }
        match nearest(keyword, self.arguments()) {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("the arguments are {}", listed(self.arguments())),
        }
    }

    fn arguments(self) -> impl Iterator<Item = &'static str> {
        ARGUMENTS.into_iter().map(|(name, _)| name).filter(move |name| self.takes(name))
    }
}

pub(crate) fn parse_attribute(kind: Kind, tokens: TokenStream, errors: &mut Errors) -> Attribute {
    let mut attribute = Attribute { kind, ..Attribute::default() };
    if let Err(error) = depth::check(&tokens, depth::LONGEST) {
        errors.push_syn(error);
        attribute.lost_coordinates = true;
        return attribute;
    }
    let tokens = tidy::sums(tidy::names(tokens));
    let mut given: Vec<String> = Vec::new();
    for piece in split_at_commas(tokens) {
        match read_by(piece, |input| Argument::parse(input, kind)) {
            Ok(argument) => match argument.given() {
                Some(again) if given.contains(&again) => {
                    errors.push(&argument.name, format!("`{again}` is given twice"));
                }
                once => {
                    given.extend(once);
                    attribute.accept(argument, errors);
                }
            },
            Err(error) => errors.push_syn(error),
        }
    }
    attribute.lost_coordinates |= attribute.coordinates.is_empty();
    attribute.admit_factors(errors);
    attribute
}

/// The formulas of an attribute, but for those of constraints and what formulas share: to be read, or of one
/// that is borrowed mutably, to be changed.
macro_rules! formulas {
    ($attribute:expr) => {{
        let Attribute { one_form, hamiltonian, lagrangian, gauge, time_transform, .. } = $attribute;
        let Attribute { dissipation, forces, momenta, events, .. } = $attribute;
        let gauge = gauge.into_iter().filter_map(|gauge| match gauge {
            Gauge::Formula(formula) => Some(formula),
            Gauge::Auto(_) => None,
        });
        let rate = time_transform.into_iter().map(|TimeTransform { rate, .. }| rate);
        let dynamics = one_form.into_iter().chain(hamiltonian).chain(lagrangian).chain(gauge);
        let forces = forces.into_iter().flat_map(|force| {
            let (components, formula) = match force {
                Force::Components(ExprArray { elems, .. }) => (Some(elems), None),
                Force::On(_, formula) => (None, Some(formula)),
            };
            components.into_iter().flatten().chain(formula)
        });
        let named = momenta.into_iter().chain(events).map(|Named { formula, .. }| formula);
        dynamics.chain(rate).chain(dissipation).chain(forces).chain(named)
    }};
}

impl Attribute {
    /// The formula that Ω comes from.
    pub(crate) fn symplectic_part(&self) -> Option<&Expr> {
        self.one_form.as_ref().or(self.lagrangian.as_ref())
    }

    /// The function whose differential is added to α.
    pub(crate) fn gauge(&self) -> Option<&Expr> {
        match &self.gauge {
            Some(Gauge::Formula(formula)) => Some(formula),
            Some(Gauge::Auto(_)) | None => None,
        }
    }

    /// All formulas as they were written, behind what they share.
    pub(crate) fn formulas(&self) -> impl Iterator<Item = &Expr> {
        self.shared_values().chain(self.scopes().map(|(formula, _)| formula))
    }

    /// All formulas as they were written but for what they share, those of a family with its indices.
    pub(crate) fn scopes(&self) -> impl Iterator<Item = (&Expr, &[Member])> {
        let constraints = self.constraints.iter().map(|one| (&one.formula, one.family.as_slice()));
        formulas!(self).map(|formula| (formula, [].as_slice())).chain(constraints)
    }

    /// All formulas, to be changed.
    fn formulas_mut(&mut self) -> impl Iterator<Item = &mut Expr> {
        let constraints = self.constraints.iter_mut().map(|one| &mut one.formula);
        Self::shared_values_mut(&mut self.shared).chain(formulas!(self)).chain(constraints)
    }

    fn accept(&mut self, argument: Argument, errors: &mut Errors) {
        let Argument { name, value } = argument;
        let keyword = name.to_string();
        if let Some(of) = Constrained::named_like(&keyword) {
            self.accept_constraints(of, &name, value, errors);
            return;
        }
        match (keyword.as_str(), value) {
            (word, _) if self.kind == Kind::Degenerate && other_word(word) == "dissipation" => {
                let message = "a dissipation function is one of velocities, and those of a degenerate system are functions of the \
                               coordinates: write the force itself, `force(x) = …`";
                errors.push(&name, message);
            }
            (other, _) if !self.kind.takes(other_word(other)) => {
                let message = format!(
                    "`{}` takes all of L as `lagrangian = …`; {} are arguments of `{}`",
                    self.kind.attribute(),
                    listed(DEGENERATE_ONLY),
                    Kind::Degenerate.attribute()
                );
                errors.push_once("arguments of the other attribute", &name, message);
            }
            ("coordinates", Value::List(tokens)) => {
                self.coordinates = list(tokens, errors, &mut self.lost_coordinates);
            }
            ("momenta", Value::List(tokens)) => self.momenta = named(tokens, "momentum", errors),
            ("events", Value::List(tokens)) if tokens.is_empty() => {
                errors.push(&name, "no event is declared here: write `events(name = g)`, with a function g whose zeros are meant");
            }
            ("events", Value::List(tokens)) => self.events = named(tokens, "event", errors),
            ("functions", Value::List(tokens)) => {
                for declared in list(tokens, errors, &mut self.lost_functions) {
                    match declared {
                        Declared::Function(function) => self.functions.push(function),
                        Declared::ScalarField(field) => self.scalar_fields.push(field),
                    }
                }
            }
            ("let", Value::Assigned(tokens)) => self.accept_shared(&name, tokens, errors),
            ("derive", Value::List(tokens)) => self.derives = list(tokens, errors, &mut false),
            ("gauge", Value::Assigned(tokens)) => {
                self.gauge = value_of(&name, tokens, errors).map(Gauge::new);
            }
            ("time_transform", Value::Assigned(tokens)) => {
                self.time_transform =
                    value_of(&name, tokens, errors).map(|rate| TimeTransform { word: name, rate });
            }
            ("force", Value::Assigned(tokens)) => match value_of(&name, tokens, errors) {
                Some(Expr::Array(components)) => {
                    self.push_force(&name, Force::Components(components), errors);
                }
                Some(other) => {
                    let message = "`force = […]` is a list with a component for each coordinate; the force on one of them is \
                                   written `force(x) = …`";
                    errors.push(other, message);
                }
                None => {}
            },
            ("force", Value::AssignedTo { of, value, parentheses }) => {
                let at = if of.is_empty() { parentheses } else { of.span() };
                match (read(of), value_of(&name, value, errors)) {
                    (Ok(on), Some(formula)) => self.push_force(&name, Force::On(on, formula), errors),
                    (Ok(_), None) => {}
                    (Err(_), _) => errors.push_syn(syn::Error::new(
                        at,
                        "a force acts on a coordinate by its name alone, as in `force(x) = …`; of an array the force on entry i is \
                         `force(x) = |i| …`",
                    )),
                }
            }
            ("dissipation", Value::Assigned(tokens)) => self.dissipation = value_of(&name, tokens, errors),
            ("one_form", Value::Assigned(tokens)) => self.one_form = value_of(&name, tokens, errors),
            ("hamiltonian", Value::Assigned(tokens)) => self.hamiltonian = value_of(&name, tokens, errors),
            ("lagrangian", Value::Assigned(tokens)) => self.lagrangian = value_of(&name, tokens, errors),
            ("crate", Value::Assigned(tokens)) => match read(tokens) {
                Ok(path) => self.crate_path = Some(path),
                Err(error) => errors.push_syn(syn::Error::new(
                    error.span(),
                    "`crate` takes the path of this library: write `crate = ::dvi_core`",
                )),
            },
            (known, _) if ARGUMENTS.iter().any(|(name, _)| *name == known) => {
                self.lost_functions |= known == "functions";
                self.lost_names |= known == "let";
                errors.push(&name, format!("`{known}` is written `{}`", form_of(known)));
            }
            _ => {
                self.lost_names |= other_word(&keyword) == "let";
                errors.push(&name, format!("unknown argument `{keyword}`; {}", self.kind.meant(&keyword)));
            }
        }
    }

    /// Adds a force, unless there is a list of all of them.
    fn push_force(&mut self, word: &Ident, force: Force, errors: &mut Errors) {
        let is_list = |force: &Force| matches!(force, Force::Components(_));
        if !self.forces.is_empty() && (is_list(&force) || self.forces.iter().any(is_list)) {
            errors.push(
                word,
                "`force = […]` has the forces on all coordinates: write one list, or `force(x) = …` for each",
            );
        } else {
            self.forces.push(force);
        }
    }
}

/// The argument that a word of another book stands for, or the word itself.
fn other_word(word: &str) -> &str {
    OTHER_WORDS.iter().find(|(_, others)| others.contains(&word)).map_or(word, |(argument, _)| argument)
}

/// How an argument is written.
fn form_of(argument: &str) -> &'static str {
    ARGUMENTS.iter().find(|(name, _)| *name == argument).map_or("", |(_, form)| form)
}
