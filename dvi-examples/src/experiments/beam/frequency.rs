//! The frequency of a mode of a linear system, from a run.

use anyhow::Result;
use dvi_core::prelude::*;
use dvi_core::{RegularLagrangian, Separable, System};

/// How many steps the mean is taken over.
const STEPS: u32 = 200;
/// hω of the steps.
const PHASE: f64 = 0.5;

/// The angular frequency near `guess` of the mode that `start` is near to, without the error of the steps.
///
/// The velocities of a mode obey v₊ + v₋ = 2 cos(ω̃h) v. The cosine that fits best, v·M(v₊ + v₋)/(2 v·Mv),
/// has an error that is of second order in what other modes take part. `method` is Newmark's with β = ¼,
/// which has (2/h) tan(ω̃h/2) = ω.
pub(super) fn frequency<S>(system: &S, method: Newmark, start: S::State<f64>, guess: f64) -> Result<f64>
where
    S: Separable + RegularLagrangian + System,
{
    let h = PHASE / guess;
    let mut run = Integrator::new(system, method, h, start)?;
    let velocity = |state: &S::State<f64>| -> Result<Vec<f64>> {
        let values: Vec<f64> = system.values(state)?.collect();
        Ok(values[values.len() / 2..].to_vec())
    };
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let mut last = run.memory().p().to_vec();
    run.advance()?;
    let (mut across, mut along) = (0.0, 0.0);
    for _ in 0..STEPS {
        let (v, p) = (velocity(&run.state())?, run.memory().p().to_vec());
        run.advance()?;
        across += dot(&v, &last) + dot(&v, run.memory().p());
        along += 2.0 * dot(&v, &p);
        last = p;
    }
    // tan²(ω̃h/2) = (1 − cos ω̃h)/(1 + cos ω̃h)
    Ok(2.0 / h * ((along - across) / (along + across)).sqrt())
}
