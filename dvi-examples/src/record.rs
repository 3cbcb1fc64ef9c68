//! What the runs of a folder have found, in a table that programs can read and later runs complete.
//!
//! A part is one experiment: the form and the time of its run, how it ended, and every number that its
//! verdicts rest on. A run replaces the parts of its own experiments and keeps the others.

use std::fs;
use std::io::ErrorKind;
use std::path::Path;

use anyhow::{Context as _, Result, bail};
use serde::{Deserialize, Serialize, Serializer};

use crate::claim::{Bound, Check, Claim, says};
use crate::gallery::Outcome;
use crate::job::Length;
use crate::output::{number, write_whole};

const NAME: &str = "summary.csv";

/// One experiment, as it was run last.
#[derive(Clone, Debug)]
pub struct Part {
    pub experiment: String,
    pub length: Length,
    /// When the run ended, in words.
    pub when: String,
    /// What it has to say, or the words of the error that has ended it.
    pub outcome: Result<Outcome, String>,
}

/// Puts a part in the place of that of an earlier run, in the order of `names`; what has another name goes.
pub fn put(parts: &mut Vec<Part>, new: Part, names: &[&str]) {
    let place = |part: &Part| names.iter().position(|name| *name == part.experiment);
    parts.retain(|old| old.experiment != new.experiment && place(old).is_some());
    parts.push(new);
    parts.sort_by_key(place);
}

/// A row of the table; the columns that a kind of row does not use are empty.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Row {
    experiment: String,
    form: Length,
    when: String,
    row: Kind,
    place: String,
    text: String,
    #[serde(serialize_with = "digits")]
    value: Option<f64>,
    bound: String,
    #[serde(serialize_with = "digits")]
    low: Option<f64>,
    #[serde(serialize_with = "digits")]
    high: Option<f64>,
    /// That of a claim or a check: for readers, and computed again when read.
    verdict: String,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Kind {
    /// Begins a part, as `Failed` does.
    Complete,
    Failed,
    Claim,
    Check,
    Instead,
    Reference,
    Note,
}

/// As tables have numbers.
fn digits<S: Serializer>(value: &Option<f64>, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(&value.map(number).unwrap_or_default())
}

impl Row {
    fn new(part: &Part, row: Kind, text: &str) -> Self {
        let [place, bound, verdict] = [const { String::new() }; 3];
        let (experiment, when, text) = (part.experiment.clone(), part.when.clone(), text.to_owned());
        let (form, value, low, high) = (part.length, None, None, None);
        Self { experiment, form, when, row, place, text, value, bound, low, high, verdict }
    }

    fn check(part: &Part, row: Kind, check: &Check) -> Self {
        let (bound, low, high) = match check.bound {
            Bound::AtMost(high) => ("at most", None, Some(high)),
            Bound::AtLeast(low) => ("at least", Some(low), None),
            Bound::Within(low, high) => ("within", Some(low), Some(high)),
            Bound::Near(target, tolerance) => ("near", Some(target), Some(tolerance)),
        };
        let (bound, verdict) = (bound.to_owned(), check.verdict().to_owned());
        Self { value: check.value, bound, low, high, verdict, ..Self::new(part, row, &check.quantity) }
    }

    fn to_check(&self) -> Result<Check> {
        let bound = match (self.bound.as_str(), self.low, self.high) {
            ("at most", None, Some(high)) => Bound::AtMost(high),
            ("at least", Some(low), None) => Bound::AtLeast(low),
            ("within", Some(low), Some(high)) => Bound::Within(low, high),
            ("near", Some(target), Some(tolerance)) => Bound::Near(target, tolerance),
            (other, ..) => bail!("`{other}` is not a bound with its numbers"),
        };
        Ok(Check::new(&self.text, self.value, bound))
    }
}

/// The rows of a part: how it ended, its claims with their checks, reference values, notes.
fn rows(part: &Part) -> Vec<Row> {
    let outcome = match &part.outcome {
        Ok(outcome) => outcome,
        Err(words) => return vec![Row::new(part, Kind::Failed, words)],
    };
    let mut rows = vec![Row::new(part, Kind::Complete, "")];
    let checks = |kind, checks: &[Check]| -> Vec<Row> {
        checks.iter().map(|check| Row::check(part, kind, check)).collect()
    };
    for claim in &outcome.claims {
        let (place, verdict) = (claim.place.clone(), claim.verdict());
        let verdict = match claim.differs() {
            Some(instead) => format!("{verdict}: {instead}"),
            None if verdict == "undecided" => "undecided: needs the full run".to_owned(),
            None => verdict.to_owned(),
        };
        rows.push(Row { place, verdict, ..Row::new(part, Kind::Claim, &claim.says) });
        rows.extend(checks(Kind::Check, &claim.printed));
        if let Some((text, instead)) = &claim.instead {
            rows.push(Row::new(part, Kind::Instead, text));
            rows.extend(checks(Kind::Check, instead));
        }
    }
    rows.extend(checks(Kind::Reference, &outcome.references));
    rows.extend(outcome.notes.iter().map(|note| Row::new(part, Kind::Note, note)));
    rows
}

pub fn save(folder: &Path, parts: &[Part]) -> Result<()> {
    let mut table = csv::Writer::from_writer(Vec::new());
    parts.iter().flat_map(rows).try_for_each(|row| table.serialize(row))?;
    write_whole(&folder.join(NAME), &table.into_inner()?)
}

/// The parts that earlier runs have left in the folder.
///
/// # Errors
/// A table of that name which is not one of these.
pub fn load(folder: &Path) -> Result<Vec<Part>> {
    let path = folder.join(NAME);
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
    let mut parts: Vec<Part> = Vec::new();
    for row in csv::Reader::from_reader(text.as_bytes()).deserialize() {
        add(&mut parts, row?)?;
    }
    Ok(parts)
}

fn add(parts: &mut Vec<Part>, row: Row) -> Result<()> {
    let (experiment, length, when) = (row.experiment.clone(), row.form, row.when.clone());
    let begin = |outcome| Part { experiment, length, when, outcome };
    match row.row {
        Kind::Complete => parts.push(begin(Ok(Outcome::default()))),
        Kind::Failed => parts.push(begin(Err(row.text))),
        Kind::Claim => last(parts)?.claims.push(says(row.place, row.text)),
        Kind::Instead => claim(parts)?.instead = Some((row.text, Vec::new())),
        Kind::Check => claim(parts)?.latest().push(row.to_check()?),
        Kind::Reference => last(parts)?.references.push(row.to_check()?),
        Kind::Note => last(parts)?.notes.push(row.text),
    }
    Ok(())
}

fn last(parts: &mut [Part]) -> Result<&mut Outcome> {
    let part = parts.last_mut().context("it does not begin with a part")?;
    part.outcome.as_mut().ok().context("a failed part with more rows")
}

fn claim(parts: &mut [Part]) -> Result<&mut Claim> {
    last(parts)?.claims.last_mut().context("a row without its claim")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn part(experiment: &str, length: Length, value: Option<f64>) -> Part {
        let claim = says("p. 1", "it is \"one\", says it")
            .check("it", value, Bound::Near(1.0, 1e-15))
            .instead("it is two")
            .check("it", value, Bound::Within(1.5, 2.5));
        let references = vec![Check::new("it", value, Bound::AtMost(3.0))];
        let outcome = Ok(Outcome { claims: vec![claim], references, notes: vec!["A note.".into()] });
        let (experiment, when) = (experiment.to_owned(), "today".to_owned());
        Part { experiment, length, when, outcome }
    }

    #[test]
    fn what_is_written_is_read_again() -> Result<()> {
        let folder = tempfile::tempdir()?;
        let failed = Part { outcome: Err("no ink".into()), ..part("c", Length::Full, None) };
        let parts = [part("a", Length::Full, Some(2.0)), part("b", Length::Short, None), failed];
        save(folder.path(), &parts)?;
        let read = load(folder.path())?;
        assert_eq!(read.len(), 3);
        for (one, other) in parts.iter().zip(&read) {
            assert_eq!(rows(one), rows(other));
            assert_eq!((&one.experiment, &one.when), (&other.experiment, &other.when));
            assert_eq!(one.length, other.length);
        }
        Ok(())
    }

    #[test]
    fn a_bound_without_its_numbers_is_refused() {
        let columns = "experiment,form,when,row,place,text,value,bound,low,high,verdict";
        assert!(parse(&format!("{columns}\na,full,now,check,,,1,at most,,2,\n")).is_err());
    }
}
