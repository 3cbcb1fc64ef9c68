//! What came out of many systems: how many agree, how many are refused and why, and the failures, each
//! made as small as it goes.

use std::collections::BTreeMap;

use super::compare::{Verdict, compare};
use super::expand::refusal;
use super::language::PARTS;
use super::random::Random;
use super::shrink::smallest;
use super::system::System;

/// So many failures are made small and printed.
const SHOWN: usize = 6;
/// So many systems that agree are to have each part of the language.
const FEWEST: usize = 3;

#[derive(Default)]
pub(super) struct Summary {
    counts: BTreeMap<String, usize>,
    /// The systems that agree, by the parts of the language that they have.
    parts: BTreeMap<&'static str, usize>,
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
                for (part, is_in) in PARTS {
                    *self.parts.entry(part).or_default() += usize::from(is_in(system));
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

    /// Fails if few of the systems that agree have some part of the language.
    pub(super) fn expect_each_part(&self) {
        for (part, count) in &self.parts {
            assert!(
                *count >= FEWEST,
                "{count} systems that agree have {part}, and {FEWEST} are to have them"
            );
        }
    }

    /// Prints what came out, and fails if anything differed.
    #[expect(clippy::print_stdout, reason = "the distribution is read with --nocapture")]
    pub(super) fn conclude(self, what: &str) {
        println!("{what}: largest difference {:.1e} of the terms", self.largest);
        for (what, count) in &self.counts {
            println!("{count:>8}  {what}");
        }
        for (part, count) in &self.parts {
            println!("{count:>8}  with {part}");
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
