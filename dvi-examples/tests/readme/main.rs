//! What the two READMEs and the guide say of the experiments is what the full run has measured.
//!
//! `full-run.csv` is the `summary.csv` of a full run. After a change of the experiments:
//! `cargo run --release -p dvi-examples && cp results/summary.csv dvi-examples/full-run.csv`, and write into
//! the README what this test asks for. A test of the short run compares claims and verdicts with that table.

mod accuracy;
mod constraints;
mod elastic;
mod energy;
mod impacts;
mod long_runs;
mod many_bodies;
mod numbers;
mod rotations;
mod table;

use table::rows;

fn assert_said(sentences: &[String]) {
    let guide = include_str!("../../../dvi-core/docs/choosing-a-method.md");
    let pages = [include_str!("../../../README.md"), include_str!("../../README.md"), guide];
    let pages = pages.map(|page| page.split_whitespace().collect::<Vec<_>>().join(" "));
    for sentence in sentences {
        let said = pages.iter().any(|page| page.contains(sentence.as_str()));
        assert!(said, "README.md, dvi-examples/README.md or the guide should say:\n{sentence}");
    }
}

#[test]
fn the_tally_is_that_of_the_full_run() {
    let rows = rows();
    let claims = || rows.iter().filter(|row| row.kind == "claim");
    let printed = || claims().filter(|row| row.place != "beyond the paper");
    let count = |wanted: fn(&str) -> bool| printed().filter(|row| wanted(&row.verdict)).count();
    let (reproduced, differ) = (count(|v| v == "reproduced"), count(|v| v.starts_with("differs")));
    assert_eq!(reproduced + differ, printed().count(), "a claim is not reproduced, or undecided");
    let beyond = || claims().filter(|row| row.place == "beyond the paper");
    assert!(beyond().all(|row| row.verdict == "holds"), "a claim of ours does not hold");
    let checks = || rows.iter().filter(|row| row.kind == "reference");
    assert!(checks().all(|row| row.verdict == "passes"), "a regression check fails");
    assert_said(&[
        format!(
            "Of {} claims of the papers that were tested, the experiments reproduce {reproduced}; the other {differ} \
             differ from what is printed, and the summary says how.",
            printed().count()
        ),
        format!(
            "{} claims that go beyond the papers hold, and {} numbers are those of independent programs or of \
             earlier runs.",
            beyond().count(),
            checks().count()
        ),
    ]);
}
