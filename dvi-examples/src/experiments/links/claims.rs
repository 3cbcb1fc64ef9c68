//! What the experiment claims.

use dvi_core::prelude::*;

use super::{ANGLE, COUNTED, COUNTED_LINKS, EARLY, H, LINKS, Measured, ORDER_STEPS, Series};
use crate::claim::{BEYOND, Bound, Claim, larger};
use crate::job::Job;

const METHODS: [&str; 3] = ["trapezoid", "midpoint", "RATTLE"];

pub(super) fn claims(job: &Job<'_>, measured: &Measured) -> Vec<Claim> {
    vec![
        constraints(job, measured),
        energy(job, measured),
        one_method(measured),
        order(measured),
        work(job, measured),
    ]
}

impl Measured {
    /// Those by constrained steps.
    fn constrained(&self) -> [&Series; 3] {
        [&self.trapezoid, &self.midpoint, &self.rattle]
    }
}

fn of_all(series: [&Series; 3], value: impl Fn(&Series) -> f64) -> f64 {
    series.into_iter().map(value).fold(0.0, larger)
}

fn constraints(job: &Job<'_>, measured: &Measured) -> Claim {
    let text = format!(
        "{LINKS} links, released at rest with angles up to {ANGLE}, h = {H}: constrained steps keep each rod and the velocities \
         along it to rounding, RK4 does not"
    );
    let (all, rk4) = (measured.constrained(), &measured.rk4);
    Claim::new(BEYOND, text)
        .check(
            "constrained: largest relative deviation of the length of a rod",
            of_all(all, |series| series.length.largest),
            Bound::AtMost(2e-14),
        )
        .check(
            "constrained: largest velocity along a rod",
            of_all(all, |series| series.along.largest),
            Bound::AtMost(1e-15),
        )
        .check(
            "RK4: largest relative deviation of the length of a rod",
            job.only_full(rk4.length.largest),
            Bound::AtLeast(0.05),
        )
        .check(
            "RK4: the same, over that up to t = 5",
            job.only_full(rk4.length.growth()),
            Bound::AtLeast(100.0),
        )
        .check("RK4: largest velocity along a rod", rk4.along.largest, Bound::AtLeast(5e-7))
}

fn energy(job: &Job<'_>, measured: &Measured) -> Claim {
    let text = "the energy error of constrained steps is as large in the beginning as in all of the run, that of RK4 grows";
    let all = measured.constrained();
    Claim::new(BEYOND, text)
        .check("constrained: max|ΔE|", of_all(all, |series| series.energy.largest), Bound::AtMost(1.5e-6))
        .check(
            format!("constrained: max|ΔE| over all / up to t = {EARLY}"),
            of_all(all, |series| series.energy.growth()),
            Bound::AtMost(1.05),
        )
        .check("RK4: max|ΔE|", job.only_full(measured.rk4.energy.largest), Bound::AtLeast(5e-5))
        .check(
            format!("RK4: max|ΔE| over all / up to t = {EARLY}"),
            job.only_full(measured.rk4.energy.growth()),
            Bound::AtLeast(100.0),
        )
}

fn one_method(measured: &Measured) -> Claim {
    let text = "the potential is linear, and so the constrained trapezoid, the constrained midpoint rule and RATTLE take the same steps";
    Claim::new(BEYOND, text)
        .check(
            "trapezoid and midpoint: largest distance of the free ends",
            measured.trapezoid.apart(&measured.midpoint),
            Bound::AtMost(2e-12),
        )
        .check(
            "trapezoid and RATTLE: largest distance of the free ends",
            measured.trapezoid.apart(&measured.rattle),
            Bound::AtMost(2e-12),
        )
}

fn order(measured: &Measured) -> Claim {
    let text = "the positions are of second order, against RK4 with half the shortest step";
    let claim = Claim::new(BEYOND, text).check(
        "largest distance of the masses of two references",
        measured.between_references,
        Bound::AtMost(3e-8),
    );
    METHODS.into_iter().zip(&measured.errors).fold(claim, |claim, (name, errors)| {
        let points: Vec<(f64, f64)> = ORDER_STEPS.into_iter().zip(*errors).collect();
        claim.check(format!("{name}: order at t = 2"), convergence_order(&points), Bound::Near(2.0, 0.05))
    })
}

fn work(job: &Job<'_>, measured: &Measured) -> Claim {
    let text = format!(
        "in a step of length {COUNTED} Newton's method takes three iterations with 25, 50 and 100 links, and RATTLE at most one \
         more with 100 than with 25"
    );
    let of = |method: usize| measured.iterations.map(|all| all[method]);
    let claim =
        METHODS.into_iter().take(2).enumerate().fold(Claim::new(BEYOND, text), |claim, (method, name)| {
            of(method).into_iter().zip(COUNTED_LINKS).fold(claim, |claim, (iterations, links)| {
                claim.check(
                    format!("{name}: iterations of a step with {links} links"),
                    job.only_full(iterations),
                    Bound::Near(3.0, 0.15),
                )
            })
        });
    let [few, _, many] = of(2);
    claim
        .check("RATTLE: iterations of a step with 100 links", job.only_full(many), Bound::AtMost(4.0))
        .check("RATTLE: the same less those with 25", job.only_full(many - few), Bound::AtMost(1.1))
}
