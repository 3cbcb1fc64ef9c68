//! Warnings, turned into errors here so that they are seen.

#![deny(unused_variables, deprecated)]

use dvi_core::prelude::*;

#[degenerate_lagrangian(
    coordinates(x[3], y[3]),
    one_form    = sum(0..3, |j| x[j] * d(y[j])),
    hamiltonian = {
        let stiffness = 2.0;
        let _nothing = 1.0;
        sum(0..3, |j| x[j] * y[j]) + sum(0..3, |k| x[0]) + sum(0..3, |j| sum(0..2, |j| x[j]) * y[j])
    },
)]
pub struct System;

#[lagrangian(
    coordinates(x[3]),
    lagrangian = sum(0..3, |j| dot(x[j]).powi(2)),
    constraint(i in 0..3) = {
        let unused = 1.0;
        x[i] - sum(0..3, |i| x[i])
    },
)]
pub struct Constrained;

#[lagrangian(
    coordinates(x[3]),
    lagrangian = sum(0..3, |j| kinetic(j)) - sum(0..3, |twice| x[0]),
    momenta(half = twice / 4.0),
    let = {
        let kinetic = |j| dot(x[j]).powi(2);
        let twice = 2.0 * x[1];
        let gap = |j, k| x[j] - x[0];
        let (sine, cosine) = x[0].sin_cos();
        let _nothing = cosine;
    },
)]
pub struct Sharing;

fn main() {}
