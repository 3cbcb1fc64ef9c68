//! Long runs: the angular momentum in space and in the body, the energy, and how far the matrix is from a
//! rotation.

use anyhow::Result;
use dvi_core::error::StepError;
use dvi_core::prelude::*;
use dvi_core::rotations;

use super::{BODY, H, begin, entries, length, rk4, state};
use crate::deviation::Deviation;
use crate::experiments::watch::Watch;
use crate::job::Job;
use crate::models::RigidBodyState;

/// So many steps from one look at the integrals to the next.
pub(super) const EVERY: u64 = 4;

pub(super) struct Series {
    pub name: &'static str,
    /// E − E(0).
    pub energy: Deviation,
    /// |M − M(0)|/|M| of the angular momentum in space.
    pub space: Deviation,
    /// The length of the angular momentum in the body over that at the start, less 1.
    pub body: Deviation,
    /// max |RᵀR − 1| over the entries.
    pub defect: Deviation,
}

impl Series {
    pub(super) fn geodesic(job: &Job<'_>, steps: u64) -> Result<Self> {
        let mut run = Integrator::new(&BODY, Geodesic::trapezoid(), H, begin())?;
        Self::of(job, "geodesics", steps, || {
            run.take_steps(EVERY)?;
            Ok(run.state())
        })
    }

    pub(super) fn rk4(job: &Job<'_>, steps: u64) -> Result<Self> {
        let mut y = entries(&begin());
        Self::of(job, "RK4", steps, || {
            y = (0..EVERY).fold(y, |y, _| rk4(&y, H, |y| BODY.motion(y)));
            Ok(state(&y))
        })
    }

    fn of(
        job: &Job<'_>,
        name: &'static str,
        steps: u64,
        later: impl FnMut() -> Result<RigidBodyState, StepError>,
    ) -> Result<Self> {
        let end = steps as f64 * H;
        let deviation = || Deviation::new(end, 300, end);
        let mut series =
            Self { name, energy: deviation(), space: deviation(), body: deviation(), defect: deviation() };
        let start = begin();
        let watch = Watch { steps, every: EVERY, h: H };
        watch.run(job, later, |t, state| series.note(t, &start, state))?;
        Ok(series)
    }

    fn note(&mut self, t: f64, start: &RigidBodyState, state: &RigidBodyState) {
        let [before, now] = [start, state].map(|state| BODY.momentum_at(state));
        let [first, here] = [(start, before), (state, now)].map(|(state, m)| rotations::apply(&state.R, m));
        let away = length([0, 1, 2].map(|k| here[k] - first[k]));
        self.energy.push(t, energy(state) - energy(start));
        self.space.push(t, away / length(first));
        self.body.push(t, length(now) / length(before) - 1.0);
        self.defect.push(t, rotations::defect(&state.R));
    }
}

fn energy(state: &RigidBodyState) -> f64 {
    let momentum = BODY.momentum_at(state);
    momentum.into_iter().zip(state.omega_R).map(|(m, omega)| 0.5 * m * omega).sum()
}
