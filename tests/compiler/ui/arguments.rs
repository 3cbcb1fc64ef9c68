//! The arguments of the attribute.

use dvi_core::prelude::*;

/// That a system with a mistake in it is taken for one that can be stepped.
fn stepped<S: DegenerateLagrangian>(system: S, state: S::State<f64>) {
    let _ = Integrator::new(&system, Sigma::midpoint(), 0.1, state);
}

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y))]
pub struct NoHamiltonian;
const _: fn() = || stepped(NoHamiltonian, NoHamiltonianState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), hamiltonian = x * y)]
pub struct NoOneForm;
const _: fn() = || stepped(NoOneForm, NoOneFormState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y))]
pub struct NoDynamics;
const _: fn() = || stepped(NoDynamics, NoDynamicsState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian()]
pub struct Nothing;
const _: fn() = || stepped(Nothing, NothingState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), lagrangian = x * dot(y) - x, one_form = x * d(y))]
pub struct LagrangianAndOneForm;
const _: fn() = || stepped(LagrangianAndOneForm, LagrangianAndOneFormState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonain = x * y)]
pub struct MisspeltArgument;
const _: fn() = || stepped(MisspeltArgument, MisspeltArgumentState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * y, damping = x)]
pub struct UnknownArgument;
const _: fn() = || stepped(UnknownArgument, UnknownArgumentState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * y, hamiltonian = x)]
pub struct ArgumentTwice;
const _: fn() = || stepped(ArgumentTwice, ArgumentTwiceState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates = (x, y), one_form = x * d(y), hamiltonian = x * y)]
pub struct CoordinatesAssigned;
const _: fn() = || stepped(CoordinatesAssigned, CoordinatesAssignedState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = )]
pub struct HamiltonianIsEmpty;
const _: fn() = || stepped(HamiltonianIsEmpty, HamiltonianIsEmptyState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * )]
pub struct HalfAnExpression;
const _: fn() = || stepped(HalfAnExpression, HalfAnExpressionState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x y)]
pub struct TwoExpressions;
const _: fn() = || stepped(TwoExpressions, TwoExpressionsState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y) hamiltonian = x)]
pub struct CommaIsMissing;
const _: fn() = || stepped(CommaIsMissing, CommaIsMissingState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y) one_form = x * d(y), hamiltonian = x * y)]
pub struct CommaAfterAListIsMissing;
const _: fn() = || stepped(CommaAfterAListIsMissing, CommaAfterAListIsMissingState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * y, "x")]
pub struct LiteralArgument;
const _: fn() = || stepped(LiteralArgument, LiteralArgumentState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * y, momenta)]
pub struct ArgumentWithoutValue;
const _: fn() = || stepped(ArgumentWithoutValue, ArgumentWithoutValueState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form: x * d(y), hamiltonian = x)]
pub struct ColonForEquals;
const _: fn() = || stepped(ColonForEquals, ColonForEqualsState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * y, crate = 3)]
pub struct CrateIsNoPath;
const _: fn() = || stepped(CrateIsNoPath, CrateIsNoPathState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = |x, y| x * d(y), hamiltonian = x)]
pub struct ClosureForAOneForm;
const _: fn() = || stepped(ClosureForAOneForm, ClosureForAOneFormState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x | y, momenta(p = x))]
pub struct BarBeforeAnotherArgument;
const _: fn() = || stepped(BarBeforeAnotherArgument, BarBeforeAnotherArgumentState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * y, momenta[p = x])]
pub struct MomentumInBrackets;
const _: fn() = || stepped(MomentumInBrackets, MomentumInBracketsState { x: 1.0, y: 0.0 });

fn main() {}
