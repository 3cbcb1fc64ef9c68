//! The right side of many vortices, each of which moves all others: the generated gradient, on one thread
//! and on two, beside two by hand; and a fast sum beside the sum over all pairs.
//!
//! `cargo bench -p dvi-benches --bench pairs [-- --markdown]`. Throughput counts ordered pairs: n(n −
//! 1) of n vortices.

mod pairs_by_hand;

use std::f64::consts::PI;
use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput};
use dvi_core::DegenerateLagrangian;
use dvi_core::fast_sum::FastSum;
use dvi_core::prelude::*;
use rayon::ThreadPoolBuilder;

/// Vortices in the plane.
#[degenerate_lagrangian(
    coordinates(x[gamma.len()], y[gamma.len()]),
    one_form = sum(0..gamma.len(), |j| gamma[j] / 2.0 * (x[j] * d(y[j]) - y[j] * d(x[j]))),
    hamiltonian = -sum_pairs(0..gamma.len(), |i, j| gamma[i] * gamma[j] / (4.0 * PI)
        * ((x[i] - x[j]).powi(2) + (y[i] - y[j]).powi(2)).ln()),
)]
struct Vortices {
    gamma: Vec<f64>,
}

impl Vortices {
    fn new(n: usize) -> Self {
        Self { gamma: (0..n).map(|j| (1.0 + (j % 5) as f64) / n as f64).collect() }
    }

    /// Where they are on a disc: all x, then all y.
    fn places(n: usize) -> Vec<f64> {
        let radius = |j: usize| ((j as f64 + 0.5) / n as f64).sqrt();
        let angle = |j: usize| 2.399_963_229_728_653 * j as f64;
        let x = (0..n).map(|j| radius(j) * angle(j).cos());
        x.chain((0..n).map(|j| radius(j) * angle(j).sin())).collect()
    }

    /// ∇H, vortex by vortex, as one writes it first.
    fn naive(&self, q: &[f64], gradient: &mut [f64]) {
        let n = self.gamma.len();
        for i in 0..n {
            let mut sum = [0.0; 2];
            for j in (0..n).filter(|j| *j != i) {
                let apart = [q[i] - q[j], q[n + i] - q[n + j]];
                let strength = self.gamma[j] / (apart[0].powi(2) + apart[1].powi(2));
                sum[0] += strength * apart[0];
                sum[1] += strength * apart[1];
            }
            gradient[i] = -self.gamma[i] / (2.0 * PI) * sum[0];
            gradient[n + i] = -self.gamma[i] / (2.0 * PI) * sum[1];
        }
    }

    /// ∇H, each pair once, eight pairs at a time.
    fn in_lanes(&self, q: &[f64], gradient: &mut [f64]) {
        gradient.fill(0.0);
        pairs_by_hand::add_in_lanes(&self.gamma, q, gradient);
    }
}

/// All gradients are the same.
fn compare(system: &Vortices, q: &[f64]) {
    let mut expected = vec![0.0; q.len()];
    system.naive(q, &mut expected);
    let largest = expected.iter().fold(0.0_f64, |largest, entry| largest.max(entry.abs()));
    let mut gradients = [vec![0.0; q.len()], vec![0.0; q.len()]];
    system.hamiltonian_gradient(q, 0.0, &mut gradients[0]);
    system.in_lanes(q, &mut gradients[1]);
    for gradient in &gradients {
        for (a, b) in expected.iter().zip(gradient) {
            assert!((a - b).abs() <= 1e-12 * largest, "{a:e} and {b:e} differ, of {largest:e}");
        }
    }
}

fn gradients(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("∇H of n vortices");
    for n in [32, 256, 1024, 4096] {
        let (system, q) = (Vortices::new(n), Vortices::places(n));
        let mut gradient = vec![0.0; 2 * n];
        compare(&system, &q);
        group.throughput(Throughput::Elements((n * (n - 1)) as u64));
        group.bench_function(BenchmarkId::new("by hand, vortex by vortex", n), |bencher| {
            bencher.iter(|| system.naive(black_box(&q), &mut gradient));
        });
        group.bench_function(BenchmarkId::new("by hand, each pair once, in lanes", n), |bencher| {
            bencher.iter(|| system.in_lanes(black_box(&q), &mut gradient));
        });
        for threads in [1, 2] {
            let pool = ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
            group.bench_function(
                BenchmarkId::new(format!("generated, {threads} thread(s)"), n),
                |bencher| {
                    pool.install(|| {
                        bencher.iter(|| system.hamiltonian_gradient(black_box(&q), 0.0, &mut gradient));
                    });
                },
            );
        }
    }
    group.finish();
}

/// ∇H by the fast multipole method beside the sum over all pairs, on one thread and on two; prints how far
/// they are apart.
fn fast_sums(criterion: &mut Criterion) {
    const TOLERANCE: f64 = 1e-8;
    let mut group = criterion.benchmark_group("∇H of many vortices");
    group.sample_size(10);
    for n in [1000, 10_000, 100_000] {
        let (system, q) = (Vortices::new(n), Vortices::places(n));
        let state = VorticesState { x: q[..n].to_vec(), y: q[n..].to_vec() };
        let fast = || FastSum::<_, 2>::new(&system, TOLERANCE).expect("a tolerance in range");
        let error = fast().measured_error(&state, 200).expect("arrays of the declared length");
        println!("n = {n}: the fast sum has a relative error of {error:.1e}");
        let mut gradient = vec![0.0; 2 * n];
        for threads in [1, 2] {
            let pool = ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
            group.bench_function(
                BenchmarkId::new(format!("all pairs, {threads} thread(s)"), n),
                |bencher| {
                    pool.install(|| {
                        bencher.iter(|| system.hamiltonian_gradient(black_box(&q), 0.0, &mut gradient));
                    });
                },
            );
            group.bench_function(BenchmarkId::new(format!("fast sum, {threads} thread(s)"), n), |bencher| {
                pool.install(|| {
                    let fast = fast();
                    // The matrices are those of the first evaluation.
                    fast.hamiltonian_gradient(&q, 0.0, &mut gradient);
                    bencher.iter(|| fast.hamiltonian_gradient(black_box(&q), 0.0, &mut gradient));
                });
            });
        }
    }
    group.finish();
}

fn main() {
    markdown::main(&[gradients, fast_sums]);
}
