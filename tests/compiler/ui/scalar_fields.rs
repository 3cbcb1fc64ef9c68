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

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = k(x + y))]
struct ANumberThatIsCalled {
    k: f64,
}
const _: ANumberThatIsCalledState = ANumberThatIsCalledState { x: 1.0, y: 2.0 };

macro_rules! of_a_function {
    ($name:ident: $($arguments:tt)*) => {
        #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), $($arguments)*)]
        struct $name {
            psi: Flat,
        }
    };
}

of_a_function! { NoArguments: hamiltonian = x * y + psi() }
const _: NoArgumentsState = NoArgumentsState { x: 1.0, y: 2.0 };

of_a_function! { TwoArgumentsAndThree: hamiltonian = psi(x, y) + psi(x, y, 1.0) }
const _: TwoArgumentsAndThreeState = TwoArgumentsAndThreeState { x: 1.0, y: 2.0 };

of_a_function! { AnotherNumberOfArguments: hamiltonian = psi(x, y, 1.0) }
const _: AnotherNumberOfArgumentsState = AnotherNumberOfArgumentsState { x: 1.0, y: 2.0 };

struct Plain;

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = psi(x, y))]
struct ATypeThatIsNoFunction {
    psi: Plain,
}
const _: ATypeThatIsNoFunctionState = ATypeThatIsNoFunctionState { x: 1.0, y: 2.0 };

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
    const _: SState = SState { x: 1.0, y: 2.0 };
}

#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = x * d(y),
    hamiltonian = x,
    gauge = psi(x, y) * x,
)]
struct InAGauge {
    psi: Flat,
}
const _: InAGaugeState = InAGaugeState { x: 1.0, y: 2.0 };

of_a_function! { AMethodOfSelf: hamiltonian = self.psi(x, y) }
const _: AMethodOfSelfState = AMethodOfSelfState { x: 1.0, y: 2.0 };

of_a_function! { NotCalled: hamiltonian = psi * x }
const _: NotCalledState = NotCalledState { x: 1.0, y: 2.0 };

of_a_function! { AFieldAndAPath: hamiltonian = psi(x, y), functions(psi = super::Flat) }
const _: AFieldAndAPathState = AFieldAndAPathState { x: 1.0, y: 2.0 };

#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = x * d(y),
    hamiltonian = x * y.exp(),
    functions(exp = super::Flat),
)]
struct ANameOfTheLanguage;
const _: ANameOfTheLanguageState = ANameOfTheLanguageState { x: 1.0, y: 2.0 };

of_a_function! { AFieldCalledAsAMethod: hamiltonian = x.psi(y) }
const _: AFieldCalledAsAMethodState = AFieldCalledAsAMethodState { x: 1.0, y: 2.0 };

fn main() {}
