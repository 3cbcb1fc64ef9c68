//! Long runs: the integrals, and how far the matrix is from a rotation.

use anyhow::Result;
use dvi_core::error::StepError;
use dvi_core::prelude::*;
use dvi_core::rotations;

use super::{H, TOP, begin, energy, entries, rk4, state};
use crate::deviation::Deviation;
use crate::experiments::watch::Watch;
use crate::job::Job;
use crate::models::{Heights, TopState};

/// So many steps from one look at the integrals to the next.
pub(super) const EVERY: u64 = 10;

pub(super) struct Series {
    pub name: &'static str,
    /// E − E(0).
    pub energy: Deviation,
    /// max |RᵀR − 1| over the entries.
    pub defect: Deviation,
    /// The angular momenta about the axis and about the vertical, relative.
    pub spin: Deviation,
    pub vertical: Deviation,
}

impl Series {
    pub(super) fn geodesic(job: &Job<'_>, steps: u64) -> Result<Self> {
        let mut run = Integrator::new(&TOP, Geodesic::trapezoid(), H, begin())?;
        Self::of(job, "geodesics", steps, || {
            run.take_steps(EVERY)?;
            Ok(run.state())
        })
    }

    pub(super) fn rk4(job: &Job<'_>, steps: u64) -> Result<Self> {
        let mut y = entries(&begin());
        Self::of(job, "RK4", steps, || {
            y = (0..EVERY).fold(y, |y, _| rk4(&y, H, |y| TOP.motion(y)));
            Ok(state(&y))
        })
    }

    fn of(
        job: &Job<'_>,
        name: &'static str,
        steps: u64,
        later: impl FnMut() -> Result<TopState, StepError>,
    ) -> Result<Self> {
        let end = steps as f64 * H;
        let deviation = || Deviation::new(end, 300, end);
        let mut series = Self {
            name,
            energy: deviation(),
            defect: deviation(),
            spin: deviation(),
            vertical: deviation(),
        };
        let before = TOP.heights(&begin());
        let watch = Watch { steps, every: EVERY, h: H };
        watch.run(job, later, |t, state| series.note(t, &before, state))?;
        Ok(series)
    }

    fn note(&mut self, t: f64, before: &Heights, state: &TopState) {
        let now = TOP.heights(state);
        self.energy.push(t, energy(&now) - energy(before));
        self.defect.push(t, rotations::defect(&state.R));
        self.spin.push(t, now.spin / before.spin - 1.0);
        self.vertical.push(t, now.vertical / before.vertical - 1.0);
    }
}
