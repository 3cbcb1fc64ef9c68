//! What is no Rust, and is written so elsewhere: found where an expression could not be read, with what to
//! write instead.

use proc_macro2::{Delimiter, Spacing, TokenStream, TokenTree};

use crate::errors::text;

const CHOICE: &str = "a choice is written `if a < b { x } else { y }`";

/// The first of it.
pub(super) fn mistaken(tokens: TokenStream) -> Option<syn::Error> {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    let inside = |token: &TokenTree| match token {
        TokenTree::Group(group) => mistaken(group.stream()),
        TokenTree::Ident(_) | TokenTree::Punct(_) | TokenTree::Literal(_) => None,
    };
    (0..tokens.len()).find_map(|at| here(&tokens[..at], &tokens[at..]).or_else(|| inside(&tokens[at])))
}

fn is_value(token: Option<&TokenTree>) -> bool {
    token.is_some_and(|token| !matches!(token, TokenTree::Punct(_)))
}

fn is(token: Option<&TokenTree>, punct: char) -> bool {
    matches!(token, Some(TokenTree::Punct(found)) if found.as_char() == punct)
}

fn error(at: &[TokenTree], message: impl std::fmt::Display) -> Option<syn::Error> {
    let at: TokenStream = at.iter().cloned().collect();
    Some(syn::Error::new_spanned(at, message))
}

/// At the first of the tokens `rest`, with those `before`.
fn here(before: &[TokenTree], rest: &[TokenTree]) -> Option<syn::Error> {
    let at = rest.get(..1)?;
    match rest.first()? {
        TokenTree::Punct(bar) if bar.as_char() == '|' && bar.spacing() == Spacing::Alone => {
            absolute_value(before, rest)
        }
        // a < b ? x : y
        TokenTree::Punct(mark) if mark.as_char() == '?' && rest.iter().any(|token| is(Some(token), ':')) => {
            error(at, CHOICE)
        }
        TokenTree::Ident(word) => match (word.to_string().as_str(), rest.get(1)) {
            // x if a < b else y
            ("if", _) if matches!(before.last(), Some(TokenTree::Ident(before)) if before == "else") => None,
            ("if" | "then", _) if is_value(before.last()) => error(at, CHOICE),
            ("where", Some(TokenTree::Group(_))) => error(at, CHOICE),
            ("mod", Some(TokenTree::Group(_))) => {
                error(at, format!("a remainder has no derivative where it jumps; {CHOICE}"))
            }
            _ => None,
        },
        // f[x, y]
        TokenTree::Group(list) if list.delimiter() == Delimiter::Bracket => {
            let is_list = list.stream().into_iter().any(|token| is(Some(&token), ','));
            let Some(TokenTree::Ident(name)) = before.last().filter(|_| is_list) else { return None };
            let inside = list.stream();
            let message = format!(
                "an index has brackets of its own, as in `{name}[i][j]`; a function is called as \
                 `{name}({})`",
                text(&inside)
            );
            error(at, message)
        }
        TokenTree::Group(_) | TokenTree::Punct(_) | TokenTree::Literal(_) => None,
    }
}

/// |x|, which is no closure.
fn absolute_value(before: &[TokenTree], rest: &[TokenTree]) -> Option<syn::Error> {
    if is_value(before.last()) {
        return None;
    }
    let end = 1 + rest.get(1..)?.iter().position(|token| is(Some(token), '|'))?;
    let inside = &rest[1..end];
    let is_index = |token: &TokenTree| matches!(token, TokenTree::Ident(_)) || is(Some(token), ',');
    let has_body = match rest.get(end + 1) {
        Some(TokenTree::Punct(punct)) => ['-', '*', '&', '!', '|'].contains(&punct.as_char()),
        other => other.is_some(),
    };
    if inside.is_empty() || (has_body && inside.iter().all(is_index)) {
        return None;
    }
    let of: TokenStream = inside.iter().cloned().collect();
    let of = if inside.len() == 1 { text(&of) } else { format!("({})", text(&of)) };
    error(&rest[..=end], format!("an absolute value is written `{of}.abs()`"))
}
