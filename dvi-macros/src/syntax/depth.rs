//! How deep the parts of a formula may nest.
//!
//! Parsers call themselves: for brackets in brackets, and for what nests without brackets, such as
//! `- - - x` or `a = b = c`; and a long chain of operators is a deep tree. This bounds the depth of the calls before the first of them, so that no
//! input exhausts the compiler's stack.

use proc_macro2::{TokenStream, TokenTree};

const DEEPEST: usize = 200;

/// Tokens between two separators.
const LONGEST: usize = 4096;

/// Words behind which an expression, a pattern or a type goes on.
#[rustfmt::skip]
const OPENING: [&str; 20] = [
    "async", "break", "const", "dyn", "else", "extern", "fn", "for", "if", "impl",
    "let", "loop", "match", "move", "mut", "raw", "return", "unsafe", "while", "yield",
];

/// # Errors
/// The first token that is too deep.
pub(crate) fn check(tokens: &TokenStream) -> syn::Result<()> {
    check_inside(tokens, DEEPEST)
}

fn check_inside(tokens: &TokenStream, room: usize) -> syn::Result<()> {
    // What nests up to the next separator, and types in types, which separators do not end.
    let (mut here, mut angles) = (0, 0);
    let mut length = 0;
    let mut behind_operator = true;
    for token in tokens.clone() {
        match &token {
            TokenTree::Group(group) => match room.checked_sub(here + angles + 1) {
                Some(room) => check_inside(&group.stream(), room)?,
                None => return Err(too_deep(&token)),
            },
            TokenTree::Punct(punct) => match punct.as_char() {
                ',' | ';' => (here, length) = (0, 0),
                '<' => angles += 1,
                '=' | '|' => here += 1,
                _ => here += usize::from(behind_operator),
            },
            TokenTree::Ident(word) => here += usize::from(OPENING.iter().any(|opening| word == opening)),
            TokenTree::Literal(_) => {}
        }
        behind_operator = matches!(token, TokenTree::Punct(_));
        length += 1;
        if here + angles > room || length > LONGEST {
            return Err(too_deep(&token));
        }
    }
    Ok(())
}

fn too_deep(token: &TokenTree) -> syn::Error {
    syn::Error::new(token.span(), "this is nested too deeply, or too long; give its parts names with `let`")
}
