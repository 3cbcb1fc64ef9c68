//! What people write who come from paper, Python, Mathematica or C, and what to write instead.

use syn::{Expr as Syntax, ExprMethodCall, Pat};

use super::{Lowering, Role};
use crate::errors::text;
use crate::syntax::{Constrained, Factor};

/// Functions by other names.
#[rustfmt::skip]
const OTHER_NAMES: [(&str, &str); 18] = [
    ("log",      "ln"),
    ("loge",     "ln"),
    ("lg",       "log10"),
    ("lb",       "log2"),
    ("log1p",    "ln_1p"),
    ("expm1",    "exp_m1"),
    ("root",     "sqrt"),
    ("arcsin",   "asin"),
    ("arccos",   "acos"),
    ("arctan",   "atan"),
    ("arctan2",  "atan2"),
    ("arsinh",   "asinh"),
    ("arcosh",   "acosh"),
    ("artanh",   "atanh"),
    ("sgn",      "signum"),
    ("sign",     "signum"),
    ("fabs",     "abs"),
    ("inv",      "recip"),
];

/// What is meant by a function of another language with this receiver and these arguments.
pub(super) fn meant(name: &str, receiver: Option<&Syntax>, arguments: &[&Syntax]) -> Option<String> {
    let x = receiver.map_or_else(|| "x".to_string(), as_receiver);
    let texts: Vec<String> = arguments.iter().map(text).collect();
    let arguments: Vec<&str> = texts.iter().map(String::as_str).collect();
    let written = match (name, arguments.as_slice()) {
        ("dot", []) => match receiver {
            Some(Syntax::Paren(inner)) => format!("dot({})", text(&inner.expr)),
            _ => format!("dot({x})"),
        },
        ("log", ["2" | "2." | "2.0"]) => format!("{x}.log2()"),
        ("log", ["10" | "10." | "10.0"]) => format!("{x}.log10()"),
        ("log", [base]) => format!("{x}.ln() / ({base}).ln()"),
        ("clamp", [least, most]) => format!("{x}.max({least}).min({most})"),
        ("copysign", [sign]) => format!("{x}.abs() * ({sign}).signum()"),
        ("pow", [exponent]) if exponent.parse::<i32>().is_ok() => format!("{x}.powi({exponent})"),
        ("pow", [exponent]) => format!("{x}.powf({exponent})"),
        ("sqr" | "square" | "squared", []) => format!("{x}.powi(2)"),
        _ => {
            let (_, meant) = OTHER_NAMES.iter().find(|(other, _)| *other == name)?;
            format!("{x}.{meant}({})", arguments.join(", "))
        }
    };
    Some(written)
}

/// An expression in front of a method.
pub(super) fn as_receiver(syntax: &Syntax) -> String {
    match syntax {
        Syntax::Path(_)
        | Syntax::Paren(_)
        | Syntax::Call(_)
        | Syntax::MethodCall(_)
        | Syntax::Index(_)
        | Syntax::Field(_) => text(syntax),
        Syntax::Lit(literal) if text(literal).contains('.') => text(syntax),
        _ => format!("({})", text(syntax)),
    }
}

impl Lowering<'_> {
    /// `x ** 2` and `x ^ 2`, where the right side binds more loosely than a power does.
    pub(super) fn not_a_power(&mut self, whole: &impl quote::ToTokens, base: &Syntax, exponent: &Syntax) {
        // `^` binds more loosely than `+` and `*`: what is meant are the operands beside it.
        let (mut base, mut exponent) = (base, exponent);
        while let Syntax::Binary(product) = base {
            base = &product.right;
        }
        while let Syntax::Binary(product) = exponent {
            exponent = &product.left;
        }
        let function = match self.literal_index(exponent) {
            Some(_) => "powi",
            None => "powf",
        };
        let message = match base {
            Syntax::Unary(negative) => {
                format!("a power is written `-{}.{function}({})`", text(&negative.expr), text(exponent))
            }
            Syntax::Cast(_) => {
                format!("a power is written `(…).{function}({})`", text(exponent))
            }
            _ => format!("a power is written `{}.{function}({})`", text(base), text(exponent)),
        };
        self.errors.push(whole, message);
    }

    /// What to write for `xdot`, `x_dot`, `dot_x`, `vx`, and `dy` of a coordinate.
    pub(super) fn velocity_called(&self, name: &str) -> Option<String> {
        let written = match self.role {
            Role::OneForm => "d",
            Role::Lagrangian => "dot",
            Role::Momentum | Role::Force if self.model.has_velocities() => "dot",
            Role::Component
            | Role::Hamiltonian
            | Role::Gauge
            | Role::TimeTransform
            | Role::Force
            | Role::Momentum => return None,
            Role::Constraint(Constrained::Velocities) => "dot",
            Role::Constraint(Constrained::Positions | Constrained::Gaps) => "",
        };
        let block = self.model.blocks.iter().find(|block| {
            let (dot, of) = (block.velocity_name(), &block.name);
            let others = [format!("{of}dot"), format!("{of}_dot"), format!("dot{of}"), format!("d{of}")];
            dot == *name || others.iter().any(|other| other == name)
        })?;
        let entry = if block.array.is_some() { "[j]" } else { "" };
        if block.factor == Factor::Rotation {
            return Some(format!("the angular velocity of `{0}` is written `omega({0})[k]`", block.name));
        }
        Some(match written {
            "" if self.role == Role::Constraint(Constrained::Gaps) => {
                "a gap is a function of the positions and the time, without velocities".to_string()
            }
            "" => "a holonomic constraint has no velocities; one of the velocities is declared by `nonholonomic = …`"
                .to_string(),
            "d" => format!("the differential of `{0}` is written `d({0}{entry})`", block.name),
            _ => format!("the velocity of `{0}` is written `dot({0}{entry})`", block.name),
        })
    }

    /// `(0..3).map(|j| …).sum()` and `a.iter().map(|a| …).sum()`; whether it was one.
    pub(super) fn iterated(&mut self, call: &ExprMethodCall) -> bool {
        if !matches!(
            call.method.to_string().as_str(),
            "sum" | "map" | "fold" | "product" | "iter" | "into_iter"
        ) {
            return false;
        }
        let (mut source, mut closure) = (&*call.receiver, None);
        loop {
            match source {
                Syntax::MethodCall(inner) => {
                    if let Some(Syntax::Closure(body)) = inner.args.first() {
                        closure = Some(body);
                    }
                    source = &inner.receiver;
                }
                Syntax::Paren(inner) => source = &inner.expr,
                _ => break,
            }
        }
        let index = match closure.map(|closure| closure.inputs.iter().collect::<Vec<_>>()).as_deref() {
            Some([Pat::Ident(index)]) => index.ident.to_string(),
            _ => "j".to_string(),
        };
        let advice = match source {
            Syntax::Range(range) => format!("`sum({}, |{index}| …)`", text(range)),
            other => format!("`sum(0..{0}.len(), |j| … {0}[j] …)`", text(other)),
        };
        self.errors.push(call, format!("a formula has no iterators; a sum is written {advice}"));
        true
    }
}
