//! Sizes that are sums, fields of fields, `min` and `max` by hand.

use dvi_tests::zoo::language::{Corners, Nested};

use crate::derivatives::oracle::{ByHand, Number};

impl<const N: usize> ByHand for Nested<N> {
    fn alpha<D: Number>(&self, q: &[D], _t: D) -> Vec<D> {
        let sizes = [N + 1, 2 * N, self.material.masses.len()];
        let mut alpha = Vec::new();
        for size in sizes {
            let first = &q[alpha.len()..][..size];
            alpha.extend(std::iter::repeat_n(D::zero(), size).chain(first.iter().copied()));
        }
        alpha
    }
    fn energy<D: Number>(&self, q: &[D], _t: D) -> D {
        let masses = &self.material.masses;
        let (x, rest) = q.split_at(N + 1);
        let (y, rest) = rest.split_at(N + 1);
        let (u, rest) = rest.split_at(2 * N);
        let (v, rest) = rest.split_at(2 * N);
        let (w, z) = rest.split_at(masses.len());
        let springs = x.windows(2).map(|pair| (pair[1] - pair[0]).powi(2) * self.material.elastic.k);
        let squares = y.iter().map(|&y| y * y);
        let products = u.iter().zip(v).map(|(&u, &v)| u * v);
        let weighted = (0..masses.len()).map(|j| w[j] * z[j] * z[j] * masses[j]);
        springs.chain(squares).chain(products).chain(weighted).sum()
    }
}

impl ByHand for Corners {
    fn alpha<D: Number>(&self, q: &[D], _t: D) -> Vec<D> {
        let (x, y) = (q[0], q[1]);
        vec![D::zero(), x + if y.re() <= 0.3 { y * y } else { y * 0.3 }]
    }
    fn energy<D: Number>(&self, q: &[D], _t: D) -> D {
        let (x, y) = (q[0], q[1]);
        let larger = if x.re() <= (y * y).re() { y * y } else { x };
        let smaller = if (x * x).re() <= y.re() { x * x } else { y };
        let larger = if larger.re() <= 0.1 { D::from(0.1) } else { larger };
        smaller * 3.0 + larger.sin() - x * 2.0
    }
}
