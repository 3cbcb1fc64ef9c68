//! One orbit: its impacts as points of the section.

use anyhow::Result;
use dvi_core::prelude::*;

use super::{COMPARED, ELLIPSE, H, Method, ORBITS, REVERSED, RoundedSquareBilliard, method};
use crate::claim::larger;
use crate::job::Job;
use crate::models::{EllipseBilliardState, RoundedSquareBilliardState};

/// More points than these make figures larger, and no clearer.
const SHOWN: usize = 3000;

pub(super) struct Orbit {
    /// The polar angle of the first impacts, over π, and the component of the velocity along the curve after
    /// it.
    pub(super) section: Vec<[f64; 2]>,
    /// The largest |gap| at an impact.
    pub(super) gap: f64,
    /// The largest |E − E(0)| at the end of a step.
    pub(super) energy: f64,
    /// The same of the product of the angular momenta about the foci, in the ellipse.
    pub(super) product: f64,
    /// The largest number of impacts in a step.
    pub(super) in_a_step: usize,
    pub(super) impacts: u64,
}

/// The component of `v` along the curve, for the direction `normal` into it.
fn along(v: &[f64], normal: [f64; 2]) -> f64 {
    (v[0] * normal[1] - v[1] * normal[0]) / normal[0].hypot(normal[1]) / v[0].hypot(v[1])
}

/// Where an orbit crosses the x axis, as a part of its half length, and the angle of its velocity there.
fn begin(number: u32) -> (f64, f64) {
    let part = (f64::from(number) + 0.5) / f64::from(ORBITS);
    (0.95 * part, 0.5 * std::f64::consts::PI * (1.0 - 0.6 * part))
}

impl Orbit {
    pub(super) fn in_ellipse(job: &Job<'_>, number: u32, h: f64, impacts: u64) -> Result<Self> {
        let [a2, b2] = [ELLIPSE.a, ELLIPSE.b].map(|half| half * half);
        let mut run = Integrator::new(&ELLIPSE, method(Collision::Reflection), h, start(number))?;
        Self::of(job, &mut run, impacts, |x, y| {
            (1.0 - x * x / a2 - y * y / b2, [-2.0 * x / a2, -2.0 * y / b2])
        })
    }

    pub(super) fn in_square(job: &Job<'_>, number: u32, h: f64, impacts: u64) -> Result<Self> {
        let EllipseBilliardState { x, y, dot_x, dot_y } = start(number);
        let start = RoundedSquareBilliardState { x: x / ELLIPSE.a, y, dot_x, dot_y };
        let mut run = Integrator::new(&RoundedSquareBilliard, method(Collision::Reflection), h, start)?;
        Self::of(job, &mut run, impacts, |x, y| {
            (1.0 - x.powi(4) - y.powi(4), [-4.0 * x.powi(3), -4.0 * y.powi(3)])
        })
    }

    fn of<S: UnilateralLagrangian>(
        job: &Job<'_>,
        run: &mut Integrator<'_, S, Method>,
        impacts: u64,
        curve: impl Fn(f64, f64) -> (f64, [f64; 2]),
    ) -> Result<Self> {
        let (energy, product) = (run.energy(), run.momentum(0));
        let mut orbit =
            Self { section: Vec::new(), gap: 0.0, energy: 0.0, product: 0.0, in_a_step: 0, impacts: 0 };
        while orbit.impacts < impacts && !job.is_stopping() {
            run.advance()?;
            let of_step = run.memory().impacts();
            for impact in of_step {
                let (x, y) = (impact.q()[0], impact.q()[1]);
                let (gap, normal) = curve(x, y);
                orbit.gap = larger(orbit.gap, gap.abs());
                if orbit.section.len() < SHOWN {
                    orbit.section.push([y.atan2(x) / std::f64::consts::PI, along(impact.v(), normal)]);
                }
            }
            orbit.in_a_step = orbit.in_a_step.max(of_step.len());
            orbit.impacts = run.memory().total();
            orbit.energy = larger(orbit.energy, (run.energy() - energy).abs());
            if let (Some(now), Some(begin)) = (run.momentum(0), product) {
                orbit.product = larger(orbit.product, (now - begin).abs());
            }
            job.proceed(of_step.len() as u64);
        }
        if orbit.impacts < impacts {
            job.cut_short();
        }
        Ok(orbit)
    }
}

impl Orbit {
    /// The part of the squares, twenty in each direction, that the points of the section visit.
    pub(super) fn filled(&self) -> f64 {
        let place = |value: f64| (((value + 1.0) * 10.0) as usize).min(19);
        let mut visited = [false; 400];
        for &[angle, along] in &self.section {
            visited[20 * place(angle) + place(along)] = true;
        }
        visited.iter().filter(|&&is_visited| is_visited).count() as f64 / 400.0
    }
}

fn start(number: u32) -> EllipseBilliardState {
    let (part, angle) = begin(number);
    EllipseBilliardState { x: part * ELLIPSE.a, y: 0.0, dot_x: angle.cos(), dot_y: angle.sin() }
}

/// The largest difference of the states of two runs with the two laws of impact.
pub(super) fn distance_of_laws() -> Result<f64> {
    let run = |collision| Integrator::new(&ELLIPSE, method(collision), H, start(3));
    let (mut one, mut other) = (run(Collision::Variational)?, run(Collision::Reflection)?);
    let mut largest = 0.0;
    while one.memory().total() < COMPARED {
        one.advance()?;
        other.advance()?;
        largest = larger(largest, (one.q()[0] - other.q()[0]).hypot(one.q()[1] - other.q()[1]));
    }
    Ok(largest)
}

/// The distance from the start in the rounded square after some impacts there and back.
pub(super) fn there_and_back() -> Result<f64> {
    let start = RoundedSquareBilliardState { x: 0.3, y: 0.1, dot_x: 0.8, dot_y: 0.6 };
    let method = method(Collision::Variational);
    let mut run = Integrator::new(&RoundedSquareBilliard, method, H, start)?;
    while run.memory().total() < REVERSED {
        run.advance()?;
    }
    let checkpoint = run.checkpoint().with_step_size(-H);
    let mut back = Integrator::resume(&RoundedSquareBilliard, method, &checkpoint)?;
    back.take_steps(run.steps())?;
    Ok((back.state().x - start.x).hypot(back.state().y - start.y))
}
