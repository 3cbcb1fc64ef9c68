//! Blocks and choices.

use dvi_core::prelude::*;

/// That a system with a mistake in it is taken for one that can be stepped.
fn stepped<S: DegenerateLagrangian>(system: S, state: S::State<f64>) {
    let _ = Integrator::new(&system, Sigma::midpoint(), 0.1, state);
}

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = if x < y { x })]
pub struct IfWithoutElse;
const _: fn() = || stepped(IfWithoutElse, IfWithoutElseState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = if x < y { x } else if y < x { y })]
pub struct ElseIfWithoutElse;
const _: fn() = || stepped(ElseIfWithoutElse, ElseIfWithoutElseState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = { let r = x * x; })]
pub struct BlockWithoutValue;
const _: fn() = || stepped(BlockWithoutValue, BlockWithoutValueState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x + {})]
pub struct EmptyBlock;
const _: fn() = || stepped(EmptyBlock, EmptyBlockState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = { let r = x * x; r.sqrt(); r })]
pub struct StatementInABlock;
const _: fn() = || stepped(StatementInABlock, StatementInABlockState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = { let r; x })]
pub struct LetWithoutValue;
const _: fn() = || stepped(LetWithoutValue, LetWithoutValueState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = { let r = x else { y }; r })]
pub struct LetElse;
const _: fn() = || stepped(LetElse, LetElseState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = { let (a, b) = x; y })]
pub struct TuplePattern;
const _: fn() = || stepped(TuplePattern, TuplePatternState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = { fn f() {} x })]
pub struct ItemInABlock;
const _: fn() = || stepped(ItemInABlock, ItemInABlockState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = if x == 0.0 { x } else { y })]
pub struct ConditionThatIsEqual;
const _: fn() = || stepped(ConditionThatIsEqual, ConditionThatIsEqualState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = if x { x } else { y })]
pub struct ConditionThatIsANumber;
const _: fn() = || stepped(ConditionThatIsANumber, ConditionThatIsANumberState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = { let a = { let b = x; b }; a + b })]
pub struct ValueUsedAfterItsBlock;
const _: fn() = || stepped(ValueUsedAfterItsBlock, ValueUsedAfterItsBlockState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = { let unused = z; x * y })]
pub struct UnusedAndWrong;
const _: fn() = || stepped(UnusedAndWrong, UnusedAndWrongState { x: 1.0, y: 0.0 });

fn main() {}
