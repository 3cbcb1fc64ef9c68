//! Literals and the names of types to values.

use quote::ToTokens;
use syn::{Lit, Pat, Type};

use super::parse::unknown;
use super::value::{Kind, Value};

pub(super) fn kind(ty: &Type) -> Kind {
    match ty.to_token_stream().to_string().trim_start_matches(":: core :: primitive :: ") {
        "usize" => Kind::Usize,
        "i64" | "i128" => Kind::I64,
        "i32" => Kind::I32,
        "f64" => Kind::F64,
        _ => unknown("type", ty),
    }
}

pub(super) fn literal_value(literal: &Lit) -> Value {
    match literal {
        Lit::Int(value) => {
            let kind = match value.suffix() {
                "usize" => Kind::Usize,
                "i64" | "i128" => Kind::I64,
                "i32" => Kind::I32,
                "" => Kind::Open,
                "f64" => return Value::Real(value.base10_parse().expect("a number")),
                _ => unknown("literal", value),
            };
            Value::Integer(value.base10_parse().expect("an integer"), kind)
        }
        Lit::Float(value) => Value::Real(value.base10_digits().parse().expect("a number")),
        Lit::Str(text) => Value::Text(text.value()),
        Lit::Bool(value) => Value::Bool(value.value),
        other => unknown("literal", other),
    }
}

pub(super) fn arm_value(pattern: &Pat) -> Option<i128> {
    match pattern {
        Pat::Wild(_) => None,
        Pat::Lit(literal) => match literal_value(&literal.lit) {
            Value::Integer(value, _) => Some(value),
            _ => unknown("pattern", pattern),
        },
        other => unknown("pattern", other),
    }
}
