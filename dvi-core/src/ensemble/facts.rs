//! What tells one computation from another, as texts: what has been written belongs to one of them.

use std::string::{String, ToString};
use std::vec::Vec;

use super::error::Difference;
use crate::state::fingerprint::Fingerprint;
use crate::{Lagrangian, Space};

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

/// A fingerprint of the formulas of a system.
pub(crate) fn formulas<S: Lagrangian>() -> String {
    let mut fingerprint = Fingerprint::new();
    for formula in S::REPORT.formulas {
        fingerprint.text(formula.name);
        fingerprint.text(formula.text);
    }
    fingerprint.to_string()
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
        fingerprint.number(system.energy(q, v, t));
        let (mut l_q, mut l_v) = (system.space().vector(), system.space().vector());
        system.gradient(q, v, t, &mut l_q, &mut l_v);
        l_q.iter().chain(l_v.iter()).for_each(|&x| fingerprint.number(x));
    }
}
