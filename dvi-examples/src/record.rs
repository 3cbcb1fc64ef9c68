//! What the runs of a folder have found, in a table that programs can read and later runs complete.
//!
//! A part is one experiment: the form and the time of its run, how it ended, and every number that its
//! verdicts rest on. A run replaces the parts of its own experiments and keeps the others.

use std::fs;
use std::io::ErrorKind;
use std::path::Path;

use anyhow::{Context as _, Result, bail, ensure};

use crate::claim::{Bound, Check, Claim};
use crate::gallery::Outcome;
use crate::job::Length;
use crate::output::{Table, number};

/// The name of the table, without its extension.
const NAME: &str = "summary";

/// One experiment, as it was run last.
#[derive(Clone, Debug)]
pub struct Part {
    pub experiment: String,
    pub length: Length,
    /// When the run ended, in words.
    pub when: String,
    pub state: State,
    pub outcome: Outcome,
}

/// How the run of a part ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum State {
    Complete,
    Interrupted,
    /// Asked for, but the run was interrupted before.
    NotStarted,
    /// With the words of the error.
    Failed(String),
}

/// The parts of earlier runs, those of the same experiments replaced by the new ones, in the order of
/// `names`. What did not start replaces nothing.
pub fn merged(old: Vec<Part>, new: Vec<Part>, names: &[&str]) -> Vec<Part> {
    let mut parts = Vec::new();
    for name in names {
        let of = |parts: &[Part]| parts.iter().find(|part| part.experiment == *name).cloned();
        let started = of(&new).filter(|part| part.state != State::NotStarted);
        parts.extend(started.or_else(|| of(&old)).or_else(|| of(&new)));
    }
    parts
}

/// A row of the table; the columns that a kind of row does not use are empty.
#[derive(Clone, Debug, Default, PartialEq)]
struct Row {
    /// `complete`, `interrupted`, `not started` or `failed` begin a part; `claim`, `check`, `instead`,
    /// `reference` and `note`.
    kind: String,
    place: String,
    text: String,
    value: String,
    bound: String,
    low: String,
    high: String,
    /// The verdict of a claim, `passes` or `fails` of a check: for readers, and computed again when read.
    verdict: String,
}

const COLUMNS: [&str; 11] =
    ["experiment", "form", "when", "row", "place", "text", "value", "bound", "low", "high", "verdict"];

impl Row {
    fn new(kind: &str, text: &str) -> Self {
        Self { kind: kind.into(), text: text.into(), ..Self::default() }
    }

    fn check(kind: &str, check: &Check) -> Self {
        let (bound, low, high) = match check.bound {
            Bound::AtMost(high) => ("at most", None, Some(high)),
            Bound::AtLeast(low) => ("at least", Some(low), None),
            Bound::Within(low, high) => ("within", Some(low), Some(high)),
            Bound::Near(target, tolerance) => ("near", Some(target), Some(tolerance)),
        };
        let text = |value: Option<f64>| value.map(number).unwrap_or_default();
        let verdict = check.value.map(|_| if check.passes() { "passes" } else { "fails" });
        Self {
            value: text(check.value),
            bound: bound.into(),
            low: text(low),
            high: text(high),
            verdict: verdict.unwrap_or("not measured").into(),
            ..Self::new(kind, &check.quantity)
        }
    }

    fn to_check(&self) -> Result<Check> {
        let parse = |text: &str| text.parse::<f64>().with_context(|| format!("`{text}` is not a number"));
        let bound = match self.bound.as_str() {
            "at most" => Bound::AtMost(parse(&self.high)?),
            "at least" => Bound::AtLeast(parse(&self.low)?),
            "within" => Bound::Within(parse(&self.low)?, parse(&self.high)?),
            "near" => Bound::Near(parse(&self.low)?, parse(&self.high)?),
            other => bail!("`{other}` is not a bound"),
        };
        let value = if self.value.is_empty() { None } else { Some(parse(&self.value)?) };
        Ok(Check::new(&self.text, value, bound))
    }
}

/// The rows of a part: how it ended, its claims with their checks, reference values, notes.
fn rows(part: &Part) -> Vec<Row> {
    let mut rows = vec![match &part.state {
        State::Complete => Row::new("complete", ""),
        State::Interrupted => Row::new("interrupted", ""),
        State::NotStarted => Row::new("not started", ""),
        State::Failed(words) => Row::new("failed", words),
    }];
    let Outcome { claims, references, notes } = &part.outcome;
    for claim in claims {
        let Claim { place, says, printed, instead, .. } = claim;
        let verdict = if part.state == State::Complete { claim.judgement() } else { String::new() };
        rows.push(Row { place: place.clone(), verdict, ..Row::new("claim", says) });
        rows.extend(printed.iter().map(|check| Row::check("check", check)));
        if let Some((text, checks)) = instead {
            rows.push(Row::new("instead", text));
            rows.extend(checks.iter().map(|check| Row::check("check", check)));
        }
    }
    rows.extend(references.iter().map(|check| Row::check("reference", check)));
    rows.extend(notes.iter().map(|note| Row::new("note", note)));
    rows
}

/// Writes the table of the parts into the folder.
pub fn save(folder: &Path, parts: &[Part]) -> Result<()> {
    let mut table = Table::new(&COLUMNS)?;
    for part in parts {
        for row in rows(part) {
            let Row { kind, place, text, value, bound, low, high, verdict } = row;
            let head = [part.experiment.clone(), part.length.name().into(), part.when.clone()];
            table.row(head.into_iter().chain([kind, place, text, value, bound, low, high, verdict]))?;
        }
    }
    table.save(folder, NAME)
}

/// The parts that earlier runs have left in the folder.
///
/// # Errors
/// A table of that name which is not one of these.
pub fn load(folder: &Path) -> Result<Vec<Part>> {
    let path = folder.join(format!("{NAME}.csv"));
    let text = match fs::read_to_string(&path) {
        Ok(text) => text,
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Vec::new()),
        Err(error) => return Err(error).with_context(|| format!("cannot read {}", path.display())),
    };
    parse(&text).with_context(|| {
        format!("{} is not a summary of this program; remove it or choose another folder", path.display())
    })
}

fn parse(text: &str) -> Result<Vec<Part>> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    ensure!(reader.headers()?.iter().eq(COLUMNS), "its columns are others");
    let mut parts: Vec<Part> = Vec::new();
    for record in reader.records() {
        let record = record?;
        let cell = |i: usize| record.get(i).unwrap_or_default().to_owned();
        let row = Row {
            kind: cell(3),
            place: cell(4),
            text: cell(5),
            value: cell(6),
            bound: cell(7),
            low: cell(8),
            high: cell(9),
            verdict: cell(10),
        };
        let state = match row.kind.as_str() {
            "complete" => Some(State::Complete),
            "interrupted" => Some(State::Interrupted),
            "not started" => Some(State::NotStarted),
            "failed" => Some(State::Failed(row.text.clone())),
            _ => None,
        };
        if let Some(state) = state {
            let length = Length::named(&cell(1)).with_context(|| format!("`{}` is not a form", cell(1)))?;
            let outcome = Outcome::default();
            parts.push(Part { experiment: cell(0), length, when: cell(2), state, outcome });
            continue;
        }
        add(&mut parts.last_mut().context("it does not begin with a part")?.outcome, &row)?;
    }
    Ok(parts)
}

fn add(outcome: &mut Outcome, row: &Row) -> Result<()> {
    let last = || "a row without its claim";
    match row.kind.as_str() {
        "claim" => outcome.claims.push(Claim::new(&row.place, &row.text)),
        "instead" => {
            outcome.claims.last_mut().with_context(last)?.instead = Some((row.text.clone(), Vec::new()));
        }
        "check" => {
            let claim = outcome.claims.last_mut().with_context(last)?;
            let list = claim.instead.as_mut().map_or(&mut claim.printed, |(_, checks)| checks);
            list.push(row.to_check()?);
        }
        "reference" => outcome.references.push(row.to_check()?),
        "note" => outcome.notes.push(row.text.clone()),
        other => bail!("`{other}` is not a row"),
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn part(experiment: &str, length: Length, value: Option<f64>) -> Part {
        let claim = Claim::new("p. 1", "it is \"one\", says it")
            .check("it", value, Bound::Near(1.0, 1e-15))
            .instead("it is two")
            .check("it", value, Bound::Within(1.5, 2.5));
        let references = vec![Check::new("it", value, Bound::AtMost(3.0))];
        let outcome = Outcome { claims: vec![claim], references, notes: vec!["A note.".into()] };
        let (experiment, when) = (experiment.to_owned(), "today".to_owned());
        Part { experiment, length, when, state: State::Complete, outcome }
    }

    #[test]
    fn what_is_written_is_read_again() -> Result<()> {
        let folder = tempfile::tempdir()?;
        let failed = Part { state: State::Failed("no ink".into()), ..part("c", Length::Full, None) };
        let parts = [part("a", Length::Full, Some(2.0)), part("b", Length::Short, None), failed];
        save(folder.path(), &parts)?;
        let read = load(folder.path())?;
        assert_eq!(read.len(), 3);
        for (one, other) in parts.iter().zip(&read) {
            assert_eq!(rows(one), rows(other));
            assert_eq!(
                (&one.experiment, one.length, &one.when),
                (&other.experiment, other.length, &other.when)
            );
        }
        Ok(())
    }

    #[test]
    fn a_run_replaces_its_own_parts_and_keeps_the_others() {
        let old = vec![part("a", Length::Full, Some(1.0)), part("b", Length::Full, Some(1.0))];
        let parts = merged(old, vec![part("b", Length::Short, None)], &["b", "a", "c"]);
        let shown: Vec<_> = parts.iter().map(|part| (part.experiment.as_str(), part.length)).collect();
        assert_eq!(shown, [("b", Length::Short), ("a", Length::Full)]);
        let idle = |name| Part { state: State::NotStarted, ..part(name, Length::Short, None) };
        let parts = merged(parts, vec![idle("a"), idle("c")], &["b", "a", "c"]);
        let shown: Vec<_> = parts.into_iter().map(|part| part.state).collect();
        assert_eq!(shown, [State::Complete, State::Complete, State::NotStarted]);
    }

    #[test]
    fn a_table_of_somebody_else_is_refused() {
        assert!(parse("a,b\n1,2\n").is_err());
        assert!(parse(&format!("{}\na,full,now,check,,,1,at most,,2,\n", COLUMNS.join(","))).is_err());
    }
}
