//! Runs experiments side by side.

use std::path::Path;
use std::sync::mpsc;

use anyhow::{Context as _, Result};
use rayon::ThreadPoolBuilder;
use rayon::iter::{ParallelBridge as _, ParallelIterator as _};

use crate::claim::{Check, Claim};
use crate::experiments::SOURCES;
use crate::job::{Job, Length};
use crate::output::now;
use crate::progress::Progress;
use crate::record::Part;

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

/// Runs the experiments, and hands what each has left to `keep` once it has ended.
pub fn run(
    experiments: &[Experiment],
    folder: &Path,
    length: Length,
    threads: Option<u16>,
    keep: impl Fn(Part) -> Result<()> + Sync,
) -> Result<()> {
    let pool = ThreadPoolBuilder::new().num_threads(threads.map_or(0, usize::from)).build();
    let pool = pool.context("cannot start the threads")?;
    let progress = Progress::new(experiments);
    let one = |number: usize| {
        let Experiment { name, title, run, .. } = experiments[number];
        let job = Job { name, title, folder, length, bar: progress.start(number) };
        let outcome = run(&job).and_then(|outcome| job.publish_motion().map(|()| outcome));
        let outcome = outcome.map_err(|error| format!("{error:#}"));
        let how = if outcome.is_ok() { "done" } else { "failed" };
        keep(Part { experiment: name.to_owned(), length, when: now(), outcome })?;
        progress.end(number, how);
        Ok(())
    };
    let mut order: Vec<usize> = (0..experiments.len()).collect();
    order.sort_by(|&i, &j| experiments[i].share.total_cmp(&experiments[j].share));
    // Beside the others, which must not wait for it, the longest begins at once: else it would end alone.
    if pool.current_num_threads() > 1 && order.len() > 1 {
        order.rotate_right(1);
    }
    std::thread::scope(|scope| {
        // Until this is dropped, which a panic does too.
        let (_running, ended) = mpsc::channel();
        scope.spawn(|| progress.watch(ended));
        // A bridge hands out one at a time, in this order.
        pool.install(|| order.into_iter().par_bridge().try_for_each(one))
    })
}

#[cfg(test)]
mod tests {
    use std::sync::Mutex;

    use super::*;

    #[test]
    fn one_failure_does_not_stop_the_others() -> Result<()> {
        let named = |name, run| Experiment { name, title: "", source: "", share: 1.0, run };
        let both = [named("a", |_| anyhow::bail!("no ink")), named("b", |_| Ok(Outcome::default()))];
        let failures = Mutex::new(Vec::new());
        run(&both, Path::new("."), Length::Short, Some(1), |part| {
            failures.lock().expect("one thread").push(part.outcome.err());
            Ok(())
        })?;
        assert_eq!(*failures.lock().expect("one thread"), [Some("no ink".into()), None]);
        Ok(())
    }
}
