//! A charged particle without mass, in two gauges of one field: what each of them allows.
//!
//! Ω is the magnetic field and does not depend on the gauge, and neither does the motion. The schemes do:
//! with a potential along x only there are one-step schemes; with the symmetric one the two-step midpoint
//! scheme has a parasitic mode that grows.

use crate::vocabulary::*;

const ALONG_X: MasslessAlongX = MasslessAlongX {};
const SYMMETRIC: MasslessSymmetric = MasslessSymmetric {};
const START: (f64, f64) = (1.0, 1.0);
const H: f64 = 0.5;
/// The steps at which the parasitic mode is measured, and until when at most.
const STEPS: [f64; 3] = [0.5, 0.25, 0.125];
const END: f64 = 1500.0;

/// A run of the two-step scheme with its path, and its parasitic mode: time and amplitude.
type Parasite = (Series<0>, Points);

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let steps = job.choose(1_000_000, 20_000);
    let span = Span { intervals: 100, ..Span::of(steps, H, 2000) };
    let (along_x, symmetric) = (Problem::new(&ALONG_X, START), Problem::new(&SYMMETRIC, START));
    let projected = symmetric.run(Projected::symmetric(), H)?;
    let all = [
        job.energy(("along *x*, one step", solid(BLUE)), along_x.run(OneStep::midpoint(), H)?, span, 200),
        job.energy(("symmetric, projected", solid(GREEN)), projected, span, 200),
        job.energy(("RK4", dashed(SLATE)), symmetric.run(RungeKutta::classical(), H)?, span, 200),
    ];
    let all = each(all, Series::whole)?;
    let strokes = [solid(VERMILLION), dashed(GREEN), dashed(SLATE)];
    let parasites = each([0, 1, 2], |k: usize| parasite(job, STEPS[k], strokes[k]))?;
    let errors = all.iter().map(|series| {
        let rows = series.kept[0].band().into_iter();
        (series.name.clone(), rows.map(|row| row.map(Some)).collect())
    });
    let modes = parasites.iter().map(|(series, amplitudes)| {
        let rows = amplitudes.iter().map(|[t, amplitude]| [Some(*t), Some(*amplitude), None]);
        (format!("parasitic mode, {}", series.name), rows.collect())
    });
    let curves = errors.chain(modes).map(|(name, rows): (_, Vec<_>)| ([name], [], rows));
    let table = curve_table("series,t,amplitude or lowest ΔH,highest ΔH", curves);
    job.publish(figure(&all, &parasites, span.end), table)?;
    let [one_step, projected, rk4] = all.each_ref().map(|series| series.kept[0].growth());
    let flat = beyond("the energy error is no larger in the whole run than in its beginning")
        .at_most("along x, one step: max|ΔH| over all / over 2000 steps", one_step, 1.001)
        .at_most("symmetric, projected: max|ΔH| over all / over 2000 steps", projected, 1.001)
        .at_least("RK4: max|ΔH| over all / over 2000 steps", rk4, 5.0);
    claims([same_motion()?, flat, grows(&parasites)])
}

fn same_motion() -> Result<Claim> {
    let places = [[1.0, 1.0], [-0.3, 2.0], [0.8, -0.7]];
    let difference = largest(places.map(|q| (omega(&ALONG_X, q) - omega(&SYMMETRIC, q)).abs()));
    let (along_x, symmetric) = (Problem::new(&ALONG_X, START), Problem::new(&SYMMETRIC, START));
    let MasslessSymmetricState { x, y } = symmetric.up_to(Gauss::<4>::new(), 0.05, 20.0)?;
    let (counts, far) = ([160, 240, 320], |q: &[f64]| distance([x, y], [q[0], q[1]]));
    let (along_x, symmetric) = (along_x.errors(20.0, &counts, far), symmetric.errors(20.0, &counts, far));
    let projected = symmetric.order(Projected::symmetric())?;
    Ok(beyond("both gauges have one Ω and one motion")
        .at_most("largest difference of entries of Ω at three points", difference, 1e-14)
        .near("along x, one step: order at t = 20", along_x.order(OneStep::midpoint())?, [2.0, 0.05])
        .near("symmetric, two steps: order at t = 20", symmetric.order(Sigma::midpoint())?, [2.0, 0.05])
        .near("symmetric, projected: order at t = 20", projected, [2.0, 0.05]))
}

fn parasite(job: &Job<'_>, h: f64, stroke: Stroke) -> Result<Parasite> {
    let mut run = Problem::new(&SYMMETRIC, START).run(unwatched(Sigma::midpoint()), h)?;
    let (mut filter, mut amplitudes) = (AlternatingComponent::default(), vec![]);
    let span = Span { end: END, early: END, intervals: 1 };
    let series = job.series((&format!("h = {h}"), stroke), &mut run, span, |run, path| {
        amplitudes.extend(filter.amplitude(run.q()).map(|amplitude| [run.time(), amplitude]));
        path.push(place(run));
        []
    });
    Ok((series, amplitudes))
}

/// The rate of growth from the medians of two windows of two turns, three turns apart: where the path bends
/// most, the smooth motion is seen in the amplitude too.
fn rate(amplitudes: &Points) -> f64 {
    const TURN: f64 = 65.0;
    let median = |start: f64| {
        let window = start..start + 2.0 * TURN;
        let inside = amplitudes.iter().filter(|[t, _]| window.contains(t));
        let mut inside: Vec<f64> = inside.map(|[_, amplitude]| *amplitude).collect();
        inside.sort_by(f64::total_cmp);
        inside.get(inside.len() / 2).copied().unwrap_or(f64::NAN)
    };
    (median(260.0 + 3.0 * TURN) / median(260.0)).ln() / (3.0 * TURN)
}

fn grows(parasites: &[Parasite; 3]) -> Claim {
    let smallest = rate(&parasites[2].1);
    let text = "in the symmetric gauge the parasitic mode of two steps grows at one rate whatever h, until \
                no step is found";
    let claim = beyond(text).at_least("rate of growth at the smallest h", smallest, 5e-3);
    claim.each(parasites, |claim, (series, amplitudes)| {
        let (grows, ended) = (rate(amplitudes) / smallest, series.ended.map(|error| error.time));
        let claim = claim.of(&series.name).near("rate of growth, in units of that", grows, [1.0, 0.1]);
        claim.at_most("time at which it ends", ended.unwrap_or(f64::INFINITY), END)
    })
}

fn figure(all: &[Series<1>; 3], parasites: &[Parasite; 3], end: f64) -> Figure {
    let plane = Panel::window("Path", ("*x*", [-2.0, 2.0]), ("*y*", [-0.2, 4.2]))
        .lines([("along *x*, one step", solid(BLUE).width(2.5), all[0].path.clone())])
        .dots(parasites[0].0.path.clone(), 1.3, VERMILLION)
        .labelled("symmetric, two steps");
    let lines = parasites
        .iter()
        .map(|(series, amplitudes)| (format!("*h* = {}", series.h), series.stroke, amplitudes.clone()));
    let axis = ("amplitude in *q*", [1e-9, 10.0]);
    let title = "Parasitic mode of two steps, symmetric gauge";
    let amplitudes = Panel::semilog(title, ("time *t*", [0.0, END]), axis).lines(lines).weight(1.35);
    let labels = ["Error of the energy", "largest |Δ*H*| of each interval"];
    Figure::of("*B* = 1 + 2(*x*² + *y*²), *φ* = cos *x* + sin *y*, from (1, 1), *h* = 0.5")
        .row(430.0, vec![plane, amplitudes.legend_at(Corner::BottomRight)])
        .row(300.0, vec![over_time(labels, end, [1e-5, 10.0], all, 0).legend_at(Corner::BottomRight)])
}
