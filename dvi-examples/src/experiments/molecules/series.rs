//! What one long run leaves.

use anyhow::Result;
use dvi_core::methods::Method;
use dvi_core::prelude::*;

use super::MOLECULES;
use crate::claim::larger;
use crate::deviation::Deviation;
use crate::job::Job;

/// The intervals in which errors are drawn and averaged.
const INTERVALS: usize = 250;

pub(super) struct Series {
    pub name: &'static str,
    pub h: f64,
    /// E/E(0) − 1.
    pub energy: Deviation,
    /// The largest |l − 1| of the sides of the triangles.
    pub bonds: Deviation,
    /// The largest difference of the velocities of two atoms of a molecule along the line between them.
    pub along: Deviation,
    /// The largest changes of the momentum in x, that in y and the angular momentum.
    pub momenta: [Deviation; 3],
}

impl Series {
    pub(super) fn new<S: Lagrangian, M: Method<S, f64>>(
        job: &Job<'_>,
        name: &'static str,
        system: &S,
        method: M,
        start: S::State<f64>,
        h: f64,
        end: f64,
    ) -> Result<Self> {
        let deviation = || Deviation::new(end, INTERVALS, 0.1 * end);
        let mut series = Self {
            name,
            h,
            energy: deviation(),
            bonds: deviation(),
            along: deviation(),
            momenta: std::array::from_fn(|_| deviation()),
        };
        let mut run = Integrator::new(system, method, h, start)?;
        let (energy, momenta) = (run.energy(), momenta(&run));
        job.repeat((end / h).round() as u64, || {
            run.advance()?;
            let state: Vec<f64> = system.values(&run.state()).into_iter().flatten().collect();
            series.note(&run, &state, energy, momenta);
            Ok(())
        })?;
        Ok(series)
    }

    fn note<R: Run<Scalar = f64>>(&mut self, run: &R, state: &[f64], energy: f64, begin: [f64; 3]) {
        let t = run.time();
        self.energy.push(t, run.energy() / energy - 1.0);
        for ((deviation, now), begin) in self.momenta.iter_mut().zip(momenta(run)).zip(begin) {
            deviation.push(t, now - begin);
        }
        let [bonds, along] = sides(state);
        self.bonds.push(t, bonds);
        self.along.push(t, along);
    }

    /// The mean error of the energy in the first and in the last tenth of the run.
    pub(super) fn tenths(&self) -> [f64; 2] {
        let means = self.energy.envelope.mean();
        let mean = |part: &[[f64; 2]]| part.iter().map(|[_, mean]| mean).sum::<f64>() / part.len() as f64;
        let tenth = INTERVALS / 10;
        [mean(&means[..tenth.min(means.len())]), mean(&means[means.len().saturating_sub(tenth)..])]
    }
}

fn momenta<R: Run<Scalar = f64>>(run: &R) -> [f64; 3] {
    std::array::from_fn(|k| run.momentum(k).unwrap_or(f64::NAN))
}

/// The largest error of a side, and the largest velocity along one.
fn sides(state: &[f64]) -> [f64; 2] {
    let (q, v) = state.split_at(state.len() / 2);
    let atoms = 3 * MOLECULES;
    let (mut length, mut along) = (0.0, 0.0);
    for m in 0..MOLECULES {
        for a in 0..3 {
            let (i, j) = (3 * m + a, 3 * m + (a + 1) % 3);
            let [x, y] = [q[j] - q[i], q[atoms + j] - q[atoms + i]];
            let [dot_x, dot_y] = [v[j] - v[i], v[atoms + j] - v[atoms + i]];
            let found = x.hypot(y);
            length = larger(length, (found - 1.0).abs());
            along = larger(along, ((x * dot_x + y * dot_y) / found).abs());
        }
    }
    [length, along]
}
