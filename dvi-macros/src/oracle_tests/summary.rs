//! What came out of many systems: how many agree, how many are refused and why, and the failures, each
//! made as small as it goes.

use std::collections::BTreeMap;

use super::compare::{Verdict, compare};
use super::expand::refusal;
use super::random::Random;
use super::shrink::smallest;
use super::system::System;

/// So many failures are made small and printed.
const SHOWN: usize = 6;

#[derive(Default)]
pub(super) struct Summary {
    counts: BTreeMap<String, usize>,
    /// Failures by the output that differs: their number, and the first ones.
    failures: BTreeMap<String, (usize, Vec<String>)>,
    largest: f64,
}

impl Summary {
    /// Compares one system; `seed` is that of its points.
    pub(super) fn examine(&mut self, system: &System, seed: u64) {
        let verdict = compare(system, &mut Random::new(seed));
        match &verdict {
            Verdict::Agrees { largest, claims } => {
                self.count("agrees");
                if !system.constraints.is_empty() {
                    self.count(&format!(
                        "agrees, with {} constraints",
                        system.constrained.words().adjective
                    ));
                }
                if system.dissipation.is_some() {
                    self.count("agrees, with a dissipation function");
                }
                if system.has_spinors() {
                    self.count("agrees, with unit vectors");
                }
                for (word, what) in [(": SO3", "rotations"), (": S2", "unit vectors")] {
                    if system.is_on_manifold() && system.attribute().contains(word) {
                        self.count(&format!("agrees, with {what} that have velocities"));
                    }
                }
                if system.has_grids() {
                    self.count("agrees, with two indices");
                }
                if system.attribute().contains("let = {") {
                    self.count("agrees, with names that formulas share");
                }
                self.largest = self.largest.max(*largest);
                for (name, declared, possible) in claims {
                    let allowed = if *possible { "true" } else { "false" };
                    self.count(&format!("{name} {declared}, by numbers {allowed}"));
                }
            }
            Verdict::NoPoint => self.count("no point in the domain"),
            Verdict::OutOfRange => self.count("an index out of range, and it is said"),
            Verdict::Refused(messages) => match messages.iter().find(|message| refusal(message).is_none()) {
                None => messages.iter().filter_map(|message| refusal(message)).for_each(|kind| {
                    self.count(&format!("refused: {kind}"));
                }),
                Some(_) => self.fail(system, seed, &verdict),
            },
            Verdict::Differs { .. } => self.fail(system, seed, &verdict),
        }
    }

    fn count(&mut self, what: &str) {
        *self.counts.entry(what.into()).or_default() += 1;
    }

    fn fail(&mut self, system: &System, seed: u64, verdict: &Verdict) {
        let kind = kind(verdict).expect("a failure");
        self.count("FAILS");
        let (count, shown) = self.failures.entry(kind.clone()).or_default();
        *count += 1;
        if shown.len() >= SHOWN {
            return;
        }
        let examine = |system: &System| compare(system, &mut Random::new(seed));
        let small = smallest(system, |candidate| kind_is(&examine(candidate), &kind));
        let text = describe(&small, &examine(&small));
        if !shown.contains(&text) {
            shown.push(text);
        }
    }

    /// Prints what came out, and fails if anything differed.
    #[expect(clippy::print_stdout, reason = "the distribution is read with --nocapture")]
    pub(super) fn conclude(self, what: &str) {
        println!("{what}: largest difference {:.1e} of the terms", self.largest);
        for (what, count) in &self.counts {
            println!("{count:>8}  {what}");
        }
        let failures: Vec<String> = self
            .failures
            .iter()
            .map(|(kind, (count, shown))| format!("{count} times: {kind}\n\n{}", shown.join("\n\n")))
            .collect();
        assert!(failures.is_empty(), "{what}\n{}", failures.join("\n\n"));
    }
}

/// The output that differs, or the message that is not expected.
fn kind(verdict: &Verdict) -> Option<String> {
    match verdict {
        Verdict::Differs { what, .. } => Some(what.clone()),
        Verdict::Refused(messages) => {
            messages.iter().find(|message| refusal(message).is_none()).map(|message| {
                // Names and numbers of the message aside.
                let words = message.split(|c: char| !c.is_alphabetic()).filter(|word| word.len() > 2);
                format!("refused: {}", words.take(6).collect::<Vec<_>>().join(" "))
            })
        }
        Verdict::Agrees { .. } | Verdict::NoPoint | Verdict::OutOfRange => None,
    }
}

fn kind_is(verdict: &Verdict, wanted: &str) -> bool {
    kind(verdict).is_some_and(|kind| kind == wanted)
}

/// The system as a user would write it, with what is wrong.
pub(super) fn describe(system: &System, verdict: &Verdict) -> String {
    let name = if system.is_regular() { "lagrangian" } else { "degenerate_lagrangian" };
    let sizes: Vec<String> = (0..system.sizes.len())
        .map(|size| format!("{} = {}", system.size_text(size), system.sizes[size].value))
        .collect();
    let attribute = system.attribute();
    let used = system.fields.iter().filter(|field| attribute.contains(field.name));
    let fields: Vec<String> = used.map(|field| format!("{} = {:?}", field.name, field.values)).collect();
    let found = match verdict {
        Verdict::Differs { details, .. } => details.clone(),
        Verdict::Refused(messages) => messages.join("\n"),
        other => format!("{other:?}"),
    };
    format!(
        "#[{name}({})]\n{}\n  sizes {}; {}\n  {found}",
        attribute,
        system.item(),
        sizes.join(", "),
        fields.join(", ")
    )
}
