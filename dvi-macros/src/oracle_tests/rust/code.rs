//! The tree that printed Rust is read into: names are resolved to slots.

use syn::BinOp;

use super::functions::Callee;
use super::value::{Kind, Value};

/// What a `let` binds: slots, or nothing for `_`.
#[derive(Clone, Debug)]
pub(super) enum Pattern {
    Slot(usize),
    Ignored,
    Tuple(Vec<Pattern>),
}

#[derive(Clone, Debug)]
pub(super) enum Code {
    Value(Value),
    Slot(usize),
    /// A const generic or another name that the environment knows.
    Named(String),
    Field(Box<Code>, String),
    Index(Box<Code>, Box<Code>),
    Negative(Box<Code>),
    Not(Box<Code>),
    Binary(BinOp, Box<Code>, Box<Code>),
    /// `place = value`, or `place ∘= value`.
    Assign(Option<BinOp>, Box<Code>, Box<Code>),
    Call(Callee, Vec<Code>),
    Method(Box<Code>, String, Vec<Code>),
    Cast(Box<Code>, Kind),
    Tuple(Vec<Code>),
    Block(Vec<Code>),
    Let(Pattern, Box<Code>),
    If(Box<Code>, Box<Code>, Option<Box<Code>>),
    /// Arms with the integer that they match, or `_`.
    Match(Box<Code>, Vec<(Option<i128>, Code)>),
    For(Pattern, Box<Code>, Box<Code>, Box<Code>),
    /// `__private::halves`: the number of bodies, their entries, and what is done for some pairs of a body.
    Halves(Box<Code>, Box<Code>, [Pattern; 3], Box<Code>),
    Return(Box<Code>),
    Continue,
    Try(Box<Code>),
}

#[derive(Clone, Debug)]
pub(super) struct Function {
    pub(super) parameters: usize,
    pub(super) slots: usize,
    pub(super) body: Code,
}

/// Sets the slots of a pattern.
pub(super) fn bind(pattern: &Pattern, value: Value, slots: &mut [Value]) {
    match (pattern, value) {
        (Pattern::Slot(slot), value) => slots[*slot] = value,
        (Pattern::Ignored, _) => {}
        (Pattern::Tuple(patterns), Value::Tuple(values)) => {
            patterns.iter().zip(values).for_each(|(pattern, value)| bind(pattern, value, slots));
        }
        (Pattern::Tuple(_), other) => panic!("{other:?} is no tuple"),
    }
}
