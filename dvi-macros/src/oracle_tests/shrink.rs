//! The smallest system that still fails, by removing one part after the other.

use super::formula::{Formula, Loops};
use super::system::{Gauge, System};

/// The smallest system that `fails` and that single removals reach.
pub(super) fn smallest(system: &System, fails: impl Fn(&System) -> bool) -> System {
    let mut smallest = system.clone();
    loop {
        let smaller = smaller_systems(&smallest).into_iter().find(|candidate| fails(candidate));
        match smaller {
            Some(smaller) => smallest = smaller,
            None => return smallest,
        }
    }
}

fn smaller_systems(system: &System) -> Vec<System> {
    let mut candidates = Vec::new();
    let mut each = |count: usize, remove: fn(&mut System, usize)| {
        candidates.extend((0..count).map(|number| {
            let mut smaller = system.clone();
            remove(&mut smaller, number);
            smaller
        }));
    };
    each(system.momenta.len(), |system, number| drop(system.momenta.remove(number)));
    each(system.forces.len(), |system, number| drop(system.forces.remove(number)));
    each(system.constraints.len(), |system, number| drop(system.constraints.remove(number)));
    if system.gauge != Gauge::None {
        candidates.push(System { gauge: Gauge::None, ..system.clone() });
    }
    if system.dissipation.is_some() {
        candidates.push(System { dissipation: None, ..system.clone() });
    }
    if system.time_transform.is_some() {
        candidates.push(system.clone().without_time_transform());
    }
    let mut copy = system.clone();
    let formulas: Vec<Formula> = copy.formulas_mut().into_iter().map(|formula| formula.clone()).collect();
    for (place, formula) in formulas.iter().enumerate() {
        let weight = formula.weight();
        let mut variants = smaller_formulas(formula);
        variants.retain(|variant| variant.weight() < weight);
        variants.sort_by_key(Formula::weight);
        for variant in variants {
            let mut smaller = system.clone();
            *smaller.formulas_mut().remove(place) = variant;
            candidates.push(smaller);
        }
    }
    candidates
}

/// All formulas that one replacement makes of this one.
fn smaller_formulas(formula: &Formula) -> Vec<Formula> {
    let mut variants = vec![Formula::Number("1")];
    match formula {
        Formula::Sum(loops, level, .., body) => {
            let once = (**body).clone();
            variants.push(match loops {
                Loops::Single | Loops::Product => once.without_level(*level),
                Loops::Pairs | Loops::OrderedPairs => once.without_level(level + 1).without_level(*level),
            });
        }
        other => variants.extend(other.parts()),
    }
    for (place, part) in formula.parts().iter().enumerate() {
        for part in smaller_formulas(part) {
            let mut variant = formula.clone();
            *variant.parts_mut().remove(place) = part;
            variants.push(variant);
        }
    }
    variants
}
