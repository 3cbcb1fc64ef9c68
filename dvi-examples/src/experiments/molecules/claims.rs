//! What the experiment claims.

use dvi_core::prelude::*;

use super::{H, H_SPRINGS, MOLECULES, Measured, ORDER_STEPS, ORDER_TIME, REVERSED, SOFT, STIFF};
use crate::claim::{BEYOND, Bound, Claim, larger};

/// What the energy error may be, over the energy.
pub(super) const BOUND: f64 = 0.01;

pub(super) fn claims(measured: &Measured) -> Vec<Claim> {
    vec![
        kept(measured),
        trend(measured),
        steps(measured),
        same(measured),
        order(measured),
        reversal(measured),
    ]
}

fn kept(measured: &Measured) -> Claim {
    let text =
        format!("{MOLECULES} rigid molecules by RATTLE, h = {H}: rods and momenta are kept to rounding");
    let rods = &measured.rods;
    let [along, across, angular] = &rods.momenta;
    Claim::new(BEYOND, text)
        .check("largest deviation of the length of a rod", rods.bonds.largest, Bound::AtMost(3e-13))
        .check("largest velocity along a rod", rods.along.largest, Bound::AtMost(1e-15))
        .check("largest change of the momentum", larger(along.largest, across.largest), Bound::AtMost(5e-13))
        .check("largest change of the angular momentum", angular.largest, Bound::AtMost(1e-10))
}

fn trend(measured: &Measured) -> Claim {
    let text = "the energy has no trend, with rods and with springs";
    [&measured.rods, &measured.springs].into_iter().fold(Claim::new(BEYOND, text), |claim, series| {
        let [first, last] = series.tenths();
        let name = series.name;
        claim
            .check(
                format!("{name}: mean ΔE in the last tenth of the run less that in the first, over max|ΔE|"),
                (last - first).abs() / series.energy.largest,
                Bound::AtMost(0.25),
            )
            .check(
                format!("{name}: max|ΔE| over all / in the first tenth"),
                series.energy.growth(),
                Bound::AtMost(1.5),
            )
    })
}

fn steps(measured: &Measured) -> Claim {
    let text = "with rods the longest step that keeps the energy to one hundredth is several times as long as with springs";
    let [rods, soft, stiff] = &measured.scans;
    let [h, by_soft, by_stiff] = [rods, soft, stiff].map(|scan| scan.longest(BOUND));
    let limit = |h: f64, k: f64| h * (3.0 * k).sqrt() / 2.0;
    Claim::new(BEYOND, text)
        .check("rods: longest step", h, Bound::Within(0.035, 0.07))
        .check(
            format!("k = {SOFT}: longest step with rods / with springs"),
            h / by_soft,
            Bound::AtLeast(3.0),
        )
        .check(
            format!("k = {STIFF}: longest step with rods / with springs"),
            h / by_stiff,
            Bound::AtLeast(9.0),
        )
        .check(
            format!("k = {SOFT}: longest step with springs / (2/ω)"),
            limit(by_soft, SOFT),
            Bound::Within(0.88, 1.01),
        )
        .check(
            format!("k = {STIFF}: longest step with springs / (2/ω)"),
            limit(by_stiff, STIFF),
            Bound::Within(0.88, 1.01),
        )
}

fn same(measured: &Measured) -> Claim {
    let text =
        "below that limit rods and springs have the same energy error: only stability shortens the steps";
    let [rods, soft, _] = &measured.scans;
    Claim::new(BEYOND, text).check(
        format!("h = {H_SPRINGS}: max|ΔE| with springs, k = {SOFT}, over that with rods"),
        soft.error(H_SPRINGS) / rods.error(H_SPRINGS),
        Bound::Near(1.0, 0.02),
    )
}

fn order(measured: &Measured) -> Claim {
    let points: Vec<(f64, f64)> = ORDER_STEPS.into_iter().zip(measured.errors).collect();
    Claim::new(BEYOND, "the positions by RATTLE are of second order, against RK4 on the accelerations")
        .check(
            "largest distance of the atoms of two references",
            measured.between_references,
            Bound::AtMost(2e-9),
        )
        .check(format!("order at t = {ORDER_TIME}"), convergence_order(&points), Bound::Near(2.0, 0.05))
}

fn reversal(measured: &Measured) -> Claim {
    Claim::new(BEYOND, format!("{REVERSED} steps of RATTLE are undone by as many steps of length −{H}"))
        .check(
            "largest difference of a coordinate or a velocity from the start",
            measured.there_and_back,
            Bound::AtMost(1e-12),
        )
}
