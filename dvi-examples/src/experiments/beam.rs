//! A vibrating beam with hundreds of degrees of freedom, by finite elements and by an elastic rod, with
//! Newmark's method.
//!
//! With β = ¼ the step does not need to resolve the fastest vibrations, and Newton's method solves banded
//! equations. On the linear beam the method conserves the energy exactly (Hughes 2000, chapter 9), and the
//! frequencies of the elements are compared with those of Euler and Bernoulli. At large deflections
//! symplectic implicit steps are no longer stable at every length (Simo, Tarnow & Wong 1992; Gonzalez & Simo
//! 1996): steps that keep the energy of a rod are lost when it is divided further.

use dvi_core::Separable;

use crate::models::{Beam, BeamState, Mode, Rod, RodState};
use crate::vocabulary::*;

const MODES: [u32; 3] = [0, 1, 2];
/// The elements of the linear beam, and the segments of the others.
const ELEMENTS: usize = 200;
const SEGMENTS: usize = 100;
const MANY_SEGMENTS: usize = 200;
/// For frequencies.
const COARSE_BEAMS: [usize; 4] = [8, 16, 32, 64];
const COARSE_RODS: [usize; 4] = [12, 25, 50, 100];
/// For iterations.
const COUNTED: [usize; 4] = [25, 50, 100, 200];
/// How accurately steps are solved: of the beam, and of the rod.
const OF_BEAM: f64 = 1e-10;
const OF_ROD: f64 = 1e-11;
const STRETCHING: f64 = 1e4;
/// The factor of the velocities of a mode with which frequencies of the rod are measured, small so that they
/// do not depend on it.
const SPEED: f64 = 1e-4;
/// The deflection of the end of the linear beam, and the angle of the end of the rod.
const DEFLECTION: f64 = 0.1;
const ANGLE: f64 = 1.5;
/// Steps in a period of the first mode of the linear beam.
const STEPS_PER_PERIOD: f64 = 100.0;
/// The step with large deflections, and a shorter one.
const H: f64 = 0.0025;
const SHORT: f64 = 0.001;
/// How long the runs with more segments are, in periods of the first mode.
const MANY_PERIODS: f64 = 15.0;

/// The energy in the course of one run, which may be lost.
struct Vibration {
    name: String,
    colour: Colour,
    h: f64,
    /// E/E(0) − 1.
    energy: Deviation,
    /// The time of the last step before the run is lost, in periods of the first mode.
    lost: Option<f64>,
}

/// Relative errors of the frequencies of [`MODES`].
type Errors = [f64; 3];

fn period() -> f64 {
    TAU / Mode::new(0).frequency()
}

/// Newmark's method with β = ¼ and Newton's method alone, up to `tolerance`: the equations of a step are so
/// ill conditioned that corrections end in rounding errors which are larger than those of the coordinates.
fn newmark(tolerance: f64) -> Newmark {
    let stopping = Stopping { tolerance, ..Stopping::default() };
    Newmark { solver: Solver::Newton, stopping, ..Newmark::new(0.25) }
}

fn rod(n: usize) -> Rod {
    Rod { n, stretching: STRETCHING }
}

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let periods = job.choose([400.0, 50.0], [4.0, 1.0]);
    let (h, beam) = (period() / STEPS_PER_PERIOD, Beam { n: ELEMENTS });
    let [end, end_large] = periods.map(|periods| periods * period());
    let end_many = job.choose(MANY_PERIODS * period(), end_large);
    job.expect(((end / h) + (end_large + end_many) / H + end_many / SHORT) as u64);
    let of_rod = |name: String, colour, n: usize, h: f64, end: f64| {
        Vibration::new(job, name, colour, &rod(n), newmark(OF_ROD), rod(n).bent(ANGLE), [h, end])
    };
    let start = beam.loaded(DEFLECTION);
    let all = [
        of_rod(format!("rod, {MANY_SEGMENTS} segments"), VERMILLION, MANY_SEGMENTS, H, end_many)?,
        of_rod(format!("the same, *h* = {SHORT}"), AMBER, MANY_SEGMENTS, SHORT, end_many)?,
        of_rod(format!("rod, {SEGMENTS} segments"), GREEN, SEGMENTS, H, end_large)?,
        Vibration::new(
            job,
            format!("beam, {ELEMENTS} elements"),
            BLUE,
            &beam,
            newmark(OF_BEAM),
            start,
            [h, end],
        )?,
    ];
    let (of_beams, of_rods) = (each(COARSE_BEAMS, errors_of_beam)?, each(COARSE_RODS, errors_of_rod)?);
    let rows = all.iter().flat_map(|Vibration { name, h, energy, .. }| {
        energy.envelope.magnitude().into_iter().map(move |[t, error]| ([name], [*h, t, error]))
    });
    let table = Table::of(&["series", "h", "t", "energy_error"], rows)?;
    job.publish(figure(&all, &of_beams, &of_rods, periods[1])?, table)?;
    Ok(vec![
        elements(&of_beams)?,
        segments(&of_rods)?,
        energy(&all[3], &beam, h / 1000.0)?,
        large(job, &all[2], periods[1]),
        lost(job, &all),
        work(job.choose(400, 20))?,
    ]
    .into())
}

impl Vibration {
    fn new<S: Lagrangian>(
        job: &Job<'_>,
        name: String,
        colour: Colour,
        system: &S,
        method: impl Method<S, f64>,
        start: S::State<f64>,
        [h, end]: [f64; 2],
    ) -> Result<Self> {
        let mut run = Integrator::new(system, method, h, start)?;
        let (begin, mut energy) = (run.energy(), Deviation::new(end, 200, 2.0 * period()));
        let kept = job.follow(&mut run, (end / h).round() as u64, |run| {
            energy.push(run.time(), run.energy() / begin - 1.0);
        });
        Ok(Self { name, colour, h, energy, lost: kept.err().map(|_| run.time() / period()) })
    }
}

/// The angular frequency near `guess` of the mode that `start` is near to, without the error of the steps.
///
/// The velocities of a mode obey v₊ + v₋ = 2 cos(ω̃h) v. The cosine that fits best, v·M(v₊ + v₋)/(2 v·Mv),
/// has an error that is of second order in what other modes take part. `method` is Newmark's with β = ¼,
/// which has (2/h) tan(ω̃h/2) = ω.
fn frequency<S>(system: &S, method: Newmark, start: S::State<f64>, guess: f64) -> Result<f64>
where
    S: Separable + RegularLagrangian + System,
{
    // hω = ½, and the mean is taken over 200 steps.
    let h = 0.5 / guess;
    let mut run = Integrator::new(system, method, h, start)?;
    let velocity = |state: &S::State<f64>| -> Result<Vec<f64>> {
        let values: Vec<f64> = system.values(state)?.collect();
        Ok(values[values.len() / 2..].to_vec())
    };
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let mut last = run.memory().p().to_vec();
    run.advance()?;
    let (mut across, mut along) = (0.0, 0.0);
    for _ in 0..200 {
        let (v, p) = (velocity(&run.state())?, run.memory().p().to_vec());
        run.advance()?;
        across += dot(&v, &last) + dot(&v, run.memory().p());
        along += 2.0 * dot(&v, &p);
        last = p;
    }
    // tan²(ω̃h/2) = (1 − cos ω̃h)/(1 + cos ω̃h)
    Ok(2.0 / h * ((along - across) / (along + across)).sqrt())
}

fn errors_of_beam(n: usize) -> Result<Errors> {
    each(MODES.map(Mode::new), |mode| {
        let found = frequency(&Beam { n }, newmark(OF_BEAM), Beam { n }.struck(mode), mode.frequency())?;
        Ok(found / mode.frequency() - 1.0)
    })
}

/// Of deflections that are so small that the frequency does not depend on them.
fn errors_of_rod(n: usize) -> Result<Errors> {
    each(MODES.map(Mode::new), |mode| {
        let found = frequency(&rod(n), newmark(OF_ROD), rod(n).struck(mode, SPEED), mode.frequency())?;
        Ok(found / mode.frequency() - 1.0)
    })
}

/// The order in 1/n of errors that belong to these n.
fn order_in_size(sizes: [usize; 4], errors: [f64; 4]) -> Option<f64> {
    order(sizes.into_iter().zip(errors).map(|(n, error)| (1.0 / n as f64, error.abs())))
}

/// The orders of the modes, which are near `target`.
fn orders(claim: Claim, name: &str, sizes: [usize; 4], errors: &[Errors; 4], target: [f64; 2]) -> Claim {
    claim.each(MODES, |claim, k| {
        let quantity = format!("{name}mode {}: order in 1/n, n from {} to {}", k + 1, sizes[0], sizes[3]);
        claim.near(quantity, order_in_size(sizes, errors.map(|errors| errors[k as usize])), target)
    })
}

fn elements(of_beams: &[Errors; 4]) -> Result<Claim> {
    let largest = |errors: Errors| largest(errors.map(f64::abs));
    let error = "elements: largest relative error of a frequency";
    let text = "the frequencies of the first three modes of finite elements are those of Euler and \
                Bernoulli, with an error of fourth order";
    Ok(orders(beyond(text), "", COARSE_BEAMS, of_beams, [4.0, 0.05])
        .at_most(format!("16 {error}"), largest(of_beams[1]), 1e-4)
        .at_most(format!("{ELEMENTS} {error}"), largest(errors_of_beam(ELEMENTS)?), 1e-8))
}

fn segments(of_rods: &[Errors; 4]) -> Result<Claim> {
    // The energy of the bent rod less that of the curve.
    let bending = each(COARSE_RODS, |n| {
        let energy: f64 = rod(n).energy_at(&rod(n).bent(ANGLE))?;
        Ok(energy - 0.9 * ANGLE * ANGLE)
    })?;
    let quantity = format!("{SEGMENTS} segments: largest relative error of a frequency");
    let text = "the elastic rod has these frequencies at small deflections, and the energy of the curve, \
                with errors of second order";
    Ok(orders(beyond(text), "rod, ", COARSE_RODS, of_rods, [2.0, 0.1])
        .at_most(quantity, largest(of_rods[3].map(f64::abs)), 1.2e-3)
        .near("energy of bending: order in 1/n", order_in_size(COARSE_RODS, bending), [2.0, 0.05]))
}

fn energy(of_beam: &Vibration, beam: &Beam, shorter: f64) -> Result<Claim> {
    // Lost is a run whose energy grows a million times, or of which no number is left.
    let mut verlet = Integrator::new(beam, Newmark::new(0.0), shorter, beam.loaded(DEFLECTION))?;
    let begin = verlet.energy();
    let grown = |energy: f64| energy.is_nan() || energy > 1e6 * begin;
    let lost = indicator((0..1000).any(|_| verlet.advance().is_err() || grown(verlet.energy())));
    let text = format!(
        "{ELEMENTS} elements, 100 steps in a period of the first mode: Newmark's method with β = 1/4 keeps \
         the energy to the accuracy with which steps are solved"
    );
    Ok(beyond(text).at_most("beam: largest |E/E(0) − 1|", of_beam.energy.largest, 1e-9).at_least(
        "runs lost of one by Störmer–Verlet with a step that is 1000 times shorter",
        lost,
        1.0,
    ))
}

fn large(job: &Job<'_>, rod: &Vibration, periods: f64) -> Claim {
    let until = job.only_full(rod.lost.unwrap_or(periods));
    let growth = job.only_full(rod.energy.growth());
    beyond(format!("large deflections of {SEGMENTS} segments, h = {H}: the energy error does not grow"))
        .at_least("rod: time until the run is lost, in periods of the first mode", until, periods)
        .at_most("rod: largest |E/E(0) − 1|", rod.energy.largest, 2e-4)
        .at_most("rod: largest |E/E(0) − 1| over all / in two periods", growth, 1.3)
}

fn lost(job: &Job<'_>, [many, short, ..]: &[Vibration; 4]) -> Claim {
    let until = |run: &Vibration| job.only_full(run.lost.unwrap_or(MANY_PERIODS));
    let short_until =
        format!("{MANY_SEGMENTS} segments, h = {SHORT}: periods until the run is lost, or its end");
    let error = format!("{MANY_SEGMENTS} segments, h = {SHORT}: largest |E/E(0) − 1|");
    beyond(format!("with {MANY_SEGMENTS} segments the same step is lost, a shorter one is not"))
        .within(
            format!("{MANY_SEGMENTS} segments, h = {H}: periods until the run is lost"),
            until(many),
            [2.0, 14.0],
        )
        .at_least(short_until, until(short), MANY_PERIODS)
        .at_most(error, short.energy.largest, 4e-5)
}

fn work(steps: u64) -> Result<Claim> {
    let h = period() / STEPS_PER_PERIOD;
    let of_beam = |n| iterations(&Beam { n }, newmark(OF_BEAM), h, Beam { n }.loaded(DEFLECTION), steps);
    let of_rod = |n| iterations(&rod(n), newmark(OF_ROD), H, rod(n).bent(ANGLE), steps);
    let both = [("beam", [1.9, 2.1], each(COUNTED, of_beam)?), ("rod", [2.8, 4.0], each(COUNTED, of_rod)?)];
    let text = "the number of iterations of a step hardly depends on that of the nodes";
    Ok(beyond(text).each(both, |claim, (name, range, all)| {
        claim.each(COUNTED.into_iter().zip(all), |claim, (n, iterations)| {
            claim.within(format!("{name}, {n} nodes: iterations of a step"), iterations, range)
        })
    }))
}

/// The shapes at six times over half a period, of so many steps.
fn shapes<S: Lagrangian>(
    empty: Panel,
    mut run: impl Run<System = S, Scalar = f64>,
    half: f64,
    shape: impl Fn(S::State<f64>) -> Vec<[f64; 2]>,
) -> Result<Panel> {
    let mut panel = empty;
    for (k, colour) in [0, 2, 3, 5, 6, 7].map(|i| SEQUENCE[i]).into_iter().enumerate() {
        if k > 0 {
            run.take_steps(half as u64 / 5)?;
        }
        let line = std::iter::once([0.0; 2]).chain(shape(run.state())).collect();
        panel = panel.line(line, Stroke::solid(colour)).labelled(format!("*t* = {:.2}", run.time()));
    }
    Ok(panel.legend_at(Corner::Beside))
}

fn figure(
    all: &[Vibration; 4],
    of_beams: &[Errors; 4],
    of_rods: &[Errors; 4],
    periods: f64,
) -> Result<Figure> {
    let (beam, h) = (Beam { n: ELEMENTS }, all[3].h);
    let run = Integrator::new(&beam, newmark(OF_BEAM), h, beam.loaded(DEFLECTION))?;
    let empty = Panel::new(
        format!("{ELEMENTS} elements, half a period"),
        Axis::linear("place along the beam"),
        Axis::linear("deflection"),
    );
    let deflections = |BeamState { w, .. }: BeamState| {
        w.into_iter().enumerate().map(|(i, w)| [(i + 1) as f64 / ELEMENTS as f64, w]).collect()
    };
    let of_beam = shapes(empty, run, 0.5 * STEPS_PER_PERIOD, deflections)?;
    let rod = rod(SEGMENTS);
    let run = Integrator::new(&rod, newmark(OF_ROD), H, rod.bent(ANGLE))?;
    let empty = Panel::plane(format!("{SEGMENTS} segments, half a period"), "*x*", "*y*");
    let nodes = |RodState { x, y, .. }: RodState| x.into_iter().zip(y).map(|(x, y)| [x, y]).collect();
    let of_rod = shapes(empty, run, 0.5 * period() / H, nodes)?;
    let time = Axis::linear("time *t*, in periods of the first mode").within(0.0, periods);
    let lines = all.iter().map(|Vibration { name, colour, energy, .. }| {
        let points = energy.envelope.magnitude().into_iter().map(|[t, error]| [t / period(), error]);
        (name, Stroke::solid(*colour), points.collect())
    });
    let axis = Axis::logarithmic("largest |*E*/*E*(0) − 1|").within(1e-16, 1.0);
    let energy = Panel::new("Energy", time, axis).lines(lines).legend_at(Corner::Beside);
    Ok(Figure::new(
        "A clamped beam: small deflections by finite elements, large ones by an elastic rod",
        format!(
            "Newmark's method, *β* = 1/4. Mass, length and bending stiffness are 1; released at rest, the \
             beam with the deflection {DEFLECTION} of its end, the rod with the angle {ANGLE}."
        ),
    )
    .row(370.0, vec![of_beam, of_rod])
    .row(350.0, vec![energy, frequencies(of_beams, of_rods)])
    .footer(format!(
        "A period of the first mode is {:.3}. The steps are {h:.4} on the beam and {H} on the rod, but for \
         the shorter ones that are named.",
        period(),
    )))
}

fn frequencies(of_beams: &[Errors; 4], of_rods: &[Errors; 4]) -> Panel {
    let n = Axis::logarithmic("elements or segments *n*").within(6.0, 130.0);
    let points = |sizes: [usize; 4], errors: &[Errors; 4], k: usize| -> Vec<[f64; 2]> {
        sizes.into_iter().zip(errors).map(|(n, errors)| [n as f64, errors[k].abs()]).collect()
    };
    let slope = |n: f64, error: f64, order: i32| vec![[n, error], [2.0 * n, error / 2f64.powi(order)]];
    Panel::new("Frequencies", n, Axis::logarithmic("relative error of the frequency"))
        .each([BLUE, GREEN, PURPLE].into_iter().enumerate(), |panel, (k, colour)| {
            let (beams, rods) = (points(COARSE_BEAMS, of_beams, k), points(COARSE_RODS, of_rods, k));
            panel
                .line(beams.clone(), Stroke::solid(colour))
                .labelled(format!("mode {}, elements", k + 1))
                .discs(beams, colour, Fill::Solid)
                .line(rods.clone(), Stroke::dashed(colour))
                .labelled(format!("mode {}, segments", k + 1))
                .discs(rods, colour, Fill::Hollow)
        })
        .line(slope(14.0, 1e-8, 4), Stroke::solid(SLATE).width(1.2))
        .labelled("orders 4 and 2")
        .line(slope(50.0, 1.5e-2, 2), Stroke::solid(SLATE).width(1.2))
        .legend_at(Corner::Beside)
}
