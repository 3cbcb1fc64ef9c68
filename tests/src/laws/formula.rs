//! The formulas of a system, on dual numbers.
//!
//! They are evaluated as they are generated, which the compiler holds against those that are written,
//! and its oracle on random systems. Derivatives are those of dual numbers, and none is generated, so that a
//! mistake of a scheme or of the compiler shows.

use dvi_core::prelude::*;
use dvi_core::{HolonomicLagrangian, Lagrangian, NonholonomicLagrangian, Space};
use num_dual::{Dual64, HyperDual64};

use super::systems::{Driven, Shaken};
use crate::zoo::constrained::Pendulum;
use crate::zoo::nonholonomic::KnifeEdge;

/// The constraints of a system of some kind.
pub trait Bound<S> {
    /// The holonomic constraints.
    fn constraints(_system: &S, _q: &[HyperDual64], _t: HyperDual64) -> Vec<HyperDual64> {
        Vec::new()
    }

    /// The constraints of the velocities.
    fn slips(_system: &S, _q: &[HyperDual64], _v: &[HyperDual64], _t: HyperDual64) -> Vec<HyperDual64> {
        Vec::new()
    }
}

impl<S> Bound<S> for <Driven as System>::Kind {}

impl<S> Bound<S> for <Shaken as System>::Kind {}

impl<S: HolonomicLagrangian<HyperDual64>> Bound<S> for <Pendulum as System>::Kind {
    fn constraints(system: &S, q: &[HyperDual64], t: HyperDual64) -> Vec<HyperDual64> {
        let mut values = vec![t; system.multipliers().dimension()];
        system.constraint(q, t, &mut values);
        values
    }
}

impl<S: NonholonomicLagrangian<HyperDual64>> Bound<S> for <KnifeEdge as System>::Kind {
    fn slips(system: &S, q: &[HyperDual64], v: &[HyperDual64], t: HyperDual64) -> Vec<HyperDual64> {
        let mut values = vec![t; system.multipliers().dimension()];
        system.velocity_constraint(q, v, t, &mut values);
        values
    }
}

/// The formulas of a system, on the numbers that oracles need; none of their derivatives.
pub trait Formula {
    /// L(q, v, t)
    fn dual(&self, q: &[Dual64], v: &[Dual64], t: Dual64) -> Dual64;
    /// The same, to be differentiated twice.
    fn hyper(&self, q: &[HyperDual64], v: &[HyperDual64], t: HyperDual64) -> HyperDual64;
    /// The forces on all coordinates.
    fn force(&self, q: &[f64], v: &[f64], t: f64) -> Vec<f64>;
    /// The holonomic constraints.
    fn constraints(&self, q: &[HyperDual64], t: HyperDual64) -> Vec<HyperDual64>;
    /// The constraints of the velocities.
    fn slips(&self, q: &[HyperDual64], v: &[HyperDual64], t: HyperDual64) -> Vec<HyperDual64>;
}

impl<S> Formula for S
where
    S: Lagrangian + Lagrangian<Dual64> + Lagrangian<HyperDual64> + System<Kind: Bound<S>>,
{
    fn dual(&self, q: &[Dual64], v: &[Dual64], t: Dual64) -> Dual64 {
        self.lagrangian(q, v, t)
    }
    fn hyper(&self, q: &[HyperDual64], v: &[HyperDual64], t: HyperDual64) -> HyperDual64 {
        self.lagrangian(q, v, t)
    }
    fn force(&self, q: &[f64], v: &[f64], t: f64) -> Vec<f64> {
        let mut forces = vec![0.0; q.len()];
        self.applied_force(q, v, t, &mut forces);
        forces
    }
    fn constraints(&self, q: &[HyperDual64], t: HyperDual64) -> Vec<HyperDual64> {
        S::Kind::constraints(self, q, t)
    }
    fn slips(&self, q: &[HyperDual64], v: &[HyperDual64], t: HyperDual64) -> Vec<HyperDual64> {
        S::Kind::slips(self, q, v, t)
    }
}

/// Numbers with a derivative of one along one of them.
pub fn dual(x: &[f64], direction: Option<usize>) -> Vec<Dual64> {
    let unit = |i| if Some(i) == direction { 1.0 } else { 0.0 };
    x.iter().enumerate().map(|(i, &x)| Dual64::new(x, unit(i))).collect()
}

/// Numbers x with derivatives along two directions.
pub fn hyper(x: &[f64], one: impl Fn(usize) -> f64, other: impl Fn(usize) -> f64) -> Vec<HyperDual64> {
    x.iter().enumerate().map(|(i, &x)| HyperDual64::new(x, one(i), other(i), 0.0)).collect()
}

/// Numbers with their derivative, and one of one along one of them.
pub fn along(x: &[Dual64], direction: Option<usize>) -> Vec<HyperDual64> {
    let unit = |i| if Some(i) == direction { 1.0 } else { 0.0 };
    x.iter().enumerate().map(|(i, x)| HyperDual64::new(x.re, unit(i), x.eps, 0.0)).collect()
}

/// One along direction `i`.
pub fn unit(i: usize) -> impl Fn(usize) -> f64 {
    move |j| if i == j { 1.0 } else { 0.0 }
}

/// Nothing, along any.
pub fn none(_: usize) -> f64 {
    0.0
}
