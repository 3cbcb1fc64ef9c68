//! The instructions per step that are allowed: those that were counted last.

/// How far a count may be above what is pinned.
#[allow(dead_code, reason = "the test of the README does not count")]
pub(crate) const MARGIN: f64 = 1.03;

/// A step, with its instructions as they were counted last.
#[derive(Debug)]
pub(crate) struct Pinned {
    pub(crate) name: String,
    pub(crate) generated: f64,
    #[allow(dead_code, reason = "only the README speaks of them")]
    pub(crate) by_hand: f64,
}

/// The rows of `instructions.csv`.
pub(crate) fn rows() -> Vec<Pinned> {
    let mut table = csv::Reader::from_reader(include_str!("instructions.csv").as_bytes());
    let rows = table.deserialize().map(|row| {
        let (name, generated, by_hand) = row.expect("a name and two numbers");
        Pinned { name, generated, by_hand }
    });
    rows.collect()
}
