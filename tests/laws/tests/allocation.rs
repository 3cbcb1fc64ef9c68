//! No step allocates, and what a run takes before its first step is linear in the length of a chain, and in
//! the number of vortices.

use dvi_core::field::{Axis, ScalarField, Spline};
use dvi_core::methods::Method;
use dvi_core::prelude::*;
use dvi_core::rotations;
use dvi_examples::osculating::Osculating;
use dvi_tests::systems::{ManyVortices, ManyVorticesState, PointVortices, PointVorticesState};
use dvi_tests::zoo::constrained::Links;
use dvi_tests::zoo::regular::{Kepler, KeplerState, RunTimeChain, RunTimeChainState};
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, Stats, StatsAlloc};

#[global_allocator]
static ALLOCATOR: &StatsAlloc<std::alloc::System> = &INSTRUMENTED_SYSTEM;

/// What is allocated for what is done, by all threads.
fn allocated(act: impl FnOnce()) -> Stats {
    let region = Region::new(ALLOCATOR);
    act();
    region.change()
}

/// How often.
fn blocks(act: &mut impl FnMut()) -> usize {
    let Stats { allocations, reallocations, .. } = allocated(act);
    allocations + reallocations
}

/// Of a hundred steps.
fn of_steps(mut advance: impl FnMut()) -> usize {
    blocks(&mut || (0..100).for_each(|_| advance()))
}

macro_rules! assert_none {
    ($system:expr, $start:expr, $($method:expr),+ $(,)?) => {$(
        let mut run = Integrator::new(&$system, $method, 0.05, $start.clone()).expect("starts");
        // The thread of the test harness allocates now and then; steps that allocate do so every time.
        let blocks = (0..3).map(|_| of_steps(|| run.advance().expect("steps"))).min();
        assert_eq!(blocks, Some(0), "{}", stringify!($method));
    )+};
}

macro_rules! assert_none_controlled {
    ($system:expr, $start:expr, $control:expr, $($method:expr),+ $(,)?) => {$(
        let mut run =
            Integrator::controlled(&$system, $method, $control, $start.clone()).expect("starts");
        let blocks = of_steps(|| run.advance().expect("steps"));
        assert_eq!(blocks, 0, "{} by {:?}", stringify!($method), $control);
    )+};
}

/// Bytes that a run takes, with steps of this length and of this number.
fn bytes<S: Lagrangian, M: Method<S, f64>>(
    system: &S,
    method: M,
    (h, steps): (f64, u64),
    start: S::State<f64>,
) -> f64 {
    let stats = allocated(|| {
        let mut run = Integrator::new(system, method, h, start).expect("starts");
        run.take_steps(steps).expect("steps");
    });
    stats.bytes_allocated as f64
}

/// Bytes that a run of a chain of `n` masses takes.
fn of_chain<M: Method<RunTimeChain, f64>>(method: M, n: usize) -> f64 {
    let chain = RunTimeChain { mass: vec![1.0; n], coupling: 0.125 };
    let wave = |phase: f64| (0..n).map(|j| 0.3 * (j as f64 + phase).sin()).collect::<Vec<f64>>();
    let start = RunTimeChainState { q: wave(0.0), wall: 0.3, dot_q: wave(1.0), dot_wall: 0.2 };
    bytes(&chain, method, (0.1, 3), start)
}

/// Friction on bodies that all depend on each other.
#[lagrangian(
    coordinates(q[n]),
    lagrangian = sum(0..n, |j| dot(q[j]).powi(2) / 2.0) - sum_pairs(0..n, |j, k| (q[j] - q[k]).powi(2)) / (n as f64),
    force(q) = |j| -0.1 * dot(q[j]),
)]
#[derive(Debug)]
struct Rubbed {
    n: usize,
}

/// Bodies that are drawn to a wall each.
#[lagrangian(
    coordinates(x[walls.len()]),
    lagrangian = sum(0..walls.len(), |i| dot(x[i]).powi(2)) / 2.0 - (x[0] - walls[0]).abs()
        - (x[1] - walls[1]).abs(),
)]
#[derive(Debug)]
struct Seamed {
    walls: Vec<f64>,
}

/// Bodies and rods beside a chain, of a number that is known at run time.
#[lagrangian(
    coordinates(x[n], R[n]: SO3, s[n]: S2),
    lagrangian = sum(0..n, |i| dot(x[i]).powi(2) / 2.0 - x[i].powi(2)) + sum(0..n, |i| dot(s[i]).norm_squared())
        + sum(0..n, |i| omega(R[i])[0].powi(2) + 0.8 * omega(R[i])[1].powi(2) + 0.5 * omega(R[i])[2].powi(2))
        + sum(1..n, |i| x[i] * R[i - 1].column(2).dot(s[i])),
)]
struct Turning {
    n: usize,
}

/// `n` bodies and `n` rods in a row.
fn turning(n: usize) -> (Turning, TurningState) {
    let start = TurningState {
        x: vec![0.3; n],
        R: vec![rotations::exp([0.3, -0.2, 0.6]); n],
        s: vec![[0.6, 0.0, 0.8]; n],
        dot_x: vec![0.2; n],
        omega_R: vec![[0.4, 0.9, -0.3]; n],
        dot_s: vec![[0.0, 0.4, 0.0]; n],
    };
    (Turning { n }, start)
}

/// Balls on a line between two walls.
#[lagrangian(
    coordinates(x[m.len()]),
    lagrangian = sum(0..m.len(), |i| m[i] * dot(x[i]).powi(2) / 2.0 - m[i] * x[i]),
    impact = [x[0], 10.0 - x[m.len() - 1]],
    impact(i in 1..m.len()) = x[i] - x[i - 1] - 1.0,
)]
#[derive(Debug)]
struct Balls {
    m: Vec<f64>,
}

/// Bytes that a constrained run of a chain of `n` rods takes.
fn of_links(n: usize) -> f64 {
    let (system, start) = Links::stretched(vec![1.0; n]);
    bytes(&system, Constrained::new(Midpoint), (0.01, 3), start)
}

/// Bytes that a run of `n` such bodies takes.
fn of_bodies<M: Method<Rubbed, f64>>(method: M, n: usize) -> f64 {
    let (system, q) = (Rubbed { n }, (0..n).map(|j| (j as f64).sin()).collect());
    let stats = allocated(|| {
        let start = RubbedState { q, dot_q: vec![0.0; n] };
        let mut run = Integrator::new(&system, method, 0.1, start).expect("starts");
        run.take_steps(3).expect("steps");
        let _ = (run.state(), run.power());
    });
    stats.bytes_allocated as f64
}

/// Masses on springs between each and the two below it.
#[lagrangian(
    coordinates(q[2 * half + 1]),
    lagrangian = sum(0..2 * half + 1, |j| dot(q[j]).powi(2) / 2.0 - q[j].powi(4) / 4.0)
        - sum(0..half, |j| (q[2 * j + 1] - q[j]).powi(2) + (q[2 * j + 2] - q[j]).powi(2)),
)]
#[derive(Debug)]
struct Tree {
    half: usize,
}

/// A tree of `2 half + 1` masses.
fn tree(half: usize) -> (Tree, TreeState) {
    let q: Vec<f64> = (0..2 * half + 1).map(|j| (j as f64).sin()).collect();
    (Tree { half }, TreeState { dot_q: vec![0.0; q.len()], q })
}

/// Bytes that a run of such a tree takes.
fn of_tree(half: usize) -> f64 {
    let (system, start) = tree(half);
    let method = Variational { solver: Solver::Newton, ..Variational::midpoint() };
    bytes(&system, method, (0.1, 3), start)
}

/// Vortices on a spiral.
fn spiral(n: usize) -> (ManyVortices, ManyVorticesState) {
    let at = |j: usize, phase: f64| (1.0 + j as f64).sqrt() * (2.4 * j as f64 + phase).sin();
    let [x, y] = [1.6, 0.0].map(|phase| (0..n).map(|j| at(j, phase)).collect::<Vec<f64>>());
    (ManyVortices { gamma: vec![1.0; n] }, ManyVorticesState { x, y })
}

/// Bytes that a run of `n` vortices takes, each of which moves all others.
fn of_vortices(method: Sigma, n: usize) -> f64 {
    let (system, start) = spiral(n);
    bytes(&system, method, (0.01, 1), start)
}

macro_rules! assert_linear {
    ($($method:expr),+ $(,)?) => {$(
        let [short, long] = [1000, 4000].map(|n| of_chain($method, n));
        assert!(long < 4.1 * short, "{}: {short} bytes and {long}", stringify!($method));
    )+};
}

#[test]
fn steps_do_not_allocate_and_storage_is_linear_in_the_number_of_bodies() {
    let counted = of_steps(|| drop(std::hint::black_box(vec![0_u8; 16])));
    assert_eq!(counted, 100, "the counter counts");

    // The thread of the test harness allocates now and then; steps that allocate do so every time.
    for case in dvi_laws::all() {
        let mut run = case.run().expect("starts");
        let mut few = || (0..case.subject.steps / 4).for_each(|_| run.advance().expect("steps"));
        assert_eq!((0..3).map(|_| blocks(&mut few)).min(), Some(0), "{case:?}");
    }
    for case in dvi_laws::fused() {
        let mut run = case.run().expect("starts");
        let mut few = || (0..10).for_each(|_| run.advance().expect("steps"));
        assert_eq!((0..3).map(|_| blocks(&mut few)).min(), Some(0), "{case:?}");
    }

    let newton = |sigma: f64| Sigma { solver: Solver::Newton, ..Sigma::new(sigma) };
    let summation = Summation::Compensated;
    let compensated = Sigma { summation, ..Sigma::midpoint() };
    // Of a fixed size for which the stack is too small.
    let eleven = |f: fn(f64) -> f64| core::array::from_fn(|j| f(std::f64::consts::TAU * j as f64 / 11.0));
    let vortices_11 = PointVortices::<11> { gamma: [1.0; 11] };
    let start_11 = PointVorticesState { x: eleven(f64::cos), y: eleven(f64::sin) };
    assert_none!(vortices_11, start_11, Sigma::leapfrog(), Sigma::midpoint(), newton(0.5), Sigma::new(1.0));
    assert_none!(
        vortices_11,
        start_11,
        RungeKutta::classical(),
        Gauss::<3>::new(),
        Gauss::<4>::new().in_lanes()
    );
    assert_none!(vortices_11, start_11, Projected::symmetric(), compensated);

    let balls = Balls { m: vec![1.0, 2.0, 0.5] };
    let balls_start = BallsState { x: vec![0.5, 3.0, 6.0], dot_x: vec![0.0, -3.0, 2.0] };
    assert_none!(
        balls,
        balls_start,
        Impacts::new(Variational::trapezoid()),
        Impacts::new(Variational::midpoint()),
        Impacts::reflecting(Variational::trapezoid()),
        Impacts::reflecting(Galerkin::<3>::new())
    );
    let (system, start) = turning(2);
    assert_none!(
        system,
        start,
        Geodesic::trapezoid(),
        Geodesic::midpoint(),
        Composition::suzuki(Geodesic::trapezoid())
    );
    let [short, long] = [1000, 4000].map(of_links);
    assert!(long < 4.1 * short, "{long} bytes for four times as many rods as {short}");
    let [short, long] = [100, 400].map(|n| {
        let (system, start) = turning(n);
        bytes(&system, Geodesic::trapezoid(), (0.01, 3), start)
    });
    assert!(long < 4.1 * short, "{long} bytes for four times as many bodies as {short}");

    // Of variable length, on the stack and on the heap, with steps that are undone.
    let fitted = || Variational::simpson().phase_fitted(Radial(Reading::Averaged));
    let kepler = Kepler { mu: 1.0 };
    let kepler_start = KeplerState { x: 0.5, y: 0.0, dot_x: 0.0, dot_y: 3.0_f64.sqrt() };
    let chain = RunTimeChain { mass: vec![1.0, 2.0, 3.0], coupling: 0.125 };
    let chain_start =
        RunTimeChainState { q: vec![0.1, 0.5, -0.2], wall: 0.3, dot_q: vec![0.3, 0.1, -0.4], dot_wall: 0.2 };
    let (reversible, osculating) = (Reversible::power(0.02, 1.0), Osculating::new(1e-3, 10.0));
    assert_none_controlled!(kepler, kepler_start, reversible, Variational::trapezoid(), fitted());
    assert_none_controlled!(kepler, kepler_start, EnergyMomentum::new(0.01), Variational::midpoint());
    assert_none_controlled!(kepler, kepler_start, osculating, Variational::trapezoid(), fitted());
    // A condition that never comes true, one that comes near it, and states that are looked at on the way.
    let mut run =
        Integrator::new(&chain, Variational::trapezoid(), 0.05, chain_start.clone()).expect("starts");
    let mut looks = 0;
    let mut events = run
        .events([Direction::Either; 2], |_, state| {
            looks += 1;
            [state.wall - 50.0, 1e-9 + state.q[0] * state.q[0]]
        })
        .expect("starts");
    let mut advance = || assert!(events.advance().expect("steps").is_none());
    assert_eq!((0..3).map(|_| of_steps(&mut advance)).min(), Some(0));
    drop(events);
    assert!(looks > 400, "{looks}");
    let by_error = ErrorControl { breaks: &[0.1, 0.2, 20.0], ..ErrorControl::new(1e-9, 10.0) };
    assert_none_controlled!(kepler, kepler_start, by_error, Gauss::<2>::new(), Gauss::<8>::new().in_lanes());
    assert_none_controlled!(chain, chain_start, by_error, Gauss::<2>::new());
    // Steps that end at seams, which are located.
    let seamed = Seamed { walls: vec![0.3, -0.2] };
    let seamed_start = SeamedState { x: vec![1.0, -0.5], dot_x: vec![0.0, 0.1] };
    assert_none_controlled!(seamed, seamed_start, by_error, Gauss::<2>::new(), Gauss::<4>::new());
    assert_none_controlled!(chain, chain_start, reversible, Variational::trapezoid(), fitted());
    assert_none!(chain, chain_start, Langevin { friction: 0.3, temperature: 0.1, seed: 1 });

    // Friction stores no matrix where the mass matrix is diagonal and constant.
    let fixed_point = Variational { solver: Solver::FixedPoint, ..Variational::midpoint() };
    let grows = |[short, long]: [f64; 2]| assert!(long < 4.1 * short, "{short} bytes and {long}");
    grows([50, 200].map(|n| of_bodies(RungeKutta::classical(), n)));
    grows([50, 200].map(|n| of_bodies(fixed_point, n)));

    // By products with vectors.
    let krylov = Sigma { solver: Solver::NewtonKrylov, ..Sigma::midpoint() };
    for (method, least) in [(Sigma::midpoint(), 600), (krylov, 100)] {
        let [few, many] = [least, 2 * least].map(|n| of_vortices(method, n));
        assert!(many < 2.1 * few, "{method:?}: {few} bytes and {many}");
    }

    // Masses that are coupled, Newton's method, and a fixed point with Newton's method behind it.
    let newton = Solver::Newton;
    assert_linear!(
        Variational::trapezoid(),
        Variational::midpoint(),
        Variational { solver: newton, ..Variational::midpoint() },
        Newmark::new(0.25),
        Newmark { solver: newton, ..Newmark::new(0.25) },
        Galerkin::<3>::new(),
        Galerkin { solver: newton, ..Galerkin::<4>::new() },
    );

    // Sparse matrices: the tree has no narrow band.
    let (system, start) = tree(100);
    assert_none!(system, start, Variational { solver: newton, ..Variational::midpoint() });
    let [small, large] = [1023, 4095].map(of_tree);
    assert!(large < 4.1 * small, "{small} bytes and {large}");

    // A field on a grid, on every kind of axis.
    let axes = [
        Axis::uniform([0.0, 3.0], 7),
        Axis::new(&[0.0, 0.5, 2.0, 3.0]),
        Axis::periodic(&[0.0, 0.5, 1.0, 2.0], 3.0),
    ];
    let field =
        Spline::sample(axes.map(|axis| axis.expect("increases")), |[x, y, z]| x + y * z).expect("is full");
    let mut at = [0.0; 3];
    let blocks = of_steps(|| {
        at = at.map(|x| x + 0.03);
        std::hint::black_box(field.expansion(at));
    });
    assert_eq!(blocks, 0, "a spline");
}
