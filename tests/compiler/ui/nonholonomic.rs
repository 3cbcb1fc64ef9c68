//! Mistakes in constraints of the velocities.

use dvi_core::NonholonomicLagrangian;
use dvi_core::prelude::*;

/// That a system with a mistake in it is taken for one that can be stepped.
fn moved<S: RegularLagrangian>(system: S, state: S::State<f64>) {
    let _ = Integrator::new(&system, Variational::trapezoid(), 0.1, state);
}

/// That a system with a mistake in it is taken for one with constraints of the velocities.
fn used<S: NonholonomicLagrangian>(system: &S) {
    system.velocity_constraint(&[1.0, 2.0], &[0.0, 1.0], 0.0, &mut [0.0]);
    let _ = system.multipliers();
}

#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    nonholonomic = x * x + y * y - 1.0,
)]
struct WithoutVelocitiesS;
const _: fn() = || used(&WithoutVelocitiesS);

#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    nonholonomic = [dot(x) - dot(x) + y, dot(y)],
)]
struct WithoutVelocitiesU;

#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    nonholonomic = dot(x).powi(2) + dot(y).powi(2) - 1.0,
)]
struct NotAffineS;
const _: fn() = || used(&NotAffineS);

#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    nonholonomic = dot(y) / dot(x) - x,
)]
struct NotAffineV;

#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    nonholonomic = if dot(x) > 0.0 { dot(y) } else { dot(y) - dot(x) },
)]
struct NotAffineW;

#[lagrangian(
    coordinates(x[n]),
    lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
    nonholonomic(i in 1..n) = dot(x[i]) * sum(0..i, |j| dot(x[j])),
)]
struct NotAffineX {
    n: usize,
}

#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    nonholonomic = dot(y) - dot(x).max(0.0),
)]
struct NotAffineY;

#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    functions(f = [f64::sin, f64::cos, f64::tan]),
    nonholonomic = [{ let speed = dot(x); x * f(speed) }, dot(x).mul_add(dot(y), x) - slope(x, dot(y))],
)]
struct NotAffineZ<F> {
    slope: F,
}

#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    nonholonomic = xdot - y,
)]
struct VelocitiesS;

#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    nonholonomic = d(x) - y,
)]
struct VelocitiesT;

/// Constraints of both kinds.
#[lagrangian(
    coordinates(x, y, z),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2) + dot(z).powi(2)) / 2.0,
    nonholonomic = dot(x) - y * dot(z),
    constraint = z - x,
    constraint = z - y,
)]
struct BothS;
const _: fn() = || used(&BothS);

#[lagrangian(
    coordinates(x, y, z),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2) + dot(z).powi(2)) / 2.0,
    constraint = z - x,
    nonholonomic(i in 0..1) = dot(x) - y * dot(z),
)]
struct BothT;

#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    nonholonomic(x) = dot(x) - y,
)]
struct HeadsU;

#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    nonholonomic = dot(x) == y * dot(y),
)]
struct FormulasS;

#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    nonholonomic = dot(x) >= 0.0,
)]
struct FormulasU;

#[lagrangian(
    coordinates(x[n]),
    lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
    nonholonomic(i in 0..n) = dot(x[0]),
)]
struct FormulasW {
    n: usize,
}

#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    nonholonomic = [dot(x) - y * dot(y), 2.0 * (y * dot(y) - dot(x))],
)]
struct TwiceS;

#[lagrangian(
    coordinates(x),
    lagrangian = dot(x).powi(2) / 2.0,
    nonholonomic = dot(x) - t,
    nonholonomic = dot(x) - x,
)]
struct TwiceT;

#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    non_holonomic = dot(x) - y,
)]
struct NamesS;
const _: fn() = || used(&NamesS);

#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    rolling = dot(x) - y,
)]
struct NamesT;

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * x, nonholonomic = d(x) - y)]
struct DegenerateS;

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * x, rolling = d(x) - y, nonholonomic(i in 0..2) = x)]
struct DegenerateT;

/// A method that keeps no constraints.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    nonholonomic = dot(x) - y * dot(y),
)]
struct WithoutConstraints;
const _: fn() =
    || moved(WithoutConstraints, WithoutConstraintsState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });

/// What is for constraints of the velocities, with others or without any.
mod without_any {
    use super::*;

    #[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0)]
    struct Free;

    #[lagrangian(coordinates(x, y), lagrangian = dot(x).powi(2) / 2.0 + dot(y).powi(2), constraint = x - y)]
    struct Beads;
    const _: fn() = || used(&Free);
    const _: fn() = || used(&Beads);
}

fn main() {}
