//! How far the experiments are: bars on a terminal, plain lines in regular intervals elsewhere.
//!
//! A terminal shows a bar for each experiment that runs, one for all, and the time left; an experiment that
//! has ended leaves a line. The bars are as wide as the terminal allows.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use console::Term;
use indicatif::{MultiProgress, ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::gallery::Experiment;

/// Between two looks at the bar of all.
const TICK: Duration = Duration::from_millis(200);
/// Between two plain lines.
const INTERVAL: Duration = Duration::from_secs(10);
/// What was done longer ago than this tells little of how fast the rest will be, beside other work.
const MEMORY: f64 = 60.0;
/// Of all `TOTAL` steps of the bar of all.
const TOTAL: u64 = 1000;

/// The progress of all experiments of a run.
#[derive(Debug)]
pub struct Progress {
    /// What draws, if somebody watches.
    bars: Option<(MultiProgress, ProgressBar)>,
    items: Vec<Item>,
    ended: AtomicUsize,
    begun: Instant,
    spoken: Mutex<Instant>,
    speed: Mutex<Speed>,
}

/// The work that was done in the seconds on the clock that it took, each with a weight that fades.
#[derive(Clone, Copy, Debug, Default)]
struct Speed {
    done: f64,
    seconds: f64,
    last: [f64; 2],
}

#[derive(Debug)]
struct Item {
    name: &'static str,
    /// Its share of the work, in any unit.
    share: f64,
    bar: ProgressBar,
    state: Mutex<State>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    Waiting,
    Running(Instant),
    Ended,
}

impl Progress {
    pub fn new(experiments: &[Experiment]) -> Self {
        let item = |experiment: &Experiment| Item {
            name: experiment.name,
            share: experiment.share,
            bar: ProgressBar::with_draw_target(Some(0), ProgressDrawTarget::hidden()),
            state: Mutex::new(State::Waiting),
        };
        let bars = Term::stderr().is_term().then(|| {
            let bars = MultiProgress::new();
            let all = bars.add(ProgressBar::new(TOTAL).with_prefix("all").with_style(style("magenta")));
            (bars, all)
        });
        let (ended, begun) = (AtomicUsize::new(0), Instant::now());
        let items = experiments.iter().map(item).collect();
        Self { bars, items, ended, begun, spoken: Mutex::new(begun), speed: Mutex::default() }
    }

    /// Begins the experiment of that number and gives its counter.
    pub fn start(&self, number: usize) -> ProgressBar {
        let item = &self.items[number];
        item.set(State::Running(Instant::now()));
        if let Some((bars, all)) = &self.bars {
            let bar = item.bar.clone().with_style(style("cyan")).with_prefix(item.name);
            bars.insert_before(all, bar);
        }
        item.bar.clone()
    }

    /// Ends the experiment of that number, with a word on how.
    pub fn end(&self, number: usize, how: &str) {
        let item = &self.items[number];
        let seconds = match item.state() {
            State::Running(begun) => format!("{:.1} s", begun.elapsed().as_secs_f64()),
            State::Waiting | State::Ended => "-".to_owned(),
        };
        item.set(State::Ended);
        let ended = 1 + self.ended.fetch_add(1, Ordering::Relaxed);
        let line = format!("{:<20} {how}, {seconds} ({ended} of {})", item.name, self.items.len());
        match &self.bars {
            Some((bars, all)) => {
                item.bar.finish_and_clear();
                bars.remove(&item.bar);
                all.suspend(|| eprintln!("{line}"));
            }
            None => eprintln!("{line}"),
        }
    }

    /// Shows where all experiments are, every now and then; returns when `done` says so.
    pub fn watch(&self, done: impl Fn() -> bool) {
        while !done() {
            std::thread::sleep(TICK);
            match &self.bars {
                Some((_, all)) => {
                    all.set_position((self.fraction() * TOTAL as f64) as u64);
                    all.set_message(self.left());
                }
                None => self.speak(),
            }
        }
        if let Some((_, all)) = &self.bars {
            all.finish_and_clear();
        }
    }

    /// A plain line, if it is time for one.
    fn speak(&self) {
        let mut spoken = self.spoken.lock().unwrap_or_else(PoisonError::into_inner);
        if spoken.elapsed() < INTERVAL {
            return;
        }
        *spoken = Instant::now();
        let running = self.items.iter().filter(|item| matches!(item.state(), State::Running(_)));
        let running = running.map(|item| format!("{} {:.0} %", item.name, 100.0 * item.fraction()));
        let running: Vec<String> = running.collect();
        let percent = 100.0 * self.fraction();
        eprintln!("{percent:3.0} % of all, {}: {}", self.left(), running.join(", "));
    }

    /// The part of the work that is done.
    fn fraction(&self) -> f64 {
        let all: f64 = self.items.iter().map(|item| item.share).sum();
        let done: f64 = self.items.iter().map(|item| item.share * item.fraction()).sum();
        done / all
    }

    /// The time left, if the rest goes on as what was done lately.
    fn left(&self) -> String {
        let (elapsed, fraction) = (self.begun.elapsed().as_secs_f64(), self.fraction());
        let mut speed = self.speed.lock().unwrap_or_else(PoisonError::into_inner);
        speed.note(elapsed, fraction);
        match speed.left(fraction) {
            _ if elapsed < 2.0 => "…".into(),
            seconds if seconds < 90.0 => format!("{seconds:.0} s left"),
            seconds if seconds < 1e5 => format!("{:.0} min left", seconds / 60.0),
            _ => "…".into(),
        }
    }
}

impl Speed {
    /// Notes how much is done in all at a time.
    fn note(&mut self, seconds: f64, done: f64) {
        let past = seconds - self.last[0];
        let fade = (-past / MEMORY).exp();
        self.seconds = fade * self.seconds + past;
        self.done = fade * self.done + (done - self.last[1]);
        self.last = [seconds, done];
    }

    /// The seconds that the rest takes.
    fn left(&self, done: f64) -> f64 {
        (1.0 - done) * self.seconds / self.done.max(f64::MIN_POSITIVE)
    }
}

impl Item {
    fn state(&self) -> State {
        *self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn set(&self, state: State) {
        *self.state.lock().unwrap_or_else(PoisonError::into_inner) = state;
    }

    fn fraction(&self) -> f64 {
        match self.state() {
            State::Waiting => 0.0,
            State::Ended => 1.0,
            State::Running(_) => {
                let length = self.bar.length().unwrap_or(0).max(1);
                (self.bar.position() as f64 / length as f64).min(1.0)
            }
        }
    }
}

/// Name, bar, per cent and a message, in any width from 50 columns on.
fn style(colour: &str) -> ProgressStyle {
    let template = format!("{{prefix:<20}} {{wide_bar:.{colour}}} {{percent:>3}} % {{msg:>11}}");
    // The template is a constant: if it were wrong, the plain default would still do.
    ProgressStyle::with_template(&template)
        .unwrap_or_else(|_| ProgressStyle::default_bar())
        .progress_chars("━╸─")
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
        assert_eq!(progress.left(), "…");
    }
    /// Three minutes of work, of which other work takes three quarters from the first minute on, and later
    /// all.
    #[test]
    fn the_time_left_follows_what_is_done_on_the_clock() {
        let mut speed = Speed::default();
        let done = |t: f64| (t.min(60.0) + 0.25 * (t - 60.0).clamp(0.0, 400.0)) / 180.0;
        for tick in 1..2700 {
            let t = 0.2 * f64::from(tick);
            speed.note(t, done(t));
            let (left, right) = (speed.left(done(t)), 540.0 - t);
            let alone = 180.0 - t;
            match t {
                10.0..60.0 => assert!((left / alone - 1.0).abs() < 0.01, "{t}: {left}"),
                110.0..460.0 => assert!((0.5..2.0).contains(&(left / right)), "{t}: {left}"),
                _ => {}
            }
        }
        let before = speed.left(done(540.0));
        speed.note(900.0, done(540.0));
        assert!(speed.left(done(540.0)) > 10.0 * before, "nothing is done, and the time left does not grow");
    }
}
