//! Predators and prey: one-step schemes where the two-step scheme fails.
//!
//! The one-form is not affine. With a component along one coordinate only it is in the class of one-step
//! schemes; in the symmetric form of the same motion it is not, and the two-step midpoint scheme loses it to
//! its parasitic mode.

use anyhow::Result;
use dvi_core::Space;
use dvi_core::methods::Method;
use dvi_core::prelude::*;

use crate::claim::{BEYOND, Bound, Check, Claim, larger};
use crate::deviation::Deviation;
use crate::figure::{
    Axis, BLUE, Corner, Figure, GREEN, Panel, SLATE, Stroke, VERMILLION, at_most, scientific,
};
use crate::gallery::{Experiment, Outcome};
use crate::job::Job;
use crate::models::{
    OneSidedPredators, OneSidedPredatorsState, ShiftedPredators, ShiftedSymmetricPredators,
    SymmetricPredators, SymmetricPredatorsState,
};
use crate::output::{Table, number};

pub const EXPERIMENT: Experiment = Experiment {
    name: "lotka-volterra",
    title: "Predators and prey, in one step and in two",
    share: 2.0,
    run,
};

const START: [f64; 2] = [2.0, 1.0];
const H: f64 = 0.1;
/// Steps of the beginning, with which the whole is compared.
const EARLY: u64 = 1000;

/// What one run leaves.
struct Series {
    name: &'static str,
    error: Deviation,
    path: Vec<[f64; 2]>,
    /// The step that failed.
    ended: Option<u64>,
}

fn run(job: &Job<'_>) -> Result<Outcome> {
    let steps = job.choose(1_000_000, 20_000);
    job.expect(3 * steps + 2 * EARLY + 2 * steps);
    let one_sided = OneSidedPredators {};
    let [x, y] = START;
    let start = OneSidedPredatorsState { x, y };
    let one_step = series(job, "one step, midpoint", &one_sided, OneStep::midpoint(), start, (H, steps))?;
    let gauss =
        series(job, "one step, Gauss of order 4", &one_sided, OneStepGauss::<2>::new(), start, (H, steps))?;
    let runge_kutta = series(job, "RK4", &one_sided, RungeKutta::classical(), start, (H, steps))?;
    let half = series(job, "", &one_sided, OneStep::midpoint(), start, (H / 2.0, 2 * steps))?;

    let symmetric = SymmetricPredators {};
    let start = SymmetricPredatorsState { x, y };
    let unwatched = Sigma { parasitic_limit: None, ..Sigma::midpoint() };
    let two_step = series(job, "two steps, σ = ½", &symmetric, unwatched, start, (H, EARLY))?;
    let watched = series(job, "", &symmetric, Sigma::midpoint(), start, (H, EARLY))?;

    let all = [one_step, gauss, runge_kutta, two_step];
    let outcome = Outcome {
        claims: claims(&all, &watched).into_iter().chain([gauges()?]).collect(),
        references: vec![
            Check::new(
                "one step, midpoint, h = 0.1: max|ΔH|",
                all[0].error.largest,
                Bound::Near(1.04e-2, 5e-5),
            ),
            Check::new(
                "one step, midpoint, h = 0.05: max|ΔH|",
                half.error.largest,
                Bound::Near(2.56e-3, 5e-6),
            ),
        ],
        notes: vec![],
    };
    job.publish(EXPERIMENT.name, figure(&all, steps as f64 * H), table(&all)?)?;
    Ok(outcome)
}

fn series<S: DegenerateLagrangian, M: Method<S, f64>>(
    job: &Job<'_>,
    name: &'static str,
    system: &S,
    method: M,
    start: S::State<f64>,
    (h, steps): (f64, u64),
) -> Result<Series> {
    let mut run = Integrator::new(system, method, h, start)?;
    let energy = run.energy();
    let mut series = Series {
        name,
        error: Deviation::new(steps as f64 * h, 400, EARLY as f64 * h),
        path: vec![START],
        ended: None,
    };
    let lost = job.repeat_until_lost(steps, || {
        run.advance()?;
        series.error.push(run.time(), run.energy() - energy);
        if run.steps() <= EARLY {
            series.path.push([run.q()[0], run.q()[1]]);
        }
        Ok(())
    });
    series.ended = lost.map(|error| error.step);
    Ok(series)
}

fn claims([one_step, gauss, runge_kutta, two_step]: &[Series; 4], watched: &Series) -> Vec<Claim> {
    let flat = Claim::new(
        BEYOND,
        "the energy error of one-step schemes is no larger in the whole run than in its beginning",
    )
    .check("midpoint: max|ΔH| over all / over 1000 steps", one_step.error.growth(), Bound::AtMost(1.001))
    .check(
        "Gauss of order 4: max|ΔH| over all / over 1000 steps",
        gauss.error.growth(),
        Bound::AtMost(1.001),
    )
    .check("RK4: max|ΔH| over all / over 1000 steps", runge_kutta.error.growth(), Bound::AtLeast(5.0));
    let number = |step: Option<u64>| step.map_or(f64::INFINITY, |step| step as f64);
    let fails = Claim::new(
        BEYOND,
        "the two-step midpoint fails in the symmetric one-form, and its parasitic mode is seen before",
    )
    .check("steps until no step is found", number(two_step.ended), Bound::AtMost(118.0))
    .check(
        "steps between the error of the parasitic mode and that",
        number(two_step.ended) - number(watched.ended),
        Bound::AtLeast(1.0),
    );
    vec![flat, fails]
}

/// Four one-forms that differ by gauges.
fn gauges() -> Result<Claim> {
    let forms: [Form; 4] = [
        omega(&OneSidedPredators {}),
        omega(&SymmetricPredators {}),
        omega(&ShiftedPredators {}),
        omega(&ShiftedSymmetricPredators {}),
    ];
    let apart = forms.iter().flat_map(|form| form.iter().zip(&forms[0]));
    let apart = apart.map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, larger);
    let spread = |h: f64| -> Result<f64> {
        let ends = [
            end(&OneSidedPredators {}, h)?,
            end(&SymmetricPredators {}, h)?,
            end(&ShiftedPredators {}, h)?,
            end(&ShiftedSymmetricPredators {}, h)?,
        ];
        let distances = ends.iter().flat_map(|a| ends.iter().map(|b| (a[0] - b[0]).hypot(a[1] - b[1])));
        Ok(distances.fold(0.0, larger))
    };
    let (coarse, fine) = (spread(H)?, spread(H / 2.0)?);
    let text = "four gauges have one Ω, and their runs differ by the second order of the scheme";
    Ok(Claim::new(BEYOND, text)
        .check("largest relative difference of Ω", apart, Bound::AtMost(1e-14))
        .check("projected, spread at t = 10: h = 0.1 over h = 0.05", coarse / fine, Bound::Near(4.0, 0.4)))
}

/// The entry of Ω at some points.
type Form = [f64; 25];

fn omega<S: DegenerateLagrangian>(system: &S) -> Form {
    let mut form = [0.0; 25];
    for (place, entry) in form.iter_mut().enumerate() {
        let q = [0.3 + 0.7 * (place / 5) as f64, 0.2 + 0.6 * (place % 5) as f64];
        let mut omega = system.space().matrix();
        system.one_form_jacobian(&q, 0.0, -1.0, 1.0, &mut omega);
        *entry = omega[1];
    }
    form
}

/// Where a projected run is at t = 10.
fn end<S>(system: &S, h: f64) -> Result<[f64; 2]>
where
    S: DegenerateLagrangian,
    S::State<f64>: From<(f64, f64)>,
{
    let [x, y] = START;
    let mut run = Integrator::new(system, Projected::symmetric(), h, (x, y).into())?;
    run.take_steps((10.0 / h).round() as u64)?;
    Ok([run.q()[0], run.q()[1]])
}

fn figure(all: &[Series; 4], end: f64) -> Figure {
    let [one_step, gauss, runge_kutta, two_step] = all;
    let coordinate = |label| Axis::linear(label).within(0.0, 4.5);
    let paths = Panel::new("Path", coordinate("*x*"), coordinate("*y*"))
        .equal()
        .line(one_step.path.clone(), Stroke::solid(BLUE).width(2.5))
        .labelled(one_step.name)
        .line(two_step.path.clone(), Stroke::solid(VERMILLION).width(1.0))
        .labelled(two_step.name);
    let time = Axis::linear("time *t*").within(0.0, end);
    let energy = Panel::new(
        "Error of the energy",
        time,
        Axis::logarithmic("largest |*H* − *H*(0)| of each interval").within(1e-6, 1.0),
    )
    .weight(1.35)
    .line(one_step.error.envelope.magnitude(), Stroke::solid(BLUE))
    .labelled(one_step.name)
    .line(gauss.error.envelope.magnitude(), Stroke::solid(GREEN))
    .labelled(gauss.name)
    .line(runge_kutta.error.envelope.magnitude(), Stroke::dashed(SLATE))
    .labelled(runge_kutta.name);
    let steps = two_step.ended.map_or("1000".to_owned(), |step| step.to_string());
    Figure::new(
        "Predators and prey: one step and two, and the energy errors of three methods",
        format!("From (2, 1), *h* = {H}; two steps with the symmetric one-form end after {steps} of them"),
    )
    .row(470.0, vec![paths.legend_at(Corner::TopRight), energy.legend_at(Corner::BottomRight)])
    .footer(format!(
        "Largest |Δ*H*| of one step: midpoint {}, Gauss {}. RK4 at the end: {}.",
        at_most(one_step.error.largest),
        at_most(gauss.error.largest),
        scientific(runge_kutta.error.largest)
    ))
}

fn table(all: &[Series; 4]) -> Result<Table> {
    let mut table = Table::new(&["method", "t", "lowest", "mean", "highest"])?;
    for Series { name, error, .. } in all {
        for row in error.envelope.rows() {
            table.row([(*name).to_owned()].into_iter().chain(row.map(number)))?;
        }
    }
    Ok(table)
}
