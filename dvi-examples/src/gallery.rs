//! Runs experiments side by side.

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc;

use anyhow::{Context as _, Result};
use rayon::ThreadPoolBuilder;
use rayon::iter::{ParallelBridge as _, ParallelIterator as _};

use crate::claim::{Check, Claim};
use crate::experiments::SOURCES;
use crate::job::{Job, Length};
use crate::output::now;
use crate::progress::Progress;
use crate::record::{Part, State};

/// One model and one picture.
#[derive(Clone, Copy, Debug)]
pub struct Experiment {
    /// What `--only` takes, and what its files are called.
    pub name: &'static str,
    /// A sentence on what it shows, without its full stop.
    pub title: &'static str,
    /// Who published it; empty if nobody did.
    pub source: &'static str,
    /// Its rough share of the time that all take, in seconds of a full run on one core: what the time left
    /// is computed from, and the order in which they begin.
    pub share: f64,
    pub run: fn(&Job<'_>) -> Result<Outcome>,
}

impl Experiment {
    /// Whether it belongs to the main job.
    pub fn is_of_a_paper(&self) -> bool {
        SOURCES.contains(&self.source)
    }
}

/// What an experiment has to say.
#[derive(Clone, Debug, Default)]
pub struct Outcome {
    pub claims: Vec<Claim>,
    /// Numbers that must be those of independent programs or of earlier runs.
    pub references: Vec<Check>,
    /// Sentences that belong to the numbers: conventions, endings of series.
    pub notes: Vec<String>,
}

impl From<Vec<Claim>> for Outcome {
    fn from(claims: Vec<Claim>) -> Self {
        Self { claims, ..Self::default() }
    }
}

/// Runs the experiments, the shortest first, and returns what each has left, in their order.
pub fn run(
    experiments: &[Experiment],
    folder: &Path,
    length: Length,
    threads: Option<u16>,
    stop: &AtomicBool,
) -> Result<Vec<Part>> {
    let pool = ThreadPoolBuilder::new().num_threads(threads.map_or(0, usize::from)).build();
    let pool = pool.context("cannot start the threads")?;
    let progress = Progress::new(experiments);
    let one = |number: usize| {
        let Experiment { name, run, .. } = experiments[number];
        let ended = |how: &str, state, outcome| {
            progress.end(number, how);
            (number, Part { experiment: name.to_owned(), length, when: now(), state, outcome })
        };
        if stop.load(Ordering::Relaxed) {
            return ended("not started", State::NotStarted, Outcome::default());
        }
        let (bar, cut) = (progress.start(number), AtomicBool::new(false));
        let job = Job { name, folder, length, bar, stop, cut };
        let ran = run(&job).and_then(|outcome| job.publish_motion().map(|()| outcome));
        match (ran, job.was_interrupted()) {
            (Ok(outcome), false) => ended("done", State::Complete, outcome),
            (Ok(outcome), true) => ended("interrupted", State::Interrupted, outcome),
            (Err(error), _) => ended("failed", State::Failed(format!("{error:#}")), Outcome::default()),
        }
    };
    let mut order: Vec<usize> = (0..experiments.len()).collect();
    order.sort_by(|&i, &j| experiments[i].share.total_cmp(&experiments[j].share));
    let mut parts: Vec<(usize, Part)> = std::thread::scope(|scope| {
        // Until this is dropped, which a panic does too.
        let (_running, ended) = mpsc::channel();
        scope.spawn(|| progress.watch(ended));
        // A bridge hands out one at a time, in this order.
        pool.install(|| order.into_iter().par_bridge().map(one).collect())
    });
    parts.sort_by_key(|(number, _)| *number);
    Ok(parts.into_iter().map(|(_, part)| part).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn quick(_: &Job<'_>) -> Result<Outcome> {
        Ok(Outcome::default())
    }

    fn broken(_: &Job<'_>) -> Result<Outcome> {
        anyhow::bail!("no ink")
    }

    #[test]
    fn one_failure_does_not_stop_the_others() {
        let named = |name, run| Experiment { name, title: "", source: "", share: 1.0, run };
        let both = [named("a", broken as fn(&Job<'_>) -> _), named("b", quick)];
        let stop = AtomicBool::new(false);
        let parts = run(&both, Path::new("."), Length::Short, Some(2), &stop).expect("threads");
        let states: Vec<_> = parts.into_iter().map(|part| part.state).collect();
        assert_eq!(states, [State::Failed("no ink".into()), State::Complete]);
    }

    #[test]
    fn nothing_starts_after_an_interrupt() {
        let stop = AtomicBool::new(true);
        let one = [Experiment { name: "a", title: "", source: "", share: 1.0, run: broken }];
        let parts = run(&one, Path::new("."), Length::Full, None, &stop).expect("threads");
        assert!(parts.iter().all(|part| part.state == State::NotStarted), "{parts:?}");
    }
}
