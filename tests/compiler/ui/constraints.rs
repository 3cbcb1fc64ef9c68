//! Mistakes in constraints.

use dvi_core::prelude::*;
use dvi_core::HolonomicLagrangian;

/// That a system with a mistake in it is taken for one with constraints.
fn used<S: HolonomicLagrangian>(system: &S) {
    system.constraint(&[1.0, 2.0], 0.0, &mut [0.0]);
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

in_the_plane! { VelocitiesS: constraint = x * dot(x) + y * dot(y) }
const _: fn() = || used(&VelocitiesS);

in_the_plane! { VelocitiesT: constraint = x * dot_x + y }
in_the_plane! { WithoutCoordinatesS: constraint = 1.0 - t * t }

macro_rules! in_a_row {
    ($name:ident: $($arguments:tt)*) => {
        #[lagrangian(
            coordinates(x[n]),
            lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
            $($arguments)*
        )]
        struct $name {
            n: usize,
            rods: Vec<f64>,
        }
    };
}

in_a_row! { WithoutItsIndexS: constraint(i in 0..n - 1) = x[0] - x[1] }
in_the_plane! { EmptyList: constraint = [] }
const _: fn() = || used(&EmptyList);

in_the_plane! { WithoutValueS: constraint }
in_the_plane! { OnACoordinate: constraint(x) = x * x + y * y - 1.0 }
in_a_row! { HeadsS: constraint() = x[0] }
in_a_row! { HeadsX: constraint(i in 0..n, j in 0..n, k in 0..n) = x[i] - x[j] + x[k] }
in_a_row! { RangesV: constraint(i in 0..m) = x[i] }
in_a_row! { ClosuresS: constraint = |i| x[i] - rods[i] }
in_the_plane! { EquationsS: constraint = x * x + y * y == 1.0 }
in_the_plane! { EquationsX: constraint == x - y }
in_the_plane! { Inequalities: constraint = x * x + y * y <= 1.0 }
in_the_plane! { ListsS: constraint = [[x, y]] }
in_a_row! { ListsT: constraint(i in 0..n) = [x[i], x[i] - rods[i]] }
in_a_row! { IndicesS: constraint(i in 0..n) = x - rods[i] }
in_the_plane! { TwiceS: constraint = x - y, constraint = 2.0 * (x - y) }
in_the_plane! { TwiceT: constraint = [x, y, x * y - t] }
in_the_plane! { NamesS: constraints = x - y }
const _: fn() = || used(&NamesS);

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * x, constraint = x - y)]
struct DegenerateS;

#[lagrangian(coordinates(x, y), lagrangian = dot(x).powi(2) / 2.0, constraint = x - y)]
struct Massless;

/// Methods that keep no constraints.
mod without_constraints {
    use super::*;

    #[lagrangian(coordinates(x, y), lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0, constraint = x * x + y * y - 1.0)]
    struct Pendulum;

    fn start() -> PendulumState {
        PendulumState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 }
    }

    fn run() {
        let _ = Integrator::new(&Pendulum, Variational::trapezoid(), 0.1, start());
        let _ = Integrator::new(&Pendulum, Gauss::<2>::new(), 0.1, start());
    }
}

/// What is for constraints, without any.
mod without_any {
    use super::*;

    #[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0)]
    struct Free;
    const _: fn() = || used(&Free);
}

/// Families with two indices.
#[lagrangian(
    coordinates(x[4]),
    lagrangian = sum(0..4, |j| dot(x[j]).powi(2) / 2.0),
    constraint(i in 0..2, i in 0..2) = x[i],
)]
struct PairsSameName;

macro_rules! of_four {
    ($name:ident: $($arguments:tt)*) => {
        #[lagrangian(
            coordinates(x[4]),
            lagrangian = sum(0..4, |j| dot(x[j]).powi(2) / 2.0),
            $($arguments)*
        )]
        struct $name;
    };
}

of_four! { PairsUnused: constraint(i in 0..2, j in i + 1..4) = x[i].powi(2) }
of_four! { PairsRanges:
    constraint(i in 0..2, j in 0..(i + 1) % 2) = x[i] * x[j],
    constraint(i in 0..2, j = 0..2) = x[i] * x[j],
    constraint(i in 0..j, j in 0..2) = x[i] * x[j],
    constraint(i in 0..2, j in i + 1..4) >= x[i] * x[j]
}

of_four! { PairsTooMany: constraint(i in 0..4, j in i..4) = x[i] * x[j] - 1.0 }

fn main() {}
