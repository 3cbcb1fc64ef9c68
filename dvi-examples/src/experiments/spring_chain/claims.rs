//! What the experiment claims.

use dvi_core::prelude::*;

use super::{
    BETAS, CENTRES, COMPARED, H, LONG, Measured, NAMES, OMEGA, ORDER_STEPS, ORDER_TIME, Series,
    expected_speed,
};
use crate::claim::{BEYOND, Bound, Claim, larger};
use crate::job::Job;

pub(super) fn claims(job: &Job<'_>, measured: &Measured) -> Vec<Claim> {
    vec![
        energy(job, measured),
        sum(job, measured),
        rk4(measured),
        speeds(job, measured),
        long(measured),
        stability(measured),
        order(measured),
    ]
}

fn energy(job: &Job<'_>, measured: &Measured) -> Claim {
    let text = format!(
        "hω = {}: the energy of Newmark's method does not drift; its error is the smaller, the nearer β is to 1/4",
        H * OMEGA
    );
    let largest = measured.newmark.each_ref().map(|series| series.energy.largest);
    let growth = measured.newmark.iter().map(|series| series.energy.growth()).fold(0.0, larger);
    let claim = NAMES.into_iter().zip(largest).zip([0.2, 0.13, 0.06, 1.5e-3]).fold(
        Claim::new(BEYOND, text),
        |claim, ((name, largest), bound)| {
            claim.check(format!("{name}: largest |ΔE|"), largest, Bound::AtMost(bound))
        },
    );
    claim
        .check("β = 0: largest |ΔE| / that with β = 1/4", largest[0] / largest[3], Bound::AtLeast(100.0))
        .check("largest |ΔE| over all / in the first hundredth", job.only_full(growth), Bound::AtMost(1.1))
}

fn sum(job: &Job<'_>, measured: &Measured) -> Claim {
    let text =
        "the sum I of the energies of the stiff springs, with the stiffness of the method, has no trend";
    let all = |value: fn(&Series) -> f64| measured.newmark.iter().map(value).fold(0.0, larger);
    Claim::new(BEYOND, text)
        .check("all β: largest |I − I(0)|, of 1", all(|series| series.sum.largest), Bound::AtMost(0.12))
        .check(
            "all β: difference of the means of I in the last and the first tenth of the run",
            job.only_full(all(|series| series.trend().abs())),
            Bound::AtMost(0.001),
        )
}

fn rk4(measured: &Measured) -> Claim {
    Claim::new(BEYOND, "RK4 with steps of the same length takes all energy from the stiff springs")
        .check("RK4: I/I(0) at t = 20", measured.rk4.left, Bound::AtMost(1e-3))
        .check("RK4: largest |ΔE|, of 2", measured.rk4.energy.largest, Bound::AtLeast(0.9))
}

fn speeds(job: &Job<'_>, measured: &Measured) -> Claim {
    let text = format!(
        "the stiff springs exchange their energies at 1/((1 + β(hω)²)√(1 + (β − ¼)(hω)²)) times the speed of the motion, \
         on average over {} starts",
        CENTRES.len()
    );
    let all = NAMES.into_iter().zip(BETAS).zip(measured.speeds);
    all.fold(Claim::new(BEYOND, text), |claim, ((name, beta), speed)| {
        let expected = (1e4 * expected_speed(beta, H)).round() / 1e4;
        claim.check(
            format!("{name}: speed of the exchange / that of the motion"),
            job.only_full(speed),
            Bound::Near(expected, 0.04),
        )
    })
}

fn long(measured: &Measured) -> Claim {
    let text = format!(
        "hω = {}: with β = 1/4 the energy does not drift, but there is next to no exchange: the step is stable and the motion another",
        LONG * OMEGA
    );
    let first = |exchange: &super::Exchange| exchange.points(0).last().map_or(f64::NAN, |point| point[1]);
    let motion = measured.motion.points(0).get(COMPARED as usize - 1).map_or(f64::NAN, |point| point[1]);
    Claim::new(BEYOND, text)
        .check("long step: largest |ΔE|", measured.long_energy, Bound::AtMost(0.02))
        .check(
            format!("motion: energy of the first stiff spring at t = {COMPARED}"),
            motion,
            Bound::AtMost(0.05),
        )
        .check(
            format!("long step: energy of the first stiff spring at t = {COMPARED}"),
            first(&measured.long),
            Bound::AtLeast(0.7),
        )
}

fn stability(measured: &Measured) -> Claim {
    let text = "the longest stable step is that of an oscillator: (¼ − β)(hω)² < 1";
    NAMES.into_iter().zip(measured.lost).fold(Claim::new(BEYOND, text), |claim, (name, [below, above])| {
        claim
            .check(
                format!("{name}: runs lost of one with 0.97 times that step"),
                f64::from(u8::from(below)),
                Bound::AtMost(0.0),
            )
            .check(
                format!("{name}: runs lost of one with 1.03 times that step"),
                f64::from(u8::from(above)),
                Bound::AtLeast(1.0),
            )
    })
}

fn order(measured: &Measured) -> Claim {
    let text = format!("the coordinates at t = {ORDER_TIME} are of second order for all β");
    NAMES.into_iter().zip(measured.errors).fold(Claim::new(BEYOND, text), |claim, (name, errors)| {
        let points: Vec<(f64, f64)> = ORDER_STEPS.into_iter().zip(errors).collect();
        claim.check(format!("{name}: order"), convergence_order(&points), Bound::Near(2.0, 0.05))
    })
}
