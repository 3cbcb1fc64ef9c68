//! Rust that a formula cannot hold, each kind once.

use dvi_core::prelude::*;

/// That a system with a mistake in it is taken for one that can be stepped.
fn stepped<S: DegenerateLagrangian>(system: S, state: S::State<f64>) {
    let _ = Integrator::new(&system, Sigma::midpoint(), 0.1, state);
}

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = match x { _ => y })]
pub struct Match;
const _: fn() = || stepped(Match, MatchState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = loop { x })]
pub struct Loop;
const _: fn() = || stepped(Loop, LoopState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + for j in 0..4 { x })]
pub struct For;
const _: fn() = || stepped(For, ForState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + square!(y))]
pub struct MacroCall;
const _: fn() = || stepped(MacroCall, MacroCallState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + (|s| s * s))]
pub struct Closure;
const _: fn() = || stepped(Closure, ClosureState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + &y)]
pub struct Reference;
const _: fn() = || stepped(Reference, ReferenceState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + *y)]
pub struct Dereference;
const _: fn() = || stepped(Dereference, DereferenceState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + (x, y))]
pub struct Tuple;
const _: fn() = || stepped(Tuple, TupleState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x % y)]
pub struct Remainder;
const _: fn() = || stepped(Remainder, RemainderState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x ^ 2)]
pub struct Caret;
const _: fn() = || stepped(Caret, CaretState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x == y)]
pub struct Equality;
const _: fn() = || stepped(Equality, EqualityState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x < y)]
pub struct Comparison;
const _: fn() = || stepped(Comparison, ComparisonState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x && y)]
pub struct Logic;
const _: fn() = || stepped(Logic, LogicState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x | y)]
pub struct BitOr;
const _: fn() = || stepped(BitOr, BitOrState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + Point { x: x, y: y })]
pub struct StructLiteral;
const _: fn() = || stepped(StructLiteral, StructLiteralState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x? + y)]
pub struct QuestionMark;
const _: fn() = || stepped(QuestionMark, QuestionMarkState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x = y)]
pub struct Assignment;
const _: fn() = || stepped(Assignment, AssignmentState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x += y)]
pub struct CompoundAssignment;
const _: fn() = || stepped(CompoundAssignment, CompoundAssignmentState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + [x, y])]
pub struct List;
const _: fn() = || stepped(List, ListState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + [y; 2])]
pub struct Repeated;
const _: fn() = || stepped(Repeated, RepeatedState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + (0..4))]
pub struct Range;
const _: fn() = || stepped(Range, RangeState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = return x)]
pub struct Return;
const _: fn() = || stepped(Return, ReturnState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = break)]
pub struct Break;
const _: fn() = || stepped(Break, BreakState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + unsafe { y })]
pub struct Unsafe;
const _: fn() = || stepped(Unsafe, UnsafeState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + async { y })]
pub struct Async;
const _: fn() = || stepped(Async, AsyncState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x.await + y)]
pub struct Await;
const _: fn() = || stepped(Await, AwaitState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + !y)]
pub struct Not;
const _: fn() = || stepped(Not, NotState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + "y")]
pub struct StringSystem;
const _: fn() = || stepped(StringSystem, StringSystemState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + true)]
pub struct Boolean;
const _: fn() = || stepped(Boolean, BooleanState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + 'y')]
pub struct Character;
const _: fn() = || stepped(Character, CharacterState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + y.re)]
pub struct FieldOfField;
const _: fn() = || stepped(FieldOfField, FieldOfFieldState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + y.0)]
pub struct TupleField;
const _: fn() = || stepped(TupleField, TupleFieldState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + y.powi::<i32>(2))]
pub struct Turbofish;
const _: fn() = || stepped(Turbofish, TurbofishState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = (|s| s)(x) + y)]
pub struct CallOfAClosure;
const _: fn() = || stepped(CallOfAClosure, CallOfAClosureState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + const { 1.0 })]
pub struct ConstBlock;
const _: fn() = || stepped(ConstBlock, ConstBlockState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = if let s = x { x } else { y })]
pub struct LetCondition;
const _: fn() = || stepped(LetCondition, LetConditionState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + _)]
pub struct Infer;
const _: fn() = || stepped(Infer, InferState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + <f64 as Real>::ONE)]
pub struct Qualified;
const _: fn() = || stepped(Qualified, QualifiedState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = sum::<f64>(0..4, |j| x))]
pub struct GenericCall;
const _: fn() = || stepped(GenericCall, GenericCallState { x: 1.0, y: 0.0 });

fn main() {}
