//! A particle with friction in a radial polynomial potential: what the energy loses, and what a method adds
//! to that.
//!
//! The test case of Kane, Marsden, Ortiz & West 2000. The forces enter the discrete equations by the
//! principle of Lagrange and d'Alembert. The angular momentum decays as e^{−γt}, and by the forced discrete
//! Noether theorem its discrete rate is known in closed form.

mod average_acceleration;
mod claims;
mod picture;

use anyhow::Result;
use dvi_core::methods::Method;
use dvi_core::prelude::*;

use crate::claim::larger;
use crate::deviation::Deviation;
use crate::figure::Envelope;
use crate::gallery::{Experiment, Outcome};
use crate::job::Job;
use crate::models::{RadialFriction, RadialFrictionState};
use average_acceleration::Newmark;

pub const EXPERIMENT: Experiment = Experiment {
    name: "friction",
    title: "The decay of the energy under friction, variational against RK4",
    share: 1.0,
    run,
};

const GAMMA: f64 = 1e-3;
const START: RadialFrictionState = RadialFrictionState { x: 1.2, y: 0.0, dot_x: 0.0, dot_y: 0.5 };
/// The steps, the longest first; the reference has the last.
const STEPS: [f64; 4] = [0.2, 0.1, 0.05, 0.025];
const LONG: f64 = STEPS[0];
const FINE: f64 = STEPS[3];
/// The length of time over which deviations of the energy are averaged: some twenty turns.
const WINDOW: f64 = 50.0;
/// The intervals of a window in which the energy is drawn.
const PARTS: usize = 10;

/// A step for a time.
#[derive(Clone, Copy, Debug)]
struct Case {
    gamma: f64,
    h: f64,
    end: f64,
}

/// The energy at multiples of [`FINE`], from the first on.
struct Reference {
    energies: Vec<f64>,
    /// The largest relative deviation of the angular momentum from l(0) e^{−γt}.
    momentum: f64,
}

/// What one run leaves.
struct Series {
    name: &'static str,
    case: Case,
    energy: Envelope,
    /// E/E' − 1, with the energy E' of the reference at the same time.
    error: Deviation,
    /// l/(l(0) e^{−γt}) − 1.
    momentum: Deviation,
    /// The time at which the energy is twice that of the beginning.
    doubled: Option<f64>,
}

/// The runs with one step.
struct Runs {
    midpoint: Series,
    trapezoid: Series,
    newmark: Series,
    rk4: Series,
}

/// All that is measured.
struct Measured {
    end: f64,
    reference: Reference,
    /// The largest relative difference of the energies of two references.
    between_references: f64,
    /// With each of [`STEPS`].
    steps: [Runs; 4],
    heun: Series,
    explicit_midpoint: Series,
    /// Without friction, at the longest step.
    conservative: Runs,
    factors: claims::Factors,
    /// The largest distance of the points of Newmark's method, half a step back, from those of the midpoint
    /// rule.
    conjugate: f64,
}

fn run(job: &Job<'_>) -> Result<Outcome> {
    let end = job.choose(3000.0, 600.0);
    let long = Case { gamma: GAMMA, h: LONG, end };
    let (fine, double) = (Case { h: FINE, ..long }, Case { h: 2.0 * FINE, ..long });
    let free = Case { gamma: 0.0, ..long };
    let by_step = STEPS.map(|h| Case { h, ..long });
    job.expect(4 * by_step.map(Case::steps).iter().sum::<u64>() + 9 * long.steps());
    job.expect(2 * fine.steps() + double.steps());

    let reference = Reference::new(job, Gauss::<4>::new(), fine)?;
    let other = Reference::new(job, Galerkin::<5>::new(), double)?;
    let pairs = reference.energies.iter().skip(1).step_by(2).zip(&other.energies);
    let without = Reference::new(job, Gauss::<4>::new(), Case { gamma: 0.0, ..fine })?;
    let [first, second, third, fourth] = by_step.map(|case| runs(job, case, &reference));
    let measured = Measured {
        end,
        between_references: pairs.map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, larger),
        steps: [first?, second?, third?, fourth?],
        heun: attempt(job, "Heun", RungeKutta::heun(), long, &reference)?.0,
        explicit_midpoint: attempt(job, "explicit midpoint", RungeKutta::midpoint(), long, &reference)?.0,
        conservative: runs(job, free, &without)?,
        factors: claims::factors(job, long)?,
        conjugate: claims::conjugate(job, long)?,
        reference,
    };
    job.publish(EXPERIMENT.name, picture::figure(&measured), picture::table(&measured)?)?;
    Ok(Outcome { claims: claims::claims(job, &measured), references: vec![], notes: vec![] })
}

impl Case {
    fn steps(self) -> u64 {
        (self.end / self.h).round() as u64
    }
}

impl Reference {
    fn new<M: Method<RadialFriction, f64>>(job: &Job<'_>, method: M, case: Case) -> Result<Self> {
        let system = RadialFriction { gamma: case.gamma };
        let mut run = Integrator::new(&system, method, case.h, START)?;
        let begin = angular(&run);
        let mut reference = Self { energies: Vec::new(), momentum: 0.0 };
        job.repeat(case.steps(), || {
            run.advance()?;
            reference.energies.push(run.energy());
            let decayed = begin * (-case.gamma * run.time()).exp();
            reference.momentum = larger(reference.momentum, (angular(&run) / decayed - 1.0).abs());
            Ok(())
        })?;
        Ok(reference)
    }

    /// The energy at time `t`; not a number if the reference was interrupted before.
    fn energy(&self, t: f64) -> f64 {
        let index = ((t / FINE).round() as usize).checked_sub(1);
        index.and_then(|index| self.energies.get(index)).copied().unwrap_or(f64::NAN)
    }
}

fn angular<R: Run<Scalar = f64>>(run: &R) -> f64 {
    run.momentum(0).unwrap_or(f64::NAN)
}

fn runs(job: &Job<'_>, case: Case, reference: &Reference) -> Result<Runs> {
    Ok(Runs {
        midpoint: series(job, "variational midpoint", Variational::midpoint(), case, reference)?,
        trapezoid: series(job, "variational trapezoid", Variational::trapezoid(), case, reference)?,
        newmark: newmark(job, case, reference)?,
        rk4: series(job, "RK4", RungeKutta::classical(), case, reference)?,
    })
}

fn series<M: Method<RadialFriction, f64>>(
    job: &Job<'_>,
    name: &'static str,
    method: M,
    case: Case,
    reference: &Reference,
) -> Result<Series> {
    let (series, ended) = attempt(job, name, method, case, reference)?;
    ended?;
    Ok(series)
}

/// A run that may be lost, and how it ended.
fn attempt<M: Method<RadialFriction, f64>>(
    job: &Job<'_>,
    name: &'static str,
    method: M,
    case: Case,
    reference: &Reference,
) -> Result<(Series, Result<(), StepError>)> {
    let system = RadialFriction { gamma: case.gamma };
    let mut run = Integrator::new(&system, method, case.h, START)?;
    let begin = [run.energy(), angular(&run)];
    let mut series = Series::new(name, case);
    let ended = job.repeat(case.steps(), || {
        run.advance()?;
        series.note(run.time(), [run.energy(), angular(&run)], begin, reference);
        Ok(())
    });
    Ok((series, ended))
}

fn newmark(job: &Job<'_>, case: Case, reference: &Reference) -> Result<Series> {
    let mut run = by_hand(case);
    let begin = [run.energy(), run.angular_momentum()];
    let mut series = Series::new("Newmark, *β* = ¼", case);
    let mut step = 0;
    job.repeat(case.steps(), || {
        run.step();
        step += 1;
        let now = [run.energy(), run.angular_momentum()];
        series.note(f64::from(step) * case.h, now, begin, reference);
        Ok(())
    })?;
    Ok(series)
}

fn by_hand(Case { gamma, h, .. }: Case) -> Newmark {
    let RadialFrictionState { x, y, dot_x, dot_y } = START;
    Newmark::new(RadialFriction { gamma }, h, [x, y], [dot_x, dot_y])
}

impl Series {
    fn new(name: &'static str, case: Case) -> Self {
        let windows = (case.end / WINDOW).round() as usize;
        Self {
            name,
            case,
            energy: Envelope::new(case.end, PARTS * windows),
            error: Deviation::new(case.end, windows, WINDOW),
            momentum: Deviation::new(case.end, windows, WINDOW),
            doubled: None,
        }
    }

    fn note(&mut self, t: f64, [energy, l]: [f64; 2], begin: [f64; 2], reference: &Reference) {
        self.energy.push(t, energy);
        self.error.push(t, energy / reference.energy(t) - 1.0);
        self.momentum.push(t, l / (begin[1] * (-self.case.gamma * t).exp()) - 1.0);
        if self.doubled.is_none() && energy > 2.0 * begin[0] {
            self.doubled = Some(t);
        }
    }

    /// The relative deviation of the energy in the first and in the last window, on average over each.
    fn means(&self) -> [f64; 2] {
        let means = self.error.envelope.mean();
        let value = |point: Option<&[f64; 2]>| point.map_or(f64::NAN, |[_, mean]| *mean);
        [value(means.first()), value(means.last())]
    }

    /// The largest magnitude of the deviation of the energy, on average over a window.
    fn largest_mean(&self) -> f64 {
        self.error.envelope.mean().iter().map(|[_, mean]| mean.abs()).fold(0.0, larger)
    }

    /// By how much the energy decays faster than it should, between the first and the last window, in units
    /// of γ.
    fn excess(&self) -> f64 {
        let [first, last] = self.means();
        ((1.0 + first) / (1.0 + last)).ln() / (GAMMA * (self.case.end - WINDOW))
    }
}

impl Runs {
    fn all(&self) -> [&Series; 4] {
        [&self.midpoint, &self.trapezoid, &self.newmark, &self.rk4]
    }
}

impl Measured {
    fn all(&self) -> impl Iterator<Item = &Series> {
        let steps = self.steps.iter().flat_map(Runs::all);
        steps.chain([&self.heun, &self.explicit_midpoint]).chain(self.conservative.all())
    }
}
