//! What a paper says, what was measured, and the verdict that follows from the two.
//!
//! A verdict is never typed in: a claim is a list of checks, a check is a number and a bound, and the
//! verdict is computed. Where the paper is known to err, the claim carries a second list, what holds
//! instead, and the verdict is *differs* only if that list passes.
//!
//! A number that must be the one of an independent program, or of earlier runs, decides on no claim: it is a
//! check by itself, of a regression.

use std::fmt;

use anyhow::Result;

use crate::gallery::Outcome;
use crate::output::digits;

/// The place of claims that no paper makes; they are counted apart.
pub const BEYOND: &str = "beyond the paper";

/// What a number must satisfy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bound {
    AtMost(f64),
    AtLeast(f64),
    Within(f64, f64),
    Near(f64, f64),
}

impl Bound {
    fn holds(self, value: f64) -> bool {
        match self {
            Bound::AtMost(high) => value <= high,
            Bound::AtLeast(low) => value >= low,
            Bound::Within(low, high) => (low..=high).contains(&value),
            Bound::Near(target, tolerance) => (value - target).abs() <= tolerance,
        }
    }
}

/// A measured number and what it must satisfy; `None` if this run was too short to measure it.
#[derive(Clone, Debug)]
pub struct Check {
    pub quantity: String,
    pub value: Option<f64>,
    pub bound: Bound,
}

/// What a paper says, with the checks that decide on it.
#[derive(Clone, Debug)]
pub struct Claim {
    /// Where the paper says it.
    pub place: String,
    pub says: String,
    pub printed: Vec<Check>,
    /// What holds if that does not, with its own checks.
    pub instead: Option<(String, Vec<Check>)>,
    /// What the next checks are of.
    subject: String,
}

/// What can be said of a claim or of a check by itself.
pub const VERDICTS: [&str; 7] =
    ["reproduced", "holds", "passes", "differs", "undecided", "not measured", "fails"];

/// What a paper says at a place.
pub fn says(place: impl Into<String>, text: impl Into<String>) -> Claim {
    let (place, says) = (place.into(), text.into());
    Claim { place, says, printed: Vec::new(), instead: None, subject: String::new() }
}

/// What no paper says.
pub fn beyond(says: impl Into<String>) -> Claim {
    self::says(BEYOND, says)
}

/// What an experiment has to say that has claims only.
pub fn claims<const N: usize>(all: [Claim; N]) -> Result<Outcome> {
    Ok(Outcome { claims: all.into(), ..Outcome::default() })
}

impl Claim {
    /// The quantities of the checks that follow begin with the name of what they are of, without its marks of
    /// italics, and a colon.
    pub fn of(self, name: impl AsRef<str>) -> Self {
        Self { subject: format!("{}: ", name.as_ref().replace('*', "")), ..self }
    }

    /// Adds a check; after [`instead`](Self::instead), to the list of what holds instead.
    pub fn check(self, quantity: impl Into<String>, value: impl Into<Option<f64>>, bound: Bound) -> Self {
        let mut claim = self;
        let check = Check::new(claim.subject.clone() + &quantity.into(), value, bound);
        claim.latest().push(check);
        claim
    }

    /// The list that the next check belongs to.
    pub fn latest(&mut self) -> &mut Vec<Check> {
        self.instead.as_mut().map_or(&mut self.printed, |(_, checks)| checks)
    }

    pub fn at_most(self, quantity: impl Into<String>, value: impl Into<Option<f64>>, high: f64) -> Self {
        self.check(quantity, value, Bound::AtMost(high))
    }

    pub fn at_least(self, quantity: impl Into<String>, value: impl Into<Option<f64>>, low: f64) -> Self {
        self.check(quantity, value, Bound::AtLeast(low))
    }

    pub fn within(self, quantity: impl Into<String>, value: impl Into<Option<f64>>, ends: [f64; 2]) -> Self {
        self.check(quantity, value, Bound::Within(ends[0], ends[1]))
    }

    /// The check that a number is another one, up to a tolerance.
    pub fn near(self, quantity: impl Into<String>, value: impl Into<Option<f64>>, near: [f64; 2]) -> Self {
        self.check(quantity, value, Bound::Near(near[0], near[1]))
    }

    /// Checks of each of some things; a name that these are of is that of the thing only.
    pub fn each<I: IntoIterator>(self, things: I, mut add: impl FnMut(Self, I::Item) -> Self) -> Self {
        let subject = self.subject.clone();
        things.into_iter().fold(self, |claim, thing| Self { subject: subject.clone(), ..add(claim, thing) })
    }

    /// What holds where the claim as printed does not; the checks that follow decide on it.
    pub fn instead(self, text: impl Into<String>) -> Self {
        Self { instead: Some((text.into(), Vec::new())), ..self }
    }

    /// One of [`VERDICTS`]: only what is printed can be reproduced, and what was not measured in a run of
    /// this length decides nothing.
    pub fn verdict(&self) -> &'static str {
        let of = |checks: &[Check]| match checks {
            _ if checks.iter().any(|check| check.value.is_none()) => "undecided",
            _ if checks.iter().all(|check| check.verdict() == "passes") => "passes",
            _ => "fails",
        };
        match (of(&self.printed), &self.instead) {
            ("passes", _) if self.is_printed() => "reproduced",
            ("passes", _) => "holds",
            ("fails", Some((_, instead))) if of(instead) == "passes" => "differs",
            ("fails", Some((_, instead))) => of(instead),
            (undecided_or_fails, _) => undecided_or_fails,
        }
    }

    pub fn is_printed(&self) -> bool {
        self.place != BEYOND
    }

    /// What holds instead, if that is the verdict.
    pub fn differs(&self) -> Option<&str> {
        self.instead.as_ref().filter(|_| self.verdict() == "differs").map(|(text, _)| text.as_str())
    }

    /// The checks that the verdict rests on.
    pub fn checks(&self) -> impl Iterator<Item = &Check> {
        let instead = self.instead.iter().flat_map(|(_, checks)| checks);
        self.printed.iter().chain(instead)
    }
}

impl Check {
    pub fn new(quantity: impl Into<String>, value: impl Into<Option<f64>>, bound: Bound) -> Self {
        Self { quantity: quantity.into(), value: value.into(), bound }
    }

    pub fn verdict(&self) -> &'static str {
        match self.value {
            None => "not measured",
            Some(value) if self.bound.holds(value) => "passes",
            Some(_) => "fails",
        }
    }

    /// The number with what is required of it.
    pub fn judged(&self) -> String {
        match self.value {
            None => format!("needs a longer run ({})", self.bound),
            Some(value) if self.bound.holds(value) => format!("{} ({})", measured(value), self.bound),
            Some(value) => format!("{} (not {})", measured(value), self.bound),
        }
    }
}

impl fmt::Display for Bound {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Bound::AtMost(high) => write!(f, "at most {}", exact(high)),
            Bound::AtLeast(low) => write!(f, "at least {}", exact(low)),
            Bound::Within(low, high) => write!(f, "{} to {}", exact(low), exact(high)),
            Bound::Near(target, tolerance) => write!(f, "{} ± {}", exact(target), exact(tolerance)),
        }
    }
}

impl fmt::Display for Check {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sign = if self.value.is_some() { " =" } else { ":" };
        write!(f, "{}{sign} {}", self.quantity, self.judged())
    }
}

/// All digits, for bounds: rounded, a bound would be another one.
fn exact(value: f64) -> String {
    digits(value, 1e-3..1e6)
}

/// Up to seven digits, for measured numbers.
fn measured(value: f64) -> String {
    digits(format!("{value:.6e}").parse().unwrap_or(value), 1e-2..1e6)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn claim(value: impl Into<Option<f64>>) -> Claim {
        says("p. 1", "it is one").check("it", value, Bound::Near(1.0, 0.1))
    }

    #[test]
    fn verdicts_follow_from_the_numbers() {
        let verdicts = [Some(1.05), Some(1.2), Some(f64::NAN), None].map(|value| claim(value).verdict());
        assert_eq!(verdicts, ["reproduced", "fails", "fails", "undecided"]);
    }

    #[test]
    fn a_known_error_of_the_paper_is_confirmed_by_measurement_too() {
        let with = |it, two| claim(it).instead("it is two").check("it", two, Bound::AtLeast(1.9)).verdict();
        assert_eq!([with(1.0, 1.0), with(2.0, 2.0), with(1.5, 1.5)], ["reproduced", "differs", "fails"]);
    }

    #[test]
    fn numbers_are_shown_with_the_digits_that_matter() {
        let shown = [3.268_824_49e-3, 2.0, 6362.0, -0.06, 1.25e7, 0.0].map(measured);
        assert_eq!(shown, ["3.268824e-3", "2", "6362", "-0.06", "1.25e7", "0"]);
    }

    #[test]
    fn bounds_are_shown_with_all_their_digits() {
        let shown = [Bound::AtMost(0.333_349), Bound::Near(1.188_395_105_778, 1e-11)].map(|b| b.to_string());
        assert_eq!(shown, ["at most 0.333349", "1.188395105778 ± 1e-11"]);
    }
}
