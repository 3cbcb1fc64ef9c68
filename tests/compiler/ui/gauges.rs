//! Gauges that cannot be, and one-forms for which none is found.

use dvi_core::prelude::*;

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * y, gauge = 2.0 * t)]
pub struct WithoutCoordinates;

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * y, gauge = x * d(y))]
pub struct WithAVelocity;

mod with_two_derivatives {
    use super::*;
    fn f<T: dvi_core::Scalar>(x: T) -> T {
        x
    }
    #[degenerate_lagrangian(
        coordinates(x, y),
        one_form = x * d(y),
        hamiltonian = x * y,
        gauge = x * f(y),
        functions(f = [f, f, f]),
    )]
    pub struct System;
}

#[lagrangian(coordinates(x), lagrangian = dot(x) * dot(x) / 2.0, gauge = x)]
pub struct OfARegularSystem;

#[degenerate_lagrangian(
    coordinates(x, y, u, w),
    one_form = x * x * w * d(y) + (u * w).exp() * d(x) - u * d(w) + (y * u).sin() * x * d(u) + y * w * d(x),
    hamiltonian = x * y,
    gauge = auto,
)]
pub struct NotFoundWithoutAHalfThatOmegaLeavesAlone;

#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = (x * (y * y).sin() + y) * d(x) + (x * y * y + 1.0).sin() * d(y) + (x * x * y).exp() * d(x),
    hamiltonian = x * y,
    gauge = auto,
)]
pub struct NotFoundWithoutAnAntiderivative;

#[degenerate_lagrangian(
    coordinates(z[4]),
    one_form = sum(0..4, |j| z[(j + 1) % 4] * d(z[j])),
    hamiltonian = z[0] * z[1],
    gauge = auto,
)]
pub struct NotFoundInHalvesOfAnArray;

mod not_found_without_a_third_derivative {
    use super::*;
    fn f<T: dvi_core::Scalar>(x: T) -> T {
        x
    }
    #[degenerate_lagrangian(
        coordinates(x, y),
        one_form = f(x) * d(y) - y * x.tan().tan() * d(x),
        hamiltonian = x * y,
        functions(f = [f, f, f]),
        gauge = auto,
    )]
    pub struct System;
}

#[degenerate_lagrangian(coordinates(x, y, z), one_form = x * d(y) + y * d(z), hamiltonian = x * y, gauge = auto)]
pub struct AnOddNumberOfCoordinates;

mod none_needed {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * y, gauge = auto)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, OneStep::midpoint(), 0.1, state);
    }
}

fn main() {}
