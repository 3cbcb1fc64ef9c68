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
    let mut rows = Vec::new();
    for line in include_str!("../instructions.csv").lines().skip(1) {
        let mut cells = line.rsplitn(3, ',');
        let mut number = || cells.next().and_then(|cell| cell.parse().ok()).unwrap_or(f64::NAN);
        let (by_hand, generated) = (number(), number());
        let name = cells.next().unwrap_or_default().trim_matches('"').to_owned();
        rows.push(Pinned { name, generated, by_hand });
    }
    rows
}
