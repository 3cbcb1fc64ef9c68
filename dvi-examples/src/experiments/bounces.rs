//! A particle that bounces on a curved floor: what its energy does over 10⁵ bounces.
//!
//! A step in which the particle reaches the floor is divided there. At the impact either the discrete energy
//! is kept, which makes the steps symplectic (Fetecau, Marsden, Ortiz & West 2003), or the energy at the
//! point of impact. The discrete energies of two flights of different lengths differ by terms of the order
//! h² from the same energy, so the first changes it at each bounce, by amounts that add up as in a random
//! walk.

mod claims;
mod picture;
mod rk4;
mod walk;

use anyhow::Result;
use dvi_core::methods::Method;
use dvi_core::prelude::*;

use crate::deviation::Deviation;
use crate::gallery::{Experiment, Outcome};
use crate::job::Job;
use crate::models::{Bouncer, BouncerState};
use rk4::Rk4;
use walk::Walk;

pub const EXPERIMENT: Experiment = Experiment {
    name: "bounces",
    title: "A particle on a curved floor: the energy over 10⁵ bounces",
    share: 13.0,
    run,
};

const FLOOR: Bouncer = Bouncer { a: 0.8 };
const START: BouncerState = BouncerState { x: 0.3, y: 1.8, dot_x: 0.4, dot_y: 0.0 };
/// The lengths of the steps of long runs.
const STEPS: [f64; 2] = [0.02, 0.01];
/// RK4 takes four forces a step.
const RK4_STEP: f64 = 4.0 * STEPS[0];
/// Up to here the particle comes down some hundred times.
const EARLY: f64 = 200.0;
/// The time at which the order is measured, and the lengths of the steps.
const ORDER_TIME: f64 = 6.0;
const ORDER_STEPS: [u64; 4] = [150, 300, 600, 1200];
/// So many step lengths near each of them: where in a step the impacts are changes the error.
const NEARBY: u64 = 6;
/// The steps of the reference.
const FINE: u64 = 4000;

/// A long run.
struct Series {
    name: &'static str,
    h: f64,
    /// E − E(0).
    energy: Deviation,
    bounces: u64,
    /// Bounces at which no impulse keeps the discrete energy.
    grazing: u64,
}

/// All that is measured.
struct Measured {
    end: f64,
    /// With the discrete energy, and with the energy at the point of impact, for each of [`STEPS`].
    variational: [Series; 2],
    reflecting: [Series; 2],
    rk4: Series,
    /// The random walks: with the discrete energy for each of [`STEPS`], with the energy at the point of
    /// impact for the longer one.
    walks: [Walk; 3],
    /// The orders of both with the trapezoidal rule, and with three Galerkin nodes.
    orders: [Option<f64>; 3],
    /// The largest difference of a coordinate or velocity from the start after [`ORDER_TIME`] there and
    /// back, of both.
    there_and_back: [f64; 2],
    /// The path of the beginning, and the impacts on it.
    path: Vec<[f64; 2]>,
    impacts: Vec<[f64; 2]>,
}

fn trapezoid(collision: Collision) -> Impacts<Verlet> {
    Impacts { collision, ..Impacts::new(Variational::trapezoid()) }
}

type Verlet = Variational<dvi_core::discrete::Unfitted, dvi_core::discrete::Trapezoid>;

fn run(job: &Job<'_>) -> Result<Outcome> {
    let end = job.choose(200_000.0, 1000.0);
    job.expect(STEPS.iter().map(|h| 2 * (end / h) as u64).sum::<u64>() + (end / RK4_STEP) as u64);
    let [coarse, fine] = STEPS;
    let series = |collision, h| Series::new(job, collision, h, end);
    let [path, impacts] = path()?;
    let measured = Measured {
        end,
        variational: [series(Collision::Variational, coarse)?, series(Collision::Variational, fine)?],
        reflecting: [series(Collision::Reflection, coarse)?, series(Collision::Reflection, fine)?],
        rk4: Series::rk4(job, RK4_STEP, end)?,
        walks: [
            Walk::new(job, Collision::Variational, coarse)?,
            Walk::new(job, Collision::Variational, fine)?,
            Walk::new(job, Collision::Reflection, coarse)?,
        ],
        orders: [
            order(trapezoid(Collision::Variational))?,
            order(trapezoid(Collision::Reflection))?,
            order(Impacts::reflecting(Galerkin::<3>::new()))?,
        ],
        there_and_back: [there_and_back(Collision::Variational)?, there_and_back(Collision::Reflection)?],
        path,
        impacts,
    };
    job.publish(EXPERIMENT.name, picture::figure(&measured), picture::table(&measured)?)?;
    Ok(Outcome { claims: claims::claims(job, &measured), references: vec![], notes: vec![] })
}

impl Series {
    fn empty(name: &'static str, h: f64, end: f64) -> Self {
        Self { name, h, energy: Deviation::new(end, 300, EARLY), bounces: 0, grazing: 0 }
    }

    fn new(job: &Job<'_>, collision: Collision, h: f64, end: f64) -> Result<Self> {
        let name = match collision {
            Collision::Variational => "discrete energy",
            Collision::Reflection => "energy at the impact",
        };
        let mut series = Self::empty(name, h, end);
        let mut run = Integrator::new(&FLOOR, trapezoid(collision), h, START)?;
        let begin = run.energy();
        job.repeat((end / h) as u64, || {
            run.advance()?;
            series.energy.push(run.time(), run.energy() - begin);
            Ok(())
        })?;
        (series.bounces, series.grazing) = (run.memory().total(), run.memory().grazing());
        Ok(series)
    }

    /// The same by RK4, with impacts that keep the energy.
    fn rk4(job: &Job<'_>, h: f64, end: f64) -> Result<Self> {
        let mut series = Self::empty("RK4", h, end);
        let mut run = Rk4::new(&FLOOR, &START);
        let (begin, mut steps) = (run.energy(), 0_u32);
        job.repeat((end / h) as u64, || {
            run.step(h);
            steps += 1;
            series.energy.push(f64::from(steps) * h, run.energy() - begin);
            Ok(())
        })?;
        series.bounces = run.bounces();
        Ok(series)
    }
}

/// The state at [`ORDER_TIME`].
fn after<M: Method<Bouncer, f64>>(method: M, steps: u64) -> Result<[f64; 4]> {
    let mut run = Integrator::new(&FLOOR, method, ORDER_TIME / steps as f64, START)?;
    run.take_steps(steps)?;
    let BouncerState { x, y, dot_x, dot_y } = run.state();
    Ok([x, y, dot_x, dot_y])
}

fn order<M: Method<Bouncer, f64> + Copy>(method: M) -> Result<Option<f64>> {
    let expected = after(Impacts::reflecting(Galerkin::<5>::new()), FINE)?;
    let mut errors = Vec::new();
    for steps in ORDER_STEPS {
        for nearby in 0..NEARBY {
            let steps = steps + steps * nearby / (2 * NEARBY);
            errors.push((ORDER_TIME / steps as f64, distance(after(method, steps)?, expected)));
        }
    }
    Ok(convergence_order(&errors))
}

fn distance(one: [f64; 4], other: [f64; 4]) -> f64 {
    one.into_iter().zip(other).map(|(a, b)| (a - b).abs()).fold(0.0, crate::claim::larger)
}

fn there_and_back(collision: Collision) -> Result<f64> {
    let (method, h) = (trapezoid(collision), STEPS[0]);
    let steps = (ORDER_TIME / h).round() as u64;
    let mut run = Integrator::new(&FLOOR, method, h, START)?;
    run.take_steps(steps)?;
    let mut back = Integrator::resume(&FLOOR, method, &run.checkpoint().with_step_size(-h))?;
    back.take_steps(steps)?;
    let entries = |BouncerState { x, y, dot_x, dot_y }: BouncerState| [x, y, dot_x, dot_y];
    Ok(distance(entries(back.state()), entries(START)))
}

/// The path up to t = 20, and the points of impact.
fn path() -> Result<[Vec<[f64; 2]>; 2]> {
    let mut run = Integrator::new(&FLOOR, trapezoid(Collision::Reflection), STEPS[1], START)?;
    let (mut path, mut impacts) = (vec![[START.x, START.y]], Vec::new());
    while run.time() < 20.0 {
        run.advance()?;
        for impact in run.memory().impacts() {
            let at = [impact.q()[0], impact.q()[1]];
            path.push(at);
            impacts.push(at);
        }
        path.push([run.q()[0], run.q()[1]]);
    }
    Ok([path, impacts])
}
