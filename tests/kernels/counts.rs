//! The instructions of a step are those that are pinned, where valgrind can count them, and those that the
//! README gives. Neither instructions nor optimisation change a number.

mod pinned;
mod printed;

use printed::{WIDE, hash_of};
use std::process::Command;

#[test]
fn the_readme_gives_the_pinned_counts() {
    let readme = include_str!("../../README.md");
    for pinned::Pinned { name, generated, by_hand } in pinned::rows() {
        let counts = format!("| {by_hand:.0} | {generated:.0} |");
        assert!(readme.contains(&counts), "the README should give {counts} for `{name}`");
    }
}

/// Builds the benchmark as it is measured, which ends well if no step takes more instructions than are
/// pinned. Without valgrind there is nothing to count, and the test says so. What it computes with the
/// widest instructions of the processor is what this test computes without optimisation and with the
/// instructions that all processors have, bit for bit.
#[test]
fn the_benchmark_keeps_to_the_pins_and_to_the_bits() -> Result<(), Box<dyn std::error::Error>> {
    let bench = ["bench", "--locked", "-p", "dvi-kernels", "--bench", "instructions"];
    let output = Command::new(env!("CARGO")).args(bench).env("CARGO_INCREMENTAL", "0").output()?;
    let [said, errors] = [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text));
    assert!(output.status.success(), "{said}{errors}");
    if Command::new("valgrind").arg("--version").output().is_err() {
        eprintln!("no instructions are counted: valgrind is not installed");
    } else {
        assert!(said.contains("newton"), "{said}{errors}");
    }
    let line = said.lines().find_map(|line| line.strip_prefix(WIDE));
    let bits = dvi_kernels::wide::bits();
    let finite = bits.iter().filter(|bits| f64::from_bits(**bits).is_finite()).count();
    assert!(finite == bits.len() && finite > 1000, "{finite} of {} numbers", bits.len());
    assert_eq!(line, Some(hash_of(&bits).as_str()));
    Ok(())
}
