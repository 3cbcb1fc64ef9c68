//! Formulas beyond reason, refused before they exhaust the compiler.

use dvi_core::prelude::*;

/// That a system with a mistake in it is taken for one that can be stepped.
fn stepped<S: DegenerateLagrangian>(system: S, state: S::State<f64>) {
    let _ = Integrator::new(&system, Sigma::midpoint(), 0.1, state);
}

#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = x * d(y),
    hamiltonian = - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - x,
)]
pub struct Signs;
const _: fn() = || stepped(Signs, SignsState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = x * d(y),
    hamiltonian = x.sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin(),
)]
pub struct FunctionsOfFunctions;
const _: fn() = || stepped(FunctionsOfFunctions, FunctionsOfFunctionsState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = x * d(y),
    hamiltonian = x.powi(4096).powi(2),
)]
pub struct PowersOfPowers;
const _: fn() = || stepped(PowersOfPowers, PowersOfPowersState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = x * d(y),
    hamiltonian = {
        let a = x * x;
        let a = a * a;
        let a = a * a;
        let a = a * a;
        let a = a * a;
        let a = a * a;
        let a = a * a;
        let a = a * a;
        let a = a * a;
        let a = a * a;
        let a = a * a;
        let a = a * a;
        let a = a * a;
        a
    },
)]
pub struct SquaresOfNames;
const _: fn() = || stepped(SquaresOfNames, SquaresOfNamesState { x: 1.0, y: 0.0 });

fn main() {}
