//! The arguments of `#[lagrangian]`, and where it differs from `#[degenerate_lagrangian]`.

use dvi_core::prelude::*;

fn run<S: RegularLagrangian>(system: &S, state: S::State<f64>) {
    let _ = (system.energy(&[0.0], &[0.0], 0.0), state);
}

mod one_form_and_hamiltonian {
    use super::*;
    #[lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * y)]
    pub struct System;
    pub fn go() {
        run(&System, SystemState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });
    }
}

mod hamiltonian_beside_a_lagrangian {
    use super::*;
    #[lagrangian(coordinates(x, y), lagrangian = dot(x).powi(2) + dot(y).powi(2) - x * y, hamiltonian = x * y)]
    pub struct System;
    pub fn go() {
        run(&System, SystemState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });
    }
}

mod list_of_a_one_form {
    use super::*;
    #[lagrangian(coordinates(x, y), one_form(x), lagrangian = dot(x).powi(2) + dot(y).powi(2) - x * y)]
    pub struct System;
    pub fn go() {
        run(&System, SystemState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });
    }
}

mod no_lagrangian {
    use super::*;
    #[lagrangian(coordinates(x, y))]
    pub struct System;
    pub fn go() {
        run(&System, SystemState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });
    }
}

mod momenta_without_a_lagrangian {
    use super::*;
    #[lagrangian(coordinates(x, y), momenta(p = dot(x)))]
    pub struct System;
    pub fn go() {
        run(&System, SystemState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });
    }
}

mod empty_lagrangian {
    use super::*;
    #[lagrangian(coordinates(x, y), lagrangian =)]
    pub struct System;
    pub fn go() {
        run(&System, SystemState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });
    }
}

mod no_arguments {
    use super::*;
    #[lagrangian()]
    pub struct System;
    pub fn go() {
        run(&System, SystemState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });
    }
}

mod no_coordinates {
    use super::*;
    #[lagrangian(lagrangian = dot(x).powi(2) + dot(y).powi(2) - x * y)]
    pub struct System;
    pub fn go() {
        run(&System, SystemState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });
    }
}

mod misspelt {
    use super::*;
    #[lagrangian(coordinates(x, y), lagrangan = dot(x).powi(2) + dot(y).powi(2) - x * y)]
    pub struct System;
    pub fn go() {
        run(&System, SystemState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });
    }
}

mod unknown {
    use super::*;
    #[lagrangian(coordinates(x, y), lagrangian = dot(x).powi(2) + dot(y).powi(2) - x * y, gauge = x)]
    pub struct System;
    pub fn go() {
        run(&System, SystemState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });
    }
}

mod no_argument {
    use super::*;
    #[lagrangian(coordinates(x, y), lagrangian = dot(x).powi(2) + dot(y).powi(2) - x * y, 3)]
    pub struct System;
    pub fn go() {
        run(&System, SystemState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });
    }
}

mod lagrangian_in_brackets {
    use super::*;
    #[lagrangian(coordinates(x, y), lagrangian(x))]
    pub struct System;
    pub fn go() {
        run(&System, SystemState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });
    }
}

mod d_in_a_lagrangian {
    use super::*;
    #[lagrangian(coordinates(x, y), lagrangian = d(x) * d(y))]
    pub struct System;
    pub fn go() {
        run(&System, SystemState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });
    }
}

mod d_in_a_momentum {
    use super::*;
    #[lagrangian(coordinates(x, y), lagrangian = dot(x).powi(2) + dot(y).powi(2) - x * y, momenta(p = d(x)))]
    pub struct System;
    pub fn go() {
        run(&System, SystemState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });
    }
}

mod velocity_of_an_expression {
    use super::*;
    #[lagrangian(coordinates(x, y), lagrangian = dot(x).powi(2) + dot(x * y).powi(2))]
    pub struct System;
    pub fn go() {
        run(&System, SystemState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });
    }
}

mod velocity_without_an_index {
    use super::*;
    #[lagrangian(coordinates(x[4], y), lagrangian = sum(0..4, |j| dot(x).powi(2)) + dot(y).powi(2))]
    pub struct System;
    pub fn go() {
        run(&System, SystemState { x: [1.0; 4], y: 0.0, dot_x: [0.0; 4], dot_y: 1.0 });
    }
}

mod unknown_name {
    use super::*;
    #[lagrangian(coordinates(x, y), lagrangian = dot(x).powi(2) + dot(y).powi(2) - x * y + z)]
    pub struct System;
    pub fn go() {
        run(&System, SystemState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });
    }
}

mod field_of_the_velocity {
    use super::*;
    #[lagrangian(coordinates(x, y), lagrangian = dot(x).powi(2) + dot(y).powi(2) - x * y + dot_x)]
    pub struct System;
    pub fn go() {
        run(&System, SystemState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });
    }
}

fn main() {}
