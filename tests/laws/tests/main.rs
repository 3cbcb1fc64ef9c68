//! What is asked of every scheme in the table, [`dvi_laws`].

mod between;
mod checkpoint;
mod equations;
mod failure;
mod forms;
mod iterations;
mod mistakes;
mod momenta;
mod motion;
mod order;
mod reversal;
mod solvers;
mod structure;

use core::fmt::Debug;
use dvi_tests::Outcome;

/// Asks the law of every case, and says where it does not hold.
#[track_caller]
fn ask<C: Debug>(cases: &[C], law: impl Fn(&C) -> Outcome) {
    assert!(!cases.is_empty());
    let broken = |case| law(case).err().map(|error| format!("\n{case:?}: {error}"));
    let broken: Vec<String> = cases.iter().filter_map(broken).collect();
    assert!(broken.is_empty(), "{} of {}:{}", broken.len(), cases.len(), broken.concat());
}

/// That a number is small.
fn below(found: f64, bound: f64, what: &str) -> Outcome {
    if found < bound { Ok(()) } else { Err(format!("{what}: {found:e}, not below {bound:e}").into()) }
}

/// A test of the law for each kind of system, so that they share the processor.
macro_rules! of_every_kind {
    ($law:expr) => {
        crate::of_every_kind!($law, affine at_large in_class separable regular constrained nonholonomic);
    };
    ($law:expr, $($kind:ident)+) => {$(
        #[test]
        fn $kind() {
            crate::ask(&dvi_laws::$kind(), $law);
        }
    )+};
}
use of_every_kind;
