//! Chains of many masses: Newton's method on Toda's chain, and Verlet's steps on the chain of Fermi, Pasta,
//! Ulam and Tsingou beside the same steps by hand; the gradient of rings; and Newton's method on vortices,
//! each of which moves all others.
//!
//! `cargo bench -p dvi-benches --bench large [-- --markdown]`. Times are those of one step by Newton
//! and of a hundred by Verlet; throughput counts masses times steps.

mod fput_by_hand;

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
        let (system, method) = (Mobile { half: n / 2 }, Constrained::new(Variational::midpoint()));
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
        let force = || fput.force(black_box(&q), &[], 0.0, &mut force);
        let evaluations = beside_gradients(criterion, "FPUT", n, run, force);
        fput_by_hand(criterion, n, evaluations);
        let (ring, start) = (Ring { n }, RingState { q: wave(n, 0.0), p: wave(n, 1.0) });
        let method = Sigma { solver: Solver::FixedPoint, ..Sigma::midpoint() };
        let Ok(run) = Integrator::new(&ring, method, H, start) else { panic!("it starts") };
        let (z, mut gradient) = ([wave(n, 0.0), wave(n, 1.0)].concat(), vec![0.0; 2 * n]);
        let gradient = || ring.hamiltonian_gradient(black_box(&z), 0.0, &mut gradient);
        beside_gradients(criterion, "a ring", n, run, gradient);
    }
}

/// The same by hand: what an iteration costs beside the force where a force is two additions and two
/// products.
fn fput_by_hand(criterion: &mut Criterion, n: usize, evaluations: u64) {
    let (q, [mut force, mut expected]) = (wave(n, 0.0), [vec![0.0; n], vec![0.0; n]]);
    Fput { n, alpha: ALPHA }.force(&q, &[], 0.0, &mut expected);
    fput_by_hand::force(ALPHA, &q, &mut force);
    assert!(force.iter().zip(&expected).all(|(a, b)| (a - b).abs() < 1e-15), "the forces differ");
    let mut group = criterion.benchmark_group(format!("FPUT, midpoint, fixed point, h = {H}"));
    group.throughput(Throughput::Elements(n as u64));
    let mut midpoint = fput_by_hand::Midpoint::new(ALPHA, H, &q, &wave(n, 1.0));
    group.bench_function(BenchmarkId::new("as many iterations by hand", n), |bencher| {
        bencher.iter(|| (0..evaluations).map(|_| midpoint.improve()).fold(0.0, f64::max));
    });
    group.finish();
}

/// Returns how many gradients a step takes.
fn beside_gradients<S: Lagrangian, M: Method<S, f64>>(
    criterion: &mut Criterion,
    name: &str,
    n: usize,
    mut run: Integrator<&S, M>,
    mut gradient: impl FnMut(),
) -> u64 {
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
    evaluations
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

/// Verlet's steps by hand, in one pass over the chain.
struct ByHand {
    q: Vec<f64>,
    p: Vec<f64>,
    force: Vec<f64>,
}

impl ByHand {
    fn new(n: usize) -> Self {
        let mut new = Self { q: wave(n, 0.0), p: wave(n, 1.0), force: vec![0.0; n] };
        let mut left = tension(new.q[0]);
        for j in 0..n {
            let stretch = if j + 1 < n { new.q[j + 1] - new.q[j] } else { -new.q[j] };
            let right = tension(stretch);
            new.force[j] = right - left;
            left = right;
        }
        new
    }

    fn step(&mut self) {
        let (n, half) = (self.q.len(), 0.5 * H);
        let move_one = |q: &mut f64, p: &mut f64, force: f64| {
            *p += half * force;
            *q += H * *p;
        };
        move_one(&mut self.q[0], &mut self.p[0], self.force[0]);
        let mut left = tension(self.q[0]);
        for j in 0..n {
            let stretch = if j + 1 < n {
                move_one(&mut self.q[j + 1], &mut self.p[j + 1], self.force[j + 1]);
                self.q[j + 1] - self.q[j]
            } else {
                -self.q[j]
            };
            let right = tension(stretch);
            self.force[j] = right - left;
            self.p[j] += half * self.force[j];
            left = right;
        }
    }
}

#[inline(always)]
fn tension(stretch: f64) -> f64 {
    stretch + ALPHA * stretch * stretch
}

fn verlet(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("FPUT, Verlet");
    for n in [1000, 100_000] {
        let system = black_box(Fput { n, alpha: ALPHA });
        let start = || FputState { q: wave(n, 0.0), dot_q: wave(n, 1.0) };
        let begin = || Integrator::new(&system, Variational::trapezoid(), H, start());
        let (Ok(mut run), mut by_hand) = (begin(), ByHand::new(n)) else { panic!("it starts") };
        for _ in 0..100 {
            assert!(run.advance().is_ok());
            by_hand.step();
        }
        let difference =
            run.q().iter().zip(&by_hand.q).map(|(a, b)| (a - b).abs()).fold(0.0, dvi_tests::larger);
        assert!(difference < 1e-12, "they differ by {difference:e}");
        group.throughput(Throughput::Elements(100 * n as u64));
        group.bench_function(BenchmarkId::new("generated", n), |bencher| {
            bencher.iter(|| assert!(run.take_steps(100).is_ok()));
        });
        group.bench_function(BenchmarkId::new("by hand", n), |bencher| {
            bencher.iter(|| (0..100).for_each(|_| by_hand.step()));
        });
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

/// ∇H of a ring, site by site.
fn ring_by_hand(n: usize, z: &[f64], gradient: &mut [f64]) {
    let (q, p) = z.split_at(n);
    let (of_q, of_p) = gradient.split_at_mut(n);
    for j in 0..n {
        let [before, after] = [if j == 0 { n - 1 } else { j - 1 }, if j + 1 == n { 0 } else { j + 1 }];
        let density = q[j] * q[j] + p[j] * p[j];
        of_q[j] = density * q[j] - q[before] - q[after];
        of_p[j] = density * p[j] - p[before] - p[after];
    }
}

/// ∇H of rings, generated and by hand.
fn rings(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("a ring, ∇H");
    for n in [1000, 10_000] {
        let (system, z) = (black_box(Ring { n }), [wave(n, 0.0), wave(n, 1.0)].concat());
        let [mut gradient, mut expected] = [vec![0.0; 2 * n], vec![0.0; 2 * n]];
        system.hamiltonian_gradient(&z, 0.0, &mut gradient);
        ring_by_hand(n, &z, &mut expected);
        assert!(gradient.iter().zip(&expected).all(|(a, b)| (a - b).abs() < 1e-15), "the gradients differ");
        group.throughput(Throughput::Elements(n as u64));
        group.bench_function(BenchmarkId::new("generated", n), |bencher| {
            bencher.iter(|| system.hamiltonian_gradient(black_box(&z), 0.0, &mut gradient));
        });
        group.bench_function(BenchmarkId::new("by hand", n), |bencher| {
            bencher.iter(|| ring_by_hand(system.n, black_box(&z), &mut expected));
        });
    }
    group.finish();
}

fn main() {
    markdown::main(&[rings, newton, lattice, rods, fixed_point, many_bodies, verlet]);
}
