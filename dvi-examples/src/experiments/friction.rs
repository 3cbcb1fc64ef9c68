//! A particle with friction in a radial polynomial potential: what the energy loses, and what a method adds
//! to that.
//!
//! The test case of Kane, Marsden, Ortiz & West 2000. The forces enter the discrete equations by the
//! principle of Lagrange and d'Alembert. The angular momentum decays as e^{−γt}, and by the forced discrete
//! Noether theorem its discrete rate is known in closed form.

use super::average_acceleration::is_midpoint;
use super::decay::{Case, *};
use crate::vocabulary::*;

const COLOURS: [Colour; 4] = [BLUE, GREEN, PURPLE, VERMILLION];

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let end = job.choose(3000.0, 600.0);
    let by_step = STEPS.map(|h| Case { gamma: GAMMA, h, end });
    let [long, _, _, fine] = by_step;
    let double = Case { h: 2.0 * FINE, ..fine };
    let reference = Reference::new(job, Gauss::<4>::new(), fine)?;
    let other = Reference::new(job, Galerkin::<5>::new(), double)?;
    let without = Reference::new(job, Gauss::<4>::new(), Case { gamma: 0.0, ..fine })?;
    let with = Setting { job, case: long, reference: &reference };
    let lost = [with.by("Heun", RungeKutta::heun())?, with.by("explicit midpoint", RungeKutta::midpoint())?];
    let steps = each(by_step, |case| Setting { case, ..with }.runs())?;
    let conservative = Setting { case: Case { gamma: 0.0, ..long }, reference: &without, job }.runs()?;
    let all = steps.iter().flatten().chain(&lost).chain(&conservative);
    let rows = all.flat_map(|Decay { name, case, error, momentum, .. }| {
        let means = error.mean().into_iter().zip(momentum.mean());
        means.map(|([t, energy], [_, momentum])| ([*name], [case.gamma, case.h, t, energy, momentum]))
    });
    let table = Table::of("method,gamma,h,t,mean_energy_deviation,mean_momentum_deviation", rows);
    job.publish(figure(&reference, &steps, &conservative[3]), table)?;
    let pairs = reference.energies.iter().skip(1).step_by(2).zip(&other.energies);
    let between = largest(pairs.map(|(a, b)| (a / b - 1.0).abs()));
    let references = "the reference has the energy of a run by another method, and the angular momentum of \
                      the motion";
    let is_known = beyond(references).at_most("largest relative difference of two energies", between, 2e-11);
    let gain = beyond("Runge–Kutta methods of second order gain energy at that step instead of losing it");
    claims([
        is_known.at_most("largest |l/(l(0) exp(−γt)) − 1|", reference.momentum, 1e-12),
        noether(job, long, &steps)?,
        follows(job, &steps[0]),
        control(&reference, &conservative),
        gain.each(&lost, |claim, run| {
            let doubled = run.doubled.unwrap_or(f64::INFINITY);
            claim.of(run.name).at_most("time at which E is twice E(0)", doubled, 5.0)
        }),
        orders(job, &steps),
        is_midpoint(job, long)?,
    ])
}

/// The forced discrete Noether theorem: what a step takes of an angular momentum.
///
/// D₁L_d and D₂L_d are parallel to the points but for Δ/h and the forces ∓½γΔ, and so l0 = (1/h + c + ½γ)
/// q0×q1 and l1 = (1/h + c − ½γ) q0×q1. The rule of the trapezoid has c = 0, that of the midpoint ¼h V'(r)/r
/// at the middle of the step.
fn noether(job: &Job<'_>, case: Case, steps: &[Runs; 4]) -> Result<Claim> {
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

/// The largest relative deviations of l from that before times the factor of the step, which follows from c,
/// and from l(0) times the product of the factors of all steps.
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

fn follows(job: &Job<'_>, runs: &Runs) -> Claim {
    let deviates = "largest relative deviation of E, means over 50";
    let too_fast = "rate of decay of E less that of the motion, in units of γ";
    let bounds = [[0.16, 0.18, 0.065], [0.12, 0.16, 0.025], [0.33, 0.36, 0.075]];
    let text = "at h = 0.2 RK4 adds to the decay of the energy as much as friction, and the other methods a \
                small part of that";
    let claim = beyond(text).each(runs.iter().zip(bounds), |claim, (run, [mean, each, rate])| {
        claim
            .of(run.name)
            .at_most(deviates, run.largest_mean(), mean)
            .at_most("the same at each step", run.error.largest, each)
            .near(too_fast, run.excess(), [0.0, rate])
    });
    let rk4 = &runs[3];
    let claim = claim.of(rk4.name).at_least(deviates, job.only_full(rk4.largest_mean()), 0.9);
    claim.at_least(too_fast, rk4.excess(), 1.0)
}

fn control(reference: &Reference, conservative: &Runs) -> Claim {
    // What RK4 loses of the energy without friction over what the motion loses by friction, as long as its
    // own motion is not close to a circle, on which it loses nothing.
    let rows = conservative[3].energy.mean();
    let own = rows.iter().rfind(|[t, _]| *t < 200.0).map_or(f64::NAN, |[_, energy]| *energy);
    let begin = reference.energy(FINE);
    let own_loss = (begin - own) / (begin - reference.energy(200.0));
    let text = "without friction the other methods keep their energy, and RK4 at first loses more than \
                friction takes";
    beyond(text)
        .each(&conservative[..3], |claim, run| {
            let [first, last] = run.means();
            let change = (1.0 + last) / (1.0 + first) - 1.0;
            claim.of(run.name).near("mean E over the last 50 / over the first − 1", change, [0.0, 5e-4])
        })
        .each(&conservative[..2], |claim, run| {
            claim.of(run.name).at_most("largest |l/l(0) − 1|", run.momentum.largest, 1e-13)
        })
        .at_least("RK4: what it loses of E to t = 200 / what friction takes", own_loss, 1.5)
}

fn orders(job: &Job<'_>, steps: &[Runs; 4]) -> Claim {
    let order = |method: usize| {
        order(steps[1..].iter().map(|runs| (runs[method].case.h, runs[method].excess().abs())))
    };
    let worse = |k: usize| job.only_full(steps[k][3].largest_mean() / steps[k][0].largest_mean());
    let dearest = "four forces in 0.2: largest deviation of E, trapezoid with h = 0.05 / RK4 with h = 0.2";
    let text = "the error of that rate is of second order, with RK4 of the fifth, so that RK4 is behind at \
                long steps and ahead at short ones";
    beyond(text)
        .each(0..3, |claim, method| {
            claim.of(steps[0][method].name).near("order of the error of the rate", order(method), [2.0, 0.1])
        })
        .near("RK4: order of the error of the rate", order(3), [5.0, 0.2])
        .at_least("h = 0.1: largest deviation of E, RK4 / midpoint", worse(1), 5.0)
        .at_most("h = 0.025: largest deviation of E, RK4 / midpoint", worse(3), 0.5)
        .at_most(dearest, steps[2][1].largest_mean() / steps[0][3].largest_mean(), 0.01)
}

fn figure(reference: &Reference, steps: &[Runs; 4], rk4_alone: &Decay) -> Figure {
    let stroke = |method: usize| solid(COLOURS[method]).width(if method == 0 { 2.4 } else { 1.8 });
    let lines = |points: fn(&Decay) -> Vec<[f64; 2]>| {
        steps[0].iter().enumerate().map(move |(method, run)| (run.name, stroke(method), points(run)))
    };
    let time = ("time *t*", [0.0, steps[0][0].case.end]);
    let energies = reference.energies.iter().zip(1..).map(|(e, n)| [f64::from(n) * FINE, *e]);
    let decay = Panel::linear("Energy", time, ("*E*", [0.0, 0.45]))
        .lines([("reference", solid(SLATE).width(5.0).opacity(0.4), energies.collect())])
        .lines(lines(|run| run.energy.mean()))
        .lines([("RK4 without friction", dashed(VERMILLION), rk4_alone.energy.mean())]);
    let means = format!("relative, |mean| over {WINDOW} units of time");
    let deviation = Panel::semilog("Deviation of the energy", time, (&means, [1e-3, 2.0]))
        .lines(lines(|run| run.error.mean().into_iter().map(|[t, mean]| [t, mean.abs()]).collect()));
    let l = ("largest |*l*/(*l*(0) exp(−*γt*)) − 1|", [1e-13, 1.0]);
    let momentum = Panel::semilog("Angular momentum", time, l).lines(lines(|run| run.momentum.magnitude()));
    let h = Axis::logarithmic("step *h*").within([0.02, 0.25]);
    let rate = Axis::logarithmic("|error| of the rate of *E*   [*γ*]");
    let excess = |method: usize| {
        let points = steps.iter().map(|runs| [runs[method].case.h, runs[method].excess().abs()]);
        (steps[0][method].name, stroke(method), points.collect())
    };
    let rates = Panel::new("Error of the rate of decay", h, rate).marked((0..4).map(excess));
    Figure::of(format!(
        "*V* = *r*²(*r*² − 1)², *γ* = {GAMMA}, from (1.2, 0) with velocity (0, 0.5); *h* = {} but for the \
         last panel; energies are means over time; reference: *h* = {FINE}",
        STEPS[0]
    ))
    .row(400.0, vec![decay, deviation.legend_at(Corner::BottomRight)])
    .row(330.0, vec![momentum.without_legend(), rates.without_legend()])
}
