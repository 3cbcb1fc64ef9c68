//! The arithmetic of numbers and integers, which overflow where those of Rust do.

use quote::ToTokens as _;
use syn::BinOp;

use super::parse::unknown;
use super::run::{Jump, panicked};
use super::value::{Kind, Value};

pub(super) fn kind_of(value: &Value) -> Kind {
    match value {
        Value::Integer(_, kind) => *kind,
        _ => Kind::Usize,
    }
}

pub(super) fn cast(value: &Value, kind: Kind) -> Value {
    if kind == Kind::F64 {
        return Value::Real(match value {
            Value::Real(value) => *value,
            other => other.integer() as f64,
        });
    }
    let value = value.integer();
    let turn = if kind == Kind::I32 { 1_i128 << 32 } else { 1_i128 << 64 };
    let least = if kind == Kind::Usize { 0 } else { -turn / 2 };
    Value::Integer((value - least).rem_euclid(turn) + least, kind)
}

pub(super) fn operation(operator: BinOp, left: Value, right: Value) -> Result<Value, Jump> {
    let value = match (left, right) {
        (Value::Real(a), Value::Real(b)) => match operator {
            BinOp::Add(_) => Value::Real(a + b),
            BinOp::Sub(_) => Value::Real(a - b),
            BinOp::Mul(_) => Value::Real(a * b),
            BinOp::Div(_) => Value::Real(a / b),
            relation => Value::Bool(related(relation, &a, &b)),
        },
        (left, right) => {
            let kind = kind_of(&left).joined(kind_of(&right));
            let (a, b) = (left.integer(), right.integer());
            let value = match operator {
                BinOp::Add(_) => a + b,
                BinOp::Sub(_) => a - b,
                BinOp::Mul(_) => a * b,
                BinOp::Div(_) | BinOp::Rem(_) if b == 0 => return Err(panicked("a division by zero")),
                BinOp::Div(_) => a / b,
                BinOp::Rem(_) => a % b,
                relation => return Ok(Value::Bool(related(relation, &a, &b))),
            };
            if !kind.holds(value) {
                return Err(panicked(format!("{a} {} {b} overflows {kind:?}", operator.to_token_stream())));
            }
            Value::Integer(value, kind)
        }
    };
    Ok(value)
}

fn related<V: PartialOrd>(relation: BinOp, a: &V, b: &V) -> bool {
    match relation {
        BinOp::Eq(_) => a == b,
        BinOp::Ne(_) => a != b,
        BinOp::Lt(_) => a < b,
        BinOp::Le(_) => a <= b,
        BinOp::Gt(_) => a > b,
        BinOp::Ge(_) => a >= b,
        other => unknown("operator", &other),
    }
}

pub(super) fn integer_method(
    name: &str,
    kind: Kind,
    value: i128,
    other: Option<i128>,
) -> Result<i128, Jump> {
    let other = other.unwrap_or_else(|| panic!("`{name}` of an integer takes an argument"));
    let (least, turn) = match kind {
        Kind::Usize => (0, 1_i128 << 64),
        _ => (i128::from(i64::MIN), 1_i128 << 64),
    };
    Ok(match name {
        "wrapping_sub" => (value - other - least).rem_euclid(turn) + least,
        "wrapping_add" => (value + other - least).rem_euclid(turn) + least,
        "saturating_sub" => (value - other).max(least),
        "saturating_add" => (value + other).min(least + turn - 1),
        "saturating_mul" => (value * other).min(least + turn - 1),
        "max" => value.max(other),
        "min" => value.min(other),
        "rem_euclid" => value.checked_rem_euclid(other).ok_or_else(|| panicked("a remainder by zero"))?,
        _ => panic!("the interpreter does not know the method `{name}` of an integer"),
    })
}
