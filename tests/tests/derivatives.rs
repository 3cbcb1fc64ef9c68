//! Generated functions of compiled systems against an independent oracle: all functions of the language, and
//! what parameters may be. Formulas of every form are held against the oracle of `dvi-macros`.

mod asked;
mod functions;
mod indices;
mod language;
mod limits;
pub(crate) mod oracle;
mod self_check;
mod shapes;

use dvi_tests::zoo::functions::{Branches, Driven, EveryFunction, OwnFunction};
use dvi_tests::zoo::language::{Corners, Elastic, Material, Nested};
use dvi_tests::zoo::shapes::{Borrowing, Chain, FullLagrangian};

macro_rules! systems {
    ($($name:ident: $system:expr;)*) => {$(
        #[test]
        fn $name() {
            oracle::agrees(&$system);
        }
    )*};
}

const TABLE: [[f64; 3]; 3] = [[0.3, -0.7, 1.1], [0.4, 0.9, -0.2], [-1.3, 0.6, 0.8]];

systems! {
    every_function: EveryFunction {};
    branches: Branches { edge: 0.3 };
    explicit_time: Driven { depth: 0.4, omega: 1.3 };
    functions_of_the_user: OwnFunction {};
    run_time_size: Chain { n: 4, k: vec![0.5, 1.5, 2.5], mass: 1.25 };
    borrowed_parameters: Borrowing { weights: &[0.5, -1.5, 2.0], coupling: &TABLE, scale: &0.25 };
    full_lagrangian: FullLagrangian { c: 0.7 };
    sizes_that_are_sums: Nested::<3> {
        material: Material { masses: vec![0.5, 1.5], elastic: Elastic { k: 2.5 } },
    };
    smaller_and_larger: Corners;
}
