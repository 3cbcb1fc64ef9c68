//! Several mistakes: each gets its error, none hides another.

use dvi_core::prelude::*;

mod in_every_argument {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x, y),
        one_form = x * d(w) + a,
        hamiltonian = x.sine() + omga * y + x % y,
        momenta(p = x * d(x), q = unknown, r = x.powi(y)),
        symmetry = x,
    )]
    pub struct System {
        pub omega: f64,
    }
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System { omega: 1.0 }, Sigma::midpoint(), 0.1, state);
    }
}

mod in_one_block {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x, y),
        one_form = x * d(y),
        hamiltonian = {
            let a = first + x;
            let b = second.sqrt();
            if a == b { third } else { a * b }
        },
    )]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod in_the_declarations {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x[4], y[n], x[4], omega),
        one_form = sum(0..4, |j| x[j] * d(y[j])),
        hamiltonian = x[0],
        functions(f = [g]),
    )]
    pub struct System {
        pub omega: f64,
    }
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System { omega: 1.0 }, Sigma::midpoint(), 0.1, state);
    }
}

mod in_the_arguments {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x, y),
        one_form(x * d(y)),
        hamiltonian = x + ,
        momenta = p,
        momentum(p = x),
    )]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod singular_twice {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y, u, w), one_form = x * d(y), hamiltonian = nothing * x)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0, u: 0.0, w: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

fn main() {}
