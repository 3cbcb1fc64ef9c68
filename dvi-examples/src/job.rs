//! What an experiment is given: a folder, a length, and somebody to tell how far it is.

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};

use dvi_core::StepError;
use indicatif::ProgressBar;

/// Full length as in the papers, or seconds instead of minutes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Length {
    Full,
    Short,
}

/// The surroundings of one experiment.
#[derive(Debug)]
pub struct Job<'a> {
    pub folder: PathBuf,
    length: Length,
    bar: ProgressBar,
    stop: &'a AtomicBool,
    cut: AtomicBool,
}

/// How a series ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ending {
    Complete,
    Interrupted,
    Failed(StepError),
}

/// Steps between two looks at the clock and at the interrupt flag.
const CHUNK: u64 = 4096;

impl<'a> Job<'a> {
    pub fn new(folder: PathBuf, length: Length, bar: ProgressBar, stop: &'a AtomicBool) -> Self {
        Self { folder, length, bar, stop, cut: AtomicBool::new(false) }
    }

    /// The first of the two in a full run, the second in a short one.
    pub fn choose<T>(&self, full: T, short: T) -> T {
        match self.length {
            Length::Full => full,
            Length::Short => short,
        }
    }

    /// A number that only a full run can measure.
    pub fn only_full<T>(&self, value: T) -> Option<T> {
        self.choose(Some(value), None)
    }

    /// Announces steps that the progress bar counts.
    pub fn expect(&self, steps: u64) {
        self.bar.inc_length(steps);
    }

    /// Whether the user has asked to stop.
    pub fn is_stopping(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    /// Counts `steps` more; false if the user interrupts, and the series should end.
    pub fn proceed(&self, steps: u64) -> bool {
        self.bar.inc(steps);
        let stop = self.is_stopping();
        if stop {
            self.cut.store(true, Ordering::Relaxed);
        }
        !stop
    }

    /// Calls `step` `count` times, unless it fails or the user interrupts.
    pub fn repeat(&self, count: u64, mut step: impl FnMut() -> Result<(), StepError>) -> Ending {
        let mut done = 0;
        while done < count {
            let chunk = CHUNK.min(count - done);
            for _ in 0..chunk {
                if let Err(error) = step() {
                    self.bar.inc(count - done);
                    return Ending::Failed(error);
                }
            }
            done += chunk;
            if !self.proceed(chunk) {
                return Ending::Interrupted;
            }
        }
        Ending::Complete
    }

    /// Whether a series of this experiment was cut short by the user.
    pub fn was_interrupted(&self) -> bool {
        self.cut.load(Ordering::Relaxed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_series_ends_at_the_interrupt_and_says_so() {
        let stop = AtomicBool::new(false);
        let job = Job::new(PathBuf::new(), Length::Short, ProgressBar::hidden(), &stop);
        let mut count = 0;
        assert_eq!(job.repeat(10_000, || Ok(count += 1)), Ending::Complete);
        assert_eq!((count, job.was_interrupted()), (10_000, false));
        let ending = job.repeat(1_000_000, || {
            count += 1;
            stop.store(count > 20_000, Ordering::Relaxed);
            Ok(())
        });
        assert_eq!(ending, Ending::Interrupted);
        assert!(job.was_interrupted() && (20_000..20_000 + 2 * CHUNK).contains(&count), "{count}");
    }
}
