//! Events that are declared in the attribute.

use dvi_core::prelude::*;

/// That a system with a mistake in it is taken for one that can be stepped.
fn stepped<S: DegenerateLagrangian>(system: S, state: S::State<f64>) {
    let _ = Integrator::new(&system, Sigma::midpoint(), 0.1, state);
}

/// That a regular system with a mistake in it is taken for one that can be stepped.
fn moved<S: RegularLagrangian>(system: S, state: S::State<f64>) {
    let _ = Integrator::new(&system, Variational::trapezoid(), 0.1, state);
}

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

#[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0, events())]
pub struct NoEvent;
const _: fn() = || moved(NoEvent, NoEventState { x: 1.0, dot_x: 0.0 });

#[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0, events(dot(x)))]
pub struct EventWithoutAName;
const _: fn() = || moved(EventWithoutAName, EventWithoutANameState { x: 1.0, dot_x: 0.0 });

#[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0, events(turn))]
pub struct EventWithoutAFormula;
const _: fn() = || moved(EventWithoutAFormula, EventWithoutAFormulaState { x: 1.0, dot_x: 0.0 });

#[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0, events(turn = d(x)))]
pub struct ADifferentialIsNoVelocity;
const _: fn() = || moved(ADifferentialIsNoVelocity, ADifferentialIsNoVelocityState { x: 1.0, dot_x: 0.0 });

#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = x * d(y),
    hamiltonian = x * y,
    events(rising = dot(x), other = d(y)),
)]
pub struct VelocitiesOfADegenerateSystem;
const _: fn() =
    || stepped(VelocitiesOfADegenerateSystem, VelocitiesOfADegenerateSystemState { x: 1.0, y: 0.0 });

#[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0, section(turn = x))]
pub struct AnotherWord;
const _: fn() = || moved(AnotherWord, AnotherWordState { x: 1.0, dot_x: 0.0 });

fn main() {}
