//! What the experiment claims.

use dvi_core::prelude::*;

use super::growth::STARTS;
use super::sleigh::{STEPS, STRAIGHT};
use super::{H, HALVED, Measured, ORDER_STEPS, ORDER_TIME, REVERSED};
use crate::claim::{BEYOND, Bound, Claim};
use crate::job::Job;

/// The end of the beginning of the long runs.
const EARLY: f64 = 100.0;

pub(super) fn claims(job: &Job<'_>, measured: &Measured) -> Vec<Claim> {
    vec![
        free(job, measured),
        order(measured),
        reversal(measured),
        springs(job, measured),
        magnet(job, measured),
        straight(measured),
    ]
}

fn free(job: &Job<'_>, measured: &Measured) -> Claim {
    let text = format!(
        "without a potential, h = {H}: energy and momenta are kept to rounding, which grows with the angle θ"
    );
    let free = &measured.free;
    let [rolling, turning] = &free.momenta;
    Claim::new(BEYOND, text)
        .check("θ at the end", job.only_full(free.rolled), Bound::AtLeast(1e4))
        .check("largest |E/E(0) − 1|", free.energy.largest, Bound::AtMost(5e-11))
        .check("largest relative change of the momentum of rolling", rolling.largest, Bound::AtMost(3e-11))
        .check("largest relative change of the momentum of turning", turning.largest, Bound::AtMost(1e-13))
        .check("largest velocity against the constraints", free.across, Bound::AtMost(1e-15))
}

fn order(measured: &Measured) -> Claim {
    let order = |errors: [f64; 4], steps: [f64; 4]| {
        convergence_order(&steps.into_iter().zip(errors).collect::<Vec<_>>())
    };
    let [circle, magnet, composed] = measured.errors.map(|errors| order(errors, ORDER_STEPS));
    let text = "places are of second order: against the circle of a free disc, and against RK4 on equations without constraints";
    Claim::new(BEYOND, text)
        .check("distance of two references with a magnet", measured.between_references, Bound::AtMost(1e-9))
        .check(format!("free disc: order at t = {ORDER_TIME}"), circle, Bound::Near(2.0, 0.01))
        .check(format!("disc with a magnet: order at t = {ORDER_TIME}"), magnet, Bound::Near(2.0, 0.05))
        .check("the same by Suzuki's composition: order", composed, Bound::Near(4.0, 0.1))
        .check(
            "sleigh: order when it has turned",
            order(measured.sleigh.errors, STEPS),
            Bound::Near(2.0, 0.05),
        )
}

fn reversal(measured: &Measured) -> Claim {
    Claim::new(BEYOND, format!("steps are undone by as many steps of length −{H}"))
        .check(
            format!("disc with a magnet, {REVERSED} steps: largest difference from the start"),
            measured.there_and_back,
            Bound::AtMost(1e-12),
        )
        .check(
            "sleigh: largest difference from the start",
            measured.sleigh.there_and_back,
            Bound::AtMost(1e-12),
        )
}

fn springs(job: &Job<'_>, measured: &Measured) -> Claim {
    let text = format!(
        "on equal springs the energy error of constrained steps, on average over {STARTS} starts, does not grow, that of RK4 does"
    );
    let (constrained, rk4, end) = (&measured.springs, &measured.springs_rk4, measured.end);
    Claim::new(BEYOND, text)
        .check("constrained: largest |ΔE|", constrained.up_to(end), Bound::AtMost(1.2e-3))
        .check(
            format!("constrained: largest |ΔE| over all / up to t = {EARLY}"),
            constrained.up_to(end) / constrained.up_to(EARLY),
            Bound::AtMost(1.02),
        )
        .check("RK4: largest |ΔE|", job.only_full(rk4.up_to(end)), Bound::AtLeast(1.2e-3))
        .check(
            format!("RK4: largest |ΔE| over all / up to t = {EARLY}"),
            job.only_full(rk4.up_to(end) / rk4.up_to(EARLY)),
            Bound::AtLeast(100.0),
        )
}

fn magnet(job: &Job<'_>, measured: &Measured) -> Claim {
    let text = "with a magnet that energy wanders away, by an amount of the order h², and RK4 with steps of the same length keeps it better";
    let (whole, half, end) = (&measured.magnet, &measured.magnet_half, measured.end);
    Claim::new(BEYOND, text)
        .check("magnet: largest |ΔE|", job.only_full(whole.up_to(end)), Bound::AtLeast(0.1))
        .check(
            "magnet: largest |ΔE| / on springs",
            job.only_full(whole.up_to(end) / measured.springs.up_to(end)),
            Bound::AtLeast(100.0),
        )
        .check(
            format!("magnet: largest |ΔE| over all / up to t = {EARLY}"),
            job.only_full(whole.up_to(end) / whole.up_to(EARLY)),
            Bound::AtLeast(10.0),
        )
        .check(
            format!("magnet: power of t by which it grows, from t = {EARLY}"),
            whole.exponent(EARLY).and_then(|exponent| job.only_full(exponent)),
            Bound::Within(0.4, 0.7),
        )
        .check(
            format!("magnet: largest |ΔE| up to t = {HALVED} with half the step / with the whole"),
            job.only_full(half.up_to(HALVED) / whole.up_to(HALVED)),
            Bound::Within(0.15, 0.35),
        )
        .check(
            "magnet: largest |ΔE| / that of RK4",
            job.only_full(whole.up_to(end) / measured.magnet_rk4.up_to(end)),
            Bound::AtLeast(5.0),
        )
}

fn straight(measured: &Measured) -> Claim {
    let sleigh = &measured.sleigh;
    let h = STEPS[0];
    let text = format!(
        "the sleigh ends straight ahead, h = {h}: its energy changes while it turns, by a term of the order h², and then no more"
    );
    let points: Vec<(f64, f64)> = STEPS.into_iter().zip(sleigh.energies.map(f64::abs)).collect();
    let last = sleigh.turning.last().map_or(f64::NAN, |point| point[1]);
    let expected = sleigh.turning_of_motion.last().map_or(f64::NAN, |point| point[1]);
    Claim::new(BEYOND, text)
        .check("rate at which ω decays / av/(I + a²)", sleigh.decay, Bound::Near(1.0, 0.002))
        .check("|ω| at t = 12 / that of the motion", last / expected, Bound::Near(1.0, 0.02))
        .check(format!("|E/E(0) − 1| at t = {STRAIGHT}"), sleigh.energies[0].abs(), Bound::AtMost(5e-3))
        .check("order of that", convergence_order(&points), Bound::Near(2.0, 0.05))
        .check("largest relative change of E when it has turned", sleigh.late, Bound::AtMost(1e-13))
}
