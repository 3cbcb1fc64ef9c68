//! What the experiment claims.

use dvi_core::prelude::*;

use super::{
    COARSE_BEAMS, COARSE_RODS, COUNTED, ELEMENTS, H, MANY_PERIODS, MANY_SEGMENTS, Measured, SEGMENTS, SHORT,
    period,
};
use crate::claim::{BEYOND, Bound, Claim, larger};
use crate::job::Job;

pub(super) fn claims(job: &Job<'_>, measured: &Measured) -> Vec<Claim> {
    vec![
        elements(measured),
        segments(measured),
        energy(measured),
        large(job, measured),
        lost(job, measured),
        work(measured),
    ]
}

/// The order in 1/n of errors that belong to these n.
fn order(sizes: [usize; 4], errors: [f64; 4]) -> Option<f64> {
    let points: Vec<(f64, f64)> =
        sizes.into_iter().zip(errors).map(|(n, error)| (1.0 / n as f64, error.abs())).collect();
    convergence_order(&points)
}

fn elements(measured: &Measured) -> Claim {
    let text = "the frequencies of the first three modes of finite elements are those of Euler and Bernoulli, with an error of fourth order";
    let claim = (0..super::MODES).fold(Claim::new(BEYOND, text), |claim, k| {
        let errors = measured.of_beams.map(|errors| errors[k]);
        claim.check(
            format!("mode {}: order in 1/n, n from {} to {}", k + 1, COARSE_BEAMS[0], COARSE_BEAMS[3]),
            order(COARSE_BEAMS, errors),
            Bound::Near(4.0, 0.05),
        )
    });
    claim
        .check(
            "16 elements: largest relative error of a frequency",
            measured.of_beams[1].map(f64::abs).into_iter().fold(0.0, larger),
            Bound::AtMost(1e-4),
        )
        .check(
            format!("{ELEMENTS} elements: largest relative error of a frequency"),
            measured.of_beam.map(f64::abs).into_iter().fold(0.0, larger),
            Bound::AtMost(1e-8),
        )
}

fn segments(measured: &Measured) -> Claim {
    let text = "the elastic rod has these frequencies at small deflections, and the energy of the curve, with errors of second order";
    let claim = (0..super::MODES).fold(Claim::new(BEYOND, text), |claim, k| {
        let errors = measured.of_rods.map(|errors| errors[k]);
        claim.check(
            format!("rod, mode {}: order in 1/n, n from {} to {}", k + 1, COARSE_RODS[0], COARSE_RODS[3]),
            order(COARSE_RODS, errors),
            Bound::Near(2.0, 0.1),
        )
    });
    claim
        .check(
            format!("{SEGMENTS} segments: largest relative error of a frequency"),
            measured.of_rods[3].map(f64::abs).into_iter().fold(0.0, larger),
            Bound::AtMost(1.2e-3),
        )
        .check(
            "energy of bending: order in 1/n",
            order(COARSE_RODS, measured.bending),
            Bound::Near(2.0, 0.05),
        )
}

fn energy(measured: &Measured) -> Claim {
    let text = format!(
        "{ELEMENTS} elements, 100 steps in a period of the first mode: Newmark's method with β = 1/4 keeps the energy to the accuracy with which steps are solved"
    );
    Claim::new(BEYOND, text)
        .check("beam: largest |E/E(0) − 1|", measured.beam.energy.largest, Bound::AtMost(1e-9))
        .check(
            "runs lost of one by Störmer–Verlet with a step that is 1000 times shorter",
            f64::from(u8::from(measured.verlet_is_lost)),
            Bound::AtLeast(1.0),
        )
}

fn large(job: &Job<'_>, measured: &Measured) -> Claim {
    let text = format!("large deflections of {SEGMENTS} segments, h = {H}: the energy error does not grow");
    let rod = &measured.rod;
    Claim::new(BEYOND, text)
        .check(
            "rod: time until the run is lost, in periods of the first mode",
            job.only_full(rod.lost.map_or(measured.periods[1], |t| t / period())),
            Bound::AtLeast(measured.periods[1]),
        )
        .check("rod: largest |E/E(0) − 1|", rod.energy.largest, Bound::AtMost(2e-4))
        .check(
            "rod: largest |E/E(0) − 1| over all / in two periods",
            job.only_full(rod.energy.growth()),
            Bound::AtMost(1.3),
        )
}

fn lost(job: &Job<'_>, measured: &Measured) -> Claim {
    let text = format!("with {MANY_SEGMENTS} segments the same step is lost, a shorter one is not");
    let until = |series: &super::Series| job.only_full(series.lost.map_or(MANY_PERIODS, |t| t / period()));
    Claim::new(BEYOND, text)
        .check(
            format!("{MANY_SEGMENTS} segments, h = {H}: periods until the run is lost"),
            until(&measured.many),
            Bound::Within(2.0, 14.0),
        )
        .check(
            format!("{MANY_SEGMENTS} segments, h = {SHORT}: periods until the run is lost, or its end"),
            until(&measured.many_short),
            Bound::AtLeast(MANY_PERIODS),
        )
        .check(
            format!("{MANY_SEGMENTS} segments, h = {SHORT}: largest |E/E(0) − 1|"),
            measured.many_short.energy.largest,
            Bound::AtMost(4e-5),
        )
}

fn work(measured: &Measured) -> Claim {
    let text = "the number of iterations of a step hardly depends on that of the nodes";
    ["beam", "rod"].into_iter().zip([[1.9, 2.1], [2.8, 4.0]]).zip(measured.iterations).fold(
        Claim::new(BEYOND, text),
        |claim, ((name, [low, high]), all)| {
            COUNTED.into_iter().zip(all).fold(claim, |claim, (n, iterations)| {
                let quantity = format!("{name}, {n} nodes: iterations of a step");
                claim.check(quantity, iterations, Bound::Within(low, high))
            })
        },
    )
}
