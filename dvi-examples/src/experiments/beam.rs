//! A vibrating beam with hundreds of degrees of freedom, by finite elements and by an elastic rod, with
//! Newmark's method.
//!
//! With β = ¼ the step does not need to resolve the fastest vibrations, and Newton's method solves banded
//! equations. On the linear beam the method conserves the energy exactly (Hughes 2000, chapter 9), and the
//! frequencies of the elements are compared with those of Euler and Bernoulli. At large deflections
//! symplectic implicit steps are no longer stable at every length (Simo, Tarnow & Wong 1992; Gonzalez & Simo
//! 1996): steps that keep the energy of a rod are lost when it is divided further.

mod claims;
mod frequency;
mod picture;
mod series;

use anyhow::Result;
use dvi_core::prelude::*;
use dvi_core::solve::Stopping;

use crate::gallery::{Experiment, Outcome};
use crate::job::Job;
use crate::models::{Beam, BeamState, Mode, Rod, RodState};
use frequency::frequency;
use series::Series;

pub const EXPERIMENT: Experiment = Experiment {
    name: "beam",
    title: "A vibrating beam of 400 degrees of freedom, with small and with large deflections",
    share: 19.0,
    run,
};

const MODES: usize = 3;
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
/// How many shapes are drawn, over half a period.
const DRAWN: usize = 6;

/// All that is measured.
struct Measured {
    /// How many periods of the first mode the runs last: of the linear beam, and of the rod.
    periods: [f64; 2],
    beam: Series,
    rod: Series,
    /// With more segments, and with shorter steps.
    many: Series,
    many_short: Series,
    /// Whether a run of the beam by Störmer–Verlet with steps that are a thousand times shorter is lost.
    verlet_is_lost: bool,
    /// Relative errors of frequencies, for each of [`COARSE_BEAMS`] and [`COARSE_RODS`]: mode by mode.
    of_beams: [[f64; MODES]; 4],
    of_rods: [[f64; MODES]; 4],
    /// The same with [`ELEMENTS`].
    of_beam: [f64; MODES],
    /// The energy of the bent rod with each of [`COARSE_RODS`] less that of the curve.
    bending: [f64; 4],
    /// Iterations of a step with each of [`COUNTED`]: beam, rod.
    iterations: [[f64; 4]; 2],
    /// The shapes over half a period.
    shapes: [Vec<(f64, Vec<[f64; 2]>)>; 2],
}

fn period() -> f64 {
    std::f64::consts::TAU / Mode::new(0).frequency()
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

fn run(job: &Job<'_>) -> Result<Outcome> {
    let periods = job.choose([400.0, 50.0], [4.0, 1.0]);
    let early = 2.0 * period();
    let (h, beam) = (period() / STEPS_PER_PERIOD, Beam { n: ELEMENTS });
    let [end, end_large] = periods.map(|periods| periods * period());
    let end_many = job.choose(MANY_PERIODS * period(), end_large);
    job.expect(((end / h) + (end_large + end_many) / H + end_many / SHORT) as u64);
    let bent = |n: usize| rod(n).bent(ANGLE);
    let measured = Measured {
        periods,
        beam: Series::new(job, &beam, newmark(OF_BEAM), beam.loaded(DEFLECTION), h, [early, end])?,
        rod: Series::new(job, &rod(SEGMENTS), newmark(OF_ROD), bent(SEGMENTS), H, [early, end_large])?,
        many: Series::new(
            job,
            &rod(MANY_SEGMENTS),
            newmark(OF_ROD),
            bent(MANY_SEGMENTS),
            H,
            [early, end_many],
        )?,
        many_short: Series::new(
            job,
            &rod(MANY_SEGMENTS),
            newmark(OF_ROD),
            bent(MANY_SEGMENTS),
            SHORT,
            [early, end_many],
        )?,
        verlet_is_lost: verlet_is_lost(&beam, h / 1000.0)?,
        of_beams: of_beams(COARSE_BEAMS)?,
        of_rods: of_rods()?,
        of_beam: of_beams([ELEMENTS])?[0],
        bending: bending()?,
        iterations: iterations(job.choose(400, 20))?,
        shapes: [shapes_of_beam(&beam, h)?, shapes_of_rod()?],
    };
    job.publish(EXPERIMENT.name, picture::figure(&measured), picture::table(&measured)?)?;
    Ok(Outcome { claims: claims::claims(job, &measured), references: vec![], notes: vec![] })
}

/// Whether the energy grows a million times, or no number is left.
fn verlet_is_lost(beam: &Beam, h: f64) -> Result<bool> {
    let mut run = Integrator::new(beam, Newmark::new(0.0), h, beam.loaded(DEFLECTION))?;
    let begin = run.energy();
    let grown = |energy: f64| energy.is_nan() || energy > 1e6 * begin;
    Ok((0..1000).any(|_| run.advance().is_err() || grown(run.energy())))
}

fn of_beams<const N: usize>(sizes: [usize; N]) -> Result<[[f64; MODES]; N]> {
    let mut errors = [[f64::NAN; MODES]; N];
    for (errors, n) in errors.iter_mut().zip(sizes) {
        for (k, error) in errors.iter_mut().enumerate() {
            let (mode, beam) = (Mode::new(k as u32), Beam { n });
            *error = frequency(&beam, newmark(OF_BEAM), beam.struck(mode), mode.frequency())?
                / mode.frequency()
                - 1.0;
        }
    }
    Ok(errors)
}

/// Of deflections that are so small that the frequency does not depend on them.
fn of_rods() -> Result<[[f64; MODES]; 4]> {
    let mut errors = [[f64::NAN; MODES]; 4];
    for (errors, n) in errors.iter_mut().zip(COARSE_RODS) {
        for (k, error) in errors.iter_mut().enumerate() {
            let mode = Mode::new(k as u32);
            *error = frequency(&rod(n), newmark(OF_ROD), rod(n).struck(mode, SPEED), mode.frequency())?
                / mode.frequency()
                - 1.0;
        }
    }
    Ok(errors)
}

fn bending() -> Result<[f64; 4]> {
    let mut differences = [f64::NAN; 4];
    for (difference, n) in differences.iter_mut().zip(COARSE_RODS) {
        let energy: f64 = rod(n).energy_at(&rod(n).bent(ANGLE))?;
        *difference = energy - 0.9 * ANGLE * ANGLE;
    }
    Ok(differences)
}

fn iterations(steps: u64) -> Result<[[f64; 4]; 2]> {
    let mut iterations = [[f64::NAN; 4]; 2];
    for (k, n) in COUNTED.into_iter().enumerate() {
        let (beam, rod) = (Beam { n }, rod(n));
        let h = period() / STEPS_PER_PERIOD;
        let mut run = Integrator::new(&beam, newmark(OF_BEAM), h, beam.loaded(DEFLECTION))?;
        run.take_steps(steps)?;
        iterations[0][k] = run.statistics().iterations as f64 / steps as f64;
        let mut run = Integrator::new(&rod, newmark(OF_ROD), H, rod.bent(ANGLE))?;
        run.take_steps(steps)?;
        iterations[1][k] = run.statistics().iterations as f64 / steps as f64;
    }
    Ok(iterations)
}

fn shapes_of_beam(beam: &Beam, h: f64) -> Result<Vec<(f64, Vec<[f64; 2]>)>> {
    let mut run = Integrator::new(beam, newmark(OF_BEAM), h, beam.loaded(DEFLECTION))?;
    let shape = |BeamState { w, .. }: BeamState| {
        let nodes = w.into_iter().enumerate().map(|(i, w)| [(i + 1) as f64 / ELEMENTS as f64, w]);
        std::iter::once([0.0; 2]).chain(nodes).collect()
    };
    let mut shapes = vec![(0.0, shape(run.state()))];
    for _ in 1..DRAWN {
        run.take_steps((0.5 * STEPS_PER_PERIOD) as u64 / (DRAWN as u64 - 1))?;
        shapes.push((run.time(), shape(run.state())));
    }
    Ok(shapes)
}

fn shapes_of_rod() -> Result<Vec<(f64, Vec<[f64; 2]>)>> {
    let rod = rod(SEGMENTS);
    let mut run = Integrator::new(&rod, newmark(OF_ROD), H, rod.bent(ANGLE))?;
    let shape = |RodState { x, y, .. }: RodState| {
        std::iter::once([0.0; 2]).chain(x.into_iter().zip(y).map(|(x, y)| [x, y])).collect()
    };
    let mut shapes = vec![(0.0, shape(run.state()))];
    for _ in 1..DRAWN {
        run.take_steps((0.5 * period() / H) as u64 / (DRAWN as u64 - 1))?;
        shapes.push((run.time(), shape(run.state())));
    }
    Ok(shapes)
}
