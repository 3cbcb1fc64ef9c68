//! What `#[lagrangian]` stands on, and the names of its coordinates.

use dvi_core::prelude::*;

fn run<S: RegularLagrangian>(system: &S, state: S::State<f64>) {
    let _ = (system.energy(&[0.0], &[0.0], 0.0), state);
}

#[lagrangian(coordinates(x, dot_x), lagrangian = dot(x).powi(2) + dot(dot_x).powi(2))]
pub struct CoordinateIsCalledAsAVelocity;
const _: fn() =
    || run(&CoordinateIsCalledAsAVelocity, CoordinateIsCalledAsAVelocityState { x: 1.0, dot_x: 0.0 });

#[lagrangian(coordinates(dot_y[2], y[2]), lagrangian = sum(0..2, |j| dot(y[j]).powi(2) + dot(dot_y[j]).powi(2)))]
pub struct TheOtherWayRound;
const _: fn() = || run(&TheOtherWayRound, TheOtherWayRoundState { y: [1.0; 2], dot_y: [0.0; 2] });

/// No mistakes: names like those of velocities, without the coordinate that they would be of.
#[lagrangian(coordinates(dot_x, r#type), lagrangian = dot(dot_x).powi(2) + dot(r#type).powi(2))]
pub struct NamesLikeVelocities;
const _: fn() =
    || run(&NamesLikeVelocities, NamesLikeVelocitiesState { dot_x: 1.0, r#type: 0.0, dot_dot_x: 0.0, dot_type: 1.0 });

fn main() {}
