//! The arguments of `#[lagrangian]`, and where it differs from `#[degenerate_lagrangian]`.

use dvi_core::prelude::*;

fn run<S: RegularLagrangian>(system: &S, state: S::State<f64>) {
    let _ = (system.energy(&[0.0], &[0.0], 0.0), state);
}

#[lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * y)]
pub struct OneFormAndHamiltonian;
const _: fn() =
    || run(&OneFormAndHamiltonian, OneFormAndHamiltonianState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });

#[lagrangian(coordinates(x, y), one_form(x), lagrangian = dot(x).powi(2) + dot(y).powi(2) - x * y)]
pub struct ListOfAOneForm;
const _: fn() = || run(&ListOfAOneForm, ListOfAOneFormState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });

#[lagrangian(coordinates(x, y))]
pub struct NoLagrangian;
const _: fn() = || run(&NoLagrangian, NoLagrangianState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });

#[lagrangian(coordinates(x, y), momenta(p = dot(x)))]
pub struct MomentaWithoutALagrangian;
const _: fn() =
    || run(&MomentaWithoutALagrangian, MomentaWithoutALagrangianState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });

#[lagrangian(coordinates(x, y), lagrangian = d(x) * d(y))]
pub struct DInALagrangian;
const _: fn() = || run(&DInALagrangian, DInALagrangianState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });

#[lagrangian(coordinates(x, y), lagrangian = dot(x).powi(2) + dot(y).powi(2) - x * y, momenta(p = d(x)))]
pub struct DInAMomentum;
const _: fn() = || run(&DInAMomentum, DInAMomentumState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });

#[lagrangian(coordinates(x, y), lagrangian = dot(x).powi(2) + dot(x * y).powi(2))]
pub struct VelocityOfAnExpression;
const _: fn() =
    || run(&VelocityOfAnExpression, VelocityOfAnExpressionState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });

#[lagrangian(coordinates(x[4], y), lagrangian = sum(0..4, |j| dot(x).powi(2)) + dot(y).powi(2))]
pub struct VelocityWithoutAnIndex;
const _: fn() =
    || run(&VelocityWithoutAnIndex, VelocityWithoutAnIndexState { x: [1.0; 4], y: 0.0, dot_x: [0.0; 4], dot_y: 1.0 });

#[lagrangian(coordinates(x, y), lagrangian = dot(x).powi(2) + dot(y).powi(2) - x * y + dot_x)]
pub struct FieldOfTheVelocity;
const _: fn() =
    || run(&FieldOfTheVelocity, FieldOfTheVelocityState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });

fn main() {}
