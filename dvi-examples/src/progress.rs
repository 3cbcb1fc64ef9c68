//! How far the experiments are: bars on a terminal, plain lines in regular intervals elsewhere.
//!
//! A terminal shows a bar for each experiment that runs, one for all, and the time left; an experiment that
//! has ended leaves a line. The bars are as wide as the terminal allows.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::time::{Duration, Instant};

use indicatif::{HumanDuration, MultiProgress, ProgressBar, ProgressStyle};

use crate::gallery::Experiment;

/// Between two looks at the bar of all.
const TICK: Duration = Duration::from_millis(200);
/// Between two plain lines.
const INTERVAL: Duration = Duration::from_secs(10);
/// Steps of the bar of all.
const TOTAL: f64 = 1e6;

/// The progress of all experiments of a run.
#[derive(Debug)]
pub struct Progress {
    /// Hidden where there is no terminal.
    bars: MultiProgress,
    all: ProgressBar,
    /// Each with its bar, once it has begun.
    items: Vec<(Experiment, OnceLock<ProgressBar>)>,
    ended: AtomicUsize,
}

impl Progress {
    pub fn new(experiments: &[Experiment]) -> Self {
        let bars = MultiProgress::new();
        let all = ProgressBar::new(TOTAL as u64).with_prefix("all").with_style(style("magenta"));
        let items = experiments.iter().map(|&experiment| (experiment, OnceLock::new())).collect();
        Self { all: bars.add(all), bars, items, ended: AtomicUsize::new(0) }
    }

    /// Begins the experiment of that number and gives its counter.
    pub fn start(&self, number: usize) -> ProgressBar {
        let (experiment, bar) = &self.items[number];
        let new = || ProgressBar::new(0).with_style(style("cyan")).with_prefix(experiment.name);
        bar.get_or_init(|| self.bars.insert_before(&self.all, new())).clone()
    }

    /// Ends the experiment of that number, with a word on how.
    pub fn end(&self, number: usize, how: &str) {
        let (name, bar) = (self.items[number].0.name, self.start(number));
        bar.finish_and_clear();
        self.bars.remove(&bar);
        let (ended, of) = (1 + self.ended.fetch_add(1, Ordering::Relaxed), self.items.len());
        let seconds = bar.elapsed().as_secs_f64();
        self.bars.suspend(|| eprintln!("{name:<20} {how}, {seconds:.1} s ({ended} of {of})"));
    }

    /// Shows how far all are every now and then, until the other end of the channel is dropped.
    pub fn watch(&self, ended: Receiver<()>) {
        let mut spoken = Instant::now();
        while ended.recv_timeout(TICK) == Err(RecvTimeoutError::Timeout) {
            self.all.set_position((self.fraction() * TOTAL) as u64);
            self.all.set_message(format!("{:#} left", HumanDuration(self.all.eta())));
            if self.bars.is_hidden() && spoken.elapsed() >= INTERVAL {
                spoken = Instant::now();
                self.speak();
            }
        }
        self.all.finish_and_clear();
    }

    fn speak(&self) {
        let is_running = |bar: &ProgressBar| !bar.is_finished();
        let running = self.items.iter().filter(|(_, bar)| bar.get().is_some_and(is_running));
        let running = running.map(|(of, bar)| format!("{} {:.0} %", of.name, 100.0 * fraction(bar.get())));
        let (percent, left) = (100.0 * self.fraction(), self.all.message());
        eprintln!("{percent:3.0} % of all, {left}: {}", running.collect::<Vec<_>>().join(", "));
    }

    /// The part of the work that is done.
    fn fraction(&self) -> f64 {
        let all: f64 = self.items.iter().map(|(of, _)| of.share).sum();
        let done: f64 = self.items.iter().map(|(of, bar)| of.share * fraction(bar.get())).sum();
        done / all
    }
}

/// The part of its work that the experiment of a bar has done.
fn fraction(bar: Option<&ProgressBar>) -> f64 {
    let counted = |bar: &ProgressBar| bar.position() as f64 / bar.length().unwrap_or(0).max(1) as f64;
    bar.map_or(0.0, |bar| if bar.is_finished() { 1.0 } else { counted(bar).min(1.0) })
}

/// Name, bar, per cent and a message, in any width from 50 columns on.
fn style(colour: &str) -> ProgressStyle {
    let template = format!("{{prefix:<20}} {{wide_bar:.{colour}}} {{percent:>3}} % {{msg:>11}}");
    // The template is a constant: if it were wrong, the plain default would still do.
    let style = ProgressStyle::with_template(&template).unwrap_or_else(|_| ProgressStyle::default_bar());
    style.progress_chars("━╸─")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gallery::Outcome;

    #[test]
    fn the_whole_is_the_sum_of_its_shares() {
        let named =
            |name, share| Experiment { name, title: "", source: "", share, run: |_| Ok(Outcome::default()) };
        let progress = Progress::new(&[named("a", 1.0), named("b", 3.0)]);
        assert_eq!(progress.fraction(), 0.0);
        let bar = progress.start(1);
        bar.inc_length(10);
        bar.inc(5);
        assert_eq!(progress.fraction(), 0.375);
        progress.end(1, "done");
        assert_eq!(progress.fraction(), 0.75);
    }
}
