//! What an experiment is given: a folder, a length, and somebody to tell how far it is.

use std::path::Path;

use indicatif::ProgressBar;

use crate::motions;
use crate::output::write_whole;
use crate::vocabulary::*;

/// Full length as in the papers, or seconds instead of minutes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
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
}

#[derive(Debug)]
pub struct Job<'a> {
    pub name: &'static str,
    pub title: &'static str,
    pub folder: &'a Path,
    pub length: Length,
    pub bar: ProgressBar,
}

/// Steps that are counted at once.
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

    /// Announces steps for the progress to count; best all of an experiment at its beginning.
    pub fn expect(&self, steps: u64) {
        self.bar.inc_length(steps);
    }

    /// Counts `steps` more of those that were expected.
    pub fn proceed(&self, steps: u64) {
        self.bar.inc(steps);
    }

    /// Calls `step` `count` times, or until it fails.
    pub fn repeat<E>(&self, count: u64, mut step: impl FnMut() -> Result<(), E>) -> Result<(), E> {
        for done in (0..count).step_by(CHUNK as usize) {
            let chunk = CHUNK.min(count - done);
            (0..chunk).try_for_each(|_| step())?;
            self.proceed(chunk);
        }
        Ok(())
    }

    /// Takes so many steps of a run, and shows the state after each of them to `look`.
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

    /// How far quantities of a run are from their start, as a series of that name: `of` returns that after
    /// each step, up to the last or to one that fails, and may add points to its path.
    pub fn series<R: Run<Scalar = f64>, const N: usize>(
        &self,
        named: Named<'_>,
        run: &mut R,
        span: Span,
        mut of: impl FnMut(&R, &mut Vec<[f64; 2]>) -> [f64; N],
    ) -> Series<N> {
        let mut series = Series::new(named, run.step_size(), span.envelopes());
        let Series { h, kept, path, .. } = &mut series;
        series.ended = self.follow(run, span.steps(*h), |run| note(kept, run.time(), of(run, path))).err();
        series
    }

    /// A series of what is no run: `step` takes so many steps of length `h` at once.
    pub fn watch<E, const N: usize>(
        &self,
        named: Named<'_>,
        span: Span,
        (h, at_once): (f64, u64),
        mut step: impl FnMut() -> Result<[f64; N], E>,
    ) -> Result<Series<N>, E> {
        let (mut series, mut done) = (Series::new(named, h, span.envelopes()), 0);
        self.repeat(span.steps(h) / at_once, || {
            done += at_once;
            step().map(|values| note(&mut series.kept, done as f64 * h, values))
        })?;
        Ok(series)
    }

    /// E − E(0) of a run as a series of that name, with so many of its first places.
    pub fn energy(
        &self,
        named: Named<'_>,
        mut run: impl Run<Scalar = f64>,
        span: Span,
        places: usize,
    ) -> Series<1> {
        let (energy, start) = (run.energy(), place(&run));
        let series = self.series(named, &mut run, span, |run, path| {
            if path.len() + 1 < places {
                path.push(place(run));
            }
            [run.energy() - energy]
        });
        Series { path: [&[start], &series.path[..]].concat(), ..series }
    }

    /// Writes the figure (SVG and PNG), which says if its run was short, and its data (CSV).
    pub fn publish(&self, figure: Figure, data: Result<Table>) -> Result<()> {
        let figure = figure.titled(&format!("{}{}", self.title, self.choose("", " — short form")));
        figure.save(self.folder, self.name)?;
        data?.save(self.folder, self.name)
    }

    /// Writes the page of its motion (HTML), if it has one.
    pub fn publish_motion(&self) -> Result<()> {
        let Some(record) = motions::of(self.name)? else { return Ok(()) };
        let mut page = Vec::new();
        record.write_page(&mut page)?;
        write_whole(&self.folder.join(format!("{}.html", self.name)), &page)
    }
}
