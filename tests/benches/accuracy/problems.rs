//! The three problems, each with all methods.

use std::f64::consts::TAU;
use std::hint::black_box;

use dvi_core::prelude::*;
use dvi_examples::models::{
    Case, FourPoints, FourVortices, Kepler, KeplerState, Orbit, OuterPlanets, OuterSolarSystem,
    outer_solar_system, quasi_periodic,
};

use crate::fields;
use crate::ours::Setting;
use crate::problem::{Problem, Scale, steps_up_to, tolerances};
use crate::rivals::Task;

/// Steps of methods of low order: each number twice the one before.
fn coarse(most: f64) -> Vec<u64> {
    steps_up_to(most, 2.0, 9)
}

/// Steps of methods of high order: an eighth more each time.
fn fine(most: f64) -> Vec<u64> {
    steps_up_to(most, 1.125, 34)
}

/// The program that the others are compared with.
pub(crate) const REFERENCE: &str = "ode_solvers Dop853";
pub(crate) const GAUSS_16: &str = "Gauss 16, in lanes";
/// The same with stages that are solved as far as an energy is to be held to 1e-10, and no further.
pub(crate) const TO_TOLERANCE: &str = "Gauss 16, in lanes, tolerance 1e-12";
pub(crate) const KAHAN_LI: &str = "Kahan–Li 8 of Verlet";

/// Gauss collocation with 2, 3, 4 and 8 stages, up to these numbers of steps.
macro_rules! gauss {
    ($on:ident, $four:expr, $six:expr, $eight:expr, $sixteen:expr) => {{
        let stopping = Stopping { tolerance: 1e-12, ..Stopping::default() };
        let to_tolerance = Gauss { stopping, ..Gauss::<8>::new().in_lanes() };
        [
            $on.method("Gauss 4, in lanes", Gauss::<2>::new().in_lanes(), fine($four)),
            $on.method("Gauss 6, in lanes", Gauss::<3>::new().in_lanes(), fine($six)),
            $on.method("Gauss 8, in lanes", Gauss::<4>::new().in_lanes(), fine($eight)),
            $on.method("Gauss 16, one by one", Gauss::<8>::new(), fine($sixteen)),
            $on.method(GAUSS_16, Gauss::<8>::new().in_lanes(), fine($sixteen)),
            $on.method(TO_TOLERANCE, to_tolerance, fine($sixteen)),
            $on.controlled(
                "Gauss 16, in lanes, steps by error",
                Gauss::<8>::new().in_lanes(),
                &tolerances(15),
            ),
        ]
    }};
}

/// Interior displacements with 5 and 9 nodes, up to these numbers of steps.
macro_rules! galerkin {
    ($on:ident, $eight:expr, $sixteen:expr) => {{
        let eight = Galerkin { summation: Summation::Compensated, ..Galerkin::<5>::new() };
        let sixteen = Galerkin { summation: Summation::Compensated, ..Galerkin::<9>::new() };
        [
            $on.method("Galerkin 8, in lanes", eight.in_lanes(), fine($eight)),
            $on.method("Galerkin 16, one by one", sixteen, fine($sixteen)),
            $on.method("Galerkin 16, in lanes", sixteen.in_lanes(), fine($sixteen)),
        ]
    }};
}

/// Verlet's steps and compositions of them, up to these numbers of steps.
macro_rules! separable {
    ($on:ident, $two:expr, $composed:expr) => {{
        let plain = Variational::trapezoid();
        let compensated = Variational { summation: Summation::Compensated, ..Variational::trapezoid() };
        let on_digits = "Kahan–Li 8 of Verlet, compensated";
        vec![
            $on.method("Verlet", plain, coarse($two)),
            $on.method("Suzuki 4 of Verlet", Composition::suzuki(plain), coarse(10.0 * $composed)),
            $on.method(KAHAN_LI, Composition::kahan_li_8(plain), fine($composed)),
            $on.method(on_digits, Composition::kahan_li_8(compensated), fine($composed)),
        ]
    }};
}

/// Four equal vortices.
pub(crate) fn vortices() -> Problem {
    fn begin() -> (FourVortices, FourPoints) {
        let Case { vortices, start } = quasi_periodic();
        (black_box(vortices), start)
    }
    let (FourVortices { gamma }, FourPoints { x, y }) = begin();
    let (field, end, scale) = (fields::Vortices::new(gamma), 1000.0, Scale::Absolute);
    let start = std::array::from_fn(|i| if i < 4 { x[i] } else { y[i - 4] });
    let on = Setting { begin, end, scale };
    let mut methods = vec![
        on.method("σ = 0", Sigma { parasitic_limit: None, ..Sigma::leapfrog() }, coarse(1e7)),
        on.method("σ = ½", Sigma::midpoint(), coarse(2e6)),
        on.method("Suzuki 4 of the midpoint rule", Composition::suzuki(Gauss::<1>::new()), coarse(2e5)),
        on.method("Kahan–Li 8 of the midpoint rule", Composition::kahan_li_8(Gauss::<1>::new()), fine(2e4)),
    ];
    methods.extend(gauss!(on, 4e5, 4e4, 2e4, 4e3));
    methods.push(Task { field, start, end, scale, absolute: 1.0 }.method(&tolerances(15)));
    Problem { name: "vortices", title: "four vortices, T = 1000", error: "|ΔH|", methods }
}

/// A Kepler orbit of eccentricity 0.6.
pub(crate) fn kepler() -> Problem {
    fn begin() -> (Kepler, KeplerState) {
        (Kepler {}, black_box(Orbit { e: 0.6 }.pericentre()))
    }
    let (_, KeplerState { x, y, dot_x, dot_y }) = begin();
    let (end, scale) = (100.0 * TAU, Scale::Relative);
    let on = Setting { begin, end, scale };
    let mut methods = separable!(on, 8e6, 5e4);
    methods.extend(gauss!(on, 1e6, 1e5, 5e4, 1e4));
    methods.extend(galerkin!(on, 5e4, 1e4));
    let start = [x, y, dot_x, dot_y];
    let task = Task { field: fields::Kepler, start, end, scale, absolute: 1.0 };
    methods.push(task.method(&tolerances(15)));
    Problem { name: "kepler", title: "Kepler, e = 0.6, 100 periods", error: "|ΔH|/|H|", methods }
}

/// The sun and the outer planets.
pub(crate) fn planets() -> Problem {
    fn begin() -> (OuterSolarSystem, OuterPlanets) {
        black_box(outer_solar_system())
    }
    let (OuterSolarSystem { g, mass }, at) = begin();
    let (field, end, scale) = (fields::Planets::new(g, mass), 1e6, Scale::Relative);
    let on = Setting { begin, end, scale };
    let mut methods = separable!(on, 4e6, 3e4);
    methods.extend(gauss!(on, 4e5, 4e4, 2e4, 5e3));
    methods.extend(galerkin!(on, 2e4, 5e3));
    let flat = |of: [[f64; 3]; 6]| -> [f64; 18] { std::array::from_fn(|i| of[i % 6][i / 6]) };
    let (q, v) = (flat(at.r), flat(at.dot_r));
    let start: [f64; 36] = std::array::from_fn(|i| if i < 18 { q[i] } else { v[i - 18] });
    // Velocities are a thousandth of the positions, and have their share of the tolerance.
    let task = Task { field, start, end, scale, absolute: 1e-3 };
    methods.push(task.method(&tolerances(15)));
    Problem { name: "planets", title: "outer solar system, 10⁶ days", error: "|ΔH|/|H|", methods }
}
