//! How far the experiments are: a bar on a terminal, plain lines in regular intervals elsewhere, and the
//! time left and what runs. An experiment that has ended leaves a line.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::time::{Duration, Instant};

use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::gallery::Experiment;

/// Between two looks at what is done.
const TICK: Duration = Duration::from_millis(200);
/// Between two plain lines.
const INTERVAL: Duration = Duration::from_secs(10);
const TOTAL: f64 = 1e6;

#[derive(Debug)]
pub struct Progress {
    /// Hidden where there is no terminal.
    all: ProgressBar,
    /// Each with its counter.
    items: Vec<(Experiment, ProgressBar)>,
    ended: AtomicUsize,
}

impl Progress {
    pub fn new(experiments: &[Experiment]) -> Self {
        let style = ProgressStyle::with_template("{bar:20.magenta} {percent:>3} % of all, {wide_msg}");
        // The template is a constant: if it were wrong, the plain default would still do.
        let style = style.unwrap_or_else(|_| ProgressStyle::default_bar()).progress_chars("━╸─");
        let counter = || ProgressBar::with_draw_target(Some(0), ProgressDrawTarget::hidden());
        let items = experiments.iter().map(|&experiment| (experiment, counter())).collect();
        Self { all: ProgressBar::new(TOTAL as u64).with_style(style), items, ended: AtomicUsize::new(0) }
    }

    /// Begins the experiment of that number and gives its counter.
    pub fn start(&self, number: usize) -> ProgressBar {
        let (_, counter) = &self.items[number];
        counter.reset_elapsed();
        counter.clone()
    }

    /// Ends the experiment of that number, with a word on how.
    pub fn end(&self, number: usize, how: &str) {
        let (Experiment { name, .. }, counter) = &self.items[number];
        counter.finish();
        let (ended, of) = (1 + self.ended.fetch_add(1, Ordering::Relaxed), self.items.len());
        let seconds = counter.elapsed().as_secs_f64();
        self.all.suspend(|| eprintln!("{name:<20} {how}, {seconds:.1} s ({ended} of {of})"));
    }

    /// Shows how far all are every now and then, until the other end of the channel is dropped.
    pub fn watch(&self, ended: Receiver<()>) {
        let (begun, mut spoken) = (Instant::now(), Instant::now());
        while ended.recv_timeout(TICK) == Err(RecvTimeoutError::Timeout) {
            let done = self.fraction();
            let left = match begun.elapsed().as_secs_f64() * (1.0 - done) / done {
                left if left < 1e5 => format!("{:#} left", HumanDuration(Duration::from_secs_f64(left))),
                _ => "…".to_owned(),
            };
            let begun = self.items.iter().filter(|(_, counter)| counter.length() > Some(0));
            let running = begun.filter(|(_, counter)| !counter.is_finished());
            let running = running.map(|(of, counter)| format!("{} {:.0} %", of.name, 100.0 * part(counter)));
            let message = format!("{left}: {}", running.collect::<Vec<_>>().join(", "));
            if self.all.is_hidden() && spoken.elapsed() >= INTERVAL {
                spoken = Instant::now();
                eprintln!("{:3.0} % of all, {message}", 100.0 * done);
            }
            self.all.set_position((done * TOTAL) as u64);
            self.all.set_message(message);
        }
        self.all.finish_and_clear();
    }

    fn fraction(&self) -> f64 {
        let all: f64 = self.items.iter().map(|(of, _)| of.share).sum();
        self.items.iter().map(|(of, counter)| of.share * part(counter)).sum::<f64>() / all
    }
}

/// The part of its work that an experiment has done; those that take a few seconds do not count.
fn part(counter: &ProgressBar) -> f64 {
    let counted = counter.position() as f64 / counter.length().unwrap_or(0).max(1) as f64;
    if counter.is_finished() { 1.0 } else { counted.min(1.0) }
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
