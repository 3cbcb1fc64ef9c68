//! What the experiment claims.

use dvi_core::prelude::*;

use super::{FLIP_STEPS, Flips, Measured, ORDER_STEPS, ORDER_TIME};
use crate::claim::{BEYOND, Bound, Claim};
use crate::experiments::rounding::{few_units, random_walk};
use crate::experiments::shadow::{self, Shadow};
use crate::job::Job;

pub(super) fn claims(job: &Job<'_>, measured: &Measured) -> Vec<Claim> {
    let shadows: Vec<Shadow> = measured.flips.iter().map(|flips| flips.energy).collect();
    vec![
        momentum(job, measured),
        flips(job, measured),
        energy(job, measured),
        shadow::claim("free body", &shadows),
        rk4(job, measured),
        order(measured),
    ]
}

fn momentum(job: &Job<'_>, measured: &Measured) -> Claim {
    let text = "a free body keeps its angular momentum in space, in length and in direction, up to errors no larger than a unit of rounding \
                times the square root of the number of steps; the one in the body keeps its length, and matrices are orthogonal to a few units \
                of rounding";
    let series = &measured.geodesic;
    let bound = random_walk(measured.steps);
    Claim::new(BEYOND, text)
        .check("steps", job.only_full(measured.steps as f64), Bound::AtLeast(1e6))
        .check("geodesics: largest |M − M(0)|/|M| in space", series.space.largest, bound)
        .check("geodesics: largest relative change of |M| in the body", series.body.largest, bound)
        .check("geodesics: max|RᵀR − 1|", series.defect.largest, few_units())
}

fn flips(job: &Job<'_>, measured: &Measured) -> Claim {
    let text = "a free body that turns about its middle axis flips with the period of the elliptic functions, up to an error of the order h² \
                that is less than h² of it";
    let expected = measured.wave.period();
    let [coarse, middle, fine] = &measured.flips;
    let order = |error: &dyn Fn(&Flips) -> f64| {
        convergence_order(&measured.flips.iter().map(|flips| (flips.h, error(flips))).collect::<Vec<_>>())
    };
    let away = |flips: &Flips| flips.period / expected - 1.0;
    Claim::new(BEYOND, text)
        .check("flips", job.only_full(f64::from(fine.count)), Bound::AtLeast(38.0))
        .check(
            format!("h = {}: relative error of the period / h²", FLIP_STEPS[2]),
            away(fine).abs() / (fine.h * fine.h),
            Bound::AtMost(1.0),
        )
        .check(
            format!("error of the period, h = {} over h = {}", FLIP_STEPS[0], FLIP_STEPS[1]),
            away(coarse) / away(middle),
            Bound::Near(4.0, 0.1),
        )
        .check(
            format!("error of the period, h = {} over h = {}", FLIP_STEPS[1], FLIP_STEPS[2]),
            away(middle) / away(fine),
            Bound::Near(4.0, 0.1),
        )
        .check("ω₂ against sn over a period: order", order(&|flips| flips.error), Bound::Near(2.0, 0.05))
}

fn energy(job: &Job<'_>, measured: &Measured) -> Claim {
    let energy = &measured.geodesic.energy;
    // The largest that h²g makes of it, by the run with the same step.
    let predicted = measured.flips[1].energy.predicted;
    Claim::new(
        BEYOND,
        "the energy error of a free body has no trend, and is that of the closed form all the time",
    )
    .check("geodesics: max|ΔE|", energy.largest, Bound::AtMost(1.02 * predicted))
    .check(
        "geodesics: max|ΔE|, last tenth of the time over the first",
        job.only_full(energy.trend()),
        Bound::Near(1.0, 0.01),
    )
}

fn rk4(job: &Job<'_>, measured: &Measured) -> Claim {
    let text = "RK4 on the entries of the matrix loses the angular momentum, the rotation and the energy in proportion to the time, but the \
                energy by so little that its error is the smaller one all that time";
    let (series, geodesic) = (&measured.rk4, &measured.geodesic);
    let far = |kept: f64| Bound::AtLeast(1e6 * kept);
    let trend = "last tenth of the time over the first";
    Claim::new(BEYOND, text)
        .check(
            "RK4: largest |M − M(0)|/|M| in space",
            job.only_full(series.space.largest),
            far(geodesic.space.largest),
        )
        .check(
            "RK4: largest relative change of |M| in the body",
            job.only_full(series.body.largest),
            far(geodesic.body.largest),
        )
        .check("RK4: max|RᵀR − 1|", job.only_full(series.defect.largest), far(geodesic.defect.largest))
        .check(
            format!("RK4: max|RᵀR − 1|, {trend}"),
            job.only_full(series.defect.trend()),
            Bound::Near(10.0, 1.0),
        )
        .check("RK4: max|ΔE|", job.only_full(series.energy.largest), Bound::AtMost(geodesic.energy.largest))
        .check(
            format!("RK4: max|ΔE|, {trend}"),
            job.only_full(series.energy.trend()),
            Bound::Near(10.0, 1.0),
        )
}

fn order(measured: &Measured) -> Claim {
    let text = "R and ω of a free body are of second order, and of fourth by Suzuki's composition, against RK4 with short steps";
    let orders = measured
        .errors
        .map(|errors| convergence_order(&ORDER_STEPS.into_iter().zip(errors).collect::<Vec<_>>()));
    let [simple, composed] = orders;
    Claim::new(BEYOND, text)
        .check("largest difference of two references", measured.between_references, Bound::AtMost(1e-9))
        .check(format!("geodesics: order at t = {ORDER_TIME}"), simple, Bound::Near(2.0, 0.05))
        .check(format!("Suzuki's composition: order at t = {ORDER_TIME}"), composed, Bound::Near(4.0, 0.1))
}
