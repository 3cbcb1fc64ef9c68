//! Sums over all pairs of many bodies: bitwise the same for every number of threads and lanes, and those by
//! hand in another order.

use core::cell::Cell;
use core::f64::consts::PI;

use dvi_core::prelude::*;
use dvi_core::scalar::Lanes;
use dvi_core::{DegenerateLagrangian, Lagrangian};
use rayon::ThreadPoolBuilder;

/// Below and above the number from which bodies are halved, whole packs and not.
const SIZES: [usize; 6] = [300, 511, 512, 541, 1024, 1101];

/// A number between −1 and 1 that depends on `seed` in no simple way.
fn number(seed: usize) -> f64 {
    (1.7 * seed as f64 + 0.3).sin() * (0.37 * (seed * seed) as f64).cos()
}

fn numbers(count: usize, seed: usize) -> Vec<f64> {
    (0..count).map(|j| number(10_000 * seed + j)).collect()
}

/// What is computed by each of several numbers of threads is the same, bit for bit.
fn same_on_all_threads(compute: impl Fn() -> Vec<f64> + Sync) -> Vec<f64> {
    let on = |threads| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(&compute)
    };
    let expected = compute();
    let bits = |vector: &[f64]| vector.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
    for threads in [1, 2, 5] {
        assert!(bits(&on(threads)) == bits(&expected), "{threads} threads, {} numbers", expected.len());
    }
    expected
}

/// Sums from the last term to the first, with the magnitude of their terms.
fn sums_by_hand<const D: usize>(
    n: usize,
    of_pair: impl Fn(usize, usize) -> [f64; D],
) -> (Vec<f64>, Vec<f64>) {
    let (mut sums, mut sizes) = (vec![0.0; D * n], vec![0.0; D * n]);
    for j in 0..n {
        for k in (0..n).rev().filter(|k| *k != j) {
            for (axis, term) in of_pair(j, k).into_iter().enumerate() {
                sums[axis * n + j] += term;
                sizes[axis * n + j] += term.abs();
            }
        }
    }
    (sums, sizes)
}

fn agree(found: &[f64], (expected, sizes): &(Vec<f64>, Vec<f64>)) {
    assert_eq!(found.len(), expected.len());
    for ((index, found), (expected, size)) in found.iter().enumerate().zip(expected.iter().zip(sizes)) {
        let apart = (found - expected).abs();
        assert!(apart <= 1e-13 * size, "entry {index}: {found:e}, by hand {expected:e}");
    }
}

/// Vortices in the plane, in a flow that turns and strains. What is no part of a formula may be of any type.
#[degenerate_lagrangian(
    coordinates(x[gamma.len()], y[gamma.len()]),
    one_form = sum(0..gamma.len(), |j| gamma[j] / 2.0 * (x[j] * d(y[j]) - y[j] * d(x[j]))),
    hamiltonian = sum(0..gamma.len(), |j| strain * x[j] * y[j]) - sum_pairs(0..gamma.len(), |i, j| gamma[i] * gamma[j]
        / (4.0 * PI) * ((x[i] - x[j]).powi(2) + (y[i] - y[j]).powi(2) + 0.01).ln()),
)]
struct Vortices {
    gamma: Vec<f64>,
    strain: f64,
    #[allow(dead_code, reason = "it is there to be of a type that threads cannot share")]
    calls: Cell<usize>,
}

impl Vortices {
    fn new(n: usize) -> Self {
        let gamma = numbers(n, 1).iter().map(|gamma| (2.0 + gamma) / n as f64).collect();
        Self { gamma, strain: 0.3, calls: Cell::new(0) }
    }
}

fn vortex_gradient(n: usize) -> Vec<f64> {
    let mut gradient = vec![0.0; 2 * n];
    Vortices::new(n).hamiltonian_gradient(&numbers(2 * n, 2), 0.0, &mut gradient);
    gradient
}

#[test]
fn gradient_of_vortices() {
    for n in SIZES {
        let (system, q) = (Vortices::new(n), numbers(2 * n, 2));
        let mut by_hand = sums_by_hand(n, |j, k| {
            let apart = [q[j] - q[k], q[n + j] - q[n + k]];
            let square = apart[0] * apart[0] + apart[1] * apart[1] + 0.01;
            apart.map(|apart| -system.gamma[j] * system.gamma[k] * apart / (2.0 * PI * square))
        });
        for j in 0..n {
            by_hand.0[j] += system.strain * q[n + j];
            by_hand.0[n + j] += system.strain * q[j];
            by_hand.1[j] += q[n + j].abs();
            by_hand.1[n + j] += q[j].abs();
        }
        agree(&same_on_all_threads(|| vortex_gradient(n)), &by_hand);
    }
}

#[test]
fn gradient_in_lanes() {
    const W: usize = 3;
    for n in [511, 541] {
        let system = Vortices::new(n);
        let moved = |lane: usize, i: usize| number(20_000 + i) + 0.02 * (lane * i % 7) as f64;
        let q: Vec<_> =
            (0..2 * n).map(|i| Lanes::<W>(core::array::from_fn(|lane| moved(lane, i)))).collect();
        let mut together = vec![Lanes::all(0.0); 2 * n];
        system.hamiltonian_gradient(&q, Lanes::all(0.0), &mut together);
        for lane in 0..W {
            let q: Vec<f64> = (0..2 * n).map(|i| moved(lane, i)).collect();
            let mut alone = vec![0.0; 2 * n];
            system.hamiltonian_gradient(&q, 0.0, &mut alone);
            let same = together.iter().zip(&alone).all(|(pack, x)| pack.0[lane].to_bits() == x.to_bits());
            assert!(same, "{n} vortices, lane {lane}");
        }
    }
}

/// Masses in space that attract each other and hang on springs; of the generic type are the masses.
#[lagrangian(
    coordinates(x[m.len()], y[m.len()], z[m.len()]),
    lagrangian = sum(0..m.len(), |j| m[j] * (dot(x[j]).powi(2) + dot(y[j]).powi(2) + dot(z[j]).powi(2)) / 2.0
        - stiffness * (x[j].powi(2) + y[j].powi(2) + z[j].powi(2)) / 2.0)
        + sum_pairs(0..m.len(), |i, j| (m[i] * m[j] - charge[i] * charge[j])
            / ((x[i] - x[j]).powi(2) + (y[i] - y[j]).powi(2) + (z[i] - z[j]).powi(2) + softening * softening).sqrt()),
)]
struct Bodies<P = f64> {
    m: Box<[P]>,
    charge: Vec<i32>,
    softening: f64,
    stiffness: f64,
}

#[test]
fn gradient_of_masses() {
    for n in SIZES {
        let m: Vec<f64> = numbers(n, 3).iter().map(|m| 1.0 + m * m).collect();
        let charge: Vec<i32> = (0..n as i32).map(|j| j % 3 - 1).collect();
        let system = Bodies { m: m.clone().into(), charge: charge.clone(), softening: 0.2, stiffness: 0.7 };
        let (q, v) = (numbers(3 * n, 4), numbers(3 * n, 5));
        let found = same_on_all_threads(|| {
            let [mut l_q, mut l_v] = [vec![0.0; 3 * n], vec![0.0; 3 * n]];
            Lagrangian::gradient(&system, &q, &v, 0.0, &mut l_q, &mut l_v);
            l_q.extend(l_v);
            l_q
        });
        let mut by_hand = sums_by_hand(n, |j, k| {
            let apart: [f64; 3] = core::array::from_fn(|axis| q[axis * n + j] - q[axis * n + k]);
            let square = apart.iter().map(|apart| apart * apart).sum::<f64>() + 0.04;
            let strength = m[j] * m[k] - f64::from(charge[j] * charge[k]);
            apart.map(|apart| -strength * apart / (square * square.sqrt()))
        });
        for i in 0..3 * n {
            by_hand.0[i] -= system.stiffness * q[i];
            by_hand.1[i] += q[i].abs();
        }
        for i in 0..3 * n {
            by_hand.0.push(m[i % n] * v[i]);
            by_hand.1.push((m[i % n] * v[i]).abs());
        }
        agree(&found, &by_hand);
    }
}

/// Energies and the points of runs.
#[test]
fn runs_of_vortices() {
    for n in [300, 1024] {
        same_on_all_threads(|| {
            let system = Vortices::new(n);
            let places = numbers(2 * n, 6);
            let start = VorticesState { x: places[..n].to_vec(), y: places[n..].to_vec() };
            let mut numbers = vec![DegenerateLagrangian::<f64>::hamiltonian(&system, &places, 0.0)];
            for method in [Sigma::leapfrog(), Sigma::midpoint()] {
                let mut run = Integrator::new(&system, method, 1e-3, start.clone()).expect("it starts");
                run.take_steps(5).expect("small steps");
                let state = run.state();
                numbers.extend(state.x.iter().chain(&state.y));
                numbers.push(run.energy());
            }
            numbers
        });
    }
}
