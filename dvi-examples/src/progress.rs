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
/// What was done longer ago than this, in seconds, tells little of how fast the rest will be.
const MEMORY: f64 = 60.0;
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
        let (begun, mut spoken, mut speed) = (Instant::now(), Instant::now(), Speed::default());
        while ended.recv_timeout(TICK) == Err(RecvTimeoutError::Timeout) {
            let done = self.fraction();
            let left = match speed.left(begun.elapsed().as_secs_f64(), done) {
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

/// The work that was done in the seconds on the clock that it took, each with a weight that fades.
/// `indicatif` forgets within 15 seconds: beside other work what it says jumps by a factor of two.
#[derive(Debug, Default)]
struct Speed {
    done: f64,
    seconds: f64,
    last: [f64; 2],
}

impl Speed {
    /// The seconds that the rest takes, if so much of all is done after so many.
    fn left(&mut self, seconds: f64, done: f64) -> f64 {
        let past = seconds - self.last[0];
        let fade = (-past / MEMORY).exp();
        self.seconds = fade * self.seconds + past;
        self.done = fade * self.done + done - self.last[1];
        self.last = [seconds, done];
        (1.0 - done) * self.seconds / self.done.max(f64::MIN_POSITIVE)
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

    /// Three minutes of work, of which other work takes three quarters from the first minute on, and later
    /// all.
    #[test]
    fn the_time_left_follows_what_is_done_on_the_clock() {
        let mut speed = Speed::default();
        let done = |t: f64| (t.min(60.0) + 0.25 * (t - 60.0).clamp(0.0, 400.0)) / 180.0;
        for tick in 1..2700 {
            let t = 0.2 * f64::from(tick);
            let left = speed.left(t, done(t));
            match t {
                10.0..60.0 => assert!((left / (180.0 - t) - 1.0).abs() < 0.01, "{t}: {left}"),
                110.0..460.0 => assert!((0.5..2.0).contains(&(left / (540.0 - t))), "{t}: {left}"),
                _ => {}
            }
        }
        let before = speed.left(540.0, done(540.0));
        assert!(speed.left(900.0, done(540.0)) > 10.0 * before, "nothing is done, and the time left stays");
    }
}
