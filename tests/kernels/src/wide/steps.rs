//! Steps of runs in lanes, with stages or nodes in lanes, and of large systems.

use dvi_core::Lagrangian;
use dvi_core::methods::{InStep, Method};
use dvi_core::prelude::*;
use dvi_core::run::Together;

use super::gradients::{Chain, ChainState, numbers, vortices};
use crate::systems::ManyVorticesState;

/// Four vortices. Systems that are measured have types of their own: what else steps them changes what is
/// inlined.
#[degenerate_lagrangian(
    coordinates(x[4], y[4]),
    one_form = sum(0..4, |j| gamma[j] / 2.0 * (x[j] * d(y[j]) - y[j] * d(x[j]))),
    hamiltonian = -sum_pairs(0..4, |i, j| gamma[i] * gamma[j] / (4.0 * PI)
        * ((x[i] - x[j]).powi(2) + (y[i] - y[j]).powi(2)).ln()),
)]
#[derive(PartialEq)]
struct Four {
    gamma: [f64; 4],
}

/// A planet.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 + mu / (x * x + y * y).sqrt(),
)]
#[derive(PartialEq)]
struct Planet {
    mu: f64,
}

const RUNS: usize = 8;
const STEPS: u64 = 20;

/// The last states of eight runs together, of runs in lanes of stages and of nodes, and of a chain and a
/// cloud by the fixed point.
pub(super) fn add_to(all: &mut Vec<f64>) {
    let four = Four { gamma: [1.0, 1.5, 1.25, 2.0] };
    let near = |j: usize| FourState { x: [1.0 + 0.01 * j as f64, -1.0, 0.2, 0.1], y: [0.1, 0.0, 1.2, -0.9] };
    let leapfrog = Sigma { parasitic_limit: None, ..Sigma::leapfrog() };
    add_together(all, &four, &leapfrog, 0.01, near);
    add_together(all, &four, &Sigma::midpoint(), 0.1, near);
    let planet = Planet { mu: 1.0 };
    let orbit = |j: usize| PlanetState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 0.8 + 0.02 * j as f64 };
    add_together(all, &planet, &Variational::trapezoid(), 0.01, orbit);

    add_run(all, &four, Gauss::<8>::new().in_lanes(), 0.5, near(0));
    add_run(all, &planet, Gauss::<8>::new().in_lanes(), 0.5, orbit(0));
    add_run(all, &planet, Galerkin::<9>::new().in_lanes(), 0.5, orbit(0));

    let count = 301;
    let at_rest = ChainState { q: numbers(count, 7), dot_q: vec![0.0; count] };
    let midpoint = Variational { solver: Solver::FixedPoint, ..Variational::midpoint() };
    add_run(all, &Chain { n: count, alpha: 0.25 }, midpoint, 0.1, at_rest);
    let count = 40;
    let cloud = ManyVorticesState { x: numbers(count, 8), y: numbers(count, 9) };
    let midpoint = Sigma { solver: Solver::FixedPoint, ..Sigma::midpoint() };
    add_run(all, &vortices(count), midpoint, 1e-4, cloud);
}

fn add_together<S: Lagrangian + PartialEq, M: InStep<RUNS, S> + PartialEq + Clone>(
    all: &mut Vec<f64>,
    system: &S,
    method: &M,
    h: f64,
    start: impl Fn(usize) -> S::State<f64>,
) {
    let begin = |j| Integrator::new(system, method.clone(), h, start(j)).expect("it starts");
    let mut runs: Vec<_> = (0..RUNS).map(begin).collect();
    let taken = Together::<RUNS, _, _>::new(&runs[0]).take_steps(&mut runs, STEPS);
    assert!(taken.iter().all(Result::is_ok), "they go on");
    runs.iter().for_each(|run| all.extend(run.q().iter()));
}

fn add_run<S: Lagrangian, M: Method<S, f64>>(
    all: &mut Vec<f64>,
    system: &S,
    method: M,
    h: f64,
    start: S::State<f64>,
) {
    let mut run = Integrator::new(system, method, h, start).expect("it starts");
    run.take_steps(STEPS).expect("it goes on");
    all.extend(run.q().iter());
}
