//! Generated functions against an independent oracle.
//!
//! A system of the tests is a tree of its own. Its text goes through the macro as a user's would, and the
//! Rust that comes out is run by an interpreter; the oracle evaluates the tree on second-order jets, and
//! every generated function and every declared structure is compared. Nothing here shares code with the
//! compiler, or looks inside of it.
//!
//! There are random systems in the whole language, all formulas of a small grammar up to a certain size,
//! and systems of which one is known to have been wrong once. `cargo test -p dvi-macros --lib
//! oracle_tests -- --nocapture` prints how many of which kind there were. More random systems come with
//! `DVI_SYSTEMS=100000`, others with `DVI_SEED=7`, and larger formulas of the grammar with `DVI_NODES=7`.

mod by_hand;
mod compare;
mod evaluate;
mod exhaustive;
mod expand;
mod forces;
mod formula;
pub(crate) mod functions;
mod generate;
mod jet;
mod language;
mod parts;
pub(crate) mod random;
mod rate;
mod read;
mod rotations;
mod rust;
mod shrink;
mod spinors;
mod structure;
mod summary;
mod system;
mod vectors;
mod write;

use formula::Formula;
use random::Random;
use summary::Summary;
use system::System;

use crate::syntax::Kind;

/// The number of random systems of a plain run.
const SYSTEMS: u64 = 500;

/// A number from the environment.
fn setting(name: &str, default: u64) -> u64 {
    match std::env::var(name) {
        Ok(text) => text.parse().unwrap_or_else(|_| panic!("{name} is a number, not {text}")),
        Err(_) => default,
    }
}

/// Runs on a stack as large as the compiler's.
fn on_large_stack(run: impl FnOnce() + Send + 'static) {
    let thread = std::thread::Builder::new().stack_size(8 << 20).spawn(run);
    if let Err(panic) = thread.expect("a thread").join() {
        std::panic::resume_unwind(panic);
    }
}

/// A random system as a user writes it: which attribute, its arguments, and the struct.
pub(crate) fn random_system(seed: u64) -> (Kind, String, String) {
    let system = generate::system(&mut Random::new(seed));
    let kind = if system.is_regular() { Kind::Regular } else { Kind::Degenerate };
    (kind, system.attribute(), system.item())
}

fn random_systems(part: u64) {
    on_large_stack(move || {
        let (count, seed) = (setting("DVI_SYSTEMS", SYSTEMS), setting("DVI_SEED", 0));
        let mut summary = Summary::default();
        for number in (0..count).filter(|number| number % 2 == part) {
            let start = (seed << 40) + number;
            let system = generate::system(&mut Random::new(start));
            summary.examine(&system, start);
        }
        if (count, seed) == (SYSTEMS, 0) {
            summary.expect_each_part();
        }
        summary.conclude("random systems");
    });
}

#[test]
fn random_systems_of_even_number() {
    random_systems(0);
}

#[test]
fn random_systems_of_odd_number() {
    random_systems(1);
}

/// All formulas of the grammar, of fewer nodes than elsewhere by this number, each in a system.
fn grammar(fewer: usize, what: &'static str, system: fn(usize, Formula) -> System) {
    on_large_stack(move || {
        let mut summary = Summary::default();
        let formulas = exhaustive::all(setting("DVI_NODES", 6) as usize - fewer);
        for (number, formula) in formulas.into_iter().enumerate() {
            summary.examine(&system(number, formula), number as u64);
        }
        summary.conclude(what);
    });
}

#[test]
fn every_small_formula_as_hamiltonian() {
    grammar(0, "Hamiltonians of the grammar", exhaustive::as_hamiltonian);
}

/// A gauge is differentiated three times, which takes longer.
#[test]
fn every_small_formula_as_gauge() {
    grammar(1, "gauges of the grammar", exhaustive::as_gauge);
}

#[test]
fn every_small_formula_as_kinetic_energy() {
    grammar(0, "kinetic energies of the grammar", exhaustive::as_kinetic_energy);
}
