//! A guiding centre in a field from a table, beside the same field from formulas.
//!
//! The functions of the field are splines through their values on a grid. Their first derivatives, which the
//! motion depends on, are of the order 3 in the distances of the grid for cubic splines, and of the order 5
//! for quintic ones.

use anyhow::{Context, Result};
use dvi_core::ProperlyDegenerate;
use dvi_core::field::{ScalarField, Spline};
use dvi_core::prelude::*;

use crate::claim::{BEYOND, Bound, Claim, larger};
use crate::deviation::Deviation;
use crate::figure::{Axis, BLUE, Corner, Figure, GREEN, Panel, Stroke, VERMILLION, at_most};
use crate::gallery::{Experiment, Outcome};
use crate::job::Job;
use crate::models::{TabulatedTokamak, TabulatedTokamakState, TokamakInClass, TokamakInClassState};
use crate::output::{Table, number};

pub const EXPERIMENT: Experiment = Experiment {
    name: "tabulated-field",
    title: "A guiding centre in a field that comes from a table",
    share: 3.0,
    run,
};

const Q: f64 = 2.0;
const MU: f64 = 6e-5;
const VELOCITY: f64 = 4e-3;
/// The bananas that are compared begin at these distances from the magnetic axis: how large the error of a
/// spline is along an orbit depends on where that lies between the points of the grid.
const RADII: [f64; 12] = [0.19, 0.195, 0.198, 0.202, 0.206, 0.209, 0.214, 0.218, 0.221, 0.225, 0.231, 0.235];
/// The one whose energy is watched.
const RADIUS: f64 = 0.2;
const H: f64 = 60.0;
/// Steps of the orbit that is compared: two bounces of the banana.
const COMPARED: usize = 200;
/// Steps of the beginning, with which the energy of the whole is compared.
const EARLY: u64 = 2000;
/// The intervals of the grid across the section.
const GRIDS: [usize; 14] = [8, 9, 11, 13, 15, 18, 21, 25, 29, 34, 40, 47, 55, 64];
/// Of the table in the long run.
const COARSE: usize = 12;

/// One kind of spline on all grids.
struct Differences {
    name: &'static str,
    /// The intervals across the section, and the root mean square of how far the orbits are at most from
    /// those of the formulas.
    of_grids: Vec<(f64, f64)>,
    /// By which power of their number it falls.
    order: f64,
}

fn run(job: &Job<'_>) -> Result<Outcome> {
    let steps = job.choose(1_000_000, 10_000);
    job.expect(steps);
    let exact = TokamakInClass { q: Q, mu: MU };
    let orbits = RADII.map(|r| path(&exact, TokamakInClassState { r, theta: 0.0, phi: 0.0, u: VELOCITY }));
    let orbits = orbits.into_iter().collect::<Result<Vec<_>>>()?;
    let cubic = differences("cubic splines", &orbits, |n| {
        TabulatedTokamak::sampled(Q, MU, n, |axes, function| Ok(Spline::sample(axes, function)?))
    })?;
    let quintic = differences("quintic splines", &orbits, |n| {
        TabulatedTokamak::sampled(Q, MU, n, |axes, function| Ok(Spline::sample_quintic(axes, function)?))
    })?;
    let energy = energy(job, steps)?;
    let outcome = Outcome { claims: claims(&cubic, &quintic, &energy), references: vec![], notes: vec![] };
    let table = table(&[&cubic, &quintic])?;
    job.publish(EXPERIMENT.name, figure(&cubic, &quintic, &energy, steps as f64 * H), table)?;
    Ok(outcome)
}

/// r and u, which go to and fro, along the orbit.
fn path<S: ProperlyDegenerate>(system: &S, start: S::State<f64>) -> Result<Vec<[f64; 2]>> {
    let mut run = Integrator::new(system, OneStep::midpoint(), H, start)?;
    let mut path = Vec::with_capacity(COMPARED);
    for _ in 0..COMPARED {
        run.advance()?;
        path.push([run.q()[0], run.q()[3]]);
    }
    Ok(path)
}

fn start(r: f64) -> TabulatedTokamakState {
    TabulatedTokamakState { r, theta: 0.0, phi: 0.0, u: VELOCITY }
}

/// How far two orbits are apart at most, in units of the width of the banana and of the velocity at the
/// start.
fn apart(path: &[[f64; 2]], orbit: &[[f64; 2]]) -> f64 {
    let radii = || orbit.iter().map(|[r, _]| *r);
    let width = radii().fold(f64::MIN, f64::max) - radii().fold(f64::MAX, f64::min);
    let differences = path.iter().zip(orbit).map(|(found, expected)| {
        larger((found[0] - expected[0]).abs() / width, (found[1] - expected[1]).abs() / VELOCITY)
    });
    differences.fold(0.0, larger)
}

fn differences<F: ScalarField<2>>(
    name: &'static str,
    orbits: &[Vec<[f64; 2]>],
    sampled: impl Fn(usize) -> Result<TabulatedTokamak<F>>,
) -> Result<Differences> {
    let mut of_grids = Vec::new();
    for n in GRIDS {
        let system = sampled(n)?;
        let mut squares = 0.0;
        for (orbit, r) in orbits.iter().zip(RADII) {
            squares += apart(&path(&system, start(r))?, orbit).powi(2);
        }
        of_grids.push((n as f64, (squares / RADII.len() as f64).sqrt()));
    }
    let falls = convergence_order(&of_grids).context("differences that fall")?;
    Ok(Differences { name, of_grids, order: -falls })
}

/// The relative energy error in the coarse table.
fn energy(job: &Job<'_>, steps: u64) -> Result<Deviation> {
    let system =
        TabulatedTokamak::sampled(Q, MU, COARSE, |axes, function| Ok(Spline::sample(axes, function)?))?;
    let mut run = Integrator::new(&system, OneStep::midpoint(), H, start(RADIUS))?;
    let start = run.energy();
    let mut error = Deviation::new(steps as f64 * H, 400, EARLY as f64 * H);
    job.repeat(steps, || {
        run.advance()?;
        error.push(run.time(), (run.energy() - start) / start);
        Ok(())
    })?;
    Ok(error)
}

fn claims(cubic: &Differences, quintic: &Differences, energy: &Deviation) -> Vec<Claim> {
    vec![
        Claim::new(BEYOND, "orbits in a table tend to those of the formulas as the splines do")
            .check("order in the distances of the grid, cubic", cubic.order, Bound::Near(3.0, 0.3))
            .check("order in the distances of the grid, quintic", quintic.order, Bound::Near(5.0, 0.3)),
        Claim::new(BEYOND, "the energy of a table is kept as that of a formula is").check(
            format!("cubic, {COARSE} intervals: max|ΔH| over all / over {EARLY} steps"),
            energy.growth(),
            Bound::AtMost(1.02),
        ),
    ]
}

fn figure(cubic: &Differences, quintic: &Differences, energy: &Deviation, end: f64) -> Figure {
    let points = |of: &Differences| of.of_grids.iter().map(|&(n, apart)| [n, apart]).collect::<Vec<_>>();
    // A straight line of this slope through the last point.
    let slope = |of: &Differences, order: i32| {
        let ends = [0, GRIDS.len() - 1].map(|grid| of.of_grids[grid].0);
        let (n, apart) = of.of_grids[GRIDS.len() - 1];
        ends.map(|at| [at, apart * (n / at).powi(order)]).to_vec()
    };
    let falls = Panel::new(
        "Distance from the orbits in the field of formulas",
        Axis::logarithmic("intervals of the grid across the section").within(6.0, 80.0),
        Axis::logarithmic("difference, relative").within(1e-13, 1e-2),
    )
    .line(slope(cubic, 3), Stroke::dashed(BLUE).width(1.0))
    .line(slope(quintic, 5), Stroke::dashed(VERMILLION).width(1.0))
    .dots(points(cubic), 4.0, BLUE)
    .labelled(format!("cubic: order {:.1}", cubic.order))
    .dots(points(quintic), 4.0, VERMILLION)
    .labelled(format!("quintic: order {:.1}", quintic.order));
    let error = Panel::new(
        format!("Relative error of the energy, cubic splines of {COARSE} intervals"),
        Axis::linear("time *t*").within(0.0, end),
        Axis::logarithmic("largest |Δ*H*/*H*| of each interval").within(1e-7, 1e-3),
    )
    .weight(1.35)
    .line(energy.envelope.magnitude(), Stroke::solid(GREEN));
    Figure::new(
        "A guiding centre in a field from a table",
        format!(
            "*q* = {Q}, *μ* = {MU}, bananas from *R* = {:.2} to {:.3}, *h* = {H}, one-step midpoint",
            1.0 + RADII[0],
            1.0 + RADII[RADII.len() - 1]
        ),
    )
    .row(430.0, vec![falls.legend_at(Corner::TopRight), error.without_legend()])
    .footer(format!(
        "Dashed: orders 3 and 5 of the first derivatives. Largest |Δ*H*/*H*|: {}.",
        at_most(energy.largest)
    ))
}

fn table(differences: &[&Differences]) -> Result<Table> {
    let mut table = Table::new(&["spline", "intervals", "difference"])?;
    for Differences { name, of_grids, .. } in differences {
        for &(n, apart) in of_grids {
            table.row([(*name).to_owned(), number(n), number(apart)])?;
        }
    }
    Ok(table)
}
