//! What the two READMEs and the guide say of the experiments is what the full run has measured.
//!
//! `full-run.csv` is the `summary.csv` of a full run. After a change of the experiments:
//! `cargo run --release -p dvi-examples -- --all && cp results/summary.csv dvi-examples/full-run.csv`, and
//! write into the README what this test asks for. A test of the short run compares claims and verdicts with
//! that table.

/// One of the pages should say this.
macro_rules! said {
    ($($sentence:tt)*) => { assert_said(&format!($($sentence)*)) };
}

use std::collections::BTreeMap;
use std::sync::LazyLock;

fn assert_said(sentence: &str) {
    let guide = include_str!("../../dvi-core/docs/choosing-a-method.md");
    let pages = [include_str!("../../README.md"), include_str!("../README.md"), guide];
    let pages = pages.map(|page| page.split_whitespace().collect::<Vec<_>>().join(" "));
    let said = pages.iter().any(|page| page.contains(sentence));
    assert!(said, "README.md, dvi-examples/README.md or the guide should say:\n{sentence}");
}

/// The rows of the table, by the names of their columns.
static ROWS: LazyLock<Vec<BTreeMap<String, String>>> = LazyLock::new(|| {
    let mut reader = csv::Reader::from_reader(include_str!("../full-run.csv").as_bytes());
    let rows: Vec<BTreeMap<_, _>> = reader.deserialize().map(|row| row.expect("a row")).collect();
    assert!(rows.iter().all(|row| row["form"] == "full"), "a part of another form");
    rows
});

/// The numbers that an experiment has measured, by their quantities.
fn of(experiment: &str) -> impl Fn(&str) -> f64 + use<'_> {
    move |quantity| {
        let row = ROWS.iter().find(|row| row["experiment"] == experiment && row["text"] == quantity);
        let value = row.and_then(|row| row["value"].parse().ok());
        value.unwrap_or_else(|| panic!("{experiment} has not measured `{quantity}`"))
    }
}

#[test]
fn the_tally_is_that_of_the_full_run() {
    let verdicts = |kind: &str, beyond: bool| -> Vec<&str> {
        let is_beyond = |row: &BTreeMap<_, _>| row["place"] == "beyond the paper";
        let rows = ROWS.iter().filter(|row| row["row"] == kind && is_beyond(row) == beyond);
        rows.map(|row| row["verdict"].as_str()).collect()
    };
    let [printed, beyond, checks] = [("claim", false), ("claim", true), ("reference", false)]
        .map(|(kind, beyond)| verdicts(kind, beyond));
    let reproduced = printed.iter().filter(|&&verdict| verdict == "reproduced").count();
    let differ = printed.iter().filter(|verdict| verdict.starts_with("differs")).count();
    assert_eq!(reproduced + differ, printed.len(), "a claim is not reproduced, or undecided");
    assert!(beyond.iter().all(|&verdict| verdict == "holds"), "a claim of ours does not hold");
    assert!(checks.iter().all(|&verdict| verdict == "passes"), "a regression check fails");
    said!(
        "Of {} claims of the papers that were tested, the experiments reproduce {reproduced}; the other \
         {differ} differ from what is printed, and the summary says how.",
        printed.len()
    );
    said!(
        "{} claims that go beyond the papers hold, and {} numbers are those of independent programs or of \
         earlier runs.",
        beyond.len(),
        checks.len()
    );
}

#[test]
fn compensated_sums_round_as_little_as_it_is_said() {
    let percent = |name: &str| {
        let ratio = of("round-off")(&format!("{name}: compensated/plain, at the end"));
        (1000.0 * ratio).ceil() / 10.0
    };
    said!(
        "After 10⁸ steps on an oscillator the rounding error of the conserved energy is then at most {:.1} \
         % of that with plain sums for σ = ½, and {:.1} % for Verlet's method.",
        percent("oscillator, σ = ½"),
        percent("oscillator, Verlet")
    );
}
