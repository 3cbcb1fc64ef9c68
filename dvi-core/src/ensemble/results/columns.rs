//! The columns of the tables of results.

use std::boxed::Box;
use std::fmt;
use std::format;
use std::string::String;
use std::vec::Vec;

use crate::ensemble::member::{Member, Outcome};
use crate::ensemble::plan::Plan;

/// A column: its name, and what it says of a member.
///
/// Names of the state stand as they are; the others have a dot, which no name of a coordinate has.
pub(super) struct Column {
    pub(super) name: String,
    /// Its type in an array of NumPy, if it is written there.
    pub(super) kind: Option<&'static str>,
    cell: Box<dyn Fn(&Member) -> Cell<'_>>,
}

/// What a column says of a member.
pub(super) enum Cell<'a> {
    Number(f64),
    Count(u64),
    Outcome(&'a Outcome),
    Text(&'a str),
    /// There is no number.
    None,
}

impl Column {
    fn new(
        name: impl Into<String>,
        kind: Option<&'static str>,
        cell: impl Fn(&Member) -> Cell<'_> + 'static,
    ) -> Self {
        Self { name: name.into(), kind, cell: Box::new(cell) }
    }

    fn count(name: &str, of: impl Fn(&Member) -> u64 + 'static) -> Self {
        Self::new(name, Some("<u8"), move |member| Cell::Count(of(member)))
    }

    fn number(name: impl Into<String>, of: impl Fn(&Member) -> Option<f64> + 'static) -> Self {
        Self::new(name, Some("<f8"), move |member| of(member).map_or(Cell::None, Cell::Number))
    }

    pub(super) fn cell<'m>(&self, member: &'m Member) -> Cell<'m> {
        (self.cell)(member)
    }
}

impl fmt::Display for Cell<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            // As many digits as tell it from its neighbours.
            Self::Number(number) => write!(f, "{number:?}"),
            Self::Count(count) => write!(f, "{count}"),
            Self::Outcome(Outcome::Finished) => f.write_str("finished"),
            Self::Outcome(Outcome::Exited { .. }) => f.write_str("exited"),
            Self::Outcome(Outcome::Failed { .. }) => f.write_str("failed"),
            Self::Text(text) => f.write_str(text),
            Self::None => Ok(()),
        }
    }
}

/// All columns of the results of a plan.
pub(super) fn columns(plan: &Plan) -> Vec<Column> {
    let mut columns = Vec::from([
        Column::count("run.member", |member| member.number),
        Column::new("run.outcome", Some("|u1"), |member| Cell::Outcome(&member.outcome)),
        Column::new("run.reason", None, |member| match &member.outcome {
            Outcome::Finished => Cell::None,
            Outcome::Exited { reason } => Cell::Text(reason),
            Outcome::Failed { error } => Cell::Text(error),
        }),
        Column::number("run.time", |member| Some(member.time)),
        Column::count("run.steps", |member| member.steps),
        Column::count("run.iterations", |member| member.iterations),
        Column::number("energy.first", |member| Some(member.energy.first)),
        Column::number("energy.last", |member| Some(member.energy.last)),
        Column::number("energy.largest_error", |member| Some(member.energy.largest_error)),
    ]);
    for (place, name) in plan.momenta.iter().enumerate() {
        for (end, which) in ["first", "last"].into_iter().enumerate() {
            let value = move |member: &Member| member.momenta.get(place).map(|ends| ends[end]);
            columns.push(Column::number(format!("momentum.{name}.{which}"), value));
        }
    }
    if plan.has_exponents {
        columns.push(Column::number("run.exponent", |member| member.exponent));
    }
    if plan.has_section {
        columns.push(Column::count("run.crossings", |member| member.crossings));
    }
    for (place, name) in plan.names.iter().enumerate() {
        columns.push(Column::number(name.as_str(), move |member| member.state.get(place).copied()));
    }
    columns
}
