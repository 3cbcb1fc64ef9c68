//! Indices, ranges and loops to tokens.

use proc_macro2::{Literal, TokenStream};
use quote::quote;
use syn::Ident;

use super::{Emitter, local};
use crate::internal::internal;
use crate::symbolic::{Atom, Count, Index, Loop, Rows};

pub(super) fn open(depth: u32) -> Ident {
    local(format_args!("i{depth}"))
}

fn plain(value: u64) -> Literal {
    match usize::try_from(value) {
        Ok(value) => Literal::usize_suffixed(value),
        Err(_) => internal("an index beyond all sizes"),
    }
}

/// `a * b`, of one factor at least.
fn product(factors: impl Iterator<Item = TokenStream>) -> TokenStream {
    let product = factors.reduce(|before, factor| quote!(#before * #factor));
    product.unwrap_or_else(|| internal("a product without factors"))
}

impl Emitter<'_> {
    /// An index as an expression of type `usize`; negative intermediate values do not occur.
    pub(crate) fn index(&self, index: &Index) -> TokenStream {
        self.difference(index, &quote!(wrapping_sub))
    }

    /// The bound of a range: a negative one is zero.
    pub(crate) fn range_bound(&self, index: &Index) -> TokenStream {
        self.difference(index, &quote!(saturating_sub))
    }

    /// The number of members of a family.
    pub(crate) fn length(&self, length: &Count) -> TokenStream {
        match (length.as_literal(), &length.rows) {
            (Some(literal), Some(_)) => self.index(&Index::literal(literal)),
            (None, Some(rows)) => self.rows(rows),
            (_, None) => self.range_bound(&length.rest),
        }
    }

    /// The number of a member of a family.
    pub(super) fn member(&self, member: &Count) -> TokenStream {
        let place = self.index(&member.rest);
        match &member.rows {
            Some(rows) => {
                let rows = self.rows(rows);
                quote!(#rows + #place)
            }
            None => place,
        }
    }

    fn rows(&self, Rows { first, step, count }: &Rows) -> TokenStream {
        let (krate, first, count) = (self.krate(), self.signed_index(first), self.range_bound(count));
        let step = Literal::i64_suffixed(*step);
        quote!(#krate::__private::members_before(#first, #step, #count))
    }

    fn difference(&self, index: &Index, subtract: &TokenStream) -> TokenStream {
        let (mut above, mut below) = (Vec::new(), Vec::new());
        for (atom, coefficient) in index.counted_terms() {
            let atom = self.atom(atom);
            let factor = plain(coefficient.unsigned_abs());
            let term = if coefficient.abs() == 1 { atom } else { quote!(#factor * #atom) };
            if *coefficient > 0 { above.push(term) } else { below.push(term) }
        }
        let constant = plain(index.constant.unsigned_abs());
        match index.constant {
            0 if !above.is_empty() => {}
            0.. => above.push(quote!(#constant)),
            _ => below.push(quote!(#constant)),
        }
        let above = if above.is_empty() { quote!(0usize) } else { quote!(#(#above)+*) };
        if below.is_empty() { above } else { quote!((#above).#subtract(#(#below)+*)) }
    }

    fn atom(&self, atom: &Atom) -> TokenStream {
        match atom {
            Atom::Open(depth) => {
                let open = open(*depth);
                quote!(#open)
            }
            Atom::Bound(_) => internal("an index outside of its sum"),
            Atom::Size(size) => self.model.sizes[size.0 as usize].tokens.clone(),
            Atom::Remainder(value, modulus) => {
                let krate = self.krate();
                let (value, modulus) = (self.signed_index(value), self.signed_index(modulus));
                quote!(#krate::__private::wrap(#value, #modulus))
            }
            Atom::Product(factors) => {
                let product = product(factors.iter().map(|factor| self.atom(factor)));
                quote!((#product))
            }
            Atom::Row(row, length) => {
                let [row, length] = [row, length].map(|index| self.index(index));
                quote!((#length) * (#row))
            }
        }
    }

    /// An index as an expression of type `i64`.
    pub(crate) fn signed_index(&self, index: &Index) -> TokenStream {
        self.integer(index, &quote!(::core::primitive::i64), Literal::i64_suffixed)
    }

    /// An index as an expression of type `i128`, which no size makes overflow.
    pub(crate) fn wide_index(&self, index: &Index) -> TokenStream {
        self.integer(index, &quote!(::core::primitive::i128), |value| Literal::i128_suffixed(value.into()))
    }

    fn integer(&self, index: &Index, kind: &TokenStream, literal: fn(i64) -> Literal) -> TokenStream {
        let constant = literal(index.constant);
        let mut terms = vec![quote!(#constant)];
        for (atom, coefficient) in index.counted_terms() {
            let (atom, coefficient) = (self.integer_atom(atom, kind), literal(*coefficient));
            terms.push(quote!(#coefficient * #atom));
        }
        quote!((#(#terms)+*))
    }

    fn integer_atom(&self, atom: &Atom, kind: &TokenStream) -> TokenStream {
        match atom {
            Atom::Remainder(value, modulus) => {
                let krate = self.krate();
                let (value, modulus) = (self.signed_index(value), self.signed_index(modulus));
                quote!((#krate::__private::remainder(#value, #modulus) as #kind))
            }
            Atom::Open(_) | Atom::Bound(_) | Atom::Size(_) => {
                let value = self.atom(atom);
                quote!((#value as #kind))
            }
            Atom::Product(factors) => product(factors.iter().map(|factor| self.integer_atom(factor, kind))),
            Atom::Row(..) => internal("a place in a row is checked by its two indices"),
        }
    }

    pub(crate) fn loop_over(&self, over: &Loop, body: &TokenStream) -> TokenStream {
        let index = open(over.depth);
        let [lower, upper] = [&over.range.lower, &over.range.upper].map(|bound| self.range_bound(bound));
        let except = over.range.left_out().map(|except| {
            let except = self.index(except);
            quote!(if #index == #except { continue; })
        });
        quote!(for #index in (#lower)..(#upper) { #(#except)* #body })
    }

    /// Whether an index cannot leave 0..`length`, whatever the sizes are.
    pub(crate) fn stays_inside(&self, index: &Index, length: &Index, loops: &[Loop]) -> bool {
        let is_natural = |index: &Index| index.as_literal().is_some_and(|value| value >= 0);
        match (index.constant, index.terms.as_slice()) {
            (_, []) => {
                is_natural(index) && length.as_literal().is_some_and(|length| index.constant < length)
            }
            (0, [(Atom::Open(depth), 1)]) => {
                loops.iter().any(|over| over.depth == *depth && over.range.upper == *length)
            }
            (0, [(Atom::Remainder(_, modulus), 1)]) => **modulus == *length && is_natural(length),
            _ => false,
        }
    }
}
