//! Blocks and choices.

use dvi_core::prelude::*;

mod if_without_else {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = if x < y { x })]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod else_if_without_else {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = if x < y { x } else if y < x { y })]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod block_without_value {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = { let r = x * x; })]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod empty_block {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + {})]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod statement_in_a_block {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = { let r = x * x; r.sqrt(); r })]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod let_without_value {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = { let r; x })]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod let_else {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = { let r = x else { y }; r })]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod tuple_pattern {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = { let (a, b) = x; y })]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod macro_statement {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = { println!(); x })]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod item_in_a_block {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = { fn f() {} x })]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod condition_that_is_equal {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = if x == 0.0 { x } else { y })]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod condition_that_is_a_number {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = if x { x } else { y })]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod value_used_after_its_block {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = { let a = { let b = x; b }; a + b })]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod branch_without_value {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = if x < y { let a = x; } else { y })]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod unused_and_wrong {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = { let unused = z; x * y })]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

fn main() {}
