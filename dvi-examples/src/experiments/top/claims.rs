//! What the experiment claims.

use dvi_core::prelude::*;

use super::{H, LEANING, Measured, ORDER_STEPS, ORDER_TIME, RATES};
use crate::claim::{BEYOND, Bound, Claim};
use crate::experiments::rounding::{few_units, random_walk};
use crate::experiments::shadow::{self, Shadow};
use crate::experiments::turnings;
use crate::job::Job;

pub(super) fn claims(job: &Job<'_>, measured: &Measured) -> Vec<Claim> {
    let shadows: Vec<Shadow> = measured.nutation.iter().map(|nutation| nutation.energy).collect();
    vec![
        turnings::claim(
            "the axis of a heavy top",
            measured.nutation.each_ref().map(|nutation| &nutation.extremes),
        ),
        rounding(job, measured),
        energy(job, measured),
        shadow::claim("top", &shadows),
        rk4(job, measured),
        order(measured),
    ]
}

fn rounding(job: &Job<'_>, measured: &Measured) -> Claim {
    let text = "the matrices of a heavy top are orthogonal to a few units of rounding for the whole run; its momenta are kept up to errors no \
                larger than a unit of rounding times the square root of the number of steps";
    let (series, bound) = (&measured.geodesic, random_walk(measured.steps));
    Claim::new(BEYOND, text)
        .check("steps", job.only_full(measured.steps as f64), Bound::AtLeast(1e7))
        .check("largest relative change of the spin", series.spin.largest, bound)
        .check("largest relative change of the momentum about the vertical", series.vertical.largest, bound)
        .check("geodesics: max|RᵀR − 1|", series.defect.largest, few_units())
}

fn energy(job: &Job<'_>, measured: &Measured) -> Claim {
    let energy = &measured.geodesic.energy;
    // The largest that h²g makes of it, by the run with the same step.
    let predicted = measured.nutation[1].energy.predicted;
    Claim::new(
        BEYOND,
        "the energy error of a heavy top has no trend, and is that of the closed form all the time",
    )
    .check("geodesics: max|ΔE|", energy.largest, Bound::AtMost(1.02 * predicted))
    .check(
        "geodesics: max|ΔE|, last tenth of the time over the first",
        job.only_full(energy.trend()),
        Bound::Near(1.0, 0.01),
    )
}

fn rk4(job: &Job<'_>, measured: &Measured) -> Claim {
    let text = format!(
        "RK4 on the entries of the matrix, h = {H}, shrinks it at right angles to ω: each step takes some (h|ω|)⁶/72 of the squares, and \
         the energy drifts in proportion to the time"
    );
    let series = &measured.rk4;
    // ω at the start; the precession makes the entries of the matrix a little slower or faster than that.
    let [dot_theta, dot_phi, spinning] = RATES;
    let square = dot_theta.powi(2) + (dot_phi * LEANING.sin()).powi(2) + spinning.powi(2);
    let shrunk = 1.0 - (-(measured.steps as f64) * H.powi(6) * square.powi(3) / 72.0).exp();
    Claim::new(BEYOND, text)
        .check("RK4: max|RᵀR − 1|", series.defect.largest, Bound::Near(shrunk, 0.2 * shrunk))
        .check(
            "RK4: max|ΔE|",
            job.only_full(series.energy.largest),
            Bound::AtLeast(100.0 * measured.geodesic.energy.largest),
        )
        .check(
            "RK4: max|ΔE|, last tenth of the time over the first",
            job.only_full(series.energy.trend()),
            Bound::Near(10.0, 1.0),
        )
}

fn order(measured: &Measured) -> Claim {
    let text = "R and ω of a heavy top are of second order, and of fourth by Suzuki's composition, against RK4 with short steps";
    let orders = measured
        .errors
        .map(|errors| convergence_order(&ORDER_STEPS.into_iter().zip(errors).collect::<Vec<_>>()));
    let [simple, composed] = orders;
    Claim::new(BEYOND, text)
        .check("largest difference of two references", measured.between_references, Bound::AtMost(1e-9))
        .check(format!("geodesics: order at t = {ORDER_TIME}"), simple, Bound::Near(2.0, 0.05))
        .check(format!("Suzuki's composition: order at t = {ORDER_TIME}"), composed, Bound::Near(4.0, 0.1))
}
