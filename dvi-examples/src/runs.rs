//! What is read of short runs.

use anyhow::Result;
use dvi_core::methods::Method;
use dvi_core::prelude::*;

use crate::numbers::{apart, each, order_of};

/// What `of` reads of a run, at its start and after each of so many steps.
pub fn course<R: Run, T>(run: &mut R, steps: u64, mut of: impl FnMut(&R) -> T) -> Result<Vec<T>, StepError> {
    let mut course = vec![of(run)];
    for _ in 0..steps {
        run.advance()?;
        course.push(of(run));
    }
    Ok(course)
}

/// The place of a run in the plane of its first two coordinates.
pub fn place<R: Run<Scalar = f64>>(run: &R) -> [f64; 2] {
    [run.q()[0], run.q()[1]]
}

/// The state of a run after time `end`.
pub fn up_to<S: Lagrangian>(
    system: &S,
    method: impl Method<S, f64>,
    h: f64,
    start: S::State<f64>,
    end: f64,
) -> Result<S::State<f64>> {
    let mut run = Integrator::new(system, method, h, start)?;
    run.take_steps((end / h).round() as u64)?;
    Ok(run.state())
}

/// The order that errors of the coordinates show after time `end`, of runs with so many steps.
pub fn order_at<S: Lagrangian, const N: usize>(
    system: &S,
    method: impl Method<S, f64> + Clone,
    start: &S::State<f64>,
    end: f64,
    counts: [u64; N],
    error: impl Fn(&[f64]) -> f64,
) -> Result<Option<f64>> {
    order_of(counts, |steps| {
        let mut run = Integrator::new(system, method.clone(), end / steps as f64, start.clone())?;
        run.take_steps(steps)?;
        Ok((end / steps as f64, error(run.q())))
    })
}

/// The largest difference of a coordinate or velocity from the start, after steps there and as many back.
pub fn there_and_back<S: Lagrangian>(
    system: &S,
    method: impl Method<S, f64> + Clone,
    h: f64,
    start: &S::State<f64>,
    steps: u64,
) -> Result<f64> {
    let mut there = Integrator::new(system, method.clone(), h, start.clone())?;
    there.take_steps(steps)?;
    let mut back = Integrator::new_at(system, method, there.time(), -h, there.state())?;
    back.take_steps(steps)?;
    let [end, start] =
        each([&back.state(), start], |state| Ok(system.values(state)?.collect::<Vec<f64>>()))?;
    Ok(apart(&end, &start))
}

/// Iterations of a step, on average over so many of them.
pub fn iterations<S: Lagrangian>(
    system: &S,
    method: impl Method<S, f64>,
    h: f64,
    start: S::State<f64>,
    steps: u64,
) -> Result<f64> {
    let mut run = Integrator::new(system, method, h, start)?;
    run.take_steps(steps)?;
    Ok(run.statistics().iterations as f64 / steps as f64)
}
