//! A particle with friction in a radial polynomial potential: what the energy loses, and what a method adds
//! to that.
//!
//! The test case of Kane, Marsden, Ortiz & West 2000. The forces enter the discrete equations by the
//! principle of Lagrange and d'Alembert. The angular momentum decays as e^{−γt}, and by the forced discrete
//! Noether theorem its discrete rate is known in closed form.

use super::average_acceleration::AverageAcceleration;
use crate::models::{RadialFriction, RadialFrictionState};
use crate::vocabulary::*;

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
/// As long as the motion of RK4 without friction is not close to a circle, on which it loses nothing.
const BEGINNING: f64 = 200.0;
const COLOURS: [Colour; 4] = [BLUE, GREEN, PURPLE, VERMILLION];

/// A step for a time.
#[derive(Clone, Copy, Debug)]
struct Case {
    gamma: f64,
    h: f64,
    end: f64,
}

impl Case {
    fn steps(self) -> u64 {
        (self.end / self.h).round() as u64
    }

    fn system(self) -> RadialFriction {
        RadialFriction { gamma: self.gamma }
    }
}

/// The energy at multiples of [`FINE`], from the first on.
struct Reference {
    energies: Vec<f64>,
    /// The largest relative deviation of the angular momentum from l(0) e^{−γt}.
    momentum: f64,
}

/// What one run leaves.
struct Decay {
    name: &'static str,
    case: Case,
    energy: Envelope,
    /// E/E' − 1, with the energy E' of the reference at the same time, and l/(l(0) e^{−γt}) − 1.
    error: Deviation,
    momentum: Deviation,
    /// E and l at the start, and the time at which the energy is twice that of the start.
    begin: [f64; 2],
    doubled: Option<f64>,
}

/// Runs with one step: midpoint, trapezoid, Newmark and RK4.
type Runs = [Decay; 4];

/// All that is measured.
struct Measured {
    end: f64,
    reference: Reference,
    /// With each of [`STEPS`].
    steps: [Runs; 4],
    /// Heun's method and the explicit midpoint rule.
    lost: [Decay; 2],
    /// Without friction, at the longest step.
    conservative: Runs,
}

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let end = job.choose(3000.0, 600.0);
    let long = Case { gamma: GAMMA, h: LONG, end };
    let (fine, double) = (Case { h: FINE, ..long }, Case { h: 2.0 * FINE, ..long });
    let by_step = STEPS.map(|h| Case { h, ..long });
    job.expect(4 * by_step.map(Case::steps).iter().sum::<u64>() + 9 * long.steps());
    job.expect(2 * fine.steps() + double.steps());

    let reference = Reference::new(job, Gauss::<4>::new(), fine)?;
    let other = Reference::new(job, Galerkin::<5>::new(), double)?;
    let without = Reference::new(job, Gauss::<4>::new(), Case { gamma: 0.0, ..fine })?;
    let heun = attempt(job, "Heun", RungeKutta::heun(), long, &reference)?.0;
    let explicit = attempt(job, "explicit midpoint", RungeKutta::midpoint(), long, &reference)?.0;
    let measured = Measured {
        end,
        steps: each(by_step, |case| runs(job, case, &reference))?,
        lost: [heun, explicit],
        conservative: runs(job, Case { gamma: 0.0, ..long }, &without)?,
        reference,
    };
    let Measured { reference, steps, lost, conservative, .. } = &measured;
    let all = steps.iter().flatten().chain(lost).chain(conservative);
    let rows = all.flat_map(|Decay { name, case, error, momentum, .. }| {
        let means = error.envelope.mean().into_iter().zip(momentum.envelope.mean());
        means.map(|([t, energy], [_, momentum])| ([*name], [case.gamma, case.h, t, energy, momentum]))
    });
    let columns = ["method", "gamma", "h", "t", "mean_energy_deviation", "mean_momentum_deviation"];
    job.publish(figure(&measured), Table::of(&columns, rows)?)?;
    let pairs = reference.energies.iter().skip(1).step_by(2).zip(&other.energies);
    let between = largest(pairs.map(|(a, b)| (a / b - 1.0).abs()));
    Ok(vec![
        beyond(
            "the reference has the energy of a run by another method, and the angular momentum of the \
                motion",
        )
        .at_most("largest relative difference of two energies", between, 2e-11)
        .at_most("largest |l/(l(0) exp(−γt)) − 1|", reference.momentum, 1e-12),
        noether(job, long, steps)?,
        follows(job, &steps[0]),
        control(&measured),
        beyond("Runge–Kutta methods of second order gain energy at that step instead of losing it").each(
            lost,
            |claim, run| {
                let doubled = run.doubled.unwrap_or(f64::INFINITY);
                claim.of(run.name).at_most("time at which E is twice E(0)", doubled, 5.0)
            },
        ),
        orders(job, steps),
        same_method(job, long)?,
    ]
    .into())
}

impl Reference {
    fn new(job: &Job<'_>, method: impl Method<RadialFriction, f64>, case: Case) -> Result<Self> {
        let system = case.system();
        let mut run = Integrator::new(&system, method, case.h, START)?;
        let begin = angular(&run);
        let mut reference = Self { energies: Vec::new(), momentum: 0.0 };
        job.follow(&mut run, case.steps(), |run| {
            reference.energies.push(run.energy());
            let decayed = begin * (-case.gamma * run.time()).exp();
            reference.momentum = larger(reference.momentum, (angular(run) / decayed - 1.0).abs());
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
    let mut newmark = AverageAcceleration::new(case.system(), case.h, START);
    let mut decay = Decay::new("Newmark, *β* = ¼", case, [newmark.energy(), newmark.angular_momentum()]);
    let mut step = 0;
    job.repeat(case.steps(), || {
        newmark.step();
        step += 1;
        decay.note(f64::from(step) * case.h, [newmark.energy(), newmark.angular_momentum()], reference);
        Ok(())
    })?;
    let (midpoint, ended) = attempt(job, "variational midpoint", Variational::midpoint(), case, reference)?;
    ended?;
    let (trapezoid, ended) =
        attempt(job, "variational trapezoid", Variational::trapezoid(), case, reference)?;
    ended?;
    let (rk4, ended) = attempt(job, "RK4", RungeKutta::classical(), case, reference)?;
    ended?;
    Ok([midpoint, trapezoid, decay, rk4])
}

/// A run that may be lost, and how it ended.
fn attempt(
    job: &Job<'_>,
    name: &'static str,
    method: impl Method<RadialFriction, f64>,
    case: Case,
    reference: &Reference,
) -> Result<(Decay, Result<(), StepError>)> {
    let system = case.system();
    let mut run = Integrator::new(&system, method, case.h, START)?;
    let mut decay = Decay::new(name, case, [run.energy(), angular(&run)]);
    let ended = job.follow(&mut run, case.steps(), |run| {
        decay.note(run.time(), [run.energy(), angular(run)], reference);
    });
    Ok((decay, ended))
}

impl Decay {
    fn new(name: &'static str, case: Case, begin: [f64; 2]) -> Self {
        let windows = (case.end / WINDOW).round() as usize;
        let [error, momentum] = Span { end: case.end, early: WINDOW, intervals: windows }.deviations();
        let energy = Envelope::new(case.end, PARTS * windows);
        Self { name, case, energy, error, momentum, begin, doubled: None }
    }

    fn note(&mut self, t: f64, [energy, l]: [f64; 2], reference: &Reference) {
        self.energy.push(t, energy);
        self.error.push(t, energy / reference.energy(t) - 1.0);
        self.momentum.push(t, l / (self.begin[1] * (-self.case.gamma * t).exp()) - 1.0);
        if self.doubled.is_none() && energy > 2.0 * self.begin[0] {
            self.doubled = Some(t);
        }
    }

    /// The relative deviation of the energy in the first and in the last window, on average over each.
    fn means(&self) -> [f64; 2] {
        let means = self.error.envelope.mean();
        [means.first(), means.last()].map(|point| point.map_or(f64::NAN, |[_, mean]| *mean))
    }

    /// The largest magnitude of the deviation of the energy, on average over a window.
    fn largest_mean(&self) -> f64 {
        largest(self.error.envelope.mean().iter().map(|[_, mean]| mean.abs()))
    }

    /// By how much the energy decays faster than it should, between the first and the last window, in units
    /// of γ.
    fn excess(&self) -> f64 {
        let [first, last] = self.means();
        ((1.0 + first) / (1.0 + last)).ln() / (GAMMA * (self.case.end - WINDOW))
    }
}

/// D₁L_d and D₂L_d are parallel to the points but for Δ/h and the forces ∓½γΔ, and so l0 = (1/h + c + ½γ)
/// q0×q1 and l1 = (1/h + c − ½γ) q0×q1. The rule of the trapezoid has c = 0, that of the midpoint ¼h V'(r)/r
/// at the middle of the step.
fn noether(job: &Job<'_>, case: Case, steps: &[Runs; 4]) -> Result<Claim> {
    let factor = |c: f64| {
        let inner = 1.0 / case.h + c;
        (inner - 0.5 * case.gamma) / (inner + 0.5 * case.gamma)
    };
    let trapezoid = defects(job, Variational::trapezoid(), case, |_| factor(0.0))?;
    let midpoint = defects(job, Variational::midpoint(), case, |[q0, q1]| {
        let middle = std::array::from_fn(|i| 0.5 * (q0[i] + q1[i]));
        factor(0.25 * case.h * case.system().slope(&middle))
    })?;
    let order = |method: usize| {
        order(steps[1..].iter().map(|runs| (runs[method].case.h, runs[method].momentum.last.abs())))
    };
    let [by_midpoint, by_trapezoid, ..] = &steps[0];
    let text =
        "each step, h = 0.2, takes of the angular momentum what the forced discrete Noether theorem says";
    Ok(beyond(text)
        .at_most("trapezoid: relative defect of l1 = l0 (1 − γh/2)/(1 + γh/2)", trapezoid[0], 1e-12)
        .at_most("trapezoid: the same of the product over all steps", trapezoid[1], 5e-12)
        .at_most("midpoint: relative defect with 1/h + h V'(r)/(4r) in place of 1/h", midpoint[0], 1e-12)
        .at_most("midpoint: the same of the product over all steps", midpoint[1], 5e-12)
        .at_most("trapezoid: largest |l/(l(0) exp(−γt)) − 1|", by_trapezoid.momentum.largest, 1.1e-8)
        .at_most("midpoint: largest |l/(l(0) exp(−γt)) − 1|", by_midpoint.momentum.largest, 1e-3)
        .near("trapezoid: order of that at the end in h", order(1), [2.0, 0.05])
        .near("midpoint: order of that at the end in h", order(0), [2.0, 0.05]))
}

/// The largest relative deviation of l from l of the step before times the factor of the step, and from l(0)
/// times the product of the factors of all steps.
fn defects(
    job: &Job<'_>,
    method: impl Method<RadialFriction, f64>,
    case: Case,
    factor: impl Fn([[f64; 2]; 2]) -> f64,
) -> Result<[f64; 2]> {
    let system = case.system();
    let mut run = Integrator::new(&system, method, case.h, START)?;
    let (mut q, mut l) = ([run.q()[0], run.q()[1]], angular(&run));
    let (mut product, mut of_a_step, mut of_all) = (l, 0.0, 0.0);
    job.follow(&mut run, case.steps(), |run| {
        let (before, expected) = (q, l);
        (q, l) = ([run.q()[0], run.q()[1]], angular(run));
        let factor = factor([before, q]);
        product *= factor;
        of_a_step = larger(of_a_step, (l / (expected * factor) - 1.0).abs());
        of_all = larger(of_all, (l / product - 1.0).abs());
    })?;
    Ok([of_a_step, of_all])
}

fn follows(job: &Job<'_>, runs: &Runs) -> Claim {
    let deviates = format!("largest relative deviation of E, means over {WINDOW}");
    let too_fast = "rate of decay of E less that of the motion, in units of γ";
    let bounds = [[0.16, 0.18, 0.065], [0.12, 0.16, 0.025], [0.33, 0.36, 0.075]];
    let rk4 = &runs[3];
    beyond(
        "at h = 0.2 RK4 adds to the decay of the energy as much as friction, and the other methods a \
            small part of that",
    )
    .each(runs.iter().zip(bounds), |claim, (run, [mean, each, rate])| {
        claim
            .of(run.name)
            .at_most(&deviates, run.largest_mean(), mean)
            .at_most("the same at each step", run.error.largest, each)
            .near(too_fast, run.excess(), [0.0, rate])
    })
    .of(rk4.name)
    .at_least(&deviates, job.only_full(rk4.largest_mean()), 0.9)
    .at_least(too_fast, rk4.excess(), 1.0)
}

fn control(Measured { reference, conservative, .. }: &Measured) -> Claim {
    // What RK4 loses of the energy without friction in the beginning, over what the motion loses by friction.
    let rows = conservative[3].energy.mean();
    let own = rows.iter().rfind(|[t, _]| *t < BEGINNING).map_or(f64::NAN, |[_, energy]| *energy);
    let begin = reference.energy(FINE);
    let own_loss = (begin - own) / (begin - reference.energy(BEGINNING));
    beyond(
        "without friction the other methods keep their energy, and RK4 at first loses more than \
            friction takes",
    )
    .each(&conservative[..3], |claim, run| {
        let [first, last] = run.means();
        let quantity = format!("mean E over the last {WINDOW} / over the first − 1");
        claim.of(run.name).near(quantity, (1.0 + last) / (1.0 + first) - 1.0, [0.0, 5e-4])
    })
    .each(&conservative[..2], |claim, run| {
        claim.of(run.name).at_most("largest |l/l(0) − 1|", run.momentum.largest, 1e-13)
    })
    .at_least(
        format!("RK4: what it loses of E to t = {BEGINNING} / what friction takes"),
        own_loss,
        1.5,
    )
}

fn orders(job: &Job<'_>, steps: &[Runs; 4]) -> Claim {
    let order = |method: usize| {
        order(steps[1..].iter().map(|runs| (runs[method].case.h, runs[method].excess().abs())))
    };
    let worse =
        |index: usize| job.only_full(steps[index][3].largest_mean() / steps[index][0].largest_mean());
    let same_cost = steps[2][1].largest_mean() / steps[0][3].largest_mean();
    let [_, long, _, short] = STEPS;
    let dearest = "four forces in 0.2: largest deviation of E, trapezoid with h = 0.05 / RK4 with h = 0.2";
    beyond(
        "the error of that rate is of second order, with RK4 of the fifth, so that RK4 is behind at \
            long steps and ahead at short ones",
    )
    .each(0..3, |claim, method| {
        claim.of(steps[0][method].name).near("order of the error of the rate", order(method), [2.0, 0.1])
    })
    .near("RK4: order of the error of the rate", order(3), [5.0, 0.2])
    .at_least(format!("h = {long}: largest deviation of E, RK4 / midpoint"), worse(1), 5.0)
    .at_most(format!("h = {short}: largest deviation of E, RK4 / midpoint"), worse(3), 0.5)
    .at_most(dearest, same_cost, 0.01)
}

/// With z' = F(z) Newmark's method is z1 − ½hF(z1) = z0 + ½hF(z0). So the points z − ½hF(z) are those of the
/// implicit midpoint rule, which is what the variational midpoint rule is for this Lagrangian and these
/// forces.
fn same_method(job: &Job<'_>, case: Case) -> Result<Claim> {
    let mut newmark = AverageAcceleration::new(case.system(), case.h, START);
    let system = case.system();
    let mut run = Integrator::new(&system, Variational::midpoint(), case.h, newmark.half_a_step_back())?;
    let entries = |RadialFrictionState { x, y, dot_x, dot_y }| [x, y, dot_x, dot_y];
    let mut most = 0.0;
    job.follow(&mut run, case.steps(), |run| {
        newmark.step();
        most = larger(most, apart(&entries(run.state()), &entries(newmark.half_a_step_back())));
    })?;
    let text =
        "Newmark's method with β = ¼ is the variational midpoint rule half a step back, with friction too";
    Ok(beyond(text).at_most("largest difference of a coordinate or a velocity", most, 1e-10))
}

fn figure(measured: &Measured) -> Figure {
    let [long, ..] = &measured.steps;
    let strokes = || {
        let [midpoint, trapezoid, newmark, rk4] = COLOURS.map(Stroke::solid);
        [midpoint.width(2.4), trapezoid, newmark, rk4]
    };
    let lines = |points: fn(&Decay) -> Vec<[f64; 2]>| {
        long.iter().zip(strokes()).map(move |(run, stroke)| (run.name, stroke, points(run)))
    };
    let time = || Axis::time(measured.end);
    let energies = measured.reference.energies.iter().zip(1..).map(|(e, n)| [f64::from(n) * FINE, *e]);
    let decay = Panel::new("Energy", time(), Axis::linear("*E*").within(0.0, 0.45))
        .line(energies.collect(), Stroke::solid(SLATE).width(5.0).opacity(0.4))
        .labelled("reference")
        .lines(lines(|run| run.energy.mean()))
        .line(measured.conservative[3].energy.mean(), Stroke::dashed(VERMILLION))
        .labelled("RK4 without friction");
    let axis = Axis::logarithmic("relative, |mean| over 50 units of time").within(1e-3, 2.0);
    let means =
        |run: &Decay| run.error.envelope.mean().into_iter().map(|[t, mean]| [t, mean.abs()]).collect();
    let deviation = Panel::new("Deviation of the energy", time(), axis).lines(lines(means));
    let axis = Axis::logarithmic("largest |*l*/(*l*(0) exp(−*γt*)) − 1|").within(1e-13, 1.0);
    let momentum =
        Panel::new("Angular momentum", time(), axis).lines(lines(|run| run.momentum.envelope.magnitude()));
    let h = Axis::logarithmic("step *h*").within(0.02, 0.25);
    let rate = Axis::logarithmic("|error| of the rate of *E*   [*γ*]");
    let rates = Panel::new("Error of the rate of decay", h, rate).each(0..4, |panel, method: usize| {
        let points = measured.steps.iter().map(|runs| [runs[method].case.h, runs[method].excess().abs()]);
        let points: Vec<_> = points.collect();
        panel.line(points.clone(), strokes()[method]).discs(points, COLOURS[method], Fill::Solid)
    });
    let [heun, explicit] =
        measured.lost.each_ref().map(|run| run.doubled.map_or("∞".to_owned(), |t| format!("{t:.1}")));
    Figure::new(
        "A particle with friction: what the energy loses, and what methods add to that",
        format!(
            "*V* = *r*²(*r*² − 1)², *γ* = {GAMMA}, from (1.2, 0) with velocity (0, 0.5); *h* = {LONG} but \
             for the last panel; energies are means over time"
        ),
    )
    .row(400.0, vec![decay, deviation.legend_at(Corner::BottomRight)])
    .row(330.0, vec![momentum.without_legend(), rates])
    .footer(format!(
        "After Kane, Marsden, Ortiz & West 2000. The reference is Gauss's method of order 8, *h* = {FINE}. \
         With Heun's method and the explicit midpoint rule the energy is doubled at *t* = {heun} and \
         {explicit}."
    ))
}
