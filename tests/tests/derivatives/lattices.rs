//! Lattices by hand, as sums over bonds.

use dvi_tests::zoo::lattices::{AblowitzLadik, Schroedinger};

use crate::derivatives::oracle::{ByHand, Number, Random};

/// Re Σ ψⱼ ψ*ⱼ₊ₛ
fn hopping<D: Number>(q: &[D], apart: usize) -> D {
    let n = q.len() / 2;
    let bond = |j: usize| {
        let k = if j + apart < n { j + apart } else { j + apart - n };
        q[j] * q[k] + q[n + j] * q[n + k]
    };
    (0..n).map(bond).sum()
}

fn density<D: Number>(q: &[D], j: usize) -> D {
    q[j] * q[j] + q[q.len() / 2 + j] * q[q.len() / 2 + j]
}

impl<const N: usize> ByHand for Schroedinger<N> {
    fn alpha<D: Number>(&self, q: &[D], _t: D) -> Vec<D> {
        (0..2 * N).map(|i| if i < N { q[N + i] } else { D::zero() }).collect()
    }
    fn energy<D: Number>(&self, q: &[D], _t: D) -> D {
        let onsite: D = (0..N).map(|j| density(q, j) * density(q, j)).sum();
        onsite * (self.lambda / 4.0) - hopping(q, 1) * self.hopping[0] - hopping(q, 2) * self.hopping[1]
    }
    fn integrals<D: Number>(&self, q: &[D], _t: D) -> Vec<D> {
        vec![(0..N).map(|j| density(q, j) / 2.0).sum()]
    }
}

impl<const N: usize> ByHand for AblowitzLadik<N> {
    fn alpha<D: Number>(&self, q: &[D], _t: D) -> Vec<D> {
        let factor = |j: usize| (density(q, j) + 1.0).ln() / density(q, j) / 2.0;
        let along_q = (0..N).map(|j| factor(j) * q[N + j]);
        along_q.chain((0..N).map(|j| -factor(j) * q[j])).collect()
    }
    fn energy<D: Number>(&self, q: &[D], _t: D) -> D {
        -hopping(q, 1)
    }
    fn integrals<D: Number>(&self, q: &[D], _t: D) -> Vec<D> {
        vec![(0..N).map(|j| (density(q, j) + 1.0).ln()).sum()]
    }
    fn point(&self, random: &mut Random) -> Vec<f64> {
        self.within(random, 0.3, 1.5)
    }
}
