//! Time transformations. Each case: one mistake, one error, and a state that exists.

use dvi_core::prelude::*;

mod not_positive {
    use super::*;

    #[degenerate_lagrangian(coordinates(x, y), one_form = y * d(x), hamiltonian = x * y, time_transform = -1.0)]
    struct S;

    fn state() -> SState {
        SState { x: 1.0, y: 2.0, t: 0.0, energy: 0.0 }
    }
}

mod a_velocity {
    use super::*;

    #[degenerate_lagrangian(coordinates(x, y), one_form = y * d(x), hamiltonian = x * y, time_transform = d(x))]
    struct S;

    fn state() -> SState {
        SState { x: 1.0, y: 2.0, t: 0.0, energy: 0.0 }
    }
}

mod a_coordinate_called_t {
    use super::*;

    #[degenerate_lagrangian(coordinates(x, t), one_form = t * d(x), hamiltonian = x * t, time_transform = 1.0)]
    struct S;

    fn state() -> SState {
        SState { x: 1.0, t: 2.0 }
    }
}

#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = y * d(x),
    hamiltonian = x * y * energy,
    time_transform = 1.0,
)]
struct AFieldCalledEnergy {
    energy: f64,
}

mod the_energy_in_a_formula {
    use super::*;

    #[degenerate_lagrangian(
        coordinates(x, y),
        one_form = y * d(x),
        hamiltonian = x * y,
        time_transform = 1.0 / (energy - x * y),
    )]
    struct S;

    fn state() -> SState {
        SState { x: 1.0, y: 2.0, t: 0.0, energy: 0.0 }
    }
}

mod the_velocity_of_the_time {
    use super::*;

    #[degenerate_lagrangian(
        coordinates(x, y),
        one_form = y * d(x) - x * d(t),
        hamiltonian = x * y,
        time_transform = 1.0 + x * x,
    )]
    struct S;

    fn state() -> SState {
        SState { x: 1.0, y: 2.0, t: 0.0, energy: 0.0 }
    }
}

mod components_of_the_declared_coordinates {
    use super::*;

    #[degenerate_lagrangian(
        coordinates(x, y),
        one_form = [y, 0.0, 1.0, 0.0],
        hamiltonian = x * y,
        time_transform = 1.0 + x * x,
    )]
    struct S;

    fn state() -> SState {
        SState { x: 1.0, y: 2.0, t: 0.0, energy: 0.0 }
    }
}

mod of_a_regular_system {
    use super::*;

    #[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0, time_transform = 1.0 + x * x)]
    struct S;

    fn state() -> SState {
        SState { x: 1.0, dot_x: 2.0 }
    }
}

mod not_transformed {
    use super::*;

    #[degenerate_lagrangian(coordinates(x, y), one_form = y * d(x), hamiltonian = x * y)]
    struct S;

    fn start() {
        let _ = S.with_energy(SState { x: 1.0, y: 2.0 });
    }
}

mod no_value {
    use super::*;

    #[degenerate_lagrangian(coordinates(x, y), one_form = y * d(x), hamiltonian = x * y, time_transform(x))]
    struct S;

    fn state() -> SState {
        SState { x: 1.0, y: 2.0 }
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
