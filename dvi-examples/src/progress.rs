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
/// What was done longer ago than this, in seconds, tells little of how fast the rest will be.
const MEMORY: f64 = 60.0;
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
        let (begun, mut spoken, mut speed) = (Instant::now(), Instant::now(), Speed::default());
        while ended.recv_timeout(TICK) == Err(RecvTimeoutError::Timeout) {
            let done = self.fraction();
            let left = match speed.left(begun.elapsed().as_secs_f64(), done) {
                left if left < 1e5 => format!("{:#} left", HumanDuration(Duration::from_secs_f64(left))),
                _ => "…".to_owned(),
            };
            self.all.set_position((done * TOTAL) as u64);
            self.all.set_message(left);
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
