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

use std::sync::LazyLock;

fn assert_said(sentence: &str) {
    let guide = include_str!("../../dvi-core/docs/choosing-a-method.md");
    let pages = [include_str!("../../README.md"), include_str!("../README.md"), guide];
    let pages = pages.map(|page| page.split_whitespace().collect::<Vec<_>>().join(" "));
    let said = pages.iter().any(|page| page.contains(sentence));
    assert!(said, "README.md, dvi-examples/README.md or the guide should say:\n{sentence}");
}

/// One row of the table.
struct Row {
    experiment: String,
    kind: String,
    place: String,
    text: String,
    value: String,
    verdict: String,
}

static ROWS: LazyLock<Vec<Row>> = LazyLock::new(|| {
    let mut reader = csv::Reader::from_reader(include_str!("../full-run.csv").as_bytes());
    let row = |row: csv::StringRecord| {
        assert_eq!(&row[1], "full", "a part of another form: {row:?}");
        let [experiment, kind, place, text, value, verdict] = [0, 3, 4, 5, 6, 10].map(|i| row[i].to_owned());
        Row { experiment, kind, place, text, value, verdict }
    };
    reader.records().map(|record| row(record.expect("a row"))).collect()
});

/// The numbers that an experiment has measured, by their quantities.
fn of(experiment: &str) -> impl Fn(&str) -> f64 + use<'_> {
    move |quantity| {
        let row = ROWS.iter().find(|row| row.experiment == experiment && row.text == quantity);
        let row = row.unwrap_or_else(|| panic!("{experiment} does not measure `{quantity}`"));
        row.value.parse().unwrap_or_else(|_| panic!("{experiment} has not measured `{quantity}`"))
    }
}

#[test]
fn the_tally_is_that_of_the_full_run() {
    let claims = || ROWS.iter().filter(|row| row.kind == "claim");
    let printed = || claims().filter(|row| row.place != "beyond the paper");
    let count = |wanted: fn(&str) -> bool| printed().filter(|row| wanted(&row.verdict)).count();
    let (reproduced, differ) = (count(|v| v == "reproduced"), count(|v| v.starts_with("differs")));
    assert_eq!(reproduced + differ, printed().count(), "a claim is not reproduced, or undecided");
    let beyond = || claims().filter(|row| row.place == "beyond the paper");
    assert!(beyond().all(|row| row.verdict == "holds"), "a claim of ours does not hold");
    let checks = || ROWS.iter().filter(|row| row.kind == "reference");
    assert!(checks().all(|row| row.verdict == "passes"), "a regression check fails");
    said!(
        "Of {} claims of the papers that were tested, the experiments reproduce {reproduced}; the other \
         {differ} differ from what is printed, and the summary says how.",
        printed().count()
    );
    said!(
        "{} claims that go beyond the papers hold, and {} numbers are those of independent programs or of \
         earlier runs.",
        beyond().count(),
        checks().count()
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
