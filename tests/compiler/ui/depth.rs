//! Formulas beyond reason, refused before they exhaust the compiler.

use dvi_core::prelude::*;

mod signs {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x, y),
        one_form = x * d(y),
        hamiltonian = - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - x,
    )]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod functions_of_functions {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x, y),
        one_form = x * d(y),
        hamiltonian = x.sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin(),
    )]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod powers_of_powers {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x, y),
        one_form = x * d(y),
        hamiltonian = x.powi(4096).powi(2),
    )]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod squares_of_names {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x, y),
        one_form = x * d(y),
        hamiltonian = {
            let a = x * x;
            let a = a * a;
            let a = a * a;
            let a = a * a;
            let a = a * a;
            let a = a * a;
            let a = a * a;
            let a = a * a;
            let a = a * a;
            let a = a * a;
            let a = a * a;
            let a = a * a;
            let a = a * a;
            a
        },
    )]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

fn main() {}
