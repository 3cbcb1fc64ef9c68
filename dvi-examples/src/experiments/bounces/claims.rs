//! What the experiment claims.

use super::{EARLY, Measured, ORDER_TIME, Series};
use crate::claim::{BEYOND, Bound, Claim};
use crate::job::Job;

pub(super) fn claims(job: &Job<'_>, measured: &Measured) -> Vec<Claim> {
    vec![flat(job, measured), walk(job, measured), rk4(job, measured), order(measured), back(measured)]
}

fn flat(job: &Job<'_>, measured: &Measured) -> Claim {
    let text = format!(
        "with the energy kept at each impact, the energy error of a particle on a curved floor is less than three times as large over 10⁵ bounces as \
         up to t = {EARLY}, and less than a third with half the step"
    );
    let [coarse, fine] = &measured.reflecting;
    let claim = Claim::new(BEYOND, text)
        .check("bounces", job.only_full(coarse.bounces as f64), Bound::AtLeast(1e5))
        .check("h = 0.02: max|ΔE|", job.only_full(coarse.energy.largest), Bound::AtMost(1.2e-3))
        .check("h = 0.01: max|ΔE|", job.only_full(fine.energy.largest), Bound::AtMost(2e-4));
    let growth = |claim: Claim, series: &Series| {
        let quantity = format!("h = {}: max|ΔE| over all / up to t = {EARLY}", series.h);
        claim.check(quantity, job.only_full(series.energy.growth()), Bound::AtMost(3.0))
    };
    growth(growth(claim, coarse), fine).check(
        "max|ΔE|, h = 0.02 over h = 0.01",
        coarse.energy.largest / fine.energy.largest,
        Bound::AtLeast(3.0),
    )
}

fn walk(job: &Job<'_>, measured: &Measured) -> Claim {
    let text = "with the discrete energy kept at each impact the energy walks at random: its change grows with the square root of the number of \
                bounces, and has a quarter of the size with half the step";
    let [coarse, fine] = &measured.variational;
    let [variational, half, reflecting] = &measured.walks;
    Claim::new(BEYOND, text)
        .check(
            "exponent of the root mean square of ΔE",
            job.only_full(variational.exponent()).flatten(),
            Bound::Near(0.5, 0.1),
        )
        .check(
            "the same where the energy is kept",
            job.only_full(reflecting.exponent()).flatten(),
            Bound::AtMost(0.2),
        )
        .check(
            "root mean square after 2048 bounces, over that where the energy is kept",
            job.only_full(variational.last() / reflecting.last()),
            Bound::AtLeast(20.0),
        )
        .check(
            "root mean square after 2048 bounces, over that with half the step",
            job.only_full(variational.last() / half.last()),
            Bound::Near(4.0, 1.2),
        )
        .check(
            "discrete energy, h = 0.02: max|ΔE|",
            job.only_full(coarse.energy.largest),
            Bound::AtMost(0.05),
        )
        .check(
            "discrete energy, h = 0.01: max|ΔE|",
            job.only_full(fine.energy.largest),
            Bound::AtMost(0.0125),
        )
        .check(
            "bounces that graze so that no impulse keeps the discrete energy, of both runs",
            job.only_full((coarse.grazing + fine.grazing) as f64),
            Bound::AtMost(20.0),
        )
}

fn rk4(job: &Job<'_>, measured: &Measured) -> Claim {
    let text = "RK4 with impacts that keep the energy, and as many forces as with h = 0.02, loses energy all the time";
    Claim::new(BEYOND, text)
        .check("RK4: max|ΔE|", job.only_full(measured.rk4.energy.largest), Bound::AtLeast(0.01))
        .check(
            format!("RK4: max|ΔE| over all / up to t = {EARLY}"),
            job.only_full(measured.rk4.energy.growth()),
            Bound::AtLeast(100.0),
        )
}

fn order(measured: &Measured) -> Claim {
    let text = format!(
        "the state at t = {ORDER_TIME}, after several bounces, is of the order of the method between impacts"
    );
    let [variational, reflecting, galerkin] = measured.orders;
    Claim::new(BEYOND, text)
        .check("discrete energy, trapezoid", variational, Bound::Near(2.0, 0.25))
        .check("energy at the impact, trapezoid", reflecting, Bound::Near(2.0, 0.15))
        .check("energy at the impact, Galerkin with 3 nodes", galerkin, Bound::Near(4.0, 0.25))
}

fn back(measured: &Measured) -> Claim {
    let [variational, reflecting] = measured.there_and_back;
    Claim::new(BEYOND, "the way back is the way there, bounces among it")
        .check("discrete energy: largest difference from the start", variational, Bound::AtMost(1e-11))
        .check("energy at the impact: the same", reflecting, Bound::AtMost(1e-11))
}
