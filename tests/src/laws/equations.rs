//! The equations that a step solves, as far as the laws know them.

use dvi_core::Real;

use crate::larger;

/// Of a scheme.
#[derive(Clone, Debug)]
pub enum Equations {
    /// Those of a discrete Lagrangian h Σ wⱼ L(qʲ, q̇ʲ, t + cⱼh).
    Discrete(Nodes),
    /// M(x1 − x0)/h = p0 + h[(½ − β)F0 + βF1] and p1 = p0 + (h/2)(F0 + F1), with F = ∂L/∂q.
    Newmark(f64),
    /// ∂L/∂v = p + h Σ aᵢⱼ (∂L/∂q + F) at the stages of a regular system, and d/dt ∂L/∂v = ∂L/∂q + F at
    /// those of a degenerate one.
    Collocation(usize),
    /// Held against the motion alone.
    Elsewhere,
}

impl Equations {
    /// The share of h² q̈ by which the coordinates of a conjugate form differ from q.
    pub fn shift(&self) -> f64 {
        match self {
            Self::Newmark(beta) => -beta,
            Self::Discrete(_) | Self::Collocation(_) | Self::Elsewhere => 0.0,
        }
    }
}

/// Nodes and weights, the derivatives of the Lagrange polynomials of the interior nodes if these are
/// displaced, and the frequency of the interpolation, 0 for a linear one.
#[derive(Clone, Debug)]
pub struct Nodes {
    /// On [0, 1].
    pub c: Vec<f64>,
    /// Weights.
    pub w: Vec<f64>,
    /// Of the polynomial of interior node k + 1 at node j.
    pub displaced: Vec<Vec<f64>>,
    /// Frequency.
    pub omega: f64,
    /// Whether the weights make the momenta of the oscillator exact too.
    pub fitted_momenta: bool,
}

impl Nodes {
    /// A rule, without displacements.
    pub fn new(c: &[f64], w: &[f64]) -> Self {
        Self { c: c.to_vec(), w: w.to_vec(), displaced: Vec::new(), omega: 0.0, fitted_momenta: false }
    }

    /// Interior displacements.
    pub fn lobatto(nodes: usize) -> Self {
        let (c, w) = lobatto(nodes);
        let of = |k| c.iter().map(|&at| lagrange_derivative(&c, k, at)).collect();
        let displaced = (1..nodes - 1).map(of).collect();
        Self { displaced, ..Self::new(&c, &w) }
    }

    /// With interpolation by sines.
    #[must_use]
    pub fn fitted(self, omega: f64) -> Self {
        Self { omega, ..self }
    }

    /// The coefficients of q0 and q1 in q and in h q̇ at node c: linear, or sines of u (Kosmas &
    /// Vlachos, eq. 15).
    pub fn interpolation(&self, c: f64, h: f64) -> [f64; 4] {
        let u = self.omega * h;
        if u == 0.0 {
            return [1.0 - c, c, -1.0, 1.0];
        }
        let (left, right, sine) = ((1.0 - c) * u, c * u, u.sin());
        [left.sin() / sine, right.sin() / sine, -u * left.cos() / sine, u * right.cos() / sine]
    }

    /// q and h q̇ at node j, with displacements of one interior node after the other.
    fn at_node<T: Real>(&self, j: usize, h: f64, [q0, q1]: [&[T]; 2], displacements: &[T]) -> [Vec<T>; 2] {
        let n = q0.len();
        let [b0, b1, d0, d1] = self.interpolation(self.c[j], h).map(T::lift);
        let mut point: Vec<T> = (0..n).map(|i| b0 * q0[i] + b1 * q1[i]).collect();
        let mut velocity: Vec<T> = (0..n).map(|i| d0 * q0[i] + d1 * q1[i]).collect();
        for (k, displacement) in displacements.chunks(n).enumerate() {
            let derivative = T::lift(self.displaced[k][j]);
            for i in 0..n {
                velocity[i] += derivative * displacement[i];
                if j == k + 1 {
                    point[i] += displacement[i];
                }
            }
        }
        [point, velocity]
    }

    /// h Σ wⱼ L(qʲ, q̇ʲ, t + cⱼh)
    pub fn discrete_lagrangian<T: Real>(
        &self,
        lagrangian: impl Fn(&[T], &[T], T) -> T,
        [t, h]: [f64; 2],
        ends: [&[T]; 2],
        displacements: &[T],
    ) -> T {
        let mut sum = T::lift(0.0);
        for (j, (&c, w)) in self.c.iter().zip(self.weights(h)).enumerate() {
            let [point, mut velocity] = self.at_node(j, h, ends, displacements);
            velocity.iter_mut().for_each(|v| *v /= T::lift(h));
            sum += T::lift(h * w) * lagrangian(&point, &velocity, T::lift(t + c * h));
        }
        sum
    }

    /// h Σ wⱼ F(qʲ, q̇ʲ, t + cⱼh)·∂qʲ by q0, by q1, and by the displacements.
    pub fn discrete_forces(
        &self,
        force: impl Fn(&[f64], &[f64], f64) -> Vec<f64>,
        [t, h]: [f64; 2],
        ends: [&[f64]; 2],
        displacements: &[f64],
    ) -> [Vec<f64>; 3] {
        let n = ends[0].len();
        let mut work = [vec![0.0; n], vec![0.0; n], vec![0.0; displacements.len()]];
        for (j, (&c, w)) in self.c.iter().zip(self.weights(h)).enumerate() {
            let [point, mut velocity] = self.at_node(j, h, ends, displacements);
            velocity.iter_mut().for_each(|v| *v /= h);
            let [b0, b1, ..] = self.interpolation(c, h);
            for (i, force) in force(&point, &velocity, t + c * h).iter().enumerate() {
                work[0][i] += h * w * b0 * force;
                work[1][i] += h * w * b1 * force;
                if j > 0 && j <= displacements.len() / n {
                    work[2][(j - 1) * n + i] += h * w * force;
                }
            }
        }
        work
    }

    /// The weights with a step.
    pub fn weights(&self, h: f64) -> Vec<f64> {
        let u = self.omega * h;
        if !self.fitted_momenta {
            return self.w.clone();
        }
        let sum: f64 = self.c.iter().zip(&self.w).map(|(c, w)| w * ((1.0 - 2.0 * c) * u).cos()).sum();
        self.w.iter().map(|w| w * (u.sin() / u) / sum).collect()
    }
}

/// P_n and its first two derivatives at x inside, by the recurrence of the polynomials and their
/// differential equation.
fn legendre(n: usize, x: f64) -> [f64; 3] {
    let (mut last, mut value) = (1.0, x);
    for k in 2..=n {
        let k = k as f64;
        (last, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * last) / k);
    }
    let n = n as f64;
    let first = n * (last - x * value) / (1.0 - x * x);
    [value, first, (2.0 * x * first - n * (n + 1.0) * value) / (1.0 - x * x)]
}

/// The Lobatto rules on [0, 1]: both ends, and the zeros of P'ₛ₋₁ by Newton's method from the extrema of
/// a Chebyshev polynomial; weights 2/(s(s−1)P²ₛ₋₁) on [−1, 1] (Abramowitz & Stegun 1964, 25.4.32).
fn lobatto(nodes: usize) -> (Vec<f64>, Vec<f64>) {
    let n = nodes - 1;
    let rule = (0..nodes).map(|j| {
        let mut x = -(core::f64::consts::PI * j as f64 / n as f64).cos();
        let mut value: f64 = 1.0;
        if j > 0 && j < n {
            for _ in 0..8 {
                let [_, first, second] = legendre(n, x);
                x -= first / second;
            }
            [value, ..] = legendre(n, x);
        }
        ((1.0 + x) / 2.0, 1.0 / ((nodes * n) as f64 * value * value))
    });
    rule.unzip()
}

/// The derivative at `at` of the Lagrange polynomial of node k.
fn lagrange_derivative(nodes: &[f64], k: usize, at: f64) -> f64 {
    let factor = |m: usize| (at - nodes[m]) / (nodes[k] - nodes[m]);
    let others = || (0..nodes.len()).filter(move |&m| m != k);
    others().map(|m| others().filter(|&l| l != m).map(factor).product::<f64>() / (nodes[k] - nodes[m])).sum()
}

/// Nodes, weights and matrix of Gauss collocation, from zeros of Legendre polynomials and integrals of
/// Lagrange polynomials.
#[derive(Clone, Debug)]
pub struct Tableau {
    /// Matrix.
    pub a: Vec<Vec<f64>>,
    /// Weights.
    pub b: Vec<f64>,
    /// Nodes.
    pub c: Vec<f64>,
}

impl Tableau {
    /// Of so many stages.
    pub fn gauss(stages: usize) -> Self {
        let legendre = |x: f64| if stages == 1 { [x, 1.0, 0.0] } else { legendre(stages, x) };
        let zero = |i: usize| {
            let guess = -(core::f64::consts::PI * (i as f64 + 0.75) / (stages as f64 + 0.5)).cos();
            (0..20).fold(guess, |x, _| x - legendre(x)[0] / legendre(x)[1])
        };
        let zeros: Vec<f64> = (0..stages).map(zero).collect();
        let b: Vec<f64> = zeros.iter().map(|&x| 1.0 / ((1.0 - x * x) * legendre(x)[1].powi(2))).collect();
        let c: Vec<f64> = zeros.iter().map(|x| (1.0 + x) / 2.0).collect();
        let lagrange = |j: usize, x: f64| -> f64 {
            (0..stages).filter(|&k| k != j).map(|k| (x - c[k]) / (c[j] - c[k])).product()
        };
        let integral =
            |j: usize, end: f64| end * b.iter().zip(&c).map(|(b, c)| b * lagrange(j, end * c)).sum::<f64>();
        let a = c.iter().map(|&end| (0..stages).map(|j| integral(j, end)).collect()).collect();
        Self { a, b, c }
    }
}

/// Whether every number is one, and none is far from the others.
pub fn apart(a: &[f64], b: &[f64]) -> f64 {
    let scale = b.iter().fold(1.0, |scale: f64, x| larger(scale, x.abs()));
    if a.len() == b.len() { crate::apart(a, b) / scale } else { f64::NAN }
}
