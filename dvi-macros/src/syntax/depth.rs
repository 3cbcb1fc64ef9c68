//! How deep the parts of a formula may nest, and how long they may be.
//!
//! Parsers call themselves: for brackets in brackets, and for what nests without brackets, such as `- - - x`
//! or `a = b = c`; and a long chain of operators is a deep tree. This bounds the depth of the calls before
//! the first of them, so that no input exhausts the compiler's stack. The terms of a sum are no chain:
//! [`tidy`](super::tidy) makes a low tree of them.

use proc_macro2::{TokenStream, TokenTree};

const DEEPEST: usize = 200;

/// Tokens between two separators of formulas.
pub(super) const LONGEST: usize = 100_000;

/// Tokens between two separators where they are in no formula, and between two signs of a sum.
pub(crate) const LONGEST_TERM: usize = 4096;

/// Operators between two separators that bind more loosely than `+`, with the tokens that they are made of.
const MOST_LOOSE: usize = 1024;

/// Words behind which an expression, a pattern or a type goes on.
#[rustfmt::skip]
pub(super) const OPENING: [&str; 20] = [
    "async", "break", "const", "dyn", "else", "extern", "fn", "for", "if", "impl",
    "let", "loop", "match", "move", "mut", "raw", "return", "unsafe", "while", "yield",
];

/// Whether no more than the `longest` stand between two separators, and none are too deep.
///
/// # Errors
/// The first token that is too deep or too far behind.
pub(crate) fn check(tokens: &TokenStream, longest: usize) -> syn::Result<()> {
    check_inside(tokens, DEEPEST, longest)
}

fn check_inside(tokens: &TokenStream, room: usize, longest: usize) -> syn::Result<()> {
    // What nests up to the next separator, and types in types, which separators do not end.
    let (mut here, mut angles) = (0, 0);
    let (mut length, mut term, mut loose) = (0, 0, 0);
    let mut behind_operator = true;
    for token in tokens.clone() {
        match &token {
            TokenTree::Group(group) => match room.checked_sub(here + angles + 1) {
                Some(room) => check_inside(&group.stream(), room, longest)?,
                None => return Err(too_deep(&token)),
            },
            TokenTree::Punct(punct) => match punct.as_char() {
                ',' | ';' => (here, length, term, loose) = (0, 0, 0, 0),
                '<' => angles += 1,
                '=' | '|' => here += 1,
                '+' | '-' if !behind_operator => term = 0,
                '&' | '^' | '>' => loose += 1,
                _ => here += usize::from(behind_operator),
            },
            TokenTree::Ident(word) => here += usize::from(OPENING.iter().any(|opening| word == opening)),
            TokenTree::Literal(_) => {}
        }
        behind_operator = matches!(token, TokenTree::Punct(_));
        length += 1;
        term += 1;
        if here + angles > room || loose > MOST_LOOSE {
            return Err(too_deep(&token));
        }
        if length > longest {
            let message = format!("this is longer than {longest} tokens; give its parts names with `let`");
            return Err(syn::Error::new(token.span(), message));
        }
        if term > LONGEST_TERM {
            let message =
                format!("this term is longer than {LONGEST_TERM} tokens; give its parts names with `let`");
            return Err(syn::Error::new(token.span(), message));
        }
    }
    Ok(())
}

fn too_deep(token: &TokenTree) -> syn::Error {
    let message = format!(
        "more than {DEEPEST} brackets, signs or conditions are nested here; give the inner ones names with \
         `let`"
    );
    syn::Error::new(token.span(), message)
}
