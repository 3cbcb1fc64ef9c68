//! The error accumulator: one bad line never hides the next.

use rustc_hash::FxHashSet as HashSet;

use proc_macro2::{TokenStream, TokenTree};
use quote::ToTokens;

/// Errors of all stages, in the order in which they were found.
#[derive(Debug, Default)]
pub(crate) struct Errors {
    found: Vec<syn::Error>,
    said: HashSet<String>,
}

impl Errors {
    /// An error on `at` that says what is wrong and what to write.
    pub(crate) fn push(&mut self, at: impl ToTokens, message: impl std::fmt::Display) {
        self.found.push(syn::Error::new_spanned(at, message));
    }

    /// The same, once for each `kind`.
    pub(crate) fn push_once(&mut self, kind: &str, at: impl ToTokens, message: impl std::fmt::Display) {
        if self.said.insert(kind.to_string()) {
            self.push(at, message);
        }
    }

    /// An error, and nothing in the place of what it is on.
    pub(crate) fn refuse<T>(&mut self, at: impl ToTokens, message: impl std::fmt::Display) -> Option<T> {
        self.push(at, message);
        None
    }

    /// The same, once for each `kind`.
    pub(crate) fn refuse_once<T>(
        &mut self,
        kind: &str,
        at: impl ToTokens,
        message: impl std::fmt::Display,
    ) -> Option<T> {
        self.push_once(kind, at, message);
        None
    }

    pub(crate) fn push_syn(&mut self, error: syn::Error) {
        self.found.push(error);
    }

    /// What was read, or nothing where that was reported.
    pub(crate) fn taken<T>(&mut self, read: syn::Result<T>) -> Option<T> {
        read.map_err(|error| self.push_syn(error)).ok()
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.found.is_empty()
    }

    pub(crate) fn count(&self) -> usize {
        self.found.len()
    }

    /// The first error as an expression; it is not reported elsewhere.
    pub(crate) fn take_first(&mut self) -> TokenStream {
        match self.found.is_empty() {
            true => TokenStream::new(),
            false => compile_error(self.found.remove(0)),
        }
    }

    pub(crate) fn into_tokens(self) -> TokenStream {
        self.found.into_iter().map(compile_error).collect()
    }
}

/// `compile_error! { "…" }` where the errors are. In a crate of the edition 2015 `::core` in front of it
/// would be a module of that crate.
fn compile_error(errors: syn::Error) -> TokenStream {
    let is_path = |token: &TokenTree| !matches!(token, TokenTree::Ident(name) if name == "compile_error");
    errors.into_iter().flat_map(|error| error.into_compile_error().into_iter().skip_while(is_path)).collect()
}

/// The nearest of the declared names, if one is a slip of the pen away: one letter more, less, other, or in
/// the place of its neighbour; two in a long name. Of a short name one letter is too much of it.
pub(crate) fn nearest<'a>(name: &str, declared: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let allowed = match name.chars().count() {
        0..=1 => 0,
        2..=7 => 1,
        _ => 2,
    };
    declared
        .into_iter()
        .map(|candidate| (edit_distance(name, candidate), candidate))
        .filter(|(distance, _)| *distance <= allowed)
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, candidate)| candidate)
}

/// The distance of Damerau and Levenshtein between neighbours, case folded.
fn edit_distance(a: &str, b: &str) -> usize {
    let [a, b] = [a, b].map(|name| name.to_lowercase().chars().collect::<Vec<char>>());
    let first: Vec<usize> = (0..=b.len()).collect();
    let mut rows = vec![first];
    for (i, from) in a.iter().enumerate() {
        let mut row = vec![i + 1];
        for (j, to) in b.iter().enumerate() {
            let replaced = rows[i][j] + usize::from(from != to);
            let mut least = replaced.min(rows[i][j + 1] + 1).min(row[j] + 1);
            if i > 0 && j > 0 && a[i - 1] == *to && b[j - 1] == *from {
                least = least.min(rows[i - 1][j - 1] + 1);
            }
            row.push(least);
        }
        rows.push(row);
    }
    rows[a.len()][b.len()]
}

/// `none`, `one`, `2`, behind `here is` or `here are`.
pub(crate) fn here(count: usize) -> String {
    match count {
        0 => "here are none".into(),
        1 => "here is one".into(),
        many => format!("here are {many}"),
    }
}

/// `a`, `b` and `c`
pub(crate) fn listed(names: impl IntoIterator<Item = impl std::fmt::Display>) -> String {
    let quoted: Vec<String> = names.into_iter().map(|name| format!("`{name}`")).collect();
    match quoted.as_slice() {
        [] => String::new(),
        [single] => single.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

/// Code as it is usually written: `N + 1`, `self.p.m`, `x[j]`.
pub(crate) fn text(code: &impl ToTokens) -> String {
    let mut text = code.to_token_stream().to_string();
    for (spaced, tight) in [
        (" . ", "."),
        (" .. ", ".."),
        (" [", "["),
        ("[ ", "["),
        (" ]", "]"),
        ("( ", "("),
        (" )", ")"),
        (" (", "("),
        ("(- ", "(-"),
    ] {
        text = text.replace(spaced, tight);
    }
    text.strip_prefix("- ").map(|negated| format!("-{negated}")).unwrap_or(text)
}

#[test]
fn the_nearest_name_is_a_slip_of_the_pen_away() {
    let names = ["omega", "x", "sin", "cos", "coordinates", "sinh"];
    let near = |name| nearest(name, names);
    assert_eq!(near("omgea"), Some("omega"));
    assert_eq!(near("omega0"), Some("omega"));
    assert_eq!(near("sni"), Some("sin"));
    assert_eq!(near("cordinate"), Some("coordinates"));
    for name in ["y", "sec", "sincos", "theta", "amigo", "heaviside", "norm"] {
        assert_eq!(near(name), None, "{name}");
    }
}

#[test]
fn an_error_is_no_path_of_one_edition() {
    let error = || syn::Error::new(proc_macro2::Span::call_site(), "what to write");
    let mut errors = error();
    errors.combine(error());
    let text = compile_error(errors).to_string();
    assert_eq!(text.matches("compile_error").count(), 2, "{text}");
    assert!(!text.contains(':'), "{text}");
}
