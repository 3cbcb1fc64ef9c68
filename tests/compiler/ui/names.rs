//! Names, functions and their arguments. Each case: one mistake, one error, and a state that exists.

use dvi_core::prelude::*;

/// That a system with a mistake in it is taken for one that can be stepped.
fn stepped<S: DegenerateLagrangian>(system: S, state: S::State<f64>) {
    let _ = Integrator::new(&system, Sigma::midpoint(), 0.1, state);
}

#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = x * d(y),
    hamiltonian = omga * x * x + y * y,
)]
pub struct UnknownName {
    pub omega: f64,
}
const _: fn() = || stepped(UnknownName { omega: 1.0 }, UnknownNameState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * charge)]
pub struct NameLikeNothing {
    pub omega: f64,
}
const _: fn() = || stepped(NameLikeNothing { omega: 1.0 }, NameLikeNothingState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = self.omgea * x)]
pub struct UnknownFieldOfSelf {
    pub omega: f64,
}
const _: fn() = || stepped(UnknownFieldOfSelf { omega: 1.0 }, UnknownFieldOfSelfState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = bessel(x) + y)]
pub struct UnknownFunction;
const _: fn() = || stepped(UnknownFunction, UnknownFunctionState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(
    coordinates(x[2], y[2]),
    one_form = sum(0..2, |j| x[j] * d(y[j])),
    hamiltonian = sum_pair(0..2, |j, k| x[j] * x[k]),
)]
pub struct MisspeltSum;
const _: fn() = || stepped(MisspeltSum, MisspeltSumState { x: [1.0, 2.0], y: [0.0, 1.0] });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = sin(x) + y)]
pub struct FunctionInsteadOfMethod;
const _: fn() = || stepped(FunctionInsteadOfMethod, FunctionInsteadOfMethodState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = special::gamma(x))]
pub struct UndeclaredPath;
const _: fn() = || stepped(UndeclaredPath, UndeclaredPathState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x.sin(y))]
pub struct TooManyArguments;
const _: fn() = || stepped(TooManyArguments, TooManyArgumentsState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x.atan2() + y)]
pub struct TooFewArguments;
const _: fn() = || stepped(TooFewArguments, TooFewArgumentsState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = x * d(y),
    hamiltonian = f(x, y),
    functions(f = [sin, cos, minus_sin]),
)]
pub struct OwnFunctionWithTwoArguments;
const _: fn() = || stepped(OwnFunctionWithTwoArguments, OwnFunctionWithTwoArgumentsState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x.powi(n) + y)]
pub struct ExponentThatIsNoLiteral {
    pub n: i32,
}
const _: fn() =
    || stepped(ExponentThatIsNoLiteral { n: 2 }, ExponentThatIsNoLiteralState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x / 0.0 + y)]
pub struct DividedByZero;
const _: fn() = || stepped(DividedByZero, DividedByZeroState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = x * d(y),
    hamiltonian = {
        let r2 = x * x + z * z;
        r2.sqrt() + 1.0 / r2
    },
)]
pub struct ValueOfALetIsUnknown;
const _: fn() = || stepped(ValueOfALetIsUnknown, ValueOfALetIsUnknownState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x.f() + y, functions(f = [f, df, d2f]))]
pub struct OwnFunctionAsAMethod;
const _: fn() = || stepped(OwnFunctionAsAMethod, OwnFunctionAsAMethodState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = 2u8 * x + y)]
pub struct NumberWithASuffix;
const _: fn() = || stepped(NumberWithASuffix, NumberWithASuffixState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = 1e999 * x + y)]
pub struct NumberBeyondAll;
const _: fn() = || stepped(NumberBeyondAll, NumberBeyondAllState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = 0.0.ln() * x + y)]
pub struct LogarithmOfZero;
const _: fn() = || stepped(LogarithmOfZero, LogarithmOfZeroState { x: 1.0, y: 0.0 });

fn main() {}
