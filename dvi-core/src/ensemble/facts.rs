//! What tells one computation from another, as texts: what has been written belongs to one of them.

use std::format;
use std::hash::{Hash, Hasher};
use std::string::String;
use std::vec::Vec;

use super::error::Difference;
use super::member::plain;
use crate::{Lagrangian, Space};

/// A hash by which texts and numbers are known again: it tells mistakes apart, not attacks.
pub(crate) use siphasher::sip::SipHasher13 as Fingerprint;

/// Each fact with what it is.
pub(crate) type Facts = Vec<(String, String)>;

/// The first fact in which `found` differs, of those that are `told`.
pub(crate) fn difference(
    expected: &Facts,
    found: &Facts,
    told: impl Fn(&str, [&str; 2]) -> bool,
) -> Option<Difference> {
    let mut facts = expected.iter().zip(found);
    let (fact, (_, found)) =
        facts.find(|((what, expected), (_, found))| expected != found && told(what, [expected, found]))?;
    Some(Difference { what: fact.0.clone(), expected: fact.1.clone(), found: found.clone() })
}

/// A fingerprint as a text.
pub(crate) fn text(fingerprint: &Fingerprint) -> String {
    format!("{:016x}", fingerprint.finish())
}

/// Adds numbers; all that are none are one.
pub(crate) fn add<'n>(fingerprint: &mut Fingerprint, numbers: impl IntoIterator<Item = &'n f64>) {
    numbers.into_iter().for_each(|&number| fingerprint.write_u64(plain(number).to_bits()));
}

/// A fingerprint of the formulas of a system.
pub(crate) fn formulas<S: Lagrangian>() -> String {
    let mut fingerprint = Fingerprint::new();
    S::REPORT.formulas.iter().for_each(|formula| [formula.name, formula.text].hash(&mut fingerprint));
    text(&fingerprint)
}

/// Adds what the parameters of a system do at a state.
pub(crate) fn parameters<S: Lagrangian>(
    fingerprint: &mut Fingerprint,
    system: &S,
    q: &[f64],
    v: &[f64],
    t: f64,
) {
    if system.check().is_ok() {
        let (mut l_q, mut l_v) = (system.space().vector(), system.space().vector());
        system.gradient(q, v, t, &mut l_q, &mut l_v);
        add(fingerprint, [system.energy(q, v, t)].iter().chain(l_q.iter()).chain(l_v.iter()));
    }
}
