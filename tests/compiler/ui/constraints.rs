//! Mistakes in constraints.

use dvi_core::prelude::*;
use dvi_core::HolonomicLagrangian;

/// That a system with a mistake in it is taken for one with constraints.
fn used<S: HolonomicLagrangian>(system: &S) {
    system.constraint(&[1.0, 2.0], 0.0, &mut [0.0]);
    let _ = system.multipliers();
}

#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    constraint = x * dot(x) + y * dot(y),
)]
struct VelocitiesS;
const _: fn() = || used(&VelocitiesS);

#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    constraint = x * dot_x + y,
)]
struct VelocitiesT;

#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    constraint = 1.0 - t * t,
)]
struct WithoutCoordinatesS;

#[lagrangian(
    coordinates(x[n]),
    lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
    constraint(i in 0..n) = rods[i],
)]
struct WithoutCoordinatesT {
    n: usize,
    rods: Vec<f64>,
}

#[lagrangian(
    coordinates(x[n]),
    lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
    constraint(i in 0..n - 1) = x[0] - x[1],
)]
struct WithoutItsIndexS {
    n: usize,
    rods: Vec<f64>,
}

#[lagrangian(
    coordinates(x[n]),
    lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
    constraint(i in 0..n) = sum(0..n, |i| x[i]),
)]
struct WithoutItsIndexT {
    n: usize,
    rods: Vec<f64>,
}

#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    constraint = [],
)]
struct EmptyList;
const _: fn() = || used(&EmptyList);

#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    constraint,
)]
struct WithoutValueS;

#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    constraint(x) = x * x + y * y - 1.0,
)]
struct OnACoordinate;

#[lagrangian(
    coordinates(x[n]),
    lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
    constraint() = x[0],
)]
struct HeadsS {
    n: usize,
    rods: Vec<f64>,
}

#[lagrangian(
    coordinates(x[n]),
    lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
    constraint(i in 0..n, j in 0..n, k in 0..n) = x[i] - x[j] + x[k],
)]
struct HeadsX {
    n: usize,
    rods: Vec<f64>,
}

#[lagrangian(
    coordinates(x[n]),
    lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
    constraint(i in 0..m) = x[i],
)]
struct RangesV {
    n: usize,
    rods: Vec<f64>,
}

#[lagrangian(
    coordinates(x[n]),
    lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
    constraint = |i| x[i] - rods[i],
)]
struct ClosuresS {
    n: usize,
    rods: Vec<f64>,
}

#[lagrangian(
    coordinates(x[n]),
    lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
    constraint = [x[0], |i| x[i]],
)]
struct ClosuresT {
    n: usize,
    rods: Vec<f64>,
}

#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    constraint = x * x + y * y == 1.0,
)]
struct EquationsS;

#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    constraint = [x == y, y - 1.0],
)]
struct EquationsW;

#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    constraint == x - y,
)]
struct EquationsX;

#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    constraint = x * x + y * y <= 1.0,
)]
struct Inequalities;

#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    constraint = [[x, y]],
)]
struct ListsS;

#[lagrangian(
    coordinates(x[n]),
    lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
    constraint(i in 0..n) = [x[i], x[i] - rods[i]],
)]
struct ListsT {
    n: usize,
    rods: Vec<f64>,
}

#[lagrangian(
    coordinates(x[n]),
    lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
    constraint(i in 0..n) = x - rods[i],
)]
struct IndicesS {
    n: usize,
    rods: Vec<f64>,
}

#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    constraint = x - y,
    constraint = 2.0 * (x - y),
)]
struct TwiceS;

#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    constraint = [x, y, x * y - t],
)]
struct TwiceT;

#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    constraints = x - y,
)]
struct NamesS;
const _: fn() = || used(&NamesS);

#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    holonomic = [x - y],
)]
struct NamesT;

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * x, constraint = x - y)]
struct DegenerateS;

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * x, constraint(i in 0..2) = x, constraints = [x, y])]
struct DegenerateT;

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
        let _ = Integrator::new(&Pendulum, RungeKutta::classical(), 0.1, start());
        let _ = Integrator::new(&Pendulum, Newmark::new(0.25), 0.1, start());
        let _ = Integrator::new(&Pendulum, Sigma::midpoint(), 0.1, start());
        // Its limit would not be watched.
        let limited = EnergyLimit { method: Variational::midpoint(), limit: 1e-6 };
        let _ = Integrator::new(&Pendulum, Constrained::new(limited), 0.1, start());
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

#[lagrangian(
    coordinates(x[4]),
    lagrangian = sum(0..4, |j| dot(x[j]).powi(2) / 2.0),
    constraint(i in 0..2, j in i + 1..4) = x[i].powi(2),
)]
struct PairsUnused;

#[lagrangian(
    coordinates(x[4]),
    lagrangian = sum(0..4, |j| dot(x[j]).powi(2) / 2.0),
    constraint(i in 0..2, j in 0..(i + 1) % 2) = x[i] * x[j],
    constraint(i in 0..2, j = 0..2) = x[i] * x[j],
    constraint(i in 0..j, j in 0..2) = x[i] * x[j],
    constraint(i in 0..2, j in i + 1..4) >= x[i] * x[j],
)]
struct PairsRanges;

#[lagrangian(
    coordinates(x[4]),
    lagrangian = sum(0..4, |j| dot(x[j]).powi(2) / 2.0),
    constraint(i in 0..4, j in i..4) = x[i] * x[j] - 1.0,
)]
struct PairsTooMany;

fn main() {}
