//! Functions of several variables. Each case: one mistake, one error, and a state that exists.

use dvi_core::field::{Expansion, ScalarField};
use dvi_core::prelude::*;
use dvi_core::Scalar;

struct Flat;

impl ScalarField<2> for Flat {
    fn expansion<T: Scalar>(&self, _: [T; 2]) -> Expansion<2, T> {
        let zero = T::lift(0.0);
        Expansion { value: zero, gradient: [zero; 2], hessian: [[zero; 2]; 2] }
    }
}

mod a_number_that_is_called {
    use super::*;

    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = k(x + y))]
    struct S {
        k: f64,
    }

    fn state() -> SState {
        SState { x: 1.0, y: 2.0 }
    }
}

mod no_arguments {
    use super::*;

    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * y + psi())]
    struct S {
        psi: Flat,
    }

    fn state() -> SState {
        SState { x: 1.0, y: 2.0 }
    }
}

mod two_arguments_and_three {
    use super::*;

    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = psi(x, y) + psi(x, y, 1.0))]
    struct S {
        psi: Flat,
    }

    fn state() -> SState {
        SState { x: 1.0, y: 2.0 }
    }
}

mod another_number_of_arguments {
    use super::*;

    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = psi(x, y, 1.0))]
    struct S {
        psi: Flat,
    }

    fn state() -> SState {
        SState { x: 1.0, y: 2.0 }
    }
}

mod a_type_that_is_no_function {
    use super::*;

    struct Plain;

    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = psi(x, y))]
    struct S {
        psi: Plain,
    }

    fn state() -> SState {
        SState { x: 1.0, y: 2.0 }
    }
}

mod a_path_that_is_no_function {
    use super::*;

    const PLAIN: f64 = 1.0;

    #[degenerate_lagrangian(
        coordinates(x, y),
        one_form = x * d(y),
        hamiltonian = psi(x, y),
        functions(psi = self::PLAIN),
    )]
    struct S;

    fn state() -> SState {
        SState { x: 1.0, y: 2.0 }
    }
}

mod in_a_gauge {
    use super::*;

    #[degenerate_lagrangian(
        coordinates(x, y),
        one_form = x * d(y),
        hamiltonian = x,
        gauge = psi(x, y) * x,
    )]
    struct S {
        psi: Flat,
    }

    fn state() -> SState {
        SState { x: 1.0, y: 2.0 }
    }
}

mod a_method_of_self {
    use super::*;

    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = self.psi(x, y))]
    struct S {
        psi: Flat,
    }

    fn state() -> SState {
        SState { x: 1.0, y: 2.0 }
    }
}

mod not_called {
    use super::*;

    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = psi * x)]
    struct S {
        psi: Flat,
    }

    fn state() -> SState {
        SState { x: 1.0, y: 2.0 }
    }
}

mod declared_twice {
    use super::*;

    #[degenerate_lagrangian(
        coordinates(x, y),
        one_form = x * d(y),
        hamiltonian = psi(x, y),
        functions(psi = super::Flat, psi = super::Flat),
    )]
    struct S;

    fn state() -> SState {
        SState { x: 1.0, y: 2.0 }
    }
}

mod a_field_and_a_path {
    use super::*;

    #[degenerate_lagrangian(
        coordinates(x, y),
        one_form = x * d(y),
        hamiltonian = psi(x, y),
        functions(psi = super::Flat),
    )]
    struct S {
        psi: Flat,
    }

    fn state() -> SState {
        SState { x: 1.0, y: 2.0 }
    }
}

mod a_name_of_the_language {
    use super::*;

    #[degenerate_lagrangian(
        coordinates(x, y),
        one_form = x * d(y),
        hamiltonian = x * y.exp(),
        functions(exp = super::Flat),
    )]
    struct S;

    fn state() -> SState {
        SState { x: 1.0, y: 2.0 }
    }
}

mod a_field_called_as_a_method {
    use super::*;

    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x.psi(y))]
    struct S {
        psi: Flat,
    }

    fn state() -> SState {
        SState { x: 1.0, y: 2.0 }
    }
}

mod not_there {
    use super::*;

    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = psi(x, y))]
    struct S {
        phi_of: Flat,
    }

    fn state() -> SState {
        SState { x: 1.0, y: 2.0 }
    }
}

fn main() {}
