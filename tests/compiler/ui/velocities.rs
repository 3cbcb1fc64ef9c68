//! Velocities: where they may stand, how they are written, and that L is affine in them.

use dvi_core::prelude::*;

/// That a system with a mistake in it is taken for one that can be stepped.
fn stepped<S: DegenerateLagrangian>(system: S, state: S::State<f64>) {
    let _ = Integrator::new(&system, Sigma::midpoint(), 0.1, state);
}

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y) + y * d(x) * d(x), hamiltonian = x)]
pub struct QuadraticOneForm;
const _: fn() = || stepped(QuadraticOneForm, QuadraticOneFormState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = f(d(y)),
    hamiltonian = x * y,
    functions(f = [f, df, d2f]),
)]
pub struct OwnFunctionOfAVelocity;
const _: fn() = || stepped(OwnFunctionOfAVelocity, OwnFunctionOfAVelocityState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x / d(y), hamiltonian = x * y)]
pub struct DividedByAVelocity;
const _: fn() = || stepped(DividedByAVelocity, DividedByAVelocityState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 + mu / x.hypot(y),
)]
pub struct RegularLagrangian {
    pub mu: f64,
}
const _: fn() = || stepped(RegularLagrangian { mu: 1.0 }, RegularLagrangianState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), lagrangian = x * dot(y) - dot(x) * dot(y) - x * y)]
pub struct ProductOfVelocities;
const _: fn() = || stepped(ProductOfVelocities, ProductOfVelocitiesState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(
    coordinates(x, y),
    lagrangian = x * dot(y) - if dot(x) < 0.0 { x } else { y },
)]
pub struct ChoiceByAVelocity;
const _: fn() = || stepped(ChoiceByAVelocity, ChoiceByAVelocityState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * x + d(y) * y)]
pub struct VelocityInTheHamiltonian;
const _: fn() = || stepped(VelocityInTheHamiltonian, VelocityInTheHamiltonianState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = x * d(y),
    hamiltonian = x * y,
    momenta(p = x * dot(x)),
)]
pub struct VelocityInAMomentum;
const _: fn() = || stepped(VelocityInAMomentum, VelocityInAMomentumState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = [0.0, x * d(y)], hamiltonian = x * y)]
pub struct VelocityInAComponent;
const _: fn() = || stepped(VelocityInAComponent, VelocityInAComponentState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * dot(y), hamiltonian = x * y)]
pub struct DotInAOneForm;
const _: fn() = || stepped(DotInAOneForm, DotInAOneFormState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), lagrangian = x * d(y) - x * y)]
pub struct DInALagrangian;
const _: fn() = || stepped(DInALagrangian, DInALagrangianState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y) - y * x, hamiltonian = x * y)]
pub struct TermWithoutD;
const _: fn() = || stepped(TermWithoutD, TermWithoutDState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * y, hamiltonian = x * y)]
pub struct NothingWithD;
const _: fn() = || stepped(NothingWithD, NothingWithDState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y) + x * d(a), hamiltonian = x * y)]
pub struct DOfAParameter {
    pub a: f64,
}
const _: fn() = || stepped(DOfAParameter { a: 1.0 }, DOfAParameterState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(x, y), hamiltonian = x * y)]
pub struct DOfTwo;
const _: fn() = || stepped(DOfTwo, DOfTwoState { x: 1.0, y: 0.0 });

fn main() {}
