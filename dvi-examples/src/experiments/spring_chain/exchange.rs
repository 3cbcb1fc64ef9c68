//! The energies of the stiff springs over time, and how much faster one run exchanges them than another.

use anyhow::Result;
use dvi_core::methods::Method;
use dvi_core::prelude::*;

use super::CHAIN;
use crate::models::SpringChain;

/// The energy of each stiff spring, on average over each unit of time.
#[derive(Clone, Debug, Default)]
pub(super) struct Exchange(pub Vec<[f64; 3]>);

impl Exchange {
    pub(super) fn new<M: Method<SpringChain, f64>>(
        method: M,
        centre: f64,
        h: f64,
        end: f64,
    ) -> Result<Self> {
        let mut run = Integrator::new(&CHAIN, method, h, CHAIN.first_pair(centre))?;
        let of_unit = (1.0 / h).round() as u64;
        let mut means = Vec::new();
        for _ in 0..end.round() as u64 {
            let mut mean = [0.0; 3];
            for _ in 0..of_unit {
                run.advance()?;
                for (mean, energy) in mean.iter_mut().zip(CHAIN.oscillatory(&run.state(), 1.0)) {
                    *mean += energy / of_unit as f64;
                }
            }
            means.push(mean);
        }
        Ok(Self(means))
    }

    /// [t, energy] of stiff spring `j`, at the middle of each unit of time.
    pub(super) fn points(&self, j: usize) -> Vec<[f64; 2]> {
        self.0.iter().enumerate().map(|(k, mean)| [k as f64 + 0.5, mean[j]]).collect()
    }

    /// Between the means.
    fn at(&self, t: f64) -> Option<[f64; 3]> {
        let place = (t - 0.5).max(0.0);
        let (k, part) = (place.floor() as usize, place.fract());
        let [before, after] = [self.0.get(k)?, self.0.get(k + 1)?];
        Some(std::array::from_fn(|j| before[j] + part * (after[j] - before[j])))
    }

    /// The mean square of the difference from those of `motion` at times that are `speed` times as long.
    fn apart(&self, motion: &Self, speed: f64) -> f64 {
        let pairs = self.0.iter().enumerate();
        let squares = pairs.map(|(k, mean)| match motion.at(speed * (k as f64 + 0.5)) {
            Some(other) => mean.iter().zip(other).map(|(a, b)| (a - b).powi(2)).sum::<f64>(),
            None => f64::INFINITY,
        });
        squares.sum::<f64>() / self.0.len() as f64
    }
}

/// How many times as fast as in `motion` the energies are exchanged: the factor of time with the least mean
/// square of differences.
pub(super) fn speed(exchange: &Exchange, motion: &Exchange) -> f64 {
    let factors = (0..=1000).map(|i| 0.4 + 0.001 * f64::from(i));
    let apart = factors.map(|factor| (factor, exchange.apart(motion, factor)));
    apart.min_by(|a, b| a.1.total_cmp(&b.1)).map_or(f64::NAN, |(factor, _)| factor)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_speed_of_a_slowed_exchange_is_found() {
        let of = |rate: f64, end: u32| {
            let energy = |k: u32| [0.0, 1.0, 2.0].map(|j| (rate * 0.05 * (f64::from(k) + 0.5) + j).sin());
            Exchange((0..end).map(energy).collect())
        };
        let found = speed(&of(0.8, 100), &of(1.0, 200));
        assert!((found - 0.8).abs() < 0.002, "{found}");
    }
}
