//! Mistakes in dissipation functions.

use dvi_core::prelude::*;

mod without_velocities {
    use super::*;

    #[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0, dissipation = 0.1 * x * x)]
    struct S;

    fn state() -> SState {
        SState { x: 1.0, dot_x: 0.0 }
    }

    #[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0, dissipation = dot(x) - dot(x) + t)]
    struct T;
}

#[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0, dissipation = d(x).powi(2))]
struct VelocitiesOfOtherNamesT;

#[lagrangian(
    coordinates(r[2]),
    lagrangian = dot(r).norm_squared() / 2.0,
    dissipation = dot(r),
)]
struct NoNumber;

#[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0, rayleigh = dot(x).powi(2))]
struct OtherWords;

#[degenerate_lagrangian(
    coordinates(x, p),
    one_form = p * d(x),
    hamiltonian = p * p / 2.0,
    dissipation = dot(x).powi(2),
)]
struct DegenerateS;

fn main() {}
