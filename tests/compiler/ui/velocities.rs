//! Velocities: where they may stand, how they are written, and that L is affine in them.

use dvi_core::prelude::*;

mod quadratic_one_form {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y) + y * d(x) * d(x), hamiltonian = x)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod function_of_a_velocity {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y).sin(), hamiltonian = x * y)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod own_function_of_a_velocity {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x, y),
        one_form = f(d(y)),
        hamiltonian = x * y,
        functions(f = [f, df, d2f]),
    )]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod divided_by_a_velocity {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x / d(y), hamiltonian = x * y)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod regular_lagrangian {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 + mu / x.hypot(y),
    )]
    pub struct System {
        pub mu: f64,
    }
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System { mu: 1.0 }, Sigma::midpoint(), 0.1, state);
    }
}

mod product_of_velocities {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), lagrangian = x * dot(y) - dot(x) * dot(y) - x * y)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod choice_by_a_velocity {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x, y),
        lagrangian = x * dot(y) - if dot(x) < 0.0 { x } else { y },
    )]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod velocity_in_the_hamiltonian {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * x + d(y) * y)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod velocity_in_a_momentum {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x, y),
        one_form = x * d(y),
        hamiltonian = x * y,
        momenta(p = x * dot(x)),
    )]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod velocity_in_a_component {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = [0.0, x * d(y)], hamiltonian = x * y)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod dot_in_a_one_form {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * dot(y), hamiltonian = x * y)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod d_in_a_lagrangian {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), lagrangian = x * d(y) - x * y)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod term_without_d {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y) - y * x, hamiltonian = x * y)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod nothing_with_d {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * y, hamiltonian = x * y)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod d_of_an_expression {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(2.0 * y), hamiltonian = x * y)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod d_of_a_parameter {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y) + x * d(a), hamiltonian = x * y)]
    pub struct System {
        pub a: f64,
    }
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System { a: 1.0 }, Sigma::midpoint(), 0.1, state);
    }
}

mod d_of_two {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(x, y), hamiltonian = x * y)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

fn main() {}
