//! The error accumulator: one bad line never hides the next.

use rustc_hash::FxHashSet as HashSet;

use proc_macro2::TokenStream;
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

    /// The first error as an expression; it is not reported elsewhere.
    pub(crate) fn take_first(&mut self) -> TokenStream {
        match self.found.is_empty() {
            true => TokenStream::new(),
            false => self.found.remove(0).into_compile_error(),
        }
    }

    pub(crate) fn into_tokens(self) -> TokenStream {
        self.found.into_iter().map(|error| error.into_compile_error()).collect()
    }
}

/// The nearest of the declared names, if one is near: a few letters apart, and not all of them.
pub(crate) fn nearest<'a>(name: &str, declared: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let length = name.chars().count();
    let allowed = (1 + length / 4).min(length.saturating_sub(1));
    declared
        .into_iter()
        .map(|candidate| (edit_distance(name, candidate), candidate))
        .filter(|(distance, _)| *distance <= allowed)
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, candidate)| candidate)
}

/// The three declared names that are nearest.
pub(crate) fn similar<'a>(name: &str, declared: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    let mut names: Vec<&str> = declared.into_iter().collect();
    names.sort_by_key(|candidate| edit_distance(name, candidate));
    names.truncate(3);
    names
}

/// Levenshtein's distance, case folded.
fn edit_distance(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) =
        (a.to_lowercase().chars().collect(), b.to_lowercase().chars().collect());
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, from) in a.iter().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, to) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(from != to);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(row[j + 1] + 1);
        }
    }
    row[b.len()]
}

/// `a`, `b` and `c`
pub(crate) fn listed<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
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
    ] {
        text = text.replace(spaced, tight);
    }
    text
}
