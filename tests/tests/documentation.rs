//! What the pages of the documentation hold for those who open one of them, read from the sources.

mod examples;
mod methods;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// The folder of the sources of the core.
fn core() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../dvi-core/src")
}

fn read(file: &str) -> String {
    fs::read_to_string(core().join(file)).expect("a file of the core")
}

/// The files of a module.
fn files(module: &str) -> Vec<PathBuf> {
    let folder = core().join(module);
    let mut files = if folder.is_dir() { crate::imports::files(&folder) } else { Vec::new() };
    files.push(core().join(format!("{module}.rs")));
    files.retain(|file| file.extension().is_some_and(|kind| kind == "rs"));
    files
}

/// The words of a text that are names.
pub(crate) fn names(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !(c.is_alphanumeric() || c == '_')).filter(|word| !word.is_empty())
}

/// What a file passes on by `pub use`: the module that it comes from, and the name.
pub(crate) fn passed_on(text: &str) -> BTreeSet<(String, String)> {
    let uses = text.split("\npub use ").skip(1).filter_map(|rest| rest.split(';').next());
    uses.flat_map(|path| {
        let path = path.trim_start_matches("crate::");
        let (module, rest) = path.split_once("::").unwrap_or(("", path));
        // `pub use crate::{…}` passes on what the root has, the traits of systems.
        let (module, rest) = if module.is_empty() { ("system", path) } else { (module, rest) };
        names(rest).map(|name| (module.to_owned(), name.to_owned())).collect::<Vec<_>>()
    })
    .collect()
}

/// The rows of the tables in the documentation of a module, cell by cell.
fn rows(text: &str) -> Vec<Vec<&str>> {
    let lines = text.lines().filter_map(|line| line.strip_prefix("//! |")?.strip_suffix('|'));
    lines.map(|line| line.split('|').map(str::trim).collect()).collect()
}
