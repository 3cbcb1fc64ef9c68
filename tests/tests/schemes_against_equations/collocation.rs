//! Gauss collocation: ∂L/∂v = p + h Σ aᵢⱼ (∂L/∂q + F) at the stages of a regular system, and d/dt ∂L/∂v =
//! ∂L/∂q + F at those of a degenerate one, solved here with matrices of differences. Where they are stiff no
//! fixed point contracts.

use dvi_core::methods::Method;
use dvi_core::prelude::*;
use dvi_core::state::Statistics;
use dvi_core::{Lagrangian, State};
use dvi_tests::larger;
use nalgebra::{DMatrix, DVector, RealField, convert};
use num_dual::{Dual64, HyperDual64};

use super::equations::{Formula, dual, size};
use super::systems::{Breathing, Coupled, Driven, Fast, Guiding, Magnetic, Shaken};
use super::{Outcome, START, STEPS};

/// Nodes, weights and matrix, from zeros of Legendre polynomials and integrals of Lagrange polynomials.
struct Tableau {
    a: Vec<Vec<f64>>,
    b: Vec<f64>,
    c: Vec<f64>,
}

impl Tableau {
    fn new(stages: usize) -> Self {
        let legendre = |x: f64| {
            let (mut before, mut value) = (0.0, 1.0);
            for k in 0..stages {
                let degree = k as f64;
                let next = ((2.0 * degree + 1.0) * x * value - degree * before) / (degree + 1.0);
                (before, value) = (value, next);
            }
            (value, stages as f64 * (before - x * value) / (1.0 - x * x))
        };
        let zero = |i: usize| {
            let guess = -(core::f64::consts::PI * (i as f64 + 0.75) / (stages as f64 + 0.5)).cos();
            (0..20).fold(guess, |x, _| x - legendre(x).0 / legendre(x).1)
        };
        let zeros: Vec<f64> = (0..stages).map(zero).collect();
        let b: Vec<f64> = zeros.iter().map(|&x| 1.0 / ((1.0 - x * x) * legendre(x).1.powi(2))).collect();
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

/// ∂L/∂q + F and ∂L/∂v.
fn derivatives<F: Formula>(formula: &F, q: &[f64], v: &[f64], t: f64) -> [Vec<f64>; 2] {
    let n = q.len();
    let value = |a, b| formula.lagrangian(&dual(q, a), &dual(v, b), Dual64::from(t)).eps;
    let mut force = formula.force(q, v, t);
    force.resize(n, 0.0);
    [
        (0..n).map(|i| value(Some(i), None) + force[i]).collect(),
        (0..n).map(|i| value(None, Some(i))).collect(),
    ]
}

/// d/dt ∂L/∂v where ∂L/∂v does not depend on v.
fn rate<F: Formula>(formula: &F, q: &[f64], v: &[f64], t: f64) -> Vec<f64> {
    let along = |x: f64, rate: f64| HyperDual64::new(x, 0.0, rate, 0.0);
    let point: Vec<_> = q.iter().zip(v).map(|(&q, &v)| along(q, v)).collect();
    let of = |i: usize| {
        let unit = |j: usize| if i == j { 1.0 } else { 0.0 };
        let velocity: Vec<_> =
            v.iter().enumerate().map(|(j, &v)| HyperDual64::new(v, unit(j), 0.0, 0.0)).collect();
        formula.lagrangian(&point, &velocity, along(t, 1.0)).eps1eps2
    };
    (0..q.len()).map(of).collect()
}

/// A step: where it begins, as (q, p), when, and how long it is.
struct Step<'a, F> {
    formula: &'a F,
    regular: bool,
    q: &'a [f64],
    p: &'a [f64],
    /// Near the velocities.
    v: &'a [f64],
    t: f64,
    h: f64,
}

impl<F: Formula> Step<'_, F> {
    fn moved(&self, weights: &[f64], velocities: &[f64]) -> Vec<f64> {
        let n = self.q.len();
        let sum = |i: usize| weights.iter().enumerate().map(|(j, w)| w * velocities[j * n + i]).sum::<f64>();
        (0..n).map(|i| self.q[i] + self.h * sum(i)).collect()
    }

    /// The residuals at the velocities of all stages, and the forces.
    fn residuals(&self, tableau: &Tableau, velocities: &[f64]) -> [Vec<f64>; 2] {
        let n = self.q.len();
        let (mut residuals, mut forces) = (Vec::new(), Vec::new());
        for ((a, c), v) in tableau.a.iter().zip(&tableau.c).zip(velocities.chunks(n)) {
            let (q, t) = (self.moved(a, velocities), self.t + c * self.h);
            let [force, momentum] = derivatives(self.formula, &q, v, t);
            if self.regular {
                residuals.extend(momentum.iter().zip(self.p).map(|(momentum, p)| momentum - p));
            } else {
                let rate = rate(self.formula, &q, v, t);
                residuals.extend(rate.iter().zip(&force).map(|(rate, force)| rate - force));
            }
            forces.extend(force);
        }
        if self.regular {
            for (i, a) in tableau.a.iter().enumerate() {
                for (j, a) in a.iter().enumerate() {
                    (0..n).for_each(|k| residuals[i * n + k] -= self.h * a * forces[j * n + k]);
                }
            }
        }
        [residuals, forces]
    }

    /// The point at the end of the step, q and p.
    fn solve(&self, tableau: &Tableau) -> Option<[Vec<f64>; 2]> {
        let size = self.q.len() * tableau.b.len();
        let mut velocities = DVector::from_fn(size, |i, _| self.v[i % self.v.len()]);
        for _ in 0..30 {
            let [residuals, _] = self.residuals(tableau, velocities.as_slice());
            let mut matrix = DMatrix::zeros(size, size);
            for k in 0..size {
                let difference = 1e-6 * (1.0 + f64::abs(velocities[k]));
                let mut at = |sign: f64| {
                    let mut moved = velocities.clone();
                    moved[k] += sign * difference;
                    let [residuals, _] = self.residuals(tableau, moved.as_slice());
                    matrix.column_mut(k).axpy(sign / (2.0 * difference), &DVector::from_vec(residuals), 1.0);
                };
                at(1.0);
                at(-1.0);
            }
            velocities -= matrix.lu().solve(&DVector::from_vec(residuals))?;
        }
        let [_, forces] = self.residuals(tableau, velocities.as_slice());
        let n = self.q.len();
        let impulse =
            |i: usize| tableau.b.iter().enumerate().map(|(j, b)| b * forces[j * n + i]).sum::<f64>();
        let p = (0..n).map(|i| self.p[i] + self.h * impulse(i)).collect();
        Some([self.moved(&tableau.b, velocities.as_slice()), p])
    }
}

/// Steps of a method against the equations.
fn follow<S: Lagrangian + Formula, M: Method<S, f64>>(
    system: &S,
    method: M,
    tableau: &Tableau,
    h: f64,
    (q, v): (&[f64], &[f64]),
    bound: f64,
) -> Result<Statistics, Box<dyn core::error::Error>> {
    let name = format!("{}, {} stages, h = {h}", S::REPORT.system, tableau.b.len());
    let state = S::State::read(|block| system.block_len(block), q, v);
    let mut run = Integrator::new_at(system, method, START, h, state)?;
    // q, p and v; a degenerate system has the last two as zeros.
    let phase = |state: &S::State<f64>, t: f64| -> Result<[Vec<f64>; 3], Box<dyn core::error::Error>> {
        let mut point: Vec<f64> = system.values(state)?.collect();
        let mut v = point.split_off(q.len());
        v.resize(q.len(), 0.0);
        let p = if S::REGULAR { derivatives(system, &point, &v, t)[1].clone() } else { v.clone() };
        Ok([point, p, v])
    };
    for step in 0..3 {
        let (t, [q, p, v]) = (run.time(), phase(&run.state(), run.time())?);
        let solved = Step { formula: system, regular: S::REGULAR, q: &q, p: &p, v: &v, t, h }.solve(tableau);
        let expected = solved.ok_or("the matrix is regular")?;
        run.advance()?;
        let found = phase(&run.state(), run.time())?;
        for (found, expected) in found.iter().zip(&expected).take(if S::REGULAR { 2 } else { 1 }) {
            let off = found.iter().zip(expected).fold(0.0, |off, (a, b)| larger(off, (a - b).abs()));
            let off = off / (1.0 + size(expected));
            assert!(off < bound, "{name}, step {step}: {off:e}");
        }
    }
    Ok(run.statistics())
}

/// One by one and in lanes, with every solver and 1, 2, 4 and 8 stages. With long steps the fixed point
/// fails.
macro_rules! check {
    ($system:expr, $start:expr) => {
        for h in STEPS {
            for solver in [Solver::Automatic, Solver::FixedPoint, Solver::Newton] {
                check!(@stages 1 2 4 8; $system, $start, h, solver, 1e-12);
            }
        }
    };
    ($system:expr, $start:expr, $h:expr) => {
        for solver in [Solver::Automatic, Solver::Newton, Solver::NewtonKrylov] {
            check!(@stages 1 2 4 8; $system, $start, $h, solver, 1e-9);
        }
        check!(@fails 1 2 4; $system, $start, $h);
    };
    (@stages $($stages:literal)*; $system:expr, $start:expr, $h:expr, $solver:expr, $bound:expr) => {$(
        let (tableau, method) = (Tableau::new($stages), Gauss { solver: $solver, ..Gauss::<$stages>::new() });
        let alone = follow($system, method, &tableau, $h, $start, $bound)?;
        let together = follow($system, method.in_lanes(), &tableau, $h, $start, $bound)?;
        assert_eq!(alone, together);
        // The fixed point of eight stages contracts on some of the stiff systems too.
        if $stages < 8 || $bound < 1e-10 {
            assert_eq!(alone.linearizations > 0, $solver == Solver::Newton || $bound > 1e-10, "{alone:?}");
        }
    )*};
    (@fails $($stages:literal)*; $system:expr, $start:expr, $h:expr) => {$(
        let method = Gauss { solver: Solver::FixedPoint, ..Gauss::<$stages>::new() };
        assert!(follow($system, method, &Tableau::new($stages), $h, $start, 1.0).is_err(), "{} stages", $stages);
    )*};
}

#[test]
fn regular_systems() -> Outcome {
    let planar: (&[f64], &[f64]) = (&[0.5, -0.2], &[0.4, -0.3]);
    check!(&Shaken { depth: 0.4 }, planar);
    check!(&Magnetic { b: 0.7 }, planar);
    check!(&Fast { field: 0.6 }, planar);
    check!(&Coupled { mass: vec![1.0, 2.0] }, planar);
    Ok(())
}

#[test]
fn degenerate_systems() -> Outcome {
    check!(&Driven {}, (&[0.4, -0.3], &[]));
    check!(&Breathing { depth: 0.3 }, (&[0.4, -0.3], &[]));
    check!(&Guiding { kappa: 0.4 }, (&[0.6, -0.5, 0.2, 0.7], &[]));
    Ok(())
}

/// A hard spring that is not linear, in the plane: separable, with two masses.
#[lagrangian(
    coordinates(x, y),
    lagrangian = dot(x).powi(2) / 2.0 + 1.5 * dot(y).powi(2) - k * (x.hypot(y) - 1.0).powi(2) / 2.0 - x * y,
)]
struct Spring {
    k: f64,
}

impl Formula for Spring {
    fn lagrangian<T: RealField + Copy>(&self, q: &[T], v: &[T], _t: T) -> T {
        let real = convert::<f64, T>;
        let stretched = (q[0] * q[0] + q[1] * q[1]).sqrt() - real(1.0);
        v[0] * v[0] * real(0.5) + v[1] * v[1] * real(1.5)
            - real(self.k / 2.0) * stretched * stretched
            - q[0] * q[1]
    }
}

/// Masses that depend on the place and on time, a magnetic term, and hard friction.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (2.0 + x.sin()) * dot(x).powi(2) / 2.0 + (0.2 * t).exp() * dot(y).powi(2) / 2.0 + b * x * dot(y)
        - k * (x - 0.3 * y * y).powi(2) / 2.0,
    force(x) = -gamma * (dot(x) + 0.03 * dot(x).powi(3) - dot(y)),
)]
struct Rubbing {
    b: f64,
    k: f64,
    gamma: f64,
}

impl Formula for Rubbing {
    fn lagrangian<T: RealField + Copy>(&self, q: &[T], v: &[T], t: T) -> T {
        let real = convert::<f64, T>;
        let off = q[0] - real(0.3) * q[1] * q[1];
        let masses = (real(2.0) + q[0].sin()) * v[0] * v[0] + (real(0.2) * t).exp() * v[1] * v[1];
        masses * real(0.5) + real(self.b) * q[0] * v[1] - real(self.k / 2.0) * off * off
    }
    fn force(&self, _q: &[f64], v: &[f64], _t: f64) -> Vec<f64> {
        vec![-self.gamma * (v[0] + 0.03 * v[0].powi(3) - v[1])]
    }
}

/// A mass matrix that is not diagonal, and a size that the run knows.
#[lagrangian(
    coordinates(q[n]),
    lagrangian = sum(0..n, |j| dot(q[j]).powi(2)) / 2.0 + 0.3 * sum(1..n, |j| dot(q[j]) * dot(q[j - 1]))
        - k * sum(0..n, |j| q[j].powi(2) / 2.0 + q[j].powi(4)),
)]
struct Linked {
    n: usize,
    k: f64,
}

impl Formula for Linked {
    fn lagrangian<T: RealField + Copy>(&self, q: &[T], v: &[T], _t: T) -> T {
        let real = convert::<f64, T>;
        (0..self.n).fold(real(0.0), |sum, j| {
            let linked = if j == 0 { real(0.0) } else { real(0.3) * v[j] * v[j - 1] };
            let square = q[j] * q[j];
            sum + v[j] * v[j] * real(0.5) + linked - real(self.k) * (square * real(0.5) + square * square)
        })
    }
}

/// α = p·dq, with a force, and a size that the run knows.
#[degenerate_lagrangian(
    coordinates(x[n], p[n]),
    one_form = sum(0..n, |j| p[j] * d(x[j])),
    hamiltonian = sum(0..n, |j| p[j] * p[j] / 2.0 + k * (x[j] - 0.3 * x[(j + 1) % n].powi(2)).powi(2) / 2.0),
    force(x) = |j| -gamma * p[j],
)]
struct Canonical {
    n: usize,
    k: f64,
    gamma: f64,
}

impl Formula for Canonical {
    fn lagrangian<T: RealField + Copy>(&self, q: &[T], v: &[T], _t: T) -> T {
        let (real, n) = (convert::<f64, T>, self.n);
        (0..n).fold(real(0.0), |sum, j| {
            let off = q[j] - real(0.3) * q[(j + 1) % n] * q[(j + 1) % n];
            sum + q[n + j] * v[j] - q[n + j] * q[n + j] * real(0.5) - real(self.k / 2.0) * off * off
        })
    }
    fn force(&self, q: &[f64], _v: &[f64], _t: f64) -> Vec<f64> {
        q[self.n..].iter().map(|p| -self.gamma * p).collect()
    }
}

/// α depends on time and on the coordinates, of which it is no linear function, and H is stiff.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = (y + y.powi(3) / 3.0 + 0.2 * t * x * y) * d(x),
    hamiltonian = k * (x * x / 2.0 + y * y / 2.0 + x.powi(4) / 4.0),
)]
struct Bent {
    k: f64,
}

impl Formula for Bent {
    fn lagrangian<T: RealField + Copy>(&self, q: &[T], v: &[T], t: T) -> T {
        let (real, [x, y]) = (convert::<f64, T>, [q[0], q[1]]);
        let form = y + y * y * y / real(3.0) + real(0.2) * t * x * y;
        form * v[0] - real(self.k) * ((x * x + y * y) * real(0.5) + x * x * x * x * real(0.25))
    }
}

#[test]
fn stiff_regular_systems() -> Outcome {
    check!(&Spring { k: 1e4 }, (&[0.6, 0.8], &[-0.24, 0.18]), 0.1);
    check!(&Rubbing { b: 0.7, k: 2e4, gamma: 200.0 }, (&[0.15, -0.7], &[0.4, -0.3]), 0.2);
    check!(&Linked { n: 2, k: 4e4 }, (&[0.05, -0.02], &[0.4, -0.3]), 0.2);
    Ok(())
}

#[test]
fn stiff_degenerate_systems() -> Outcome {
    check!(&Canonical { n: 2, k: 1e3, gamma: 0.5 }, (&[0.1, 0.05, 0.3, -0.2], &[]), 0.2);
    check!(&Bent { k: 40.0 }, (&[0.1, -0.2], &[]), 0.2);
    Ok(())
}
