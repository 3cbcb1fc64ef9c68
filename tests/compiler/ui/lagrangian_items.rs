//! What `#[lagrangian]` stands on, and the names of its coordinates.

use dvi_core::prelude::*;

fn run<S: RegularLagrangian>(system: &S, state: S::State<f64>) {
    let _ = (system.energy(&[0.0], &[0.0], 0.0), state);
}

mod tuple_struct {
    use super::*;
    #[lagrangian(coordinates(x, y), lagrangian = dot(x).powi(2) + dot(y).powi(2) - x * y)]
    pub struct System(pub f64);
    pub fn go() {
        run(&System(1.0), SystemState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });
    }
}

mod enumeration {
    use super::*;
    #[lagrangian(coordinates(x, y), lagrangian = dot(x).powi(2) + dot(y).powi(2) - x * y)]
    pub enum System {
        One,
    }
    pub fn go() {
        run(&System::One, SystemState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });
    }
}

mod union {
    use super::*;
    #[lagrangian(coordinates(x, y), lagrangian = dot(x).powi(2) + dot(y).powi(2) - x * y)]
    pub union System {
        pub a: f64,
    }
    pub fn go() {
        run(&System { a: 1.0 }, SystemState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });
    }
}

mod coordinate_is_called_as_a_velocity {
    use super::*;
    #[lagrangian(coordinates(x, dot_x), lagrangian = dot(x).powi(2) + dot(dot_x).powi(2))]
    pub struct System;
    pub fn go() {
        run(&System, SystemState { x: 1.0, dot_x: 0.0 });
    }
}

mod the_other_way_round {
    use super::*;
    #[lagrangian(coordinates(dot_y[2], y[2]), lagrangian = sum(0..2, |j| dot(y[j]).powi(2) + dot(dot_y[j]).powi(2)))]
    pub struct System;
    pub fn go() {
        run(&System, SystemState { y: [1.0; 2], dot_y: [0.0; 2] });
    }
}

mod coordinate_twice {
    use super::*;
    #[lagrangian(coordinates(x, y, x), lagrangian = dot(x).powi(2) + dot(y).powi(2) - x * y)]
    pub struct System;
    pub fn go() {
        run(&System, SystemState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });
    }
}

mod field_shadows_a_coordinate {
    use super::*;
    #[lagrangian(coordinates(x, y), lagrangian = dot(x).powi(2) + dot(y).powi(2) - x * y)]
    pub struct System {
        pub x: f64,
    }
    pub fn go() {
        run(&System { x: 1.0 }, SystemState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });
    }
}

mod field_is_no_number {
    use super::*;
    #[lagrangian(coordinates(x, y), lagrangian = dot(x).powi(2) + dot(y).powi(2) - x * y * name)]
    pub struct System {
        pub name: &'static str,
    }
    pub fn go() {
        run(&System { name: "x" }, SystemState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });
    }
}

mod function {
    use super::*;
    #[lagrangian(coordinates(x, y), lagrangian = dot(x) * dot(y))]
    pub fn system() {}
    pub fn go() {
        system();
    }
}

/// No mistakes: names like those of velocities, without the coordinate that they would be of.
mod names_like_velocities {
    use super::*;
    #[lagrangian(coordinates(dot_x, r#type), lagrangian = dot(dot_x).powi(2) + dot(r#type).powi(2))]
    pub struct System;
    pub fn go() {
        run(&System, SystemState { dot_x: 1.0, r#type: 0.0, dot_dot_x: 0.0, dot_type: 1.0 });
    }
}

fn main() {}
