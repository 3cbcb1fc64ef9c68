//! The problems, and the methods on each of them with their numbers of steps.

use std::f64::consts::TAU;

use anyhow::Result;
use dvi_core::Lagrangian;
use dvi_core::methods::Method;
use dvi_core::prelude::*;

use super::{Course, noted};
use crate::job::Job;
use crate::models::{
    Case, FourPoints, FourVortices, Kepler, KeplerState, Orbit, OuterPlanets, OuterSolarSystem,
    outer_solar_system, quasi_periodic,
};

pub const SECOND: &str = "order 2";
pub const RK4: &str = "RK4";
pub const KAHAN_LI: &str = "Kahan–Li 8";
pub const GAUSS_4: &str = "Gauss 4";
pub const GAUSS_8: &str = "Gauss 8";
pub const GAUSS_16: &str = "Gauss 16";

/// A motion up to one time.
pub struct Problem {
    pub name: &'static str,
    pub title: String,
    pub contenders: Vec<Contender>,
}

/// A method over its numbers of steps.
pub struct Contender {
    pub name: &'static str,
    pub counts: Vec<u64>,
    pub run: Box<Steps>,
}

/// A run with a number of steps.
type Steps = dyn Fn(&Job<'_>, u64) -> Result<Course> + Send + Sync;

impl Problem {
    /// All steps of all runs.
    pub fn steps(&self) -> u64 {
        self.contenders.iter().flat_map(|contender| &contender.counts).sum()
    }
}

/// A system with its start and the time at which runs end.
struct Setting<S: Lagrangian> {
    begin: fn() -> (S, S::State<f64>),
    end: f64,
    sizes: Sizes,
}

/// How many runs a method gets.
#[derive(Clone, Copy)]
struct Sizes {
    runs: u32,
    ratio: f64,
}

impl<S: Lagrangian + 'static> Setting<S> {
    /// `method` with up to `most` steps, in the ratios of the setting.
    fn with<M>(&self, name: &'static str, stages: u64, method: M, most: f64) -> Contender
    where
        M: Method<S, f64> + Clone + Send + Sync + 'static,
    {
        let (begin, end, Sizes { runs, ratio }) = (self.begin, self.end, self.sizes);
        let counts = (0..runs).rev().map(|k| (most / ratio.powi(k as i32)).round() as u64).collect();
        Contender {
            name,
            counts,
            run: Box::new(move |job, steps| {
                let course = follow(job, begin(), method.clone(), end, steps)?;
                Ok(Course { stages, ..course })
            }),
        }
    }
}

/// One run, its energy looked at after each step.
fn follow<S: Lagrangian, M: Method<S, f64>>(
    job: &Job<'_>,
    (system, start): (S, S::State<f64>),
    method: M,
    end: f64,
    steps: u64,
) -> Result<Course> {
    let mut run = Integrator::new(&system, method, end / steps as f64, start)?;
    let (initial, mut error) = (run.energy(), 0.0);
    job.repeat(steps, || {
        run.advance()?;
        error = noted(error, run.energy(), initial);
        Ok(())
    })?;
    let statistics = run.statistics();
    Ok(Course { steps, evaluations: statistics.gradients + statistics.linearizations, stages: 1, error })
}

/// The three problems, in full length and with many runs, or shorter and with few.
pub fn all(job: &Job<'_>) -> Vec<Problem> {
    let sizes = job.choose(Sizes { runs: 33, ratio: 2f64.powf(0.25) }, Sizes { runs: 5, ratio: 4.0 });
    let share = job.choose(1.0, 0.05);
    vec![vortices(sizes, share), kepler(sizes, share), planets(sizes, share)]
}

fn vortices(sizes: Sizes, share: f64) -> Problem {
    let begin = || -> (FourVortices, FourPoints) {
        let Case { vortices, start } = quasi_periodic();
        (vortices, start)
    };
    let setting = Setting { begin, end: 1000.0 * share, sizes };
    let composed = Composition::kahan_li_8(Gauss::<1>::new());
    Problem {
        name: "vortices",
        title: format!("Four vortices, up to *t* = {}", setting.end),
        contenders: vec![
            setting.with(SECOND, 1, Sigma::midpoint(), 1e6 * share),
            setting.with(RK4, 1, RungeKutta::classical(), 3e5 * share),
            setting.with(KAHAN_LI, 1, composed, 2e4 * share),
            setting.with(GAUSS_4, 2, Gauss::<2>::new(), 2e5 * share),
            setting.with(GAUSS_8, 4, Gauss::<4>::new(), 2e4 * share),
            setting.with(GAUSS_16, 8, Gauss::<8>::new(), 4e3 * share),
        ],
    }
}

fn kepler(sizes: Sizes, share: f64) -> Problem {
    let begin = || -> (Kepler, KeplerState) { (Kepler {}, Orbit { e: 0.6 }.pericentre()) };
    // Compensated sums, as those of Gauss collocation are.
    let verlet = Variational { summation: Summation::Compensated, ..Variational::trapezoid() };
    let periods = (100.0 * share).round();
    let setting = Setting { begin, end: TAU * periods, sizes };
    Problem {
        name: "kepler",
        title: format!("Kepler orbit, *e* = 0.6, {periods} periods"),
        contenders: vec![
            setting.with(SECOND, 1, verlet, 2e6 * share),
            setting.with(RK4, 1, RungeKutta::classical(), 5e5 * share),
            setting.with(KAHAN_LI, 1, Composition::kahan_li_8(verlet), 4e4 * share),
            setting.with(GAUSS_4, 2, Gauss::<2>::new(), 4e5 * share),
            setting.with(GAUSS_8, 4, Gauss::<4>::new(), 4e4 * share),
            setting.with(GAUSS_16, 8, Gauss::<8>::new(), 8e3 * share),
        ],
    }
}

fn planets(sizes: Sizes, share: f64) -> Problem {
    let begin: fn() -> (OuterSolarSystem, OuterPlanets) = outer_solar_system;
    let setting = Setting { begin, end: 1e6 * share, sizes };
    // Compensated sums, as those of Gauss collocation are.
    let verlet = Variational { summation: Summation::Compensated, ..Variational::trapezoid() };
    let title = if share == 1.0 { "10⁶".to_owned() } else { format!("{}", setting.end) };
    Problem {
        name: "planets",
        title: format!("Outer solar system, {title} days"),
        contenders: vec![
            setting.with(SECOND, 1, verlet, 1e6 * share),
            setting.with(RK4, 1, RungeKutta::classical(), 2e5 * share),
            setting.with(KAHAN_LI, 1, Composition::kahan_li_8(verlet), 2e4 * share),
            setting.with(GAUSS_4, 2, Gauss::<2>::new(), 2e5 * share),
            setting.with(GAUSS_8, 4, Gauss::<4>::new(), 2e4 * share),
            setting.with(GAUSS_16, 8, Gauss::<8>::new(), 4e3 * share),
        ],
    }
}
