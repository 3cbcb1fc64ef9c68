//! What an experiment is given: a folder, a length, and somebody to tell how far it is.

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::Result;
use dvi_core::methods::Method;
use dvi_core::prelude::*;
use indicatif::ProgressBar;

use crate::deviation::{Deviation, Named, Plan, Series, Span, note};
use crate::experiments::title;
use crate::figure::Figure;
use crate::motions;
use crate::output::{Table, write_whole};
use crate::runs::place;

/// Full length as in the papers, or seconds instead of minutes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Length {
    Full,
    Short,
}

impl Length {
    pub fn name(self) -> &'static str {
        match self {
            Length::Full => "full",
            Length::Short => "short",
        }
    }

    /// The form that has this name.
    pub fn named(name: &str) -> Option<Self> {
        [Length::Full, Length::Short].into_iter().find(|length| length.name() == name)
    }
}

/// The surroundings of one experiment.
#[derive(Debug)]
pub struct Job<'a> {
    /// The name of the experiment.
    pub name: &'static str,
    pub folder: &'a Path,
    pub length: Length,
    pub bar: ProgressBar,
    /// Whether the user has asked to stop.
    pub stop: &'a AtomicBool,
    /// Whether a series ended before its time because of that.
    pub cut: AtomicBool,
}

/// Steps between two looks at the clock and at the interrupt flag.
const CHUNK: u64 = 4096;

impl Job<'_> {
    /// The first of the two in a full run, the second in a short one.
    pub fn choose<T>(&self, full: T, short: T) -> T {
        match self.length {
            Length::Full => full,
            Length::Short => short,
        }
    }

    /// A number that only a full run can measure.
    pub fn only_full(&self, value: impl Into<Option<f64>>) -> Option<f64> {
        self.choose(value.into(), None)
    }

    /// Announces steps for the progress bar to count; best all of an experiment at its beginning.
    pub fn expect(&self, steps: u64) {
        self.bar.inc_length(steps);
    }

    /// Whether the user has asked to stop.
    pub fn is_stopping(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    /// Counts `steps` more of those that were expected.
    pub fn proceed(&self, steps: u64) {
        self.bar.inc(steps);
    }

    /// Notes that a series ends before its time because the user wants to stop.
    pub fn cut_short(&self) {
        self.cut.store(true, Ordering::Relaxed);
    }

    /// Calls `step` `count` times; fewer, if the user interrupts.
    pub fn repeat(
        &self,
        count: u64,
        mut step: impl FnMut() -> Result<(), StepError>,
    ) -> Result<(), StepError> {
        let mut done = 0;
        while done < count && !self.is_stopping() {
            let chunk = CHUNK.min(count - done);
            (0..chunk).try_for_each(|_| step())?;
            self.proceed(chunk);
            done += chunk;
        }
        if done < count {
            self.cut_short();
        }
        Ok(())
    }

    /// Takes so many steps of a run, fewer if the user interrupts, and shows the state after each of them to
    /// `look`.
    pub fn follow<R: Run>(
        &self,
        run: &mut R,
        steps: u64,
        mut look: impl FnMut(&R),
    ) -> Result<(), StepError> {
        self.repeat(steps, || {
            run.advance()?;
            look(run);
            Ok(())
        })
    }

    /// How far quantities of a run are from their start in the course of so many steps; `of` returns that
    /// after each of them.
    pub fn keep<R: Run<Scalar = f64>, const N: usize>(
        &self,
        run: &mut R,
        steps: u64,
        span: Span,
        mut of: impl FnMut(&R) -> [f64; N],
    ) -> Result<[Deviation; N], StepError> {
        let mut kept = span.deviations();
        self.follow(run, steps, |run| note(&mut kept, run.time(), of(run)))?;
        Ok(kept)
    }

    /// The same as a series of that name, with the points that `of` adds to its path.
    pub fn series<R: Run<Scalar = f64>, const N: usize>(
        &self,
        (name, stroke): Named<'_>,
        run: &mut R,
        steps: u64,
        span: Span,
        mut of: impl FnMut(&R, &mut Vec<[f64; 2]>) -> [f64; N],
    ) -> Result<Series<N>, StepError> {
        let mut path = Vec::new();
        let kept = self.keep(run, steps, span, |run| of(run, &mut path))?;
        Ok(Series { path, ..Series::new(name, stroke, kept) })
    }

    /// E − E(0) of a run as a series of that name, with its first places, and the error that has ended it.
    pub fn attempt<S: Lagrangian>(
        &self,
        (name, stroke): Named<'_>,
        system: &S,
        method: impl Method<S, f64>,
        start: impl Into<S::State<f64>>,
        plan: Plan,
    ) -> Result<(Series<1>, Option<StepError>), StartError> {
        let mut run = Integrator::new(system, method, plan.h, start.into())?;
        let (energy, mut path) = (run.energy(), vec![place(&run)]);
        let span = Span { intervals: plan.intervals, ..Span::of(plan.steps, plan.h, plan.early) };
        let mut kept = span.deviations();
        let followed = self.follow(&mut run, plan.steps, |run| {
            note(&mut kept, run.time(), [run.energy() - energy]);
            if path.len() < plan.places {
                path.push(place(run));
            }
        });
        Ok((Series { path, ..Series::new(name, stroke, kept) }, followed.err()))
    }

    /// The same of a run that comes to its end.
    pub fn energy<S: Lagrangian>(
        &self,
        named: Named<'_>,
        system: &S,
        method: impl Method<S, f64>,
        start: impl Into<S::State<f64>>,
        plan: Plan,
    ) -> Result<Series<1>> {
        let (series, ended) = self.attempt(named, system, method, start, plan)?;
        ended.map_or(Ok(series), |error| Err(error.into()))
    }

    /// Writes the figure (SVG and PNG), which says if its run was short or interrupted, and its data (CSV).
    pub fn publish(&self, figure: Figure, data: Table) -> Result<()> {
        let figure = figure.titled(&format!("{}{}", title(self.name), self.choose("", " — short form")));
        let figure = if self.was_interrupted() { figure.interrupted() } else { figure };
        figure.save(self.folder, self.name)?;
        data.save(self.folder, self.name)
    }

    /// Writes the page of its motion (HTML), if it has one.
    pub fn publish_motion(&self) -> Result<()> {
        let Some(record) = motions::of(self.name)? else { return Ok(()) };
        let mut page = Vec::new();
        record.write_page(&mut page)?;
        write_whole(&self.folder.join(format!("{}.html", self.name)), &page)
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
        let (stop, mut count) = (AtomicBool::new(false), 0);
        let (folder, bar, cut) = (Path::new(""), ProgressBar::hidden(), AtomicBool::new(false));
        let job = Job { name: "", folder, length: Length::Short, bar, stop: &stop, cut };
        let mut steps = |number, last| {
            let done = job.repeat(number, || {
                count += 1;
                stop.store(count > last, Ordering::Relaxed);
                Ok(())
            });
            assert_eq!(done, Ok(()));
            (count, job.was_interrupted())
        };
        assert_eq!(steps(10_000, 20_000), (10_000, false));
        let (count, interrupted) = steps(1_000_000, 20_000);
        assert!(interrupted && (20_000..20_000 + 2 * CHUNK).contains(&count), "{count}");
    }
}
