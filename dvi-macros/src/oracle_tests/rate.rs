//! dF/dt of a gauge F along (v, 1), as a jet.
//!
//! The first derivatives of dF/dt are second ones of F, which its jet has. Of the third ones, only those
//! along (v, 1) are asked for: the second derivatives of F are differenced along that line, to the eighth
//! order. What twice the step and what the sixth order make of it otherwise is taken for the error: either
//! of the two may vanish where the error does not.

use super::evaluate::{Oracle, Outside, Point};
use super::formula::Formula;
use super::jet::{Jet, Sized};
use super::system::System;

const STEP: f64 = 2e-3;
/// So many steps before and behind are values asked for: 1 to 4, and twice as many.
const PLACES: [i32; 6] = [1, 2, 3, 4, 6, 8];
const SINGLE: [usize; 4] = [0, 1, 2, 3];
const DOUBLE: [usize; 4] = [1, 3, 4, 5];
/// Of the difference of the values k steps before and behind; for both orders.
const EIGHTH: [f64; 4] = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];
const SIXTH: [f64; 4] = [3.0 / 4.0, -3.0 / 20.0, 1.0 / 60.0, 0.0];

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

/// A derivative and its error, from the differences of the values at all places before and behind.
fn derivative(differences: [f64; 6]) -> [f64; 2] {
    let quotient = |weights: [f64; 4], places: [usize; 4], step: f64| {
        let terms = weights.iter().zip(places).map(|(weight, place)| weight * differences[place]);
        terms.sum::<f64>() / step
    };
    let [value, of_sixth] = [EIGHTH, SIXTH].map(|weights| quotient(weights, SINGLE, STEP));
    let of_double = quotient(EIGHTH, DOUBLE, 2.0 * STEP);
    [value, (value - of_double).abs() + (value - of_sixth).abs()]
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
    let at = |steps: i32| {
        let shift = f64::from(steps) * STEP;
        let q = point.q.iter().zip(&point.v).map(|(q, v)| q + shift * v).collect();
        let moved = Point { q, v: point.v.clone(), t: point.t + shift };
        Oracle::new(system, &moved).value(gauge)
    };
    let here = at(0)?;
    let pairs = PLACES.map(|steps| Ok([at(steps)?, at(-steps)?]));
    let pairs = pairs.into_iter().collect::<Result<Vec<[Jet; 2]>, Outside>>()?;
    let along = |entry: &dyn Fn(usize) -> Sized| {
        (0..n).fold(entry(2 * n), |sum, i| sum.plus(entry(i).times(Sized::new(point.v[i]))))
    };
    let speed = point.v.iter().fold(1.0, |sum, v| sum + v.abs());
    let third = |i: usize, j: usize| {
        let [value, error] = derivative(std::array::from_fn(|place| {
            let [ahead, behind] = &pairs[place];
            ahead.hessian(i, j).value - behind.hessian(i, j).value
        }));
        Third { value, error, size: value.abs() + here.hessian(i, j).size * speed }
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

/// Quotients of waves of all lengths, at all phases: where the error is not too much to tell anything, it is
/// no less than that of the derivative.
#[test]
fn errors_are_no_less_than_they_are() {
    let mut fine = 0;
    for (frequency, phase) in (1..120).flat_map(|frequency| (0..1000).map(move |phase| (frequency, phase))) {
        let (k, phase) = (f64::from(frequency), f64::from(phase) * std::f64::consts::TAU / 1000.0);
        let at = |steps: i32| 1.0 / (1.5 + (k * f64::from(steps) * STEP + phase).sin());
        let [value, error] = derivative(PLACES.map(|steps| at(steps) - at(-steps)));
        let exact = -k * phase.cos() * at(0).powi(2);
        let third = Third { value, error, size: value.abs() };
        if !third.is_coarse() {
            let allowed = error + ALLOWED * (third.size + 1.0);
            assert!((value - exact).abs() < allowed, "{value} ± {error} of {exact}, {frequency} at {phase}");
            fine += 1;
        }
    }
    assert!(fine > 30_000, "{fine} derivatives are told");
}
