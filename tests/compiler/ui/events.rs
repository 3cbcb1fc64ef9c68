//! Events that are declared in the attribute.

use dvi_core::prelude::*;

mod event_twice {
    use super::*;
    #[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0, events(turn = dot(x), turn = x))]
    pub struct System;
    pub fn run() -> Result<(), StartError> {
        let start = SystemState { x: 1.0, dot_x: 0.0 };
        let mut run = Integrator::new(&System, Variational::trapezoid(), 0.1, start)?;
        let _ = run.declared_events([Direction::Rising])?;
        Ok(())
    }
}

mod unknown_name {
    use super::*;
    #[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0, events(turn = dot(x), far = x - radios))]
    pub struct System {
        pub radius: f64,
    }
    pub fn run() -> Result<(), StartError> {
        let start = SystemState { x: 1.0, dot_x: 0.0 };
        let mut run = Integrator::new(&System { radius: 1.0 }, Variational::trapezoid(), 0.1, start)?;
        let _ = run.declared_events([Direction::Rising; 2])?;
        Ok(())
    }
}

mod no_event {
    use super::*;
    #[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0, events())]
    pub struct System;
    pub fn run() {
        let start = SystemState { x: 1.0, dot_x: 0.0 };
        let _ = Integrator::new(&System, Variational::trapezoid(), 0.1, start);
    }
}

mod event_without_a_name {
    use super::*;
    #[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0, events(dot(x)))]
    pub struct System;
    pub fn run() {
        let start = SystemState { x: 1.0, dot_x: 0.0 };
        let _ = Integrator::new(&System, Variational::trapezoid(), 0.1, start);
    }
}

mod event_without_a_formula {
    use super::*;
    #[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0, events(turn))]
    pub struct System;
    pub fn run() {
        let start = SystemState { x: 1.0, dot_x: 0.0 };
        let _ = Integrator::new(&System, Variational::trapezoid(), 0.1, start);
    }
}

mod a_differential_is_no_velocity {
    use super::*;
    #[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0, events(turn = d(x)))]
    pub struct System;
    pub fn run() {
        let start = SystemState { x: 1.0, dot_x: 0.0 };
        let _ = Integrator::new(&System, Variational::trapezoid(), 0.1, start);
    }
}

mod velocities_of_a_degenerate_system {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x, y),
        one_form = x * d(y),
        hamiltonian = x * y,
        events(rising = dot(x), other = d(y)),
    )]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod another_word {
    use super::*;
    #[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0, section(turn = x))]
    pub struct System;
    pub fn run() {
        let start = SystemState { x: 1.0, dot_x: 0.0 };
        let _ = Integrator::new(&System, Variational::trapezoid(), 0.1, start);
    }
}

mod not_a_list {
    use super::*;
    #[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0, events = x)]
    pub struct System;
    pub fn run() {
        let start = SystemState { x: 1.0, dot_x: 0.0 };
        let _ = Integrator::new(&System, Variational::trapezoid(), 0.1, start);
    }
}

fn main() {}
