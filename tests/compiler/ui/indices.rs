//! Indices, ranges and sums.

use dvi_core::prelude::*;

/// That a system with a mistake in it is taken for one that can be stepped.
fn stepped<S: DegenerateLagrangian>(system: S, state: S::State<f64>) {
    let _ = Integrator::new(&system, Sigma::midpoint(), 0.1, state);
}

macro_rules! of_four_pairs {
    ($name:ident $state:ident: $($arguments:tt)*) => {
        #[degenerate_lagrangian(
            coordinates(x[4], y[4]),
            one_form = sum(0..4, |j| x[j] * d(y[j])),
            $($arguments)*
        )]
        pub struct $name;
        const _: fn() = || stepped($name, $state { x: [1.0; 4], y: [0.0; 4] });
    };
}

of_four_pairs! { LiteralIndex LiteralIndexState: hamiltonian = x[0] * x[4] + y[0] }
of_four_pairs! { NegativeIndex NegativeIndexState: hamiltonian = x[-1] + y[0] }
of_four_pairs! { HugeIndex HugeIndexState: hamiltonian = x[18446744073709551615] + y[0] }
of_four_pairs! { NeighbourOfTheLast NeighbourOfTheLastState:
    hamiltonian = sum(0..4, |j| (x[j + 1] - x[j]).powi(2))
}

of_four_pairs! { NeighbourOfTheFirst NeighbourOfTheFirstState:
    hamiltonian = sum(0..=3, |j| x[j - 1] * x[j])
}

#[degenerate_lagrangian(
    coordinates(x[4], y[4]),
    one_form = sum(0..4, |j| x[j] * d(y[j])),
    hamiltonian = sum(0..4, |j| a[j] * x[j] * x[j]) + y[0],
)]
pub struct ParameterArrayTooShort {
    pub a: [f64; 3],
}
const _: fn() =
    || stepped(ParameterArrayTooShort { a: [1.0; 3] }, ParameterArrayTooShortState { x: [1.0; 4], y: [0.0; 4] });

#[degenerate_lagrangian(
    coordinates(x[4], y[4]),
    one_form = sum(0..4, |j| x[j] * d(y[j])),
    hamiltonian = a[0][2] * x[0] + y[0],
)]
pub struct MatrixTooNarrow {
    pub a: [[f64; 2]; 3],
}
const _: fn() =
    || stepped(MatrixTooNarrow { a: [[1.0; 2]; 3] }, MatrixTooNarrowState { x: [1.0; 4], y: [0.0; 4] });

#[degenerate_lagrangian(
    coordinates(x[4], y[4]),
    one_form = sum(0..4, |j| x[j] * d(y[j])),
    hamiltonian = a[0] * x[0] + y[0],
)]
pub struct OneIndexForAMatrix {
    pub a: [[f64; 2]; 3],
}
const _: fn() =
    || stepped(OneIndexForAMatrix { a: [[1.0; 2]; 3] }, OneIndexForAMatrixState { x: [1.0; 4], y: [0.0; 4] });

#[degenerate_lagrangian(
    coordinates(x[4], y[4]),
    one_form = sum(0..4, |j| x[j] * d(y[j])),
    hamiltonian = a[0][1] * x[0] + y[0],
)]
pub struct TwoIndicesForAList {
    pub a: [f64; 3],
}
const _: fn() =
    || stepped(TwoIndicesForAList { a: [1.0; 3] }, TwoIndicesForAListState { x: [1.0; 4], y: [0.0; 4] });

of_four_pairs! { IndexOutsideOfItsSum IndexOutsideOfItsSumState:
    hamiltonian = sum(0..4, |j| x[j] * x[j]) + y[j]
}

of_four_pairs! { IndexAsANumber IndexAsANumberState: hamiltonian = sum(0..4, |j| j * x[j]) + y[0] }

#[degenerate_lagrangian(
    coordinates(x[4], y[4]),
    one_form = sum(0..4, |j| x[j] * d(y[j])),
    hamiltonian = x[1.0] + y[a],
)]
pub struct NumberAsAnIndex {
    pub a: f64,
}
const _: fn() = || stepped(NumberAsAnIndex { a: 1.0 }, NumberAsAnIndexState { x: [1.0; 4], y: [0.0; 4] });

of_four_pairs! { MisspeltIndex MisspeltIndexState: hamiltonian = sum(0..4, |site| x[site] * y[sit]) }
of_four_pairs! { ArrayWithoutIndex ArrayWithoutIndexState: hamiltonian = x * x + y[0] }

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = a * x + y)]
pub struct ParameterArrayWithoutIndex {
    pub a: Vec<f64>,
}
const _: fn() =
    || stepped(ParameterArrayWithoutIndex { a: vec![1.0] }, ParameterArrayWithoutIndexState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x[0] + y)]
pub struct IndexOnASingleCoordinate;
const _: fn() = || stepped(IndexOnASingleCoordinate, IndexOnASingleCoordinateState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = a[0] * x + y)]
pub struct IndexOnASingleParameter {
    pub a: f64,
}
const _: fn() =
    || stepped(IndexOnASingleParameter { a: 1.0 }, IndexOnASingleParameterState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(
    coordinates(x[4], y[4]),
    one_form = sum(0..4, |j| x[j] * d(y[j])),
    hamiltonian = x[0][1] + y[0],
)]
pub struct TwoIndicesForACoordinate;
const _: fn() =
    || stepped(TwoIndicesForACoordinate, TwoIndicesForACoordinateState { x: [1.0; 4], y: [0.0; 4] });

of_four_pairs! { IndexOfAnExpression IndexOfAnExpressionState: hamiltonian = (x[0] + y[0])[0] }
of_four_pairs! { ProductOfIndices ProductOfIndicesState:
    hamiltonian = sum_pairs(0..2, |j, k| x[j * k] * y[j])
}

of_four_pairs! { QuotientOfIndices QuotientOfIndicesState: hamiltonian = sum(0..4, |j| x[j / 2] * y[j]) }
of_four_pairs! { RemainderByZero RemainderByZeroState: hamiltonian = sum(0..4, |j| x[j % 0] * y[j]) }
of_four_pairs! { RangeWithoutEnd RangeWithoutEndState: hamiltonian = sum(0.., |j| x[j] * y[j]) }
of_four_pairs! { RangeThatIsNone RangeThatIsNoneState: hamiltonian = sum(4, |j| x[j] * y[j]) }
of_four_pairs! { SumWithoutClosure SumWithoutClosureState: hamiltonian = sum(0..4, x[0] * y[0]) }
of_four_pairs! { SumOverTwoIndices SumOverTwoIndicesState: hamiltonian = sum(0..4, |j, k| x[j] * y[k]) }
of_four_pairs! { PairsOverOneIndex PairsOverOneIndexState: hamiltonian = sum_pairs(0..4, |j| x[j] * y[j]) }
of_four_pairs! { IndexThatIsAPattern IndexThatIsAPatternState:
    hamiltonian = sum(0..4, |(j, k)| x[j] * y[j])
}

of_four_pairs! { RangeThatIsEmpty RangeThatIsEmptyState: hamiltonian = sum(4..0, |j| x[j] * y[j]) + x[0] }
of_four_pairs! { CastToAnInteger CastToAnIntegerState: hamiltonian = sum(0..4, |j| j as u32 * x[j]) + y[0] }

#[lagrangian(
    coordinates(q[n][n]),
    lagrangian = sum(0..n, |i| sum(0..n, |j| dot(q[i][j]).powi(2))) / 2.0
        - sum_pairs(0..n, |i, i| q[i][0] * q[0][i]),
    force(q) = |j, j| -q[j][j],
)]
pub struct TwoIndicesWithOneName {
    pub n: usize,
}

fn main() {}
