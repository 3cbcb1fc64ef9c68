//! Terms that add to several entries of one array: beside one another, farther apart, and around the end of
//! a ring.

use dvi_core::DegenerateLagrangian;
use dvi_core::prelude::*;
use dvi_core::scalar::Lanes;

use super::{SIZES, Sum, agree, lanes_agree, numbers};

/// Terms that add to several entries of one array, which lie beside one another.
#[lagrangian(
    coordinates(x[n], y[n]),
    lagrangian = sum(0..n, |j| dot(x[j]).powi(2) + dot(y[j]).powi(2)) / 2.0
        + sum(1..n, |j| x[j] * x[j - 1] + y[j - 1].powi(2) * y[j])
        - sum(0..n - 2, |j| k[j] * (x[j + 2] - 2.0 * x[j + 1] + x[j]).powi(2)) / 2.0
        - sum(stride..n, |j| x[j - stride] * y[j] * x[j]),
)]
struct Neighbours {
    n: usize,
    stride: usize,
    k: Vec<f64>,
}

fn neighbours_by_hand(system: &Neighbours, q: &[f64]) -> Vec<Sum> {
    let (n, stride) = (system.n, system.stride);
    let mut force = vec![Sum::default(); 2 * n];
    for j in 1..n {
        force[j].add(q[j - 1]);
        force[j - 1].add(q[j]);
        force[n + j].add(q[n + j - 1].powi(2));
        force[n + j - 1].add(2.0 * q[n + j - 1] * q[n + j]);
    }
    for j in 0..n - 2 {
        let bent = system.k[j] * (q[j + 2] - 2.0 * q[j + 1] + q[j]);
        for (index, factor) in [(j, -1.0), (j + 1, 2.0), (j + 2, -1.0)] {
            force[index].add(factor * bent);
            force[index].size += 4.0 * system.k[j].abs();
        }
    }
    for j in stride..n {
        force[j - stride].add(-q[n + j] * q[j]);
        force[n + j].add(-q[j - stride] * q[j]);
        force[j].add(-q[j - stride] * q[n + j]);
    }
    force
}

#[test]
fn entries_beside_one_another() {
    for (n, stride) in (2..45).flat_map(|n| [1, 2, 9].map(|stride| (n, stride))) {
        let system = Neighbours { n, stride, k: numbers(n, 11) };
        let (q, mut force) = (numbers(2 * n, 12), vec![0.0; 2 * n]);
        system.force(&q, &[], 0.0, &mut force);
        agree(&force, &neighbours_by_hand(&system, &q), &format!("{n} masses, {stride} apart"));
        lanes_agree(
            &q,
            |q, out| system.force(q, &[], Lanes::all(0.0), out),
            |q, out| system.force(q, &[], 0.0, out),
        );
    }
}

/// Terms that add to entries that are as far apart as a pack has terms, nearly so far, and farther.
#[degenerate_lagrangian(
    coordinates(x[n], y[n]),
    one_form = sum(0..n, |j| y[j] * d(x[j])),
    hamiltonian = sum(9..n, |j| k[j] * x[j] * x[j - 7] * x[j - 8] * x[j - 9] * y[j - 3] * y[j - 3])
        - sum(8..n, |j| x[j] * x[j - 8] - y[j] * y[j - 7] * x[j - 4]),
)]
struct Far {
    n: usize,
    k: Vec<f64>,
}

fn far_by_hand(system: &Far, q: &[f64]) -> Vec<Sum> {
    let (n, k) = (system.n, &system.k);
    let (x, y) = q.split_at(n);
    let mut gradient = vec![Sum::default(); 2 * n];
    for j in 9..n {
        let factors = [x[j], x[j - 7], x[j - 8], x[j - 9], y[j - 3], y[j - 3]];
        for (factor, entry) in [j, j - 7, j - 8, j - 9, n + j - 3, n + j - 3].into_iter().enumerate() {
            let others = (0..6).filter(|other| *other != factor).map(|other| factors[other]);
            gradient[entry].add(k[j] * others.product::<f64>());
        }
    }
    for j in 8..n {
        gradient[j].add(-x[j - 8]);
        gradient[j - 8].add(-x[j]);
        gradient[n + j].add(y[j - 7] * x[j - 4]);
        gradient[n + j - 7].add(y[j] * x[j - 4]);
        gradient[j - 4].add(y[j] * y[j - 7]);
    }
    gradient
}

#[test]
fn entries_far_apart() {
    for n in SIZES {
        let (system, q) = (Far { n, k: numbers(n, 15) }, numbers(2 * n, 16));
        let mut gradient = vec![0.0; 2 * n];
        system.hamiltonian_gradient(&q, 0.0, &mut gradient);
        agree(&gradient, &far_by_hand(&system, &q), &format!("{n} places"));
        lanes_agree(
            &q,
            |q, out| system.hamiltonian_gradient(q, Lanes::all(0.0), out),
            |q, out| system.hamiltonian_gradient(q, 0.0, out),
        );
    }
}

/// A ring: neighbours on both sides, also beyond its end.
#[degenerate_lagrangian(
    coordinates(x[n], y[n]),
    one_form = sum(0..n, |j| y[j] * d(x[j])),
    hamiltonian = sum(0..n, |j| k[(j + 1) % n] * x[j] * x[(j + 1) % n] * y[(j + n - 2) % n])
        * sum(0..n, |j| x[j] * y[(j + 3) % n]) + sum(2..n, |j| x[(j + 1) % n] * y[(j - 1) % n].powi(2)),
)]
struct Ring {
    n: usize,
    k: Vec<f64>,
}

fn ring_by_hand(system: &Ring, q: &[f64]) -> Vec<Sum> {
    let (n, k) = (system.n, &system.k);
    let (x, y) = q.split_at(n);
    let at = |j: usize, steps: usize| (j + steps) % n;
    // Two steps back.
    let back = |j: usize| (j + 2 * n - 2) % n;
    let cubic: f64 = (0..n).map(|j| k[at(j, 1)] * x[j] * x[at(j, 1)] * y[back(j)]).sum();
    let square: f64 = (0..n).map(|j| x[j] * y[at(j, 3)]).sum();
    let mut gradient = vec![Sum::default(); 2 * n];
    for j in 0..n {
        gradient[j].add(square * k[at(j, 1)] * x[at(j, 1)] * y[back(j)]);
        gradient[at(j, 1)].add(square * k[at(j, 1)] * x[j] * y[back(j)]);
        gradient[n + back(j)].add(square * k[at(j, 1)] * x[j] * x[at(j, 1)]);
        gradient[j].add(cubic * y[at(j, 3)]);
        gradient[n + at(j, 3)].add(cubic * x[j]);
        if j > 1 {
            gradient[at(j, 1)].add(y[j - 1].powi(2));
            gradient[n + j - 1].add(2.0 * x[at(j, 1)] * y[j - 1]);
        }
    }
    // The sums are known to rounding errors of their terms only.
    for entry in &mut gradient {
        entry.size += (2 * n) as f64;
    }
    gradient
}

#[test]
fn entries_around_the_end_of_a_ring() {
    for n in SIZES {
        let (system, q) = (Ring { n, k: numbers(n, 13) }, numbers(2 * n, 14));
        let mut gradient = vec![0.0; 2 * n];
        system.hamiltonian_gradient(&q, 0.0, &mut gradient);
        agree(&gradient, &ring_by_hand(&system, &q), &format!("a ring of {n}"));
        lanes_agree(
            &q,
            |q, out| system.hamiltonian_gradient(q, Lanes::all(0.0), out),
            |q, out| system.hamiltonian_gradient(q, 0.0, out),
        );
    }
}
