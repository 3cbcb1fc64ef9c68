//! How the change of the energy grows with the number of bounces: its root mean square over many starts.

use anyhow::Result;
use dvi_core::prelude::*;

use super::{FLOOR, START, trapezoid};
use crate::job::Job;
use crate::models::BouncerState;

/// Numbers of bounces, each twice the one before.
const DOUBLINGS: u32 = 9;
const FIRST: u64 = 8;

pub(super) struct Walk {
    /// The number of bounces, and the root mean square of E − E(0) there.
    pub(super) points: Vec<[f64; 2]>,
}

impl Walk {
    pub(super) fn new(job: &Job<'_>, collision: Collision, h: f64) -> Result<Self> {
        let starts = job.choose(60, 6);
        let mut squares = [0.0; DOUBLINGS as usize];
        for k in 0..starts {
            let start = BouncerState { x: 0.3 + 0.011 * f64::from(k), ..START };
            let mut run = Integrator::new(&FLOOR, trapezoid(collision), h, start)?;
            let begin = run.energy();
            for (doubling, square) in (0..DOUBLINGS).zip(&mut squares) {
                while run.memory().total() < FIRST << doubling {
                    run.advance()?;
                }
                *square += (run.energy() - begin).powi(2) / f64::from(starts);
            }
        }
        let bounces = (0..DOUBLINGS).map(|doubling| (FIRST << doubling) as f64);
        Ok(Self { points: bounces.zip(squares).map(|(n, square): (f64, f64)| [n, square.sqrt()]).collect() })
    }

    /// The exponent of the growth with the number of bounces.
    pub(super) fn exponent(&self) -> Option<f64> {
        let points: Vec<(f64, f64)> = self.points.iter().map(|&[n, deviation]| (n, deviation)).collect();
        convergence_order(&points)
    }

    /// The root mean square after the most bounces.
    pub(super) fn last(&self) -> f64 {
        self.points.last().map_or(f64::NAN, |point| point[1])
    }
}
