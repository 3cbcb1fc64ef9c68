//! dF/dt of a gauge F along (v, 1), as a jet.
//!
//! The first derivatives of dF/dt are second ones of F, which its jet has. Of the third ones, only those
//! along (v, 1) are asked for: the second derivatives of F are differenced along that line, to the eighth
//! order, and ten times the difference from the sixth order is taken for the error.

use super::evaluate::{Oracle, Outside, Point};
use super::formula::Formula;
use super::jet::{Jet, Sized};
use super::system::System;

const STEP: f64 = 4e-3;
/// Of the difference of the values k steps before and behind; for both orders.
const EIGHTH: [f64; 4] = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];
const SIXTH: [f64; 4] = [3.0 / 4.0, -3.0 / 20.0, 1.0 / 60.0, 0.0];

/// Where the derivatives of F grow fast, the eighth order is not much better than the sixth.
const SAFETY: f64 = 10.0;

/// An error above this part of the terms is too much to tell anything.
const COARSE: f64 = 1e-6;
/// What [`super::compare`] allows, relative to the size of the terms.
const ALLOWED: f64 = 1e-10;

/// A third derivative along the line.
struct Third {
    value: f64,
    /// No less than the error of the value.
    error: f64,
    size: f64,
}

impl Third {
    fn is_coarse(&self) -> bool {
        self.error > COARSE * (self.size + 1.0)
    }

    fn sized(&self) -> Sized {
        Sized { value: self.value, size: self.size + self.error / ALLOWED }
    }
}

pub(super) fn rate(system: &System, gauge: &Formula, point: &Point) -> Result<Jet, Outside> {
    let n = system.dimension();
    let at = |steps: f64| {
        let q = point.q.iter().zip(&point.v).map(|(q, v)| q + steps * STEP * v).collect();
        let moved = Point { q, v: point.v.clone(), t: point.t + steps * STEP };
        Oracle::new(system, &moved).value(gauge)
    };
    let here = at(0.0)?;
    let mut pairs = Vec::new();
    for steps in 1..=EIGHTH.len() {
        pairs.push([at(steps as f64)?, at(-(steps as f64))?]);
    }
    let along = |entry: &dyn Fn(usize) -> Sized| {
        (0..n).fold(entry(2 * n), |sum, i| sum.plus(entry(i).times(Sized::new(point.v[i]))))
    };
    let speed = point.v.iter().fold(1.0, |sum, v| sum + v.abs());
    let third = |i: usize, j: usize| {
        let difference = |weights: [f64; 4]| {
            let parts = pairs.iter().zip(weights);
            let parts = parts.map(|([ahead, behind], weight)| {
                weight * (ahead.hessian(i, j).value - behind.hessian(i, j).value) / STEP
            });
            parts.sum::<f64>()
        };
        let (value, coarser) = (difference(EIGHTH), difference(SIXTH));
        Third {
            value,
            error: SAFETY * (value - coarser).abs(),
            size: value.abs() + here.hessian(i, j).size * speed,
        }
    };
    let positions = || (0..n).chain([2 * n]);
    if positions().any(|i| positions().any(|j| third(i, j).is_coarse())) {
        return Err(Outside::Domain);
    }
    let is_position = |i: usize| i < n || i == 2 * n;
    let position = |i: usize| if i == 2 * n { i } else { i % n };
    Ok(Jet::from_derivatives(
        along(&|i| here.gradient(i)),
        2 * n + 1,
        |i| if is_position(i) { along(&|j| here.hessian(i, j)) } else { here.gradient(position(i)) },
        |i, j| match (is_position(i), is_position(j)) {
            (true, true) => third(i, j).sized(),
            (false, false) => Sized::default(),
            _ => here.hessian(position(i), position(j)),
        },
    ))
}
