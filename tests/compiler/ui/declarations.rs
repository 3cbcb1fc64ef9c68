//! Coordinates, fields, sizes, functions, and what the attribute stands on.

use dvi_core::prelude::*;

mod field_shadows_a_coordinate {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * y)]
    pub struct System {
        pub x: f64,
    }
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System { x: 1.0 }, Sigma::midpoint(), 0.1, state);
    }
}

mod coordinate_twice {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y, x), one_form = x * d(y), hamiltonian = x * y)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod coordinate_is_a_constant {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, PI), one_form = x * d(PI), hamiltonian = x)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, PI: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod no_coordinates {
    use super::*;
    #[degenerate_lagrangian(one_form = x * d(y), hamiltonian = x * y)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod empty_coordinates {
    use super::*;
    #[degenerate_lagrangian(coordinates(), one_form = x * d(y), hamiltonian = x * y)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod three_sizes {
    use super::*;
    #[degenerate_lagrangian(coordinates(x[4][4][4], y), one_form = x * d(y), hamiltonian = x * y)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: [[[1.0; 4]; 4]; 4], y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod typed_coordinate {
    use super::*;
    #[degenerate_lagrangian(coordinates(x: f64, y), one_form = x * d(y), hamiltonian = x * y)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod coordinates_without_comma {
    use super::*;
    #[degenerate_lagrangian(coordinates(x y), one_form = x * d(y), hamiltonian = x * y)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod keyword_as_a_coordinate {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, type), one_form = x * d(y), hamiltonian = x * y)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod literal_as_a_coordinate {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, 2), one_form = x * d(y), hamiltonian = x * y)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod size_is_a_quotient {
    use super::*;
    #[degenerate_lagrangian(coordinates(x[N / 2], y[N / 2]), one_form = sum(0..4, |j| x[j] * d(y[j])), hamiltonian = x[0] * y[0])]
    pub struct System<const N: usize>;
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System::<3>, Sigma::midpoint(), 0.1, state);
    }
}

mod size_is_unknown {
    use super::*;
    #[degenerate_lagrangian(coordinates(x[M], y[4]), one_form = sum(0..4, |j| x[j] * d(y[j])), hamiltonian = x[0] * y[0])]
    pub struct System<const N: usize>;
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System::<4>, Sigma::midpoint(), 0.1, state);
    }
}

mod size_is_a_real_field {
    use super::*;
    #[degenerate_lagrangian(coordinates(x[n], y[4]), one_form = sum(0..4, |j| x[j] * d(y[j])), hamiltonian = x[0] * y[0])]
    pub struct System {
        pub n: f64,
    }
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System { n: 4.0 }, Sigma::midpoint(), 0.1, state);
    }
}

mod size_is_a_length_of_nothing {
    use super::*;
    #[degenerate_lagrangian(coordinates(x[m.len()], y[4]), one_form = sum(0..4, |j| x[j] * d(y[j])), hamiltonian = x[0] * y[0])]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod size_is_missing {
    use super::*;
    #[degenerate_lagrangian(coordinates(x[], y[4]), one_form = sum(0..4, |j| x[j] * d(y[j])), hamiltonian = x[0] * y[0])]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod size_is_zero {
    use super::*;
    #[degenerate_lagrangian(coordinates(x[0], y[4]), one_form = sum(0..4, |j| x[j] * d(y[j])), hamiltonian = x[0] * y[0])]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: [], y: [0.0; 4] };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod size_is_negative {
    use super::*;
    #[degenerate_lagrangian(coordinates(x[-4], y[4]), one_form = sum(0..4, |j| x[j] * d(y[j])), hamiltonian = x[0] * y[0])]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod size_is_a_float {
    use super::*;
    #[degenerate_lagrangian(coordinates(x[4.0], y[4]), one_form = sum(0..4, |j| x[j] * d(y[j])), hamiltonian = x[0] * y[0])]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod size_is_huge {
    use super::*;
    #[degenerate_lagrangian(coordinates(x[1_000_000_000_000], y[4]), one_form = sum(0..4, |j| x[j] * d(y[j])), hamiltonian = x[0] * y[0])]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod size_is_beyond_integers {
    use super::*;
    #[degenerate_lagrangian(coordinates(x[99999999999999999999999], y[4]), one_form = sum(0..4, |j| x[j] * d(y[j])), hamiltonian = x[0] * y[0])]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod field_is_text {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = name * x)]
    pub struct System {
        pub name: String,
    }
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System { name: String::new() }, Sigma::midpoint(), 0.1, state);
    }
}

mod field_is_of_another_type {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = a * x + a * y)]
    pub struct System {
        pub a: Option<f64>,
    }
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System { a: None }, Sigma::midpoint(), 0.1, state);
    }
}

mod field_is_an_array_of_another_type {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = a[0] * x)]
    pub struct System {
        pub a: [Option<f64>; 2],
    }
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System { a: [None; 2] }, Sigma::midpoint(), 0.1, state);
    }
}

mod function_without_derivatives {
    use super::*;
    fn sine<T: dvi_core::Scalar>(x: T) -> T {
        x.sin()
    }
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = f(x), functions(f = [sine]))]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod function_without_list {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = f(x), functions(f = sine))]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod function_is_a_closure {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = f(x), functions(f = [|x| x, |x| 1.0, |x| 0.0]))]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod function_twice {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = f(x), functions(f = [f, g, h], f = [f, g, h]))]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod function_of_the_table {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = sum(x), functions(sum = [f, g, h]))]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod momentum_twice {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x, momenta(p = x, p = y))]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod momentum_without_formula {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x, momenta(p))]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod momentum_is_empty {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x, momenta(p = ))]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod tuple_struct {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * y)]
    pub struct System(pub f64);
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System(1.0), Sigma::midpoint(), 0.1, state);
    }
}

mod enumeration {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * y)]
    pub enum System {
        One,
    }
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System::One, Sigma::midpoint(), 0.1, state);
    }
}

mod union {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * y)]
    pub union System {
        pub a: f64,
    }
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System { a: 1.0 }, Sigma::midpoint(), 0.1, state);
    }
}

mod function {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * y)]
    pub fn system() {}
    pub fn run() {
        system();
    }
}

mod size_of_another_type {
    use super::*;
    #[degenerate_lagrangian(coordinates(x[N], y[4]), one_form = sum(0..4, |j| x[j] * d(y[j])), hamiltonian = x[0] * y[0])]
    pub struct System<const N: bool>;
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System::<true>, Sigma::midpoint(), 0.1, state);
    }
}

fn main() {}
