//! Sizes that are const generics, from none to a thousand: what is right at each of them, on the stack of a
//! small thread. And sizes of a run that no memory holds.

use approx::abs_diff_eq;
use std::error::Error;
use std::thread;

use dvi_core::IndexError;
use dvi_core::ensemble::{Ensemble, Outcome};
use dvi_core::prelude::*;
use dvi_core::space::Space;
use dvi_tests::systems::{PointVortices, PointVorticesState};

type Checked = Result<(), Box<dyn Error + Send + Sync>>;

/// Oscillators of frequency 1, of a size that is a const generic, and of one that is a field.
macro_rules! degenerate {
    ($name:ident [$($generics:tt)*] { $($field:tt)* } $n:tt) => {
        #[degenerate_lagrangian(
            coordinates(q[$n], p[$n]),
            one_form = sum(0..$n, |j| p[j] * d(q[j])),
            hamiltonian = sum(0..$n, |j| p[j] * p[j] + q[j] * q[j]) / 2.0,
        )]
        #[derive(Debug, PartialEq)]
        struct $name $($generics)* { $($field)* }
    };
}

/// The same in L, with terms that couple velocities of several of them.
macro_rules! regular {
    ($name:ident [$($generics:tt)*] { $($field:tt)* } $n:tt, $coupled:literal) => {
        #[lagrangian(
            coordinates(q[$n]),
            lagrangian = sum(0..$n, |j| dot(q[j]) * dot(q[j]) - q[j] * q[j]) / 2.0
                + sum(1..$n, |j| $coupled * dot(q[j]) * dot(q[j - 1])),
        )]
        #[derive(Debug, PartialEq)]
        struct $name $($generics)* { $($field)* }
    };
}

/// The same in u, q = sinh(u): the mass matrix varies.
macro_rules! varying {
    ($name:ident [$($generics:tt)*] { $($field:tt)* } $n:tt) => {
        #[lagrangian(
            coordinates(u[$n]),
            lagrangian = sum(0..$n, |j| (u[j].cosh() * dot(u[j])).powi(2) - u[j].sinh().powi(2)) / 2.0,
        )]
        #[derive(Debug, PartialEq)]
        struct $name $($generics)* { $($field)* }
    };
}

degenerate!(Waves [<const N: usize>] {} N);
degenerate!(LongWaves [] { n: usize } n);
regular!(Springs [<const N: usize>] {} N, 0.2);
regular!(LongSprings [] { n: usize } n, 0.2);
regular!(Free [<const N: usize>] {} N, 0.0);
varying!(Bent [<const N: usize>] {} N);
varying!(LongBent [] { n: usize } n);

const NEWTON: Solver = Solver::Newton;
const H: f64 = 0.01;
/// Of q or u, and of p or a velocity, at the start.
const START: [f64; 2] = [0.6, -0.3];

/// Where a run is after so many steps.
fn end<S: Lagrangian, M: Method<S, f64>>(
    system: &S,
    method: M,
    steps: u64,
    start: S::State<f64>,
) -> Result<Vec<f64>, Box<dyn Error + Send + Sync>> {
    let mut run = Integrator::new(system, method, H, start)?;
    run.take_steps(steps)?;
    assert!(run.energy().is_finite());
    Ok(run.q().to_vec())
}

/// q = a cos t + b sin t after a number of steps.
fn oscillation(steps: u64) -> f64 {
    let (sin, cos) = (H * steps as f64).sin_cos();
    START[0] * cos + START[1] * sin
}

/// No coordinates stay none, whether the size is a const generic or a field, and one moves as the closed form
/// says.
macro_rules! none_and_one {
    ($fixed:ident, $long:ident, $state:ident, $long_state:ident { $q:ident, $v:ident }, $exact:expr, $($method:expr),+ $(,)?) => {$({
        let name = concat!(stringify!($fixed), ", ", stringify!($method));
        let none = end(&$fixed::<0> {}, $method, 3, $state { $q: [], $v: [] })?;
        assert_eq!(none, [0.0; 0], "{name}");
        let long = |n: usize| {
            end(&$long { n }, $method, 100, $long_state { $q: vec![START[0]; n], $v: vec![START[1]; n] })
        };
        assert_eq!(long(0)?, [0.0; 0], "{name}");
        let (one, exact): (_, f64) = (long(1)?, $exact);
        assert!(abs_diff_eq!(one[0], exact, epsilon = 4e-5), "{name}: {one:?}, not {exact}");
    })+};
}

#[test]
fn none_and_one_of_a_degenerate_system() -> Checked {
    none_and_one!(
        Waves,
        LongWaves,
        WavesState,
        LongWavesState { q, p },
        oscillation(100),
        Sigma::midpoint(),
        Sigma { solver: NEWTON, ..Sigma::midpoint() },
        Sigma { solver: Solver::FixedPoint, ..Sigma::midpoint() },
        OneStep::midpoint(),
        OneStepGauss::<2>::new(),
        Projected::symmetric(),
        Gauss::<2>::new().in_lanes(),
        RungeKutta::classical(),
    );
    Ok(())
}

#[test]
fn none_and_one_of_a_regular_system() -> Checked {
    none_and_one!(
        Springs,
        LongSprings,
        SpringsState,
        LongSpringsState { q, dot_q },
        oscillation(100),
        Variational::trapezoid(),
        Variational { solver: NEWTON, ..Variational::midpoint() },
        Variational { summation: Summation::Compensated, ..Variational::midpoint() },
        Newmark { solver: NEWTON, ..Newmark::new(0.25) },
        Galerkin::<3>::new(),
        Galerkin { solver: NEWTON, ..Galerkin::<3>::new() },
        Galerkin::<4>::new().in_lanes(),
        Gauss::<2>::new(),
        RungeKutta::classical(),
        Langevin { friction: 0.0, temperature: 0.0, seed: 1 },
    );
    // q = sinh(u), and cosh(u) u' is its velocity.
    let (sin, cos) = 1.0_f64.sin_cos();
    let exact = (START[0].sinh() * cos + START[0].cosh() * START[1] * sin).asinh();
    none_and_one!(
        Bent,
        LongBent,
        BentState,
        LongBentState { u, dot_u },
        exact,
        Variational::trapezoid(),
        Gauss::<2>::new(),
    );
    Ok(())
}

/// Oscillators beside one that is always there.
#[lagrangian(
    coordinates(q[N], w),
    lagrangian = (sum(0..N, |j| dot(q[j]) * dot(q[j]) - q[j] * q[j]) + dot(w) * dot(w) - w * w) / 2.0,
)]
#[derive(Debug)]
struct Beside<const N: usize>;

#[test]
fn none_beside_one() -> Checked {
    let start = BesideState { q: [], w: START[0], dot_q: [], dot_w: START[1] };
    let found = end(&Beside::<0>, Galerkin { solver: NEWTON, ..Galerkin::<3>::new() }, 3, start)?;
    assert!(found.len() == 1 && (found[0] - oscillation(3)).abs() < 1e-9, "{found:?}");
    Ok(())
}

#[test]
fn what_is_measured_on_no_coordinates() -> Checked {
    let (waves, start) = (Waves::<0> {}, WavesState { q: [], p: [] });
    let mut run = Integrator::new(&waves, Sigma::midpoint(), H, start)?;
    LyapunovExponent::new(&run).advance(&mut run)?;
    let springs = Springs::<0> {};
    let method = Variational::midpoint();
    let mut map = TangentMap::new(&springs, &method);
    let none = springs.space().vector();
    map.evaluate(&springs, dvi_core::discrete::Interval { t: 0.0, h: H }, &none, &none)?;
    map.apply(&mut springs.space().vector(), &mut springs.space().vector());
    let states = (0..9).map(|_| SpringsState { q: [], dot_q: [] });
    let results =
        Ensemble::new(&springs, Variational::trapezoid(), H, states).in_lanes::<8>().take_steps(3)?;
    assert!(results.members().iter().all(|member| member.outcome == Outcome::Finished));
    Ok(())
}

/// Two megabytes are what Rust gives to a thread.
fn on_a_small_stack(run: impl FnOnce() -> Checked + Send + 'static) -> Checked {
    let run = thread::Builder::new().stack_size(2 << 20).spawn(run)?;
    run.join().map_err(|_| "the thread panicked")?
}

macro_rules! fit {
    ($n:literal; $system:expr, $state:ident { $q:ident, $v:ident }, $($method:expr),+ $(,)?) => {$(
        on_a_small_stack(|| {
            let start = $state { $q: [START[0]; $n], $v: [START[1]; $n] };
            let found = end(&$system, $method, 2, start)?;
            let worst = found[..$n].iter().map(|q| (q - oscillation(2)).abs()).fold(0.0, dvi_tests::larger);
            assert!(worst < 1e-6, "{}, {}: {worst:e}", stringify!($system), stringify!($method));
            Ok(())
        })?;
    )+};
}

#[test]
fn a_thousand_fit_on_a_small_stack() -> Checked {
    fit!(
        1000; Waves::<1000> {}, WavesState { q, p },
        Sigma::midpoint(),
        Gauss::<8>::new().in_lanes(),
    );
    fit!(
        1000; Free::<1000> {}, FreeState { q, dot_q },
        Variational::trapezoid(),
        Galerkin::<3>::new(),
        Gauss::<8>::new().in_lanes(),
        Langevin { friction: 0.0, temperature: 0.0, seed: 1 },
    );
    Ok(())
}

#[test]
fn forty_fit_on_a_small_stack_with_matrices() -> Checked {
    fit!(
        40; Waves::<40> {}, WavesState { q, p },
        Sigma { solver: NEWTON, ..Sigma::midpoint() },
        OneStepGauss::<3>::new(),
        Projected::symmetric(),
    );
    fit!(
        40; Free::<40> {}, FreeState { q, dot_q },
        Variational { solver: NEWTON, ..Variational::midpoint() },
        Galerkin::<8>::new().in_lanes(),
    );
    Ok(())
}

// Sizes that are numbers: of a dozen, all is in the values.
degenerate!(SixWaves [] {} 6);
regular!(Dozen [] {} 12, 0.0);
regular!(Thousand [] {} 1000, 0.0);

#[test]
fn literal_sizes_fit_on_a_small_stack() -> Checked {
    fit!(6; SixWaves {}, SixWavesState { q, p }, OneStepGauss::<3>::new(), Projected::symmetric());
    fit!(12; Dozen {}, DozenState { q, dot_q }, Galerkin { solver: NEWTON, ..Galerkin::<9>::new() });
    fit!(1000; Thousand {}, ThousandState { q, dot_q }, Gauss::<8>::new().in_lanes());
    Ok(())
}

/// A polygon of `N` equal vortices on the unit circle turns at the rate Γ(N − 1)/4π (Thomson 1883).
fn polygon<const N: usize>(angle: f64) -> PointVorticesState<N> {
    let place = |j: usize| angle + core::f64::consts::TAU * j as f64 / N as f64;
    PointVorticesState {
        x: core::array::from_fn(|j| place(j).cos()),
        y: core::array::from_fn(|j| place(j).sin()),
    }
}

fn turns<const N: usize>(method: Sigma) -> Checked {
    on_a_small_stack(move || {
        let (system, h) = (PointVortices::<N> { gamma: [1.0; N] }, 6e-3 / N as f64);
        let mut run = Integrator::new(&system, method, h, polygon(0.0))?;
        // A tangent map takes a matrix of all coordinates.
        if N <= 60 {
            LyapunovExponent::new(&run).advance(&mut run)?;
        } else {
            run.take_steps(1)?;
        }
        run.take_steps(1)?;
        let exact = polygon::<N>(2.0 * h * (N as f64 - 1.0) / (4.0 * core::f64::consts::PI));
        let found = run.state();
        for j in 0..N {
            let off = (found.x[j] - exact.x[j]).hypot(found.y[j] - exact.y[j]);
            assert!(off < 1e-7, "{N} vortices, number {j}: {off:e}");
        }
        // The workers of an ensemble have threads of that size.
        let states = |count: u32| (0..count).map(|k| polygon::<N>(f64::from(k)));
        let results = Ensemble::new(&system, method, h, states(1)).take_steps(1)?;
        let in_lanes = Ensemble::new(&system, method, h, states(9)).in_lanes::<8>().take_steps(1)?;
        let members = results.members().iter().chain(in_lanes.members());
        for member in members {
            assert_eq!(member.outcome, Outcome::Finished, "{N} vortices");
        }
        Ok(())
    })
}

#[test]
fn many_vortices_fit_on_a_small_stack() -> Checked {
    turns::<60>(Sigma::midpoint())?;
    turns::<1000>(Sigma::midpoint())?;
    turns::<60>(Sigma::leapfrog())
}

/// A square lattice, and two waves for each number.
#[lagrangian(
    coordinates(q[n * n]),
    lagrangian = sum(0..n, |i| sum(0..n, |j| dot(q[n * i + j]).powi(2) - q[n * i + j].powi(2))) / 2.0,
)]
struct Lattice {
    n: usize,
}

#[degenerate_lagrangian(
    coordinates(q[2 * n], p[2 * n]),
    one_form = sum(0..2 * n, |j| p[j] * d(q[j])),
    hamiltonian = sum(0..2 * n, |j| p[j] * p[j] + q[j] * q[j]) / 2.0,
)]
struct TwoWaves {
    n: usize,
}

/// No state is as long as these say, and no size wraps around to that of one.
#[test]
fn sizes_beyond_all_memory_are_errors() {
    let q = vec![0.0];
    for n in [1 << 32, usize::MAX] {
        let start = LatticeState { q: q.clone(), dot_q: q.clone() };
        let error = Integrator::new(Lattice { n }, Variational::midpoint(), 0.1, start).err();
        assert!(matches!(error, Some(StartError::Index(IndexError { array: "q", .. }))), "{n}: {error:?}");
    }
    // One array is in memory, two are not.
    for (n, ends) in [(1 << 63, "q"), (usize::MAX >> 5, "p")] {
        let start = TwoWavesState { q: q.clone(), p: q.clone() };
        let error = Integrator::new(TwoWaves { n }, Sigma::midpoint(), 0.1, start).err();
        let Some(StartError::Index(IndexError { array, .. })) = error else { panic!("{n}: {error:?}") };
        assert_eq!(array, ends, "{n}");
    }
}
