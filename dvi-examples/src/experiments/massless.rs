//! A charged particle without mass, in two gauges of one field: what each of them allows.
//!
//! Ω is the magnetic field and does not depend on the gauge, and neither does the motion. The schemes do:
//! with a potential along x only there are one-step schemes; with the symmetric one the two-step midpoint
//! scheme has a parasitic mode that grows.

use anyhow::Result;
use dvi_core::methods::Method;
use dvi_core::prelude::*;
use dvi_core::space::sink::Dense;

use crate::claim::{BEYOND, Bound, Claim, larger};
use crate::deviation::Deviation;
use crate::figure::{
    Axis, BLUE, Corner, Figure, GREEN, Panel, SLATE, Stroke, VERMILLION, at_most, scientific,
};
use crate::gallery::{Experiment, Outcome};
use crate::job::Job;
use crate::models::{MasslessAlongX, MasslessAlongXState, MasslessSymmetric, MasslessSymmetricState};
use crate::output::{Table, number};

pub const EXPERIMENT: Experiment = Experiment {
    name: "massless-particle",
    title: "A charged particle without mass, in two gauges",
    share: 4.0,
    run,
};

const START: [f64; 2] = [1.0, 1.0];
const H: f64 = 0.5;
/// Steps of the beginning, with which the whole is compared.
const EARLY: u64 = 2000;
/// The steps at which the parasitic mode is measured, and until when at most.
const STEPS: [f64; 3] = [0.5, 0.25, 0.125];
const END: f64 = 1500.0;

const fn along_x() -> MasslessAlongXState {
    MasslessAlongXState { x: START[0], y: START[1] }
}

const fn symmetric() -> MasslessSymmetricState {
    MasslessSymmetricState { x: START[0], y: START[1] }
}

/// What one long run leaves.
struct Series {
    name: &'static str,
    error: Deviation,
    path: Vec<[f64; 2]>,
}

/// The parasitic mode of the two-step scheme.
struct Parasite {
    h: f64,
    /// Time and amplitude.
    amplitudes: Vec<[f64; 2]>,
    path: Vec<[f64; 2]>,
    /// The time at which no step was found.
    ended: Option<f64>,
}

fn run(job: &Job<'_>) -> Result<Outcome> {
    let steps = job.choose(1_000_000, 20_000);
    job.expect(3 * steps + STEPS.map(|h| (END / h) as u64).iter().sum::<u64>());
    let (one_sided, both) = (MasslessAlongX {}, MasslessSymmetric {});
    let all = [
        series(job, "along *x*, one step", &one_sided, OneStep::midpoint(), along_x(), steps)?,
        series(job, "symmetric, projected", &both, Projected::symmetric(), symmetric(), steps)?,
        series(job, "RK4", &both, RungeKutta::classical(), symmetric(), steps)?,
    ];
    let parasites = STEPS.into_iter().map(|h| parasite(job, h)).collect::<Result<Vec<_>>>()?;
    let claims = vec![same_motion()?, flat(&all), grows(&parasites)];
    job.publish(EXPERIMENT.name, figure(&all, &parasites, steps as f64 * H), table(&all, &parasites)?)?;
    Ok(Outcome { claims, references: vec![], notes: vec![] })
}

fn series<S: DegenerateLagrangian, M: Method<S, f64>>(
    job: &Job<'_>,
    name: &'static str,
    system: &S,
    method: M,
    start: S::State<f64>,
    steps: u64,
) -> Result<Series> {
    let mut run = Integrator::new(system, method, H, start)?;
    let energy = run.energy();
    let error = Deviation::new(steps as f64 * H, 100, EARLY as f64 * H);
    let mut series = Series { name, error, path: vec![START] };
    job.repeat(steps, || {
        run.advance()?;
        series.error.push(run.time(), run.energy() - energy);
        if run.steps() <= EARLY {
            series.path.push([run.q()[0], run.q()[1]]);
        }
        Ok(())
    })?;
    Ok(series)
}

fn parasite(job: &Job<'_>, h: f64) -> Result<Parasite> {
    let system = MasslessSymmetric {};
    let method = Sigma { parasitic_limit: None, ..Sigma::midpoint() };
    let mut run = Integrator::new(&system, method, h, symmetric())?;
    let mut filter = AlternatingComponent::new(&system);
    let mut parasite = Parasite { h, amplitudes: vec![], path: vec![START], ended: None };
    let lost = job.repeat_until_lost((END / h) as u64, || {
        run.advance()?;
        parasite.amplitudes.extend(filter.amplitude(run.q()).map(|amplitude| [run.time(), amplitude]));
        parasite.path.push([run.q()[0], run.q()[1]]);
        Ok(())
    });
    parasite.ended = lost.map(|error| error.step as f64 * h);
    Ok(parasite)
}

fn same_motion() -> Result<Claim> {
    let (one_sided, both) = (MasslessAlongX {}, MasslessSymmetric {});
    fn omega<S: DegenerateLagrangian>(system: &S, q: [f64; 2]) -> [f64; 4] {
        let mut entries = [0.0; 4];
        system.one_form_jacobian(&q, 0.0, 1.0, -1.0, &mut Dense::new(&mut entries, 2));
        entries
    }
    fn end<S: DegenerateLagrangian, M: Method<S, f64>>(
        system: &S,
        method: M,
        start: S::State<f64>,
        steps: u64,
    ) -> Result<[f64; 2]> {
        let mut run = Integrator::new(system, method, 20.0 / steps as f64, start)?;
        run.take_steps(steps)?;
        Ok([run.q()[0], run.q()[1]])
    }
    let apart = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
    let mut difference = 0.0;
    for q in [[1.0, 1.0], [-0.3, 2.0], [0.8, -0.7]] {
        for (one, other) in omega(&one_sided, q).into_iter().zip(omega(&both, q)) {
            difference = larger(difference, (one - other).abs());
        }
    }
    let exact = end(&both, Gauss::<4>::new(), symmetric(), 400)?;
    let (mut one_step, mut two_step, mut projected) = (vec![], vec![], vec![]);
    for steps in [160, 240, 320] {
        let h = 20.0 / steps as f64;
        one_step.push((h, apart(exact, end(&one_sided, OneStep::midpoint(), along_x(), steps)?)));
        two_step.push((h, apart(exact, end(&both, Sigma::midpoint(), symmetric(), steps)?)));
        projected.push((h, apart(exact, end(&both, Projected::symmetric(), symmetric(), steps)?)));
    }
    let order = |errors: &[(f64, f64)]| convergence_order(errors);
    Ok(Claim::new(BEYOND, "both gauges have one Ω and one motion")
        .check("largest difference of entries of Ω at three points", difference, Bound::AtMost(1e-14))
        .check("along x, one step: order at t = 20", order(&one_step), Bound::Near(2.0, 0.05))
        .check("symmetric, two steps: order at t = 20", order(&two_step), Bound::Near(2.0, 0.05))
        .check("symmetric, projected: order at t = 20", order(&projected), Bound::Near(2.0, 0.05)))
}

fn flat(all: &[Series; 3]) -> Claim {
    let text = "the energy error is no larger in the whole run than in its beginning";
    all.iter().fold(Claim::new(BEYOND, text), |claim, series| {
        let bound = if series.name == "RK4" { Bound::AtLeast(5.0) } else { Bound::AtMost(1.001) };
        let quantity = format!("{}: max|ΔH| over all / over {EARLY} steps", series.name.replace('*', ""));
        claim.check(quantity, series.error.growth(), bound)
    })
}

impl Parasite {
    /// The exponential rate of growth, from the medians of two windows of two turns, three turns apart.
    /// Where the path bends most, the smooth motion is seen in the amplitude too.
    fn rate(&self) -> f64 {
        const TURN: f64 = 65.0;
        let median = |start: f64| {
            let window = start..start + 2.0 * TURN;
            let inside = self.amplitudes.iter().filter(|[t, _]| window.contains(t));
            let mut inside: Vec<f64> = inside.map(|[_, amplitude]| *amplitude).collect();
            inside.sort_by(f64::total_cmp);
            inside.get(inside.len() / 2).copied().unwrap_or(f64::NAN)
        };
        (median(260.0 + 3.0 * TURN) / median(260.0)).ln() / (3.0 * TURN)
    }
}

fn grows(parasites: &[Parasite]) -> Claim {
    let text = "in the symmetric gauge the parasitic mode of two steps grows at one rate whatever h, until no step is found";
    let rate = parasites.last().map_or(f64::NAN, Parasite::rate);
    let claim =
        Claim::new(BEYOND, text).check("rate of growth at the smallest h", rate, Bound::AtLeast(5e-3));
    parasites.iter().fold(claim, |claim, parasite| {
        let Parasite { h, ended, .. } = parasite;
        claim
            .check(
                format!("h = {h}: rate of growth, in units of that"),
                parasite.rate() / rate,
                Bound::Near(1.0, 0.1),
            )
            .check(
                format!("h = {h}: time at which it ends"),
                ended.unwrap_or(f64::INFINITY),
                Bound::AtMost(END),
            )
    })
}

fn figure(all: &[Series; 3], parasites: &[Parasite], end: f64) -> Figure {
    let [one_step, projected, runge_kutta] = all;
    let path = |series: &Series| series.path.iter().take(200).copied().collect::<Vec<_>>();
    let plane =
        Panel::new("Path", Axis::linear("*x*").within(-2.0, 2.0), Axis::linear("*y*").within(-0.2, 4.2));
    let plane = plane
        .equal()
        .line(path(one_step), Stroke::solid(BLUE).width(2.5))
        .labelled("along *x*, one step")
        .dots(parasites[0].path.clone(), 1.3, VERMILLION)
        .labelled("symmetric, two steps");
    let empty = Panel::new(
        "Parasitic mode of two steps, symmetric gauge",
        Axis::linear("time *t*").within(0.0, END),
        Axis::logarithmic("amplitude in *q*").within(1e-9, 10.0),
    );
    let strokes = [Stroke::solid(VERMILLION), Stroke::dashed(GREEN), Stroke::dashed(SLATE)];
    let amplitudes = parasites.iter().zip(strokes).fold(empty.weight(1.35), |panel, (parasite, stroke)| {
        panel.line(parasite.amplitudes.clone(), stroke).labelled(format!("*h* = {}", parasite.h))
    });
    let energy = Panel::new(
        "Error of the energy",
        Axis::linear("time *t*").within(0.0, end),
        Axis::logarithmic("largest |Δ*H*| of each interval").within(1e-5, 10.0),
    )
    .line(one_step.error.envelope.magnitude(), Stroke::solid(BLUE))
    .labelled(one_step.name)
    .line(projected.error.envelope.magnitude(), Stroke::solid(GREEN))
    .labelled(projected.name)
    .line(runge_kutta.error.envelope.magnitude(), Stroke::dashed(SLATE))
    .labelled(runge_kutta.name);
    Figure::new(
        "A charged particle without mass: two gauges of one field",
        format!("*B* = 1 + 2(*x*² + *y*²), *φ* = cos *x* + sin *y*, from (1, 1), *h* = {H}"),
    )
    .row(430.0, vec![plane.legend_at(Corner::TopRight), amplitudes.legend_at(Corner::BottomRight)])
    .row(300.0, vec![energy.legend_at(Corner::BottomRight)])
    .footer(format!(
        "Largest |Δ*H*|: one step {}, projected {}. RK4 at the end: {}.",
        at_most(one_step.error.largest),
        at_most(projected.error.largest),
        scientific(runge_kutta.error.largest)
    ))
}

fn table(all: &[Series; 3], parasites: &[Parasite]) -> Result<Table> {
    let mut table = Table::new(&["series", "t", "amplitude or lowest ΔH", "highest ΔH"])?;
    for Series { name, error, .. } in all {
        for [t, low, _, high] in error.envelope.rows() {
            table.row([name.replace('*', ""), number(t), number(low), number(high)])?;
        }
    }
    for Parasite { h, amplitudes, .. } in parasites {
        for [t, amplitude] in amplitudes {
            table.row([
                format!("parasitic mode, h = {h}"),
                number(*t),
                number(*amplitude),
                String::new(),
            ])?;
        }
    }
    Ok(table)
}
