//! Names, functions and their arguments. Each case: one mistake, one error, and a state that exists.

use dvi_core::prelude::*;

/// That a system with a mistake in it is taken for one that can be stepped.
fn stepped<S: DegenerateLagrangian>(system: S, state: S::State<f64>) {
    let _ = Integrator::new(&system, Sigma::midpoint(), 0.1, state);
}

macro_rules! with_a_parameter {
    ($name:ident $state:ident: $($arguments:tt)*) => {
        #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), $($arguments)*)]
        pub struct $name {
            pub omega: f64,
        }
        const _: fn() = || stepped($name { omega: 1.0 }, $state { x: 1.0, y: 0.0 });
    };
}

with_a_parameter! { UnknownName UnknownNameState: hamiltonian = omga * x * x + y * y }
with_a_parameter! { NameLikeNothing NameLikeNothingState: hamiltonian = x * charge }
with_a_parameter! { UnknownFieldOfSelf UnknownFieldOfSelfState: hamiltonian = self.omgea * x }

macro_rules! degenerate {
    ($name:ident $state:ident: $($arguments:tt)*) => {
        #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), $($arguments)*)]
        pub struct $name;
        const _: fn() = || stepped($name, $state { x: 1.0, y: 0.0 });
    };
}

degenerate! { UnknownFunction UnknownFunctionState: hamiltonian = bessel(x) + y }

#[degenerate_lagrangian(
    coordinates(x[2], y[2]),
    one_form = sum(0..2, |j| x[j] * d(y[j])),
    hamiltonian = sum_pair(0..2, |j, k| x[j] * x[k]),
)]
pub struct MisspeltSum;
const _: fn() = || stepped(MisspeltSum, MisspeltSumState { x: [1.0, 2.0], y: [0.0, 1.0] });

degenerate! { FunctionInsteadOfMethod FunctionInsteadOfMethodState: hamiltonian = sin(x) + y }
degenerate! { UndeclaredPath UndeclaredPathState: hamiltonian = special::gamma(x) }
degenerate! { TooManyArguments TooManyArgumentsState: hamiltonian = x.sin(y) }
degenerate! { TooFewArguments TooFewArgumentsState: hamiltonian = x.atan2() + y }
degenerate! { OwnFunctionWithTwoArguments OwnFunctionWithTwoArgumentsState:
    hamiltonian = f(x, y),
    functions(f = [sin, cos, minus_sin])
}

degenerate! { DividedByZero DividedByZeroState: hamiltonian = x / 0.0 + y }

degenerate! { OwnFunctionAsAMethod OwnFunctionAsAMethodState:
    hamiltonian = x.f() + y,
    functions(f = [f, df, d2f])
}

degenerate! { NumberWithASuffix NumberWithASuffixState: hamiltonian = 2u8 * x + y }
degenerate! { NumberBeyondAll NumberBeyondAllState: hamiltonian = 1e999 * x + y }
degenerate! { LogarithmOfZero LogarithmOfZeroState: hamiltonian = 0.0.ln() * x + y }

#[degenerate_lagrangian(
    coordinates(x[2], y[2]),
    one_form = sum(0..2, |j| x[j] * d(y[j])),
    hamiltonian = sum(0..2, |j| x[j] * f64::from(j)) + [1.0, 2.0].iter().sum(),
)]
pub struct NumbersOfIndices;
const _: fn() = || stepped(NumbersOfIndices, NumbersOfIndicesState { x: [1.0, 2.0], y: [0.0, 1.0] });

fn main() {}
