//! Names that all formulas of a system share.

use dvi_core::prelude::*;

/// The names of a system are those of its formulas.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 - k * r,
    let = {
        let x = 1.0;
        let k = 2.0;
        let t = 0.5;
        let sum = |a| a;
        let r = x.hypot(y);
        let r = 2.0 * r;
    },
)]
struct Hides {
    k: f64,
}

/// A gap has no velocities, the Lagrangian has.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (speed2 + square(dot(y))) / 2.0 - y,
    impact = [y, y - speed2, 1.0 - along(x)],
    let = {
        let speed2 = dot(x).powi(2);
        let square = |a| a * a;
        let along = |a| a * dot(x);
    },
)]
struct Moves;

#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = form + y,
    hamiltonian = form + x * x,
    let = {
        let form = x * d(y);
        let mixed = x * d(y) + x;
    },
)]
struct OfOneForm;

/// Names see those before them.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 - energy - series(x) - first(y),
    let = {
        let energy = k * r;
        let r = x.hypot(y);
        let series = |a| 1.0 + a * series(a);
        let first = |a| second(a);
        let second = |a| first(a);
    },
)]
struct Order {
    k: f64,
}

/// What is wrong in a definition is said once.
#[lagrangian(
    coordinates(x[3]),
    lagrangian = sum(0..3, |i| dot(x[i]).powi(2) - well(x[i]) - here - stiff),
    momenta(p = here + stiff, q = well(x[0])),
    let = {
        let well = |a| a * a + stifness * a;
        let here = x[i].powi(2);
        let stiff = stiffness * depht;
    },
)]
struct Once {
    stiffness: f64,
}

/// A name that stands before is no function; one that was refused is refused once.
#[lagrangian(
    coordinates(x),
    lagrangian = dot(x).powi(2) / 2.0 - a(x) - sum,
    let = {
        let a = x;
        let sum = x;
    },
)]
struct Called;

macro_rules! one {
    ($name:ident: $($arguments:tt)*) => {
        #[lagrangian(coordinates(x), $($arguments)*)]
        struct $name;
    };
}

// Where a definition was lost, no name is unknown.
one! { NoDefinitions: lagrangian = dot(x).powi(2) / 2.0 - r2 - well(x), let = { r2 = x * x; x + 1.0 } }
one! { NoNames: lagrangian = dot(x).powi(2) / 2.0 - r2, let = x * x }
one! { Nothing: lagrangian = dot(x).powi(2) / 2.0, let = {} }
one! { OtherWord: lagrangian = dot(x).powi(2) / 2.0 - r2, where = { let r2 = x * x; } }

fn main() {}
