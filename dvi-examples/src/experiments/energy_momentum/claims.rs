//! What the experiment claims.

use dvi_core::prelude::*;

use super::ending::REACH;
use super::{Measured, Runs, Series};
use crate::claim::{BEYOND, Bound, Claim, larger};

pub(super) fn claims(measured: &Measured) -> Vec<Claim> {
    vec![
        discrete_energy(measured),
        momentum(measured),
        energy(measured),
        lengths(measured),
        accuracy(measured),
        ending(measured),
    ]
}

/// The runs on the spring, and those on the orbit.
fn systems(measured: &Measured) -> [(&'static str, &[Runs; 4]); 2] {
    [("spring", &measured.spring), ("Kepler", &measured.kepler)]
}

/// The largest over the four lengths of the first step.
fn largest(runs: &[Runs; 4], value: impl Fn(&Runs) -> f64) -> f64 {
    runs.iter().map(value).fold(0.0, larger)
}

/// The order in the mean length of the steps.
fn order(runs: &[Runs; 4], of: fn(&Runs) -> &Series, value: fn(&Series) -> f64) -> Option<f64> {
    let points = runs.iter().map(of).map(|series| (series.mean_length(), value(series)));
    convergence_order(&points.collect::<Vec<_>>())
}

fn discrete_energy(measured: &Measured) -> Claim {
    let text = "the steps keep the discrete energy to rounding, and steps of one length up to terms of the second order";
    let bounds = [(1.5e-14, 3.141e-3, 5e-6), (5e-14, 1.053e-2, 2e-5)];
    let claim = Claim::new(BEYOND, text);
    systems(measured).into_iter().zip(bounds).fold(claim, |claim, ((name, runs), (kept, varies, near))| {
        claim
            .check(
                format!("{name}: largest |E_d − e| of all runs"),
                largest(runs, |runs| runs.kept.discrete.largest),
                Bound::AtMost(kept),
            )
            .check(
                format!("{name}: the same over all steps / over the first tenth"),
                largest(runs, |runs| runs.kept.discrete.growth()),
                Bound::AtMost(2.0),
            )
            .check(
                format!("{name}, steps of one length: largest difference of two E_d"),
                runs[0].mean.discrete_range.width(),
                Bound::Near(varies, near),
            )
            .check(
                format!("{name}, steps of one length: order of that in h"),
                order(runs, |runs| &runs.mean, |series| series.discrete_range.width()),
                Bound::Near(2.0, 0.02),
            )
    })
}

fn momentum(measured: &Measured) -> Claim {
    let claim = Claim::new(BEYOND, "both keep the angular momentum to rounding");
    systems(measured).into_iter().fold(claim, |claim, (name, runs)| {
        claim
            .check(
                format!("{name}: largest |l − l(0)| of all runs"),
                largest(runs, |runs| runs.kept.momentum),
                Bound::AtMost(2e-13),
            )
            .check(
                format!("{name}, steps of one length: the same"),
                largest(runs, |runs| runs.mean.momentum),
                Bound::AtMost(2e-13),
            )
    })
}

fn energy(measured: &Measured) -> Claim {
    let text = "the energy at the points of the run varies by terms of the second order, on the spring a little more than with steps of one length, on the orbit a third as much";
    let width = |series: &Series| series.energy.width();
    let ratio = |runs: &[Runs; 4]| width(&runs[0].kept) / width(&runs[0].mean);
    let bounds = [Bound::Within(1.04, 1.07), Bound::Within(0.3, 0.32)];
    let claim = Claim::new(BEYOND, text);
    systems(measured).into_iter().zip(bounds).fold(claim, |claim, ((name, runs), bound)| {
        claim
            .check(
                format!("{name}: order of the largest difference of two E in h"),
                order(runs, |runs| &runs.kept, width),
                Bound::Near(2.0, 0.02),
            )
            .check(
                format!("{name}, steps of one length: the same"),
                order(runs, |runs| &runs.mean, width),
                Bound::Near(2.0, 0.02),
            )
            .check(
                format!("{name}: largest difference of two E / that with steps of one length"),
                ratio(runs),
                bound,
            )
    })
}

fn lengths(measured: &Measured) -> Claim {
    let text = "the lengths of the steps stay within limits and do not drift";
    let firsts = [super::ON_SPRING[0], super::ON_ORBIT[0]];
    let bounds = [(1.34, 5e-4), (5.09, 2e-3)];
    let claim = Claim::new(BEYOND, text);
    let all = systems(measured).into_iter().zip(firsts).zip(bounds);
    all.fold(claim, |claim, (((name, runs), first), (most, drift))| {
        let series = &runs[0].kept;
        claim
            .check(
                format!("{name}: smallest length / that of the first step"),
                series.lengths.low / first,
                Bound::Within(0.999, 1.0),
            )
            .check(
                format!("{name}: largest length / that of the first step"),
                series.lengths.high / first,
                Bound::Near(most, 0.01),
            )
            .check(
                format!("{name}: mean length of the last tenth of the steps / of the first − 1"),
                series.drift() - 1.0,
                Bound::Near(0.0, drift),
            )
    })
}

fn accuracy(measured: &Measured) -> Claim {
    let text = "up to t = 50 the run is closer to the motion than one with as many steps of one length, and farther than one of the same work";
    let closer = [Bound::Within(0.94, 0.96), Bound::Within(0.3, 0.5)];
    let farther = [Bound::AtLeast(20.0), Bound::AtLeast(5.0)];
    let claim = Claim::new(BEYOND, text).check(
        "spring: largest distance of the reference from one with steps twice as long",
        measured.between_references,
        Bound::AtMost(1e-12),
    );
    systems(measured).into_iter().zip(closer).zip(farther).fold(
        claim,
        |claim, (((name, runs), closer), farther)| {
            let claim = compare(claim, name, runs, closer);
            costs(claim, name, runs, farther)
        },
    )
}

fn compare(claim: Claim, name: &str, runs: &[Runs; 4], closer: Bound) -> Claim {
    claim
        .check(
            format!("{name}: order of the largest distance in h"),
            order(runs, |runs| &runs.kept, |series| series.distance),
            Bound::Near(2.0, 0.03),
        )
        .check(
            format!("{name}: largest distance / that with as many steps of one length"),
            runs[0].kept.distance / runs[0].mean.distance,
            closer,
        )
}

fn costs(claim: Claim, name: &str, runs: &[Runs; 4], farther: Bound) -> Claim {
    let [Runs { kept, mean, work }, ..] = runs;
    let ratio = |runs: &Runs| runs.kept.distance / runs.work.distance;
    let rate = |series: &Series| series.work_of_a_step() / series.mean_length();
    claim
        .check(
            format!("{name}: evaluations of derivatives in a step / in one of steps of one length"),
            kept.work_of_a_step() / mean.work_of_a_step(),
            Bound::AtLeast(4.0),
        )
        .check(
            format!("{name}: evaluations in a time, the run of the same work / this one"),
            rate(work) / rate(kept),
            Bound::AtMost(1.0),
        )
        .check(format!("{name}: largest distance / that with the same work"), ratio(&runs[0]), farther)
        .check(
            format!("{name}: the same with the shortest first step"),
            ratio(&runs[runs.len() - 1]),
            farther,
        )
}

fn ending(measured: &Measured) -> Claim {
    let ending = &measured.ending;
    let text = "with the trapezoidal rule on the spring the scheme ends, because no length within reach of the last has the discrete energy e";
    Claim::new(BEYOND, text)
        .check("steps that it takes", ending.steps as f64, Bound::Near(3.0, 0.0))
        .check(
            "|E_d − e| of the last of them, by hand",
            ending.last.defect(ending.length).abs(),
            Bound::AtMost(5e-14),
        )
        .check(
            format!("smallest E_d − e of lengths up to {REACH} times the last, by hand"),
            ending.failed.smallest(),
            Bound::Near(2.758e-3, 1e-6),
        )
        .check(
            "that of the best length that the control has found, less that by hand",
            ending.defect - ending.failed.defect(ending.best),
            Bound::Near(0.0, 1e-13),
        )
}
