//! Systems in units `u` of their coordinates and `tau` of time.

use dvi_core::prelude::*;

use super::InUnits;

/// A system with one unit for each coordinate, and some with one for L or for a constraint: its step and its
/// start, coordinates and then velocities.
macro_rules! in_units {
    ($system:ident, [f64; $n:literal], $h:literal, $start:expr) => {
        impl InUnits<$n> for $system {
            const H: f64 = $h;
            fn system(u: [f64; $n], tau: f64) -> Self {
                Self { u, tau }
            }
            fn start() -> Vec<f64> {
                $start.to_vec()
            }
        }
    };
}

/// A system of two arrays, each with a unit.
macro_rules! arrays_in_units {
    ($system:ident, $($size:ident)? $n:literal, $h:literal, $start:expr) => {
        impl InUnits<2> for $system {
            const H: f64 = $h;
            fn unit(coordinate: usize) -> usize {
                coordinate / $n
            }
            fn system([u, w]: [f64; 2], tau: f64) -> Self {
                Self { $($size: $n,)? u, w, tau }
            }
            fn start() -> Vec<f64> {
                $start
            }
        }
    };
}

#[degenerate_lagrangian(
    coordinates(x[3], y[3]),
    one_form = sum(0..3, |j| (u * x[j] * w * d(y[j]) - w * y[j] * u * d(x[j])) / 2.0) / tau,
    hamiltonian = sum_pairs(0..3, |j, k| ((u * x[j] - u * x[k]).powi(2) + (w * y[j] - w * y[k]).powi(2)).ln())
        / (4.0 * PI),
)]
pub(super) struct Vortices {
    u: f64,
    w: f64,
    tau: f64,
}

arrays_in_units!(Vortices, 3, 0.1, vec![1.0, -0.4, -0.7, 0.2, 0.9, -0.8]);

/// Four coordinates whose Ω has all entries, and no pair of them.
#[degenerate_lagrangian(
    coordinates(a, b, c, d),
    one_form = (15.0 * u[0] * a * u[1] * d(b)
        + (3.0 * u[0] * a + 10.0 * u[1] * b) * u[2] * d(c)
        + (13.0 * u[0] * a + u[1] * b + 14.0 * u[2] * c) * u[3] * d(d)) / tau,
    hamiltonian = ((u[0] * a).powi(2) + (u[1] * b).powi(2) + (u[2] * c).powi(2) + (u[3] * d).powi(2)) / 2.0
        + (u[0] * a * u[3] * d).powi(2) / 4.0,
)]
pub(super) struct Tangled {
    u: [f64; 4],
    tau: f64,
}

in_units!(Tangled, [f64; 4], 0.5, [1.0, 0.75, -0.5, 1.25]);

/// Predators y and their prey x.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = u[2] * (u[1] * y).ln() / (u[0] * x) * u[0] * d(x) / tau,
    hamiltonian = u[2] * (u[0] * x + u[1] * y - (u[0] * x).ln() - 2.0 * (u[1] * y).ln()),
)]
pub(super) struct Predators {
    u: [f64; 3],
    tau: f64,
}

in_units!(Predators, [f64; 3], 0.1, [1.0, 1.0]);

/// The centre of the gyration of a charge: Ω couples three coordinates.
#[degenerate_lagrangian(
    coordinates(x, y, z, v),
    one_form = ((1.0 + (u[0] * x).powi(2) / 10.0) * (u[0] * x * u[1] * d(y) - u[1] * y * u[0] * d(x)) / 2.0
        + u[3] * v * u[2] * d(z)) / tau,
    hamiltonian = (u[3] * v).powi(2) / 2.0 + 0.3 * (u[0] * x + (u[1] * y).powi(2))
        + (u[2] * z).powi(2) * (1.0 + (u[0] * x).powi(2)),
)]
pub(super) struct Centre {
    u: [f64; 4],
    tau: f64,
}

in_units!(Centre, [f64; 4], 0.1, [1.0, 0.3, 0.5, 0.8]);

/// Coupled amplitudes, of a size that is known at run time only.
#[degenerate_lagrangian(
    coordinates(x[n], p[n]),
    one_form = sum(0..n, |j| w * p[j] * u * d(x[j])) / tau,
    hamiltonian = sum(0..n, |j| ((w * p[j]).powi(2) + (u * x[j]).powi(2)).powi(2) / 4.0)
        + sum(1..n, |j| u * x[j] * u * x[j - 1] + w * p[j] * w * p[j - 1]),
)]
pub(super) struct Amplitudes {
    n: usize,
    u: f64,
    w: f64,
    tau: f64,
}

arrays_in_units!(Amplitudes, n 4, 0.05, vec![1.0, 0.0, 0.5, -0.4, 0.0, 0.3, 0.2, 0.1]);

#[lagrangian(
    coordinates(x, y),
    lagrangian = u[2] * (((u[0] * dot(x) / tau).powi(2) + (u[1] * dot(y) / tau).powi(2)) / 2.0
        + 1.0 / ((u[0] * x).powi(2) + (u[1] * y).powi(2)).sqrt()),
)]
pub(super) struct Kepler {
    u: [f64; 3],
    tau: f64,
}

in_units!(Kepler, [f64; 3], 0.05, [0.8, 0.0, 0.0, 1.2]);

#[lagrangian(
    coordinates(a, b),
    lagrangian = (u[0] * dot(a) / tau).powi(2) + (u[1] * dot(b) / tau).powi(2) / 2.0
        + u[0] * dot(a) / tau * u[1] * dot(b) / tau * (u[0] * a - u[1] * b).cos()
        + 2.0 * (u[0] * a).cos() + (u[1] * b).cos(),
)]
pub(super) struct DoublePendulum {
    u: [f64; 2],
    tau: f64,
}

in_units!(DoublePendulum, [f64; 2], 0.05, [1.0, 0.5, 0.1, 0.3]);

/// A charge in a magnetic field, with friction and a drive.
#[lagrangian(
    coordinates(x, y, z),
    lagrangian = ((u[0] * dot(x)).powi(2) + (u[1] * dot(y)).powi(2) + (u[2] * dot(z)).powi(2))
        / tau.powi(2) / 2.0
        + (u[0] * x * u[1] * dot(y) - u[1] * y * u[0] * dot(x)) / tau
        - (u[0] * x).powi(2) * (1.0 + (u[2] * z).powi(2)) / 2.0,
    force(z) = u[2] * ((t * tau).sin() - 0.1 * u[2] * dot(z) / tau),
)]
pub(super) struct Charge {
    u: [f64; 3],
    tau: f64,
}

in_units!(Charge, [f64; 3], 0.1, [1.0, 0.5, 0.1, 0.2, -0.3, 0.5]);

/// A chain of stiff springs, of a size that is known at run time only.
#[lagrangian(
    coordinates(x[n], y[n]),
    lagrangian = sum(0..n, |j| ((u * dot(x[j])).powi(2) + (w * dot(y[j])).powi(2)) / tau.powi(2) / 2.0
        - ((u * x[j]).powi(2) + (w * y[j]).powi(2)).powi(2) / 4.0)
        - sum(1..n, |j| 50.0 * ((u * x[j] - u * x[j - 1]).powi(2) + (w * y[j] - w * y[j - 1]).powi(2)) / 2.0),
)]
pub(super) struct Chain {
    n: usize,
    u: f64,
    w: f64,
    tau: f64,
}

arrays_in_units!(Chain, n 12, 0.2, (0..48).map(|j| (1.7 * f64::from(j)).sin()).collect());

/// A constant mass matrix that couples coordinates.
#[lagrangian(
    coordinates(x, y, z),
    lagrangian = ((u[0] * dot(x)).powi(2) + (u[1] * dot(y)).powi(2) + 2.0 * (u[2] * dot(z)).powi(2)
        + u[0] * dot(x) * u[1] * dot(y) + u[1] * dot(y) * u[2] * dot(z)) / tau.powi(2) / 2.0
        + (u[0] * x - u[1] * y).cos() - (u[2] * z).powi(2) / 2.0,
)]
pub(super) struct CoupledMasses {
    u: [f64; 3],
    tau: f64,
}

in_units!(CoupledMasses, [f64; 3], 0.1, [1.0, 0.5, 0.1, 0.2, -0.3, 0.5]);

/// A bead on the circle in which a sphere meets a plane, where each constraint has a unit too.
#[lagrangian(
    coordinates(x, y, z),
    lagrangian = ((u[0] * dot(x)).powi(2) + (u[1] * dot(y)).powi(2) + (u[2] * dot(z)).powi(2))
        / tau.powi(2) / 2.0
        - u[2] * z,
    constraint = ((u[0] * x).powi(2) + (u[1] * y).powi(2) + (u[2] * z).powi(2) - 1.0) / u[3],
    constraint = (u[0] * x - u[1] * y - 0.2) / u[4],
)]
pub(super) struct Bead {
    u: [f64; 5],
    tau: f64,
}

in_units!(Bead, [f64; 5], 0.05, [0.6, 0.4, f64::sqrt(0.48), 0.25, 0.25, -0.25 / f64::sqrt(0.48)]);

/// A blade on a plane that is not level.
#[lagrangian(
    coordinates(x, y, a),
    lagrangian = ((u[0] * dot(x)).powi(2) + (u[1] * dot(y)).powi(2) + (u[2] * dot(a)).powi(2))
        / tau.powi(2) / 2.0
        + u[0] * x,
    nonholonomic = u[0] * dot(x) * (u[2] * a).sin() - u[1] * dot(y) * (u[2] * a).cos(),
)]
pub(super) struct Blade {
    u: [f64; 3],
    tau: f64,
}

in_units!(Blade, [f64; 3], 0.1, [0.5, 0.2, 0.0, 1.0, 0.0, 0.7]);
