//! The functions of `__private` that generated code calls for indices, checks and loops.

use super::run::{Jump, Machine, Step, panicked};
use super::value::{Kind, Value};

impl Machine<'_> {
    pub(super) fn library(&mut self, name: &str, arguments: &[Value]) -> Step {
        let integer = |n: usize| arguments[n].integer();
        let size = |value: i128| Ok::<_, Jump>(Value::Integer(value, Kind::Usize));
        match name {
            "wrap" | "remainder" => {
                let kind = if name == "wrap" { Kind::Usize } else { Kind::I64 };
                let remainder = integer(0).checked_rem_euclid(integer(1));
                let remainder = remainder.ok_or_else(|| panicked("a remainder by zero"))?;
                Ok(Value::Integer(remainder, kind))
            }
            "members_before" => {
                size((0..integer(2)).map(|row| (integer(0) + integer(1) * row).max(0)).sum())
            }
            // Chunks of two, so that short loops have some.
            "whole" => size(integer(1) - (integer(1) - integer(0)).max(0) % 2),
            "first_unturned" => size(integer(0).max(integer(2)).min(integer(1))),
            "past_unturned" => size((integer(1) - integer(2)).max(integer(0))),
            "Waiting" => {
                let Value::Tuple(terms) = &arguments[0] else { panic!("a list of terms") };
                Ok(self.array(terms.iter().map(Value::real).collect()))
            }
            // Few enough that both ways are taken.
            "are_many" => Ok(Value::Bool(integer(0) >= 3)),
            // Sizes of the tests are small.
            "check_sizes" => Ok(Value::Unit),
            "check_index" | "check_indices" => {
                let length = arguments[arguments.len() - 1].integer();
                let past = if name == "check_indices" { integer(2) } else { integer(1) + 1 };
                let outside = (integer(1)..past).find(|index| !(0..length).contains(index));
                Ok(outside.map_or(Value::Unit, |index| {
                    let Value::Text(array) = &arguments[0] else { panic!("an array has a name") };
                    Value::Failure(format!("index {index} of `{array}`, of length {length}"))
                }))
            }
            other => panic!("the interpreter does not know the function __private::{other}"),
        }
    }
}
