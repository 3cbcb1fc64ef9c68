//! A vibrating beam with hundreds of degrees of freedom, by finite elements and by an elastic rod, with
//! Newmark's method.
//!
//! With β = ¼ the step does not need to resolve the fastest vibrations, and Newton's method solves banded
//! equations. On the linear beam the method conserves the energy exactly (Hughes 2000, chapter 9). At large
//! deflections symplectic implicit steps are no longer stable at every length (Simo, Tarnow & Wong 1992;
//! Gonzalez & Simo 1996): steps that keep the energy of a rod are lost when it is divided further.

use super::beam_frequencies::Frequencies;
use crate::vocabulary::*;

/// The elements of the linear beam, and the segments of the others.
pub const ELEMENTS: usize = 200;
pub const SEGMENTS: usize = 100;
const MANY_SEGMENTS: usize = 200;
/// How accurately steps are solved: of the beam, and of the rod.
pub const OF_BEAM: f64 = 1e-10;
pub const OF_ROD: f64 = 1e-11;
/// The deflection of the end of the linear beam, and the angle of the end of the rod.
const DEFLECTION: f64 = 0.1;
pub const ANGLE: f64 = 1.5;
/// Steps in a period of the first mode of the linear beam.
const STEPS_PER_PERIOD: f64 = 100.0;
/// The step with large deflections, and a shorter one.
const H: f64 = 0.0025;
const SHORT: f64 = 0.001;
/// How long the runs with more segments are, in periods of the first mode.
const MANY_PERIODS: f64 = 15.0;

fn period() -> f64 {
    TAU / Mode::new(0).frequency()
}

/// Newmark's method with β = ¼ and Newton's method alone, up to `tolerance`: the equations of a step are so
/// ill conditioned that corrections end in rounding errors which are larger than those of the coordinates.
pub fn newmark(tolerance: f64) -> Newmark {
    let stopping = Stopping { tolerance, ..Stopping::default() };
    Newmark { solver: Solver::Newton, stopping, ..Newmark::new(0.25) }
}

pub fn rod(n: usize) -> Rod {
    Rod { n, stretching: 1e4 }
}

fn bent(rod: &Rod) -> Problem<'_, Rod> {
    Problem::new(rod, rod.bent(ANGLE))
}

fn loaded(beam: &Beam) -> Problem<'_, Beam> {
    Problem::new(beam, beam.loaded(DEFLECTION))
}

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let periods = job.choose([400.0, 50.0], [4.0, 1.0]);
    let (h, beam) = (period() / STEPS_PER_PERIOD, Beam { n: ELEMENTS });
    let [end, end_large] = periods.map(|periods| periods * period());
    let end_many = job.choose(MANY_PERIODS * period(), end_large);
    job.expect(((end / h) + (end_large + end_many) / H + end_many / SHORT) as u64);
    let (many, rod) = (rod(MANY_SEGMENTS), rod(SEGMENTS));
    let [of_many, of_rod] = [MANY_SEGMENTS, SEGMENTS].map(|n| format!("rod, {n} segments"));
    let (shorter, of_beam) = (format!("the same, *h* = {SHORT}"), format!("beam, {ELEMENTS} elements"));
    let (many, rod, linear) = (bent(&many), bent(&rod), loaded(&beam).run(newmark(OF_BEAM), h)?);
    let all = [
        vibration(job, (&of_many, solid(VERMILLION)), many.run(newmark(OF_ROD), H)?, end_many),
        vibration(job, (&shorter, solid(AMBER)), many.run(newmark(OF_ROD), SHORT)?, end_many),
        vibration(job, (&of_rod, solid(GREEN)), rod.run(newmark(OF_ROD), H)?, end_large),
        vibration(job, (&of_beam, solid(BLUE)), linear, end),
    ];
    let frequencies = Frequencies::new()?;
    let curves = all.iter().map(|series| ([&series.name], [series.h], series.kept[0].magnitude()));
    job.publish(figure(&all, &frequencies, periods[1])?, curve_table("series,h,t,energy_error", curves))?;
    let [elements, segments] = frequencies.claims()?;
    let [_, short, of_rod, of_beam] = all.each_ref().map(|series| &series.kept[0]);
    let lost = |error: StepError| error.time / period();
    let until = |k: usize, end| job.only_full(all[k].ended.map_or(end, lost));
    let lost = is_lost(&mut loaded(&beam).run(Newmark::new(0.0), h / 1000.0)?, 1000, 1e6);
    let of_verlet = "runs lost of one by Störmer–Verlet with a step that is 1000 times shorter";
    let keeps = "200 elements, 100 steps in a period of the first mode: Newmark's method with β = 1/4 keeps \
                 the energy to the accuracy with which steps are solved";
    let in_periods = "time until the run is lost, in periods of the first mode";
    claims([
        elements,
        segments,
        beyond(keeps)
            .at_most("beam: largest |E/E(0) − 1|", of_beam.largest, 1e-9)
            .at_least(of_verlet, lost, 1.0),
        beyond("large deflections of 100 segments, h = 0.0025: the energy error does not grow")
            .of("rod")
            .at_least(in_periods, until(2, periods[1]), periods[1])
            .at_most("largest |E/E(0) − 1|", of_rod.largest, 2e-4)
            .at_most("largest |E/E(0) − 1| over all / in two periods", job.only_full(of_rod.growth()), 1.3),
        beyond("with 200 segments the same step is lost, a shorter one is not")
            .of("200 segments, h = 0.0025")
            .within("periods until the run is lost", until(0, MANY_PERIODS), [2.0, 14.0])
            .of("200 segments, h = 0.001")
            .at_least("periods until the run is lost, or its end", until(1, MANY_PERIODS), MANY_PERIODS)
            .at_most("largest |E/E(0) − 1|", short.largest, 4e-5),
        work(job.choose(400, 20))?,
    ])
}

/// E/E(0) − 1.
fn vibration(job: &Job<'_>, named: Named<'_>, mut run: impl Run<Scalar = f64>, end: f64) -> Series<1> {
    let (span, begin) = (Span { end, early: 2.0 * period(), intervals: 200 }, run.energy());
    job.series(named, &mut run, span, |run, _| [run.energy() / begin - 1.0])
}

fn work(steps: u64) -> Result<Claim> {
    const COUNTED: [usize; 4] = [25, 50, 100, 200];
    let h = period() / STEPS_PER_PERIOD;
    let beams = each(COUNTED, |n| loaded(&Beam { n }).iterations(newmark(OF_BEAM), h, steps))?;
    let rods = each(COUNTED, |n| bent(&rod(n)).iterations(newmark(OF_ROD), H, steps))?;
    let both = [("beam", [1.9, 2.1], beams), ("rod", [2.8, 4.0], rods)];
    let text = "the number of iterations of a step hardly depends on that of the nodes";
    Ok(beyond(text).each(both, |claim, (name, range, all)| {
        claim.each(COUNTED.into_iter().zip(all), |claim, (n, iterations)| {
            claim.within(format!("{name}, {n} nodes: iterations of a step"), iterations, range)
        })
    }))
}

fn figure(all: &[Series<1>; 4], frequencies: &Frequencies, periods: f64) -> Result<Figure> {
    let (beam, rod, h) = (Beam { n: ELEMENTS }, rod(SEGMENTS), all[3].h);
    let of_beam = shapes(loaded(&beam).run(newmark(OF_BEAM), h)?, 0.5 * STEPS_PER_PERIOD, |state| {
        state.w.into_iter().zip(1..).map(|(w, i)| [f64::from(i) / ELEMENTS as f64, w]).collect()
    })?;
    let of_rod = shapes(bent(&rod).run(newmark(OF_ROD), H)?, 0.5 * period() / H, |state| state.r)?;
    let half = |panel: Panel, shapes: [Shape; 6]| {
        let lines = shapes.map(|(t, colour, line)| (format!("*t* = {t:.2}"), solid(colour), line));
        panel.lines(lines).legend_at(Corner::Beside)
    };
    let (along, across) = (Axis::linear("place along the beam"), Axis::linear("deflection"));
    let of_beam = half(Panel::new(format!("{ELEMENTS} elements, half a period"), along, across), of_beam);
    let of_rod = half(Panel::plane(format!("{SEGMENTS} segments, half a period"), "*x*", "*y*"), of_rod);
    let time = ("time *t*, in periods of the first mode", [0.0, periods]);
    let lines = all.iter().map(|series| {
        series.line(series.kept[0].magnitude().into_iter().map(|[t, error]| [t / period(), error]).collect())
    });
    let energy = Panel::semilog("Energy", time, ("largest |*E*/*E*(0) − 1|", [1e-16, 1.0])).lines(lines);
    let subtitle = format!(
        "Mass, length and bending stiffness are 1; released at rest, the beam with the deflection \
         {DEFLECTION} of its end, the rod with the angle {ANGLE}"
    );
    let figure = Figure::of(subtitle).row(370.0, vec![of_beam, of_rod]);
    Ok(figure.row(350.0, vec![energy.legend_at(Corner::Beside), frequencies.panel()]))
}
