//! The mass matrix ∂²L/∂v∂v of a regular Lagrangian: what makes it singular for certain.

use dvi_core::prelude::*;

fn run<S: RegularLagrangian>(system: &S, state: S::State<f64>) {
    let _ = (system.energy(&[0.0], &[0.0], 0.0), state);
}

#[lagrangian(coordinates(x, y), lagrangian = x * dot(y) - x * y)]
pub struct Affine;
const _: fn() = || run(&Affine, AffineState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });

#[lagrangian(coordinates(x, y), lagrangian = x * y)]
pub struct NoVelocity;
const _: fn() = || run(&NoVelocity, NoVelocityState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });

#[lagrangian(coordinates(x, y), lagrangian = (dot(x) - dot(x)) * y + x)]
pub struct VelocityCancels;
const _: fn() = || run(&VelocityCancels, VelocityCancelsState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });

#[lagrangian(coordinates(x, y), lagrangian = dot(x).powi(2) / 2.0 - x * y)]
pub struct Unmentioned;
const _: fn() = || run(&Unmentioned, UnmentionedState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });

#[lagrangian(coordinates(x[4], y), lagrangian = dot(y).powi(2) / 2.0 - x[1] * y)]
pub struct UnmentionedArray;
const _: fn() =
    || run(&UnmentionedArray, UnmentionedArrayState { x: [1.0; 4], y: 0.0, dot_x: [0.0; 4], dot_y: 1.0 });

#[lagrangian(coordinates(x, y), lagrangian = dot(x).powi(2) / 2.0 + x * dot(y) - x * y)]
pub struct Linear;
const _: fn() = || run(&Linear, LinearState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });

#[lagrangian(coordinates(x, y, z), lagrangian = dot(x).powi(2) / 2.0 + x * dot(y) - x * y * z)]
pub struct LinearAndUnmentioned;
const _: fn() =
    || run(&LinearAndUnmentioned, LinearAndUnmentionedState { x: 1.0, y: 0.0, z: 0.0, dot_x: 0.0, dot_y: 1.0, dot_z: 0.0 });

#[lagrangian(coordinates(x[4], y), lagrangian = sum(0..3, |j| dot(x[j]).powi(2)) + dot(y).powi(2) - x[3] * y)]
pub struct PartOfAnArray;
const _: fn() =
    || run(&PartOfAnArray, PartOfAnArrayState { x: [1.0; 4], y: 0.0, dot_x: [0.0; 4], dot_y: 1.0 });

#[lagrangian(coordinates(x, y), lagrangian = dot(x).powi(2) + dot(y).abs() - x * y)]
pub struct PiecewiseLinear;
const _: fn() = || run(&PiecewiseLinear, PiecewiseLinearState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });

#[lagrangian(coordinates(x, y), lagrangian = dot(x).abs() + dot(y).abs() - x * y)]
pub struct AllPiecewiseLinear;
const _: fn() =
    || run(&AllPiecewiseLinear, AllPiecewiseLinearState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });

#[lagrangian(coordinates(x, y, z), lagrangian = dot(x) * (dot(y) + dot(z)) - x * y * z)]
pub struct NoMatching;
const _: fn() =
    || run(&NoMatching, NoMatchingState { x: 1.0, y: 0.0, z: 0.0, dot_x: 0.0, dot_y: 1.0, dot_z: 0.0 });

#[lagrangian(coordinates(x, y), lagrangian = (dot(x) + dot(y)).powi(2) - x * y)]
pub struct SquareOfASum;
const _: fn() = || run(&SquareOfASum, SquareOfASumState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });

/// No mistakes: an indefinite matrix, and numbers of very different size.
#[lagrangian(coordinates(x, y), lagrangian = dot(x) * dot(y) - x * y)]
pub struct RegularIndefinite;
#[lagrangian(coordinates(x, y), lagrangian = 1e-20 * dot(x).powi(2) + 1e20 * dot(y).powi(2) - x * y)]
pub struct RegularScaled;
#[lagrangian(coordinates(x[4], y[2]), lagrangian = dot(x[0]).powi(2) + sum(1..4, |j| dot(x[j]).powi(2))
    + sum(0..2, |j| dot(y[(j + 1) % 2]).powi(2)) - x[3] * y[0])]
pub struct RegularCovered;
const _: fn() =
    || run(&RegularIndefinite, RegularIndefiniteState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });
const _: fn() = || run(&RegularScaled, RegularScaledState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });

fn main() {}
