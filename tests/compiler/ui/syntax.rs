//! Rust that a formula cannot hold, each kind once.

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

degenerate! { Match MatchState: hamiltonian = match x { _ => y } }
degenerate! { Loop LoopState: hamiltonian = loop { x } }
degenerate! { For ForState: hamiltonian = x + for j in 0..4 { x } }
degenerate! { MacroCall MacroCallState: hamiltonian = x + square!(y) }
degenerate! { Closure ClosureState: hamiltonian = x + (|s| s * s) }
degenerate! { Reference ReferenceState: hamiltonian = x + &y }
degenerate! { Dereference DereferenceState: hamiltonian = x + *y }
degenerate! { Tuple TupleState: hamiltonian = x + (x, y) }
degenerate! { Remainder RemainderState: hamiltonian = x % y }
degenerate! { Caret CaretState: hamiltonian = x ^ 2 }
degenerate! { Equality EqualityState: hamiltonian = x == y }
degenerate! { Logic LogicState: hamiltonian = x && y }
degenerate! { BitOr BitOrState: hamiltonian = x | y }
degenerate! { StructLiteral StructLiteralState: hamiltonian = x + Point { x: x, y: y } }
degenerate! { QuestionMark QuestionMarkState: hamiltonian = x? + y }
degenerate! { Assignment AssignmentState: hamiltonian = x = y }
degenerate! { List ListState: hamiltonian = x + [x, y] }
degenerate! { Repeated RepeatedState: hamiltonian = x + [y; 2] }
degenerate! { Range RangeState: hamiltonian = x + (0..4) }
degenerate! { Return ReturnState: hamiltonian = return x }
degenerate! { Break BreakState: hamiltonian = break }
degenerate! { Unsafe UnsafeState: hamiltonian = x + unsafe { y } }
degenerate! { Async AsyncState: hamiltonian = x + async { y } }
degenerate! { Await AwaitState: hamiltonian = x.await + y }
degenerate! { Not NotState: hamiltonian = x + !y }
degenerate! { StringSystem StringSystemState: hamiltonian = x + "y" }
degenerate! { Boolean BooleanState: hamiltonian = x + true }
degenerate! { FieldOfField FieldOfFieldState: hamiltonian = x + y.re }
degenerate! { TupleField TupleFieldState: hamiltonian = x + y.0 }
degenerate! { MethodWithoutParentheses MethodWithoutParenthesesState: hamiltonian = x.sqrt + (x + y).sin }
degenerate! { Turbofish TurbofishState: hamiltonian = x + y.powi::<i32>(2) }
degenerate! { CallOfAClosure CallOfAClosureState: hamiltonian = (|s| s)(x) + y }
degenerate! { ConstBlock ConstBlockState: hamiltonian = x + const { 1.0 } }
degenerate! { LetCondition LetConditionState: hamiltonian = if let s = x { x } else { y } }
degenerate! { Infer InferState: hamiltonian = x + _ }
degenerate! { Qualified QualifiedState: hamiltonian = x + <f64 as Real>::ONE }
degenerate! { GenericCall GenericCallState: hamiltonian = sum::<f64>(0..4, |j| x) }
degenerate! { Suffix SuffixState: hamiltonian = 0.1_f32 * x + y }

fn main() {}
