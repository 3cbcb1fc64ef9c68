//! A charged particle without mass, in two gauges of one field: what each of them allows.
//!
//! Ω is the magnetic field and does not depend on the gauge, and neither does the motion. The schemes do:
//! with a potential along x only there are one-step schemes; with the symmetric one the two-step midpoint
//! scheme has a parasitic mode that grows.

use dvi_core::space::sink::Dense;

use crate::models::{MasslessAlongX, MasslessSymmetric};
use crate::vocabulary::*;

const ALONG_X: MasslessAlongX = MasslessAlongX {};
const SYMMETRIC: MasslessSymmetric = MasslessSymmetric {};
const START: (f64, f64) = (1.0, 1.0);
const H: f64 = 0.5;
/// Steps of the beginning, with which the whole is compared.
const EARLY: u64 = 2000;
/// The steps at which the parasitic mode is measured, and until when at most.
const STEPS: [f64; 3] = [0.5, 0.25, 0.125];
const END: f64 = 1500.0;

/// The parasitic mode of the two-step scheme.
struct Parasite {
    h: f64,
    /// Time and amplitude.
    amplitudes: Vec<[f64; 2]>,
    path: Vec<[f64; 2]>,
    /// The time at which no step was found.
    ended: Option<f64>,
}

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let steps = job.choose(1_000_000, 20_000);
    job.expect(3 * steps + STEPS.map(|h| (END / h) as u64).iter().sum::<u64>());
    let (solid, dashed) = (Stroke::solid, Stroke::dashed);
    let (one_step, path) =
        long_run(job, ("along *x*, one step", solid(BLUE)), &ALONG_X, OneStep::midpoint(), steps)?;
    let named = ("symmetric, projected", solid(GREEN));
    let all = [
        one_step,
        long_run(job, named, &SYMMETRIC, Projected::symmetric(), steps)?.0,
        long_run(job, ("RK4", dashed(SLATE)), &SYMMETRIC, RungeKutta::classical(), steps)?.0,
    ];
    let parasites = each(STEPS, |h| Parasite::new(job, h))?;
    let errors = all.iter().flat_map(|series| {
        let rows = ranges([&series.name], &series.kept[0].envelope);
        rows.map(|(name, [t, low, _, high])| (name, [t, low, high].map(Some)))
    });
    let modes = parasites.iter().flat_map(|Parasite { h, amplitudes, .. }| {
        let rows = amplitudes.iter().map(|[t, amplitude]| [Some(*t), Some(*amplitude), None]);
        rows.map(move |row| ([format!("parasitic mode, h = {h}")], row))
    });
    let table = Table::of(&["series", "t", "amplitude or lowest ΔH", "highest ΔH"], errors.chain(modes))?;
    job.publish(figure(&all, &path, &parasites, steps as f64 * H), table)?;
    let growth = |series: &Series<1>| {
        format!("{}: max|ΔH| over all / over {EARLY} steps", series.name.replace('*', ""))
    };
    let flat = beyond("the energy error is no larger in the whole run than in its beginning")
        .each(&all[..2], |claim, series| claim.at_most(growth(series), series.kept[0].growth(), 1.001))
        .at_least(growth(&all[2]), all[2].kept[0].growth(), 5.0);
    Ok(vec![same_motion()?, flat, grows(&parasites)].into())
}

/// E − E(0), and the path of the beginning.
fn long_run<S>(
    job: &Job<'_>,
    (name, stroke): (&str, Stroke),
    system: &S,
    method: impl Method<S, f64>,
    steps: u64,
) -> Result<(Series<1>, Vec<[f64; 2]>)>
where
    S: DegenerateLagrangian<State<f64>: From<(f64, f64)>>,
{
    let mut run = Integrator::new(system, method, H, START.into())?;
    let (energy, mut path) = (run.energy(), vec![[START.0, START.1]]);
    let span = Span { end: steps as f64 * H, early: EARLY as f64 * H, intervals: 100 };
    let kept = job.keep(&mut run, steps, span, |run| {
        if path.len() < 200 {
            path.push(place(run));
        }
        [run.energy() - energy]
    })?;
    Ok((Series::new(name, stroke, kept), path))
}

fn same_motion() -> Result<Claim> {
    fn omega<S: DegenerateLagrangian>(system: &S, q: [f64; 2]) -> [f64; 4] {
        let mut entries = [0.0; 4];
        system.one_form_jacobian(&q, 0.0, 1.0, -1.0, &mut Dense::new(&mut entries, 2));
        entries
    }
    fn end<S>(system: &S, method: impl Method<S, f64>, steps: u64) -> Result<[f64; 2]>
    where
        S: DegenerateLagrangian<State<f64>: From<(f64, f64)>>,
    {
        let mut run = Integrator::new(system, method, 20.0 / steps as f64, START.into())?;
        run.take_steps(steps)?;
        Ok(place(&run))
    }
    let places = [[1.0, 1.0], [-0.3, 2.0], [0.8, -0.7]];
    let difference = largest(places.map(|q| apart(&omega(&ALONG_X, q), &omega(&SYMMETRIC, q))));
    let exact = end(&SYMMETRIC, Gauss::<4>::new(), 400)?;
    let error = |steps: u64, place| (20.0 / steps as f64, distance(exact, place));
    let counts = [160, 240, 320];
    let one_step = order_of(counts, |steps| Ok(error(steps, end(&ALONG_X, OneStep::midpoint(), steps)?)))?;
    let two_step = order_of(counts, |steps| Ok(error(steps, end(&SYMMETRIC, Sigma::midpoint(), steps)?)))?;
    let projected =
        order_of(counts, |steps| Ok(error(steps, end(&SYMMETRIC, Projected::symmetric(), steps)?)))?;
    Ok(beyond("both gauges have one Ω and one motion")
        .at_most("largest difference of entries of Ω at three points", difference, 1e-14)
        .near("along x, one step: order at t = 20", one_step, [2.0, 0.05])
        .near("symmetric, two steps: order at t = 20", two_step, [2.0, 0.05])
        .near("symmetric, projected: order at t = 20", projected, [2.0, 0.05]))
}

impl Parasite {
    fn new(job: &Job<'_>, h: f64) -> Result<Self> {
        let method = Sigma { parasitic_limit: None, ..Sigma::midpoint() };
        let mut run = Integrator::new(&SYMMETRIC, method, h, START.into())?;
        let mut filter = AlternatingComponent::new(&SYMMETRIC);
        let (mut amplitudes, mut path) = (vec![], vec![[START.0, START.1]]);
        let ended = job.follow(&mut run, (END / h) as u64, |run| {
            amplitudes.extend(filter.amplitude(run.q()).map(|amplitude| [run.time(), amplitude]));
            path.push(place(run));
        });
        Ok(Self { h, amplitudes, path, ended: ended.err().map(|error| error.step as f64 * h) })
    }

    /// The exponential rate of growth, from the medians of two windows of two turns, three turns apart.
    /// Where the path bends most, the smooth motion is seen in the amplitude too.
    fn rate(&self) -> f64 {
        const TURN: f64 = 65.0;
        let median = |start: f64| {
            let window = start..start + 2.0 * TURN;
            let inside = self.amplitudes.iter().filter(|[t, _]| window.contains(t));
            let mut inside: Vec<f64> = inside.map(|[_, amplitude]| *amplitude).collect();
            inside.sort_by(f64::total_cmp);
            inside.get(inside.len() / 2).copied().unwrap_or(f64::NAN)
        };
        (median(260.0 + 3.0 * TURN) / median(260.0)).ln() / (3.0 * TURN)
    }
}

fn grows(parasites: &[Parasite; 3]) -> Claim {
    let rate = parasites[2].rate();
    beyond(
        "in the symmetric gauge the parasitic mode of two steps grows at one rate whatever h, until no \
            step is found",
    )
    .at_least("rate of growth at the smallest h", rate, 5e-3)
    .each(parasites, |claim, parasite| {
        let Parasite { h, ended, .. } = parasite;
        claim
            .near(format!("h = {h}: rate of growth, in units of that"), parasite.rate() / rate, [1.0, 0.1])
            .at_most(format!("h = {h}: time at which it ends"), ended.unwrap_or(f64::INFINITY), END)
    })
}

fn figure(all: &[Series<1>; 3], path: &[[f64; 2]], parasites: &[Parasite; 3], end: f64) -> Figure {
    let plane =
        Panel::new("Path", Axis::linear("*x*").within(-2.0, 2.0), Axis::linear("*y*").within(-0.2, 4.2))
            .equal()
            .line(path.to_vec(), Stroke::solid(BLUE).width(2.5))
            .labelled("along *x*, one step")
            .dots(parasites[0].path.clone(), 1.3, VERMILLION)
            .labelled("symmetric, two steps");
    let strokes = [Stroke::solid(VERMILLION), Stroke::dashed(GREEN), Stroke::dashed(SLATE)];
    let lines = parasites
        .iter()
        .zip(strokes)
        .map(|(parasite, stroke)| (format!("*h* = {}", parasite.h), stroke, parasite.amplitudes.clone()));
    let axis = Axis::logarithmic("amplitude in *q*").within(1e-9, 10.0);
    let amplitudes = Panel::new("Parasitic mode of two steps, symmetric gauge", Axis::time(END), axis);
    let amplitudes = amplitudes.lines(lines).weight(1.35).legend_at(Corner::BottomRight);
    let energy =
        over_time(["Error of the energy", "largest |Δ*H*| of each interval"], end, [1e-5, 10.0], all, 0);
    let [one_step, projected, rk4] = all.each_ref().map(|series| series.kept[0].largest);
    Figure::new(
        "A charged particle without mass: two gauges of one field",
        format!("*B* = 1 + 2(*x*² + *y*²), *φ* = cos *x* + sin *y*, from (1, 1), *h* = {H}"),
    )
    .row(430.0, vec![plane, amplitudes])
    .row(300.0, vec![energy.legend_at(Corner::BottomRight)])
    .footer(format!(
        "Largest |Δ*H*|: one step {}, projected {}. RK4 at the end: {}.",
        at_most(one_step),
        at_most(projected),
        scientific(rk4)
    ))
}
