//! The B-splines along one axis: the cells between their knots, and their polynomials in each cell.
//!
//! With knots t₀ ≤ t₁ ≤ …, the B-splines of degree k are those of degree k − 1, blended (de Boor, *A
//! Practical Guide to Splines*, 2001, chapter IX):
//!
//! Bⱼₖ(x) = (x − tⱼ)/(tⱼ₊ₖ − tⱼ) Bⱼ,ₖ₋₁(x) + (tⱼ₊ₖ₊₁ − x)/(tⱼ₊ₖ₊₁ − tⱼ₊₁) Bⱼ₊₁,ₖ₋₁(x)
//!
//! On a cell [tᵢ, tᵢ₊₁], p + 1 of degree p are not zero. Their coefficients in powers of s = (x − tᵢ)/(tᵢ₊₁
//! − tᵢ) are computed once. An evaluation divides by nothing, and what it reads depends on the cell only.
//!
//! Without a period the knots are the points of the grid but (p − 1)/2 next to each end, which are "not a
//! knot" (chapter IV), and the two ends are knots p + 1 times. With a period all points are knots, and so
//! are their repetitions.

use alloc::vec::Vec;

use super::Axis;
use crate::Scalar;

/// The coefficients of a polynomial of the largest degree, which is 5.
pub(super) const ORDER: usize = 6;

/// A number in a cell: which one, and the B-splines that are not zero there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Local<T> {
    /// Counted from 0; the first of the B-splines has the same number.
    pub(super) cell: T,
    /// The reciprocal of the width of the cell.
    pub(super) reciprocal: T,
    /// The B-splines with their first two derivatives in s.
    pub(super) functions: [[T; 3]; ORDER],
}

impl<T: Scalar> Local<T> {
    /// Nothing yet.
    pub(super) fn none() -> Self {
        let zero = T::lift(0.0);
        Self { cell: zero, reciprocal: zero, functions: [[zero; 3]; ORDER] }
    }
}

/// B-splines of degree P on one axis.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Basis<const P: usize> {
    /// p knots, the ends of the cells in increasing order, p knots.
    knots: Vec<f64>,
    /// The reciprocal widths of the cells.
    reciprocals: Vec<f64>,
    /// Of each cell the p + 1 polynomials, with p + 1 coefficients each, those of higher powers later.
    polynomials: Vec<f64>,
    /// Cells per unit of length from the second end on, if that shows the cell up to one.
    density: Option<f64>,
    period: Option<f64>,
}

impl<const P: usize> Basis<P> {
    /// The B-splines on an axis that has more than P points.
    pub(super) fn new(axis: &Axis) -> Self {
        let points = axis.points();
        let count = points.len();
        let knots: Vec<f64> = match axis.period() {
            None => {
                let (first, last, skipped) = (points[0], points[count - 1], P.div_ceil(2));
                let inner = &points[skipped..count - skipped];
                let ends = |x| core::iter::repeat_n(x, P + 1);
                ends(first).chain(inner.iter().copied()).chain(ends(last)).collect()
            }
            Some(period) => {
                let before = points[count - P..].iter().map(|x| x - period);
                let after = points[..=P].iter().map(|x| x + period);
                before.chain(points.iter().copied()).chain(after).collect()
            }
        };
        let cells = knots.len() - 2 * P - 1;
        let around = |cell: usize| &knots[cell..cell + 2 * P + 2];
        let reciprocals = (0..cells).map(around).map(|t| 1.0 / (t[P + 1] - t[P])).collect();
        let polynomials = (0..cells).flat_map(|cell| polynomials::<P>(around(cell))).collect();
        let density = density(&knots[P..P + cells + 1]);
        Self { density, reciprocals, polynomials, period: axis.period(), knots }
    }

    pub(super) fn cells(&self) -> usize {
        self.reciprocals.len()
    }

    /// The least and the largest number at which the B-splines are known.
    pub(super) fn domain(&self) -> (f64, f64) {
        match self.period {
            None => self.ends(),
            Some(_) => (f64::NEG_INFINITY, f64::INFINITY),
        }
    }

    fn ends(&self) -> (f64, f64) {
        (self.knots[P], self.knots[P + self.cells()])
    }

    /// The number itself, or what it is in the first period; not a number outside of the domain.
    fn position(&self, x: f64) -> f64 {
        let (first, last) = self.ends();
        if first <= x && x <= last {
            return x;
        }
        let Some(period) = self.period else { return f64::NAN };
        // A remainder has no rounding error, however large the quotient is.
        let beyond = (x - first) % period;
        // Sums are rounded to the end at most, which is rounded from the first point plus the period.
        first + if beyond < 0.0 { beyond + period } else { beyond }
    }

    /// The cell of a position, and 0 of what is not a number.
    fn cell(&self, x: f64) -> usize {
        let (last, ends) = (self.cells() - 1, &self.knots[P..]);
        match self.density {
            // Negative numbers become 0.
            Some(density) => match (((x - ends[1]) * density + 1.0) as usize).min(last) {
                guess if x < ends[guess] => guess.saturating_sub(1),
                guess if x >= ends[guess + 1] => (guess + 1).min(last),
                guess => guess,
            },
            None => ends[1..=last].partition_point(|&end| end <= x),
        }
    }

    /// The B-splines at `x`, not numbers outside of the domain.
    pub(super) fn at<T: Scalar>(&self, x: T) -> Local<T> {
        let position = x.piecewise(|x| self.position(x));
        let cell = position.piecewise(|x| self.cell(x) as f64);
        let start = cell.piecewise(|cell| entry(&self.knots, P + cell as usize, 1, 0));
        let reciprocal = cell.piecewise(|cell| entry(&self.reciprocals, cell as usize, 1, 0));
        // What is subtracted has the value of x: zero is left, with the derivatives of x.
        let differential = x - x.piecewise(|x| x);
        let s = (differential + (position - start)) * reciprocal;
        let coefficient = |function: usize, power: usize| {
            let (size, at) = ((P + 1) * (P + 1), function * (P + 1) + power);
            cell.piecewise(|cell| entry(&self.polynomials, cell as usize * size, size, at))
        };
        let mut local = Local { cell, reciprocal, ..Local::none() };
        for i in 0..=P {
            local.functions[i] = horner::<P, T>(|power| coefficient(i, power), s);
        }
        local
    }
}

/// An entry of a row of a table. One beyond its end is not a number: a wrong index is seen in what is
/// computed from it.
#[inline]
pub(super) fn entry(table: &[f64], start: usize, width: usize, at: usize) -> f64 {
    // All entries of a row ask the same question, and one answer serves them.
    match table.get(start..start.wrapping_add(width)) {
        Some(row) => row[at],
        None => f64::NAN,
    }
}

/// A polynomial with its first two derivatives.
fn horner<const P: usize, T: Scalar>(coefficient: impl Fn(usize) -> T, s: T) -> [T; 3] {
    let (mut value, mut first, mut half_second) = (coefficient(P), T::lift(0.0), T::lift(0.0));
    for power in (0..P).rev() {
        if power + 2 < P {
            half_second = half_second * s + first;
        } else if power + 2 == P {
            half_second = first;
        }
        first = if power + 1 == P { value } else { first * s + value };
        value = value * s + coefficient(power);
    }
    [value, first, half_second + half_second]
}

/// Cells per unit of length between the second and the last but one of their ends, if that shows the cell up
/// to one.
fn density(ends: &[f64]) -> Option<f64> {
    let cells = ends.len() - 1;
    if cells < 3 {
        return Some(0.0);
    }
    let density = (cells - 2) as f64 / (ends[cells - 1] - ends[1]);
    let is_near = |i: usize| ((ends[i] - ends[1]) * density + 1.0 - i as f64).abs() <= 0.5;
    (1..cells).all(is_near).then_some(density)
}

/// The coefficients of the p + 1 B-splines in the cell between the knots p and p + 1 of those given.
fn polynomials<const P: usize>(knots: &[f64]) -> impl Iterator<Item = f64> + use<P> {
    let (start, width) = (knots[P], knots[P + 1] - knots[P]);
    let mut of_degree = [[0.0; ORDER]; ORDER];
    of_degree[0][0] = 1.0;
    for k in 1..=P {
        let lower = core::mem::take(&mut of_degree);
        for (i, function) in lower.iter().enumerate().take(k) {
            // Bⱼ of the lower degree, on the knots from j to j + k, rises in the next function and falls in
            // this one.
            let j = P + 1 - k + i;
            let span = knots[j + k] - knots[j];
            let slope = width / span;
            let (rise, fall) = ((start - knots[j]) / span, (knots[j + k] - start) / span);
            for power in 0..k {
                of_degree[i + 1][power] += rise * function[power];
                of_degree[i + 1][power + 1] += slope * function[power];
                of_degree[i][power] += fall * function[power];
                of_degree[i][power + 1] -= slope * function[power];
            }
        }
    }
    of_degree.into_iter().take(P + 1).flat_map(|function| function.into_iter().take(P + 1))
}
