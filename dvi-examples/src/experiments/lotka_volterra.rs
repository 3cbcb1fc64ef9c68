//! Predators and prey: one-step schemes where the two-step scheme fails.
//!
//! The one-form is not affine. With a component along one coordinate only it is in the class of one-step
//! schemes; in the symmetric form of the same motion it is not, and the two-step midpoint scheme loses it to
//! its parasitic mode.

use dvi_core::Space as _;

use crate::models::{OneSidedPredators, ShiftedPredators, ShiftedSymmetricPredators, SymmetricPredators};
use crate::vocabulary::*;

const START: (f64, f64) = (2.0, 1.0);
const H: f64 = 0.1;
/// Steps of the beginning, with which the whole is compared.
const EARLY: u64 = 1000;

/// E − E(0), the path of the beginning, and the step that failed, infinite if none did.
type Motion = (Series<1>, Vec<[f64; 2]>, f64);

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let steps = job.choose(1_000_000, 20_000);
    job.expect(3 * steps + 2 * EARLY + 2 * steps);
    let (solid, dashed) = (Stroke::solid, Stroke::dashed);
    let (one_sided, symmetric) = (OneSidedPredators {}, SymmetricPredators {});
    let midpoint =
        follow(job, ("one step, midpoint", solid(BLUE)), &one_sided, OneStep::midpoint(), (H, steps))?;
    let half = follow(job, ("", solid(BLUE)), &one_sided, OneStep::midpoint(), (H / 2.0, 2 * steps))?;
    let order_4 = ("one step, Gauss of order 4", solid(GREEN));
    let gauss = follow(job, order_4, &one_sided, OneStepGauss::<2>::new(), (H, steps))?;
    let rk4 = follow(job, ("RK4", dashed(SLATE)), &one_sided, RungeKutta::classical(), (H, steps))?;
    let unwatched = Sigma { parasitic_limit: None, ..Sigma::midpoint() };
    let two_step = follow(job, ("two steps, σ = ½", solid(VERMILLION)), &symmetric, unwatched, (H, EARLY))?;
    let watched = follow(job, ("", solid(VERMILLION)), &symmetric, Sigma::midpoint(), (H, EARLY))?;
    let largest = |(series, ..): &Motion| series.kept[0].largest;
    let near = |name: &str, run, bound| {
        Check::new(format!("one step, midpoint, {name}: max|ΔH|"), largest(run), bound)
    };
    let references = vec![
        near("h = 0.1", &midpoint, Bound::Near(1.04e-2, 5e-5)),
        near("h = 0.05", &half, Bound::Near(2.56e-3, 5e-6)),
    ];
    let [growth, of_gauss, of_rk4] = [&midpoint, &gauss, &rk4].map(|(series, ..)| series.kept[0].growth());
    let text =
        "the two-step midpoint fails in the symmetric one-form, and its parasitic mode is seen before";
    let claims = vec![
        beyond("the energy error of one-step schemes is no larger in the whole run than in its beginning")
            .at_most("midpoint: max|ΔH| over all / over 1000 steps", growth, 1.001)
            .at_most("Gauss of order 4: max|ΔH| over all / over 1000 steps", of_gauss, 1.001)
            .at_least("RK4: max|ΔH| over all / over 1000 steps", of_rk4, 5.0),
        beyond(text).at_most("steps until no step is found", two_step.2, 118.0).at_least(
            "steps between the error of the parasitic mode and that",
            two_step.2 - watched.2,
            1.0,
        ),
        gauges()?,
    ];
    let all = [midpoint, gauss, rk4, two_step];
    let rows = all.iter().flat_map(|(series, ..)| ranges([&series.name], &series.kept[0].envelope));
    let table = Table::of(&["method", "t", "lowest", "mean", "highest"], rows)?;
    job.publish(figure(&all, steps as f64 * H), table)?;
    Ok(Outcome { claims, references, notes: vec![] })
}

fn follow<S: DegenerateLagrangian>(
    job: &Job<'_>,
    (name, stroke): (&str, Stroke),
    system: &S,
    method: impl Method<S, f64>,
    (h, steps): (f64, u64),
) -> Result<Motion>
where
    S::State<f64>: From<(f64, f64)>,
{
    let mut run = Integrator::new(system, method, h, START.into())?;
    let (energy, mut path) = (run.energy(), vec![[START.0, START.1]]);
    let mut kept = Span { end: steps as f64 * h, early: EARLY as f64 * h, intervals: 400 }.deviations();
    let ended = job.follow(&mut run, steps, |run| {
        note(&mut kept, run.time(), [run.energy() - energy]);
        if run.steps() <= EARLY {
            path.push(place(run));
        }
    });
    let failed = ended.err().map_or(f64::INFINITY, |error| error.step as f64);
    Ok((Series::new(name, stroke, kept), path, failed))
}

/// Four one-forms that differ by gauges.
fn gauges() -> Result<Claim> {
    let forms: [Form; 4] = [
        omega(&OneSidedPredators {}),
        omega(&SymmetricPredators {}),
        omega(&ShiftedPredators {}),
        omega(&ShiftedSymmetricPredators {}),
    ];
    let apart = forms.iter().flat_map(|form| form.iter().zip(&forms[0]));
    let apart = largest(apart.map(|(a, b)| (a / b - 1.0).abs()));
    let [coarse, fine] = each([H, H / 2.0], |h| {
        let ends = [
            end(&OneSidedPredators {}, h)?,
            end(&SymmetricPredators {}, h)?,
            end(&ShiftedPredators {}, h)?,
            end(&ShiftedSymmetricPredators {}, h)?,
        ];
        Ok(largest(ends.iter().flat_map(|&a| ends.map(|b| distance(a, b)))))
    })?;
    Ok(beyond("four gauges have one Ω, and their runs differ by the second order of the scheme")
        .at_most("largest relative difference of Ω", apart, 1e-14)
        .near("projected, spread at t = 10: h = 0.1 over h = 0.05", coarse / fine, [4.0, 0.4]))
}

/// The entry of Ω at some points.
type Form = [f64; 25];

fn omega<S: DegenerateLagrangian>(system: &S) -> Form {
    std::array::from_fn(|place| {
        let q = [0.3 + 0.7 * (place / 5) as f64, 0.2 + 0.6 * (place % 5) as f64];
        let mut omega = system.space().matrix();
        system.one_form_jacobian(&q, 0.0, -1.0, 1.0, &mut omega);
        omega[1]
    })
}

/// Where a projected run is at t = 10.
fn end<S: DegenerateLagrangian>(system: &S, h: f64) -> Result<[f64; 2]>
where
    S::State<f64>: From<(f64, f64)>,
{
    let mut run = Integrator::new(system, Projected::symmetric(), h, START.into())?;
    run.take_steps((10.0 / h).round() as u64)?;
    Ok(place(&run))
}

fn figure(all: &[Motion; 4], end: f64) -> Figure {
    let [one_step, _, _, two_step] = all;
    let coordinate = |label| Axis::linear(label).within(0.0, 4.5);
    let paths = Panel::new("Path", coordinate("*x*"), coordinate("*y*"))
        .equal()
        .line(one_step.1.clone(), Stroke::solid(BLUE).width(2.5))
        .labelled(&one_step.0.name)
        .line(two_step.1.clone(), Stroke::solid(VERMILLION).width(1.0))
        .labelled(&two_step.0.name);
    let labels = ["Error of the energy", "largest |*H* − *H*(0)| of each interval"];
    let energy = over_time(labels, end, [1e-6, 1.0], all[..3].iter().map(|(series, ..)| series), 0);
    let steps = if two_step.2.is_finite() { two_step.2.to_string() } else { "1000".to_owned() };
    let [midpoint, gauss, rk4, _] = all.each_ref().map(|(series, ..)| series.kept[0].largest);
    Figure::new(
        "Predators and prey: one step and two, and the energy errors of three methods",
        format!("From (2, 1), *h* = {H}; two steps with the symmetric one-form end after {steps} of them"),
    )
    .row(470.0, vec![paths, energy.weight(1.35).legend_at(Corner::BottomRight)])
    .footer(format!(
        "Largest |Δ*H*| of one step: midpoint {}, Gauss {}. RK4 at the end: {}.",
        at_most(midpoint),
        at_most(gauss),
        scientific(rk4)
    ))
}
