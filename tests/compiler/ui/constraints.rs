//! Mistakes in constraints.

use dvi_core::prelude::*;
use dvi_core::HolonomicLagrangian;

/// That a system with a mistake in it is taken for one with constraints.
fn used<S: HolonomicLagrangian>(system: &S) {
    system.constraint(&[1.0, 2.0], 0.0, &mut [0.0]);
    let _ = system.multipliers();
}

mod velocities {
    use super::*;

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        constraint = x * dot(x) + y * dot(y),
    )]
    struct S;

    fn run() {
        used(&S);
    }

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        constraint = x * dot_x + y,
    )]
    struct T;
}

mod without_coordinates {
    use super::*;

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        constraint = 1.0 - t * t,
    )]
    struct S;

    #[lagrangian(
        coordinates(x[n]),
        lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
        constraint(i in 0..n) = rods[i],
    )]
    struct T {
        n: usize,
        rods: Vec<f64>,
    }
}

mod without_its_index {
    use super::*;

    #[lagrangian(
        coordinates(x[n]),
        lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
        constraint(i in 0..n - 1) = x[0] - x[1],
    )]
    struct S {
        n: usize,
        rods: Vec<f64>,
    }

    #[lagrangian(
        coordinates(x[n]),
        lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
        constraint(i in 0..n) = sum(0..n, |i| x[i]),
    )]
    struct T {
        n: usize,
        rods: Vec<f64>,
    }
}

mod empty_list {
    use super::*;

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        constraint = [],
    )]
    struct S;

    fn run() {
        used(&S);
    }
}

mod empty {
    use super::*;

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        constraint =,
    )]
    struct S;

    fn run() {
        used(&S);
    }
}

mod without_value {
    use super::*;

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        constraint,
    )]
    struct S;

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        constraint(x * x + y * y - 1.0),
    )]
    struct T;

    #[lagrangian(
        coordinates(x[n]),
        lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
        constraint(i in 0..n),
    )]
    struct U {
        n: usize,
        rods: Vec<f64>,
    }
}

mod on_a_coordinate {
    use super::*;

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        constraint(x) = x * x + y * y - 1.0,
    )]
    struct S;
}

mod heads {
    use super::*;

    #[lagrangian(
        coordinates(x[n]),
        lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
        constraint() = x[0],
    )]
    struct S {
        n: usize,
        rods: Vec<f64>,
    }

    #[lagrangian(
        coordinates(x[n]),
        lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
        constraint(0..n) = x[0],
    )]
    struct T {
        n: usize,
        rods: Vec<f64>,
    }

    #[lagrangian(
        coordinates(x[n]),
        lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
        constraint(i: 0..n) = x[i],
    )]
    struct U {
        n: usize,
        rods: Vec<f64>,
    }

    #[lagrangian(
        coordinates(x[n]),
        lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
        constraint(i = 0..n) = x[i],
    )]
    struct V {
        n: usize,
        rods: Vec<f64>,
    }

    #[lagrangian(
        coordinates(x[n]),
        lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
        constraint(|i| 0..n) = x[i],
    )]
    struct W {
        n: usize,
        rods: Vec<f64>,
    }

    #[lagrangian(
        coordinates(x[n]),
        lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
        constraint(i in 0..n, j in 0..n, k in 0..n) = x[i] - x[j] + x[k],
    )]
    struct X {
        n: usize,
        rods: Vec<f64>,
    }

    #[lagrangian(
        coordinates(x[n]),
        lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
        constraint(_ in 0..n) = x[0],
    )]
    struct Y {
        n: usize,
        rods: Vec<f64>,
    }

    #[lagrangian(
        coordinates(x[n]),
        lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
        constraint(for i in 0..n) = x[i],
    )]
    struct Z {
        n: usize,
        rods: Vec<f64>,
    }
}

mod ranges {
    use super::*;

    #[lagrangian(
        coordinates(x[n]),
        lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
        constraint(i in n) = x[i],
    )]
    struct S {
        n: usize,
        rods: Vec<f64>,
    }

    #[lagrangian(
        coordinates(x[n]),
        lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
        constraint(i in 0..) = x[i],
    )]
    struct T {
        n: usize,
        rods: Vec<f64>,
    }

    #[lagrangian(
        coordinates(x[n]),
        lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
        constraint(i in 3..2) = x[i],
    )]
    struct U {
        n: usize,
        rods: Vec<f64>,
    }

    #[lagrangian(
        coordinates(x[n]),
        lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
        constraint(i in 0..m) = x[i],
    )]
    struct V {
        n: usize,
        rods: Vec<f64>,
    }

    #[lagrangian(
        coordinates(x[n]),
        lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
        constraint(i in 0..i) = x[i],
    )]
    struct W {
        n: usize,
        rods: Vec<f64>,
    }

    #[lagrangian(
        coordinates(x[n]),
        lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
        constraint(i in 0..n / 2) = x[i],
    )]
    struct X {
        n: usize,
        rods: Vec<f64>,
    }

    #[lagrangian(
        coordinates(x[n]),
        lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
        constraint(i in rods) = x[i],
    )]
    struct Y {
        n: usize,
        rods: Vec<f64>,
    }
}

mod closures {
    use super::*;

    #[lagrangian(
        coordinates(x[n]),
        lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
        constraint = |i| x[i] - rods[i],
    )]
    struct S {
        n: usize,
        rods: Vec<f64>,
    }

    #[lagrangian(
        coordinates(x[n]),
        lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
        constraint = [x[0], |i| x[i]],
    )]
    struct T {
        n: usize,
        rods: Vec<f64>,
    }
}

mod equations {
    use super::*;

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        constraint = x * x + y * y == 1.0,
    )]
    struct S;

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        constraint = x * x + y * y = t + 1.0,
    )]
    struct T;

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        constraint = (x == 0),
    )]
    struct U;

    #[lagrangian(
        coordinates(x[n]),
        lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
        constraint(i in 0..n) = x[i] == rods[i],
    )]
    struct V {
        n: usize,
        rods: Vec<f64>,
    }

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        constraint = [x == y, y - 1.0],
    )]
    struct W;

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        constraint == x - y,
    )]
    struct X;
}

mod inequalities {
    use super::*;

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        constraint = x * x + y * y <= 1.0,
    )]
    struct S;
}

mod lists {
    use super::*;

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        constraint = [[x, y]],
    )]
    struct S;

    #[lagrangian(
        coordinates(x[n]),
        lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
        constraint(i in 0..n) = [x[i], x[i] - rods[i]],
    )]
    struct T {
        n: usize,
        rods: Vec<f64>,
    }
}

mod out_of_range {
    use super::*;

    #[lagrangian(
        coordinates(x[3]),
        lagrangian = sum(0..3, |j| dot(x[j]).powi(2) / 2.0),
        constraint(i in 0..3) = x[i + 1] - x[i],
    )]
    struct S;
}

mod indices {
    use super::*;

    #[lagrangian(
        coordinates(x[n]),
        lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
        constraint(i in 0..n) = x - rods[i],
    )]
    struct S {
        n: usize,
        rods: Vec<f64>,
    }

    #[lagrangian(
        coordinates(x[n]),
        lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
        constraint(i in 0..n) = x[i] - i,
    )]
    struct T {
        n: usize,
        rods: Vec<f64>,
    }

    #[lagrangian(
        coordinates(x[n]),
        lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
        constraint(i in 0..n) = x[j] - rods[i],
    )]
    struct U {
        n: usize,
        rods: Vec<f64>,
    }

    #[lagrangian(
        coordinates(x[n]),
        lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0),
        constraint = x[i] - rods[i],
    )]
    struct V {
        n: usize,
        rods: Vec<f64>,
    }
}

mod twice {
    use super::*;

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        constraint = x - y,
        constraint = 2.0 * (x - y),
    )]
    struct S;

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        constraint = [x, y, x * y - t],
    )]
    struct T;
}

mod names {
    use super::*;

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        constraints = x - y,
    )]
    struct S;

    fn run() {
        used(&S);
    }

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        holonomic = [x - y],
    )]
    struct T;

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        contraint = x - y,
    )]
    struct U;

    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
        constraint = x - z,
    )]
    struct V;
}

mod degenerate {
    use super::*;

    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * x, constraint = x - y)]
    struct S;

    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * x, constraint(i in 0..2) = x, constraints = [x, y])]
    struct T;
}

mod massless {
    use super::*;

    #[lagrangian(coordinates(x, y), lagrangian = dot(x).powi(2) / 2.0, constraint = x - y)]
    struct S;
}

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

    fn run() {
        used(&Free);
    }
}

/// Families with two indices.
mod pairs {
    use super::*;

    #[lagrangian(
        coordinates(x[4]),
        lagrangian = sum(0..4, |j| dot(x[j]).powi(2) / 2.0),
        constraint(i in 0..2, i in 0..2) = x[i],
    )]
    struct SameName;

    #[lagrangian(
        coordinates(x[4]),
        lagrangian = sum(0..4, |j| dot(x[j]).powi(2) / 2.0),
        constraint(i in 0..2, j in i + 1..4) = x[i].powi(2),
    )]
    struct Unused;

    #[lagrangian(
        coordinates(x[4]),
        lagrangian = sum(0..4, |j| dot(x[j]).powi(2) / 2.0),
        constraint(i in 0..2, j in 0..(i + 1) % 2) = x[i] * x[j],
        constraint(i in 0..2, j = 0..2) = x[i] * x[j],
        constraint(i in 0..j, j in 0..2) = x[i] * x[j],
        constraint(i in 0..2, j in i + 1..4) >= x[i] * x[j],
    )]
    struct Ranges;

    #[lagrangian(
        coordinates(x[4]),
        lagrangian = sum(0..4, |j| dot(x[j]).powi(2) / 2.0),
        constraint(i in 0..4, j in i..4) = x[i] * x[j] - 1.0,
    )]
    struct TooMany;
}

fn main() {}
