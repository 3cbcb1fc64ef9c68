//! A pendulum of 50 links, by constraints: each rod is an equation, and no angle occurs.
//!
//! Positions stay on the constraints and velocities along them to rounding, and the energy does not drift
//! (Wendlandt & Marsden 1997; Leimkuhler & Skeel 1994). RK4 on the equations of motion with the
//! accelerations at each state does neither. The potential is linear, so that RATTLE and the constrained
//! steps of the trapezoidal and of the midpoint rule are one method, which three codes compute.

mod claims;
mod picture;
mod series;

use anyhow::Result;
use dvi_core::discrete::{Midpoint, Trapezoid, Unfitted};
use dvi_core::methods::Method;
use dvi_core::prelude::*;

use crate::claim::larger;
use crate::experiments::accelerations::Accelerations;
use crate::gallery::{Experiment, Outcome};
use crate::job::Job;
use crate::models::{Links, LinksState};
use series::Series;

pub const EXPERIMENT: Experiment = Experiment {
    name: "links",
    title: "A pendulum of 50 links by constraints, beside RK4 on its accelerations",
    share: 25.0,
    run,
};

/// How many links there are.
const LINKS: usize = 50;
/// The angle of the last link at the start.
const ANGLE: f64 = 0.5;
const PENDULUM: Links = Links { n: LINKS };
const H: f64 = 0.01;
/// The end of the beginning, with which the whole is compared.
const EARLY: f64 = 5.0;
/// The length of the steps whose iterations are compared, and the numbers of links.
const COUNTED: f64 = 0.005;
const COUNTED_LINKS: [usize; 3] = [25, 50, 100];
/// The time at which the order is measured, the steps, and that of the reference.
const ORDER_TIME: f64 = 2.0;
const ORDER_STEPS: [f64; 4] = [0.02, 0.01, 0.005, 0.0025];
const FINE: f64 = 0.00125;

type Shape = Vec<[f64; 2]>;

/// All that is measured.
struct Measured {
    end: f64,
    rattle: Series,
    trapezoid: Series,
    midpoint: Series,
    rk4: Series,
    /// The pendulum at some times.
    instants: Vec<(f64, Shape)>,
    /// Iterations of a step with 25, 50 and 100 links: trapezoid, midpoint, RATTLE.
    iterations: [[f64; 3]; 3],
    /// The distances of the masses from the reference at [`ORDER_TIME`], for each of [`ORDER_STEPS`]: the
    /// same methods.
    errors: [[f64; 4]; 3],
    /// The distance of two references.
    between_references: f64,
}

fn run(job: &Job<'_>) -> Result<Outcome> {
    let end = job.choose(300.0, 6.0);
    job.expect(4 * (end / H).round() as u64);
    let fine = reference(FINE)?;
    let measured = Measured {
        end,
        rattle: Series::constrained(job, "RATTLE", Rattle::default(), end)?,
        trapezoid: Series::constrained(job, "constrained trapezoid", trapezoid(), end)?,
        midpoint: Series::constrained(job, "constrained midpoint", midpoint(), end)?,
        rk4: Series::rk4(job, end)?,
        instants: instants()?,
        iterations: iterations(job)?,
        errors: [errors(trapezoid(), &fine)?, errors(midpoint(), &fine)?, errors(Rattle::default(), &fine)?],
        between_references: distance(&fine, &reference(2.0 * FINE)?),
    };
    job.publish(EXPERIMENT.name, picture::figure(&measured), picture::table(&measured)?)?;
    Ok(Outcome { claims: claims::claims(job, &measured), references: vec![], notes: vec![] })
}

fn trapezoid() -> Constrained<Variational<Unfitted, Trapezoid>> {
    Constrained::new(Variational::trapezoid())
}

fn midpoint() -> Constrained<Variational<Unfitted, Midpoint>> {
    Constrained::new(Variational::midpoint())
}

/// Where the masses are.
fn shape(state: &LinksState) -> Shape {
    state.x.iter().zip(&state.y).map(|(&x, &y)| [x, y]).collect()
}

/// The largest distance of a mass of one from the same mass of the other.
fn distance(one: &[[f64; 2]], other: &[[f64; 2]]) -> f64 {
    let apart = one.iter().zip(other).map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1]));
    apart.fold(0.0, larger)
}

/// The masses at [`ORDER_TIME`].
fn after<M: Method<Links, f64>>(method: M, h: f64) -> Result<Shape> {
    let mut run = Integrator::new(&PENDULUM, method, h, PENDULUM.bent(ANGLE))?;
    run.take_steps((ORDER_TIME / h).round() as u64)?;
    Ok(shape(&run.state()))
}

/// The same by RK4.
fn reference(h: f64) -> Result<Shape> {
    let mut run = Accelerations::new(&PENDULUM, h, &PENDULUM.bent(ANGLE))?;
    for _ in 0..(ORDER_TIME / h).round() as u64 {
        run.step()?;
    }
    Ok(shape(&run.state()))
}

fn errors<M: Method<Links, f64> + Clone>(method: M, reference: &[[f64; 2]]) -> Result<[f64; 4]> {
    let mut errors = [f64::NAN; 4];
    for (error, h) in errors.iter_mut().zip(ORDER_STEPS) {
        *error = distance(&after(method.clone(), h)?, reference);
    }
    Ok(errors)
}

/// The pendulum at equal times over half a swing.
fn instants() -> Result<Vec<(f64, Shape)>> {
    let mut run = Integrator::new(&PENDULUM, trapezoid(), H, PENDULUM.bent(ANGLE))?;
    let mut instants = vec![(0.0, shape(&run.state()))];
    for _ in 0..5 {
        run.take_steps(50)?;
        instants.push((run.time(), shape(&run.state())));
    }
    Ok(instants)
}

fn iterations(job: &Job<'_>) -> Result<[[f64; 3]; 3]> {
    fn of<M: Method<Links, f64>>(n: usize, method: M, steps: u64) -> Result<f64> {
        let system = Links { n };
        let mut run = Integrator::new(&system, method, COUNTED, system.bent(ANGLE))?;
        run.take_steps(steps)?;
        Ok(run.statistics().iterations as f64 / steps as f64)
    }
    let mut iterations = [[f64::NAN; 3]; 3];
    let steps = job.choose(1000, 10);
    for (all, n) in iterations.iter_mut().zip(COUNTED_LINKS) {
        *all = [of(n, trapezoid(), steps)?, of(n, midpoint(), steps)?, of(n, Rattle::default(), steps)?];
    }
    Ok(iterations)
}
