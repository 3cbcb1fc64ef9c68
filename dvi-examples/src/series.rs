//! Series: what runs should keep, over time, with the panels and the tables of that.

use crate::vocabulary::*;

/// How long a run is, when its beginning ends, and in how many intervals it is drawn.
#[derive(Clone, Copy, Debug)]
pub struct Span {
    pub end: f64,
    pub early: f64,
    pub intervals: usize,
}

impl Span {
    /// That of so many steps of length `h`, drawn in 400 intervals, of which so many are the beginning.
    pub fn of(steps: u64, h: f64, early: u64) -> Self {
        Self { end: steps as f64 * h, early: early as f64 * h, intervals: 400 }
    }

    pub fn steps(self, h: f64) -> u64 {
        (self.end / h).round() as u64
    }

    pub fn envelopes<const N: usize>(self) -> [Envelope; N] {
        std::array::from_fn(|_| Envelope::new(self.end, self.intervals, self.early))
    }
}

/// Adds the values of several quantities at time `t`.
pub fn note<const N: usize>(kept: &mut [Envelope; N], t: f64, values: [f64; N]) {
    kept.iter_mut().zip(values).for_each(|(of, value)| of.push(t, value));
}

/// The name of a run, and the line that figures show it with.
pub type Named<'a> = (&'a str, Stroke);

/// A run by its name, by the line that figures show it with, by the length of its steps, by what it should
/// keep, by points of its path, and by the error that has ended it early.
#[derive(Clone, Debug)]
pub struct Series<const N: usize> {
    pub name: String,
    pub stroke: Stroke,
    pub h: f64,
    pub kept: [Envelope; N],
    pub path: Points,
    pub ended: Option<StepError>,
}

impl<const N: usize> Series<N> {
    pub fn new((name, stroke): Named<'_>, h: f64, kept: [Envelope; N]) -> Self {
        Self { name: name.into(), stroke, h, kept, path: Vec::new(), ended: None }
    }

    /// The series of a run that comes to its end.
    pub fn whole(self) -> Result<Self> {
        self.ended.map_or(Ok(self), |error| Err(error.into()))
    }

    /// What the series is, for [`Panel::lines`], over any points.
    pub fn line(&self, points: Points) -> Line<&str> {
        (&self.name, self.stroke, points)
    }
}

/// A line for each run, for [`Panel::lines`]: the largest magnitude of a quantity in each interval of time.
pub fn magnitudes<'a, const N: usize>(
    all: impl IntoIterator<Item = &'a Series<N>>,
    quantity: usize,
) -> Vec<Line<&'a str>> {
    all.into_iter().map(|series| series.line(series.kept[quantity].magnitude())).collect()
}

/// A panel of that up to time `end`.
pub fn over_time<'a, const N: usize>(
    [title, label]: [&str; 2],
    end: f64,
    range: [f64; 2],
    all: impl IntoIterator<Item = &'a Series<N>>,
    quantity: usize,
) -> Panel {
    Panel::semilog(title, ("time *t*", [0.0, end]), (label, range)).lines(magnitudes(all, quantity))
}

/// A table with the name of each run, time, and the largest magnitudes of as many quantities as there are
/// columns.
pub fn magnitude_table<'a, const N: usize>(
    columns: &str,
    all: impl IntoIterator<Item = &'a Series<N>>,
) -> Result<Table> {
    let quantities = columns.split(',').skip(2).count().min(N);
    let curves = all.into_iter().map(|Series { name, kept, .. }| {
        let others: Vec<_> = kept[1..quantities].iter().map(Envelope::magnitude).collect();
        let row = move |(k, [t, first]): (usize, [f64; 2])| {
            [t, first].into_iter().chain(others.iter().map(|of| of[k][1])).collect::<Vec<_>>()
        };
        ([name], [], kept[0].magnitude().into_iter().enumerate().map(row))
    });
    curve_table(columns, curves)
}

/// A table with the name of each run, that of each of its quantities if there is a column for it, time, and
/// after these columns the lowest, mean and highest value in each interval of time.
pub fn range_table<'a, const N: usize>(
    columns: &str,
    quantities: &[&str],
    all: impl IntoIterator<Item = &'a Series<N>>,
) -> Result<Table> {
    let names = columns.split(',').skip(1).count();
    let curves = all.into_iter().flat_map(|Series { name, kept, .. }| {
        let named = quantities.iter().map(move |quantity| [name, *quantity].into_iter().take(names));
        named.zip(kept).map(|(texts, of)| (texts, [], of.rows()))
    });
    curve_table(&format!("{columns},lowest,mean,highest"), curves)
}

/// A table of curves, each with its names, the numbers that belong to all of it, and its points.
pub fn curve_table<T, N, P, C: Into<Option<f64>>>(
    columns: &str,
    curves: impl IntoIterator<Item = (T, N, P)>,
) -> Result<Table>
where
    T: IntoIterator<Item: AsRef<str>> + Clone,
    N: IntoIterator<Item = C> + Clone,
    P: IntoIterator<Item: IntoIterator<Item = C>>,
{
    let rows = curves.into_iter().flat_map(|(names, numbers, points)| {
        let rows = points.into_iter();
        rows.map(move |point| (names.clone(), numbers.clone().into_iter().chain(point).map(Into::into)))
    });
    Table::of(columns, rows)
}
