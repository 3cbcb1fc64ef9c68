//! Blocks and choices.

use dvi_core::prelude::*;

/// That a system with a mistake in it is taken for one that can be stepped.
fn stepped<S: DegenerateLagrangian>(system: S, state: S::State<f64>) {
    let _ = Integrator::new(&system, Sigma::midpoint(), 0.1, state);
}

macro_rules! degenerate {
    ($name:ident $state:ident: $($arguments:tt)*) => {
        #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), $($arguments)*)]
        pub struct $name;
        const _: fn() = || stepped($name, $state { x: 1.0, y: 0.0 });
    };
}

degenerate! { IfWithoutElse IfWithoutElseState: hamiltonian = if x < y { x } }
degenerate! { ElseIfWithoutElse ElseIfWithoutElseState: hamiltonian = if x < y { x } else if y < x { y } }
degenerate! { BlockWithoutValue BlockWithoutValueState: hamiltonian = { let r = x * x; } }
degenerate! { EmptyBlock EmptyBlockState: hamiltonian = x + {} }
degenerate! { StatementInABlock StatementInABlockState: hamiltonian = { let r = x * x; r.sqrt(); r } }
degenerate! { LetWithoutValue LetWithoutValueState: hamiltonian = { let r; x } }
degenerate! { LetElse LetElseState: hamiltonian = { let r = x else { y }; r } }
degenerate! { TuplePattern TuplePatternState: hamiltonian = { let (a, b) = x; y } }
degenerate! { ItemInABlock ItemInABlockState: hamiltonian = { fn f() {} x } }
degenerate! { ConditionThatIsEqual ConditionThatIsEqualState: hamiltonian = if x == 0.0 { x } else { y } }
degenerate! { ConditionThatIsANumber ConditionThatIsANumberState: hamiltonian = if x { x } else { y } }
degenerate! { ValueUsedAfterItsBlock ValueUsedAfterItsBlockState:
    hamiltonian = { let a = { let b = x; b }; a + b }
}

degenerate! { UnusedAndWrong UnusedAndWrongState: hamiltonian = { let unused = z; x * y } }
degenerate! { EqualIndex EqualIndexState: hamiltonian = sum(0..3, |i| if i == 1 { x } else { y }) }

#[lagrangian(coordinates(x), lagrangian = { let (a, a) = x.sin_cos(); dot(x).powi(2) - a })]
pub struct OneNameForTwo;

fn main() {}
