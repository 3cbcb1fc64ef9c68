//! Time transformations. Each case: one mistake, one error, and a state that exists.

use dvi_core::prelude::*;

#[degenerate_lagrangian(coordinates(x, y), one_form = y * d(x), hamiltonian = x * y, time_transform = -1.0)]
struct NotPositive;
const _: NotPositiveState = NotPositiveState { x: 1.0, y: 2.0, t: 0.0, energy: 0.0 };

#[degenerate_lagrangian(coordinates(x, y), one_form = y * d(x), hamiltonian = x * y, time_transform = d(x))]
struct AVelocity;
const _: AVelocityState = AVelocityState { x: 1.0, y: 2.0, t: 0.0, energy: 0.0 };

#[degenerate_lagrangian(coordinates(x, t), one_form = t * d(x), hamiltonian = x * t, time_transform = 1.0)]
struct ACoordinateCalledT;
const _: ACoordinateCalledTState = ACoordinateCalledTState { x: 1.0, t: 2.0 };

#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = y * d(x),
    hamiltonian = x * y * energy,
    time_transform = 1.0,
)]
struct AFieldCalledEnergy {
    energy: f64,
}

#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = y * d(x),
    hamiltonian = x * y,
    time_transform = 1.0 / (energy - x * y),
)]
struct TheEnergyInAFormula;
const _: TheEnergyInAFormulaState = TheEnergyInAFormulaState { x: 1.0, y: 2.0, t: 0.0, energy: 0.0 };

#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = y * d(x) - x * d(t),
    hamiltonian = x * y,
    time_transform = 1.0 + x * x,
)]
struct TheVelocityOfTheTime;
const _: TheVelocityOfTheTimeState = TheVelocityOfTheTimeState { x: 1.0, y: 2.0, t: 0.0, energy: 0.0 };

#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = [y, 0.0, 1.0, 0.0],
    hamiltonian = x * y,
    time_transform = 1.0 + x * x,
)]
struct ComponentsOfTheDeclaredCoordinates;
const _: ComponentsOfTheDeclaredCoordinatesState =
    ComponentsOfTheDeclaredCoordinatesState { x: 1.0, y: 2.0, t: 0.0, energy: 0.0 };

mod not_transformed {
    use super::*;

    #[degenerate_lagrangian(coordinates(x, y), one_form = y * d(x), hamiltonian = x * y)]
    struct S;

    fn start() {
        let _ = S.with_energy(SState { x: 1.0, y: 2.0 });
    }
}

mod begun_with_a_mistake {
    use super::*;

    #[degenerate_lagrangian(
        coordinates(x, y),
        one_form = y * d(x),
        hamiltonian = x * z,
        time_transform = 1.0 + x * x,
    )]
    struct S;

    fn start() {
        let _ = S.with_energy(SState { x: 1.0, y: 2.0, t: 0.0, energy: 0.0 });
    }
}

fn main() {}
