//! Many masses: Newton's method on chains, lattices, trees of rods, and vortices, each of which moves all
//! others; and steps by the fixed point beside their forces.
//!
//! `cargo bench -p dvi-benches --bench large [-- --markdown]`. Times are those of one step; throughput
//! counts masses times steps.

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, BenchmarkId, Criterion, Throughput};
use dvi_core::methods::Method;
use dvi_core::prelude::*;
use dvi_core::{DegenerateLagrangian, Lagrangian};
use dvi_examples::models::{VortexBlobs, VortexBlobsState};
use dvi_tests::zoo::constrained::Mobile;
use std::hint::black_box;

/// Toda's chain between walls.
#[lagrangian(
    coordinates(q[n]),
    lagrangian = sum(0..n, |j| dot(q[j]).powi(2)) / 2.0 - q[0].exp() + q[0] - (-q[n - 1]).exp() - q[n - 1]
        - sum(1..n, |j| (q[j] - q[j - 1]).exp() - (q[j] - q[j - 1])),
)]
struct Toda {
    n: usize,
}

/// The chain with cubic terms of strength `alpha`, between walls.
#[lagrangian(
    coordinates(q[n]),
    lagrangian = sum(0..n, |j| dot(q[j]).powi(2)) / 2.0 - q[0].powi(2) / 2.0 - alpha / 3.0 * q[0].powi(3)
        - q[n - 1].powi(2) / 2.0 + alpha / 3.0 * q[n - 1].powi(3)
        - sum(1..n, |j| (q[j] - q[j - 1]).powi(2) / 2.0 + alpha / 3.0 * (q[j] - q[j - 1]).powi(3)),
)]
struct Fput {
    n: usize,
    alpha: f64,
}

/// Rows of `side` masses one after the other, on springs to the neighbours before and behind, left and
/// right.
#[lagrangian(
    coordinates(q[n]),
    lagrangian = sum(0..n, |j| dot(q[j]).powi(2) - q[j].powi(4) / 2.0) / 2.0
        - sum(1..n, |j| (q[j] - q[j - 1]).cosh()) - sum(side..n, |j| (q[j] - q[j - side]).cosh()),
)]
struct Lattice {
    n: usize,
    side: usize,
}

const ALPHA: f64 = 0.25;
const H: f64 = 0.1;

/// A wave of small amplitude.
fn wave(n: usize, phase: f64) -> Vec<f64> {
    (0..n).map(|j| 0.1 * (0.3 * j as f64 + phase).sin()).collect()
}

/// The steps of a run of so many masses.
fn steps<S: Lagrangian, M: Method<S, f64>>(
    group: &mut BenchmarkGroup<'_, WallTime>,
    (id, n): (BenchmarkId, usize),
    run: Result<Integrator<&S, M>, StartError>,
) {
    let mut run = run.expect("it starts");
    group.throughput(Throughput::Elements(n as u64));
    group.bench_function(id, |bencher| bencher.iter(|| assert!(run.advance().is_ok())));
}

fn newton(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("Toda, midpoint, Newton, h = 1");
    group.sample_size(10);
    for n in [100, 1000, 10_000, 100_000] {
        let system = Toda { n };
        let method = Variational { solver: Solver::Newton, ..Variational::midpoint() };
        let start = TodaState { q: wave(n, 0.0), dot_q: wave(n, 1.0) };
        let run = Integrator::new(&system, method, 1.0, start);
        steps(&mut group, (BenchmarkId::from_parameter(n), n), run);
    }
    group.finish();
}

/// Steps by Newton on square lattices, with sparse matrices and without a matrix.
fn lattice(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("lattice, midpoint, Newton, h = 1");
    group.sample_size(10);
    let sides = [50, 100, 200].into_iter();
    for (side, solver) in sides.flat_map(|side| [(side, Solver::Newton), (side, Solver::NewtonKrylov)]) {
        let n = side * side;
        let method = Variational { solver, ..Variational::midpoint() };
        let start = LatticeState { q: wave(n, 0.0), dot_q: wave(n, 1.0) };
        let system = Lattice { n, side };
        let run = Integrator::new(&system, method, 1.0, start);
        steps(&mut group, (BenchmarkId::new(format!("{solver:?}"), n), n), run);
    }
    group.finish();
}

/// Steps with constraints on a tree, whose matrix is sparse and has no narrow band.
fn rods(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("rods in a tree, constrained midpoint, h = 0.01");
    group.sample_size(10);
    for n in [63, 127, 255] {
        let (system, method) = (Mobile { half: n / 2 }, Constrained::new(Midpoint));
        let run = Integrator::new(&system, method, 0.01, system.at_rest());
        steps(&mut group, (BenchmarkId::from_parameter(n), n), run);
    }
    group.finish();
}

/// A step of the midpoint rule by the fixed point, and as many evaluations of the force, or of ∇H, alone as
/// it takes on average, rounded.
fn fixed_point(criterion: &mut Criterion) {
    let method = Variational { solver: Solver::FixedPoint, ..Variational::midpoint() };
    for n in [1000, 10_000, 100_000] {
        let (q, mut force) = (wave(n, 0.0), vec![0.0; n]);
        let (toda, start) = (Toda { n }, TodaState { q: wave(n, 0.0), dot_q: wave(n, 1.0) });
        let Ok(run) = Integrator::new(&toda, method, H, start) else { panic!("it starts") };
        beside_gradients(criterion, "Toda", n, run, || toda.force(black_box(&q), &[], 0.0, &mut force));
        let (fput, start) = (Fput { n, alpha: ALPHA }, FputState { q: wave(n, 0.0), dot_q: wave(n, 1.0) });
        let Ok(run) = Integrator::new(&fput, method, H, start) else { panic!("it starts") };
        beside_gradients(criterion, "FPUT", n, run, || fput.force(black_box(&q), &[], 0.0, &mut force));
        let (ring, start) = (Ring { n }, RingState { q: wave(n, 0.0), p: wave(n, 1.0) });
        let method = Sigma { solver: Solver::FixedPoint, ..Sigma::midpoint() };
        let Ok(run) = Integrator::new(&ring, method, H, start) else { panic!("it starts") };
        let (z, mut gradient) = ([wave(n, 0.0), wave(n, 1.0)].concat(), vec![0.0; 2 * n]);
        let gradient = || ring.hamiltonian_gradient(black_box(&z), 0.0, &mut gradient);
        beside_gradients(criterion, "a ring", n, run, gradient);
    }
}

fn beside_gradients<S: Lagrangian, M: Method<S, f64>>(
    criterion: &mut Criterion,
    name: &str,
    n: usize,
    mut run: Integrator<&S, M>,
    mut gradient: impl FnMut(),
) {
    assert!(run.take_steps(20).is_ok());
    let begin = run.statistics().gradients;
    assert!(run.take_steps(100).is_ok());
    let evaluations = (run.statistics().gradients - begin + 50) / 100;
    let mut group = criterion.benchmark_group(format!("{name}, midpoint, fixed point, h = {H}"));
    group.throughput(Throughput::Elements(n as u64));
    group.bench_function(BenchmarkId::new("a step", n), |bencher| {
        bencher.iter(|| assert!(run.advance().is_ok()));
    });
    group.bench_function(BenchmarkId::new("as many gradients", n), |bencher| {
        bencher.iter(|| (0..evaluations).for_each(|_| gradient()));
    });
    group.finish();
}

/// By the fixed point, and by Newton's method with a matrix and without.
fn many_bodies(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("vortices, midpoint");
    group.sample_size(10);
    for n in [64, 128, 256] {
        let system =
            VortexBlobs { gamma: (0..n).map(|j| (1.0 + (j % 5) as f64) / n as f64).collect(), core: 0.1 };
        let at = |j: usize| ((j as f64 + 0.5) / n as f64).sqrt();
        let turn = |j: usize| 2.399_963_229_728_653 * j as f64;
        let start = VortexBlobsState {
            x: (0..n).map(|j| at(j) * turn(j).cos()).collect(),
            y: (0..n).map(|j| at(j) * turn(j).sin()).collect(),
        };
        for solver in [Solver::FixedPoint, Solver::Newton, Solver::NewtonKrylov] {
            let method = Sigma { solver, ..Sigma::midpoint() };
            let run = Integrator::new(&system, method, 0.1, start.clone());
            steps(&mut group, (BenchmarkId::new(format!("{solver:?}"), n), n), run);
        }
    }
    group.finish();
}

/// A ring of oscillators with amplitudes q + ip, as of light in an array of waveguides.
#[degenerate_lagrangian(
    coordinates(q[n], p[n]),
    one_form = sum(0..n, |j| (p[j] * d(q[j]) - q[j] * d(p[j])) / 2.0),
    hamiltonian = sum(0..n, |j| (q[j].powi(2) + p[j].powi(2)).powi(2)) / 4.0
        - sum(0..n, |j| q[j] * q[(j + 1) % n] + p[j] * p[(j + 1) % n]),
)]
struct Ring {
    n: usize,
}

fn main() {
    markdown::main(&[newton, lattice, rods, fixed_point, many_bodies]);
}
