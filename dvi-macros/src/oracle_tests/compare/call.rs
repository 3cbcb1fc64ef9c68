//! A call of a generated function.

use super::super::rust::{Kind, Machine, Value};
use super::Difference;

/// A generated function about to be called: its arguments, and the slices that it writes to.
pub(super) struct Call<'a> {
    pub(super) machine: Machine<'a>,
    pub(super) arguments: Vec<Value>,
}

impl Call<'_> {
    pub(super) fn slice(mut self, entries: &[f64]) -> Self {
        let value = self.machine.array(entries.to_vec());
        self.arguments.push(value);
        self
    }

    pub(super) fn real(mut self, value: f64) -> Self {
        self.arguments.push(Value::Real(value));
        self
    }

    pub(super) fn index(mut self, value: usize) -> Self {
        self.arguments.push(Value::Integer(value as i128, Kind::Usize));
        self
    }

    /// Its value and all slices after the call.
    pub(super) fn run(mut self, name: &str) -> Result<(Value, Vec<Vec<f64>>), Difference> {
        let value = self.machine.call(name, self.arguments);
        value.map(|value| (value, self.machine.arrays)).map_err(|reason| (name.to_string(), reason))
    }

    pub(super) fn number(self, name: &str) -> Result<f64, Difference> {
        self.run(name).map(|(value, _)| value.real())
    }
}
