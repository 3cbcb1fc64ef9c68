//! Rust that a formula cannot hold, each kind once.

use dvi_core::prelude::*;

mod match_ {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = match x { _ => y })]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod loop_ {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = loop { x })]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod for_ {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + for j in 0..4 { x })]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod while_ {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + while true { y })]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod macro_call {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + square!(y))]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod closure {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + (|s| s * s))]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod reference {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + &y)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod dereference {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + *y)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod tuple {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + (x, y))]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod remainder {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x % y)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod caret {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x ^ 2)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod equality {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x == y)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod comparison {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x < y)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod logic {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x && y)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod bit_or {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x | y)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod shift {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x << 2)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod struct_literal {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + Point { x: x, y: y })]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod question_mark {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x? + y)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod assignment {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x = y)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod compound_assignment {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x += y)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod list {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + [x, y])]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod repeated {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + [y; 2])]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod range {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + (0..4))]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod return_ {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = return x)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod break_ {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = break)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod unsafe_ {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + unsafe { y })]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod async_ {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + async { y })]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod await_ {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x.await + y)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod not {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + !y)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod string {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + "y")]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod boolean {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + true)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod character {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + 'y')]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod field_of_field {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + y.re)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod tuple_field {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + y.0)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod turbofish {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + y.powi::<i32>(2))]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod call_of_a_closure {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = (|s| s)(x) + y)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod const_block {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + const { 1.0 })]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod let_condition {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = if let s = x { x } else { y })]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod infer {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + _)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod imaginary {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + 2.0i)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod qualified {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + <f64 as Real>::ONE)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod generic_call {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = sum::<f64>(0..4, |j| x))]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

fn main() {}
