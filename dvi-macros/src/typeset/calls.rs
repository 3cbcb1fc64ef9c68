//! Functions, velocities, sums.

use syn::{Expr, ExprCall, ExprClosure};

use super::{Strength, Tex, Typesetter, plain};
use crate::errors::text;
use crate::syntax::{bound, literal};
use crate::words::{AREA, SUMS, VELOCITIES};

/// Functions that LaTeX has under another name than Rust.
const RENAMED: [(&str, &str); 4] =
    [("asin", r"\arcsin"), ("acos", r"\arccos"), ("atan", r"\arctan"), ("ln", r"\ln")];
/// Those that have the same.
const SAME: [&str; 8] = ["sin", "cos", "tan", "sinh", "cosh", "tanh", "min", "max"];

impl Typesetter {
    /// A method of numbers, with the number first.
    pub(super) fn function(&mut self, name: &str, arguments: &[&Expr]) -> Tex {
        let parts: Vec<Tex> = arguments.iter().map(|argument| self.expr(argument)).collect();
        match (name, &parts[..]) {
            ("powi" | "powf", [base, exponent]) => {
                let base = base.within(Strength::Atom);
                Tex::new(Strength::Function, format!("{{{base}}}^{{{}}}", exponent.text))
            }
            ("sqrt", [of]) => Tex::atom(format!(r"\sqrt{{{}}}", of.text)),
            ("cbrt", [of]) => Tex::atom(format!(r"\sqrt[3]{{{}}}", of.text)),
            ("recip", [of]) => Tex::new(Strength::Product, format!(r"\frac{{1}}{{{}}}", of.text)),
            ("exp", [of]) => Tex::new(Strength::Function, format!(r"\mathrm{{e}}^{{{}}}", of.text)),
            ("abs" | "norm" | "len", [of]) => Tex::atom(format!(r"\left|{}\right|", of.text)),
            ("norm_squared", [of]) => {
                Tex::new(Strength::Function, format!(r"{{\left|{}\right|}}^{{2}}", of.text))
            }
            ("dot" | "cross", [a, b]) => {
                let [a, b] = [a, b].map(|part| part.within(Strength::Function));
                let sign = if name == "dot" { r"\cdot" } else { r"\times" };
                Tex::new(Strength::Product, format!("{a} {sign} {b}"))
            }
            ("hypot", [a, b]) => {
                let [a, b] = [a, b].map(|part| part.within(Strength::Atom));
                Tex::atom(format!(r"\sqrt{{{{{a}}}^2 + {{{b}}}^2}}"))
            }
            ("mul_add", [a, b, c]) => {
                let [a, b] = [a, b].map(|part| part.within(Strength::Product));
                Tex::new(Strength::Sum, format!(r"{a} \, {b} + {}", c.within(Strength::Product)))
            }
            _ => {
                let renamed =
                    RENAMED.iter().find(|(known, _)| *known == name).map(|(_, sign)| (*sign).to_owned());
                let same = || SAME.contains(&name).then(|| format!("\\{name}"));
                let sign = renamed.or_else(same);
                let sign = sign.unwrap_or_else(|| format!(r"\operatorname{{{}}}", name.replace('_', r"\_")));
                applied(&sign, &parts)
            }
        }
    }

    pub(super) fn call(&mut self, call: &ExprCall) -> Tex {
        let arguments: Vec<&Expr> = call.args.iter().collect();
        let Expr::Path(path) = &*call.func else { return Tex::atom(plain(&text(call))) };
        let Some(name) = path.path.get_ident().map(ToString::to_string) else {
            // `f64::sin(x)` is `x.sin()`.
            let last = path.path.segments.last().map(|last| last.ident.to_string()).unwrap_or_default();
            return self.function(&last, &arguments);
        };
        match (name.as_str(), &arguments[..]) {
            (velocity, [of]) if VELOCITIES.contains(&velocity) => {
                let is_one_form = velocity == VELOCITIES[0];
                if is_one_form {
                    Tex::atom(format!(r"\mathrm{{d}}{}", self.expr(of).text))
                } else {
                    Tex::atom(self.velocity(of, r"\dot"))
                }
            }
            (AREA, [of]) => Tex::atom(format!(r"\operatorname{{area}}\left({}\right)", self.expr(of).text)),
            (sum, [range, Expr::Closure(closure)]) if SUMS.contains(&sum) => self.sum(sum, range, closure),
            _ => self.own(&name, &arguments),
        }
    }

    /// A function of the user's.
    fn own(&mut self, name: &str, arguments: &[&Expr]) -> Tex {
        let arguments: Vec<String> = arguments.iter().map(|argument| self.expr(argument).text).collect();
        Tex::atom(format!(r"{}\left({}\right)", self.symbol(name), arguments.join(", ")))
    }

    /// A sum over an index or two.
    fn sum(&mut self, name: &str, range: &Expr, closure: &ExprClosure) -> Tex {
        let indices: Vec<String> =
            closure.inputs.iter().flat_map(bound).map(|index| self.symbol(&index.to_string())).collect();
        let [first, last] = self.ends(range);
        let limits = match name {
            "sum_pairs" => format!(r"_{{{first} \le {} \le {last}}}", indices.join(" < ")),
            "sum_ordered_pairs" => format!(r"_{{{first} \le {} \le {last}}}", indices.join(r" \ne ")),
            _ => format!("_{{{} = {first}}}^{{{last}}}", indices.join(", ")),
        };
        let sign = if name == "product" { r"\prod" } else { r"\sum" };
        let body = self.expr(&closure.body).last();
        Tex::new(Strength::Series, format!("{sign}{limits} {body}"))
    }

    /// `0 \le i \le n - 1`
    pub(super) fn range(&mut self, index: &str, range: &Expr) -> String {
        let [first, last] = self.ends(range);
        format!(r"{first} \le {} \le {last}", self.symbol(index))
    }

    /// The first and the last value of a range.
    fn ends(&mut self, range: &Expr) -> [String; 2] {
        let Expr::Range(range) = range else { return [self.expr(range).text, String::new()] };
        [
            range.start.as_ref().map_or_else(String::new, |start| self.expr(start).text),
            range.end.as_ref().map_or_else(String::new, |end| self.last(end)),
        ]
    }

    /// The last value of a range, which is one less than its end.
    fn last(&mut self, end: &Expr) -> String {
        if let Some(end) = literal(end) {
            return (end - 1).to_string();
        }
        if let Expr::Binary(syn::ExprBinary { left, op: syn::BinOp::Sub(_), right, .. }) = end
            && let Some(less) = literal(right)
        {
            return format!("{} - {}", self.expr(left).text, less + 1);
        }
        if let Expr::Binary(syn::ExprBinary { left, op: syn::BinOp::Add(_), right, .. }) = end
            && literal(right) == Some(1)
        {
            return self.expr(left).text;
        }
        format!("{} - 1", self.expr(end).text)
    }
}

/// `\sin x`, `\sin(a + b)` or `f(x, y)`.
fn applied(sign: &str, arguments: &[Tex]) -> Tex {
    match arguments {
        [of] if of.strength == Strength::Atom => Tex::new(Strength::Series, format!("{sign} {}", of.text)),
        several => {
            let several: Vec<&str> = several.iter().map(|argument| argument.text.as_str()).collect();
            Tex::new(Strength::Function, format!(r"{sign}\left({}\right)", several.join(", ")))
        }
    }
}
