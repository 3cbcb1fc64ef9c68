//! Imports run one way: what the map of `CONTRIBUTING.md` says is read from the code.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// The rooms of a crate, row by row of its table in `CONTRIBUTING.md`; those of one row know each other.
fn rooms(of: &str) -> Vec<Vec<String>> {
    let map = include_str!("../../CONTRIBUTING.md");
    let (_, section) = map.split_once(&format!("\n**`{of}`**")).expect("a section on the crate");
    let rows =
        section.lines().skip_while(|line| !line.starts_with('|')).take_while(|line| line.starts_with('|'));
    let names = |row: &str| -> Vec<String> {
        row.split('|').nth(1).unwrap_or_default().split('`').skip(1).step_by(2).map(str::to_owned).collect()
    };
    rows.map(names).filter(|names| !names.is_empty()).collect()
}

/// The files below `folder`.
fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path());
    entries.flat_map(|path| if path.is_dir() { files(&path) } else { vec![path] }).collect()
}

/// What follows `crate::` in the code of a file, up to its tests and without its comments.
fn names_of(text: &str) -> BTreeSet<String> {
    let code = text.split("#[cfg(test)]").next().unwrap_or_default();
    let code: String =
        code.lines().filter(|line| !line.trim_start().starts_with("//")).collect::<Vec<_>>().join("\n");
    let mut names = BTreeSet::new();
    for rest in code.split("crate::").skip(1) {
        // `use crate::{a, b::{c, d}, e};`
        let (mut depth, mut name) = (0, String::new());
        for character in rest.chars() {
            match character {
                '{' => depth += 1,
                '}' => depth -= 1,
                _ if character.is_alphanumeric() || character == '_' => name.push(character),
                _ => {
                    names.insert(core::mem::take(&mut name));
                }
            }
            if depth <= 0 && !(character.is_alphanumeric() || character == '_') {
                break;
            }
        }
        names.insert(name);
    }
    names
}

/// In which room each name is that the root of the crate passes on.
fn passed_on(root: &str) -> BTreeMap<String, String> {
    let uses = root.split("pub use ").skip(1).filter_map(|rest| rest.split(';').next()?.split_once("::"));
    let names = |list: &str| -> Vec<String> {
        let words = list.split(|c: char| !(c.is_alphanumeric() || c == '_'));
        words.filter(|word| !word.is_empty()).map(str::to_owned).collect()
    };
    uses.flat_map(|(room, list)| names(list).into_iter().map(move |name| (name, room.to_owned()))).collect()
}

/// Every import of a crate that leads to a row above its own, and rooms that are in no row.
fn upwards(of: &str, outside: &[&str]) -> Vec<String> {
    let rooms = rooms(of);
    let row_of = |room: &str| rooms.iter().position(|row| row.iter().any(|name| name == room));
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(of).join("src");
    let passed_on = passed_on(&fs::read_to_string(source.join("lib.rs")).expect("a root"));
    let mut found = Vec::new();
    for path in files(&source) {
        let inside = path.strip_prefix(&source).expect("a file of the crate");
        let room = inside.components().next().expect("a name").as_os_str().to_string_lossy();
        let room = room.trim_end_matches(".rs");
        let is_test =
            inside.components().any(|part| part.as_os_str() == "tests" || part.as_os_str() == "tests.rs");
        if is_test || outside.contains(&room) {
            continue;
        }
        let Some(row) = row_of(room) else {
            found.push(format!("{room} is not in the map"));
            continue;
        };
        for name in names_of(&fs::read_to_string(&path).expect("a file")) {
            let to = passed_on.get(&name).map_or(name.as_str(), String::as_str);
            if row_of(to).is_some_and(|to| to < row) {
                found.push(format!("{} imports {to}", inside.display()));
            }
        }
    }
    found
}

#[test]
fn imports_of_the_macros_run_upwards() {
    assert_eq!(upwards("dvi-macros", &["lib", "oracle_tests", "fuzz_tests"]), Vec::<String>::new());
}

#[test]
fn imports_of_the_core_run_upwards() {
    let facade = ["lib", "guide", "prelude", "private", "rotations", "threads"];
    assert_eq!(upwards("dvi-core", &facade), Vec::<String>::new());
    // The test sees what there is.
    assert!(
        names_of("use crate::{a, b::{c, d}, e};\nlet x = crate::f::g(); // crate::h")
            .is_superset(&["a", "b", "e", "f"].map(str::to_owned).into_iter().collect())
    );
}
