//! What Criterion has measured in one run, as tables in Markdown for the README of the benchmarks.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::time::Duration;

use criterion::Criterion;
use serde_json::Value;

/// Medians in nanoseconds, by group, function and parameter, as Criterion calls them.
#[derive(Debug)]
pub struct Medians(BTreeMap<String, BTreeMap<String, BTreeMap<u64, f64>>>);

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
    let mut medians = Medians(BTreeMap::new());
    medians.collect(folder.path()).expect("what Criterion has written");
    Some(medians)
}

/// Measures, and prints a table of each group if they are asked for: a row for each function, a column for
/// each parameter, and in brackets the time over the shortest one of the column.
pub fn main(groups: &[fn(&mut Criterion)]) {
    let Some(Medians(medians)) = measure(groups) else { return };
    for (group, functions) in &medians {
        let parameters: BTreeSet<u64> = functions.values().flat_map(BTreeMap::keys).copied().collect();
        let named = |parameter: &u64| if *parameter == 0 { String::new() } else { parameter.to_string() };
        print_row(std::iter::once(group.clone()).chain(parameters.iter().map(named)));
        print_row((0..=parameters.len()).map(|_| "---".to_owned()));
        for (function, times) in functions {
            let cell = |parameter| {
                let Some(time) = times.get(parameter) else { return String::new() };
                let column = functions.values().filter_map(|times| times.get(parameter));
                let ratio = time / column.copied().fold(f64::INFINITY, f64::min);
                format!("{:.2?} ({ratio:.2})", Duration::from_nanos(time.round() as u64))
            };
            print_row(std::iter::once(function.clone()).chain(parameters.iter().map(cell)));
        }
        println!();
    }
}

/// Prints a row.
pub fn print_row(cells: impl Iterator<Item = String>) {
    println!("| {} |", cells.collect::<Vec<_>>().join(" | "));
}

impl Medians {
    /// The median of a benchmark without a parameter, in nanoseconds.
    ///
    /// # Panics
    /// If nothing of that name was measured.
    pub fn of(&self, group: &str, function: &str) -> f64 {
        self.0[group][function][&0]
    }

    /// Reads the names and medians below a folder.
    fn collect(&mut self, folder: &Path) -> std::io::Result<()> {
        for entry in std::fs::read_dir(folder)? {
            let path = entry?.path();
            if path.ends_with("new") {
                let read = |file: &str| -> std::io::Result<Value> {
                    Ok(serde_json::from_str(&std::fs::read_to_string(path.join(file))?)?)
                };
                let (benchmark, estimates) = (read("benchmark.json")?, read("estimates.json")?);
                let name = |id: &str| benchmark[id].as_str().unwrap_or_default().to_owned();
                let parameter = name("value_str").parse().unwrap_or(0);
                let median = estimates["median"]["point_estimate"].as_f64().expect("a median");
                let functions = self.0.entry(name("group_id")).or_default();
                functions.entry(name("function_id")).or_default().insert(parameter, median);
            } else if path.is_dir() {
                self.collect(&path)?;
            }
        }
        Ok(())
    }
}
