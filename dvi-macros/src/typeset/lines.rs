//! Equations below one another, broken where a page ends.

use std::fmt::Write as _;

/// What stands on a line, in letters of usual width, besides a term that is longer by itself.
const WIDTH: usize = 72;
/// Beyond so many letters nobody reads a formula.
const LONGEST: usize = 1500;

/// A name and what it is.
#[derive(Debug)]
pub(crate) struct Equation {
    pub(super) name: String,
    /// The terms of a sum, each with its sign but for the first.
    pub(super) terms: Vec<String>,
    pub(super) relation: &'static str,
    /// What its index runs over.
    pub(super) range: Option<String>,
    pub(super) lets: Vec<(String, Vec<String>)>,
}

impl Equation {
    pub(super) fn new(name: String, terms: Vec<String>, lets: Vec<(String, Vec<String>)>) -> Self {
        Self { name, terms, relation: "=", range: None, lets }
    }

    /// Whether it is too long to be read.
    fn is_endless(&self) -> bool {
        let lets = self.lets.iter().flat_map(|(_, terms)| terms);
        self.terms.iter().chain(lets).map(|term| width(term)).sum::<usize>() > LONGEST
    }
}

/// Equations as a block of LaTeX that rustdoc and GitHub typeset; nothing of none.
pub(crate) fn block<'a>(equations: impl IntoIterator<Item = &'a Equation>) -> String {
    let mut lines = Vec::new();
    for equation in equations {
        let Equation { name, terms, relation, range, lets } = equation;
        if equation.is_endless() {
            lines.push(format!(r"{name} &{relation} \dots"));
            continue;
        }
        lines.extend(broken(name, relation, terms));
        if let (Some(range), Some(last)) = (range, lines.last_mut()) {
            let _ = write!(last, r" \qquad \text{{for }} {range}");
        }
        for (name, terms) in lets {
            // Formulas may have the same names for the same things.
            let defined = broken(name, "=", terms);
            if !lines.windows(defined.len()).any(|known| known == defined) {
                lines.extend(defined);
            }
        }
    }
    if lines.is_empty() {
        return String::new();
    }
    let lines = lines.join(" \\\\\n");
    format!("```math\n\\begin{{aligned}}\n{lines}\n\\end{{aligned}}\n```\n\n")
}

fn broken(name: &str, relation: &str, terms: &[String]) -> Vec<String> {
    let mut lines = vec![format!("{name} &{relation}")];
    let mut used = width(name);
    for (place, term) in terms.iter().enumerate() {
        let width = width(term);
        if used + width > WIDTH && place > 0 {
            lines.push(r"&\quad".to_owned());
            used = 0;
        }
        used += width;
        if let Some(line) = lines.last_mut() {
            let _ = write!(line, " {term}");
        }
    }
    lines
}

/// About how many letters wide a formula is: a command is one.
fn width(tex: &str) -> usize {
    let mut count = 0;
    let mut letters = tex.chars().peekable();
    while let Some(letter) = letters.next() {
        match letter {
            '\\' => {
                // A space has no letter.
                if letters.next_if_eq(&',').is_none() {
                    while letters.next_if(char::is_ascii_alphabetic).is_some() {}
                    count += 1;
                }
            }
            '{' | '}' | '_' | '^' | ' ' => {}
            _ => count += 1,
        }
    }
    count
}
