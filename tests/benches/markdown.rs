//! What Criterion has measured in one run, as tables in Markdown for the README of the benchmarks.

use std::collections::BTreeMap;
use std::path::Path;
use std::time::Duration;

use criterion::Criterion;
use serde_json::Value;

/// A table: its head, and for each row a name and cells.
pub type Table = (&'static [&'static str], &'static [(&'static str, &'static [Cell])]);

/// What a cell shows, of medians; benchmarks are named as Criterion names them, group/function.
#[derive(Clone, Copy, Debug)]
pub enum Cell {
    /// The time of the first over that of the second.
    Ratio(&'static str, &'static str),
    /// A time.
    Time(&'static str),
    /// So many things, done in the time of a benchmark, in 10⁹ in a second.
    Billions(f64, &'static str),
    /// Nothing was measured.
    Empty,
}

/// Medians in nanoseconds, by name.
#[derive(Debug)]
pub struct Medians(BTreeMap<String, f64>);

/// Measures as Criterion does; with `--markdown` for less long, and gives what was measured.
///
/// # Panics
/// If what Criterion writes cannot be read.
pub fn measure(groups: &[fn(&mut Criterion)]) -> Option<Medians> {
    if !std::env::args().any(|argument| argument == "--markdown") {
        let mut criterion = Criterion::default().configure_from_args();
        groups.iter().for_each(|group| group(&mut criterion));
        criterion.final_summary();
        return None;
    }
    let folder = tempfile::tempdir().expect("a folder for what is measured");
    let mut criterion = Criterion::default()
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(2))
        .sample_size(30)
        .output_directory(folder.path());
    groups.iter().for_each(|group| group(&mut criterion));
    let mut medians = BTreeMap::new();
    collect(folder.path(), &mut medians).expect("what Criterion has written");
    Some(Medians(medians))
}

/// Measures, and prints tables if they are asked for.
///
/// # Panics
/// If a table has a name that was not measured.
pub fn main(groups: &[fn(&mut Criterion)], tables: &[Table]) {
    let Some(medians) = measure(groups) else { return };
    for (head, rows) in tables {
        print_row(head.iter().map(|&name| name.to_owned()));
        print_row(head.iter().map(|_| "---".to_owned()));
        for (name, cells) in *rows {
            print_row(
                std::iter::once((*name).to_owned()).chain(cells.iter().map(|cell| medians.show(*cell))),
            );
        }
        println!();
    }
}

/// Prints a row.
pub fn print_row(cells: impl Iterator<Item = String>) {
    println!("| {} |", cells.collect::<Vec<_>>().join(" | "));
}

impl Medians {
    /// The median of a benchmark, in nanoseconds.
    ///
    /// # Panics
    /// If nothing of that name was measured.
    pub fn of(&self, name: &str) -> f64 {
        *self.0.get(name).unwrap_or_else(|| panic!("`{name}` is none of {:?}", self.0.keys()))
    }

    fn show(&self, cell: Cell) -> String {
        match cell {
            Cell::Ratio(one, other) => format!("{:.2}", self.of(one) / self.of(other)),
            Cell::Time(name) => format!("{:.2?}", Duration::from_nanos(self.of(name).round() as u64)),
            Cell::Billions(count, name) => format!("{:.2}", count / self.of(name)),
            Cell::Empty => String::new(),
        }
    }
}

/// Reads the names and medians below a folder.
fn collect(folder: &Path, medians: &mut BTreeMap<String, f64>) -> std::io::Result<()> {
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        if path.ends_with("new") {
            let read = |file: &str| -> std::io::Result<Value> {
                Ok(serde_json::from_str(&std::fs::read_to_string(path.join(file))?)?)
            };
            let (benchmark, estimates) = (read("benchmark.json")?, read("estimates.json")?);
            let name = benchmark["full_id"].as_str().expect("a name");
            let median = estimates["median"]["point_estimate"].as_f64().expect("a median");
            medians.insert(name.to_owned(), median);
        } else if path.is_dir() {
            collect(&path, medians)?;
        }
    }
    Ok(())
}
