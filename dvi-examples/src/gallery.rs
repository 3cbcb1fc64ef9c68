//! Runs experiments side by side, each with its own progress bar.

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::{Context as _, Result};
use indicatif::{MultiProgress, ProgressBar, ProgressStyle};
use rayon::ThreadPoolBuilder;
use rayon::prelude::*;

use crate::claim::Claim;
use crate::job::{Job, Length};

/// One model and one picture.
#[derive(Clone, Copy, Debug)]
pub struct Experiment {
    /// What `--only` takes, and what its files are called.
    pub name: &'static str,
    pub title: &'static str,
    pub run: fn(&Job<'_>) -> Result<Outcome>,
}

/// What an experiment has to say.
#[derive(Clone, Debug, Default)]
pub struct Outcome {
    pub claims: Vec<Claim>,
    /// Sentences that belong to the numbers: conventions, endings of series.
    pub notes: Vec<String>,
}

/// How an experiment ended.
#[derive(Debug)]
pub enum Ended {
    Complete(Outcome),
    Interrupted(Outcome),
    NotStarted,
    Failed(anyhow::Error),
}

pub fn run(
    experiments: &[Experiment],
    folder: &Path,
    length: Length,
    threads: Option<u16>,
    stop: &AtomicBool,
) -> Result<Vec<Ended>> {
    let pool = ThreadPoolBuilder::new().num_threads(threads.map_or(0, usize::from)).build();
    let pool = pool.context("cannot start the threads")?;
    let bars = MultiProgress::new();
    let bars: Vec<_> = experiments.iter().map(|experiment| bars.add(bar(experiment))).collect();
    let one = |(experiment, bar): (&Experiment, ProgressBar)| {
        if stop.load(Ordering::Relaxed) {
            bar.abandon_with_message("not started");
            return Ended::NotStarted;
        }
        bar.reset_elapsed();
        bar.set_length(0);
        bar.set_message("");
        let job = Job::new(folder.to_owned(), length, bar.clone(), stop);
        let result = (experiment.run)(&job);
        let seconds = format!("{:.1} s", bar.elapsed().as_secs_f64());
        match (result, job.was_interrupted()) {
            (Ok(outcome), false) => {
                bar.finish_with_message(seconds);
                Ended::Complete(outcome)
            }
            (Ok(outcome), true) => {
                bar.abandon_with_message(format!("interrupted after {seconds}"));
                Ended::Interrupted(outcome)
            }
            (Err(error), _) => {
                bar.abandon_with_message("failed");
                Ended::Failed(error)
            }
        }
    };
    Ok(pool.install(|| experiments.par_iter().zip(bars).map(one).collect()))
}

fn bar(experiment: &Experiment) -> ProgressBar {
    // Without any length it would look complete.
    let bar = ProgressBar::new(1).with_prefix(experiment.name).with_message("waiting");
    // The template is a constant: if it were wrong, the plain default would still do.
    ProgressStyle::with_template("{prefix:<20} {bar:40.cyan/blue} {percent:>3} %  {msg}")
        .map(|style| bar.set_style(style.progress_chars("━╸─")))
        .unwrap_or_default();
    bar.tick();
    bar
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
        let named = |name, run| Experiment { name, title: "", run };
        let both = [named("a", broken as fn(&Job<'_>) -> _), named("b", quick)];
        let stop = AtomicBool::new(false);
        let ended = run(&both, Path::new("."), Length::Short, Some(2), &stop).expect("threads");
        assert!(matches!(&ended[..], [Ended::Failed(_), Ended::Complete(_)]), "{ended:?}");
    }

    #[test]
    fn nothing_starts_after_an_interrupt() {
        let stop = AtomicBool::new(true);
        let one = [Experiment { name: "a", title: "", run: broken }];
        let ended = run(&one, Path::new("."), Length::Full, None, &stop).expect("threads");
        assert!(matches!(&ended[..], [Ended::NotStarted]), "{ended:?}");
    }
}
