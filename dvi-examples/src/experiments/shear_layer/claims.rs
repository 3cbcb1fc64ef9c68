//! What the experiment claims.

use std::f64::consts::TAU;

use dvi_core::diagnostics::convergence_order;

use super::{Measured, TOLERANCE};
use crate::claim::{BEYOND, Bound, Claim};
use crate::job::Job;
use crate::models::ShearLayer;

pub(super) fn claims(job: &Job<'_>, measured: &Measured) -> Vec<Claim> {
    vec![waves(measured), kept(measured), forces(measured), cost(job, measured)]
}

/// The rate at which waves on a layer of blobs grow, by linear theory.
fn expected_rate() -> f64 {
    let [k, d, core] = [TAU, ShearLayer::THICKNESS, ShearLayer::CORE];
    let s = d.hypot(core);
    ((-2.0 * k * s).exp() - ((-k * core).exp() - k * (s - core)).powi(2)).sqrt() / (2.0 * d)
}

fn waves(measured: &Measured) -> Claim {
    Claim::new(BEYOND, "small waves on the layer grow as Rayleigh says").check(
        "rate from t = 1 to 2 / that of linear theory",
        measured.rate / expected_rate(),
        Bound::Near(1.0, 0.05),
    )
}

fn kept(measured: &Measured) -> Claim {
    Claim::new(BEYOND, "while the layer rolls up, energy and impulses are kept to the tolerance of the sum")
        .check("largest |ΔH|/H", measured.energy.largest, Bound::AtMost(TOLERANCE))
        .check(
            "largest change of ΣΓz / ΣΓ times the length",
            measured.impulse.largest,
            Bound::AtMost(TOLERANCE),
        )
        .check("largest relative change of ΣΓ|z|²", measured.angular.largest, Bound::AtMost(TOLERANCE))
}

fn forces(measured: &Measured) -> Claim {
    let text = "the forces on all blobs are those of the sum over all pairs, to the tolerance";
    Claim::new(BEYOND, text)
        .check("relative error at the start", measured.errors[0], Bound::AtMost(TOLERANCE))
        .check("relative error at the end", measured.errors[1], Bound::AtMost(TOLERANCE))
}

fn cost(job: &Job<'_>, measured: &Measured) -> Claim {
    let (mut counts, mut savings) = (vec![], vec![]);
    for &(blobs, pairs, products) in &measured.operations {
        counts.push((blobs as f64, (pairs + products) as f64));
        savings.push((blobs * (blobs - 1)) as f64 / (pairs + products) as f64);
    }
    let power = counts.get(1..).and_then(convergence_order);
    Claim::new(BEYOND, "from 25 000 to 400 000 blobs, what an evaluation takes grows like their number")
        .check("power of the number of blobs", job.only_full(power).flatten(), Bound::Near(1.0, 0.1))
        .check(
            "100 000 blobs: ordered pairs of all / pairs and products of an evaluation",
            job.only_full(savings.get(2).copied()).flatten(),
            Bound::AtLeast(30.0),
        )
        .check("evaluations in a step", job.only_full(measured.evaluations), Bound::AtMost(25.0))
}
