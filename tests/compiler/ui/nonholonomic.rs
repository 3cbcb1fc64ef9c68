//! Mistakes in constraints of the velocities.

use dvi_core::NonholonomicLagrangian;
use dvi_core::prelude::*;

/// That a system with a mistake in it is taken for one with constraints of the velocities.
fn used<S: NonholonomicLagrangian>(system: &S) {
    system.velocity_constraint(&[1.0, 2.0], &[0.0, 1.0], 0.0, &mut [0.0]);
    let _ = system.multipliers();
}

mod without_velocities {
    use super::*;

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        nonholonomic = x * x + y * y - 1.0,
    )]
    struct S;

    fn run() {
        used(&S);
    }

    #[lagrangian(
        coordinates(x[n]),
        lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
        nonholonomic(i in 0..n) = t * rods[i],
    )]
    struct T {
        n: usize,
        rods: Vec<f64>,
    }

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        nonholonomic = [dot(x) - dot(x) + y, dot(y)],
    )]
    struct U;
}

mod not_affine {
    use super::*;

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        nonholonomic = dot(x).powi(2) + dot(y).powi(2) - 1.0,
    )]
    struct S;

    fn run() {
        used(&S);
    }

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        nonholonomic = dot(x) * y - x * dot(x) * dot(y),
    )]
    struct T;

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        nonholonomic = dot(y) - dot(x).tanh(),
    )]
    struct U;

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        nonholonomic = dot(y) / dot(x) - x,
    )]
    struct V;

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        nonholonomic = if dot(x) > 0.0 { dot(y) } else { dot(y) - dot(x) },
    )]
    struct W;

    #[lagrangian(
        coordinates(x[n]),
        lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
        nonholonomic(i in 1..n) = dot(x[i]) * sum(0..i, |j| dot(x[j])),
    )]
    struct X {
        n: usize,
    }

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        nonholonomic = dot(y) - dot(x).max(0.0),
    )]
    struct Y;

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        functions(f = [f64::sin, f64::cos, f64::tan]),
        nonholonomic = [{ let speed = dot(x); x * f(speed) }, dot(x).mul_add(dot(y), x) - slope(x, dot(y))],
    )]
    struct Z<F> {
        slope: F,
    }
}

mod velocities {
    use super::*;

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        nonholonomic = xdot - y,
    )]
    struct S;

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        nonholonomic = d(x) - y,
    )]
    struct T;
}

/// Constraints of both kinds.
mod both {
    use super::*;

    #[lagrangian(
        coordinates(x, y, z),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2) + dot(z).powi(2)) / 2.0,
        nonholonomic = dot(x) - y * dot(z),
        constraint = z - x,
        constraint = z - y,
    )]
    struct S;

    fn run() {
        used(&S);
    }

    #[lagrangian(
        coordinates(x, y, z),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2) + dot(z).powi(2)) / 2.0,
        constraint = z - x,
        nonholonomic(i in 0..1) = dot(x) - y * dot(z),
    )]
    struct T;
}

mod heads {
    use super::*;

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        nonholonomic,
    )]
    struct S;

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        nonholonomic = [],
    )]
    struct T;

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        nonholonomic(x) = dot(x) - y,
    )]
    struct U;

    #[lagrangian(
        coordinates(x[n]),
        lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
        nonholonomic() = dot(x[0]),
    )]
    struct V {
        n: usize,
    }

    #[lagrangian(
        coordinates(x[n]),
        lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
        nonholonomic(i in 0..n),
    )]
    struct W {
        n: usize,
    }

    #[lagrangian(
        coordinates(x[n]),
        lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
        nonholonomic(i in 0..n) - dot(x[i]),
    )]
    struct X {
        n: usize,
    }
}

mod formulas {
    use super::*;

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        nonholonomic = dot(x) == y * dot(y),
    )]
    struct S;

    #[lagrangian(
        coordinates(x[n]),
        lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
        nonholonomic(i in 1..n) = dot(x[i]) == dot(x[i - 1]) + t,
    )]
    struct T {
        n: usize,
    }

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        nonholonomic = dot(x) >= 0.0,
    )]
    struct U;

    #[lagrangian(
        coordinates(x[n]),
        lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
        nonholonomic = |i| dot(x[i]),
    )]
    struct V {
        n: usize,
    }

    #[lagrangian(
        coordinates(x[n]),
        lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
        nonholonomic(i in 0..n) = dot(x[0]),
    )]
    struct W {
        n: usize,
    }

    #[lagrangian(
        coordinates(x[n]),
        lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
        nonholonomic = dot(x[i]),
    )]
    struct X {
        n: usize,
    }

    #[lagrangian(
        coordinates(x[3]),
        lagrangian = sum(0..3, |j| dot(x[j]).powi(2) / 2.0),
        nonholonomic(i in 0..3) = dot(x[i + 1]),
    )]
    struct Y;
}

mod twice {
    use super::*;

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        nonholonomic = [dot(x) - y * dot(y), 2.0 * (y * dot(y) - dot(x))],
    )]
    struct S;

    #[lagrangian(
        coordinates(x),
        lagrangian = dot(x).powi(2) / 2.0,
        nonholonomic = dot(x) - t,
        nonholonomic = dot(x) - x,
    )]
    struct T;
}

mod names {
    use super::*;

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        non_holonomic = dot(x) - y,
    )]
    struct S;

    fn run() {
        used(&S);
    }

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        rolling = dot(x) - y,
    )]
    struct T;

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        velocity_constraint = [dot(x) - y],
    )]
    struct U;

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        nonholonomc = dot(x) - y,
    )]
    struct V;

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        nonholonomic = dot(x) - z,
    )]
    struct W;
}

mod degenerate {
    use super::*;

    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * x, nonholonomic = d(x) - y)]
    struct S;

    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * x, rolling = d(x) - y, nonholonomic(i in 0..2) = x)]
    struct T;
}

/// A method that keeps no constraints.
mod without_constraints {
    use super::*;

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        nonholonomic = dot(x) - y * dot(y),
    )]
    struct Blade;

    fn run() {
        let start = BladeState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 };
        let _ = Integrator::new(&Blade, Variational::trapezoid(), 0.1, start);
    }
}

/// What is for constraints of the velocities, with others or without any.
mod without_any {
    use super::*;

    #[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0)]
    struct Free;

    #[lagrangian(coordinates(x, y), lagrangian = dot(x).powi(2) / 2.0 + dot(y).powi(2), constraint = x - y)]
    struct Beads;

    fn run() {
        used(&Free);
        used(&Beads);
    }
}

fn main() {}
