//! The words of the language: methods, forms of their own, constants. The functions of one and of two
//! numbers come in from their tables.

use std::f64::consts;

use crate::symbolic::{Binary, Unary, binary_by_name, binary_names, unary_by_name, unary_names};

/// A method of numbers.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Method {
    Unary(Unary),
    Binary(Binary),
    /// One of [`ARITHMETIC`].
    Arithmetic(&'static str, usize),
}

/// Methods that are arithmetic rather than functions of a table, with the number of arguments.
const ARITHMETIC: [(&str, usize); 7] = [
    ("powi", 1),
    ("recip", 0),
    ("mul_add", 2),
    ("min", 1),
    ("max", 1),
    ("to_radians", 0),
    ("to_degrees", 0),
];

/// A method of vectors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum VectorMethod {
    Dot,
    Cross,
    Norm,
    NormSquared,
}

/// With the number of arguments.
#[rustfmt::skip]
const VECTORS: [(&str, VectorMethod, usize); 4] = [
    ("dot",          VectorMethod::Dot,         1),
    ("cross",        VectorMethod::Cross,       1),
    ("norm",         VectorMethod::Norm,        0),
    ("norm_squared", VectorMethod::NormSquared, 0),
];

/// Sums and products over indices.
pub(crate) const SUMS: [&str; 4] = ["sum", "sum_pairs", "sum_ordered_pairs", "product"];

/// Velocities, in a one-form and in a Lagrangian.
pub(crate) const VELOCITIES: [&str; 2] = ["d", "dot"];

/// The one-form of area on the sphere of unit vectors, where there are some.
pub(crate) const AREA: &str = "area";

/// The time, unless a coordinate or a field has that name.
pub(crate) const TIME: &str = "t";

/// The coordinate that a time transformation adds beside it.
pub(crate) const ENERGY: &str = "energy";

/// The constant that goes without a path: a single name may be that of another one in the module of the
/// user, which the macro cannot see; only this is taken for what it says.
pub(crate) const PI: &str = "PI";

/// Those of `std::f64::consts`, by their full paths, with their signs in LaTeX.
#[rustfmt::skip]
const CONSTANTS: [(&str, f64, &str); 8] = [
    (PI,            consts::PI,        r"\pi"),
    ("TAU",         consts::TAU,       r"2\pi"),
    ("E",           consts::E,         r"\mathrm{e}"),
    ("SQRT_2",      consts::SQRT_2,    r"\sqrt{2}"),
    ("LN_2",        consts::LN_2,      r"\ln 2"),
    ("LN_10",       consts::LN_10,     r"\ln 10"),
    ("FRAC_PI_2",   consts::FRAC_PI_2, r"\frac{\pi}{2}"),
    ("FRAC_1_PI",   consts::FRAC_1_PI, r"\frac{1}{\pi}"),
];

impl Method {
    pub(crate) fn by_name(name: &str) -> Option<Self> {
        let arithmetic = || ARITHMETIC.iter().find(|(known, ..)| *known == name);
        unary_by_name(name)
            .map(Self::Unary)
            .or_else(|| binary_by_name(name).map(Self::Binary))
            .or_else(|| arithmetic().map(|&(name, arity)| Self::Arithmetic(name, arity)))
    }

    /// The number of arguments, the receiver not counted.
    pub(crate) fn arity(self) -> usize {
        match self {
            Self::Unary(_) => 0,
            Self::Binary(_) => 1,
            Self::Arithmetic(_, arity) => arity,
        }
    }
}

impl VectorMethod {
    /// With the number of arguments, the receiver not counted.
    pub(crate) fn by_name(name: &str) -> Option<(Self, usize)> {
        VECTORS.iter().find(|(known, ..)| *known == name).map(|(_, method, arity)| (*method, *arity))
    }
}

/// The names that a function of the user's own cannot have.
pub(crate) fn reserved() -> impl Iterator<Item = &'static str> {
    SUMS.into_iter().chain(VELOCITIES)
}

/// Whether numbers have a method of this name.
pub(crate) fn is_method(name: &str) -> bool {
    Method::by_name(name).is_some()
}

/// All that can be called.
pub(crate) fn callable() -> impl Iterator<Item = &'static str> {
    let arithmetic = ARITHMETIC.iter().map(|(name, ..)| *name);
    unary_names().chain(binary_names()).chain(arithmetic).chain(reserved())
}

/// The constant of `std::f64::consts` with this name, and its sign in LaTeX.
pub(crate) fn constant(name: &str) -> Option<(f64, &'static str)> {
    CONSTANTS.iter().find(|(known, ..)| *known == name).map(|(_, value, sign)| (*value, *sign))
}

#[test]
fn the_page_of_the_language_lists_the_methods() {
    let methods: Vec<&str> = callable().filter(|name| is_method(name)).collect();
    let page = include_str!("../docs/degenerate_lagrangian.md").replace('\n', " ");
    let list = format!("the methods {}.", crate::errors::listed(methods));
    assert!(page.contains(&list), "{list}");
}
