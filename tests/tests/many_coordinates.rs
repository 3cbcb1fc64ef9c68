//! Systems whose number of coordinates is known at run time only: their matrices are banded, and Newton's
//! method with these takes the steps of solvers that store none. Of two-forms with a band, a run is that of
//! the same system of fixed size, whose matrix is dense.

use dvi_core::prelude::*;
use dvi_examples::models::{VortexBlobs, VortexBlobsState};

use crate::networks::{as_without_a_matrix, end};

const N: usize = 24;

/// Toda's ring with masses of their own.
#[lagrangian(
    coordinates(q[m.len()]),
    lagrangian = sum(0..m.len(), |j| m[j] * dot(q[j]).powi(2) / 2.0
        - (q[(j + 1) % m.len()] - q[j]).exp() + (q[(j + 1) % m.len()] - q[j])),
)]
struct Ring {
    m: Vec<f64>,
}

/// A chain whose neighbours' velocities are coupled, and depend on the positions where `bend` is not zero.
macro_rules! chain {
    ($name:ident, $bend:literal) => {
        #[lagrangian(
            coordinates(q[m.len()]),
            lagrangian = sum(0..m.len(), |j| m[j] * dot(q[j]).powi(2) * (1.0 + $bend * q[j] * q[j]) / 2.0
                    - q[j].powi(4) / 4.0)
                + sum(1..m.len(), |j| 0.2 * dot(q[j]) * dot(q[j - 1]) - (q[j] - q[j - 1]).powi(2)),
        )]
        struct $name {
            m: Vec<f64>,
        }
    };
}

chain!(Chain, 0.0);
chain!(Bent, 0.3);

/// A lattice with two coordinates at each site, and a one-form that couples neighbours, with a term that is
/// not affine where `bend` is not zero.
macro_rules! lattice {
    ($name:ident [$($generics:tt)*] $masses:ty, $bend:literal, $($n:tt)+) => {
        #[degenerate_lagrangian(
            coordinates(x[$($n)+], y[$($n)+]),
            one_form = sum(0..$($n)+, |j| m[j] / 2.0 * (x[j] * d(y[j]) - y[j] * d(x[j])) + $bend * x[j].powi(3) * d(y[j]))
                + sum(1..$($n)+, |j| 0.1 * x[j - 1] * d(y[j])),
            hamiltonian = sum(0..$($n)+, |j| (x[j] * x[j] + y[j] * y[j]) / 2.0 + x[j].powi(4) / 8.0)
                + sum(1..$($n)+, |j| 0.3 * x[j] * x[j - 1] + 0.2 * y[j] * y[j - 1]),
        )]
        #[derive(Clone, Debug)]
        struct $name $($generics)* { m: $masses }
    };
}

lattice!(Lattice [<const N: usize>] [f64; N], 0.0, N);
lattice!(LongLattice [] Vec<f64>, 0.0, m.len());
lattice!(LongBentLattice [] Vec<f64>, 0.05, m.len());

fn masses() -> [f64; N] {
    std::array::from_fn(|j| 1.0 + 0.3 * (j as f64).sin())
}

fn wave(phase: f64) -> [f64; N] {
    std::array::from_fn(|j| 0.4 * (0.7 * j as f64 + phase).sin())
}

macro_rules! regular {
    ($system:ident, $state:ident, $($method:expr),+ $(,)?) => {
        as_without_a_matrix!(
            0.3,
            $system { m: masses().to_vec() },
            $state { q: wave(0.0).to_vec(), dot_q: wave(1.0).to_vec() },
            $($method),+
        )
    };
}

#[test]
fn banded_newton_steps_are_those_without_a_matrix() {
    regular!(
        Ring,
        RingState,
        Variational::midpoint(),
        Variational::midpoint().phase_fitted(Constant(0.7)),
        Newmark::new(0.25),
        Galerkin::<3>::new(),
    );
    regular!(Chain, ChainState, Variational::midpoint());
    regular!(Bent, BentState, Variational::midpoint(), Variational::trapezoid(), Galerkin::<3>::new());
}

/// A fixed point and explicit steps need the matrix of a two-form.
#[test]
fn two_forms_with_a_band_are_those_of_fixed_size() {
    let [x, y] = [wave(0.0), wave(1.0)];
    let (fixed, start) = (Lattice { m: masses() }, LatticeState { x, y });
    let (long, same) =
        (LongLattice { m: masses().to_vec() }, LongLatticeState { x: x.to_vec(), y: y.to_vec() });
    let bent = LongBentLattice { m: masses().to_vec() };
    let bent_start = LongBentLatticeState { x: x.to_vec(), y: y.to_vec() };
    let by = |solver| Sigma { solver, ..Sigma::midpoint() };
    let close = |(a, _): &(Vec<f64>, u64), (b, _): &(Vec<f64>, u64)| {
        let difference = dvi_tests::apart(a, b);
        assert!(difference < 1e-11, "{difference:e}");
    };
    let classical = RungeKutta::classical();
    close(&end(&long, classical, (0.1, 40), same.clone()), &end(&fixed, classical, (0.1, 40), start));
    let of_bent = end(&bent, by(Solver::FixedPoint), (0.1, 40), bent_start.clone());
    for solver in [Solver::Newton, Solver::FixedPoint] {
        close(&end(&long, by(solver), (0.1, 40), same.clone()), &end(&fixed, by(solver), (0.1, 40), start));
        close(&of_bent, &end(&bent, by(solver), (0.1, 40), bent_start.clone()));
    }
    as_without_a_matrix!(0.1, long, same.clone(), Sigma::midpoint());
    as_without_a_matrix!(0.1, bent, bent_start.clone(), Sigma::midpoint());
}

/// Bodies of different masses, each of which is bound to all others and to the centre.
#[lagrangian(
    coordinates(x[m.len()], y[m.len()]),
    lagrangian = sum(0..m.len(), |j| m[j] * (dot(x[j]).powi(2) + dot(y[j]).powi(2)) / 2.0
            - k * m[j] * (x[j] * x[j] + y[j] * y[j]) / 2.0)
        + sum_pairs(0..m.len(), |i, j| g * m[i] * m[j] / ((x[i] - x[j]).powi(2) + (y[i] - y[j]).powi(2) + 0.1).sqrt()),
)]
struct Swarm {
    m: Vec<f64>,
    k: f64,
    g: f64,
}

/// The coordinates of points that fill a disc.
fn disc(n: usize) -> [Vec<f64>; 2] {
    let turn = |j: usize| (j as f64 + 0.5, 2.399_963_229_728_653 * j as f64);
    let radius = |j: f64| (j / n as f64).sqrt();
    [
        (0..n).map(|j| radius(turn(j).0) * turn(j).1.cos()).collect(),
        (0..n).map(|j| radius(turn(j).0) * turn(j).1.sin()).collect(),
    ]
}

/// Newton's method without a matrix, against the fixed point, which needs none.
#[test]
fn products_with_vectors_are_enough_for_many_bodies() {
    let n = 40;
    let [x, y] = disc(n);
    let distance = dvi_tests::apart;
    let m = (0..n).map(|j| 10.0_f64.powi(j as i32 % 3)).collect();
    let swarm = Swarm { m, k: 1.0, g: 1.0 / n as f64 };
    let start = SwarmState { x: x.clone(), y: y.clone(), dot_x: y.clone(), dot_y: x.clone() };
    let by = |solver| Variational { solver, ..Variational::midpoint() };
    let (expected, _) = end(&swarm, by(Solver::FixedPoint), (0.05, 3), start.clone());
    let (found, iterations) = end(&swarm, by(Solver::NewtonKrylov), (0.05, 3), start.clone());
    assert!(distance(&found, &expected) < 1e-13 && iterations <= 12, "{iterations}");
    let by = |solver| Galerkin { solver, ..Galerkin::<3>::new() };
    let (expected, _) = end(&swarm, by(Solver::FixedPoint), (0.05, 3), start.clone());
    let (found, iterations) = end(&swarm, by(Solver::NewtonKrylov), (0.05, 3), start.clone());
    assert!(distance(&found, &expected) < 1e-13 && iterations <= 12, "{iterations}");
    let by = |solver| Variational { solver, ..Variational::midpoint() };
    // Where the fixed point does not contract: h²k/4 > 1.
    let stiff = Swarm { k: 1e3, g: 1e-3 / n as f64, ..swarm };
    let mut run = Integrator::new(&stiff, by(Solver::NewtonKrylov), 0.1, start).expect("starts");
    let energy = run.energy();
    run.take_steps(5).expect("steps");
    assert!((run.energy() / energy - 1.0).abs() < 1e-3 && run.statistics().factorisations > 0);

    let gamma = (0..n).map(|j| (1.0 + (j % 5) as f64) / n as f64).collect();
    let cloud = VortexBlobs { gamma, core: 0.1 };
    let start = VortexBlobsState { x, y };
    let by = |solver| Sigma { solver, ..Sigma::midpoint() };
    let (expected, _) = end(&cloud, by(Solver::FixedPoint), (0.1, 3), start.clone());
    let (found, iterations) = end(&cloud, by(Solver::NewtonKrylov), (0.1, 3), start);
    assert!(distance(&found, &expected) < 1e-13 && iterations <= 12, "{iterations}");
}
