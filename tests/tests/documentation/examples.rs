//! A page that users open has an example that runs.

use std::fs;

use super::{files, names, passed_on, read};

/// Modules of which users open all pages, besides those of the prelude.
const MODULES: [&str; 6] = ["archive", "diagnostics", "ensemble", "fast_sum", "field", "record"];
/// What has a page of its own.
const ITEMS: [&str; 5] = ["pub struct ", "pub enum ", "pub trait ", "pub fn ", "pub type "];

/// Whether a documentation comment has an example that is compiled, and not a formula or a text only.
fn has_example(comment: &[&str]) -> bool {
    let fences = comment.iter().filter_map(|line| line.trim_start().strip_prefix("/// ```"));
    // Every second one ends what the one before has begun.
    fences.step_by(2).any(|kind| matches!(kind, "" | "no_run"))
}

/// The lines above the declaration of a name in `text` that belong to it, if there is one.
fn above<'a>(text: &'a str, name: &str) -> Option<Vec<&'a str>> {
    let declares = |line: &&str| {
        let line = line.trim_start();
        let item = ITEMS.iter().find_map(|item| line.strip_prefix(item)).and_then(|rest| names(rest).next());
        // Or a row of a macro, as of quadrature rules; such rows follow each other without an empty line.
        item == Some(name) || line.strip_prefix(name).is_some_and(|rest| rest.starts_with(" = ["))
    };
    let lines: Vec<&str> = text.lines().collect();
    let place = lines.iter().position(declares)?;
    let is_beside =
        |line: &&&str| line.trim_start().starts_with("///") || !(line.is_empty() || line.ends_with(';'));
    let mut above: Vec<&str> = lines[..place].iter().rev().take_while(is_beside).copied().collect();
    above.reverse();
    Some(above)
}

/// All pages, as the module and the name.
fn pages() -> Vec<(String, String)> {
    let mut pages: Vec<_> = passed_on(&read("prelude.rs")).into_iter().collect();
    pages.retain(|(module, _)| module != "dvi_macros");
    for module in MODULES {
        let text = read(&format!("{module}.rs"));
        pages.extend(passed_on(&text).into_iter().map(|(_, name)| (module.to_owned(), name)));
        let own = text.lines().filter_map(|line| ITEMS.iter().find_map(|item| line.strip_prefix(item)));
        pages.extend(own.filter_map(|rest| Some((module.to_owned(), names(rest).next()?.to_owned()))));
    }
    pages
}

#[test]
fn every_page_that_users_open_has_an_example() {
    let pages = pages();
    assert!(pages.len() > 100, "{pages:?}");
    let without = pages.iter().filter(|(module, name)| {
        // A module may pass on what another one declares.
        let mut files = [module.as_str()].into_iter().chain(MODULES).flat_map(files);
        let found = files.find_map(|file| {
            let text = fs::read_to_string(file).expect("a file");
            above(&text, name).map(|comment| has_example(&comment))
        });
        !found.unwrap_or_else(|| panic!("{module} does not declare {name}"))
    });
    let without: Vec<_> = without.map(|(module, name)| format!("{module}::{name}")).collect();
    assert!(without.is_empty(), "pages without an example: {without:#?}");
}

#[test]
fn a_formula_is_no_example() {
    let text = "\
/// Neither a formula nor a text is an example.
/// ```math
/// p = v;
/// ```
/// ```text
/// 1
/// ```
pub struct None;

/// ```math
/// p = v
/// ```
/// ```
/// assert!(true);
/// ```
#[derive(Debug)]
pub enum One {}

pub trait Silent {}
";
    let found =
        ["None", "One", "Silent", "Missing"].map(|name| above(text, name).map(|above| has_example(&above)));
    assert_eq!(found, [Some(false), Some(true), Some(false), None]);
}
