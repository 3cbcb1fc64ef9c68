//! Spellings that mean the same, made one before anything is read.
//!
//! - `r#x` is `x`, as in Rust.
//! - What a `macro_rules` has put in a place is a group without brackets in the tokens, and here the
//!   expression that it holds.
//! - A long sum `t0 + t1 - t2 + …` is a tree as deep as it is long, which the compiler's stack does not
//!   bear. Its terms are put into such groups first, `t0 + ⟨t1 - t2 + …⟩ + …`, and groups of groups, so that
//!   the tree is low.

use proc_macro2::{Delimiter, Group, Ident, Punct, Spacing, TokenStream, TokenTree};
use syn::ext::IdentExt as _;
use syn::visit_mut::{self, VisitMut};
use syn::{Expr, ExprParen, token};

use super::depth::OPENING;

/// `tokens` in which each name has one spelling.
pub(crate) fn names(tokens: TokenStream) -> TokenStream {
    renamed(tokens, plain)
}

/// `tokens` with other names, for those names that have another one.
pub(crate) fn renamed(tokens: TokenStream, other: impl Fn(&Ident) -> Option<Ident> + Copy) -> TokenStream {
    replaced(tokens, |tokens| {
        let mut changes = false;
        let rename = |token| match token {
            TokenTree::Ident(ident) => {
                let name = other(&ident);
                changes |= name.is_some();
                name.unwrap_or(ident).into()
            }
            token => token,
        };
        (tokens.into_iter().map(rename).collect(), changes)
    })
    .0
}

/// `x` for `r#x`. Keywords keep their `r#`; so does `gen`, which is one from the edition 2024 on.
fn plain(ident: &Ident) -> Option<Ident> {
    let plain = ident.unraw();
    let is_keyword = || plain == "gen" || syn::parse_str::<Ident>(&plain.to_string()).is_err();
    (plain != *ident && !is_keyword()).then_some(plain)
}

/// `tokens` in which no sum has more than [`TERMS`] terms beside one another.
pub(super) fn sums(tokens: TokenStream) -> TokenStream {
    replaced(tokens, |tokens| {
        let mut changes = false;
        let mut low = Vec::new();
        let mut sum = Sum::default();
        for (position, token) in tokens.iter().enumerate() {
            if sum.is_over_at(token, tokens.get(position + 1)) {
                changes |= std::mem::take(&mut sum).write(&mut low);
                low.push(token.clone());
            } else {
                sum.push(token.clone());
            }
        }
        changes |= sum.write(&mut low);
        (low, changes)
    })
    .0
}

/// The tokens that `change` makes of these and of those in groups, from the innermost on, and whether it
/// changes any: groups in which it does not keep the places of their brackets.
pub(crate) fn replaced(
    tokens: TokenStream,
    change: impl Fn(Vec<TokenTree>) -> (Vec<TokenTree>, bool) + Copy,
) -> (TokenStream, bool) {
    let mut inside = false;
    let tokens = tokens.into_iter().map(|token| {
        let TokenTree::Group(group) = &token else { return token };
        match replaced(group.stream(), change) {
            (_, false) => token,
            (stream, true) => {
                inside = true;
                let mut renewed = Group::new(group.delimiter(), stream);
                renewed.set_span(group.span());
                renewed.into()
            }
        }
    });
    let tokens: Vec<TokenTree> = tokens.collect();
    let (tokens, here) = change(tokens);
    (tokens.into_iter().collect(), inside || here)
}

/// So many terms of a sum stand beside one another.
const TERMS: usize = 64;

/// The tokens of a sum, or of what begins like one.
#[derive(Default)]
struct Sum {
    /// What stands in front of the first sign.
    first: Vec<TokenTree>,
    terms: Vec<Term>,
}

struct Term {
    sign: Punct,
    tokens: Vec<TokenTree>,
}

impl Sum {
    /// Whether a token binds as loosely as `+` or more loosely, or what it means is not known here.
    fn is_over_at(&self, token: &TokenTree, next: Option<&TokenTree>) -> bool {
        match token {
            TokenTree::Group(group) => group.delimiter() == Delimiter::Brace,
            TokenTree::Literal(_) => false,
            TokenTree::Ident(word) => word == "in" || OPENING.iter().any(|opening| word == opening),
            TokenTree::Punct(punct) => match punct.as_char() {
                '*' | '/' | '%' | ':' => false,
                '.' => punct.spacing() == Spacing::Joint,
                // `+=` and `->`
                '+' | '-' => {
                    punct.spacing() == Spacing::Joint
                        && matches!(next, Some(TokenTree::Punct(next)) if ['=', '>'].contains(&next.as_char()))
                }
                _ => true,
            },
        }
    }

    fn push(&mut self, token: TokenTree) {
        let last = self.terms.last_mut().map_or(&mut self.first, |term| &mut term.tokens);
        // Behind an operator, `-` is the sign of what follows.
        let is_behind_value = last.last().is_some_and(|token| !matches!(token, TokenTree::Punct(_)));
        match token {
            TokenTree::Punct(sign) if is_behind_value && ['+', '-'].contains(&sign.as_char()) => {
                self.terms.push(Term { sign, tokens: Vec::new() });
            }
            token => last.push(token),
        }
    }

    /// Whether it was too long.
    fn write(mut self, tokens: &mut Vec<TokenTree>) -> bool {
        let is_long = self.terms.len() > TERMS;
        while self.terms.len() > TERMS {
            let mut groups = Vec::new();
            let mut terms = self.terms.into_iter().peekable();
            while terms.peek().is_some() {
                groups.extend(Term::group(terms.by_ref().take(TERMS)));
            }
            self.terms = groups;
        }
        tokens.extend(self.first);
        tokens.extend(self.terms.into_iter().flat_map(Term::tokens));
        is_long
    }
}

impl Term {
    /// `+ ⟨t1 - t2⟩` for `+ t1 - t2`, and `+ ⟨- t1 - t2⟩` for `- t1 - t2`.
    fn group(terms: impl Iterator<Item = Self>) -> Option<Self> {
        let mut tokens: Vec<TokenTree> = terms.flat_map(Self::tokens).collect();
        let TokenTree::Punct(first) = tokens.first()?.clone() else { return None };
        let mut sign = Punct::new('+', Spacing::Alone);
        sign.set_span(first.span());
        if first.as_char() == '+' {
            tokens.remove(0);
        }
        let end = tokens.last()?.span();
        let mut group = Group::new(Delimiter::None, tokens.into_iter().collect());
        group.set_span(end);
        Some(Self { sign, tokens: vec![group.into()] })
    }

    fn tokens(self) -> impl Iterator<Item = TokenTree> {
        [TokenTree::Punct(self.sign)].into_iter().chain(self.tokens)
    }
}

/// The expressions in place of the groups without brackets that hold them.
pub(crate) struct Ungrouped;

impl VisitMut for Ungrouped {
    fn visit_expr_mut(&mut self, syntax: &mut Expr) {
        while let Expr::Group(group) = syntax {
            let expr = std::mem::replace(&mut group.expr, Box::new(Expr::PLACEHOLDER));
            let paren_token = token::Paren(group.group_token.span);
            *syntax = match *expr {
                // As it has to be written.
                Expr::Binary(_) => Expr::Paren(ExprParen { attrs: Vec::new(), paren_token, expr }),
                expr => expr,
            };
        }
        visit_mut::visit_expr_mut(self, syntax);
    }
}

#[cfg(test)]
mod tests {
    use quote::quote;
    use syn::parse::Parser as _;

    use super::*;

    #[test]
    fn a_name_has_one_spelling() {
        let tidied = names(quote!(r#x + f(r#x[r#j], r#type, r#gen) + self.r#y));
        assert_eq!(tidied.to_string(), quote!(x + f(x[j], r#type, r#gen) + self.y).to_string());
    }

    /// How deep operators stand inside of one another.
    fn depth(syntax: &Expr) -> usize {
        match syntax {
            Expr::Binary(binary) => 1 + depth(&binary.left).max(depth(&binary.right)),
            Expr::Unary(unary) => 1 + depth(&unary.expr),
            Expr::Paren(inner) => depth(&inner.expr),
            _ => 0,
        }
    }

    fn sign(punct: char) -> TokenTree {
        Punct::new(punct, Spacing::Alone).into()
    }

    /// The value at x = 1.
    fn value(syntax: &Expr) -> i64 {
        match syntax {
            Expr::Lit(syn::ExprLit { lit: syn::Lit::Int(number), .. }) => {
                number.base10_parse().expect("an integer")
            }
            Expr::Path(_) => 1,
            Expr::Paren(inner) => value(&inner.expr),
            Expr::Unary(unary) => -value(&unary.expr),
            Expr::Binary(binary) => match binary.op {
                syn::BinOp::Add(_) => value(&binary.left) + value(&binary.right),
                syn::BinOp::Sub(_) => value(&binary.left) - value(&binary.right),
                _ => value(&binary.left) * value(&binary.right),
            },
            _ => unreachable!("it is made of these"),
        }
    }

    #[test]
    fn a_long_sum_is_a_low_tree_of_the_same_value() {
        let mut tokens = quote!(7 * -x);
        let mut expected = -7;
        for n in 1..20_000_i64 {
            let minus = n % 3 == 0;
            let number = proc_macro2::Literal::i64_unsuffixed(n);
            tokens.extend([sign(if minus { '-' } else { '+' })]);
            tokens.extend(quote!(#number * x));
            expected += if minus { -n } else { n };
        }
        let parse = |input: syn::parse::ParseStream<'_>| super::super::cut::expression(input);
        let sum = parse.parse2(sums(quote!({ let a = #tokens; a }))).expect("a block");
        let Expr::Block(block) = sum else { panic!("a block") };
        let Some(syn::Stmt::Local(local)) = block.block.stmts.first() else { panic!("a binding") };
        let sum = &local.init.as_ref().expect("a value").expr;
        assert_eq!(value(sum), expected);
        assert!(depth(sum) < 250, "{}", depth(sum));
    }

    #[test]
    fn what_is_no_sum_is_no_group() {
        let list = std::iter::repeat_n(quote!(a < b + c), 100);
        let tokens = quote!(if #(#list)&&* { x } else { y });
        assert_eq!(sums(tokens.clone()).to_string(), tokens.to_string());
    }
}
