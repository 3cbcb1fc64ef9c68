//! The names in generated code that users read in messages and documentation: that of the type of numbers,
//! and those of generics and arguments of functions, which are called nearly as in the traits.

use proc_macro2::{Ident, Span, TokenStream, TokenTree};
use syn::ext::IdentExt as _;

use crate::syntax::tidy;

/// The type as the stages write it: nobody else's.
const INTERNAL: &str = "__T";

/// What it is called where the user has nothing of that name.
const NUMBERS: [&str; 4] = ["T", "Number", "Numbers", "Scalar"];

/// Generics besides, and what they are called where the user has nothing of that name. A type `W` beside the
/// system would hide a constant `W`.
const GENERICS: [(&str, &str); 2] = [("__K", "K"), ("__W", "LANES")];

/// Arguments as the stages write them, and what they are called where the user has nothing of the first name:
/// as in the traits but for the last letter, since a constant of the user's may be called `q` or `t`, and no
/// argument can be called as a constant is.
#[rustfmt::skip]
const ARGUMENTS: [(&str, &str); 19] = [
    ("__q",          "q_"),
    ("__v",          "v_"),
    ("__t",          "t_"),
    ("__vector",     "out_"),
    ("__g",          "out_"),
    ("__l_q",        "l_q_"),
    ("__l_v",        "l_v_"),
    ("__w",          "w_"),
    ("__weights",    "w_"),
    ("__a",          "a_"),
    ("__b",          "b_"),
    ("__sink",       "sink_"),
    ("__index",      "index_"),
    ("__i",          "i_"),
    ("__coordinate", "coordinate_"),
    ("__axis",       "axis_"),
    ("__body",       "body_"),
    ("__block",      "block_"),
    ("__len",        "block_len_"),
];

/// What is renamed, and to what.
pub(super) type Renaming = Vec<(&'static str, &'static str)>;

/// For an attribute and the item below it.
pub(super) fn renaming(inputs: [&TokenStream; 2]) -> Renaming {
    let mut taken = Vec::new();
    inputs.into_iter().for_each(|input| mentioned(input, &mut taken));
    let is_free = |name: &str| !taken.contains(&name);
    let numbers = NUMBERS.into_iter().find(|name| is_free(name)).map(|name| (INTERNAL, name));
    let generics = GENERICS.into_iter().filter(|(_, name)| is_free(name));
    let arguments = ARGUMENTS.into_iter().filter(|(internal, _)| is_free(internal));
    numbers.into_iter().chain(generics).chain(arguments).collect()
}

/// Adds those of the names above that stand in `tokens`.
fn mentioned(tokens: &TokenStream, taken: &mut Vec<&'static str>) {
    for token in tokens.clone() {
        match token {
            TokenTree::Ident(ident) => {
                let text = ident.unraw().to_string();
                let generics = GENERICS.map(|(_, name)| name);
                let arguments = ARGUMENTS.map(|(internal, _)| internal);
                let mut known = NUMBERS.into_iter().chain(generics).chain(arguments);
                taken.extend(known.find(|name| *name == text));
            }
            TokenTree::Group(group) => mentioned(&group.stream(), taken),
            TokenTree::Punct(_) | TokenTree::Literal(_) => {}
        }
    }
}

/// `tokens` with the names that users read.
pub(super) fn renamed(tokens: TokenStream, renaming: &Renaming) -> TokenStream {
    tidy::renamed(tokens, |ident| {
        let (_, name) = renaming.iter().find(|(internal, _)| ident == internal)?;
        // The user's own names are not what it is resolved to, nor is it what they are.
        Some(Ident::new(name, ident.span().resolved_at(Span::mixed_site())))
    })
}
