//! Sums by hand, as loops.

use dvi_tests::zoo::sums::{FunctionsOfSums, NestedSums, OrderedPairs, Staircase};

use crate::derivatives::oracle::{ByHand, Number};

fn sum<D: Number>(n: usize, f: impl Fn(usize) -> D) -> D {
    (0..n).map(f).sum()
}

/// The components along all x, then along all y.
fn components<D>(n: usize, along_x: impl Fn(usize) -> D, along_y: impl Fn(usize) -> D) -> Vec<D> {
    (0..n).map(along_x).chain((0..n).map(along_y)).collect()
}

impl<const N: usize> ByHand for FunctionsOfSums<N> {
    fn alpha<D: Number>(&self, q: &[D], _t: D) -> Vec<D> {
        let root = (sum(N, |j| q[j] * q[j]) + 1.0).sqrt();
        components(N, |k| root * q[N + k], |j| q[j] / 4.0)
    }
    fn energy<D: Number>(&self, q: &[D], _t: D) -> D {
        let (x, y) = q.split_at(N);
        let radius = sum(N, |j| (x[j] * x[j] + y[j] * y[j]) * self.m[j]).sqrt();
        let product = sum(N, |j| x[j].sin()) * sum(N, |k| y[k] * y[k] * self.m[k]);
        let quotient = sum(N, |j| x[j] * y[j]).cos() / (sum(N, |j| y[j] * y[j]) + 1.0);
        radius + product + quotient
    }
}

impl<const N: usize> ByHand for NestedSums<N> {
    fn alpha<D: Number>(&self, q: &[D], _t: D) -> Vec<D> {
        let along_y = |j: usize| q[j] + q[j] * sum(N, |k| q[k] * self.c[k][j]).sin();
        components(N, |_| D::zero(), along_y)
    }
    fn energy<D: Number>(&self, q: &[D], _t: D) -> D {
        let (x, y) = q.split_at(N);
        let mut total = D::zero();
        for j in 0..N {
            let mut weights = D::zero();
            let mut inner = D::zero();
            for k in 0..N {
                let apart = x[j] - y[k];
                weights += (-(apart * apart * self.c[j][k])).exp();
                inner += (sum(N, |l| x[l] * self.c[k][l]) * y[j]).sin() * x[k];
            }
            total += weights.ln() + inner * inner;
        }
        total
    }
}

impl<const N: usize> ByHand for Staircase<N> {
    fn alpha<D: Number>(&self, q: &[D], _t: D) -> Vec<D> {
        let (x, y) = q.split_at(N);
        components(N, |_| D::zero(), |j| x[j] + sum(j, |k| x[k] * y[k]))
    }
    fn energy<D: Number>(&self, q: &[D], _t: D) -> D {
        let (x, y) = q.split_at(N);
        let mut total = D::zero();
        for last in 1..N {
            for k in 1..=last {
                total += (x[k] - y[k - 1]) * (x[k] - y[k - 1]) * y[last - 1];
            }
        }
        for j in 1..4 {
            total += sum(N - j, |k| x[k] * x[k + j] * y[j]).sin();
        }
        total + sum(N, |j| x[j] * y[N - 1 - j] * (j + 1) as f64)
    }
}

impl<const N: usize> ByHand for OrderedPairs<N> {
    fn alpha<D: Number>(&self, q: &[D], _t: D) -> Vec<D> {
        let other = |j: usize, k: usize| if j == k { D::zero() } else { q[j] * self.c[j][k] };
        components(N, |_| D::zero(), |k| q[k] + q[k] * sum(N, |j| other(j, k)))
    }
    fn energy<D: Number>(&self, q: &[D], _t: D) -> D {
        let (x, y) = q.split_at(N);
        let mut forces = D::zero();
        let mut inner = D::from(2.0);
        let mut pairs = D::zero();
        for j in 0..N {
            for k in (0..N).filter(|k| *k != j) {
                forces += (x[j] - x[k]).sin() * y[j] * self.c[j][k];
                inner += x[j] * y[k] * y[k];
                for l in (0..N).filter(|_| j < k) {
                    for m in l + 1..N {
                        pairs += x[j] * x[l] * (y[k] - y[m]).cos();
                    }
                }
            }
        }
        forces + inner.ln() + pairs
    }
    fn point(&self, random: &mut crate::derivatives::oracle::Random) -> Vec<f64> {
        self.within(random, -0.5, 0.8)
    }
}
