//! Velocities: where they may stand, how they are written, and that L is affine in them.

use dvi_core::prelude::*;

/// That a system with a mistake in it is taken for one that can be stepped.
fn stepped<S: DegenerateLagrangian>(system: S, state: S::State<f64>) {
    let _ = Integrator::new(&system, Sigma::midpoint(), 0.1, state);
}

macro_rules! two {
    ($name:ident $state:ident: $($arguments:tt)*) => {
        #[degenerate_lagrangian(coordinates(x, y), $($arguments)*)]
        pub struct $name;
        const _: fn() = || stepped($name, $state { x: 1.0, y: 0.0 });
    };
}

two! { QuadraticOneForm QuadraticOneFormState: one_form = x * d(y) + y * d(x) * d(x), hamiltonian = x }

two! { DividedByAVelocity DividedByAVelocityState: one_form = x / d(y), hamiltonian = x * y }

#[degenerate_lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 + mu / x.hypot(y),
)]
pub struct RegularLagrangian {
    pub mu: f64,
}
const _: fn() = || stepped(RegularLagrangian { mu: 1.0 }, RegularLagrangianState { x: 1.0, y: 0.0 });

two! { ChoiceByAVelocity ChoiceByAVelocityState: lagrangian = x * dot(y) - if dot(x) < 0.0 { x } else { y } }

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * x + d(y) * y)]
pub struct VelocityInTheHamiltonian;
const _: fn() = || stepped(VelocityInTheHamiltonian, VelocityInTheHamiltonianState { x: 1.0, y: 0.0 });

two! { VelocityInAComponent VelocityInAComponentState: one_form = [0.0, x * d(y)], hamiltonian = x * y }
two! { DotInAOneForm DotInAOneFormState: one_form = x * dot(y), hamiltonian = x * y }
two! { DInALagrangian DInALagrangianState: lagrangian = x * d(y) - x * y }
two! { TermWithoutD TermWithoutDState: one_form = x * d(y) - y * x, hamiltonian = x * y }
two! { NothingWithD NothingWithDState: one_form = x * y, hamiltonian = x * y }

two! { DOfTwo DOfTwoState: one_form = x * d(x, y), hamiltonian = x * y }

fn main() {}
