//! The forced discrete Noether theorem: what a step takes of an angular momentum.

use super::decay::{Case, Runs};
use crate::vocabulary::*;

/// D₁L_d and D₂L_d are parallel to the points but for Δ/h and the forces ∓½γΔ, and so l0 = (1/h + c + ½γ)
/// q0×q1 and l1 = (1/h + c − ½γ) q0×q1. The rule of the trapezoid has c = 0, that of the midpoint ¼h V'(r)/r
/// at the middle of the step.
pub fn noether(job: &Job<'_>, case: Case, steps: &[Runs; 4]) -> Result<Claim> {
    let slope =
        |q0: [f64; 2], q1: [f64; 2]| case.system().slope(&[0, 1].map(|i: usize| 0.5 * (q0[i] + q1[i])));
    let trapezoid = defects(job, Variational::trapezoid(), case, |_, _| 0.0)?;
    let midpoint = defects(job, Variational::midpoint(), case, |q0, q1| 0.25 * case.h * slope(q0, q1))?;
    let order = |method: usize| {
        order(steps[1..].iter().map(|runs| (runs[method].case.h, runs[method].momentum.last.abs())))
    };
    let [by_midpoint, by_trapezoid, ..] = steps[0].each_ref().map(|run| run.momentum.largest);
    let text =
        "each step, h = 0.2, takes of the angular momentum what the forced discrete Noether theorem says";
    Ok(beyond(text)
        .at_most("trapezoid: relative defect of l1 = l0 (1 − γh/2)/(1 + γh/2)", trapezoid[0], 1e-12)
        .at_most("trapezoid: the same of the product over all steps", trapezoid[1], 5e-12)
        .at_most("midpoint: relative defect with 1/h + h V'(r)/(4r) in place of 1/h", midpoint[0], 1e-12)
        .at_most("midpoint: the same of the product over all steps", midpoint[1], 5e-12)
        .at_most("trapezoid: largest |l/(l(0) exp(−γt)) − 1|", by_trapezoid, 1.1e-8)
        .at_most("midpoint: largest |l/(l(0) exp(−γt)) − 1|", by_midpoint, 1e-3)
        .near("trapezoid: order of that at the end in h", order(1), [2.0, 0.05])
        .near("midpoint: order of that at the end in h", order(0), [2.0, 0.05]))
}

/// The largest relative deviation of l from l of the step before times the factor of the step, which follows
/// from c, and from l(0) times the product of the factors of all steps.
fn defects(
    job: &Job<'_>,
    method: impl Method<RadialFriction, f64>,
    case: Case,
    c: impl Fn([f64; 2], [f64; 2]) -> f64,
) -> Result<[f64; 2]> {
    let mut run = case.run(method)?;
    let (mut before, [mut l]) = (place(&run), momenta(&run));
    let (mut product, mut of_a_step, mut of_all) = (l, 0.0, 0.0);
    job.follow(&mut run, case.steps(), |run| {
        let (after, expected) = (place(run), l);
        let inner = 1.0 / case.h + c(before, after);
        let factor = (inner - 0.5 * case.gamma) / (inner + 0.5 * case.gamma);
        (before, [l]) = (after, momenta(run));
        product *= factor;
        of_a_step = larger(of_a_step, (l / (expected * factor) - 1.0).abs());
        of_all = larger(of_all, (l / product - 1.0).abs());
    })?;
    Ok([of_a_step, of_all])
}
