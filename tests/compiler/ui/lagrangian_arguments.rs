//! The arguments of `#[lagrangian]`, and where it differs from `#[degenerate_lagrangian]`.

use dvi_core::prelude::*;

fn run<S: RegularLagrangian>(system: &S, state: S::State<f64>) {
    let _ = (system.energy(&[0.0], &[0.0], 0.0), state);
}

macro_rules! two {
    ($name:ident $state:ident: $($arguments:tt)*) => {
        #[lagrangian(coordinates(x, y), $($arguments)*)]
        pub struct $name;
        const _: fn() = || run(&$name, $state { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });
    };
}

two! { OneFormAndHamiltonian OneFormAndHamiltonianState: one_form = x * d(y), hamiltonian = x * y }
two! { MomentaWithoutALagrangian MomentaWithoutALagrangianState: momenta(p = dot(x)) }
two! { DInALagrangian DInALagrangianState: lagrangian = d(x) * d(y) }
two! {
    DInAMomentum DInAMomentumState:
    lagrangian = dot(x).powi(2) + dot(y).powi(2) - x * y, momenta(p = d(x))
}
two! { VelocityOfAnExpression VelocityOfAnExpressionState: lagrangian = dot(x).powi(2) + dot(x * y).powi(2) }

#[lagrangian(coordinates(x[4], y), lagrangian = sum(0..4, |j| dot(x).powi(2)) + dot(y).powi(2))]
pub struct VelocityWithoutAnIndex;

two! {
    FieldOfTheVelocity FieldOfTheVelocityState:
    lagrangian = dot(x).powi(2) + dot(y).powi(2) - x * y + dot_x
}

fn main() {}
