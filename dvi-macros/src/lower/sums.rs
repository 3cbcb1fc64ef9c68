//! Index sums and index arithmetic.

use quote::ToTokens;
use syn::{BinOp, Expr as Syntax, ExprCall, ExprClosure, Lit, RangeLimits, UnOp};

use super::{Binding, DEEPEST_SUM, Lowering, bound_name};
use crate::symbolic::{Binder, Expr, Index};

/// Beyond all sizes, and far from where sums of indices overflow.
const LARGEST: u64 = 1 << 48;

impl Lowering<'_> {
    /// `sum(0..n, |j| …)`, `sum_pairs(0..n, |j, k| …)` over j < k, `sum_ordered_pairs` over j ≠ k.
    pub(super) fn sum(&mut self, name: &str, call: &ExprCall) -> Option<Expr> {
        let pairs = name != "sum";
        let form = if pairs { format!("{name}(0..n, |j, k| …)") } else { "sum(0..n, |j| …)".to_string() };
        let (Some(range), Some(Syntax::Closure(closure)), 2) =
            (call.args.first(), call.args.get(1), call.args.len())
        else {
            self.errors.push(call, format!("write `{form}`"));
            return None;
        };
        if self.level + 2 > DEEPEST_SUM {
            self.errors.push_once("depth of sums", call, "sums are nested too deeply");
            return None;
        }
        let bounds = self.range(range);
        let level = self.level;
        if !pairs {
            let indices = self.closure_indices::<1>(closure);
            let ((lower, upper), [index]) = (bounds?, indices?);
            let binder = Binder { level, lower, upper, except: None };
            let body = self.inside(&[(index, &binder)], &closure.body)?;
            return Some(self.graph.reduce(binder, body));
        }
        let indices = self.closure_indices::<2>(closure);
        let ((lower, upper), [first, second]) = (bounds?, indices?);
        let outer = Binder { level, lower: lower.clone(), upper: upper.clone(), except: None };
        let inner = if name == "sum_pairs" {
            Binder {
                level: level + 1,
                lower: Index::bound(level).plus(&Index::literal(1), 1),
                upper,
                except: None,
            }
        } else {
            Binder { level: level + 1, lower, upper, except: Some(Index::bound(level)) }
        };
        let body = self.inside(&[(first, &outer), (second, &inner)], &closure.body)?;
        let body = self.graph.reduce(inner, body);
        Some(self.graph.reduce(outer, body))
    }

    /// The body of a closure with its indices bound to these ranges.
    pub(super) fn inside(&mut self, indices: &[(String, &Binder)], body: &Syntax) -> Option<Expr> {
        let outside = self.scope.len();
        for (name, binder) in indices {
            self.scope.push((name.clone(), Binding::Index { binder: (*binder).clone() }));
        }
        self.level += indices.len() as u32;
        let value = self.expr(body);
        self.level -= indices.len() as u32;
        self.scope.truncate(outside);
        value
    }

    pub(super) fn closure_indices<const COUNT: usize>(
        &mut self,
        closure: &ExprClosure,
    ) -> Option<[String; COUNT]> {
        let mut names = Vec::new();
        for input in &closure.inputs {
            match bound_name(input) {
                Some(name) => names.push(name),
                None => {
                    self.errors.push(input, "an index is a name: write `|j| …`");
                    return None;
                }
            }
        }
        let found = names.len();
        let names = <[String; COUNT]>::try_from(names).ok();
        if names.is_none() {
            let expected = if COUNT == 1 { "one index: `|j| …`" } else { "two indices: `|j, k| …`" };
            let inputs = &closure.inputs;
            let message = format!("expected {expected}; here are {found}");
            if inputs.is_empty() {
                self.errors.push(closure, message);
            } else {
                self.errors.push(inputs, message);
            }
        }
        names
    }

    fn range(&mut self, syntax: &Syntax) -> Option<(Index, Index)> {
        let Syntax::Range(range) = syntax else {
            self.errors.push(syntax, "expected a range of indices, as in `0..n`");
            return None;
        };
        let lower = match &range.start {
            Some(start) => self.index(start),
            None => Some(Index::literal(0)),
        };
        let Some(end) = &range.end else {
            self.errors.push(syntax, "this range has no end: write `0..n`");
            return None;
        };
        let upper = self.index(end);
        let (lower, upper) = (lower?, upper?);
        let upper = match range.limits {
            RangeLimits::HalfOpen(_) => upper,
            RangeLimits::Closed(_) => upper.plus(&Index::literal(1), 1),
        };
        if let (Some(least), Some(beyond)) = (lower.as_literal(), upper.as_literal())
            && least >= beyond
        {
            self.errors.push(syntax, "this range is empty");
            return None;
        }
        Some((lower, upper))
    }

    /// Whether an expression is index arithmetic: it names a bound index or a size.
    pub(super) fn is_index(&mut self, syntax: &Syntax) -> bool {
        match syntax {
            Syntax::Path(path) => match path.path.get_ident().map(ToString::to_string) {
                Some(name) => match self.binding_of(&name) {
                    Some(binding) => matches!(binding, Binding::Index { .. }),
                    None => self.model.size(syntax).is_some(),
                },
                None => false,
            },
            Syntax::Paren(inner) => self.is_index(&inner.expr),
            Syntax::Binary(binary) => self.is_index(&binary.left) || self.is_index(&binary.right),
            Syntax::MethodCall(call) => call.method == "len",
            _ => false,
        }
    }

    /// Sums, differences and literal multiples of indices, sizes and literals; and remainders.
    pub(super) fn index(&mut self, syntax: &Syntax) -> Option<Index> {
        let index = self.index_inside(syntax)?;
        let numbers = index.terms.iter().map(|(_, coefficient)| *coefficient);
        if numbers.chain([index.constant]).any(|number| number.unsigned_abs() > LARGEST) {
            self.errors.push(syntax, "this index is too large");
            return None;
        }
        Some(index)
    }

    fn index_inside(&mut self, syntax: &Syntax) -> Option<Index> {
        match syntax {
            Syntax::Lit(literal) => match &literal.lit {
                // What is too large is reported as such.
                Lit::Int(value) => {
                    return Some(Index::literal(value.base10_digits().parse().unwrap_or(i64::MAX)));
                }
                _ => self.errors.push(syntax, "an index is an integer"),
            },
            Syntax::Paren(inner) => return self.index(&inner.expr),
            Syntax::Group(inner) => return self.index(&inner.expr),
            Syntax::Unary(unary) if matches!(unary.op, UnOp::Neg(_)) => {
                return Some(self.index(&unary.expr)?.times(-1));
            }
            Syntax::Path(path) => {
                let name = path.path.get_ident().map(ToString::to_string).unwrap_or_default();
                if let Some(Binding::Index { binder }) = self.binding_of(&name) {
                    return Some(Index::bound(binder.level));
                }
                if let Some(size) = self.model.size(syntax) {
                    return Some(size);
                }
                if self.index_names.contains(&name) {
                    self.errors.push(path, format!("the index `{name}` is used outside of its sum"));
                } else if !self.model.lost_coordinates {
                    // Where declarations were lost, it may be a size of one of them.
                    let suggestion = self.index_suggestion(&name);
                    self.errors
                        .push(path, format!("`{}` is not an index{suggestion}", path.to_token_stream()));
                }
            }
            Syntax::MethodCall(_) | Syntax::Field(_) => match self.model.size(syntax) {
                Some(size) => return Some(size),
                None => self
                    .errors
                    .push(syntax, "expected an index or a size: `field.len()` of an array of the struct"),
            },
            Syntax::Binary(binary) => return self.index_arithmetic(binary),
            other => self
                .errors
                .push(other, "expected an index: sums and differences of indices, sizes and integers"),
        }
        None
    }

    fn index_arithmetic(&mut self, binary: &syn::ExprBinary) -> Option<Index> {
        let (left, right) = (self.index(&binary.left), self.index(&binary.right));
        let (left, right) = (left?, right?);
        match binary.op {
            BinOp::Add(_) => Some(left.plus(&right, 1)),
            BinOp::Sub(_) => Some(left.plus(&right, -1)),
            BinOp::Rem(_) => {
                if right.as_literal().is_some_and(|modulus| modulus < 1) {
                    self.errors.push(&binary.right, "a remainder is taken by a positive number");
                    return None;
                }
                Some(left.remainder(&right))
            }
            BinOp::Mul(_) => match (left.as_literal(), right.as_literal()) {
                (Some(factor), _) => Some(right.times(factor)),
                (_, Some(factor)) => Some(left.times(factor)),
                _ => {
                    self.errors.push(binary, "an index may be multiplied by a literal only");
                    None
                }
            },
            _ => {
                self.errors.push(binary, "index arithmetic knows `+`, `-`, `*` by a literal, and `%`");
                None
            }
        }
    }

    fn index_suggestion(&self, name: &str) -> String {
        let bound = self.scope.iter().filter(|(_, binding)| matches!(binding, Binding::Index { .. }));
        let known: Vec<&str> = bound
            .map(|(name, _)| name.as_str())
            .chain(self.model.sizes.iter().map(|size| size.text.as_str()))
            .collect();
        crate::errors::nearest(name, known).map_or_else(
            || "; an index is bound by a sum, as in `sum(0..n, |j| …)`".to_string(),
            |near| format!("; did you mean `{near}`?"),
        )
    }

    pub(super) fn literal_index(&mut self, syntax: &Syntax) -> Option<i64> {
        match syntax {
            Syntax::Lit(literal) => match &literal.lit {
                Lit::Int(value) => value.base10_parse().ok(),
                _ => None,
            },
            Syntax::Unary(unary) if matches!(unary.op, UnOp::Neg(_)) => {
                self.literal_index(&unary.expr).map(|value| -value)
            }
            Syntax::Paren(inner) => self.literal_index(&inner.expr),
            Syntax::Group(inner) => self.literal_index(&inner.expr),
            _ => None,
        }
    }
}
