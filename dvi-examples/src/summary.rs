//! The summary: claim by claim, what the paper says, what was measured, and the verdict.
//!
//! Claims decide on what a paper says, or on what we say beyond it. Regression checks compare a number with
//! that of an independent program or of earlier runs; they decide on nothing and are counted apart.

use std::fmt::Write as _;

use crate::claim::{Check, Claim, Verdict};
use crate::gallery::Outcome;
use crate::job::Length;
use crate::output::wrapped;
use crate::record::{Part, State};

/// The summary of a folder as Markdown; `title` names the picture of an experiment.
pub fn markdown(parts: &[Part], title: impl Fn(&str) -> &'static str) -> String {
    let mut text = String::from("# Claim by claim\n\n");
    for length in [Length::Full, Length::Short] {
        let of = || parts.iter().filter(|part| part.length == length);
        if of().next().is_some() {
            let count = counted(of().count(), "experiment");
            let _ = writeln!(text, "**The {} form**, {count}: {}.\n", length.name(), tally(of()));
        }
    }
    if parts.iter().any(|part| part.length == Length::Short) {
        text +=
            "The short form runs for shorter times; claims that need longer ones stay undecided in it.\n\n";
    }
    for part in parts {
        let Part { experiment, length, when, state, outcome } = part;
        let _ = writeln!(text, "## {experiment}: {}\n", title(experiment));
        let _ = writeln!(text, "The {} form, {when}.\n", length.name());
        match state {
            State::Failed(error) => {
                let _ = writeln!(text, "**Failed**: {error}\n");
            }
            State::NotStarted => text += "**Interrupted** before it started.\n\n",
            State::Complete => section(&mut text, experiment, outcome, false),
            State::Interrupted => {
                text += "**Interrupted**: the series end early, and no claim was decided.\n\n";
                section(&mut text, experiment, outcome, true);
            }
        }
    }
    text
}

fn section(text: &mut String, name: &str, outcome: &Outcome, interrupted: bool) {
    let _ = writeln!(text, "![]({name}.png)\n");
    if !outcome.claims.is_empty() {
        *text += "| Claim | Measured (required) | Verdict |\n|---|---|---|\n";
    }
    for claim in &outcome.claims {
        let says = cell(&claim.says);
        if interrupted {
            // Numbers of incomplete series would only mislead.
            let _ = writeln!(text, "| {says} ({}) | | interrupted |", claim.place);
            continue;
        }
        let measured: Vec<String> = claim.checks().map(|check| cell(&check.to_string())).collect();
        let verdict = cell(&claim.judgement());
        let _ = writeln!(text, "| {says} ({}) | {} | {verdict} |", claim.place, measured.join("<br>"));
    }
    *text += "\n";
    if !outcome.references.is_empty() && !interrupted {
        *text += "| Regression check | Measured (required) | |\n|---|---|---|\n";
        for check in &outcome.references {
            let (quantity, measured) = (cell(&check.quantity), cell(&check.judged()));
            let _ = writeln!(text, "| {quantity} | {measured} | {} |", passes(check));
        }
        *text += "\n";
    }
    for note in &outcome.notes {
        let _ = writeln!(text, "- {note}");
    }
    if !outcome.notes.is_empty() {
        *text += "\n";
    }
}

fn passes(check: &Check) -> &'static str {
    match check.value {
        None => "not measured",
        Some(_) if check.passes() => "passes",
        Some(_) => "**fails**",
    }
}

/// Vertical bars would end the cell.
fn cell(text: &str) -> String {
    text.replace('|', "\\|")
}

/// The summary of a run for a terminal, in lines of at most `width` letters if there is a limit.
pub fn plain(parts: &[Part], title: impl Fn(&str) -> &'static str, width: Option<usize>) -> String {
    let mut text = String::new();
    let mut line = |indent: usize, words: &str| text += &wrapped(words, indent, width);
    for Part { experiment, state, outcome, .. } in parts {
        line(0, &format!("{experiment}: {}", title(experiment)));
        match state {
            State::NotStarted => line(2, "interrupted before it started"),
            State::Failed(error) => line(2, &format!("failed: {error}")),
            State::Complete | State::Interrupted => {}
        }
        let interrupted = *state == State::Interrupted;
        for claim in &outcome.claims {
            entry(&mut line, claim, interrupted);
        }
        for check in outcome.references.iter().filter(|_| !interrupted) {
            let mark = if check.value.is_none() || check.passes() { "=" } else { "✗" };
            line(2, &format!("{mark} {check}"));
        }
        line(0, "");
    }
    text + &wrapped(&format!("{}.", tally(parts)), 0, width)
}

fn entry(line: &mut impl FnMut(usize, &str), claim: &Claim, interrupted: bool) {
    if interrupted {
        line(2, &format!("… {} ({}): interrupted", claim.says, claim.place));
        return;
    }
    let mark = match claim.verdict() {
        Verdict::Reproduced => "✓",
        Verdict::Differs(_) => "≠",
        Verdict::NotReproduced => "✗",
        Verdict::Undecided => "?",
    };
    line(2, &format!("{mark} {} ({})", claim.says, claim.place));
    for check in claim.checks() {
        line(6, &check.to_string());
    }
    line(6, &format!("→ {}", claim.judgement()));
}

/// Claims of the papers, claims beyond them, and regression checks, counted apart.
pub fn tally<'a>(parts: impl IntoIterator<Item = &'a Part>) -> String {
    let complete = parts.into_iter().filter(|part| part.state == State::Complete);
    let outcomes: Vec<&Outcome> = complete.map(|part| &part.outcome).collect();
    let claims = outcomes.iter().flat_map(|outcome| &outcome.claims);
    let (printed, beyond): (Vec<&Claim>, Vec<&Claim>) = claims.partition(|claim| claim.is_printed());
    let count = |claims: &[&Claim], wanted: fn(&Verdict) -> bool| {
        claims.iter().filter(|claim| wanted(&claim.verdict())).count()
    };
    let of = |claims: &[&Claim], holds: [&'static str; 4]| {
        let [reproduced, differs, not, undecided] = holds;
        listed(&[
            (count(claims, |v| *v == Verdict::Reproduced), reproduced),
            (count(claims, |v| matches!(v, Verdict::Differs(_))), differs),
            (count(claims, |v| *v == Verdict::NotReproduced), not),
            (count(claims, |v| *v == Verdict::Undecided), undecided),
        ])
    };
    let of_papers =
        of(&printed, ["reproduced", "different from what is printed", "not reproduced", "undecided"]);
    let of_ours = of(&beyond, ["true", "different", "false", "undecided"]);
    let references: Vec<&Check> = outcomes.iter().flat_map(|outcome| &outcome.references).collect();
    let judged = listed(&[
        (references.iter().filter(|check| check.passes()).count(), "passed"),
        (references.iter().filter(|check| check.value.is_some() && !check.passes()).count(), "failed"),
        (references.iter().filter(|check| check.value.is_none()).count(), "not measured"),
    ]);
    let mut tally = format!("{} of the papers: {of_papers}", counted(printed.len(), "claim"));
    if !beyond.is_empty() {
        let _ = write!(tally, "; {} beyond them: {of_ours}", counted(beyond.len(), "claim"));
    }
    if !references.is_empty() {
        let _ = write!(tally, "; {}: {judged}", counted(references.len(), "regression check"));
    }
    tally
}

/// The counts that are not zero, with what is counted.
fn listed(parts: &[(usize, &str)]) -> String {
    let shown = parts.iter().filter(|(count, _)| *count > 0).map(|(count, what)| format!("{count} {what}"));
    let shown: Vec<String> = shown.collect();
    if shown.is_empty() { "none decided".into() } else { shown.join(", ") }
}

fn counted(count: usize, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claim::{BEYOND, Bound};

    fn outcome() -> Outcome {
        let claim = |value| Claim::new("p. 1", "|x| is small").check("|x|", value, Bound::AtMost(1.0));
        let beyond = |value: Option<f64>| {
            Claim::new(BEYOND, "|x| is positive").check("|x|", value, Bound::AtLeast(0.0))
        };
        Outcome {
            claims: vec![claim(0.5), claim(2.0), beyond(Some(0.5)), beyond(None)],
            references: vec![Check::new("|x|", 0.5, Bound::Near(0.5, 1e-3))],
            notes: vec!["A note.".into()],
        }
    }

    fn part(state: State, length: Length) -> Part {
        let (experiment, when) = ("sample".to_owned(), "today".to_owned());
        Part { experiment, length, when, state, outcome: outcome() }
    }

    #[test]
    fn both_forms_tell_verdicts_and_numbers() {
        let parts = [part(State::Complete, Length::Short)];
        let page = markdown(&parts, |_| "A sample");
        for wanted in [
            "2 claims of the papers: 1 reproduced, 1 not reproduced; 2 claims beyond them: 1 true, 1 undecided; \
             1 regression check: 1 passed.",
            "| \\|x\\| is small (p. 1) | \\|x\\| = 0.5 (at most 1) | reproduced |",
            "| \\|x\\| | 0.5 (0.5 ± 0.001) | passes |",
            "The short form, today.",
            "- A note.",
        ] {
            assert!(page.contains(wanted), "{page}");
        }
        let shown = plain(&parts, |_| "A sample", None);
        assert!(shown.contains("      |x| = 2 (not at most 1)\n"), "{shown}");
    }

    #[test]
    fn a_folder_tells_what_made_each_of_its_parts() {
        let parts = [Length::Short, Length::Full].map(|length| part(State::Complete, length));
        let page = markdown(&parts, |_| "A sample");
        assert!(
            page.contains("**The full form**, 1 experiment: ") && page.contains("**The short form**"),
            "{page}"
        );
    }

    #[test]
    fn an_interrupted_experiment_decides_nothing() {
        let page = markdown(&[part(State::Interrupted, Length::Full)], |_| "A sample");
        assert!(page.contains("| interrupted |") && !page.contains("| reproduced |"), "{page}");
        assert!(page.contains("0 claims of the papers: none decided"), "{page}");
    }
}
