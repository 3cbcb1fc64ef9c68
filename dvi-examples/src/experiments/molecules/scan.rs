//! How the energy error depends on the length of the steps, and which is the longest that keeps a bound.

use anyhow::Result;
use dvi_core::methods::Method;
use dvi_core::prelude::*;

use crate::claim::larger;
use crate::job::Job;

/// How many lengths are tried between one and twice that one.
const FINENESS: f64 = 8.0;

/// Lengths of steps, the shortest first, each with the largest |E − E(0)| over E(0); infinite where the run
/// is lost.
pub(super) struct Scan(pub Vec<[f64; 2]>);

impl Scan {
    /// Of runs up to time `end`, with steps between the two.
    pub(super) fn new<S: Lagrangian, M: Method<S, f64> + Clone>(
        job: &Job<'_>,
        system: &S,
        method: &M,
        start: &S::State<f64>,
        [shortest, longest]: [f64; 2],
        end: f64,
    ) -> Result<Self> {
        let count = (FINENESS * (longest / shortest).log2()).round() as u32;
        let mut errors = Vec::new();
        for i in 0..=count {
            let h = shortest * (f64::from(i) / FINENESS).exp2();
            let mut run = Integrator::new(system, method.clone(), h, start.clone())?;
            let (begin, mut largest) = (run.energy(), 0.0);
            let steps = (end / h).ceil() as u64;
            job.expect(steps);
            let lost = job.repeat_until_lost(steps, || {
                run.advance()?;
                largest = larger(largest, (run.energy() / begin - 1.0).abs());
                Ok(())
            });
            errors.push([h, if lost.is_some() || !largest.is_finite() { f64::INFINITY } else { largest }]);
        }
        Ok(Self(errors))
    }

    /// The longest step at which, and at all shorter ones that were tried, the error is at most `bound`.
    pub(super) fn longest(&self, bound: f64) -> f64 {
        let kept = self.0.iter().take_while(|[_, error]| *error <= bound);
        kept.last().map_or(f64::NAN, |[h, _]| *h)
    }

    /// The error of the step that is the nearest to `h`.
    pub(super) fn error(&self, h: f64) -> f64 {
        let off = |tried: f64| (tried / h).ln().abs();
        let nearest = self.0.iter().min_by(|a, b| off(a[0]).total_cmp(&off(b[0])));
        nearest.map_or(f64::NAN, |[_, error]| *error)
    }
}
