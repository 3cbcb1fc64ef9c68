//! Imports run one way: what the map of `CONTRIBUTING.md` says is read from the code.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use crate::documentation::{names, passed_on};

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
pub(crate) fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path());
    entries.flat_map(|path| if path.is_dir() { files(&path) } else { vec![path] }).collect()
}

/// What follows `crate::` in the code of a file: rooms, and names that the root passes on.
fn names_of(text: &str) -> BTreeSet<String> {
    paths_of(text).iter().filter_map(|path| path.split("::").next().map(str::to_owned)).collect()
}

/// Every import of a crate that leads to a row above its own, and rooms that are in no row.
fn upwards(of: &str, outside: &[&str]) -> Vec<String> {
    let rooms = rooms(of);
    let row_of = |room: &str| rooms.iter().position(|row| row.iter().any(|name| name == room));
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(of).join("src");
    // In which room each name is that the root of the crate passes on.
    let passed_on = passed_on(&fs::read_to_string(source.join("lib.rs")).expect("a root"));
    let passed_on: BTreeMap<_, _> = passed_on.into_iter().map(|(room, name)| (name, room)).collect();
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

/// Every path after `crate::` in the code of a file, with the groups of `use` multiplied out.
fn paths_of(text: &str) -> BTreeSet<String> {
    /// Reads one path or group up to where it ends, below `prefix`.
    fn read<'t>(prefix: &str, mut text: &'t str, paths: &mut BTreeSet<String>) -> &'t str {
        let is_part = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
        let end = text.find(|c| !is_part(c)).unwrap_or(text.len());
        let path = format!("{prefix}{}", &text[..end]);
        text = &text[end..];
        let Some(mut rest) = text.strip_prefix('{') else {
            paths.insert(path);
            return text;
        };
        loop {
            rest = rest.trim_start().trim_start_matches(',').trim_start();
            match rest.strip_prefix('}') {
                Some(after) => return after,
                None => rest = read(&path, rest, paths),
            }
            // `a as b`
            rest =
                rest.trim_start().strip_prefix("as ").map_or(rest, |name| name.trim_start_matches(is_part));
        }
    }
    let code = text.split("#[cfg(test)]").next().unwrap_or_default();
    let code: String =
        code.lines().filter(|line| !line.trim_start().starts_with("//")).collect::<Vec<_>>().join("\n");
    let mut paths = BTreeSet::new();
    for rest in code.split("crate::").skip(1) {
        read("", rest, &mut paths);
    }
    paths
}

/// The names that `pub use`, `pub mod` and `pub` items make of a file: what users of the crate can name.
fn public_names(text: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for rest in text.split("\npub ").skip(1) {
        let (word, rest) = rest.split_once(' ').unwrap_or((rest, ""));
        if word == "use" {
            let list = rest.split(';').next().unwrap_or_default();
            let list =
                list.rsplit_once("::{").map_or_else(|| list.rsplit("::").next(), |(_, list)| Some(list));
            found.extend(names(list.unwrap_or_default()).map(str::to_owned));
        } else {
            found.extend(names(rest).next().map(str::to_owned));
        }
    }
    found
}

/// Rooms that users could have written: they see of the core what users see.
#[test]
fn some_rooms_know_public_items_only() {
    /// Macros that write `Debug`, of errors and others, a hash, and how work is cut for threads.
    const BESIDES: [&str; 5] = [
        "error::said",
        "shown::shown",
        "state::fingerprint::Fingerprint",
        "threads::at_once",
        "threads::largest_part",
    ];
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("../dvi-core/src");
    let of = |name: &str| public_names(&fs::read_to_string(source.join(name)).expect("a file"));
    let root = of("lib.rs");
    let is_public = |path: &str| match path.split("::").collect::<Vec<_>>()[..] {
        [name] => root.contains(name),
        [room, name, ..] => root.contains(room) && of(&format!("{room}.rs")).contains(name),
        [] => false,
    };
    let mut found = Vec::new();
    for room in ["ensemble", "record", "fast_sum", "field"] {
        for path in [files(&source.join(room)), vec![source.join(format!("{room}.rs"))]].concat() {
            for name in paths_of(&fs::read_to_string(&path).expect("a file")) {
                let is_own = name.split("::").next() == Some(room);
                if !is_own && !BESIDES.contains(&name.as_str()) && !is_public(&name) {
                    found.push(format!("{} imports {name}", path.display()));
                }
            }
        }
    }
    assert_eq!(found, Vec::<String>::new());
    // The test sees what there is.
    assert_eq!(
        paths_of("use crate::a::{B, c::{D as E, F}};\ncrate::g::h!(x);"),
        ["a::B", "a::c::D", "a::c::F", "g::h"].map(str::to_owned).into_iter().collect()
    );
    assert!(
        is_public("scalar::Lanes") && !is_public("scalar::simd::widest") && !is_public("threads::share")
    );
}
