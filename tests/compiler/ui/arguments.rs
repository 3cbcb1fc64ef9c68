//! The arguments of the attribute.

use dvi_core::prelude::*;

/// That a system with a mistake in it is taken for one that can be stepped.
fn stepped<S: DegenerateLagrangian>(system: S, state: S::State<f64>) {
    let _ = Integrator::new(&system, Sigma::midpoint(), 0.1, state);
}

macro_rules! degenerate {
    ($name:ident $state:ident: $($arguments:tt)*) => {
        #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), $($arguments)*)]
        pub struct $name;
        const _: fn() = || stepped($name, $state { x: 1.0, y: 0.0 });
    };
}

degenerate! { NoHamiltonian NoHamiltonianState: }

#[degenerate_lagrangian(coordinates(x, y), hamiltonian = x * y)]
pub struct NoOneForm;
const _: fn() = || stepped(NoOneForm, NoOneFormState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y))]
pub struct NoDynamics;
const _: fn() = || stepped(NoDynamics, NoDynamicsState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), lagrangian = x * dot(y) - x, one_form = x * d(y))]
pub struct LagrangianAndOneForm;
const _: fn() = || stepped(LagrangianAndOneForm, LagrangianAndOneFormState { x: 1.0, y: 0.0 });

degenerate! { MisspeltArgument MisspeltArgumentState: hamiltonain = x * y }
degenerate! { UnknownArgument UnknownArgumentState: hamiltonian = x * y, damping = x }
degenerate! { ArgumentTwice ArgumentTwiceState: hamiltonian = x * y, hamiltonian = x }

#[degenerate_lagrangian(coordinates = (x, y), one_form = x * d(y), hamiltonian = x * y)]
pub struct CoordinatesAssigned;
const _: fn() = || stepped(CoordinatesAssigned, CoordinatesAssignedState { x: 1.0, y: 0.0 });

degenerate! { HamiltonianIsEmpty HamiltonianIsEmptyState: hamiltonian = }
degenerate! { HalfAnExpression HalfAnExpressionState: hamiltonian = x * }
degenerate! { TwoExpressions TwoExpressionsState: hamiltonian = x y }

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y) hamiltonian = x)]
pub struct CommaIsMissing;
const _: fn() = || stepped(CommaIsMissing, CommaIsMissingState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y) one_form = x * d(y), hamiltonian = x * y)]
pub struct CommaAfterAListIsMissing;
const _: fn() = || stepped(CommaAfterAListIsMissing, CommaAfterAListIsMissingState { x: 1.0, y: 0.0 });

degenerate! { LiteralArgument LiteralArgumentState: hamiltonian = x * y, "x" }
degenerate! { ArgumentWithoutValue ArgumentWithoutValueState: hamiltonian = x * y, momenta }

#[degenerate_lagrangian(coordinates(x, y), one_form: x * d(y), hamiltonian = x)]
pub struct ColonForEquals;
const _: fn() = || stepped(ColonForEquals, ColonForEqualsState { x: 1.0, y: 0.0 });

degenerate! { CrateIsNoPath CrateIsNoPathState: hamiltonian = x * y, crate = 3 }

degenerate! { BarBeforeAnotherArgument BarBeforeAnotherArgumentState: hamiltonian = x | y, momenta(p = x) }
degenerate! { MomentumInBrackets MomentumInBracketsState: hamiltonian = x * y, momenta[p = x] }

fn main() {}
