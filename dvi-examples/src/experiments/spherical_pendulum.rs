//! A spherical pendulum by unit vectors, along great circles, and the same by a constraint.
//!
//! Its height goes up and down between the roots of a cubic polynomial, while it goes around the vertical.
//! Steps along great circles stay on the sphere without a projection (Lee, Leok & McClamroch 2009); RATTLE
//! takes the chord in place of the arc and finds the force that keeps the length.

mod claims;
mod picture;
mod series;

use anyhow::Result;
use dvi_core::error::StepError;
use dvi_core::methods::Method;
use dvi_core::prelude::*;

use crate::experiments::rk4::rk4;
use crate::experiments::shadow::Shadow;
use crate::experiments::turnings::{Extreme, Sample, Turnings};
use crate::gallery::{Experiment, Outcome};
use crate::job::Job;
use crate::models::{ConstrainedPendulum, SphericalPendulum, SphericalPendulumState};
use series::Series;

pub const EXPERIMENT: Experiment = Experiment {
    name: "spherical-pendulum",
    title: "A spherical pendulum by unit vectors and by a constraint",
    share: 18.0,
    run,
};

const PENDULUM: SphericalPendulum = SphericalPendulum { gravity: 1.0 };
const CONSTRAINED: ConstrainedPendulum = ConstrainedPendulum { gravity: 1.0 };
/// The angle from the direction downwards at the start, its rate, and the rate around the vertical.
const HANGING: f64 = 0.8;
const RATES: [f64; 2] = [0.3, 0.35];
/// The step of the long runs, and of what is drawn.
const H: f64 = 0.05;
/// The steps with which turnings and both methods are compared, the longest first.
const STEPS: [f64; 3] = [0.1, 0.05, 0.025];
/// The time at which the order is measured, and the step of the reference.
const ORDER_TIME: f64 = 8.0;
const FINE: f64 = 2e-3;
/// How long the path is drawn.
const DRAWN: f64 = 37.0;

/// Up and down with steps of one length.
struct Swings {
    extremes: [Extreme; 2],
    energy: Shadow,
    /// The place at [`ORDER_TIME`].
    place: [f64; 3],
}

/// All that is measured.
struct Measured {
    steps: u64,
    geodesic: Series,
    rattle: Series,
    rk4: Series,
    /// For each of [`STEPS`], by great circles and by RATTLE.
    swings: [Swings; 3],
    constrained: [Swings; 3],
    /// The distances from the reference at [`ORDER_TIME`]: by great circles, by their composition of order
    /// 4, and by RATTLE.
    errors: [[f64; 3]; 3],
    between_references: f64,
    path: Vec<[f64; 2]>,
}

fn run(job: &Job<'_>) -> Result<Outcome> {
    let steps: u64 = job.choose(10_000_000, 8_000);
    job.expect(3 * steps / series::EVERY);
    let fine = reference(FINE);
    let end = job.choose(400.0, 25.0);
    let [coarse, middle, short] = STEPS;
    let by_arcs = [arcs(coarse, end)?, arcs(middle, end)?, arcs(short, end)?];
    let by_chords = [chords(coarse, end)?, chords(middle, end)?, chords(short, end)?];
    let distances = |swings: &[Swings; 3]| [0, 1, 2].map(|k| distance(swings[k].place, fine));
    let measured = Measured {
        steps,
        geodesic: Series::geodesic(job, steps)?,
        rattle: Series::rattle(job, steps)?,
        rk4: Series::rk4(job, steps)?,
        errors: [distances(&by_arcs), composed(fine)?, distances(&by_chords)],
        swings: by_arcs,
        constrained: by_chords,
        between_references: distance(fine, reference(2.0 * FINE)),
        path: path()?,
    };
    job.publish(EXPERIMENT.name, picture::figure(&measured), picture::table(&measured)?)?;
    Ok(Outcome { claims: claims::claims(job, &measured), references: vec![], notes: vec![] })
}

fn begin() -> SphericalPendulumState {
    SphericalPendulum::hanging(HANGING, RATES)
}

fn trapezoid() -> Geodesic<dvi_core::discrete::Trapezoid> {
    Geodesic::trapezoid()
}

fn distance(one: [f64; 3], other: [f64; 3]) -> f64 {
    one.into_iter().zip(other).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}

/// s and ṡ.
fn entries(SphericalPendulumState { s, dot_s }: &SphericalPendulumState) -> [f64; 6] {
    [s[0], s[1], s[2], dot_s[0], dot_s[1], dot_s[2]]
}

fn state(y: &[f64; 6]) -> SphericalPendulumState {
    SphericalPendulumState { s: [y[0], y[1], y[2]], dot_s: [y[3], y[4], y[5]] }
}

/// s at [`ORDER_TIME`], by RK4.
fn reference(h: f64) -> [f64; 3] {
    let steps = (ORDER_TIME / h).round() as u64;
    let end = (0..steps).fold(entries(&begin()), |y, _| rk4(&y, h, |y| PENDULUM.motion(y)));
    state(&end).s
}

/// The distances from the reference by Suzuki's composition of steps along great circles.
fn composed(expected: [f64; 3]) -> Result<[f64; 3]> {
    fn after<M: Method<SphericalPendulum, f64>>(method: M, h: f64) -> Result<[f64; 3]> {
        let mut run = Integrator::new(&PENDULUM, method, h, begin())?;
        run.take_steps((ORDER_TIME / h).round() as u64)?;
        Ok(run.state().s)
    }
    let mut errors = [f64::NAN; 3];
    for (error, h) in errors.iter_mut().zip(STEPS) {
        *error = distance(after(Composition::suzuki(trapezoid()), h)?, expected);
    }
    Ok(errors)
}

/// Along great circles.
fn arcs(h: f64, end: f64) -> Result<Swings> {
    let mut run = Integrator::new(&PENDULUM, trapezoid(), h, begin())?;
    let next = || {
        run.advance()?;
        Ok(run.state())
    };
    Swings::new(h, end, |state| PENDULUM.shift(state), next)
}

/// By RATTLE.
fn chords(h: f64, end: f64) -> Result<Swings> {
    let start = ConstrainedPendulum::state_of(&begin());
    let mut run = Integrator::new(&CONSTRAINED, Rattle::default(), h, start)?;
    let next = || {
        run.advance()?;
        Ok(ConstrainedPendulum::on_sphere(&run.state()))
    };
    Swings::new(h, end, |state| CONSTRAINED.shift(state), next)
}

impl Swings {
    /// Of a run whose steps `next` takes, with g of the energy E − h²g that it keeps.
    fn new(
        h: f64,
        end: f64,
        shift: impl Fn(&SphericalPendulumState) -> f64,
        mut next: impl FnMut() -> Result<SphericalPendulumState, StepError>,
    ) -> Result<Self> {
        let (start, mut turnings) = (begin(), Turnings::new(h));
        let (heights, begun) = (PENDULUM.heights(&start), shift(&start));
        let (mut energy, mut place) = (Shadow::new(h, heights.energy, begun), [f64::NAN; 3]);
        let compared = (ORDER_TIME / h).round() as u64;
        for step in 1..=(end / h).round() as u64 {
            let state = next()?;
            let shift = shift(&state);
            energy.push(PENDULUM.heights(&state).energy, shift);
            turnings.push(Sample { height: state.s[2], rate: state.dot_s[2], shift });
            if step == compared {
                place = state.s;
            }
        }
        Ok(Self { extremes: turnings.against(&heights, begun), energy, place })
    }
}

/// The path from above.
fn path() -> Result<Vec<[f64; 2]>> {
    let mut run = Integrator::new(&PENDULUM, trapezoid(), H, begin())?;
    let mut path = vec![[begin().s[0], begin().s[1]]];
    for _ in 0..(DRAWN / H) as u64 {
        run.advance()?;
        path.push([run.q()[0], run.q()[1]]);
    }
    Ok(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_integrals_by_hand_are_those_of_the_declarations() {
        let heights = PENDULUM.heights(&begin());
        let run = Integrator::new(&PENDULUM, trapezoid(), H, begin()).expect("a run");
        let start = ConstrainedPendulum::state_of(&begin());
        let constrained = Integrator::new(&CONSTRAINED, Rattle::default(), H, start).expect("a run");
        for (energy, vertical) in
            [(run.energy(), run.momentum(0)), (constrained.energy(), constrained.momentum(0))]
        {
            assert!((energy - heights.energy).abs() < 1e-15);
            assert!(vertical.is_some_and(|vertical| (vertical - heights.vertical).abs() < 1e-15));
        }
    }

    #[test]
    fn the_motion_by_hand_keeps_the_integrals() {
        let steps = (ORDER_TIME / FINE).round() as u64;
        let end = (0..steps).fold(entries(&begin()), |y, _| rk4(&y, FINE, |y| PENDULUM.motion(y)));
        let (before, after) = (PENDULUM.heights(&begin()), PENDULUM.heights(&state(&end)));
        assert!((before.energy - after.energy).abs() < 1e-11);
        assert!((before.vertical - after.vertical).abs() < 1e-11);
    }
}
