//! A problem, the methods on it, and the runs of a method.

use cpu_time::ThreadTime;

/// A motion from one state to one time.
pub(crate) struct Problem {
    /// Its name in the table of all points.
    pub(crate) name: &'static str,
    pub(crate) title: &'static str,
    /// What is kept: |ΔH| or |ΔH|/|H|.
    pub(crate) error: &'static str,
    pub(crate) methods: Vec<Method>,
}

/// A method over its steps or tolerances.
pub(crate) struct Method {
    pub(crate) name: String,
    pub(crate) runs: Vec<Run>,
}

/// What one run shows.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seen {
    /// The largest error of the energy at the ends of the steps.
    pub(crate) error: f64,
    /// Evaluations of the right-hand side.
    pub(crate) evaluations: u64,
}

/// One run, which can be made as often as wanted.
pub(crate) struct Run {
    /// The run by itself, which looks at no energy; false if it does not come to its end.
    alone: Box<dyn Fn() -> bool>,
    /// The same run with the energy after each step.
    watched: Box<dyn Fn() -> Option<Seen>>,
}

impl Run {
    pub(crate) fn new(
        alone: impl Fn() -> bool + 'static,
        watched: impl Fn() -> Option<Seen> + 'static,
    ) -> Self {
        Self { alone: Box::new(alone), watched: Box::new(watched) }
    }

    /// What the run shows, if it comes to its end.
    pub(crate) fn watch(&self) -> Option<Seen> {
        (self.watched)().filter(|seen| seen.error.is_finite())
    }

    /// Milliseconds of the run in time of the processor, the mean of as many as take `least` milliseconds
    /// together.
    pub(crate) fn time(&self, least: f64) -> f64 {
        let begin = ThreadTime::now();
        let elapsed = || 1e3 * begin.elapsed().as_secs_f64();
        let mut count = 0.0;
        loop {
            assert!((self.alone)(), "a run that came to its end before does so again");
            count += 1.0;
            let elapsed = elapsed();
            if elapsed >= least {
                return elapsed / count;
            }
        }
    }
}

/// The errors of the energy along a run.
pub(crate) struct Watch {
    initial: f64,
    unit: f64,
    largest: f64,
}

impl Watch {
    /// Errors in units of the energy at the start, or absolute ones.
    pub(crate) fn new(initial: f64, scale: Scale) -> Self {
        let unit = match scale {
            Scale::Absolute => 1.0,
            Scale::Relative => initial.abs(),
        };
        Self { initial, unit, largest: 0.0 }
    }

    pub(crate) fn note(&mut self, energy: f64) {
        self.largest = dvi_tests::larger(self.largest, (energy - self.initial).abs() / self.unit);
    }

    pub(crate) fn seen(&self, evaluations: u64) -> Seen {
        Seen { error: self.largest, evaluations }
    }
}

/// What an error of the energy is measured in.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Scale {
    Absolute,
    Relative,
}

/// `count` numbers of steps up to `most`, each `ratio` times the one before.
pub(crate) fn steps_up_to(most: f64, ratio: f64, count: i32) -> Vec<u64> {
    (0..count).rev().map(|k| (most / ratio.powi(k)).round() as u64).collect()
}

/// Tolerances from 10⁻⁴ on, four in a decade.
pub(crate) fn tolerances(last: i32) -> Vec<f64> {
    (16..=4 * last).map(|k| 10f64.powf(-0.25 * f64::from(k))).collect()
}
