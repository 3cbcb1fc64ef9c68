//! Runs experiments side by side.

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::{Context as _, Result};
use rayon::ThreadPoolBuilder;
use rayon::iter::{ParallelBridge as _, ParallelIterator as _};

use crate::claim::{Check, Claim};
use crate::job::{Job, Length};
use crate::progress::Progress;

/// One model and one picture.
#[derive(Clone, Copy, Debug)]
pub struct Experiment {
    /// What `--only` takes, and what its files are called.
    pub name: &'static str,
    pub title: &'static str,
    /// Its rough share of the time that all take, in seconds of a full run: what the time left is computed
    /// from.
    pub share: f64,
    pub run: fn(&Job<'_>) -> Result<Outcome>,
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

/// How an experiment ended.
#[derive(Debug)]
pub enum Ended {
    Complete(Outcome),
    Interrupted(Outcome),
    NotStarted,
    Failed(anyhow::Error),
}

/// Runs the experiments, the longest first, and returns how each has ended, in their order.
pub fn run(
    experiments: &[Experiment],
    folder: &Path,
    length: Length,
    threads: Option<u16>,
    stop: &AtomicBool,
) -> Result<Vec<Ended>> {
    let pool = ThreadPoolBuilder::new().num_threads(threads.map_or(0, usize::from)).build();
    let pool = pool.context("cannot start the threads")?;
    let progress = Progress::new(experiments);
    let one = |number: usize| {
        if stop.load(Ordering::Relaxed) {
            progress.end(number, "not started");
            return (number, Ended::NotStarted);
        }
        let name = experiments[number].name;
        let job = Job::new(name, folder.to_owned(), length, progress.start(number), stop);
        let (how, ended) = match ((experiments[number].run)(&job), job.was_interrupted()) {
            (Ok(outcome), false) => ("done", Ended::Complete(outcome)),
            (Ok(outcome), true) => ("interrupted", Ended::Interrupted(outcome)),
            (Err(error), _) => ("failed", Ended::Failed(error)),
        };
        progress.end(number, how);
        (number, ended)
    };
    let mut order: Vec<usize> = (0..experiments.len()).collect();
    order.sort_by(|&i, &j| experiments[j].share.total_cmp(&experiments[i].share));
    let finished = AtomicBool::new(false);
    let mut ended: Vec<(usize, Ended)> = std::thread::scope(|scope| {
        scope.spawn(|| progress.watch(|| finished.load(Ordering::Relaxed)));
        let _guard = SetAtEnd(&finished);
        // A bridge hands out one at a time, in this order.
        pool.install(|| order.into_iter().par_bridge().map(one).collect())
    });
    ended.sort_by_key(|(number, _)| *number);
    Ok(ended.into_iter().map(|(_, ended)| ended).collect())
}

/// Sets a flag when it goes out of scope, also in a panic.
struct SetAtEnd<'a>(&'a AtomicBool);

impl Drop for SetAtEnd<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
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
        let named = |name, run| Experiment { name, title: "", share: 1.0, run };
        let both = [named("a", broken as fn(&Job<'_>) -> _), named("b", quick)];
        let stop = AtomicBool::new(false);
        let ended = run(&both, Path::new("."), Length::Short, Some(2), &stop).expect("threads");
        assert!(matches!(&ended[..], [Ended::Failed(_), Ended::Complete(_)]), "{ended:?}");
    }

    #[test]
    fn nothing_starts_after_an_interrupt() {
        let stop = AtomicBool::new(true);
        let one = [Experiment { name: "a", title: "", share: 1.0, run: broken }];
        let ended = run(&one, Path::new("."), Length::Full, None, &stop).expect("threads");
        assert!(matches!(&ended[..], [Ended::NotStarted]), "{ended:?}");
    }
}
