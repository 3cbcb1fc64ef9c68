//! The energy in the course of one run, which may be lost.

use anyhow::Result;
use dvi_core::methods::Method;
use dvi_core::prelude::*;

use crate::deviation::Deviation;
use crate::job::Job;

/// The intervals in which deviations are drawn.
const INTERVALS: usize = 200;

pub(super) struct Series {
    pub h: f64,
    /// E/E(0) − 1.
    pub energy: Deviation,
    /// The time of the last step before the run is lost.
    pub lost: Option<f64>,
}

impl Series {
    /// With the ends of the beginning and of all.
    pub(super) fn new<S: Lagrangian, M: Method<S, f64>>(
        job: &Job<'_>,
        system: &S,
        method: M,
        start: S::State<f64>,
        h: f64,
        [early, end]: [f64; 2],
    ) -> Result<Self> {
        let mut run = Integrator::new(system, method, h, start)?;
        let begin = run.energy();
        let mut energy = Deviation::new(end, INTERVALS, early);
        let lost = job.repeat_until_lost((end / h).round() as u64, || {
            run.advance()?;
            energy.push(run.time(), run.energy() / begin - 1.0);
            Ok(())
        });
        Ok(Self { h, energy, lost: lost.map(|_| run.time()) })
    }
}
