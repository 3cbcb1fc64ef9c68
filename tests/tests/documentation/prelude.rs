//! The page of the prelude has a line for each name.

use std::collections::BTreeSet;

use super::{names, passed_on, read, rows};

#[test]
fn the_prelude_says_a_word_on_each_name() {
    let text = read("prelude.rs");
    let exported: BTreeSet<_> = passed_on(&text).into_iter().map(|(_, name)| name).collect();
    let rows: Vec<_> = rows(&text).into_iter().filter(|row| row[0].starts_with("[`")).collect();
    let said: BTreeSet<_> = rows.iter().filter_map(|row| names(row[0]).next()).map(str::to_owned).collect();
    assert_eq!(rows.len(), said.len(), "a name has two lines");
    let differ: Vec<_> = said.symmetric_difference(&exported).collect();
    assert!(differ.is_empty(), "without a line, or not exported: {differ:?}");
    assert!(rows.iter().all(|row| row.len() == 2 && !row[1].is_empty()));
}
