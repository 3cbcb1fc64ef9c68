//! Runs whose release builds use the widest instructions that the processor has, and other builds those of all processors.

use dvi_core::Lagrangian;
use dvi_core::methods::{InStep, Method};
use dvi_core::prelude::*;
use dvi_core::run::Together;

/// Vortices, of which there may be enough to take their pairs in halves.
#[degenerate_lagrangian(
    coordinates(x[gamma.len()], y[gamma.len()]),
    one_form = sum(0..gamma.len(), |j| gamma[j] / 2.0 * (x[j] * d(y[j]) - y[j] * d(x[j]))),
    hamiltonian = -sum_pairs(0..gamma.len(), |i, j| gamma[i] * gamma[j] / (4.0 * PI)
        * ((x[i] - x[j]).powi(2) + (y[i] - y[j]).powi(2) + 0.01).ln()),
)]
#[derive(PartialEq)]
struct Cloud {
    gamma: Vec<f64>,
}

/// A chain of Fermi, Pasta, Ulam and Tsingou.
#[lagrangian(
    coordinates(q[n]),
    lagrangian = sum(0..n, |j| dot(q[j]).powi(2)) / 2.0
        - sum(1..n, |j| (q[j] - q[j - 1]).powi(2) / 2.0 + alpha / 3.0 * (q[j] - q[j - 1]).powi(3)),
)]
#[derive(PartialEq)]
struct Chain {
    n: usize,
    alpha: f64,
}

fn numbers(count: usize, seed: usize) -> Vec<f64> {
    (0..count).map(|j| ((31 * j + 17 * seed) % 101) as f64 / 50.0 - 1.0).collect()
}

fn cloud(count: usize) -> (Cloud, impl Fn(usize) -> CloudState) {
    let gamma = numbers(count, 1).into_iter().map(|gamma| (1.5 + gamma) / count as f64).collect();
    (Cloud { gamma }, move |seed| CloudState { x: numbers(count, seed), y: numbers(count, seed + 3) })
}

/// The bits of the coordinates after some steps of each kind, or what has failed.
pub fn runs() -> Result<Vec<u64>, Box<dyn core::error::Error>> {
    let mut bits = Vec::new();
    let (many, places) = cloud(600);
    alone(&many, Sigma::new(0.0), places(2), 2, &mut bits)?;
    let (few, places) = cloud(21);
    together(&few, Sigma::midpoint(), &places, &mut bits)?;
    let chain = Chain { n: 301, alpha: 0.25 };
    let wave = |seed| ChainState { q: numbers(301, seed), dot_q: numbers(301, seed + 5) };
    alone(&chain, Variational::midpoint(), wave(1), 5, &mut bits)?;
    alone(&chain, Gauss::<8>::new().in_lanes(), wave(2), 2, &mut bits)?;
    Ok(bits)
}

fn alone<S: Lagrangian, M: Method<S, f64>>(
    system: &S,
    method: M,
    start: S::State<f64>,
    steps: u64,
    bits: &mut Vec<u64>,
) -> Result<(), Box<dyn core::error::Error>> {
    let mut run = Integrator::new(system, method, 0.05, start)?;
    run.take_steps(steps)?;
    bits.extend(run.q().iter().map(|q| q.to_bits()));
    Ok(())
}

/// Eight runs in lanes.
fn together<S: Lagrangian + PartialEq, M: InStep<8, S> + PartialEq + Copy>(
    system: &S,
    method: M,
    start: &impl Fn(usize) -> S::State<f64>,
    bits: &mut Vec<u64>,
) -> Result<(), Box<dyn core::error::Error>> {
    let runs = (0..8).map(|seed| Integrator::new(system, method, 0.05, start(seed)));
    let mut runs = runs.collect::<Result<Vec<_>, _>>()?;
    let results = Together::<8, _, _>::new(&runs[0]).take_steps(&mut runs, 10);
    results.into_iter().collect::<Result<(), _>>()?;
    bits.extend(runs.iter().flat_map(|run| run.q()).map(|q| q.to_bits()));
    Ok(())
}
