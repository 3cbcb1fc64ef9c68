//! Formulas as they are written elsewhere: on paper, in Python, in C. The message says what to write here.

use dvi_core::prelude::*;

mod power_with_stars {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x**2 + y)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod power_with_stars_of_a_product {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = 3.0 * (x + y)**3)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod power_with_a_caret {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x^2)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod product_without_a_sign {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = 2x + y)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod product_without_a_sign_of_a_decimal {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = 0.5y + x)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod logarithm {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x.log() + y)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod power_by_name {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x.pow(2) + y)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod arc_sine {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x.arcsin() + y)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod undeclared_function {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = potential(x) + y)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod undeclared_method {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x.bessel() + y)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod integers_that_are_divided {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = (3 / 2) as f64 * x + y)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod differential_as_a_name {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * dy, hamiltonian = x + y)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod iterator {
    use super::*;
    #[degenerate_lagrangian(coordinates(x[4], y[4]), one_form = sum(0..4, |j| x[j] * d(y[j])), hamiltonian = (0..4).map(|i| x[i]).sum())]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod iterator_of_a_field {
    use super::*;
    #[degenerate_lagrangian(coordinates(x[4], y[4]), one_form = sum(0..4, |j| x[j] * d(y[j])), hamiltonian = g.iter().sum() * x[0])]
    pub struct System { pub g: [f64; 3] }
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System { g: [1.0; 3] }, Sigma::midpoint(), 0.1, state);
    }
}

mod index_that_is_divided {
    use super::*;
    #[degenerate_lagrangian(coordinates(x[4], y[4]), one_form = sum(0..4, |j| x[j] * d(y[j])), hamiltonian = sum(0..4, |k| (k / 2) as f64 * x[k]))]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod size_that_is_divided {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = (n / 2) as f64 * x)]
    pub struct System { pub n: usize }
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System { n: 1 }, Sigma::midpoint(), 0.1, state);
    }
}

mod size_that_is_not_declared {
    use super::*;
    #[degenerate_lagrangian(coordinates(x[N], y[N]), one_form = sum(0..N, |j| x[j] * d(y[j])), hamiltonian = sum(0..N, |j| x[j] * y[j]))]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod index_out_of_range_of_a_pair {
    use super::*;
    #[degenerate_lagrangian(coordinates(x[4], y[4]), one_form = sum(0..4, |j| x[j] * d(y[j])), hamiltonian = sum_pairs(0..4, |j, k| g[k - j] * x[j]))]
    pub struct System { pub g: [f64; 3] }
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System { g: [1.0; 3] }, Sigma::midpoint(), 0.1, state);
    }
}

mod index_below_zero_of_a_pair {
    use super::*;
    #[degenerate_lagrangian(coordinates(x[4], y[4]), one_form = sum(0..4, |j| x[j] * d(y[j])), hamiltonian = sum_pairs(0..4, |j, k| g[k - j - 2] * x[j]))]
    pub struct System { pub g: [f64; 3] }
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System { g: [1.0; 3] }, Sigma::midpoint(), 0.1, state);
    }
}

mod velocity_as_one_word {
    use super::*;
    #[lagrangian(coordinates(x), lagrangian = xdot * xdot / 2.0 - x * x)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, dot_x: 0.0 };
        let _ = Integrator::new(&System, Variational::midpoint(), 0.1, state);
    }
}

mod velocity_with_an_underscore {
    use super::*;
    #[lagrangian(coordinates(x), lagrangian = x_dot * x_dot / 2.0 - x * x)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, dot_x: 0.0 };
        let _ = Integrator::new(&System, Variational::midpoint(), 0.1, state);
    }
}

mod velocity_with_d {
    use super::*;
    #[lagrangian(coordinates(x), lagrangian = dx * dx / 2.0 - x * x)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, dot_x: 0.0 };
        let _ = Integrator::new(&System, Variational::midpoint(), 0.1, state);
    }
}

mod quotient_under_a_name {
    use dvi_core::degenerate_lagrangian;

    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = { let a = 3; (a / 2) as f64 * y })]
    pub struct System;
}

mod named_quotient {
    use dvi_core::degenerate_lagrangian;

    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = { let a = 7 / 2; a as f64 * y })]
    pub struct System;
}

mod quotient_in_a_block {
    use dvi_core::degenerate_lagrangian;

    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = ({ 7 / 2 }) as f64 * y)]
    pub struct System;
}

mod cast_of_a_block {
    use dvi_core::degenerate_lagrangian;

    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = ({ let a = 7; a / 2 }) as f64 * y)]
    pub struct System;
}

mod mutable_name {
    use dvi_core::degenerate_lagrangian;

    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = { let mut s = y; s })]
    pub struct System;
}

mod constant_of_one_name {
    use dvi_core::degenerate_lagrangian;

    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = E * x + y)]
    pub struct System;
}

fn main() {}

mod quotient_in_a_choice {
    use dvi_core::degenerate_lagrangian;

    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = (if n > 2 { n / 2 } else { n }) as f64 * y)]
    pub struct System { pub n: i32 }
}

mod quotient_behind_a_method {
    use dvi_core::degenerate_lagrangian;

    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = ((n % 3) / 2).min(3) as f64 * y)]
    pub struct System { pub n: i32 }
}

mod quotient_of_a_constant {
    use dvi_core::degenerate_lagrangian;

    pub const K: i32 = 5;

    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = (self::K / 2) as f64 * y)]
    pub struct System;
}

mod quotient_of_a_field_of_a_field {
    use dvi_core::degenerate_lagrangian;

    pub struct Material { pub n: i32 }

    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = (m.n / 2) as f64 * y)]
    pub struct System { pub m: Material }
}

mod logarithm_to_a_base {
    use dvi_core::degenerate_lagrangian;

    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x.log(2.0) + y)]
    pub struct System;
}

mod power_with_an_argument {
    use dvi_core::degenerate_lagrangian;

    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = (x + y).pow(3))]
    pub struct System;
}

mod bounds_by_one_name {
    use dvi_core::degenerate_lagrangian;

    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x.clamp(0.0, 1.0) + y)]
    pub struct System;
}

mod function_of_two_numbers {
    use dvi_core::degenerate_lagrangian;

    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = max(x, 2.0 * y))]
    pub struct System;
}

mod function_by_another_name_as_in_c {
    use dvi_core::degenerate_lagrangian;

    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = pow(x, 2) + y)]
    pub struct System;
}

mod condition_of_equality {
    use dvi_core::degenerate_lagrangian;

    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = if x == 1.0 { x } else { y })]
    pub struct System;
}

mod velocity_as_a_method {
    use dvi_core::lagrangian;

    #[lagrangian(coordinates(x), lagrangian = x.dot().powi(2) / 2.0 - x * x)]
    pub struct System;
}
