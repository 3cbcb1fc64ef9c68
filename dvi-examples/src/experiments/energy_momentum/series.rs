//! What one run leaves.

use anyhow::Result;
use dvi_core::prelude::*;

use super::{COMPARED, Motion};
use crate::claim::larger;
use crate::deviation::Deviation;
use crate::job::Job;

/// The lowest and the highest of some numbers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Range {
    pub low: f64,
    pub high: f64,
}

/// A step of the beginning of a run.
#[derive(Clone, Copy, Debug)]
pub(super) struct Step {
    /// The time at its end.
    pub t: f64,
    pub length: f64,
    /// E − E(0) at its end.
    pub energy: f64,
}

pub(super) struct Series {
    pub system: &'static str,
    pub name: &'static str,
    /// The steps that it should take, and those that it has taken.
    wanted: u64,
    steps: u64,
    end: f64,
    /// E_d − e over the number of the step.
    pub discrete: Deviation,
    pub discrete_range: Range,
    /// E − E(0).
    pub energy: Range,
    /// The largest |l − l(0)|.
    pub momentum: f64,
    pub lengths: Range,
    /// The times that the first and the last tenth of the steps take.
    tenths: [f64; 2],
    /// The largest distance from the motion at times up to [`COMPARED`].
    pub distance: f64,
    /// Evaluations of first and second derivatives.
    work: u64,
    pub beginning: Vec<Step>,
}

/// Intervals of the run in which E_d − e is drawn.
const INTERVALS: usize = 100;
/// The time up to which each step is drawn.
pub(super) const BEGINNING: f64 = 15.0;

/// The discrete energy of a step of the midpoint rule.
pub(super) fn discrete_energy(h: f64, [q0, q1]: [[f64; 2]; 2], potential: fn(f64) -> f64) -> f64 {
    let velocity: [f64; 2] = std::array::from_fn(|i| (q1[i] - q0[i]) / h);
    let middle: [f64; 2] = std::array::from_fn(|i| 0.5 * (q0[i] + q1[i]));
    0.5 * square(velocity) + potential(square(middle))
}

pub(super) fn square([x, y]: [f64; 2]) -> f64 {
    x * x + y * y
}

impl Range {
    const EMPTY: Self = Self { low: f64::INFINITY, high: f64::NEG_INFINITY };

    /// Not a number, once one of the values is not.
    fn push(&mut self, value: f64) {
        self.low = -larger(-self.low, -value);
        self.high = larger(self.high, value);
    }

    pub(super) fn width(self) -> f64 {
        self.high - self.low
    }
}

impl Series {
    pub(super) fn new<S, R>(
        job: &Job<'_>,
        name: &'static str,
        motion: &Motion<'_, S>,
        mut run: R,
        steps: u64,
    ) -> Result<Self>
    where
        S: RegularLagrangian<f64>,
        R: Run<Scalar = f64>,
    {
        let mut series = Self::empty(motion.name, name, steps);
        let [energy, momentum] = [run.energy(), angular(&run)];
        let mut kept = None;
        job.repeat(steps, || {
            let before = place(&run);
            run.advance()?;
            let (h, t, after) = (run.step_size(), run.time(), place(&run));
            let discrete = discrete_energy(h, [before, after], motion.potential);
            series.count(h, discrete - *kept.get_or_insert(discrete));
            series.note(t, run.energy() - energy, angular(&run) - momentum);
            if t <= COMPARED {
                let [x, y] = (motion.position)(t);
                series.distance = larger(series.distance, (after[0] - x).hypot(after[1] - y));
            }
            Ok(())
        })?;
        let statistics = run.statistics();
        series.work = statistics.gradients + statistics.linearizations;
        Ok(series)
    }

    fn empty(system: &'static str, name: &'static str, wanted: u64) -> Self {
        Self {
            system,
            name,
            wanted,
            steps: 0,
            end: 0.0,
            discrete: Deviation::new(wanted as f64, INTERVALS, wanted as f64 / 10.0),
            discrete_range: Range::EMPTY,
            energy: Range::EMPTY,
            momentum: 0.0,
            lengths: Range::EMPTY,
            tenths: [0.0; 2],
            distance: 0.0,
            work: 0,
            beginning: Vec::new(),
        }
    }

    /// A step of length `h`, and its E_d − e.
    fn count(&mut self, h: f64, discrete: f64) {
        self.steps += 1;
        self.discrete.push(self.steps as f64, discrete);
        self.discrete_range.push(discrete);
        self.lengths.push(h);
        let tenth = self.wanted / 10;
        if self.steps <= tenth {
            self.tenths[0] += h;
        }
        if self.steps > self.wanted - tenth {
            self.tenths[1] += h;
        }
    }

    /// The end of that step: the time, and the changes of the energy and of the angular momentum since the
    /// start.
    fn note(&mut self, t: f64, energy: f64, momentum: f64) {
        if t < BEGINNING {
            self.beginning.push(Step { t, length: t - self.end, energy });
        }
        self.end = t;
        self.energy.push(energy);
        self.momentum = larger(self.momentum, momentum.abs());
    }

    pub(super) fn mean_length(&self) -> f64 {
        self.end / self.steps as f64
    }

    /// The mean length of the last tenth of the steps over that of the first.
    pub(super) fn drift(&self) -> f64 {
        self.tenths[1] / self.tenths[0]
    }

    pub(super) fn work_of_a_step(&self) -> f64 {
        self.work as f64 / self.steps as f64
    }
}

fn place<R: Run<Scalar = f64>>(run: &R) -> [f64; 2] {
    [run.q()[0], run.q()[1]]
}

fn angular<R: Run<Scalar = f64>>(run: &R) -> f64 {
    run.momentum(0).unwrap_or(f64::NAN)
}
