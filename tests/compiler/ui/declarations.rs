//! Coordinates, fields, sizes, functions, and what the attribute stands on.

use dvi_core::prelude::*;

/// That a system with a mistake in it is taken for one that can be stepped.
fn stepped<S: DegenerateLagrangian>(system: S, state: S::State<f64>) {
    let _ = Integrator::new(&system, Sigma::midpoint(), 0.1, state);
}

#[degenerate_lagrangian(coordinates(x, PI), one_form = x * d(PI), hamiltonian = x)]
pub struct CoordinateIsAConstant;
const _: fn() = || stepped(CoordinateIsAConstant, CoordinateIsAConstantState { x: 1.0, PI: 0.0 });

#[degenerate_lagrangian(coordinates(), one_form = x * d(y), hamiltonian = x * y)]
pub struct EmptyCoordinates;
const _: fn() = || stepped(EmptyCoordinates, EmptyCoordinatesState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x: f64, y), one_form = x * d(y), hamiltonian = x * y)]
pub struct TypedCoordinate;
const _: fn() = || stepped(TypedCoordinate, TypedCoordinateState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x y), one_form = x * d(y), hamiltonian = x * y)]
pub struct CoordinatesWithoutComma;
const _: fn() = || stepped(CoordinatesWithoutComma, CoordinatesWithoutCommaState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, type), one_form = x * d(y), hamiltonian = x * y)]
pub struct KeywordAsACoordinate;
const _: fn() = || stepped(KeywordAsACoordinate, KeywordAsACoordinateState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, self), one_form = x * d(y), hamiltonian = x * y)]
pub struct KeywordThatIsNoName;
const _: fn() = || stepped(KeywordThatIsNoName, KeywordThatIsNoNameState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, 2), one_form = x * d(y), hamiltonian = x * y)]
pub struct LiteralAsACoordinate;
const _: fn() = || stepped(LiteralAsACoordinate, LiteralAsACoordinateState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x[N / 2], y[N / 2]), one_form = sum(0..4, |j| x[j] * d(y[j])), hamiltonian = x[0] * y[0])]
pub struct SizeIsAQuotient<const N: usize>;
const _: fn() = || stepped(SizeIsAQuotient::<3>, SizeIsAQuotientState { x: [1.0; 4], y: [0.0; 4] });

#[degenerate_lagrangian(coordinates(x[M], y[4]), one_form = sum(0..4, |j| x[j] * d(y[j])), hamiltonian = x[0] * y[0])]
pub struct SizeIsUnknown<const N: usize>;
const _: fn() = || stepped(SizeIsUnknown::<4>, SizeIsUnknownState { x: [1.0; 4], y: [0.0; 4] });

#[degenerate_lagrangian(coordinates(x[], y[4]), one_form = sum(0..4, |j| x[j] * d(y[j])), hamiltonian = x[0] * y[0])]
pub struct SizeIsMissing;
const _: fn() = || stepped(SizeIsMissing, SizeIsMissingState { x: [1.0; 4], y: [0.0; 4] });

#[degenerate_lagrangian(coordinates(x[0], y[4]), one_form = sum(0..4, |j| x[j] * d(y[j])), hamiltonian = x[0] * y[0])]
pub struct SizeIsZero;
const _: fn() = || stepped(SizeIsZero, SizeIsZeroState { x: [], y: [0.0; 4] });

#[degenerate_lagrangian(coordinates(x[99999999999999999999999], y[4]), one_form = sum(0..4, |j| x[j] * d(y[j])), hamiltonian = x[0] * y[0])]
pub struct SizeIsBeyondIntegers;
const _: fn() = || stepped(SizeIsBeyondIntegers, SizeIsBeyondIntegersState { x: [1.0; 4], y: [0.0; 4] });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = name * x)]
pub struct FieldIsText {
    pub name: String,
}
const _: fn() = || stepped(FieldIsText { name: String::new() }, FieldIsTextState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = a * x + a * y)]
pub struct FieldIsOfAnotherType {
    pub a: Option<f64>,
}
const _: fn() = || stepped(FieldIsOfAnotherType { a: None }, FieldIsOfAnotherTypeState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = a[0] * x)]
pub struct FieldIsAnArrayOfAnotherType {
    pub a: [Option<f64>; 2],
}
const _: fn() =
    || stepped(FieldIsAnArrayOfAnotherType { a: [None; 2] }, FieldIsAnArrayOfAnotherTypeState { x: 1.0, y: 0.0 });

mod function_without_list {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = f(x), functions(f = sine))]
    pub struct System;
    const _: fn() = || stepped(System, SystemState { x: 1.0, y: 0.0 });
}

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = f(x), functions(f = [f, g, h], f = [f, g, h]))]
pub struct FunctionTwice;
const _: fn() = || stepped(FunctionTwice, FunctionTwiceState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = sum(x), functions(sum = [f, g, h]))]
pub struct FunctionOfTheTable;
const _: fn() = || stepped(FunctionOfTheTable, FunctionOfTheTableState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x, momenta(p = x, p = y))]
pub struct MomentumTwice;
const _: fn() = || stepped(MomentumTwice, MomentumTwiceState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x, momenta(p))]
pub struct MomentumWithoutFormula;
const _: fn() = || stepped(MomentumWithoutFormula, MomentumWithoutFormulaState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * y)]
pub struct TupleStruct(pub f64);
const _: fn() = || stepped(TupleStruct(1.0), TupleStructState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * y)]
pub enum Enumeration {
    One,
}
const _: fn() = || stepped(Enumeration::One, EnumerationState { x: 1.0, y: 0.0 });

mod function {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * y)]
    pub fn system() {}
    pub fn run() {
        system();
    }
}

fn main() {}
