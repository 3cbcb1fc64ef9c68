//! Where the equation for the length of a step has no solution: the trapezoidal rule on the spring.

use anyhow::{Context as _, Result, bail};
use dvi_core::prelude::*;

use super::series::square;
use super::{ON_SPRING, START};
use crate::claim::larger;
use crate::models::{StiffeningSpring, StiffeningSpringState};

/// A state at which a length is sought, and E_d − e over the lengths.
#[derive(Clone, Debug)]
pub(super) struct Sought {
    state: StiffeningSpringState,
    energy: f64,
    pub curve: Vec<[f64; 2]>,
}

/// The last step of the run, and the one that it cannot take.
#[derive(Clone, Debug)]
pub(super) struct Ending {
    pub steps: u64,
    pub time: f64,
    pub last: Sought,
    pub failed: Sought,
    /// The length of the last step.
    pub length: f64,
    /// The length that the control has found to be the best, with its defect.
    pub best: f64,
    pub defect: f64,
}

/// The most steps that the run may take.
const MOST: u64 = 1000;
/// Lengths up to so many times that of the step before are tried: as far as the control seeks.
pub(super) const REACH: f64 = 4.0;
/// Lengths on a curve.
const POINTS: u32 = 4000;

impl Ending {
    pub(super) fn new() -> Result<Self> {
        let (rule, control) = (Variational::trapezoid(), EnergyMomentum::new(ON_SPRING[0]));
        let mut run = ControlledIntegrator::new(&StiffeningSpring {}, rule, control, START)?;
        let mut before = None;
        let mut step = || {
            let sought = (run.state(), run.step_size());
            run.advance()?;
            before = Some(sought);
            Ok::<(), StepError>(())
        };
        let ended = (0..MOST).try_for_each(|_| step());
        let failure = ended.err().context("the run with the trapezoidal rule has not ended")?.failure;
        let StepFailure::EnergyStep { h, defect } = failure else { bail!(failure) };
        let energy = run.control_memory().discrete_energy().context("no step was taken")?;
        let (state, length) = before.context("no step was taken")?;
        Ok(Self {
            steps: run.steps(),
            time: run.time(),
            last: Sought::new(state, energy, length),
            failed: Sought::new(run.state(), energy, run.step_size()),
            length: run.step_size(),
            best: h,
            defect,
        })
    }
}

impl Sought {
    /// With `before`, the length of the step before.
    fn new(state: StiffeningSpringState, energy: f64, before: f64) -> Self {
        let mut sought = Self { state, energy, curve: Vec::new() };
        let lengths = (1..=POINTS).map(|k| REACH * before * f64::from(k) / f64::from(POINTS));
        sought.curve = lengths.map(|h| [h, sought.defect(h)]).collect();
        sought
    }

    /// E_d − e of a step of length `h`: q1 = q + h(p − ½h∇V(q)), and E_d = ½|Δ/h|² + ½(V(q) + V(q1)).
    pub(super) fn defect(&self, h: f64) -> f64 {
        let StiffeningSpringState { x, y, dot_x, dot_y } = self.state;
        let (q, p) = ([x, y], [dot_x, dot_y]);
        let slope = 1.0 + square(q);
        let velocity: [f64; 2] = std::array::from_fn(|i| p[i] - 0.5 * h * slope * q[i]);
        let q1: [f64; 2] = std::array::from_fn(|i| q[i] + h * velocity[i]);
        let potential = |q: [f64; 2]| 0.5 * square(q) + 0.25 * square(q).powi(2);
        0.5 * square(velocity) + 0.5 * (potential(q) + potential(q1)) - self.energy
    }

    /// The smallest E_d − e within reach; not more than zero if there is a solution.
    pub(super) fn smallest(&self) -> f64 {
        self.curve.iter().map(|[_, defect]| *defect).fold(f64::INFINITY, |a, b| -larger(-a, -b))
    }
}
