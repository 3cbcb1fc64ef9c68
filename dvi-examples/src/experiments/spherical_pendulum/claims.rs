//! What the experiment claims.

use dvi_core::prelude::*;

use super::{Measured, ORDER_TIME, STEPS, Swings, distance};
use crate::claim::{BEYOND, Bound, Claim};
use crate::experiments::rounding::{few_units, random_walk};
use crate::experiments::shadow::{self, Shadow};
use crate::experiments::turnings;
use crate::job::Job;

pub(super) fn claims(job: &Job<'_>, measured: &Measured) -> Vec<Claim> {
    let shadows = |swings: &[Swings; 3]| swings.each_ref().map(|swings| swings.energy);
    let [arcs, chords]: [[Shadow; 3]; 2] = [&measured.swings, &measured.constrained].map(shadows);
    vec![
        turnings::claim("a spherical pendulum", measured.swings.each_ref().map(|swings| &swings.extremes)),
        rounding(job, measured),
        energy(job, measured),
        shadow::claim("great circles", &arcs),
        shadow::claim("RATTLE", &chords),
        rk4(job, measured),
        order(measured),
    ]
}

fn rounding(job: &Job<'_>, measured: &Measured) -> Claim {
    let text = "unit vectors have the length one to a few units of rounding for the whole run; the momentum about the vertical is kept up to \
                errors no larger than a unit of rounding times the square root of the number of steps, and by RATTLE up to what the \
                errors of the length add up to over the steps";
    let (arcs, chords, bound) = (&measured.geodesic, &measured.rattle, random_walk(measured.steps));
    let momentum = "largest relative change of the momentum about the vertical";
    Claim::new(BEYOND, text)
        .check("steps", job.only_full(measured.steps as f64), Bound::AtLeast(1e7))
        .check("great circles: largest ||s|² − 1|", arcs.length.largest, few_units())
        .check("RATTLE: largest ||s|² − 1|", chords.length.largest, bound)
        .check(format!("great circles: {momentum}"), arcs.vertical.largest, bound)
        .check(
            format!("RATTLE: {momentum}"),
            chords.vertical.largest,
            Bound::AtMost(measured.steps as f64 * chords.length.largest),
        )
}

fn energy(job: &Job<'_>, measured: &Measured) -> Claim {
    let text = "the energy errors of a spherical pendulum have no trend, by great circles and by RATTLE";
    let predicted = |swings: &[Swings; 3]| Bound::AtMost(1.02 * swings[1].energy.predicted);
    let (arcs, chords) = (&measured.geodesic.energy, &measured.rattle.energy);
    let trend = "max|ΔE|, last tenth of the time over the first";
    Claim::new(BEYOND, text)
        .check("great circles: max|ΔE|", arcs.largest, predicted(&measured.swings))
        .check(format!("great circles: {trend}"), job.only_full(arcs.trend()), Bound::Near(1.0, 0.01))
        .check("RATTLE: max|ΔE|", chords.largest, predicted(&measured.constrained))
        .check(format!("RATTLE: {trend}"), job.only_full(chords.trend()), Bound::Near(1.0, 0.01))
}

fn rk4(job: &Job<'_>, measured: &Measured) -> Claim {
    let (series, arcs) = (&measured.rk4, &measured.geodesic);
    let trend = "last tenth of the time over the first";
    Claim::new(
        BEYOND,
        "RK4 on s and its rate leaves the sphere, and loses energy and momentum in proportion to the time",
    )
    .check(
        "RK4: largest ||s|² − 1|",
        job.only_full(series.length.largest),
        Bound::AtLeast(1e6 * arcs.length.largest),
    )
    .check(
        "RK4: largest relative change of the momentum",
        job.only_full(series.vertical.largest),
        Bound::AtLeast(1e3 * arcs.vertical.largest),
    )
    .check(
        format!("RK4: change of the momentum, {trend}"),
        job.only_full(series.vertical.trend()),
        Bound::Near(10.0, 1.0),
    )
    .check("RK4: max|ΔE|", job.only_full(series.energy.largest), Bound::AtLeast(10.0 * arcs.energy.largest))
    .check(
        format!("RK4: max|ΔE|, {trend}"),
        job.only_full(series.energy.trend()),
        Bound::Near(10.0, 1.0),
    )
}

fn order(measured: &Measured) -> Claim {
    let text = "the place of a spherical pendulum is of second order by great circles and by RATTLE, which differ by a term of the order h², and \
                of fourth by Suzuki's composition";
    let order = |errors: [f64; 3]| convergence_order(&STEPS.into_iter().zip(errors).collect::<Vec<_>>());
    let [arcs, composed, chords] = measured.errors.map(order);
    let apart = [0, 1, 2].map(|k| distance(measured.swings[k].place, measured.constrained[k].place));
    Claim::new(BEYOND, text)
        .check("distance of two references", measured.between_references, Bound::AtMost(1e-9))
        .check(format!("great circles: order at t = {ORDER_TIME}"), arcs, Bound::Near(2.0, 0.05))
        .check(format!("Suzuki's composition: order at t = {ORDER_TIME}"), composed, Bound::Near(4.0, 0.1))
        .check(format!("RATTLE: order at t = {ORDER_TIME}"), chords, Bound::Near(2.0, 0.05))
        .check("order of the distance of great circles and RATTLE", order(apart), Bound::Near(2.0, 0.05))
}
