//! Systems on a tree, whose matrices are sparse and have no narrow band: Newton's method with their factors,
//! against a solver that stores no matrix, and rods against what they have to keep.

use dvi_core::prelude::*;
use dvi_tests::larger;
use dvi_tests::zoo::constrained::{Mobile, MobileState};

/// Masses on springs between each and the two below it.
#[lagrangian(
    coordinates(q[2 * half + 1]),
    lagrangian = sum(0..2 * half + 1, |j| m[j] * dot(q[j]).powi(2) / 2.0 - q[j].powi(4) / 4.0)
        - sum(0..half, |j| (q[2 * j + 1] - q[j]).cosh() + (q[2 * j + 2] - q[j]).powi(2)),
)]
struct Tree {
    half: usize,
    m: Vec<f64>,
}

/// The same with masses that are coupled and vary.
#[lagrangian(
    coordinates(q[2 * half + 1]),
    lagrangian = sum(0..2 * half + 1, |j| m[j] * (1.0 + 0.3 * q[j] * q[j]) * dot(q[j]).powi(2) / 2.0 - q[j].powi(4) / 4.0)
        + sum(0..half, |j| 0.1 * dot(q[2 * j + 1]) * dot(q[j]) - (q[2 * j + 2] - q[j]).powi(2)),
)]
struct BentTree {
    half: usize,
    m: Vec<f64>,
}

/// Oscillators in canonical pairs.
#[degenerate_lagrangian(
    coordinates(x[2 * half + 1], y[2 * half + 1]),
    one_form = sum(0..2 * half + 1, |j| m[j] * x[j] * d(y[j])),
    hamiltonian = sum(0..2 * half + 1, |j| (x[j] * x[j] + y[j] * y[j]) / 2.0 + x[j].powi(4) / 8.0)
        + sum(0..half, |j| 0.3 * x[2 * j + 1] * x[j] + 0.2 * y[2 * j + 2] * y[j]),
)]
struct Pairs {
    half: usize,
    m: Vec<f64>,
}

/// Of a tree with eight levels.
const N: usize = 255;

fn masses() -> Vec<f64> {
    (0..N).map(|j| 1.0 + 0.3 * (j as f64).sin()).collect()
}

fn wave(phase: f64) -> Vec<f64> {
    (0..N).map(|j| 0.4 * (0.7 * j as f64 + phase).sin()).collect()
}

/// Where a run is after some steps, and after how many iterations.
pub(crate) fn end<S: Lagrangian, M: Method<S, f64>>(
    system: &S,
    method: M,
    (h, steps): (f64, u64),
    start: S::State<f64>,
) -> (Vec<f64>, u64) {
    let mut run = Integrator::new(system, method, h, start).expect("starts");
    run.take_steps(steps).expect("steps");
    (run.q().to_vec(), run.statistics().iterations)
}

/// Compares steps by Newton's method with those of the same method by products with vectors.
macro_rules! as_without_a_matrix {
    ($h:expr, $system:expr, $start:expr, $($method:expr),+ $(,)?) => {$({
        let [(expected, _), (found, iterations)] = [Solver::NewtonKrylov, Solver::Newton].map(|solver| {
            let mut method = $method;
            method.solver = solver;
            $crate::networks::end(&$system, method, ($h, 10), $start)
        });
        let difference = dvi_tests::apart(&expected, &found);
        assert!(difference < 1e-13, "{}: {difference:e}", stringify!($method));
        // With a wrong matrix the iteration would converge, but slowly.
        assert!(iterations <= 40, "{}: {iterations}", stringify!($method));
    })+};
}
pub(crate) use as_without_a_matrix;

#[test]
fn sparse_newton_steps_are_those_without_a_matrix() {
    as_without_a_matrix!(
        0.1,
        Tree { half: N / 2, m: masses() },
        TreeState { q: wave(0.0), dot_q: wave(1.0) },
        Variational::midpoint(),
        Galerkin::<3>::new(),
    );
    as_without_a_matrix!(
        0.1,
        BentTree { half: N / 2, m: masses() },
        BentTreeState { q: wave(0.0), dot_q: wave(1.0) },
        Variational::trapezoid(),
    );
    as_without_a_matrix!(
        0.1,
        Pairs { half: N / 2, m: masses() },
        PairsState { x: wave(0.0), y: wave(1.0) },
        Sigma::midpoint(),
    );
}

#[test]
fn rods_in_a_tree_keep_their_lengths() {
    let system = Mobile { half: N / 2 };
    let mut run =
        Integrator::new(&system, Constrained::new(Midpoint), 0.01, system.at_rest()).expect("starts");
    let energy = run.energy();
    run.take_steps(50).expect("steps");
    let state: MobileState = run.state();
    let length = |j: usize| {
        let above = (j - 1) / 2;
        (state.x[j] - state.x[above]).hypot(state.y[j] - state.y[above])
    };
    let stretch = (1..N).map(|j| (length(j) - 1.0).abs()).fold(0.0, larger);
    assert!(stretch < 1e-14, "{stretch:e}");
    // As much has fallen as moves now, to the order of the steps.
    let kinetic = run.energy() - state.y.iter().sum::<f64>();
    assert!(
        kinetic > 1.0 && (run.energy() - energy).abs() < 1e-4 * kinetic,
        "{kinetic} {}",
        run.energy() - energy
    );
}
