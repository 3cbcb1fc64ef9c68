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

macro_rules! in_the_plane {
    ($name:ident: $($arguments:tt)*) => {
        #[lagrangian(
            coordinates(x, y),
            lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
            $($arguments)*
        )]
        struct $name;
    };
}

in_the_plane! { WithoutVelocitiesS: nonholonomic = x * x + y * y - 1.0 }
const _: fn() = || used(&WithoutVelocitiesS);

in_the_plane! { WithoutVelocitiesU: nonholonomic = [dot(x) - dot(x) + y, dot(y)] }
in_the_plane! { NotAffineS: nonholonomic = dot(x).powi(2) + dot(y).powi(2) - 1.0 }
const _: fn() = || used(&NotAffineS);

in_the_plane! { NotAffineW: nonholonomic = if dot(x) > 0.0 { dot(y) } else { dot(y) - dot(x) } }

in_the_plane! { NotAffineY: nonholonomic = dot(y) - dot(x).max(0.0) }

#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    functions(f = [f64::sin, f64::cos, f64::tan]),
    nonholonomic = [{ let speed = dot(x); x * f(speed) }, dot(x).mul_add(dot(y), x) - slope(x, dot(y))],
)]
struct NotAffineZ<F> {
    slope: F,
}

in_the_plane! { VelocitiesS: nonholonomic = xdot - y }
in_the_plane! { VelocitiesT: nonholonomic = d(x) - y }

#[lagrangian(
    coordinates(x, y, z),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2) + dot(z).powi(2)) / 2.0,
    constraint = z - x,
    nonholonomic(i in 0..1) = dot(x) - y * dot(z),
)]
struct BothT;

in_the_plane! { HeadsU: nonholonomic(x) = dot(x) - y }
in_the_plane! { FormulasS: nonholonomic = dot(x) == y * dot(y) }
in_the_plane! { FormulasU: nonholonomic = dot(x) >= 0.0 }

in_the_plane! { TwiceS: nonholonomic = [dot(x) - y * dot(y), 2.0 * (y * dot(y) - dot(x))] }

#[lagrangian(
    coordinates(x),
    lagrangian = dot(x).powi(2) / 2.0,
    nonholonomic = dot(x) - t,
    nonholonomic = dot(x) - x,
)]
struct TwiceT;

in_the_plane! { NamesS: non_holonomic = dot(x) - y }
const _: fn() = || used(&NamesS);

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * x, nonholonomic = d(x) - y)]
struct DegenerateS;

// A method that keeps no constraints.
in_the_plane! { WithoutConstraints: nonholonomic = dot(x) - y * dot(y) }
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
