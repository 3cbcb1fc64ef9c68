//! The stability limit |λh| < 1/|1 − 2σ| on z' = λz, λ imaginary (Rowley & Marsden 2002, section 4.1),
//! found by bisection and without use of the formula.

use anyhow::Result;
use dvi_core::prelude::*;
use rayon::prelude::*;

use crate::claim::{Bound, Claim};
use crate::figure::{Anchor, Axis, BLUE, Corner, Figure, Fill, Panel, SLATE, Stroke, VERMILLION};
use crate::gallery::{Experiment, Outcome};
use crate::job::Job;
use crate::models::{Rotation, RotationState};
use crate::output::Table;

pub const EXPERIMENT: Experiment =
    Experiment { name: "stability", title: "The stability limit over σ, by bisection", run };

/// σ = ½ has no limit and is tested apart.
#[rustfmt::skip]
const SIGMAS: [f64; 18] = [
    0.0, 0.1, 0.2, 0.3, 0.4, 0.45, 0.47, 0.48, 0.49, 0.51, 0.52, 0.53, 0.55, 0.6, 0.7, 0.8, 0.9, 1.0,
];

/// A mode that grows reaches this size unless it grows more slowly than we resolve; at the limit itself
/// the growth is linear and does not.
const LARGE: f64 = 1e8;

fn run(job: &Job<'_>) -> Result<Outcome> {
    let steps = job.choose(40_000, 8_000);
    // A bisection takes some 32 runs.
    job.expect(steps * (3 + 32 * SIGMAS.len() as u64));
    let measured: Vec<[f64; 2]> =
        SIGMAS.par_iter().map(|&sigma| Ok([sigma, limit(job, sigma, steps)?])).collect::<Result<_>>()?;
    let [once, twice] = [steps, 2 * steps].map(|steps| largest_amplitude(job, 0.5, 1e3, steps));
    let growth = twice? / once?;
    let deviation = measured.iter().map(|[sigma, limit]| (limit * (1.0 - 2.0 * sigma).abs() - 1.0).abs());
    let deviation = deviation.fold(0.0, f64::max);
    let claims = vec![
        Claim::new("section 4.1", "stable for imaginary λ only when |λh| < 1/|1 − 2σ|").check(
            "largest relative deviation from the formula",
            deviation,
            Bound::AtMost(job.choose(1e-4, 1e-3)),
        ),
        Claim::new("section 4.1", "for σ = ½ there is no limit").check(
            format!("growth of max|z| from step {steps} to twice that, λh = 1000i"),
            growth,
            Bound::AtMost(1.001),
        ),
    ];
    job.publish(EXPERIMENT.name, figure(&measured), table(&measured)?)?;
    Ok(Outcome { claims, notes: vec![] })
}

/// The largest ω at which runs with h = 1 stay bounded.
fn limit(job: &Job<'_>, sigma: f64, steps: u64) -> Result<f64> {
    let is_stable = |omega: f64| Ok::<_, anyhow::Error>(largest_amplitude(job, sigma, omega, steps)? < LARGE);
    let (mut low, mut high) = (0.0, 0.5);
    while is_stable(high)? && !job.is_stopping() {
        (low, high) = (high, 2.0 * high);
    }
    while high - low > 1e-9 * high && !job.is_stopping() {
        let middle = 0.5 * (low + high);
        if is_stable(middle)? { low = middle } else { high = middle }
    }
    Ok(0.5 * (low + high))
}

/// max |z| over a run with h = 1 from 1 and from a second point that excites both modes.
fn largest_amplitude(job: &Job<'_>, sigma: f64, omega: f64, steps: u64) -> Result<f64> {
    let rotation = Rotation { omega };
    let [first, second] = [0.0, omega.min(1.0)].map(|angle| RotationState { x: angle.cos(), y: angle.sin() });
    // Both modes are wanted.
    let method = Sigma { parasitic_limit: None, ..Sigma::new(sigma) };
    let mut run = Integrator::from_two_points(&rotation, method, 1.0, first, second)?;
    let mut largest = 0.0f64;
    job.repeat(steps, || {
        // Once it is large enough to be called unstable, there is no need to go on to infinity.
        if largest < LARGE {
            run.advance()?;
            largest = run.q().iter().fold(largest, |largest, q| q.abs().max(largest));
        }
        Ok(())
    })?;
    Ok(largest)
}

fn figure(measured: &[[f64; 2]]) -> Figure {
    let formula = |sigma: f64| 1.0 / (1.0 - 2.0 * sigma).abs();
    let (bottom, top) = (0.5, 200.0);
    let curve: Vec<[f64; 2]> =
        (0..=1000).map(|i| f64::from(i) / 1000.0).map(|s| [s, formula(s).min(1e6)]).collect();
    let stable = curve.iter().map(|&[sigma, limit]| [sigma, bottom, limit]).collect();
    let sigma = Axis::linear("σ").within(-0.02, 1.02);
    let panel = Panel::new(
        "Runs on the border between bounded and unbounded",
        sigma,
        Axis::logarithmic("|λ*h*|").within(bottom, top),
    )
    .band(stable, BLUE)
    .line(curve, Stroke::solid(BLUE))
    .labelled("1/|1 − 2σ|")
    .discs(measured.to_vec(), VERMILLION, Fill::Hollow)
    .labelled("measured by bisection")
    .note([0.5, 0.75], Anchor::Middle, BLUE, "stable")
    .note([0.1, 20.0], Anchor::Middle, SLATE, "unstable")
    .legend_at(Corner::TopRight);
    Figure::new(
        "The σ-family is stable up to |λ*h*| = 1/|1 − 2σ|, and without limit for σ = ½",
        "On *z*' = λ*z* with imaginary λ; found by bisection, without use of the formula",
    )
    .row(470.0, vec![panel])
    .footer("Rowley & Marsden 2002, section 4.1.")
}

fn table(measured: &[[f64; 2]]) -> Result<Table> {
    let mut table = Table::new(&["sigma", "limit", "formula"])?;
    for &[sigma, limit] in measured {
        table.row([sigma, limit, 1.0 / (1.0 - 2.0 * sigma).abs()])?;
    }
    Ok(table)
}
