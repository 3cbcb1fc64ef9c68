//! Indices, ranges and sums.

use dvi_core::prelude::*;

/// That a system with a mistake in it is taken for one that can be stepped.
fn stepped<S: DegenerateLagrangian>(system: S, state: S::State<f64>) {
    let _ = Integrator::new(&system, Sigma::midpoint(), 0.1, state);
}

macro_rules! of_four_pairs {
    ($name:ident $state:ident $({ $field:ident: $type:ty = $value:expr })?: $($arguments:tt)*) => {
        #[degenerate_lagrangian(
            coordinates(x[4], y[4]),
            one_form = sum(0..4, |j| x[j] * d(y[j])),
            $($arguments)*
        )]
        pub struct $name {
            $(pub $field: $type)?
        }
        const _: fn() = || stepped($name { $($field: $value)? }, $state { x: [1.0; 4], y: [0.0; 4] });
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

of_four_pairs! { ParameterArrayTooShort ParameterArrayTooShortState { a: [f64; 3] = [1.0; 3] }:
    hamiltonian = sum(0..4, |j| a[j] * x[j] * x[j]) + y[0]
}

of_four_pairs! { MatrixTooNarrow MatrixTooNarrowState { a: [[f64; 2]; 3] = [[1.0; 2]; 3] }:
    hamiltonian = a[0][2] * x[0] + y[0]
}

of_four_pairs! { OneIndexForAMatrix OneIndexForAMatrixState { a: [[f64; 2]; 3] = [[1.0; 2]; 3] }:
    hamiltonian = a[0] * x[0] + y[0]
}

of_four_pairs! { TwoIndicesForAList TwoIndicesForAListState { a: [f64; 3] = [1.0; 3] }:
    hamiltonian = a[0][1] * x[0] + y[0]
}

of_four_pairs! { IndexOutsideOfItsSum IndexOutsideOfItsSumState:
    hamiltonian = sum(0..4, |j| x[j] * x[j]) + y[j]
}

of_four_pairs! { IndexAsANumber IndexAsANumberState: hamiltonian = sum(0..4, |j| j * x[j]) + y[0] }
of_four_pairs! { NumberAsAnIndex NumberAsAnIndexState { a: f64 = 1.0 }: hamiltonian = x[1.0] + y[a] }
of_four_pairs! { MisspeltIndex MisspeltIndexState: hamiltonian = sum(0..4, |site| x[site] * y[sit]) }
of_four_pairs! { ArrayWithoutIndex ArrayWithoutIndexState: hamiltonian = x * x + y[0] }
of_four_pairs! { ParameterArrayWithoutIndex ParameterArrayWithoutIndexState { a: Vec<f64> = vec![1.0] }:
    hamiltonian = a * x[0] + y[0]
}

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x[0] + y)]
pub struct IndexOnASingleCoordinate;

of_four_pairs! { IndexOnASingleParameter IndexOnASingleParameterState { a: f64 = 1.0 }:
    hamiltonian = a[0] * x[0] + y[0]
}

of_four_pairs! { TwoIndicesForACoordinate TwoIndicesForACoordinateState: hamiltonian = x[0][1] + y[0] }
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
