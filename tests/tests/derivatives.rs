//! Every generated derivative of every kind of system against an independent oracle.

mod asked;
mod functions;
mod gauges;
mod indices;
mod language;
mod lattices;
mod limits;
pub(crate) mod oracle;
mod particles;
mod regular;
mod self_check;
mod shapes;
mod structure;
mod sums;
mod tangent;

use dvi_tests::systems::{LotkaVolterra, PointVortices};
use dvi_tests::zoo::functions::{Branches, Driven, EveryFunction, OwnFunction};
use dvi_tests::zoo::gauges::{OneSided, OneSidedShifted, SymmetricShifted};
use dvi_tests::zoo::language::{Corners, Elastic, Material, Neighbours, Nested, Toeplitz};
use dvi_tests::zoo::lattices::{AblowitzLadik, Schroedinger};
use dvi_tests::zoo::particles::{GuidingCentre, PlaneParticle, SphereVortices};
use dvi_tests::zoo::shapes::{Borrowing, Chain, FullLagrangian};
use dvi_tests::zoo::sums::{FunctionsOfSums, NestedSums, OrderedPairs, Staircase};

macro_rules! systems {
    ($($name:ident: $system:expr;)*) => {$(
        #[test]
        fn $name() {
            let system = $system;
            oracle::agrees(&system);
            structure::agrees(&system);
        }
    )*};
}

const A: [f64; 2] = [1.0, 1.0];
const B: [f64; 2] = [-1.0, -2.0];
const TABLE: [[f64; 3]; 3] = [[0.3, -0.7, 1.1], [0.4, 0.9, -0.2], [-1.3, 0.6, 0.8]];

systems! {
    vortices_in_the_plane: PointVortices { gamma: [1.0, -0.5, 2.0, 0.75] };
    vortices_on_the_sphere: SphereVortices { gamma: [1.0, -0.5, 2.0] };
    lotka_volterra_symmetric: LotkaVolterra { a: A, b: B };
    lotka_volterra_one_sided: OneSided { a: A, b: B };
    lotka_volterra_one_sided_shifted: OneSidedShifted { a: A, b: B };
    lotka_volterra_symmetric_shifted: SymmetricShifted { a: A, b: B };
    charged_particle_in_the_plane: PlaneParticle { b: 1.5, ripple: 0.3, e: -0.7 };
    guiding_centre: GuidingCentre { mu: 0.4, shear: 0.6 };
    discrete_schroedinger: Schroedinger::<5> { lambda: 0.8, hopping: [1.0, 0.25] };
    ablowitz_ladik: AblowitzLadik::<4> {};
    every_function: EveryFunction {};
    branches: Branches { edge: 0.3 };
    explicit_time: Driven { depth: 0.4, omega: 1.3 };
    functions_of_the_user: OwnFunction {};
    functions_of_sums: FunctionsOfSums { m: [0.7, 1.1, 1.9] };
    nested_sums: NestedSums { c: TABLE };
    ranges_that_depend_on_an_index: Staircase::<4> {};
    ordered_pairs: OrderedPairs { c: TABLE };
    run_time_size: Chain { n: 4, k: vec![0.5, 1.5, 2.5], mass: 1.25 };
    one_pendulum: Chain { n: 1, k: Vec::new(), mass: 1.25 };
    borrowed_parameters: Borrowing { weights: &[0.5, -1.5, 2.0], coupling: &TABLE, scale: &0.25 };
    full_lagrangian: FullLagrangian { c: 0.7 };
    differences_of_indices: Toeplitz { g: [0.7, -0.4, 1.3] };
    differences_of_indices_of_any_size: Neighbours::<5> { g: [0.7, -0.4, 1.3, 0.2, -0.9].into() };
    one_body_without_a_neighbour: Neighbours::<1> { g: Box::default() };
    sizes_that_are_sums: Nested::<3> {
        material: Material { masses: vec![0.5, 1.5], elastic: Elastic { k: 2.5 } },
    };
    smaller_and_larger: Corners;
}
