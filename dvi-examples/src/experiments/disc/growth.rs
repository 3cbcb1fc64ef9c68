//! How far the energy is from its start in the course of long runs, on average over several starts.

use std::f64::consts::TAU;

use anyhow::Result;
use dvi_core::error::StepError;
use dvi_core::prelude::*;

use super::reduced::start;
use super::{PLACE, RATES, midpoint};
use crate::claim::larger;
use crate::experiments::rk4::rk4;
use crate::job::Job;
use crate::models::{RollingDisc, RollingDiscState};

/// How many starts there are: in equally spaced directions from one place.
pub(super) const STARTS: u64 = 8;
/// Times in a factor of ten at which the growth is noted.
const PER_DECADE: f64 = 8.0;

/// The mean, over the starts, of the largest |E − E(0)| up to time t, for times t at equal ratios.
pub(super) struct Growth(pub Vec<[f64; 2]>);

impl Growth {
    pub(super) fn constrained(job: &Job<'_>, disc: &RollingDisc, h: f64, end: f64) -> Result<Self> {
        Self::of(job, disc, h, end, |begin| {
            let mut run = Integrator::new(disc, midpoint(), h, begin)?;
            Ok(move || {
                run.advance()?;
                Ok(run.energy())
            })
        })
    }

    pub(super) fn rk4(job: &Job<'_>, disc: &RollingDisc, h: f64, end: f64) -> Result<Self> {
        Self::of(job, disc, h, end, |begin| {
            let mut y = start(&begin);
            Ok(move || {
                y = rk4(&y, h, |y| disc.reduced(y));
                Ok(energy(disc, &y))
            })
        })
    }

    /// Of runs whose steps `begun` takes, each of which returns the energy after it.
    fn of<F: FnMut() -> Result<f64, StepError>>(
        job: &Job<'_>,
        disc: &RollingDisc,
        h: f64,
        end: f64,
        begun: impl Fn(RollingDiscState) -> Result<F>,
    ) -> Result<Self> {
        let decades = end.log10();
        let count = (PER_DECADE * decades).round().max(1.0);
        let times = (0..=count as u32).map(|k| 10f64.powf(f64::from(k) / count * decades));
        let mut points: Vec<[f64; 2]> = times.map(|t| [t, 0.0]).collect();
        for k in 0..STARTS {
            let begin = disc.rolling(PLACE, 0.3 + k as f64 * TAU / STARTS as f64, RATES);
            let (first, mut step) = (energy(disc, &start(&begin)), begun(begin)?);
            let (mut largest, mut steps, mut next) = (0.0, 0_u64, 0);
            job.repeat((end / h).round() as u64, || {
                largest = larger(largest, (step()? - first).abs());
                steps += 1;
                while next < points.len() && (steps as f64 + 0.5) * h > points[next][0] {
                    points[next][1] += largest / STARTS as f64;
                    next += 1;
                }
                Ok(())
            })?;
        }
        Ok(Self(points))
    }

    /// Up to the last of the times that is not after `t`.
    pub(super) fn up_to(&self, t: f64) -> f64 {
        let before = self.0.iter().take_while(|point| point[0] <= 1.001 * t);
        before.last().map_or(f64::NAN, |point| point[1])
    }

    /// The slope in a double logarithmic picture from time `from` on: of the line of least squares.
    pub(super) fn exponent(&self, from: f64) -> Option<f64> {
        let late = self.0.iter().filter(|point| point[0] >= 0.999 * from);
        convergence_order(&late.map(|point| (point[0], point[1])).collect::<Vec<_>>())
    }
}

/// The energy of a disc of which (x, y, θ, φ, θ', φ') is known.
fn energy(disc: &RollingDisc, &[x, y, _, phi, dot_theta, dot_phi]: &[f64; 6]) -> f64 {
    let RollingDisc { radius, stiffness, field, gradient } = disc;
    let kinetic = radius.powi(2) * (0.75 * dot_theta.powi(2) + 0.125 * dot_phi.powi(2));
    let magnet = (field[0] + gradient * y) * phi.cos() + (field[1] + gradient * x) * phi.sin();
    kinetic + 0.5 * (stiffness[0] * x * x + stiffness[1] * y * y) - magnet
}

#[cfg(test)]
mod tests {
    use super::super::MAGNET;
    use super::*;

    #[test]
    fn the_energy_by_hand_is_that_of_the_lagrangian() {
        let disc = RollingDisc { radius: 0.7, ..MAGNET };
        let state = disc.rolling([0.4, -0.3], 1.1, [0.9, -0.6]);
        let generated: f64 = disc.energy_at(&state).expect("a state");
        assert!((energy(&disc, &start(&state)) - generated).abs() < 1e-15);
    }
}
