//! One-forms as lists of components, and Ω that is singular for certain.

use dvi_core::prelude::*;

/// That a system with a mistake in it is taken for one that can be stepped.
fn stepped<S: DegenerateLagrangian>(system: S, state: S::State<f64>) {
    let _ = Integrator::new(&system, Sigma::midpoint(), 0.1, state);
}

#[degenerate_lagrangian(coordinates(x, y), one_form = [y, x, 0.0], hamiltonian = x * y)]
pub struct TooManyComponents;
const _: fn() = || stepped(TooManyComponents, TooManyComponentsState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = [y], hamiltonian = x * y)]
pub struct TooFewComponents;
const _: fn() = || stepped(TooFewComponents, TooFewComponentsState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x[3], y[3]), one_form = [0.0, |j| x[j]], hamiltonian = x[0] * y[0])]
pub struct ArrayWithoutClosure;
const _: fn() =
    || stepped(ArrayWithoutClosure, ArrayWithoutClosureState { x: [1.0, 2.0, 3.0], y: [0.0; 3] });

#[degenerate_lagrangian(coordinates(x, y), one_form = [|i| y, 0.0], hamiltonian = x * y)]
pub struct ClosureForASingleCoordinate;
const _: fn() = || stepped(ClosureForASingleCoordinate, ClosureForASingleCoordinateState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y) + y * d(x), hamiltonian = x * y)]
pub struct ExactOneForm;
const _: fn() = || stepped(ExactOneForm, ExactOneFormState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), lagrangian = x * y)]
pub struct NoVelocityInTheLagrangian;
const _: fn() = || stepped(NoVelocityInTheLagrangian, NoVelocityInTheLagrangianState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y, u, w), one_form = x * d(y), hamiltonian = x * y + u)]
pub struct CoordinatesThatNothingMentions;
const _: fn() =
    || stepped(CoordinatesThatNothingMentions, CoordinatesThatNothingMentionsState { x: 1.0, y: 0.0, u: 0.0, w: 0.0 });

#[degenerate_lagrangian(
    coordinates(x, y, u, w),
    one_form = x * d(y) + x * x * d(u) + x * d(w),
    hamiltonian = x * y + u * w,
)]
pub struct AllThatCouplesCouplesToOne;
const _: fn() =
    || stepped(AllThatCouplesCouplesToOne, AllThatCouplesCouplesToOneState { x: 1.0, y: 0.0, u: 0.0, w: 0.0 });

fn main() {}
