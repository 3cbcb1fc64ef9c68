//! What tells one computation from another, as texts: what has been written belongs to one of them.

use std::any::type_name;
use std::fmt::Debug;
use std::format;
use std::string::{String, ToString};
use std::vec::Vec;

use super::error::Difference;
use crate::state::fingerprint::Fingerprint;
use crate::{Lagrangian, Space};

/// Each fact with what it is.
pub(crate) type Facts = Vec<(String, String)>;

/// What a method on a system with coordinates of these names is, and `others`.
pub(crate) fn of<S: Lagrangian, M: Debug>(
    names: &[String],
    method: &M,
    others: impl IntoIterator<Item = (&'static str, String)>,
) -> Facts {
    let mut formulas = Fingerprint::new();
    for formula in S::REPORT.formulas {
        formulas.text(formula.name);
        formulas.text(formula.text);
    }
    let facts = [
        ("version of the library", env!("CARGO_PKG_VERSION").to_string()),
        ("system", type_name::<S>().to_string()),
        ("list of coordinates", names.join(" ")),
        ("fingerprint of the formulas", formulas.to_string()),
        ("method", text(method)),
    ];
    facts.into_iter().chain(others).map(|(what, value)| (what.to_string(), value)).collect()
}

/// A method as a text: what it says of itself need not say the number of its stages, which its type does.
pub(crate) fn text<M: Debug>(method: &M) -> String {
    format!("{} {method:?}", type_name::<M>())
}

/// The first fact in which `found` differs. One that is empty is not known, and belongs to all.
pub(crate) fn difference(expected: &Facts, found: &Facts) -> Option<Difference> {
    let mut facts = expected.iter().zip(found);
    let ((what, expected), (_, found)) = facts.find(|((_, expected), (_, found))| {
        expected != found && !expected.is_empty() && !found.is_empty()
    })?;
    Some(Difference { what: what.clone(), expected: expected.clone(), found: found.clone() })
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
