//! The instructions of a step are those that are pinned, where valgrind can count them, and those that the README gives.

mod pinned;

use std::process::Command;

#[test]
fn the_readme_gives_the_pinned_counts() {
    let readme = include_str!("../../README.md");
    for pinned::Pinned { name, generated, by_hand } in pinned::rows() {
        let counts = format!("({generated:.0} / {by_hand:.0})");
        assert!(readme.contains(&counts), "the README should give {counts} for `{name}`");
    }
}

/// Builds the benchmark as it is measured. Without valgrind there is nothing to count, and the test says so.
#[test]
fn no_step_takes_more_instructions_than_are_pinned() {
    if Command::new("valgrind").arg("--version").output().is_err() {
        eprintln!("not tested: valgrind is not installed");
        return;
    }
    let bench = ["bench", "--locked", "-p", "dvi-kernels", "--bench", "instructions"];
    let output =
        Command::new(env!("CARGO")).args(bench).env("CARGO_INCREMENTAL", "0").output().expect("cargo starts");
    let [said, errors] = [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text));
    assert!(output.status.success() && said.contains("newton"), "{said}{errors}");
}
