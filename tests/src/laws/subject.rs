//! What follows from the Lagrangian of a system: momenta, forces, equations of motion, the motion.

use core::cell::OnceCell;

use dvi_core::Lagrangian;
use dvi_core::mechanics::Rates;
use dvi_core::prelude::*;
use nalgebra::{DMatrix, DVector};
use num_dual::{Dual64, HyperDual64};

use super::formula::{Formula, along, dual, hyper, none, unit};
use crate::{larger, state};

/// The largest entry.
pub fn size(vector: &[f64]) -> f64 {
    vector.iter().fold(0.0, |size: f64, entry| larger(size, entry.abs()))
}

/// The largest entry of a + sign·b.
pub fn defect(a: &[f64], sign: f64, b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |size: f64, (a, b)| larger(size, (a + sign * b).abs()))
}

type Field = dyn Fn(f64, &[f64]) -> Result<Vec<f64>, StartError>;

/// What the laws know of a system: its formula, and where and when runs begin.
pub struct Subject {
    /// Of the system.
    pub name: &'static str,
    /// Whether L has velocities in more than a one-form, so that states have velocities.
    pub regular: bool,
    /// Coordinates, and velocities if there are any.
    pub start: [Vec<f64>; 2],
    /// When runs begin.
    pub t: f64,
    /// Steps that are short enough for every scheme.
    pub h: f64,
    /// How many of these leave parasites small.
    pub steps: u32,
    /// For how long errors are let grow where orders are measured.
    pub time: f64,
    formula: &'static dyn Formula,
    field: Box<Field>,
    end: OnceCell<Vec<f64>>,
}

impl core::fmt::Debug for Subject {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(self.name)
    }
}

impl Subject {
    /// Of a run from `start` at time `t` with steps of length `h`.
    pub fn new<S>(system: &'static S, start: [&[f64]; 2], [t, h]: [f64; 2]) -> Self
    where
        S: Lagrangian + Formula + System<Kind: Rates<S, f64>>,
    {
        let (name, regular, start) = (S::REPORT.system, S::REGULAR, start.map(<[f64]>::to_vec));
        let n = start[0].len();
        let field = move |t: f64, values: &[f64]| {
            let (q, v) = values.split_at(n);
            let here = state(system, q, v);
            let rates = system.vector_field(t, &here)?;
            let values = [system.lagrangian_at(t, &here)?, system.energy_at(t, &here)?];
            Ok(system.values(&rates)?.chain(values).collect())
        };
        Self {
            name,
            regular,
            start,
            t,
            h,
            time: 2.0,
            steps: 80,
            formula: system,
            field: Box::new(field),
            end: OnceCell::new(),
        }
    }

    /// What the library says of a state: its rates of change, L along them and E.
    ///
    /// # Errors
    /// Those of the library.
    pub fn said(&self, t: f64, values: &[f64]) -> Result<Vec<f64>, StartError> {
        (self.field)(t, values)
    }

    /// With so few steps.
    #[must_use]
    pub fn few(self, steps: u32) -> Self {
        Self { steps, time: 1.0, ..self }
    }

    /// The number of coordinates.
    pub fn dimension(&self) -> usize {
        self.start[0].len()
    }

    /// L on dual numbers.
    pub fn lagrangian(&self, q: &[Dual64], v: &[Dual64], t: f64) -> Dual64 {
        self.formula.dual(q, v, Dual64::from(t))
    }

    /// L on hyper-dual numbers.
    pub fn twice(&self, q: &[HyperDual64], v: &[HyperDual64], t: HyperDual64) -> HyperDual64 {
        self.formula.hyper(q, v, t)
    }

    /// The forces on all coordinates.
    pub fn force(&self, q: &[f64], v: &[f64], t: f64) -> Vec<f64> {
        self.formula.force(q, v, t)
    }

    /// Whether there are any.
    pub fn is_forced(&self) -> bool {
        let [q, v] = &self.start;
        self.force(q, v, self.t).iter().any(|&force| force != 0.0)
    }

    /// Whether the one-form depends on the time.
    pub fn form_is_driven(&self) -> bool {
        size(&self.momentum_rates(&self.start[0], &vec![0.0; self.dimension()], self.t)) > 0.0
    }

    /// Whether L is a one-form with a constant Dα, and a function.
    pub fn is_affine(&self) -> bool {
        let n = self.dimension();
        let rest = vec![0.0; n];
        let bent = |i: usize, j: usize| {
            // ∂αᵢ/∂qʲ at two points of a line, and two times.
            let slope = |by: f64| {
                let (q, t): (Vec<f64>, _) =
                    (self.start[0].iter().map(|q| q * by + by).collect(), HyperDual64::from(self.t + by));
                self.twice(&hyper(&q, none, unit(j)), &hyper(&rest, unit(i), none), t).eps1eps2
            };
            (slope(1.0) - slope(0.7)).abs() > 1e-12
        };
        !self.regular && !(0..n * n).any(|k| bent(k / n, k % n))
    }

    /// Variations of coordinates and velocities that keep to the constraints: all of them, without
    /// these.
    pub fn directions(&self) -> Vec<Vec<f64>> {
        let ([q, v], n) = (&self.start, self.dimension());
        let rows = self.constraint_rows(q, self.t);
        if rows.nrows() == 0 {
            let size = n + v.len();
            return (0..size).map(|i| (0..size).map(unit(i)).collect()).collect();
        }
        // Of g and of ġ = G(q)v + ∂g/∂t, whose derivative by q is that of G v.
        let by = |j: usize| {
            let moved = |by: f64| -> Vec<f64> { (0..n).map(|i| q[i] + by * unit(j)(i)).collect() };
            let rate = |by: f64| self.constraint_rates(&moved(by), v, self.t)[1].clone();
            let (ahead, behind) = (rate(1e-6), rate(-1e-6));
            ahead.iter().zip(&behind).map(|(a, b)| (a - b) / 2e-6).collect::<Vec<f64>>()
        };
        let bent: Vec<Vec<f64>> = (0..n).map(by).collect();
        let m = rows.nrows();
        let all = DMatrix::from_fn(2 * m, 2 * n, |k, i| match (k < m, i < n) {
            (true, true) => rows[(k, i)],
            (true, false) => 0.0,
            (false, true) => bent[i][k - m],
            (false, false) => rows[(k - m, i - n)],
        });
        let normal = (&all * all.transpose()).lu();
        let along = |i: usize| {
            let unit = DVector::from_fn(2 * n, |j, _| unit(i)(j));
            let off = normal.solve(&(&all * &unit)).map_or(unit.clone() * f64::NAN, |x| all.transpose() * x);
            (unit - off).as_slice().to_vec()
        };
        (0..2 * n).map(along).collect()
    }

    /// p = ∂L/∂v
    pub fn momenta(&self, q: &[f64], v: &[f64], t: f64) -> Vec<f64> {
        let q = dual(q, None);
        (0..q.len()).map(|i| self.lagrangian(&q, &dual(v, Some(i)), t).eps).collect()
    }

    /// ∂L/∂q + F
    pub fn pull(&self, q: &[f64], v: &[f64], t: f64) -> Vec<f64> {
        let (forces, still) = (self.force(q, v, t), dual(v, None));
        let by = |i: usize| self.lagrangian(&dual(q, Some(i)), &still, t).eps;
        (0..q.len()).map(|i| by(i) + forces[i]).collect()
    }

    /// d/dt ∂L/∂v where velocities do not change.
    pub fn momentum_rates(&self, q: &[f64], v: &[f64], t: f64) -> Vec<f64> {
        let (q, t) = (hyper(q, none, |i| v[i]), HyperDual64::new(t, 0.0, 1.0, 0.0));
        (0..q.len()).map(|i| self.twice(&q, &hyper(v, unit(i), none), t).eps1eps2).collect()
    }

    /// The derivative of ∂L/∂v along that of a point.
    pub fn varied_momenta(&self, q: &[Dual64], v: &[Dual64], t: f64) -> Vec<f64> {
        let (point, t) = (along(q, None), HyperDual64::from(t));
        (0..q.len()).map(|i| self.twice(&point, &along(v, Some(i)), t).eps1eps2).collect()
    }

    /// The gradients of the constraints, a row for each, by the velocities where these are constrained.
    pub fn constraint_rows(&self, q: &[f64], t: f64) -> DMatrix<f64> {
        let (n, t, still, rest) = (q.len(), HyperDual64::from(t), hyper(q, none, none), vec![0.0; q.len()]);
        let by = |i| {
            let mut values = self.formula.constraints(&hyper(q, unit(i), none), t);
            values.extend(self.formula.slips(&still, &hyper(&rest, unit(i), none), t));
            values
        };
        let columns: Vec<Vec<HyperDual64>> = (0..n).map(by).collect();
        DMatrix::from_fn(columns[0].len(), n, |k, i| columns[i][k].eps1)
    }

    /// The constraints, and how fast they change: g, ġ and what g̈ is without an acceleration; behind ġ and
    /// g̈ the constraints of the velocities and what their rates are.
    pub fn constraint_rates(&self, q: &[f64], v: &[f64], t: f64) -> [Vec<f64>; 3] {
        let (q, t) = (hyper(q, |i| v[i], |i| v[i]), HyperDual64::new(t, 1.0, 1.0, 0.0));
        let (values, slips) =
            (self.formula.constraints(&q, t), self.formula.slips(&q, &hyper(v, none, none), t));
        let first = values.iter().map(|x| x.eps1).chain(slips.iter().map(|x| x.re));
        let second = values.iter().map(|x| x.eps1eps2).chain(slips.iter().map(|x| x.eps1));
        [values.iter().map(|x| x.re).collect(), first.collect(), second.collect()]
    }

    /// By how much velocities do not fulfil their constraints.
    pub fn slips(&self, q: &[f64], v: &[f64], t: f64) -> Vec<f64> {
        let [values, rates, _] = self.constraint_rates(q, v, t);
        rates[values.len()..].to_vec()
    }

    /// The rates of change of coordinates and velocities, by d/dt ∂L/∂v = ∂L/∂q + F + Gᵀλ with Gv̇ + ġ =
    /// 0.
    pub fn rates(&self, values: &[f64], t: f64) -> Vec<f64> {
        let n = self.dimension();
        let q = &values[..n];
        let (rest, zero) = (vec![0.0; n], HyperDual64::from(t));
        if !self.regular {
            // (∂αᵢ/∂qʲ − ∂αⱼ/∂qⁱ) q̇ʲ = −∂H/∂qⁱ − ∂αᵢ/∂t + Fᵢ
            let by =
                |i, j| self.twice(&hyper(q, none, unit(j)), &hyper(&rest, unit(i), none), zero).eps1eps2;
            let slopes = DMatrix::from_fn(n, n, by);
            let (pull, rate) = (self.pull(q, &rest, t), self.momentum_rates(q, &rest, t));
            let right = DVector::from_fn(n, |i, _| pull[i] - rate[i]);
            return solved(&slopes - slopes.transpose(), &right).as_slice().to_vec();
        }
        let v = &values[n..];
        let rows = self.constraint_rows(q, t);
        let [.., bent] = self.constraint_rates(q, v, t);
        let (pull, rate, m) = (self.pull(q, v, t), self.momentum_rates(q, v, t), rows.nrows());
        let still = hyper(q, none, none);
        let mass = |i, j| self.twice(&still, &hyper(v, unit(i), unit(j)), zero).eps1eps2;
        let matrix = DMatrix::from_fn(n + m, n + m, |i, j| match (i < n, j < n) {
            (true, true) => mass(i, j),
            (true, false) => -rows[(j - n, i)],
            (false, true) => rows[(i - n, j)],
            (false, false) => 0.0,
        });
        let right = DVector::from_fn(n + m, |i, _| if i < n { pull[i] - rate[i] } else { -bent[i - n] });
        [v, &solved(matrix, &right).as_slice()[..n]].concat()
    }

    /// The same as it follows from the formula, E = ∂L/∂v·v − L.
    pub fn expected(&self, values: &[f64], t: f64) -> Vec<f64> {
        let (rates, (q, v)) = (self.rates(values, t), values.split_at(self.dimension()));
        let v = if self.regular { v } else { &rates };
        let along = self.lagrangian(&dual(q, None), &dual(v, None), t).re;
        let twice: f64 = self.momenta(q, v, t).iter().zip(v).map(|(p, v)| p * v).sum();
        [&rates[..], &[along, twice - along]].concat()
    }

    /// The derivative of the rates along that of a point, by central differences of eighth order.
    pub fn varied_rates(&self, values: &[Dual64], t: f64) -> Vec<f64> {
        const APART: f64 = 1.0 / 256.0;
        let at = |by: f64| -> Vec<f64> {
            self.rates(&values.iter().map(|x| x.re + by * APART * x.eps).collect::<Vec<_>>(), t)
        };
        let mut sum = vec![0.0; values.len()];
        for (by, weight) in [(1.0, 4.0 / 5.0), (2.0, -1.0 / 5.0), (3.0, 4.0 / 105.0), (4.0, -1.0 / 280.0)] {
            let ends = at(by).into_iter().zip(at(-by));
            sum.iter_mut().zip(ends).for_each(|(sum, (b, a))| *sum += weight / APART * (b - a));
        }
        sum
    }

    /// Coordinates and velocities at the end of the time, by extrapolation of Gragg's midpoint rule in
    /// steps of which errors are far below those of any scheme (Hairer, Nørsett & Wanner 1993, section
    /// II.9).
    pub fn end(&self) -> &[f64] {
        const PARTS: u32 = 64;
        self.end.get_or_init(|| {
            let h = self.time / f64::from(PARTS);
            let begin = DVector::from_vec(self.start.concat());
            let end =
                (0..PARTS).fold(begin, |y, part| self.extrapolated(&y, self.t + f64::from(part) * h, h));
            end.as_slice().to_vec()
        })
    }

    fn extrapolated(&self, y: &DVector<f64>, t: f64, h: f64) -> DVector<f64> {
        const ROWS: usize = 7;
        let slope = |y: &DVector<f64>, t: f64| DVector::from_vec(self.rates(y.as_slice(), t));
        let first = slope(y, t);
        let mut rows: Vec<DVector<f64>> = Vec::new();
        for k in 0..ROWS {
            let parts = 2 * (k + 1);
            let h = h / parts as f64;
            let (mut before, mut now) = (y.clone(), y + &first * h);
            for part in 1..parts {
                let next = &before + slope(&now, t + part as f64 * h) * (2.0 * h);
                (before, now) = (now, next);
            }
            // Aitken and Neville in h², from the last row to the first.
            let mut entry = now;
            for j in 0..k {
                let ratio = ((k + 1) as f64 / (k - j) as f64).powi(2);
                let better = &entry + (&entry - &rows[j]) / (ratio - 1.0);
                rows[j] = core::mem::replace(&mut entry, better);
            }
            rows.push(entry);
        }
        rows.remove(ROWS - 1)
    }
}

/// x with Ax = b; no numbers where A is singular.
fn solved(matrix: DMatrix<f64>, right: &DVector<f64>) -> DVector<f64> {
    let none = DVector::from_element(right.len(), f64::NAN);
    matrix.lu().solve(right).unwrap_or(none)
}
