//! All runs of a problem: first what they show, then their times, in rounds through all of them.

use crate::problem::{Method, Problem, Run, Seen};

/// Milliseconds that one measurement of a time takes at least.
const LEAST: f64 = 3.0;
/// Rounds through all runs; the time of a run is the median.
const ROUNDS: usize = 5;
/// Runs that take longer are measured in the first rounds only.
const LONG: f64 = 100.0;
const LONG_ROUNDS: usize = 2;
/// A run with a larger error is not worth its time.
const LARGEST_ERROR: f64 = 1e-2;

/// A run that came to its end.
#[derive(Clone, Debug)]
pub(crate) struct Point {
    pub(crate) method: String,
    pub(crate) milliseconds: f64,
    pub(crate) error: f64,
    /// Evaluations of the right-hand side, where they are known.
    pub(crate) evaluations: Option<u64>,
}

pub(crate) fn measure(problem: &Problem) -> Vec<Point> {
    let all = problem.methods.iter().flat_map(|method| method.runs.iter().map(move |run| (method, run)));
    let seen = all.filter_map(|(method, run)| Some((method, run, run.watch()?)));
    let runs: Vec<_> = seen.filter(|(_, _, seen)| seen.error <= LARGEST_ERROR).collect();
    let mut times = vec![Vec::new(); runs.len()];
    for round in 0..ROUNDS {
        for ((_, run, _), times) in runs.iter().zip(&mut times) {
            if round < LONG_ROUNDS || median(times) < LONG {
                times.push(run.time(LEAST));
            }
        }
    }
    let point = |((method, _, seen), times): ((&Method, &Run, Seen), &Vec<f64>)| Point {
        method: method.name.clone(),
        milliseconds: median(times),
        error: seen.error,
        evaluations: Some(seen.evaluations),
    };
    runs.into_iter().zip(&times).map(point).collect()
}

fn median(times: &[f64]) -> f64 {
    let mut sorted = times.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted[sorted.len() / 2]
}
