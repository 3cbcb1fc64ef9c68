//! What one run leaves.

use anyhow::Result;
use dvi_core::error::StartError;
use dvi_core::methods::Method;
use dvi_core::prelude::*;

use super::{ANGLE, EARLY, H, LINKS, PENDULUM};
use crate::claim::larger;
use crate::deviation::Deviation;
use crate::experiments::accelerations::Accelerations;
use crate::job::Job;
use crate::models::{Links, LinksState};

pub(super) struct Series {
    pub name: &'static str,
    /// E − E(0).
    pub energy: Deviation,
    /// The largest deviation of the length of a rod, over that length.
    pub length: Deviation,
    /// The largest difference of the velocities of the ends of a rod along it.
    pub along: Deviation,
    /// The free end after each step.
    pub tip: Vec<[f64; 2]>,
}

impl Series {
    fn new(name: &'static str, end: f64) -> Self {
        let intervals = 300;
        let [energy, length, along] = std::array::from_fn(|_| Deviation::new(end, intervals, EARLY));
        Self { name, energy, length, along, tip: Vec::new() }
    }

    pub(super) fn constrained<M: Method<Links, f64>>(
        job: &Job<'_>,
        name: &'static str,
        method: M,
        end: f64,
    ) -> Result<Self> {
        let mut run = Integrator::new(&PENDULUM, method, H, PENDULUM.bent(ANGLE))?;
        let (begin, mut series) = (run.energy(), Self::new(name, end));
        job.repeat((end / H).round() as u64, || {
            run.advance()?;
            series.note(run.time(), run.energy() - begin, &run.state());
            Ok(())
        })?;
        Ok(series)
    }

    pub(super) fn rk4(job: &Job<'_>, end: f64) -> Result<Self> {
        let mut run = Accelerations::new(&PENDULUM, H, &PENDULUM.bent(ANGLE))?;
        let (begin, mut series) = (run.energy()?, Self::new("RK4", end));
        let (mut steps, mut lost) = (0, None);
        let mut step = || -> Result<(), StartError> {
            run.step()?;
            steps += 1;
            series.note(f64::from(steps) * H, run.energy()? - begin, &run.state());
            Ok(())
        };
        job.repeat((end / H).round() as u64, || {
            if lost.is_none() {
                lost = step().err();
            }
            Ok(())
        })?;
        lost.map_or(Ok(series), |error| Err(error.into()))
    }

    fn note(&mut self, t: f64, energy: f64, state: &LinksState) {
        let LinksState { x, y, dot_x, dot_y } = state;
        let (mut before, mut length, mut along) = ([0.0; 4], 0.0, 0.0);
        for i in 0..LINKS {
            let here = [x[i], y[i], dot_x[i], dot_y[i]];
            let [x, y, dot_x, dot_y] = std::array::from_fn(|k| here[k] - before[k]);
            let found = f64::hypot(x, y);
            length = larger(length, (found / PENDULUM.rod() - 1.0).abs());
            along = larger(along, ((x * dot_x + y * dot_y) / found).abs());
            before = here;
        }
        self.energy.push(t, energy);
        self.length.push(t, length);
        self.along.push(t, along);
        self.tip.push([before[0], before[1]]);
    }

    /// The largest distance of the free end from that of another run.
    pub(super) fn apart(&self, other: &Self) -> f64 {
        super::distance(&self.tip, &other.tip)
    }
}
