//! The summary: claim by claim, what the paper says, what was measured, and the verdict.

use std::fmt::Write as _;

use crate::claim::{Claim, Verdict};
use crate::gallery::{Ended, Experiment, Outcome};
use crate::job::Length;

/// The experiments with how they ended.
pub type Results<'a> = [(&'a Experiment, &'a Ended)];

/// The summary as Markdown.
pub fn markdown(results: &Results<'_>, length: Length) -> String {
    let mut text = String::from("# Claim by claim\n\n");
    if length == Length::Short {
        text += "This was the **short** form: shorter times, and claims that need longer ones stay undecided.\n\n";
    }
    let _ = writeln!(text, "{}.\n", tally(results));
    for (experiment, ended) in results {
        let Experiment { name, title, .. } = experiment;
        let _ = writeln!(text, "## {name}: {title}\n");
        match ended {
            Ended::Failed(error) => {
                let _ = writeln!(text, "**Failed**: {error:#}\n");
            }
            Ended::NotStarted => text += "**Interrupted** before it started.\n\n",
            Ended::Complete(outcome) => section(&mut text, name, outcome, false),
            Ended::Interrupted(outcome) => {
                text += "**Interrupted**: the series end early, and no claim was decided.\n\n";
                section(&mut text, name, outcome, true);
            }
        }
    }
    text
}

fn section(text: &mut String, name: &str, outcome: &Outcome, interrupted: bool) {
    let _ = writeln!(text, "![]({name}.png)\n");
    *text += "| Claim | Measured (required) | Verdict |\n|---|---|---|\n";
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
    for note in &outcome.notes {
        let _ = writeln!(text, "- {note}");
    }
    if !outcome.notes.is_empty() {
        *text += "\n";
    }
}

/// Vertical bars would end the cell.
fn cell(text: &str) -> String {
    text.replace('|', "\\|")
}

/// The summary for a terminal.
pub fn plain(results: &Results<'_>) -> String {
    let mut text = String::new();
    for (experiment, ended) in results {
        let _ = writeln!(text, "{}: {}", experiment.name, experiment.title);
        let (outcome, interrupted) = match ended {
            Ended::Complete(outcome) => (outcome, false),
            Ended::Interrupted(outcome) => (outcome, true),
            Ended::NotStarted => {
                text += "  interrupted before it started\n\n";
                continue;
            }
            Ended::Failed(error) => {
                let _ = writeln!(text, "  failed: {error:#}\n");
                continue;
            }
        };
        for claim in &outcome.claims {
            entry(&mut text, claim, interrupted);
        }
        text.push('\n');
    }
    text + &tally(results) + ".\n"
}

fn entry(text: &mut String, claim: &Claim, interrupted: bool) {
    if interrupted {
        let _ = writeln!(text, "  … {} ({}): interrupted", claim.says, claim.place);
        return;
    }
    let mark = match claim.verdict() {
        Verdict::Reproduced => "✓",
        Verdict::Differs(_) => "≠",
        Verdict::NotReproduced => "✗",
        Verdict::Undecided => "?",
    };
    let _ = writeln!(text, "  {mark} {} ({})", claim.says, claim.place);
    for check in claim.checks() {
        let _ = writeln!(text, "      {check}");
    }
    let _ = writeln!(text, "      → {}", claim.judgement());
}

/// Claims of the papers and claims beyond them, counted apart.
fn tally(results: &Results<'_>) -> String {
    let complete = results.iter().filter_map(|(_, ended)| match ended {
        Ended::Complete(outcome) => Some(&outcome.claims),
        _ => None,
    });
    let (printed, beyond): (Vec<&Claim>, Vec<&Claim>) =
        complete.flatten().partition(|claim| claim.is_printed());
    let count = |claims: &[&Claim], wanted: fn(&Verdict) -> bool| {
        claims.iter().filter(|claim| wanted(&claim.verdict())).count()
    };
    let parts = [
        (count(&printed, |v| *v == Verdict::Reproduced), "reproduced"),
        (count(&printed, |v| matches!(v, Verdict::Differs(_))), "differ from what is printed"),
        (count(&printed, |v| *v == Verdict::NotReproduced), "not reproduced"),
        (count(&printed, |v| *v == Verdict::Undecided), "undecided"),
    ];
    let shown = parts.iter().filter(|(count, _)| *count > 0).map(|(count, what)| format!("{count} {what}"));
    let shown: Vec<String> = shown.collect();
    let shown = if shown.is_empty() { "none decided".into() } else { shown.join(", ") };
    let holds = count(&beyond, |v| *v == Verdict::Reproduced);
    let beyond = beyond.len();
    format!("{} claims of the papers: {shown}; {beyond} beyond them: {holds} hold", printed.len())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claim::{BEYOND, Bound};

    fn outcome() -> Outcome {
        let claim = |value| Claim::new("p. 1", "|x| is small").check("|x|", value, Bound::AtMost(1.0));
        let beyond = Claim::new(BEYOND, "|x| is positive").check("|x|", 0.5, Bound::AtLeast(0.0));
        Outcome { claims: vec![claim(0.5), claim(2.0), beyond], notes: vec!["A note.".into()] }
    }

    fn experiment() -> Experiment {
        Experiment { name: "sample", title: "A sample", run: |_| Ok(Outcome::default()) }
    }

    #[test]
    fn both_forms_tell_verdicts_and_numbers() {
        let (experiment, ended) = (experiment(), Ended::Complete(outcome()));
        let results = [(&experiment, &ended)];
        let page = markdown(&results, Length::Short);
        assert!(
            page.contains("2 claims of the papers: 1 reproduced, 1 not reproduced; 1 beyond them: 1 hold."),
            "{page}"
        );
        assert!(
            page.contains("| \\|x\\| is small (p. 1) | \\|x\\| = 0.5 (at most 1) | reproduced |"),
            "{page}"
        );
        assert!(page.contains("short") && page.contains("- A note."), "{page}");
        assert!(plain(&results).contains("      |x| = 2 (not at most 1)\n"), "{}", plain(&results));
    }

    #[test]
    fn an_interrupted_experiment_decides_nothing() {
        let (experiment, ended) = (experiment(), Ended::Interrupted(outcome()));
        let page = markdown(&[(&experiment, &ended)], Length::Full);
        assert!(page.contains("| interrupted |") && !page.contains("| reproduced |"), "{page}");
        assert!(page.contains("0 claims of the papers: none decided"), "{page}");
    }
}
