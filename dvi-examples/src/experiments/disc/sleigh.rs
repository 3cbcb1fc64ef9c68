//! The sleigh, which begins backwards and in rotation, turns around, and ends straight ahead.

use anyhow::Result;
use dvi_core::prelude::*;

use super::{FINE, H, distance, midpoint, there_and_back};
use crate::claim::larger;
use crate::experiments::rk4::rk4;
use crate::models::{ChaplyginSleigh, ChaplyginSleighState};

pub(super) const SLEIGH: ChaplyginSleigh = ChaplyginSleigh { inertia: 1.0, a: 0.5 };
/// v and ω at the start.
const START: [f64; 2] = [-1.0, 2.0];
/// The steps of the runs; the path is drawn with the first.
pub(super) const STEPS: [f64; 4] = [H, H / 2.0, H / 4.0, H / 8.0];
/// The time at which runs are compared and turned around, and that of straight motion.
const TURNED: f64 = 8.0;
pub(super) const STRAIGHT: f64 = 24.0;

/// What runs with each of [`STEPS`] leave.
pub(super) struct Sleigh {
    /// The places with the longest step.
    pub path: Vec<[f64; 2]>,
    /// The same in the motion, by RK4.
    pub motion: Vec<[f64; 2]>,
    /// |ω| with the longest step, and in the motion.
    pub turning: Vec<[f64; 2]>,
    pub turning_of_motion: Vec<[f64; 2]>,
    /// The distances from the motion at [`TURNED`].
    pub errors: [f64; 4],
    /// E/E(0) − 1 when it moves straight ahead.
    pub energies: [f64; 4],
    /// The largest relative difference of two energies after [`TURNED`], with the longest step.
    pub late: f64,
    /// The rate at which ω decays between the two times with the longest step, over av/(I + a²) for the
    /// speed v at the end.
    pub decay: f64,
    /// The largest difference of a coordinate or velocity from the start, after steps there and back.
    pub there_and_back: f64,
}

impl Sleigh {
    pub(super) fn new() -> Result<Self> {
        let (motion, turning_of_motion) = motion(TURNED + 4.0);
        let mut sleigh = Self {
            path: Vec::new(),
            turning: Vec::new(),
            errors: [f64::NAN; 4],
            energies: [f64::NAN; 4],
            late: 0.0,
            decay: f64::NAN,
            there_and_back: there_and_back(&SLEIGH, &begin(), (TURNED / H).round() as u64)?,
            motion,
            turning_of_motion,
        };
        let at = (TURNED / FINE).round() as usize;
        let expected = sleigh.motion.get(at).copied().unwrap_or([f64::NAN; 2]);
        for (k, h) in STEPS.into_iter().enumerate() {
            let mut run = Integrator::new(&SLEIGH, midpoint(), h, begin())?;
            let energy = run.energy();
            run.take_steps((TURNED / h).round() as u64)?;
            let state = run.state();
            sleigh.errors[k] = distance([state.x, state.y], expected);
            let (turned, late) = (run.energy(), state.dot_theta);
            for _ in 0..((STRAIGHT - TURNED) / h).round() as u64 {
                run.advance()?;
                if k == 0 {
                    sleigh.late = larger(sleigh.late, (run.energy() / turned - 1.0).abs());
                }
            }
            sleigh.energies[k] = run.energy() / energy - 1.0;
            let end = run.state();
            let rate = SLEIGH.a * end.dot_x.hypot(end.dot_y) / (SLEIGH.inertia + SLEIGH.a.powi(2));
            if k == 0 {
                sleigh.decay = (late / end.dot_theta).abs().ln() / ((STRAIGHT - TURNED) * rate);
            }
        }
        sleigh.follow()?;
        Ok(sleigh)
    }

    /// What is drawn.
    fn follow(&mut self) -> Result<()> {
        let h = STEPS[0];
        let mut run = Integrator::new(&SLEIGH, midpoint(), h, begin())?;
        self.path.push([0.0; 2]);
        self.turning.push([0.0, START[1].abs()]);
        for _ in 0..((TURNED + 4.0) / h).round() as u64 {
            run.advance()?;
            let ChaplyginSleighState { x, y, dot_theta, .. } = run.state();
            self.path.push([x, y]);
            self.turning.push([run.time(), dot_theta.abs()]);
        }
        Ok(())
    }
}

fn begin() -> ChaplyginSleighState {
    ChaplyginSleigh::sliding(START[0], START[1])
}

/// The places and |ω| at multiples of [`FINE`].
fn motion(end: f64) -> (Vec<[f64; 2]>, Vec<[f64; 2]>) {
    let mut y = [0.0, 0.0, 0.0, START[0], START[1]];
    let (mut places, mut turning) = (vec![[0.0; 2]], vec![[0.0, START[1].abs()]]);
    for step in 1..=(end / FINE).round() as u32 {
        y = rk4(&y, FINE, |y| SLEIGH.reduced(y));
        places.push([y[0], y[1]]);
        turning.push([f64::from(step) * FINE, y[4].abs()]);
    }
    (places, turning)
}
