//! A guiding centre in a tokamak: a one-step scheme where the one-form is in class, a projected one where it
//! is not.
//!
//! A particle that has little velocity along the field is reflected where the field is strong, and its orbit
//! in the poloidal plane is a banana; one with more goes around. Energy and toroidal momentum are conserved.

use anyhow::Result;
use dvi_core::methods::Method;
use dvi_core::prelude::*;

use crate::claim::{BEYOND, Bound, Claim, larger};
use crate::deviation::Deviation;
use crate::figure::{
    Axis, BLUE, Corner, Figure, GREEN, Panel, SLATE, Stroke, VERMILLION, at_most, scientific,
};
use crate::gallery::{Experiment, Outcome};
use crate::job::Job;
use crate::models::{TokamakInClass, TokamakInClassState, TokamakOutOfClass, TokamakOutOfClassState};
use crate::output::{Table, number};

pub const EXPERIMENT: Experiment = Experiment {
    name: "guiding-centre",
    title: "A guiding centre in a tokamak, in class and out of class",
    share: 8.0,
    run,
};

const Q: f64 = 2.0;
const MU: f64 = 6e-5;
/// The start, on the outer side: the distance from the magnetic axis.
const RADIUS: f64 = 0.2;
/// The velocities along the field at the start, of the banana and of the passing orbit.
const VELOCITIES: [f64; 2] = [4e-3, 1.2e-2];
const H: f64 = 60.0;
/// Steps of the beginning, with which the whole is compared; several bounces.
const EARLY: u64 = 2000;

/// What one run leaves.
struct Series {
    name: &'static str,
    error: Deviation,
    /// R and Z of the beginning.
    path: Vec<[f64; 2]>,
    /// The largest change of the toroidal momentum, relative to its size.
    momentum: f64,
}

/// The runs of one orbit.
struct Orbit {
    in_class: Series,
    projected: Series,
    runge_kutta: Series,
}

fn run(job: &Job<'_>) -> Result<Outcome> {
    let steps = job.choose(1_000_000, 10_000);
    job.expect(6 * steps);
    let [banana, passing] = VELOCITIES.map(|u| orbit(job, u, steps));
    let orbits = [banana?, passing?];
    let outcome = Outcome { claims: claims(&orbits), references: vec![], notes: vec![] };
    job.publish(EXPERIMENT.name, figure(&orbits, steps as f64 * H), table(&orbits)?)?;
    Ok(outcome)
}

fn orbit(job: &Job<'_>, u: f64, steps: u64) -> Result<Orbit> {
    let system = TokamakInClass { q: Q, mu: MU };
    let start = TokamakInClassState { r: RADIUS, theta: 0.0, phi: 0.0, u };
    let toroidal = |q: &[f64]| [1.0 + q[0] * q[1].cos(), q[0] * q[1].sin()];
    let in_class = series(job, "in class, one step", &system, OneStep::midpoint(), start, toroidal, steps)?;
    let system = TokamakOutOfClass { q: Q, mu: MU };
    let start = TokamakOutOfClassState { x: RADIUS, z: 0.0, phi: 0.0, u };
    let plane = |q: &[f64]| [1.0 + q[0], q[1]];
    let projected =
        series(job, "out of class, projected", &system, Projected::symmetric(), start, plane, steps)?;
    let runge_kutta = series(job, "RK4", &system, RungeKutta::classical(), start, plane, steps)?;
    Ok(Orbit { in_class, projected, runge_kutta })
}

fn series<S: DegenerateLagrangian, M: Method<S, f64>>(
    job: &Job<'_>,
    name: &'static str,
    system: &S,
    method: M,
    start: S::State<f64>,
    place: impl Fn(&[f64]) -> [f64; 2],
    steps: u64,
) -> Result<Series> {
    let mut run = Integrator::new(system, method, H, start)?;
    let energy = run.energy();
    let toroidal = run.momenta().map(|(_, value)| value).sum::<f64>();
    let mut series = Series {
        name,
        error: Deviation::new(steps as f64 * H, 400, EARLY as f64 * H),
        path: vec![place(run.q())],
        momentum: 0.0,
    };
    job.repeat(steps, || {
        run.advance()?;
        series.error.push(run.time(), (run.energy() - energy) / energy);
        let change = run.momenta().map(|(_, value)| value).sum::<f64>() / toroidal - 1.0;
        series.momentum = larger(series.momentum, change.abs());
        if run.steps() <= EARLY / 8 {
            series.path.push(place(run.q()));
        }
        Ok(())
    })?;
    Ok(series)
}

const NAMES: [&str; 2] = ["banana", "passing orbit"];

fn claims(orbits: &[Orbit; 2]) -> Vec<Claim> {
    let mut flat = Claim::new(BEYOND, "energy errors are no larger in the whole run than in its beginning");
    let mut momentum = Claim::new(BEYOND, "the toroidal momentum is kept to rounding errors");
    let mut same = Claim::new(BEYOND, "both sets of coordinates give one orbit");
    let reach = |series: &Series| series.path.iter().map(|[_, z]| z.abs()).fold(0.0, larger);
    for (name, Orbit { in_class, projected, runge_kutta }) in NAMES.iter().zip(orbits) {
        let text = format!("{name}: largest |Z| out of class, in units of that in class");
        same = same.check(text, reach(projected) / reach(in_class), Bound::Near(1.0, 2e-3));
        for series in [in_class, projected] {
            let text = format!("{name}, {}: max|ΔH| over all / over {EARLY} steps", series.name);
            flat = flat.check(text, series.error.growth(), Bound::AtMost(1.02));
            let text = format!("{name}, {}: max|Δp_φ/p_φ|", series.name);
            momentum = momentum.check(text, series.momentum, Bound::AtMost(1e-9));
        }
        let text = format!("{name}, {}: max|ΔH| over all / over {EARLY} steps", runge_kutta.name);
        flat = flat.check(text, runge_kutta.error.growth(), Bound::AtLeast(2.0));
    }
    vec![flat, momentum, same]
}

fn figure(orbits: &[Orbit; 2], end: f64) -> Figure {
    let [banana, passing] = orbits;
    let paths = Panel::new(
        "Poloidal plane",
        Axis::linear("*R*").within(0.7, 1.3),
        Axis::linear("*Z*").within(-0.22, 0.38),
    )
    .equal()
    .line(banana.in_class.path.clone(), Stroke::solid(BLUE).width(2.5))
    .labelled("banana, in class")
    .line(banana.projected.path.clone(), Stroke::dashed(VERMILLION).width(1.2))
    .labelled("banana, out of class")
    .line(passing.in_class.path.clone(), Stroke::solid(GREEN).width(2.5))
    .labelled("passing, in class")
    .line(passing.projected.path.clone(), Stroke::dashed(SLATE).width(1.2))
    .labelled("passing, out of class");
    let energy = Panel::new(
        "Relative error of the energy, banana",
        Axis::linear("time *t*").within(0.0, end),
        Axis::logarithmic("largest |Δ*H*/*H*| of each interval").within(1e-7, 1e-1),
    )
    .weight(1.35)
    .line(banana.in_class.error.envelope.magnitude(), Stroke::solid(BLUE))
    .labelled(banana.in_class.name)
    .line(banana.projected.error.envelope.magnitude(), Stroke::solid(VERMILLION))
    .labelled(banana.projected.name)
    .line(banana.runge_kutta.error.envelope.magnitude(), Stroke::dashed(SLATE))
    .labelled(banana.runge_kutta.name);
    Figure::new(
        "A guiding centre in a tokamak: two orbits in two sets of coordinates",
        format!("*q* = {Q}, *μ* = {MU}, from *R* = {}, *h* = {H}", 1.0 + RADIUS),
    )
    .row(470.0, vec![paths.legend_at(Corner::TopRight), energy.legend_at(Corner::TopRight)])
    .footer(format!(
        "Largest |Δ*H*/*H*| of the banana: one step {}, projected {}. RK4 at the end: {}.",
        at_most(banana.in_class.error.largest),
        at_most(banana.projected.error.largest),
        scientific(banana.runge_kutta.error.largest)
    ))
}

fn table(orbits: &[Orbit; 2]) -> Result<Table> {
    let mut table = Table::new(&["orbit", "method", "t", "lowest", "mean", "highest"])?;
    for (orbit, Orbit { in_class, projected, runge_kutta }) in NAMES.iter().zip(orbits) {
        for Series { name, error, .. } in [in_class, projected, runge_kutta] {
            for row in error.envelope.rows() {
                let names = [(*orbit).to_owned(), (*name).to_owned()];
                table.row(names.into_iter().chain(row.map(number)))?;
            }
        }
    }
    Ok(table)
}
