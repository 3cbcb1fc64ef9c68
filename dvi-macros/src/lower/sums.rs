//! Index sums and index arithmetic.

use quote::ToTokens;
use syn::{BinOp, Expr as Syntax, ExprCall, ExprClosure, Lit, RangeLimits, UnOp};

use super::{Binding, DEEPEST_SUM, Lowering, Role, Value, bound_name};
use crate::errors::here;
use crate::symbolic::{Atom, Fold, Free, Index, Loop, Range};
use crate::syntax::{ident, literal};

/// Beyond all sizes, and far from where sums of indices overflow.
const LARGEST: u64 = 1 << 48;

impl Lowering<'_> {
    /// `sum(0..n, |j| …)`, `product` alike, `sum_pairs(0..n, |j, k| …)` over j < k, `sum_ordered_pairs` over
    /// j ≠ k.
    pub(super) fn sum(&mut self, name: &str, call: &ExprCall) -> Option<Value> {
        let pairs = matches!(name, "sum_pairs" | "sum_ordered_pairs");
        let form =
            if pairs { format!("{name}(0..n, |j, k| …)") } else { format!("{name}(0..n, |j| …)") };
        let (Some(range), Some(Syntax::Closure(closure)), 2) =
            (call.args.first(), call.args.get(1), call.args.len())
        else {
            return self.refuse(call, format!("write `{form}`"));
        };
        if self.loops + 2 > DEEPEST_SUM {
            return self.errors.refuse_once("depth of sums", call, "sums are nested too deeply");
        }
        let bounds = self.range(range);
        let depth = self.loops;
        if !pairs {
            let indices = self.closure_indices::<1>(closure);
            let ((lower, upper), [index]) = (bounds?, indices?);
            if let Some(values) = self.model.written_out(range, closure) {
                return self.written_out(name, call, [index], values.map(|value| [value]), &closure.body);
            }
            let (form, only) = natural(depth, &lower, &upper);
            let body = self.inside(&[(index, form, &only)], &closure.body)?;
            let (fold, body) = match name {
                "product" => (Fold::Product, self.number(&closure.body, body)?.into()),
                _ => (Fold::Sum, body),
            };
            return body.map(|body| {
                let value = self.graph.fold(fold, Atom::Open(depth), only.range.clone(), body);
                self.admitted(call, value)
            });
        }
        let indices = self.closure_indices::<2>(closure);
        let (bounds, names) = (bounds?, indices?);
        if let Some(values) = self.model.written_out(range, closure) {
            let (all, is_ordered) = (values.clone(), name == "sum_ordered_pairs");
            let pairs = values.flat_map(|first| all.clone().map(move |second| [first, second]));
            let pairs = pairs.filter(|[first, second]| first < second || (is_ordered && first != second));
            return self.written_out(name, call, names, pairs, &closure.body);
        }
        if name == "sum_ordered_pairs" {
            return self.ordered_pairs(bounds, names, &closure.body);
        }
        let ties = self.ties;
        let sum =
            self.pairs((bounds.0.clone(), bounds.1.clone()), &bounds.1, names.clone(), &closure.body)?;
        if self.ties == ties {
            return Some(sum);
        }
        // Without the first index that has no second one, less is in doubt.
        let last = bounds.1.plus(&Index::literal(1), -1);
        self.ties = ties;
        self.pairs(bounds, &last, names, &closure.body)
    }

    /// A sum or product term by term, with these values of its indices in turn.
    fn written_out<const INDICES: usize>(
        &mut self,
        name: &str,
        call: &ExprCall,
        indices: [String; INDICES],
        values: impl Iterator<Item = [i64; INDICES]>,
        body: &Syntax,
    ) -> Option<Value> {
        let (mut terms, outside) = (Vec::new(), self.scope.len());
        for values in values {
            self.calls.counted(call, self.errors)?;
            for (index, value) in indices.iter().zip(values) {
                let binding = Binding::Index { form: Index::literal(value), over: None };
                self.scope.push((index.clone(), binding));
            }
            let term = self.value(body);
            self.scope.truncate(outside);
            terms.push(term?);
        }
        let whole = terms.into_iter().map(Some).reduce(|before, term| {
            before?.zip(term?, |before, term| {
                Some(if name == "product" {
                    self.graph.multiply(before, term)
                } else {
                    self.graph.add(before, term)
                })
            })
        })??;
        let whole = if name == "product" { self.number(body, whole)?.into() } else { whole };
        whole.map(|value| self.admitted(call, value))
    }

    /// The sum over j < k in a range, with j below `last` only.
    fn pairs(
        &mut self,
        (lower, upper): (Index, Index),
        last: &Index,
        [first, second]: [String; 2],
        body: &Syntax,
    ) -> Option<Value> {
        let depth = self.loops;
        let (first_form, outer) = natural(depth, &lower, last);
        let (second_form, inner) = natural(depth + 1, &first_form.plus(&Index::literal(1), 1), &upper);
        self.twice([(first, first_form, &outer), (second, second_form, &inner)], body)
    }

    /// The sum of the body of a closure over two indices with these forms in these loops.
    fn twice(&mut self, indices: [(String, Index, &Loop); 2], body: &Syntax) -> Option<Value> {
        self.inside(&indices, body)?.map(|body| {
            let loops = indices.iter().rev().map(|(_, _, over)| *over);
            Some(loops.fold(body, |body, Loop { depth, range }| {
                self.graph.fold(Fold::Sum, Atom::Open(*depth), range.clone(), body)
            }))
        })
    }

    /// The sum over j ≠ k in a range.
    fn ordered_pairs(
        &mut self,
        (lower, upper): (Index, Index),
        [first, second]: [String; 2],
        body: &Syntax,
    ) -> Option<Value> {
        let depth = self.loops;
        let (first_form, outer) = natural(depth, &lower, &upper);
        let (second_form, all) = natural(depth + 1, &lower, &upper);
        // Both indices are shifted alike.
        let range = Range { except: Some(Index::open(depth)), ..all.range };
        let inner = Loop { range, ..all };
        self.twice([(first, first_form, &outer), (second, second_form, &inner)], body)
    }

    /// The body of a closure with its indices bound to these forms in these loops.
    pub(super) fn inside(&mut self, indices: &[(String, Index, &Loop)], body: &Syntax) -> Option<Value> {
        let outside = self.scope.len();
        for (name, form, over) in indices {
            let binding = Binding::Index { form: form.clone(), over: Some((*over).clone()) };
            self.scope.push((name.clone(), binding));
        }
        self.loops += indices.len() as u32;
        let value = self.value(body);
        self.loops -= indices.len() as u32;
        self.scope.truncate(outside);
        value
    }

    pub(super) fn closure_indices<const COUNT: usize>(
        &mut self,
        closure: &ExprClosure,
    ) -> Option<[String; COUNT]> {
        let mut names = Vec::new();
        for input in &closure.inputs {
            let message = match bound_name(input) {
                Some(name) if name != "_" && names.contains(&name) => "two indices have this name",
                Some(name) => {
                    names.push(name);
                    continue;
                }
                None => "an index is a name: write `|j| …`",
            };
            return self.refuse(input, message);
        }
        let found = names.len();
        let names = <[String; COUNT]>::try_from(names).ok();
        if names.is_none() {
            let expected = if COUNT == 1 { "one index: `|j| …`" } else { "two indices: `|j, k| …`" };
            let inputs = &closure.inputs;
            let message = format!("expected {expected}; {}", here(found));
            if inputs.is_empty() {
                self.errors.push(closure, message);
            } else {
                self.errors.push(inputs, message);
            }
        }
        names
    }

    pub(super) fn range(&mut self, syntax: &Syntax) -> Option<(Index, Index)> {
        let Syntax::Range(range) = syntax else {
            return self.refuse(syntax, "expected a range of indices, as in `0..n`");
        };
        let lower = range.start.as_ref().map_or_else(|| Some(Index::literal(0)), |start| self.index(start));
        let Some(end) = &range.end else {
            return self.refuse(syntax, "this range has no end: write `0..n`");
        };
        let upper = self.index(end);
        let (lower, upper) = (lower?, upper?);
        let upper = match range.limits {
            RangeLimits::HalfOpen(_) => upper,
            RangeLimits::Closed(_) => upper.plus(&Index::literal(1), 1),
        };
        if let (Some(least), Some(beyond)) = (lower.as_literal(), upper.as_literal())
            && least >= beyond
            && !range.start.iter().any(|start| self.names_index(start))
            && !self.names_index(end)
        {
            return self.refuse(syntax, "this range is empty");
        }
        Some((lower, upper))
    }

    /// Whether an expression names an index: in a sum over components this is a number, and a range that
    /// has nothing in it for one component may have something for the next.
    fn names_index(&self, syntax: &Syntax) -> bool {
        match syntax {
            Syntax::Paren(inner) => self.names_index(&inner.expr),
            Syntax::Binary(binary) => self.names_index(&binary.left) || self.names_index(&binary.right),
            _ => ident(syntax).is_some_and(|name| {
                matches!(self.binding_of(&name.to_string()), Some(Binding::Index { .. }))
            }),
        }
    }

    /// Whether an expression is index arithmetic: it names a bound index or a size.
    pub(super) fn is_index(&mut self, syntax: &Syntax) -> bool {
        match syntax {
            Syntax::Paren(inner) => self.is_index(&inner.expr),
            Syntax::Binary(binary) => self.is_index(&binary.left) || self.is_index(&binary.right),
            Syntax::MethodCall(call) => call.method == "len",
            _ => ident(syntax).is_some_and(|name| match self.binding_of(&name.to_string()) {
                Some(binding) => matches!(binding, Binding::Index { .. }),
                None => self.model.size(syntax).is_some(),
            }),
        }
    }

    /// Sums, differences and multiples of indices, sizes and literals; and remainders.
    pub(super) fn index(&mut self, syntax: &Syntax) -> Option<Index> {
        let index = self.index_inside(syntax)?;
        let numbers = index.terms.iter().map(|(_, coefficient)| *coefficient);
        if numbers.chain([index.constant]).any(|number| number.unsigned_abs() > LARGEST) {
            return self.refuse(syntax, "this index is too large");
        }
        Some(index)
    }

    fn index_inside(&mut self, syntax: &Syntax) -> Option<Index> {
        match syntax {
            Syntax::Lit(literal) => match &literal.lit {
                // What is too large is reported as such.
                Lit::Int(value) => Some(Index::literal(value.base10_digits().parse().unwrap_or(i64::MAX))),
                _ => self.refuse(syntax, "an index is an integer"),
            },
            Syntax::Paren(inner) => self.index(&inner.expr),
            Syntax::Unary(unary) if matches!(unary.op, UnOp::Neg(_)) => {
                Some(self.index(&unary.expr)?.times(-1))
            }
            Syntax::Path(path) => {
                let name = path.path.get_ident().map(ToString::to_string).unwrap_or_default();
                match self.binding_of(&name) {
                    Some(Binding::Index { form, .. }) => return Some(form.clone()),
                    Some(Binding::Value { .. } | Binding::Function(_)) => {
                        let message = format!("`{name}` is a name of this formula here, and no index");
                        return self.refuse(path, message);
                    }
                    None => {}
                }
                if let Some(size) = self.model.size(syntax) {
                    return Some(size);
                }
                if self.index_names.contains(&name) {
                    return self.outside_of_sum(path, &name);
                }
                // Where declarations were lost, it may be a size of one of them.
                if self.model.lost_coordinates {
                    return None;
                }
                let suggestion = self.index_suggestion(&name);
                self.refuse(path, format!("`{}` is not an index{suggestion}", path.to_token_stream()))
            }
            Syntax::MethodCall(_) | Syntax::Field(_) => self.model.size(syntax).or_else(|| {
                self.refuse(syntax, "expected an index or a size: `field.len()` of an array of the struct")
            }),
            Syntax::Binary(binary) => self.index_arithmetic(binary),
            other => {
                self.refuse(other, "expected an index: sums and differences of indices, sizes and integers")
            }
        }
    }

    fn index_arithmetic(&mut self, binary: &syn::ExprBinary) -> Option<Index> {
        let (left, right) = (self.index(&binary.left), self.index(&binary.right));
        let (left, right) = (left?, right?);
        match binary.op {
            BinOp::Add(_) => Some(left.plus(&right, 1)),
            BinOp::Sub(_) => Some(left.plus(&right, -1)),
            BinOp::Rem(_) => {
                if right.as_literal().is_some_and(|modulus| modulus < 1) {
                    return self.refuse(&binary.right, "a remainder is taken by a positive number");
                }
                Some(left.remainder(&right))
            }
            BinOp::Mul(_) => match (left.as_literal(), right.as_literal()) {
                (Some(factor), _) => Some(right.times(factor)),
                (_, Some(factor)) => Some(left.times(factor)),
                _ if [&left, &right].iter().any(|factor| factor.free() == Free::default()) => {
                    Some(left.product(&right))
                }
                _ => self.refuse(
                    binary,
                    "an index is multiplied by a literal or a size, and not by another index",
                ),
            },
            _ => self.refuse(binary, "index arithmetic knows `+`, `-`, `*` by a literal or a size, and `%`"),
        }
    }

    fn index_suggestion(&self, name: &str) -> String {
        let bound = self.scope.iter().filter(|(_, binding)| matches!(binding, Binding::Index { .. }));
        let known: Vec<&str> = bound
            .map(|(name, _)| name.as_str())
            .chain(self.model.sizes.iter().map(|size| size.text.as_str()))
            .collect();
        crate::errors::nearest(name, known).map_or_else(
            || match self.role {
                Role::Constraint(of) => format!(
                    "; an index is bound by the constraint, as in `{}(i in 0..n) = …`, or by a sum, as in `sum(0..n, |j| …)`",
                    of.words().word
                ),
                Role::Shared => format!(
                    "; what formulas share sees none of their indices: write a function of it, `let f = |{name}| …;`"
                ),
                _ => "; an index is bound by a sum, as in `sum(0..n, |j| …)`".to_string(),
            },
            |near| format!("; did you mean `{near}`?"),
        )
    }
}

/// The value of an integer literal, with a sign or without.
pub(super) fn signed_literal(syntax: &Syntax) -> Option<i64> {
    match syntax {
        Syntax::Unary(unary) if matches!(unary.op, UnOp::Neg(_)) => {
            signed_literal(&unary.expr).map(|value| -value)
        }
        Syntax::Paren(inner) => signed_literal(&inner.expr),
        _ => literal(syntax),
    }
}

/// A loop over `lower..upper` that counts from zero where `lower` might be negative, and the index as a form
/// in the open index of that loop.
pub(super) fn natural(depth: u32, lower: &Index, upper: &Index) -> (Index, Loop) {
    let open = Index::open(depth);
    if lower.is_natural() {
        let range = Range { lower: lower.clone(), upper: upper.clone(), except: None, taken: Vec::new() };
        return (open, Loop { depth, range });
    }
    (lower.plus(&open, 1), Loop { depth, range: Range::up_to(upper.plus(lower, -1)) })
}
