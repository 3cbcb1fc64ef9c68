//! What generated functions call: the methods of `Scalar`, the helpers of the library, each other, and
//! the user's own.

use super::super::functions::{bessel, erf};
use super::parse::TRAITS;

#[derive(Clone, Debug)]
pub(super) enum Callee {
    /// `Scalar::lift`, `Number::number` and `Parameter::value`
    Number,
    Unary(fn(f64) -> f64),
    Binary(fn(f64, f64) -> f64),
    Power,
    Choose,
    /// Another function of `__private`.
    Library(String),
    /// `Sink::add`, of a dense matrix.
    AddEntry,
    Ok,
    /// Another generated function.
    Generated(String),
    /// A path of the user's.
    Own(String),
}

type UnaryRow = (&'static str, fn(f64) -> f64);
type BinaryRow = (&'static str, fn(f64, f64) -> f64);

#[rustfmt::skip]
const UNARY: &[UnaryRow] = &[
    ("sqrt",  f64::sqrt),  ("cbrt",  f64::cbrt),  ("exp",   f64::exp),   ("exp2",   f64::exp2),
    ("exp_m1", f64::exp_m1), ("ln",  f64::ln),    ("ln_1p", f64::ln_1p), ("log2",   f64::log2),
    ("log10", f64::log10), ("sin",   f64::sin),   ("cos",   f64::cos),   ("tan",    f64::tan),
    ("asin",  f64::asin),  ("acos",  f64::acos),  ("atan",  f64::atan),  ("sinh",   f64::sinh),
    ("cosh",  f64::cosh),  ("tanh",  f64::tanh),  ("asinh", f64::asinh), ("acosh",  f64::acosh),
    ("atanh", f64::atanh), ("abs",   f64::abs),   ("signum", f64::signum), ("sign", sign), ("erf", erf),
    ("sinc", |x| bessel(0, x)), ("sinc1", |x| bessel(1, x)), ("sinc2", |x| bessel(2, x)),
    ("sinc3", |x| bessel(3, x)),
];

const BINARY: &[BinaryRow] = &[
    ("atan2", f64::atan2),
    ("hypot", f64::hypot),
    ("powf", f64::powf),
    ("over_root", over_root),
    ("over_squares", |u, w| u / (u * u + w * w)),
];

/// Zero where the root is, as the documentation of `dvi_core::Scalar` has it.
fn over_root(w: f64, root: f64) -> f64 {
    if root > 0.0 { w / root } else { 0.0 }
}

fn sign(x: f64) -> f64 {
    if x == 0.0 { 0.0 } else { x.signum() }
}

/// What a path calls, by its segments.
pub(super) fn callee(path: &[String]) -> Callee {
    let segments: Vec<&str> = path.iter().map(String::as_str).collect();
    match segments.as_slice() {
        [.., "Scalar", "lift"] | [.., "__private", "Number", "number"] | [.., "Parameter", "value"] => {
            Callee::Number
        }
        [.., "Scalar", "powi"] => Callee::Power,
        [.., "Scalar", "choose"] => Callee::Choose,
        [.., "Scalar", name] => scalar(name),
        [.., "__private", name] => Callee::Library((*name).into()),
        [.., "Sink", "add"] => Callee::AddEntry,
        ["core", "result", "Result", "Ok"] => Callee::Ok,
        [.., owner, name] if TRAITS.contains(owner) => Callee::Generated((*name).into()),
        ["dvi_core" | "core", ..] => {
            panic!("the interpreter does not know the function {}", path.join("::"))
        }
        _ => Callee::Own(path.join("::")),
    }
}

fn scalar(name: &str) -> Callee {
    let unary = UNARY.iter().find(|(known, _)| *known == name).map(|(_, function)| Callee::Unary(*function));
    let binary =
        BINARY.iter().find(|(known, _)| *known == name).map(|(_, function)| Callee::Binary(*function));
    unary
        .or(binary)
        .unwrap_or_else(|| panic!("the interpreter does not know the method `{name}` of a scalar"))
}
