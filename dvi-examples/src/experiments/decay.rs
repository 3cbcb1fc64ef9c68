//! How energy and angular momentum of a particle decay by friction, in the motion and in runs.

use super::average_acceleration::AverageAcceleration;
use crate::vocabulary::*;

pub const GAMMA: f64 = 1e-3;
pub const START: RadialFrictionState = RadialFrictionState { x: 1.2, y: 0.0, dot_x: 0.0, dot_y: 0.5 };
/// The steps, the longest first; the reference has the last.
pub const STEPS: [f64; 4] = [0.2, 0.1, 0.05, 0.025];
pub const FINE: f64 = STEPS[3];
/// The length of time over which deviations of the energy are averaged: some twenty turns.
pub const WINDOW: f64 = 50.0;

#[derive(Clone, Copy)]
pub struct Case {
    pub gamma: f64,
    pub h: f64,
    pub end: f64,
}

impl Case {
    pub fn steps(self) -> u64 {
        (self.end / self.h).round() as u64
    }

    pub fn system(self) -> RadialFriction {
        RadialFriction { gamma: self.gamma }
    }

    pub fn run<M: Method<RadialFriction, f64>>(self, method: M) -> Result<Integrator<RadialFriction, M>> {
        Ok(Integrator::new(self.system(), method, self.h, START)?)
    }
}

/// The energy at multiples of [`FINE`], from the first on, and the largest relative deviation of the angular
/// momentum from l(0) e^{−γt}.
pub struct Reference {
    pub energies: Vec<f64>,
    pub momentum: f64,
}

impl Reference {
    pub fn new(job: &Job<'_>, method: impl Method<RadialFriction, f64>, case: Case) -> Result<Self> {
        let mut run = case.run(method)?;
        let (mut energies, [begin], mut momentum) = (Vec::new(), momenta(&run), 0.0);
        job.follow(&mut run, case.steps(), |run| {
            energies.push(run.energy());
            let ([l], decayed) = (momenta(run), begin * (-case.gamma * run.time()).exp());
            momentum = larger(momentum, (l / decayed - 1.0).abs());
        })?;
        Ok(Self { energies, momentum })
    }

    /// The energy at time `t`; not a number where the reference has none.
    pub fn energy(&self, t: f64) -> f64 {
        let index = ((t / FINE).round() as usize).checked_sub(1);
        index.and_then(|index| self.energies.get(index)).copied().unwrap_or(f64::NAN)
    }
}

/// What one run leaves: E, drawn in tenths of a window; with the energy E' of the reference at the same
/// time, E/E' − 1; and l/(l(0) e^{−γt}) − 1.
pub struct Decay {
    pub name: &'static str,
    pub case: Case,
    pub energy: Envelope,
    pub error: Envelope,
    pub momentum: Envelope,
    /// The time at which the energy is twice that of the start, and why it ended early.
    pub doubled: Option<f64>,
    lost: Option<StepError>,
}

/// Runs with one step: midpoint, trapezoid, Newmark and RK4.
pub type Runs = [Decay; 4];

#[derive(Clone, Copy)]
pub struct Setting<'a> {
    pub job: &'a Job<'a>,
    pub case: Case,
    pub reference: &'a Reference,
}

impl Setting<'_> {
    pub fn runs(self) -> Result<Runs> {
        let (case, mut steps) = (self.case, 0);
        let mut newmark = AverageAcceleration::new(case, START);
        let newmark = self.decay("Newmark, *β* = ¼", newmark.integrals(), || {
            newmark.step();
            steps += 1;
            Ok((f64::from(steps) * case.h, newmark.integrals()))
        });
        let midpoint = self.by("variational midpoint", Variational::midpoint())?;
        let trapezoid = self.by("variational trapezoid", Variational::trapezoid())?;
        let runs = [midpoint, trapezoid, newmark, self.by("RK4", RungeKutta::classical())?];
        match runs.iter().find_map(|run| run.lost) {
            Some(error) => bail!(error),
            None => Ok(runs),
        }
    }

    pub fn by(self, name: &'static str, method: impl Method<RadialFriction, f64>) -> Result<Decay> {
        let mut run = self.case.run(method)?;
        let integrals = |run: &Integrator<_, _>| {
            let [l] = momenta(run);
            [run.energy(), l]
        };
        Ok(self.decay(name, integrals(&run), || {
            run.advance()?;
            Ok((run.time(), integrals(&run)))
        }))
    }

    /// From E and l at the start, with the time and those after each step.
    fn decay<F>(self, name: &'static str, begin: [f64; 2], mut step: F) -> Decay
    where
        F: FnMut() -> Result<(f64, [f64; 2]), StepError>,
    {
        let Self { job, case, reference } = self;
        let (windows, end) = ((case.end / WINDOW).round() as usize, case.end);
        let [mut error, mut momentum] = Span { end, early: WINDOW, intervals: windows }.envelopes();
        let (mut energy, mut doubled) = (Envelope::new(end, 10 * windows, 0.0), None);
        let ended = job.repeat(case.steps(), || {
            let (t, [e, l]) = step()?;
            energy.push(t, e);
            error.push(t, e / reference.energy(t) - 1.0);
            momentum.push(t, l / (begin[1] * (-case.gamma * t).exp()) - 1.0);
            if e > 2.0 * begin[0] {
                doubled.get_or_insert(t);
            }
            Ok(())
        });
        Decay { name, case, energy, error, momentum, doubled, lost: ended.err() }
    }
}

impl Decay {
    /// The relative deviation of the energy in the first and in the last window, on average over each.
    pub fn means(&self) -> [f64; 2] {
        let means = self.error.mean();
        [means.first(), means.last()].map(|point| point.map_or(f64::NAN, |[_, mean]| *mean))
    }

    /// The largest magnitude of the deviation of the energy, on average over a window.
    pub fn largest_mean(&self) -> f64 {
        largest(self.error.mean().iter().map(|[_, mean]| mean.abs()))
    }

    /// By how much faster the energy decays than it should, from first to last window, in units of γ.
    pub fn excess(&self) -> f64 {
        let [first, last] = self.means();
        ((1.0 + first) / (1.0 + last)).ln() / (GAMMA * (self.case.end - WINDOW))
    }
}
