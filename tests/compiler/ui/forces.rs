//! Mistakes in forces.

use dvi_core::prelude::*;

#[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0, force = -dot(x))]
struct NoList;

#[lagrangian(
    coordinates(theta),
    lagrangian = dot(theta).powi(2) / 2.0,
    force(thetta) = -1.0,
)]
struct OnNoCoordinateS;

#[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0, force(gamma) = -1.0)]
struct OnNoCoordinateT {
    gamma: f64,
}

macro_rules! on_a_line {
    ($name:ident: $($arguments:tt)*) => {
        #[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0, $($arguments)*)]
        struct $name;
    };
}

on_a_line! { OnNothingS: force() = -dot(x) }
on_a_line! { OnNothingT: force(x): -dot(x) }
on_a_line! { OnNothingU: friction(x) = -dot(x) }

#[lagrangian(
    coordinates(x[2]),
    lagrangian = sum(0..2, |i| dot(x[i]).powi(2) / 2.0),
    force(x[0]) = -dot(x[0]),
)]
struct OnAnEntry;

on_a_line! { TwiceS: force(x) = -dot(x), force(x) = t.cos() }
on_a_line! { TwiceT: force = [-dot(x)], force(x) = t.cos() }

#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = y * d(x),
    hamiltonian = x * x + y * y,
    force = [-dot(x), 0.0],
)]
struct VelocitiesOfADegenerateSystem;

on_a_line! { DifferentialOfARegularSystemS: force(x) = -d(x) }

#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = y * d(x),
    hamiltonian = x * x + y * y,
    time_transform = 1.0 + x * x,
    force(x) = -y,
)]
struct WithTransformedTime;

mod explicit_methods {
    use super::*;

    #[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0, force(x) = -dot(x))]
    struct Friction;

    fn run() {
        let _ = Integrator::new(&Friction, Newmark::new(0.25), 0.1, FrictionState { x: 0.0, dot_x: 1.0 });
    }
}

/// Names of indices are those of the formula that they stand in, not of one before.
#[lagrangian(
    coordinates(x[3]),
    lagrangian = sum(0..3, |k| dot(x[k]).powi(2)),
    force(x) = |i| k - sum(0..3, |j| x[j]) * x[i],
)]
struct IndicesOfOtherFormulasS;

fn main() {}
