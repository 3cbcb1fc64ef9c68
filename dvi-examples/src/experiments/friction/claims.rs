//! What the experiment claims, and the runs that only claims need.

use anyhow::Result;
use dvi_core::methods::Method;
use dvi_core::prelude::*;

use super::{Case, FINE, Measured, Runs, START, STEPS, Series, WINDOW, angular, by_hand};
use crate::claim::{BEYOND, Bound, Claim, larger};
use crate::job::Job;
use crate::models::{RadialFriction, RadialFrictionState};

/// How far the angular momentum is from what the discrete Noether theorem says, relatively.
#[derive(Clone, Copy, Debug)]
pub(super) struct Factors {
    midpoint: Defect,
    trapezoid: Defect,
}

/// The largest relative deviation of l from l of the step before times the factor of the step, and from l(0)
/// times the product of the factors of all steps.
#[derive(Clone, Copy, Debug)]
struct Defect {
    of_a_step: f64,
    of_all: f64,
}

/// D₁L_d and D₂L_d are parallel to the points but for Δ/h and the forces ∓½γΔ, and so l0 = (1/h + c + ½γ)
/// q0×q1 and l1 = (1/h + c − ½γ) q0×q1. The rule of the trapezoid has c = 0, that of the midpoint ¼h V'(r)/r
/// at the middle of the step.
pub(super) fn factors(job: &Job<'_>, case: Case) -> Result<Factors> {
    let factor = |c: f64| {
        let inner = 1.0 / case.h + c;
        (inner - 0.5 * case.gamma) / (inner + 0.5 * case.gamma)
    };
    let midpoint = defect(job, Variational::midpoint(), case, |system, [q0, q1]| {
        let middle = std::array::from_fn(|i| 0.5 * (q0[i] + q1[i]));
        factor(0.25 * case.h * system.slope(&middle))
    })?;
    let trapezoid = defect(job, Variational::trapezoid(), case, |_, _| factor(0.0))?;
    Ok(Factors { midpoint, trapezoid })
}

fn defect<M: Method<RadialFriction, f64>>(
    job: &Job<'_>,
    method: M,
    case: Case,
    factor: impl Fn(&RadialFriction, [[f64; 2]; 2]) -> f64,
) -> Result<Defect> {
    let system = RadialFriction { gamma: case.gamma };
    let mut run = Integrator::new(&system, method, case.h, START)?;
    let mut product = angular(&run);
    let mut defect = Defect { of_a_step: 0.0, of_all: 0.0 };
    job.repeat(case.steps(), || {
        let (before, l) = ([run.q()[0], run.q()[1]], angular(&run));
        run.advance()?;
        let factor = factor(&system, [before, [run.q()[0], run.q()[1]]]);
        product *= factor;
        defect.of_a_step = larger(defect.of_a_step, (angular(&run) / (l * factor) - 1.0).abs());
        defect.of_all = larger(defect.of_all, (angular(&run) / product - 1.0).abs());
        Ok(())
    })?;
    Ok(defect)
}

/// With z' = F(z) Newmark's method is z1 − ½hF(z1) = z0 + ½hF(z0). So the points z − ½hF(z) are those of the
/// implicit midpoint rule, which is what the variational midpoint rule is for this Lagrangian and these
/// forces.
pub(super) fn conjugate(job: &Job<'_>, case: Case) -> Result<f64> {
    let system = RadialFriction { gamma: case.gamma };
    let mut newmark = by_hand(case);
    let [x, y, dot_x, dot_y] = newmark.half_a_step_back();
    let start = RadialFrictionState { x, y, dot_x, dot_y };
    let mut run = Integrator::new(&system, Variational::midpoint(), case.h, start)?;
    let mut largest = 0.0;
    job.repeat(case.steps(), || {
        run.advance()?;
        newmark.step();
        let RadialFrictionState { x, y, dot_x, dot_y } = run.state();
        for (a, b) in [x, y, dot_x, dot_y].into_iter().zip(newmark.half_a_step_back()) {
            largest = larger(largest, (a - b).abs());
        }
        Ok(())
    })?;
    Ok(largest)
}

pub(super) fn claims(job: &Job<'_>, measured: &Measured) -> Vec<Claim> {
    vec![
        reference(measured),
        noether(measured),
        follows(job, measured),
        control(measured),
        second_order_is_lost(measured),
        orders(job, measured),
        same_method(measured),
    ]
}

fn name(series: &Series) -> String {
    series.name.replace('*', "")
}

fn reference(measured: &Measured) -> Claim {
    Claim::new(
        BEYOND,
        "the reference has the energy of a run by another method, and the angular momentum of the motion",
    )
    .check("largest relative difference of two energies", measured.between_references, Bound::AtMost(2e-11))
    .check("largest |l/(l(0) exp(−γt)) − 1|", measured.reference.momentum, Bound::AtMost(1e-12))
}

fn noether(measured: &Measured) -> Claim {
    let Factors { midpoint, trapezoid } = measured.factors;
    let text =
        "each step, h = 0.2, takes of the angular momentum what the forced discrete Noether theorem says";
    let order = |method: usize| {
        let point = |runs: &Runs| (runs.all()[method].case.h, runs.all()[method].momentum.last.abs());
        convergence_order(&measured.steps[1..].iter().map(point).collect::<Vec<_>>())
    };
    let Runs { midpoint: by_midpoint, trapezoid: by_trapezoid, .. } = &measured.steps[0];
    let defects = Claim::new(BEYOND, text)
        .check(
            "trapezoid: relative defect of l1 = l0 (1 − γh/2)/(1 + γh/2)",
            trapezoid.of_a_step,
            Bound::AtMost(1e-12),
        )
        .check("trapezoid: the same of the product over all steps", trapezoid.of_all, Bound::AtMost(5e-12))
        .check(
            "midpoint: relative defect with 1/h + h V'(r)/(4r) in place of 1/h",
            midpoint.of_a_step,
            Bound::AtMost(1e-12),
        )
        .check("midpoint: the same of the product over all steps", midpoint.of_all, Bound::AtMost(5e-12));
    defects
        .check(
            "trapezoid: largest |l/(l(0) exp(−γt)) − 1|",
            by_trapezoid.momentum.largest,
            Bound::AtMost(1.1e-8),
        )
        .check(
            "midpoint: largest |l/(l(0) exp(−γt)) − 1|",
            by_midpoint.momentum.largest,
            Bound::AtMost(1e-3),
        )
        .check("trapezoid: order of that at the end in h", order(1), Bound::Near(2.0, 0.05))
        .check("midpoint: order of that at the end in h", order(0), Bound::Near(2.0, 0.05))
}

fn follows(job: &Job<'_>, measured: &Measured) -> Claim {
    let text = "at h = 0.2 RK4 adds to the decay of the energy as much as friction, and the other methods a small part of that";
    let runs = &measured.steps[0];
    let bounds = [[0.16, 0.18, 0.065], [0.12, 0.16, 0.025], [0.33, 0.36, 0.075]];
    let claim =
        runs.all().into_iter().zip(bounds).fold(Claim::new(BEYOND, text), |claim, (series, bounds)| {
            let [mean, each, rate] = bounds;
            claim
                .check(deviates(series), series.largest_mean(), Bound::AtMost(mean))
                .check(
                    format!("{}: the same at each step", name(series)),
                    series.error.largest,
                    Bound::AtMost(each),
                )
                .check(too_fast(series), series.excess(), Bound::Near(0.0, rate))
        });
    claim.check(deviates(&runs.rk4), job.only_full(runs.rk4.largest_mean()), Bound::AtLeast(0.9)).check(
        too_fast(&runs.rk4),
        runs.rk4.excess(),
        Bound::AtLeast(1.0),
    )
}

fn deviates(series: &Series) -> String {
    format!("{}: largest relative deviation of E, means over {WINDOW}", name(series))
}

fn too_fast(series: &Series) -> String {
    format!("{}: rate of decay of E less that of the motion, in units of γ", name(series))
}

fn control(measured: &Measured) -> Claim {
    let text = "without friction the other methods keep their energy, and RK4 at first loses more than friction takes";
    let runs = &measured.conservative;
    let claim = runs.all().into_iter().take(3).fold(Claim::new(BEYOND, text), |claim, series| {
        let [first, last] = series.means();
        let changed = (1.0 + last) / (1.0 + first) - 1.0;
        claim.check(
            format!("{}: mean E over the last {WINDOW} / over the first − 1", name(series)),
            changed,
            Bound::Near(0.0, 5e-4),
        )
    });
    let claim = [&runs.midpoint, &runs.trapezoid].into_iter().fold(claim, |claim, series| {
        claim.check(
            format!("{}: largest |l/l(0) − 1|", name(series)),
            series.momentum.largest,
            Bound::AtMost(1e-13),
        )
    });
    claim.check(
        format!("RK4: what it loses of E to t = {BEGINNING} / what friction takes"),
        own_loss(measured),
        Bound::AtLeast(1.5),
    )
}

/// As long as the motion of RK4 without friction is not close to a circle, on which it loses nothing.
const BEGINNING: f64 = 200.0;

/// What RK4 loses of the energy without friction in the beginning, over what the motion loses by friction.
fn own_loss(measured: &Measured) -> f64 {
    let rows = measured.conservative.rk4.energy.mean();
    let own = rows.iter().rfind(|[t, _]| *t < BEGINNING).map_or(f64::NAN, |[_, energy]| *energy);
    let begin = measured.reference.energy(FINE);
    (begin - own) / (begin - measured.reference.energy(BEGINNING))
}

fn second_order_is_lost(measured: &Measured) -> Claim {
    let text = "Runge–Kutta methods of second order gain energy at that step instead of losing it";
    let both = [&measured.heun, &measured.explicit_midpoint];
    both.into_iter().fold(Claim::new(BEYOND, text), |claim, series| {
        let doubled = series.doubled.unwrap_or(f64::INFINITY);
        claim.check(format!("{}: time at which E is twice E(0)", series.name), doubled, Bound::AtMost(5.0))
    })
}

fn orders(job: &Job<'_>, measured: &Measured) -> Claim {
    let text = "the error of that rate is of second order, with RK4 of the fifth, so that RK4 is behind at long steps and ahead at short ones";
    let points = |method: usize| {
        let point = |runs: &Runs| (runs.all()[method].case.h, runs.all()[method].excess().abs());
        measured.steps[1..].iter().map(point).collect::<Vec<_>>()
    };
    let claim = (0..3).fold(Claim::new(BEYOND, text), |claim, method| {
        let name = name(measured.steps[0].all()[method]);
        claim.check(
            format!("{name}: order of the error of the rate"),
            convergence_order(&points(method)),
            Bound::Near(2.0, 0.1),
        )
    });
    let worse = |index: usize| {
        let runs: &Runs = &measured.steps[index];
        runs.rk4.largest_mean() / runs.midpoint.largest_mean()
    };
    let same_cost = measured.steps[2].trapezoid.largest_mean() / measured.steps[0].rk4.largest_mean();
    claim
        .check("RK4: order of the error of the rate", convergence_order(&points(3)), Bound::Near(5.0, 0.2))
        .check(
            format!("h = {}: largest deviation of E, RK4 / midpoint", STEPS[1]),
            job.only_full(worse(1)),
            Bound::AtLeast(5.0),
        )
        .check(
            format!("h = {}: largest deviation of E, RK4 / midpoint", STEPS[3]),
            job.only_full(worse(3)),
            Bound::AtMost(0.5),
        )
        .check(
            "four forces in 0.2: largest deviation of E, trapezoid with h = 0.05 / RK4 with h = 0.2",
            same_cost,
            Bound::AtMost(0.01),
        )
}

fn same_method(measured: &Measured) -> Claim {
    Claim::new(
        BEYOND,
        "Newmark's method with β = ¼ is the variational midpoint rule half a step back, with friction too",
    )
    .check("largest difference of a coordinate or a velocity", measured.conjugate, Bound::AtMost(1e-10))
}
