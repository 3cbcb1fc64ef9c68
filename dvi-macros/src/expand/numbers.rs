//! The name of the type of numbers in generated code, which users read in messages and documentation.

use proc_macro2::{Group, Ident, Span, TokenStream, TokenTree};
use syn::ext::IdentExt as _;

/// As the stages write it: nobody else's.
const INTERNAL: &str = "__T";

/// What it is called where the user has nothing of that name.
const NAMES: [&str; 4] = ["T", "Number", "Numbers", "Scalar"];

/// The first of the names that stands nowhere in the attribute and the item.
pub(super) fn name<'a>(inputs: impl IntoIterator<Item = &'a TokenStream> + Clone) -> &'static str {
    let is_free = |name: &&str| !inputs.clone().into_iter().any(|input| mentions(input, name));
    NAMES.into_iter().find(is_free).unwrap_or(INTERNAL)
}

fn mentions(tokens: &TokenStream, name: &str) -> bool {
    tokens.clone().into_iter().any(|token| match token {
        TokenTree::Ident(ident) => ident.unraw() == name,
        TokenTree::Group(group) => mentions(&group.stream(), name),
        TokenTree::Punct(_) | TokenTree::Literal(_) => false,
    })
}

/// `tokens` with the type of numbers called `name`.
pub(super) fn named(tokens: TokenStream, name: &str) -> TokenStream {
    let rename = |token: TokenTree| match token {
        TokenTree::Ident(ident) if ident == INTERNAL => Ident::new(name, in_place(ident.span())).into(),
        TokenTree::Group(group) => {
            let mut renamed = Group::new(group.delimiter(), named(group.stream(), name));
            renamed.set_span(group.span());
            renamed.into()
        }
        token => token,
    };
    tokens.into_iter().map(rename).collect()
}

/// The user's own names are not what it is resolved to.
fn in_place(span: Span) -> Span {
    span.resolved_at(Span::mixed_site())
}
