//! Runs with steps that keep the discrete energy, beside runs with steps of one length.

use crate::vocabulary::*;

/// The time up to which runs are compared with the motion, and that up to which each step is drawn.
pub const COMPARED: f64 = 50.0;
pub const BEGINNING: f64 = 15.0;

/// A system with its start, V as a function of r², and where the particle is at a time.
pub struct Motion<'a, S: RegularLagrangian<f64>> {
    pub system: &'a S,
    pub start: S::State<f64>,
    pub potential: fn(f64) -> f64,
    pub position: &'a dyn Fn(f64) -> [f64; 2],
}

/// What one run leaves.
pub struct Steps {
    /// Over the number of the step: E_d − e, E − E(0), l − l(0), and the length of the step.
    pub kept: [Deviation; 4],
    /// The mean length of the steps, and that of their last tenth over that of the first.
    pub length: f64,
    pub lengthening: f64,
    /// The evaluations of first and second derivatives in a step.
    pub work: f64,
    /// The largest distance from the motion at times up to [`COMPARED`].
    pub distance: f64,
    /// The time at the end of a step of the beginning, its length, and E − E(0) there.
    pub beginning: Vec<[f64; 3]>,
}

/// Runs on one system for the lengths of the first step: with steps that keep the discrete energy, with as
/// many steps of one length, the mean of those, and with steps of one length and at most as many evaluations
/// of derivatives in the same time as the first.
pub struct Runs {
    pub name: &'static str,
    pub kept: [Steps; 4],
    pub mean: [Steps; 4],
    pub work: [Steps; 4],
}

impl<S: RegularLagrangian<f64>> Motion<'_, S> {
    pub fn runs(&self, job: &Job<'_>, name: &'static str, first: [f64; 4], steps: u64) -> Result<Runs> {
        let rule = Variational::midpoint();
        let of_one_length = |h: f64, steps| {
            self.steps(job, Integrator::new(self.system, rule, h, self.start.clone())?, steps)
        };
        let kept = each(first, |h| {
            let control = EnergyMomentum::new(h);
            self.steps(
                job,
                ControlledIntegrator::new(self.system, rule, control, self.start.clone())?,
                steps,
            )
        })?;
        let mean = each(kept.each_ref(), |kept| of_one_length(kept.length, steps))?;
        let work = each([0, 1, 2, 3], |i| {
            let h = mean[i].length * mean[i].work / kept[i].work;
            let steps = (COMPARED / h).ceil() as u64;
            job.expect(steps);
            of_one_length(h, steps)
        })?;
        Ok(Runs { name, kept, mean, work })
    }

    fn steps(&self, job: &Job<'_>, mut run: impl Run<Scalar = f64>, wanted: u64) -> Result<Steps> {
        let span = Span { end: wanted as f64, early: wanted as f64 / 10.0, intervals: 100 };
        let (mut kept, mut tenths, mut farthest) = (span.deviations(), [0.0; 2], 0.0);
        let (mut end, mut beginning, tenth) = (0.0, Vec::new(), wanted / 10);
        let (energy, [momentum]) = (run.energy(), momenta(&run));
        let (mut before, mut first) = (place(&run), None);
        job.follow(&mut run, wanted, |run| {
            let (step, h, t, after) = (run.steps(), run.step_size(), run.time(), place(run));
            // The discrete energy of a step of the midpoint rule.
            let velocity = [0, 1].map(|i: usize| (after[i] - before[i]) / h);
            let middle = [0, 1].map(|i: usize| 0.5 * (before[i] + after[i]));
            let discrete = 0.5 * dot(velocity, velocity) + (self.potential)(dot(middle, middle));
            let defect = discrete - *first.get_or_insert(discrete);
            let (change, [now]) = (run.energy() - energy, momenta(run));
            note(&mut kept, step as f64, [defect, change, now - momentum, h]);
            tenths[0] += if step <= tenth { h } else { 0.0 };
            tenths[1] += if step > wanted - tenth { h } else { 0.0 };
            if t < BEGINNING {
                beginning.push([t, t - end, change]);
            }
            if t <= COMPARED {
                farthest = larger(farthest, distance(after, (self.position)(t)));
            }
            (before, end) = (after, t);
        })?;
        let (steps, statistics) = (run.steps() as f64, run.statistics());
        let work = (statistics.gradients + statistics.linearizations).max(1) as f64 / steps;
        Ok(Steps {
            kept,
            length: end / steps,
            lengthening: tenths[1] / tenths[0],
            work,
            distance: farthest,
            beginning,
        })
    }
}

/// The largest over the four lengths of the first step.
pub fn most(runs: &[Steps; 4], value: impl Fn(&Steps) -> f64) -> f64 {
    largest(runs.iter().map(value))
}

/// The order in the mean length of the steps.
pub fn order_in_length(runs: &[Steps; 4], value: impl Fn(&Steps) -> f64) -> Option<f64> {
    order(runs.iter().map(|steps| (steps.length, value(steps))))
}
