//! Paths that lead nowhere: the compiler says so, on the path.

use dvi_core::prelude::*;

mod function_does_not_exist {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = f(x), functions(f = [f, g, h]))]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

fn main() {}
