//! What `alternatives/run` has measured with programs in other languages, if it has been run:
//! `alternatives.csv`.

use std::path::Path;

use anyhow::{Context as _, Result, ensure};

use crate::measure::Point;

/// Rows of the file: points of a problem.
pub(crate) struct Alternatives(Vec<(String, Point)>);

impl Alternatives {
    /// The file in `folder`, or nothing where there is none.
    ///
    /// # Errors
    /// If the file is not what the script writes.
    pub(crate) fn read(folder: &Path) -> Result<Self> {
        let path = folder.join("alternatives.csv");
        if !path.exists() {
            return Ok(Self(Vec::new()));
        }
        let name = path.display();
        let mut reader = csv::Reader::from_path(&path).with_context(|| format!("cannot read {name}"))?;
        let mut rows = Vec::new();
        for row in reader.records() {
            let row = row.with_context(|| format!("{name} is not a table"))?;
            ensure!(row.len() == 6, "a row of {name} has {} cells, and not 6", row.len());
            let parse =
                |i: usize| row[i].parse().with_context(|| format!("{name}: `{}` is not a number", &row[i]));
            let evaluations = row[5].parse().ok();
            let point =
                Point { method: row[1].to_owned(), milliseconds: parse(3)?, error: parse(4)?, evaluations };
            rows.push((row[0].to_owned(), point));
        }
        Ok(Self(rows))
    }

    /// The points of a problem.
    pub(crate) fn of(&self, problem: &str) -> Vec<Point> {
        self.0.iter().filter(|(name, _)| name == problem).map(|(_, point)| point.clone()).collect()
    }
}
