//! What people write who come from paper, Python, Mathematica or C, and what to write instead.

use syn::{BinOp, Expr as Syntax, ExprBinary, ExprLit, ExprMethodCall, Ident, Lit, Pat};

use super::sums::signed_literal;
use super::{Lowering, Role, is_number_type};
use crate::errors::text;
use crate::syntax::{Constrained, Factor, elements, ident};
use crate::words::{Method, is_method};

/// Functions by other names, and functions of functions, as they are written behind a number.
#[rustfmt::skip]
const OTHER_NAMES: [(&[&str], &str); 29] = [
    (&["log", "loge"],         "ln()"),
    (&["lg"],                  "log10()"),
    (&["lb"],                  "log2()"),
    (&["log1p"],               "ln_1p()"),
    (&["expm1"],               "exp_m1()"),
    (&["root"],                "sqrt()"),
    (&["arcsin"],              "asin()"),
    (&["arccos"],              "acos()"),
    (&["arctan"],              "atan()"),
    (&["arctan2"],             "atan2()"),
    (&["arsinh", "arcsinh"],   "asinh()"),
    (&["arcosh", "arccosh"],   "acosh()"),
    (&["artanh", "arctanh"],   "atanh()"),
    (&["sgn", "sign"],         "signum()"),
    (&["fabs"],                "abs()"),
    (&["inv"],                 "recip()"),
    (&["cot"],                 "tan().recip()"),
    (&["sec"],                 "cos().recip()"),
    (&["csc", "cosec"],        "sin().recip()"),
    (&["coth"],                "tanh().recip()"),
    (&["sech"],                "cosh().recip()"),
    (&["csch"],                "sinh().recip()"),
    (&["acot", "arccot"],      "recip().atan()"),
    (&["asec"],                "recip().acos()"),
    (&["acsc"],                "recip().asin()"),
    (&["acoth"],               "recip().atanh()"),
    (&["sq", "sqr", "square", "squared"],       "powi(2)"),
    (&["cube", "cubed"],                        "powi(3)"),
    (&["clone", "into", "to_owned", "from"],    ""),
];

/// Functions that jump.
#[rustfmt::skip]
const JUMPING: [&str; 13] = [
    "ceil", "floor", "fract", "heaviside", "mod", "rem_euclid", "rint", "round", "step", "theta", "trunc", "unit_step",
    "unitstep",
];

/// Functions with the exponent at the name: `sin2(x)` is sin²(x); `exp10(x)` is 10ˣ.
const SQUARED_BY_NAME: [&str; 7] = ["sin", "cos", "tan", "sinh", "cosh", "tanh", "abs"];

/// What is meant by a function of another language with this receiver and these arguments.
pub(super) fn meant(name: &str, receiver: Option<&Syntax>, arguments: &[&Syntax]) -> Option<String> {
    let x = receiver.map_or_else(|| "x".to_string(), as_receiver);
    let alone = match receiver {
        Some(Syntax::Paren(inner)) => text(&inner.expr),
        _ => x.clone(),
    };
    let texts: Vec<String> = arguments.iter().map(text).collect();
    let arguments: Vec<&str> = texts.iter().map(String::as_str).collect();
    // Functions of Mathematica begin with a capital letter.
    let lower = name.to_lowercase();
    let written = match (lower.as_str(), arguments.as_slice()) {
        ("dot", []) => format!("dot({alone})"),
        ("dot", [y]) => format!("sum(0..n, |j| {x}[j] * {y}[j])"),
        ("log", ["2" | "2." | "2.0"]) => format!("{x}.log2()"),
        ("log", ["10" | "10." | "10.0"]) => format!("{x}.log10()"),
        ("log", [base]) => format!("{x}.ln() / ({base}).ln()"),
        ("clamp", [least, most]) => format!("{x}.max({least}).min({most})"),
        ("copysign", [sign]) => format!("{x}.abs() * ({sign}).signum()"),
        ("arctan2", [other]) => format!("{x}.atan2({other})"),
        ("pow", [exponent]) if exponent.parse::<i32>().is_ok() => format!("{x}.powi({exponent})"),
        ("pow", [exponent]) => format!("{x}.powf({exponent})"),
        ("erfc", []) => format!("1.0 - {x}.erf()"),
        ("sinpi", []) => format!("({x} * PI).sin()"),
        ("cospi", []) => format!("({x} * PI).cos()"),
        ("exp10" | "pow10", []) => format!("10.0_f64.powf({alone})"),
        ("pow2" | "pow3" | "pow4", []) => format!("{x}.powi({})", lower.trim_start_matches("pow")),
        (other, []) if OTHER_NAMES.iter().any(|(names, _)| names.contains(&other)) => {
            let (_, meant) = OTHER_NAMES.iter().find(|(names, _)| names.contains(&other))?;
            if meant.is_empty() { x } else { format!("{x}.{meant}") }
        }
        (other, given) => {
            // `dsqrt` is that of Fortran.
            let without_type = other.strip_prefix('d').unwrap_or(other);
            let base = other.trim_end_matches(|digit: char| digit.is_ascii_digit());
            let known = [other, without_type].into_iter().find(|name| Method::by_name(name).is_some());
            match known {
                Some(known) => format!("{x}.{known}({})", given.join(", ")),
                None if given.is_empty() && base != other && SQUARED_BY_NAME.contains(&base) => {
                    format!("{x}.{base}().powi({})", &other[base.len()..])
                }
                None => return None,
            }
        }
    };
    Some(written)
}

/// What is said of a function that has no derivative where it jumps.
pub(super) fn jumps(name: &str) -> Option<String> {
    JUMPING.contains(&name.to_lowercase().as_str()).then(|| {
        format!(
            "`{name}` has no derivative where it jumps: write the formulas on both sides with a condition, \
             as in `if x < 0.0 {{ 0.0 }} else {{ 1.0 }}`"
        )
    })
}

/// `x` for `ẋ`, which is one letter or two.
fn undotted(name: &str) -> Option<String> {
    const DOTTED: &str = "ȧḃċḋėḟġḣṁṅȯṗṙṡṫẇẋẏż";
    const PLAIN: &str = "abcdefghmnoprstwxyz";
    if let Some((before, after)) = name.split_once('\u{307}') {
        return Some(format!("{before}{after}"));
    }
    let first = name.chars().next()?;
    let (_, plain) = DOTTED.chars().zip(PLAIN.chars()).find(|(dotted, _)| *dotted == first)?;
    Some(format!("{plain}{}", &name[first.len_utf8()..]))
}

/// The root of a sum of squares, called by one of its names.
fn is_norm(name: &str) -> bool {
    ["norm", "norm2", "norm_squared", "length", "magnitude", "mag"].contains(&name.to_lowercase().as_str())
}

/// Whether numbers have a method of this name.
fn is_function(name: &Ident) -> bool {
    is_method(&name.to_string())
}

/// An expression in front of a method.
pub(super) fn as_receiver(syntax: &Syntax) -> String {
    match syntax {
        Syntax::Call(call) if ident(&call.func).is_some_and(is_function) => {
            let (first, rest) = (call.args.first(), call.args.iter().skip(1).map(text));
            let first = first.map_or_else(|| "x".to_string(), as_receiver);
            format!("{first}.{}({})", text(&call.func), rest.collect::<Vec<_>>().join(", "))
        }
        Syntax::Path(_)
        | Syntax::Paren(_)
        | Syntax::Call(_)
        | Syntax::MethodCall(_)
        | Syntax::Index(_)
        | Syntax::Array(_)
        | Syntax::Field(_) => text(syntax),
        Syntax::Lit(literal) if text(literal).contains('.') => text(syntax),
        Syntax::Lit(ExprLit { lit: Lit::Int(value), .. }) if value.suffix().is_empty() => {
            format!("{}.0", value.base10_digits())
        }
        // What is no power is reported where it stands.
        _ if text(syntax).contains(['^', '|']) => "(…)".to_string(),
        _ => format!("({})", text(syntax)),
    }
}

impl Lowering<'_> {
    /// `x ** 2` and `x ^ 2`, where the right side binds more loosely than a power does. `x ** k` and
    /// `x * *k` are the same to the parser.
    pub(super) fn not_a_power<T>(&mut self, power: &ExprBinary) -> Option<T> {
        let (mut base, mut exponent) = (&*power.left, &*power.right);
        if let (BinOp::Mul(_), Syntax::Unary(dereferenced)) = (power.op, exponent) {
            exponent = &dereferenced.expr;
        }
        let is_place = matches!(exponent, Syntax::Path(_) | Syntax::Field(_) | Syntax::Index(_));
        let may_be_product = is_place && matches!(power.op, BinOp::Mul(_));
        // `^` binds more loosely than `+` and `*`: what is meant are the operands beside it.
        while let Syntax::Binary(product) = base {
            if matches!(product.op, BinOp::BitXor(_)) {
                self.not_a_power::<()>(product);
            }
            base = &product.right;
        }
        while let Syntax::Binary(product) = exponent {
            exponent = &product.left;
        }
        let is_name = |syntax: &Syntax, is: &dyn Fn(&Ident) -> bool| ident(syntax).is_some_and(is);
        let is_differential = |syntax: &Syntax| matches!(syntax, Syntax::Call(call) if is_name(&call.func, &|name| name == "d"));
        let literal = signed_literal(exponent);
        let (function, power) = (if literal.is_some() { "powi" } else { "powf" }, text(exponent));
        let meant = match (base, exponent) {
            // sin^2(x)
            (Syntax::Path(name), Syntax::Call(call))
                if is_name(base, &is_function) && matches!(&*call.func, Syntax::Lit(_)) =>
            {
                let x = call.args.first().map_or_else(|| "x".to_string(), as_receiver);
                format!("{x}.{}().powi({})", text(name), text(&call.func))
            }
            (Syntax::Path(_), _) if is_name(base, &|name| self.is_euler(name)) => {
                format!("{}.exp()", as_receiver(exponent))
            }
            _ if self.role == Role::OneForm && is_differential(base) => {
                let message =
                    "a one-form is linear in d(·), and Ω is made of it: write α, as `x * d(y)` for dx ∧ dy";
                return self.refuse(quote::quote!(#base #exponent), message);
            }
            (Syntax::Unary(negative), _) => format!("-{}.{function}({power})", as_receiver(&negative.expr)),
            (Syntax::Cast(_), _) => format!("(…).{function}({power})"),
            (Syntax::Lit(literal), _) => match &literal.lit {
                // 2x^2
                Lit::Int(value) if !value.suffix().is_empty() && !is_number_type(value.suffix()) => {
                    format!("{} * {}.{function}({power})", value.base10_digits(), value.suffix())
                }
                Lit::Int(value) => format!("{}.0_f64.{function}({power})", value.base10_digits()),
                _ => format!("{}.{function}({power})", text(base)),
            },
            _ => format!("{}.{function}({power})", as_receiver(base)),
        };
        let product = match may_be_product {
            true => format!(", and a product with what a reference points to `{} * {power}`", text(base)),
            false => String::new(),
        };
        self.refuse(quote::quote!(#base #exponent), format!("a power is written `{meant}`{product}"))
    }

    /// Whether a name is that of 2.718… on paper, and of nothing here.
    fn is_euler(&self, name: &Ident) -> bool {
        (name == "e" || name == "E") && !self.is_declared(&name.to_string())
    }

    /// Whether something has this name here.
    pub(super) fn is_declared(&self, name: &str) -> bool {
        self.binding_of(name).is_some()
            || self.model.blocks.iter().any(|block| block.name == name)
            || self.model.parameters.iter().any(|parameter| parameter.text == name)
            || self.model.sizes.iter().any(|size| size.text == name)
    }

    /// What to write for a name that is none here, if it is known from elsewhere.
    pub(super) fn name_called(&self, name: &str) -> Option<&'static str> {
        Some(match name {
            "e" => "write `std::f64::consts::E`, and `x.exp()` for a power of it",
            "pi" | "Pi" | "π" => "write `PI`",
            "τ" | "tau" => "write `std::f64::consts::TAU`",
            "inf" | "Inf" | "infinity" | "Infinity" | "∞" => {
                "a formula has finite values: leave out what is infinitely far"
            }
            "time" => "the time is written `t`",
            _ => return None,
        })
    }

    /// What is wrong with a call of what is no function of the language, if that is known from elsewhere.
    pub(super) fn call_called(
        &self,
        name: &str,
        receiver: Option<&Syntax>,
        arguments: &[&Syntax],
    ) -> Option<String> {
        let all: Vec<&Syntax> = receiver.into_iter().chain(arguments.iter().copied()).collect();
        let block = |syntax: &Syntax| self.model.blocks.iter().find(|block| block.name == text(syntax));
        if let Some(jumps) = jumps(name) {
            return Some(jumps);
        }
        if is_norm(name) {
            let list = match all.as_slice() {
                [one] => elements(one).map_or_else(|| vec![*one], |list| list.iter().collect()),
                _ => all,
            };
            let is_square = name == "norm_squared";
            let root = if is_square { "" } else { ".sqrt()" };
            let written = match list.as_slice() {
                [one] if block(one).is_some_and(|block| block.array.is_some()) => {
                    format!("sum(0..n, |j| {}[j].powi(2)){root}", text(one))
                }
                [one] if is_square => format!("{}.powi(2)", as_receiver(one)),
                [one] => format!("{}.abs()", as_receiver(one)),
                [x, y] if !is_square => format!("{}.hypot({})", as_receiver(x), text(y)),
                several => {
                    let squares = several.iter().map(|x| format!("{}.powi(2)", as_receiver(x)));
                    format!("({}){root}", squares.collect::<Vec<_>>().join(" + "))
                }
            };
            return Some(format!("unknown function `{name}`; write `{written}`"));
        }
        let of = all.first().copied().and_then(block)?;
        let is_derivative = ["dt", "ddt", "diff", "derivative", "der", "vel", "velocity"]
            .contains(&name.to_lowercase().as_str())
            || name == "D";
        if is_derivative {
            return self
                .velocity_called(&format!("dot_{}", of.name))
                .map(|written| format!("unknown function `{name}`; {written}"));
        }
        let is_second = ["ddot", "dddot", "acc", "acceleration"].contains(&name);
        is_second.then(|| {
            format!("unknown function `{name}`: no second derivative stands in {}", self.role.name())
        })
    }

    /// What to write for `xdot`, `x_dot`, `dot_x`, `vx`, and `dy` of a coordinate.
    pub(super) fn velocity_called(&self, name: &str) -> Option<String> {
        let written = match (self.velocity_word(), self.role) {
            (Ok(word), _) => word,
            (Err(_), Role::Constraint(_)) => "",
            (Err(_), _) => return None,
        };
        let block = self.model.blocks.iter().find(|block| {
            let (dot, of) = (block.velocity_name(), &block.name);
            let before = ["dot", "d", "v", "v_"].map(|prefix| format!("{prefix}{of}"));
            let behind =
                ["dot", "_dot", "d", "_d", "_t", "p", "_prime"].map(|suffix| format!("{of}{suffix}"));
            let others = [before.as_slice(), &behind].concat();
            dot == *name
                || others.iter().any(|other| other == name)
                || undotted(name).is_some_and(|name| *of == name)
        })?;
        let entry = match &block.grid {
            Some(_) => block.letters(),
            None if block.array.is_some() => "[j]",
            None => "",
        };
        if block.factor == Factor::Rotation {
            let name = block.axis.map_or_else(|| block.name.to_string(), |_| format!("{}[j]", block.name));
            return Some(format!("the angular velocity of `{name}` is written `omega({name})[k]`"));
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
            other => {
                let count = match elements(other) {
                    Some(list) => list.len().to_string(),
                    None if self.model.size(&syn::parse_quote!(#other.len())).is_some() => {
                        format!("{}.len()", text(other))
                    }
                    None => "n".to_string(),
                };
                format!("`sum(0..{count}, |j| … {}[j] …)`", as_receiver(other))
            }
        };
        self.errors.push(call, format!("a formula has no iterators; a sum is written {advice}"));
        true
    }
}
