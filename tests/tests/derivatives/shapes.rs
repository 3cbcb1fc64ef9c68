//! Run-time sizes, borrowed parameters and a full Lagrangian by hand.

use dvi_tests::zoo::shapes::{Borrowing, Chain, FullLagrangian};

use crate::derivatives::oracle::{ByHand, Number};

impl ByHand for Chain {
    fn alpha<D: Number>(&self, q: &[D], _t: D) -> Vec<D> {
        let (_, p) = q.split_at(self.n);
        p.iter().copied().chain(vec![D::zero(); self.n]).collect()
    }
    fn energy<D: Number>(&self, q: &[D], _t: D) -> D {
        let (angle, p) = q.split_at(self.n);
        let mass = f64::from(self.mass);
        let pendula: D = (0..self.n).map(|j| p[j] * p[j] / (2.0 * mass) - angle[j].cos()).sum();
        let springs: D =
            (1..self.n).map(|j| ((angle[j] - angle[j - 1]) / 2.0).sin().powi(2) * self.k[j - 1]).sum();
        pendula + springs * 2.0
    }
}

impl<const N: usize> ByHand for Borrowing<'_, N> {
    fn alpha<D: Number>(&self, q: &[D], _t: D) -> Vec<D> {
        let along_y = (0..N).map(|j| q[j] * self.weights[j]);
        vec![D::zero(); N].into_iter().chain(along_y).collect()
    }
    fn energy<D: Number>(&self, q: &[D], _t: D) -> D {
        let pairs = (0..N).flat_map(|k| (0..k).map(move |j| (j, k)));
        pairs.map(|(j, k)| (q[j] - q[N + k]).exp() * (self.coupling[j][k] * self.scale)).sum()
    }
}

/// Coordinates x, y, u₀, u₁, w₀, w₁.
impl ByHand for FullLagrangian {
    fn alpha<D: Number>(&self, q: &[D], _t: D) -> Vec<D> {
        let [x, y] = [q[0], q[1]];
        let (u, w) = (&q[2..4], &q[4..6]);
        let along_u = w[0].sin() + w[1].sin();
        let along_w = |j: usize| u[j] * (x * u[j] + 1.0);
        let along_x = y - (x * x + 1.0).recip() * 2.0;
        vec![along_x, x.exp() + y * y, along_u, D::zero(), along_w(0), along_w(1)]
    }
    fn energy<D: Number>(&self, q: &[D], _t: D) -> D {
        let [x, y] = [q[0], q[1]];
        let (u, w) = (&q[2..4], &q[4..6]);
        let branch = if x.re() > y.re() { x } else { -y * y * y };
        let body = |j: usize| w[j] * w[j] + u[j].cosh() - u[j] * w[j] * (x * u[j] + 1.0) * self.c;
        body(0) + body(1) - branch - x * x * (x.exp() + y * y) - x * 2.0 / (x * x + 1.0)
    }
    /// As it was declared, before any splitting.
    fn whole<D: Number>(&self, q: &[D], v: &[D], _t: D) -> D {
        let [x, y, dx, dy] = [q[0], q[1], v[0], v[1]];
        let (u, w, dw) = (&q[2..4], &q[4..6], &v[4..6]);
        let branch = if x.re() > y.re() { dx * y + x } else { dx * y - y * y * y };
        let body = |j: usize| u[j] * (dw[j] + w[j] * self.c) * (x * u[j] + 1.0) - w[j] * w[j] - u[j].cosh();
        (x * x + dy) * (x.exp() + y * y) - (dx - x) * 2.0 / (x * x + 1.0)
            + branch
            + body(0)
            + body(1)
            + v[2] * (w[0].sin() + w[1].sin())
    }
}
