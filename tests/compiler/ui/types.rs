//! What only the compiler can know of types: it says so on the field, or on the name.

use dvi_core::prelude::*;

mod field_is_of_any_type {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = a * x)]
    pub struct System<T> {
        pub a: T,
    }
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System { a: "1.0" }, Sigma::midpoint(), 0.1, state);
    }
}

mod constant_does_not_exist {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = Self::G * x)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod field_is_of_a_type_of_the_user {
    use super::*;
    pub struct Charge;

    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = a * x + a * y)]
    pub struct System {
        pub a: Charge,
    }
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System { a: Charge }, Sigma::midpoint(), 0.1, state);
    }
}

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * f64::NAN - std::f64::INFINITY)]
pub struct Infinite;

fn main() {}
