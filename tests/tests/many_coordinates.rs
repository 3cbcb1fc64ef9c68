//! Systems whose number of coordinates is known at run time only: their matrices are banded, and a run is
//! that of the same system of fixed size, whose matrices are dense.

use dvi_core::methods::{Composition, Method};
use dvi_core::prelude::*;
use dvi_examples::models::{VortexBlobs, VortexBlobsState};

const N: usize = 24;

/// Toda's ring with masses of their own.
macro_rules! ring {
    ($name:ident [$($generics:tt)*] $masses:ty, $($n:tt)+) => {
        #[lagrangian(
            coordinates(q[$($n)+]),
            lagrangian = sum(0..$($n)+, |j| m[j] * dot(q[j]).powi(2) / 2.0
                - (q[(j + 1) % ($($n)+)] - q[j]).exp() + (q[(j + 1) % ($($n)+)] - q[j])),
        )]
        #[derive(Clone, Debug)]
        struct $name $($generics)* { m: $masses }
    };
}

/// A chain whose neighbours' velocities are coupled, and depend on the positions where `bend` is not zero.
macro_rules! chain {
    ($name:ident [$($generics:tt)*] $masses:ty, $bend:literal, $($n:tt)+) => {
        #[lagrangian(
            coordinates(q[$($n)+]),
            lagrangian = sum(0..$($n)+, |j| m[j] * dot(q[j]).powi(2) * (1.0 + $bend * q[j] * q[j]) / 2.0
                    - q[j].powi(4) / 4.0)
                + sum(1..$($n)+, |j| 0.2 * dot(q[j]) * dot(q[j - 1]) - (q[j] - q[j - 1]).powi(2)),
        )]
        #[derive(Clone, Debug)]
        struct $name $($generics)* { m: $masses }
    };
}

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

ring!(Ring [<const N: usize>] [f64; N], N);
ring!(LongRing [] Vec<f64>, m.len());
chain!(Chain [<const N: usize>] [f64; N], 0.0, N);
chain!(LongChain [] Vec<f64>, 0.0, m.len());
chain!(Bent [<const N: usize>] [f64; N], 0.3, N);
chain!(LongBent [] Vec<f64>, 0.3, m.len());
lattice!(Lattice [<const N: usize>] [f64; N], 0.0, N);
lattice!(LongLattice [] Vec<f64>, 0.0, m.len());
lattice!(BentLattice [<const N: usize>] [f64; N], 0.05, N);
lattice!(LongBentLattice [] Vec<f64>, 0.05, m.len());

fn masses() -> [f64; N] {
    std::array::from_fn(|j| 1.0 + 0.3 * (j as f64).sin())
}

fn wave(phase: f64) -> [f64; N] {
    std::array::from_fn(|j| 0.4 * (0.7 * j as f64 + phase).sin())
}

/// Where a run is after some steps, and after how many iterations.
fn end<S: Lagrangian, M: Method<S, f64>>(
    system: &S,
    method: M,
    h: f64,
    start: S::State<f64>,
) -> (Vec<f64>, u64) {
    let mut run = Integrator::new(system, method, h, start).expect("starts");
    run.take_steps(40).expect("steps");
    (run.q().to_vec(), run.statistics().iterations)
}

macro_rules! same {
    ($fixed:expr, $fixed_start:expr, $long:expr, $long_start:expr, $h:expr, $($method:expr),+ $(,)?) => {$({
        let (expected, least) = end(&$fixed, $method, $h, $fixed_start);
        let (found, iterations) = end(&$long, $method, $h, $long_start);
        let distance = |(a, b): (&f64, &f64)| (a - b).abs();
        let difference = expected.iter().zip(&found).map(distance).fold(0.0, dvi_tests::larger);
        assert!(difference < 1e-11, "{}: {difference:e}", stringify!($method));
        // With a wrong matrix the iteration would converge, but slowly.
        assert!(iterations <= least + least / 10, "{}: {iterations} of {least}", stringify!($method));
    })+};
}

const NEWTON: Solver = Solver::Newton;

macro_rules! regular {
    ($name:ident: $fixed:ident, $fixed_state:ident, $long:ident, $long_state:ident, $($method:expr),+ $(,)?) => {
        #[test]
        fn $name() {
            same!(
                $fixed { m: masses() },
                $fixed_state { q: wave(0.0), dot_q: wave(1.0) },
                $long { m: masses().to_vec() },
                $long_state { q: wave(0.0).to_vec(), dot_q: wave(1.0).to_vec() },
                0.3,
                $($method),+
            );
        }
    };
}

regular!(
    rings_are_those_of_fixed_size:
    Ring,
    RingState,
    LongRing,
    LongRingState,
    Variational { solver: NEWTON, ..Variational::midpoint() },
    Variational { solver: NEWTON, ..Variational::simpson() },
    Variational { solver: NEWTON, ..Variational::midpoint().phase_fitted(Constant(0.7)) },
    Newmark { solver: NEWTON, ..Newmark::new(0.25) },
    Composition::triple_jump(Variational { solver: NEWTON, ..Variational::midpoint() }),
);

regular!(
    chains_are_those_of_fixed_size:
    Chain,
    ChainState,
    LongChain,
    LongChainState,
    Variational { solver: NEWTON, ..Variational::midpoint() },
    Newmark { solver: NEWTON, ..Newmark::new(0.25) },
);

regular!(
    chains_of_masses_that_vary_are_those_of_fixed_size:
    Bent,
    BentState,
    LongBent,
    LongBentState,
    Variational::midpoint(),
    Variational::trapezoid(),
);

// Of fixed size, their matrices fill a good part of the stack of a test.
regular!(
    rings_with_displacements_are_those_of_fixed_size:
    Ring,
    RingState,
    LongRing,
    LongRingState,
    Galerkin { solver: NEWTON, ..Galerkin::<3>::new() },
);

regular!(
    chains_with_displacements_are_those_of_fixed_size:
    Bent,
    BentState,
    LongBent,
    LongBentState,
    Galerkin::<3>::new(),
);

#[test]
fn degenerate_systems_are_those_of_fixed_size() {
    let newton = Solver::Newton;
    macro_rules! pair {
        ($fixed:ident, $fixed_state:ident, $long:ident, $long_state:ident, $($method:expr),+ $(,)?) => {
            same!(
                $fixed { m: masses() },
                $fixed_state { x: wave(0.0), y: wave(1.0) },
                $long { m: masses().to_vec() },
                $long_state { x: wave(0.0).to_vec(), y: wave(1.0).to_vec() },
                0.1,
                $($method),+
            )
        };
    }
    pair!(
        Lattice,
        LatticeState,
        LongLattice,
        LongLatticeState,
        Sigma { solver: newton, ..Sigma::midpoint() },
        Sigma { solver: Solver::FixedPoint, ..Sigma::midpoint() },
        RungeKutta::classical(),
    );
    pair!(
        BentLattice,
        BentLatticeState,
        LongBentLattice,
        LongBentLatticeState,
        Sigma { solver: newton, ..Sigma::midpoint() },
        Sigma { solver: Solver::FixedPoint, ..Sigma::midpoint() },
    );
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
    let distance =
        |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, dvi_tests::larger);
    fn steps<S: Lagrangian, M: Method<S, f64>>(
        system: &S,
        method: M,
        h: f64,
        start: S::State<f64>,
    ) -> (Vec<f64>, u64) {
        let mut run = Integrator::new(system, method, h, start).expect("starts");
        run.take_steps(3).expect("steps");
        (run.q().to_vec(), run.statistics().iterations)
    }

    let m = (0..n).map(|j| 10.0_f64.powi(j as i32 % 3)).collect();
    let swarm = Swarm { m, k: 1.0, g: 1.0 / n as f64 };
    let start = SwarmState { x: x.clone(), y: y.clone(), dot_x: y.clone(), dot_y: x.clone() };
    let by = |solver| Variational { solver, ..Variational::midpoint() };
    let (expected, _) = steps(&swarm, by(Solver::FixedPoint), 0.05, start.clone());
    let (found, iterations) = steps(&swarm, by(Solver::NewtonKrylov), 0.05, start.clone());
    assert!(distance(&found, &expected) < 1e-13 && iterations <= 12, "{iterations}");
    let by = |solver| Newmark { solver, ..Newmark::new(0.25) };
    let (expected, _) = steps(&swarm, by(Solver::FixedPoint), 0.05, start.clone());
    let (found, iterations) = steps(&swarm, by(Solver::NewtonKrylov), 0.05, start.clone());
    assert!(distance(&found, &expected) < 1e-13 && iterations <= 12, "{iterations}");
    let by = |solver| Galerkin { solver, ..Galerkin::<3>::new() };
    let (expected, _) = steps(&swarm, by(Solver::FixedPoint), 0.05, start.clone());
    let (found, iterations) = steps(&swarm, by(Solver::NewtonKrylov), 0.05, start.clone());
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
    let (expected, _) = steps(&cloud, by(Solver::FixedPoint), 0.1, start.clone());
    let (found, iterations) = steps(&cloud, by(Solver::NewtonKrylov), 0.1, start);
    assert!(distance(&found, &expected) < 1e-13 && iterations <= 12, "{iterations}");
}
