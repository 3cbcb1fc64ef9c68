//! Point vortices on a sphere: a one-form along the longitudes only, which is in the class of one-step
//! schemes and not affine.
//!
//! A pair turns around its moment M = ΣΓr with the rate |M|/2πl², where l is its distance, and a ring of n
//! equal vortices at height z around the axis with the rate Γ(n − 1)z/4π(1 − z²) (Polvani & Dritschel 1993).
//! M is conserved. In coordinates along an axis a scheme is symmetric about that axis only: the component
//! along it is kept, and M turns slowly around it.

use std::f64::consts::{PI, TAU};

use anyhow::Result;
use dvi_core::methods::Method;
use dvi_core::prelude::*;

use crate::claim::{BEYOND, Bound, Claim, larger};
use crate::deviation::Deviation;
use crate::figure::{
    Axis, BLUE, Corner, Envelope, Figure, GREEN, Panel, SKY, SLATE, Stroke, VERMILLION, at_most, scientific,
};
use crate::gallery::{Experiment, Outcome};
use crate::job::Job;
use crate::models::SphereVortices;
use crate::output::{Table, number};

pub const EXPERIMENT: Experiment =
    Experiment { name: "sphere-vortices", title: "Point vortices on a sphere", share: 9.0, run };

/// Three vortices whose moment is not along the axis of the coordinates.
const THREE: SphereVortices<3> = SphereVortices { gamma: [1.0, 1.5, 2.0] };
const PLACES: [[f64; 3]; 3] = [[0.9, 0.2, 0.5], [-0.4, 0.8, 0.3], [-0.5, -0.7, 0.7]];
const H: f64 = 0.5;
/// Steps of the beginning, with which the whole is compared.
const EARLY: u64 = 4000;

/// What one run leaves.
struct Series {
    name: &'static str,
    /// (x, y) of the vortices in the beginning, as seen from above the pole.
    paths: [Vec<[f64; 2]>; 3],
    energy: Deviation,
    /// |M| over its value at the start, less 1.
    moment: Deviation,
    /// By what angle M has turned around the axis of the coordinates.
    turn: Envelope,
    /// |M_z − M_z(0)|/|M|.
    largest_axial: f64,
}

fn run(job: &Job<'_>) -> Result<Outcome> {
    let steps = job.choose(400_000, 20_000);
    job.expect(3 * steps);
    let all = [
        series(job, "one step, midpoint", OneStep::midpoint(), steps)?,
        series(job, "one step, Gauss of order 4", OneStepGauss::<2>::new(), steps)?,
        series(job, "RK4", RungeKutta::classical(), steps)?,
    ];
    let claims = vec![kept(&all), precession()?, pair()?, ring()?];
    job.publish(EXPERIMENT.name, figure(&all, steps as f64 * H), table(&all)?)?;
    Ok(Outcome { claims, references: vec![], notes: vec![] })
}

/// ΣΓr.
fn moment<const N: usize>(gamma: &[f64; N], places: &[[f64; 3]; N]) -> [f64; 3] {
    std::array::from_fn(|i| gamma.iter().zip(places).map(|(gamma, place)| gamma * place[i]).sum())
}

fn length(v: [f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn difference(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| a[i] - b[i])
}

fn series<M: Method<SphereVortices<3>, f64>>(
    job: &Job<'_>,
    name: &'static str,
    method: M,
    steps: u64,
) -> Result<Series> {
    let mut run = Integrator::new(&THREE, method, H, SphereVortices::state(PLACES))?;
    let (energy, start) = (run.energy(), moment(&THREE.gamma, &THREE.places(run.q())));
    let end = steps as f64 * H;
    let empty = || Deviation::new(end, 100, EARLY as f64 * H);
    let mut series = Series {
        name,
        paths: [vec![], vec![], vec![]],
        energy: empty(),
        moment: empty(),
        turn: Envelope::new(end, 100),
        largest_axial: 0.0,
    };
    let mut direction = Direction::of(start);
    job.repeat(steps, || {
        run.advance()?;
        let places = THREE.places(run.q());
        let moment = moment(&THREE.gamma, &places);
        series.energy.push(run.time(), run.energy() - energy);
        series.moment.push(run.time(), length(moment) / length(start) - 1.0);
        series.turn.push(run.time(), direction.turned_to(moment));
        series.largest_axial = larger(series.largest_axial, (moment[2] - start[2]).abs() / length(start));
        if run.steps() <= 400 {
            for (path, [x, y, _]) in series.paths.iter_mut().zip(places) {
                path.push([x, y]);
            }
        }
        Ok(())
    })?;
    Ok(series)
}

/// The angle of a vector around the z axis, counted over more than one turn.
struct Direction {
    angle: f64,
    turn: f64,
}

impl Direction {
    fn of([x, y, _]: [f64; 3]) -> Self {
        Self { angle: y.atan2(x), turn: 0.0 }
    }

    /// The angle since the start.
    fn turned_to(&mut self, [x, y, _]: [f64; 3]) -> f64 {
        let angle = y.atan2(x);
        self.turn += (angle - self.angle + PI).rem_euclid(TAU) - PI;
        self.angle = angle;
        self.turn
    }
}

fn kept(all: &[Series; 3]) -> Claim {
    let text = "energy and length of the moment are no further off in the whole run than in its beginning, and the moment along the axis is kept to rounding errors";
    let [midpoint, gauss, runge_kutta] = all;
    let claim = [midpoint, gauss].into_iter().fold(Claim::new(BEYOND, text), |claim, series| {
        let name =
            |quantity: &str| format!("{}: max|Δ{quantity}| over all / over {EARLY} steps", series.name);
        claim
            .check(name("H"), series.energy.growth(), Bound::AtMost(1.05))
            .check(name("|M|"), series.moment.growth(), Bound::AtMost(1.05))
            .check(format!("{}: max|ΔM_z|/|M|", series.name), series.largest_axial, Bound::AtMost(1e-10))
    });
    let growth = runge_kutta.energy.growth();
    claim.check(format!("RK4: max|ΔH| over all / over {EARLY} steps"), growth, Bound::AtLeast(4.0))
}

/// The angle by which M has turned at t = 400, over the step.
fn precession() -> Result<Claim> {
    const END: f64 = 400.0;
    fn order<M: Method<SphereVortices<3>, f64> + Copy>(method: M, steps: [u64; 3]) -> Result<Option<f64>> {
        let angle = |steps: u64| -> Result<(f64, f64)> {
            let h = END / steps as f64;
            let mut run = Integrator::new(&THREE, method, h, SphereVortices::state(PLACES))?;
            let mut direction = Direction::of(moment(&THREE.gamma, &THREE.places(run.q())));
            run.take_steps(steps)?;
            Ok((h, direction.turned_to(moment(&THREE.gamma, &THREE.places(run.q()))).abs()))
        };
        Ok(convergence_order(&steps.into_iter().map(angle).collect::<Result<Vec<_>>>()?))
    }
    Ok(Claim::new(BEYOND, "the moment turns slowly around the axis of the coordinates, at a rate that falls with the order of the scheme")
        .check("midpoint: order of the angle at t = 400", order(OneStep::midpoint(), [400, 600, 800])?, Bound::Near(2.0, 0.1))
        .check("Gauss of order 4: order of the angle at t = 400", order(OneStepGauss::<2>::new(), [400, 600, 800])?, Bound::Near(4.0, 0.2)))
}

/// v turned around an axis by an angle (Rodrigues).
fn turned(v: [f64; 3], axis: [f64; 3], angle: f64) -> [f64; 3] {
    let k = axis.map(|x| x / length(axis));
    let cross = [k[1] * v[2] - k[2] * v[1], k[2] * v[0] - k[0] * v[2], k[0] * v[1] - k[1] * v[0]];
    let dot: f64 = k.iter().zip(v).map(|(k, v)| k * v).sum();
    let (sin, cos) = angle.sin_cos();
    std::array::from_fn(|i| v[i] * cos + cross[i] * sin + k[i] * dot * (1.0 - cos))
}

fn pair() -> Result<Claim> {
    const END: f64 = 40.0;
    let pair = SphereVortices { gamma: [1.0, 2.0] };
    let start = SphereVortices::state([[0.8, 0.3, 0.2], [-0.3, 0.5, 0.6]]);
    let mut errors = Vec::new();
    for steps in [100, 150, 200] {
        let h = END / steps as f64;
        let mut run = Integrator::new(&pair, OneStep::midpoint(), h, start)?;
        let places = pair.places(run.q());
        let axis = moment(&pair.gamma, &places);
        let rate = length(axis) / (TAU * length(difference(places[0], places[1])).powi(2));
        run.take_steps(steps)?;
        let apart = |(a, b): ([f64; 3], [f64; 3])| length(difference(a, turned(b, axis, rate * END)));
        errors.push((h, pair.places(run.q()).into_iter().zip(places).map(apart).fold(0.0, larger)));
    }
    Ok(Claim::new(
        BEYOND,
        "a pair turns around its moment with the rate |M|/2πl², to the order of the scheme",
    )
    .check("distance from that at t = 40, 200 steps", errors[2].1, Bound::AtMost(0.05))
    .check("order of it", convergence_order(&errors), Bound::Near(2.0, 0.05)))
}

fn ring() -> Result<Claim> {
    const N: usize = 4;
    let (z, h, steps) = (0.7f64, 0.5, 100);
    let ring = SphereVortices { gamma: [1.0; N] };
    let angle = |j: usize| TAU * j as f64 / N as f64;
    let radius = (1.0 - z * z).sqrt();
    let start = std::array::from_fn(|j| [radius * angle(j).cos(), radius * angle(j).sin(), z]);
    let rate = (N - 1) as f64 * z / (4.0 * PI * (1.0 - z * z));
    let mut run = Integrator::new(&ring, OneStep::midpoint(), h, SphereVortices::state(start))?;
    run.take_steps(steps)?;
    let apart = |(a, b): ([f64; 3], [f64; 3])| {
        length(difference(a, turned(b, [0.0, 0.0, 1.0], rate * h * steps as f64)))
    };
    let error = ring.places(run.q()).into_iter().zip(start).map(apart).fold(0.0, larger);
    Ok(Claim::new(
        BEYOND,
        "a ring of four vortices around the axis turns as it should, without error of the scheme",
    )
    .check("distance from that after 100 steps of h = 0.5", error, Bound::AtMost(1e-11)))
}

fn figure(all: &[Series; 3], end: f64) -> Figure {
    let [midpoint, gauss, runge_kutta] = all;
    let rim = (0..=180).map(|k| f64::from(k) * PI / 90.0).map(|angle| [angle.cos(), angle.sin()]).collect();
    let plane = Panel::new(
        "Paths, seen from above the pole",
        Axis::linear("*x*").within(-1.1, 1.1),
        Axis::linear("*y*").within(-1.1, 1.75),
    );
    let plane = plane.equal().line(rim, Stroke::solid(SLATE).width(1.0));
    let paths = midpoint.paths.iter().zip([BLUE, VERMILLION, GREEN]).zip(THREE.gamma).fold(
        plane,
        |plane, ((path, colour), gamma)| {
            plane.line(path.clone(), Stroke::solid(colour).width(1.1)).labelled(format!("Γ = {gamma}"))
        },
    );
    let time = || Axis::linear("time *t*").within(0.0, end);
    let strokes = [Stroke::solid(BLUE), Stroke::solid(SKY), Stroke::dashed(VERMILLION)];
    let lines = |panel: Panel, what: fn(&Series) -> &Envelope| {
        [midpoint, gauss, runge_kutta].into_iter().zip(strokes).fold(panel, |panel, (series, stroke)| {
            panel.line(what(series).magnitude(), stroke).labelled(series.name)
        })
    };
    let energy =
        Panel::new("Error of the energy", time(), Axis::logarithmic("largest |Δ*H*| of each interval"));
    let energy = lines(energy, |series| &series.energy.envelope);
    let moment = Panel::new(
        "Length of the moment",
        time(),
        Axis::logarithmic("largest |Δ|*M*||/|*M*| of each interval"),
    );
    let turn =
        Panel::new("Direction of the moment", time(), Axis::logarithmic("angle around the axis   [rad]"));
    Figure::new(
        "Three point vortices on a sphere",
        format!("*h* = {H}; on the left the one-step midpoint scheme up to *t* = {}", 400.0 * H),
    )
    .row(430.0, vec![paths, energy.weight(1.4).legend_at(Corner::Beside)])
    .row(
        300.0,
        vec![
            lines(moment, |series| &series.moment.envelope).without_legend(),
            lines(turn, |series| &series.turn).without_legend(),
        ],
    )
    .footer(format!(
        "Largest |Δ*H*| of one step: midpoint {}, Gauss {}. RK4 at the end: {}.",
        at_most(midpoint.energy.largest),
        at_most(gauss.energy.largest),
        scientific(runge_kutta.energy.largest)
    ))
}

fn table(all: &[Series; 3]) -> Result<Table> {
    let mut table = Table::new(&["method", "quantity", "t", "lowest", "mean", "highest"])?;
    for Series { name, energy, moment, turn, .. } in all {
        for (quantity, envelope) in
            [("ΔH", &energy.envelope), ("Δ|M|/|M|", &moment.envelope), ("angle of M", turn)]
        {
            for row in envelope.rows() {
                let names = [(*name).to_owned(), quantity.to_owned()];
                table.row(names.into_iter().chain(row.map(number)))?;
            }
        }
    }
    Ok(table)
}
