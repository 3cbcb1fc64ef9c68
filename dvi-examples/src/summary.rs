//! The summary: claim by claim, what the paper says, what was measured, and the verdict.
//!
//! Claims decide on what a paper says, or on what we say beyond it. Regression checks compare a number with
//! that of an independent program or of earlier runs; they decide on nothing and are counted apart.

use anyhow::{Context as _, Result};
use askama::Template as _;

use crate::claim::{Check, Claim, VERDICTS};
use crate::gallery::Experiment;
use crate::job::Length;
use crate::record::Part;

#[derive(askama::Template)]
#[template(path = "summary.md")]
struct Summary<'a> {
    parts: &'a [Part],
    experiments: &'a [Experiment],
}

/// The summary of these parts, with the titles that the experiments have.
pub fn markdown(parts: &[Part], experiments: &[Experiment]) -> Result<String> {
    Summary { parts, experiments }.render().context("the summary cannot be written")
}

impl Summary<'_> {
    fn title(&self, name: &str) -> &'static str {
        self.experiments.iter().find(|experiment| experiment.name == name).map_or("", |of| of.title)
    }

    /// The forms of runs that there are parts of, how many, and what these decide.
    fn forms(&self) -> impl Iterator<Item = (&'static str, usize, String)> {
        let form = |length: Length| {
            let of = || self.parts.iter().filter(move |part| part.length == length);
            (length.name(), of().count(), tally(of()))
        };
        [Length::Full, Length::Short].into_iter().map(form).filter(|(_, count, _)| *count > 0)
    }
}

/// Claims of the papers, claims beyond them, and regression checks, counted apart by their verdicts.
pub fn tally<'a>(parts: impl IntoIterator<Item = &'a Part>) -> String {
    let outcomes: Vec<_> = parts.into_iter().filter_map(|part| part.outcome.as_ref().ok()).collect();
    let claims = outcomes.iter().flat_map(|outcome| &outcome.claims);
    let (printed, beyond): (Vec<_>, Vec<_>) = claims.partition(|claim| claim.is_printed());
    let checks = outcomes.iter().flat_map(|outcome| &outcome.references);
    format!(
        "Claims of the papers: {}; claims beyond them: {}; regression checks: {}.",
        counted(printed.into_iter().map(Claim::verdict).collect()),
        counted(beyond.into_iter().map(Claim::verdict).collect()),
        counted(checks.map(Check::verdict).collect())
    )
}

fn counted(verdicts: Vec<&str>) -> String {
    let count = |word| verdicts.iter().filter(|&&verdict| verdict == word).count();
    let counts = VERDICTS.into_iter().map(|word| (word, count(word))).filter(|(_, count)| *count > 0);
    let counts: Vec<_> = counts.map(|(word, count)| format!("{word} {count}")).collect();
    if counts.is_empty() { "none".into() } else { counts.join(", ") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claim::{Bound, beyond, says};
    use crate::gallery::Outcome;

    fn part(length: Length) -> Part {
        let claim = |value| says("p. 1", "|x| is small").at_most("|x|", value, 1.0);
        let beyond = |value: Option<f64>| beyond("|x| is positive").at_least("|x|", value, 0.0);
        let outcome = Ok(Outcome {
            claims: vec![claim(0.5), claim(2.0), beyond(Some(0.5)), beyond(None)],
            references: vec![Check::new("|x|", 0.5, Bound::Near(0.5, 1e-3))],
            notes: vec!["A note.".into()],
        });
        Part { experiment: "momenta".into(), length, when: "today".into(), outcome }
    }

    #[test]
    fn a_summary_tells_verdicts_and_numbers_of_parts_of_both_forms() -> Result<()> {
        let (name, title, source) = ("momenta", "Which scheme", "");
        let momenta = Experiment { name, title, source, share: 1.0, run: |_| Ok(Outcome::default()) };
        let page = markdown(&[Length::Short, Length::Full].map(part), &[momenta])?;
        for wanted in [
            "The full form, experiments: 1. ",
            "## momenta: Which scheme\n",
            "The short form, experiments: 1. Claims of the papers: reproduced 1, fails 1; claims beyond \
             them: holds 1, undecided 1; regression checks: passes 1.",
            "The short form, today.\n",
            "- **reproduced**: |x| is small (p. 1)\n  - |x| = 0.5 (at most 1)\n",
            "- **fails**: |x| is small (p. 1)\n  - |x| = 2 (not at most 1)\n",
            "- **passes**, a regression check: |x| = 0.5 (0.5 ± 0.001)\n",
            "- A note.\n",
        ] {
            assert!(page.contains(wanted), "{page}");
        }
        Ok(())
    }
}
