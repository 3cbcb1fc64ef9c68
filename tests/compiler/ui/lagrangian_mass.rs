//! The mass matrix ∂²L/∂v∂v of a regular Lagrangian: what makes it singular for certain.

use dvi_core::prelude::*;

fn run<S: RegularLagrangian>(system: &S, state: S::State<f64>) {
    let _ = (system.energy(&[0.0], &[0.0], 0.0), state);
}

mod affine {
    use super::*;
    #[lagrangian(coordinates(x, y), lagrangian = x * dot(y) - x * y)]
    pub struct System;
    pub fn go() {
        run(&System, SystemState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });
    }
}

mod affine_with_functions {
    use super::*;
    #[lagrangian(coordinates(x, y), lagrangian = x.sin() * dot(y) + y * dot(x) - x * y)]
    pub struct System;
    pub fn go() {
        run(&System, SystemState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });
    }
}

mod no_velocity {
    use super::*;
    #[lagrangian(coordinates(x, y), lagrangian = x * y)]
    pub struct System;
    pub fn go() {
        run(&System, SystemState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });
    }
}

mod no_velocity_of_an_array {
    use super::*;
    #[lagrangian(coordinates(x[4], y), lagrangian = x[0] * y)]
    pub struct System;
    pub fn go() {
        run(&System, SystemState { x: [1.0; 4], y: 0.0, dot_x: [0.0; 4], dot_y: 1.0 });
    }
}

mod velocity_cancels {
    use super::*;
    #[lagrangian(coordinates(x, y), lagrangian = (dot(x) - dot(x)) * y + x)]
    pub struct System;
    pub fn go() {
        run(&System, SystemState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });
    }
}

mod unmentioned {
    use super::*;
    #[lagrangian(coordinates(x, y), lagrangian = dot(x).powi(2) / 2.0 - x * y)]
    pub struct System;
    pub fn go() {
        run(&System, SystemState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });
    }
}

mod unmentioned_array {
    use super::*;
    #[lagrangian(coordinates(x[4], y), lagrangian = dot(y).powi(2) / 2.0 - x[1] * y)]
    pub struct System;
    pub fn go() {
        run(&System, SystemState { x: [1.0; 4], y: 0.0, dot_x: [0.0; 4], dot_y: 1.0 });
    }
}

mod two_unmentioned {
    use super::*;
    #[lagrangian(coordinates(x, y, z), lagrangian = dot(y).powi(2) / 2.0 - x * y * z)]
    pub struct System;
    pub fn go() {
        run(&System, SystemState { x: 1.0, y: 0.0, z: 0.0, dot_x: 0.0, dot_y: 1.0, dot_z: 0.0 });
    }
}

mod linear {
    use super::*;
    #[lagrangian(coordinates(x, y), lagrangian = dot(x).powi(2) / 2.0 + x * dot(y) - x * y)]
    pub struct System;
    pub fn go() {
        run(&System, SystemState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });
    }
}

mod linear_and_unmentioned {
    use super::*;
    #[lagrangian(coordinates(x, y, z), lagrangian = dot(x).powi(2) / 2.0 + x * dot(y) - x * y * z)]
    pub struct System;
    pub fn go() {
        run(&System, SystemState { x: 1.0, y: 0.0, z: 0.0, dot_x: 0.0, dot_y: 1.0, dot_z: 0.0 });
    }
}

mod part_of_an_array {
    use super::*;
    #[lagrangian(coordinates(x[4], y), lagrangian = sum(0..3, |j| dot(x[j]).powi(2)) + dot(y).powi(2) - x[3] * y)]
    pub struct System;
    pub fn go() {
        run(&System, SystemState { x: [1.0; 4], y: 0.0, dot_x: [0.0; 4], dot_y: 1.0 });
    }
}

mod one_of_an_array {
    use super::*;
    #[lagrangian(coordinates(x[4], y), lagrangian = dot(x[2]).powi(2) + dot(y).powi(2) - x[3] * y)]
    pub struct System;
    pub fn go() {
        run(&System, SystemState { x: [1.0; 4], y: 0.0, dot_x: [0.0; 4], dot_y: 1.0 });
    }
}

mod piecewise_linear {
    use super::*;
    #[lagrangian(coordinates(x, y), lagrangian = dot(x).powi(2) + dot(y).abs() - x * y)]
    pub struct System;
    pub fn go() {
        run(&System, SystemState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });
    }
}

mod all_piecewise_linear {
    use super::*;
    #[lagrangian(coordinates(x, y), lagrangian = dot(x).abs() + dot(y).abs() - x * y)]
    pub struct System;
    pub fn go() {
        run(&System, SystemState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });
    }
}

mod no_matching {
    use super::*;
    #[lagrangian(coordinates(x, y, z), lagrangian = dot(x) * (dot(y) + dot(z)) - x * y * z)]
    pub struct System;
    pub fn go() {
        run(&System, SystemState { x: 1.0, y: 0.0, z: 0.0, dot_x: 0.0, dot_y: 1.0, dot_z: 0.0 });
    }
}

mod square_of_a_sum {
    use super::*;
    #[lagrangian(coordinates(x, y), lagrangian = (dot(x) + dot(y)).powi(2) - x * y)]
    pub struct System;
    pub fn go() {
        run(&System, SystemState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });
    }
}

mod square_of_a_sum_with_a_mass {
    use super::*;
    #[lagrangian(coordinates(x, y), lagrangian = m / 2.0 * (3.0 * dot(x) - dot(y)).powi(2) - x * y)]
    pub struct System {
        pub m: f64,
    }
    pub fn go() {
        run(&System { m: 1.0 }, SystemState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });
    }
}

mod two_squares_of_three {
    use super::*;
    #[lagrangian(coordinates(x, y, z), lagrangian = (dot(x) - dot(y)).powi(2) + (dot(y) - dot(z)).powi(2) - x * y * z)]
    pub struct System;
    pub fn go() {
        run(&System, SystemState { x: 1.0, y: 0.0, z: 0.0, dot_x: 0.0, dot_y: 1.0, dot_z: 0.0 });
    }
}

/// No mistakes: an indefinite matrix, and numbers of very different size.
mod regular {
    use super::*;
    #[lagrangian(coordinates(x, y), lagrangian = dot(x) * dot(y) - x * y)]
    pub struct Indefinite;
    #[lagrangian(coordinates(x, y), lagrangian = 1e-20 * dot(x).powi(2) + 1e20 * dot(y).powi(2) - x * y)]
    pub struct Scaled;
    #[lagrangian(coordinates(x[4], y[2]), lagrangian = dot(x[0]).powi(2) + sum(1..4, |j| dot(x[j]).powi(2))
        + sum(0..2, |j| dot(y[(j + 1) % 2]).powi(2)) - x[3] * y[0])]
    pub struct Covered;
    pub fn go() {
        run(&Indefinite, IndefiniteState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });
        run(&Scaled, ScaledState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });
    }
}

fn main() {}
