//! Long runs: the integrals, and the length of the rod.

use anyhow::Result;
use dvi_core::error::StepError;
use dvi_core::prelude::*;

use super::{CONSTRAINED, H, PENDULUM, begin, entries, rk4, state, trapezoid};
use crate::deviation::Deviation;
use crate::experiments::watch::Watch;
use crate::job::Job;
use crate::models::{ConstrainedPendulum, Heights, SphericalPendulumState};

/// So many steps from one look at the integrals to the next.
pub(super) const EVERY: u64 = 4;

pub(super) struct Series {
    pub name: &'static str,
    /// E − E(0).
    pub energy: Deviation,
    /// |s|² − 1.
    pub length: Deviation,
    /// The angular momentum about the vertical, relative.
    pub vertical: Deviation,
}

impl Series {
    pub(super) fn geodesic(job: &Job<'_>, steps: u64) -> Result<Self> {
        let mut run = Integrator::new(&PENDULUM, trapezoid(), H, begin())?;
        Self::of(job, "great circles", steps, || {
            run.take_steps(EVERY)?;
            Ok(run.state())
        })
    }

    pub(super) fn rattle(job: &Job<'_>, steps: u64) -> Result<Self> {
        let start = ConstrainedPendulum::state_of(&begin());
        let mut run = Integrator::new(&CONSTRAINED, Rattle::default(), H, start)?;
        Self::of(job, "RATTLE", steps, || {
            run.take_steps(EVERY)?;
            Ok(ConstrainedPendulum::on_sphere(&run.state()))
        })
    }

    pub(super) fn rk4(job: &Job<'_>, steps: u64) -> Result<Self> {
        let mut y = entries(&begin());
        Self::of(job, "RK4", steps, || {
            y = (0..EVERY).fold(y, |y, _| rk4(&y, H, |y| PENDULUM.motion(y)));
            Ok(state(&y))
        })
    }

    fn of(
        job: &Job<'_>,
        name: &'static str,
        steps: u64,
        later: impl FnMut() -> Result<SphericalPendulumState, StepError>,
    ) -> Result<Self> {
        let end = steps as f64 * H;
        let deviation = || Deviation::new(end, 300, end);
        let mut series = Self { name, energy: deviation(), length: deviation(), vertical: deviation() };
        let before = PENDULUM.heights(&begin());
        let watch = Watch { steps, every: EVERY, h: H };
        watch.run(job, later, |t, state| series.note(t, &before, state))?;
        Ok(series)
    }

    fn note(&mut self, t: f64, before: &Heights, state: &SphericalPendulumState) {
        let now = PENDULUM.heights(state);
        self.energy.push(t, now.energy - before.energy);
        self.length.push(t, state.s.iter().map(|x| x * x).sum::<f64>() - 1.0);
        self.vertical.push(t, now.vertical / before.vertical - 1.0);
    }
}
