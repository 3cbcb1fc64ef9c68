//! What one long run leaves.

use anyhow::Result;
use dvi_core::methods::Method;
use dvi_core::prelude::*;

use super::{CENTRES, CHAIN, H};
use crate::claim::larger;
use crate::deviation::Deviation;
use crate::job::Job;
use crate::models::SpringChain;

/// The intervals in which deviations are drawn.
const INTERVALS: usize = 300;

pub(super) struct Series {
    pub name: &'static str,
    /// E − E(0).
    pub energy: Deviation,
    /// I − I(0), where I is the sum of the energies of the stiff springs with the stiffness of the method.
    pub sum: Deviation,
    /// I/I(0) at t = 20.
    pub left: f64,
}

impl Series {
    pub(super) fn new<M: Method<SpringChain, f64>>(
        job: &Job<'_>,
        name: &'static str,
        method: M,
        stiffness: f64,
        end: f64,
    ) -> Result<Self> {
        let mut run = Integrator::new(&CHAIN, method, H, CHAIN.first_pair(CENTRES[0]))?;
        let sum =
            |run: &Integrator<'_, _, M>| -> f64 { CHAIN.oscillatory(&run.state(), stiffness).iter().sum() };
        let (energy, begin) = (run.energy(), sum(&run));
        let deviation = || Deviation::new(end, INTERVALS, 0.01 * end);
        let mut series = Self { name, energy: deviation(), sum: deviation(), left: f64::NAN };
        let mut steps = 0;
        job.repeat((end / H).round() as u64, || {
            run.advance()?;
            let (t, now) = (run.time(), sum(&run));
            series.energy.push(t, run.energy() - energy);
            series.sum.push(t, now - begin);
            steps += 1;
            if steps == (20.0 / H).round() as u64 {
                series.left = now / begin;
            }
            Ok(())
        })?;
        Ok(series)
    }

    /// By how much the mean of I in the last tenth of the run differs from that in the first.
    pub(super) fn trend(&self) -> f64 {
        let means = self.sum.envelope.mean();
        let mean = |part: &[[f64; 2]]| part.iter().map(|[_, mean]| mean).sum::<f64>() / part.len() as f64;
        let tenth = (means.len() / 10).max(1);
        mean(&means[means.len().saturating_sub(tenth)..]) - mean(&means[..tenth.min(means.len())])
    }

    /// The largest |E − E(0)| of a run with steps of length `h`.
    pub(super) fn largest_energy<M: Method<SpringChain, f64>>(method: M, h: f64, end: f64) -> Result<f64> {
        let mut run = Integrator::new(&CHAIN, method, h, CHAIN.first_pair(CENTRES[0]))?;
        let (begin, mut largest) = (run.energy(), 0.0);
        for _ in 0..(end / h).round() as u64 {
            run.advance()?;
            largest = larger(largest, (run.energy() - begin).abs());
        }
        Ok(largest)
    }
}
