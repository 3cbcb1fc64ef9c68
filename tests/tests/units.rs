//! Units do not matter: where the unit of each block of coordinates, that of L and that of time change by
//! powers of two up to 2^±80, every method takes the same steps, scaled, bit for bit, however its equations
//! are solved.
//!
//! Each system is written in physical coordinates X = u x, with numbers x in units u, and in a time t τ.
//! What a run computes of X is exact in u and τ where these are powers of two; so any difference is a
//! decision that a method has taken in numbers and not in sizes.

mod systems;

use core::fmt::Debug;
use dvi_core::prelude::*;
use dvi_tests::apart;

use systems::{
    Amplitudes, Bead, Blade, Centre, Chain, Charge, CoupledMasses, DoublePendulum, Kepler, Predators,
    Tangled, Vortices,
};

/// Exponents of the units of coordinates, and of time.
type Exponents<const N: usize> = ([i32; N], i32);

/// Of so many kinds: one unit after the other, all of them to and fro, up to 2^±80.
fn exponents<const N: usize>() -> impl Iterator<Item = Exponents<N>> {
    let one = |k: usize, by: i32| (core::array::from_fn(|i| if i == k { by } else { 0 }), 0);
    let single = (0..N).flat_map(move |k| [one(k, 80), one(k, -80), one(k, 13)]);
    let mixed = [7, -41, 80].map(|by: i32| {
        let of = |i: usize| (by * (i as i32 * 5 + 3)) % 81;
        (core::array::from_fn(of), of(N) / 2)
    });
    let near = (core::array::from_fn(|i| (i as i32 * 5) % 13 - 6), 4);
    single.chain(mixed).chain([([0; N], 40), ([0; N], -80), near])
}

fn power(exponent: i32) -> f64 {
    f64::powi(2.0, exponent)
}

/// A system in units `u` and τ.
trait InUnits<const N: usize>: Lagrangian<f64> + Sized {
    const H: f64;
    fn system(u: [f64; N], tau: f64) -> Self;
    /// The start, coordinates and then velocities, in units of one.
    fn start() -> Vec<f64>;
    /// Which unit a coordinate has.
    fn unit(coordinate: usize) -> usize {
        coordinate
    }
}

/// The end of a run in units, in units of one.
fn end<const N: usize, S: InUnits<N>, M: Method<S, f64>>(
    (coordinates, time): Exponents<N>,
    method: M,
    steps: u64,
) -> Result<Vec<f64>, String> {
    let (u, tau) = (coordinates.map(power), power(time));
    let system = S::system(u, tau);
    let start = S::start();
    let n = system.names().filter(|name| !name.is_velocity).count();
    let factor = |k: usize| if k < n { 1.0 / u[S::unit(k)] } else { tau / u[S::unit(k - n)] };
    let scaled: Vec<f64> = start.iter().enumerate().map(|(k, x)| x * factor(k)).collect();
    let (q, v) = scaled.split_at(n);
    let state = S::State::read(&|block| system.block_len(block), q, v);
    let mut run = Integrator::new(&system, method, S::H / tau, state).map_err(|error| error.to_string())?;
    run.take_steps(steps).map_err(|error| error.to_string())?;
    let state = run.state();
    let values = system.values(&state).expect("a state of this system").enumerate();
    Ok(values.map(|(k, value)| value / factor(k)).collect())
}

fn check<const N: usize, S: InUnits<N>, M: Method<S, f64> + Clone + Debug>(method: M) {
    let name = format!("{method:?} on {}", S::REPORT.system);
    // The guess is that of all increments after the seventh.
    let steps = 9;
    let plain =
        end::<N, S, M>(([0; N], 0), method.clone(), steps).unwrap_or_else(|error| panic!("{name}: {error}"));
    assert!(plain.iter().all(|x| x.is_finite()) && plain != S::start(), "{name}: {plain:?}");
    for units in exponents::<N>() {
        let scaled = end::<N, S, M>(units, method.clone(), steps);
        let scaled = scaled.unwrap_or_else(|error| panic!("{name} in {units:?}: {error}"));
        let agree = plain.iter().zip(&scaled).all(|(a, b)| a.to_bits() == b.to_bits());
        assert!(agree, "{name} in {units:?}: {scaled:?}, and not {plain:?}");
    }
}

/// Each method on each system, which has so many units.
macro_rules! check {
    ($($system:ident[$units:literal]: $($method:expr),+;)+) => {$($(
        check::<$units, $system, _>($method);
    )+)+};
}

const SOLVERS: [Solver; 4] = [Solver::Automatic, Solver::FixedPoint, Solver::Newton, Solver::NewtonKrylov];

#[test]
fn of_degenerate_systems() {
    for solver in SOLVERS {
        let midpoint = Sigma { solver, ..Sigma::midpoint() };
        check! {
            Vortices[2]: midpoint;
            Predators[3]: midpoint;
            Centre[4]: midpoint;
            Amplitudes[2]: midpoint;
            Tangled[4]: midpoint;
        }
    }
    check! {
        Tangled[4]: Gauss::<2>::new(), Projected::symmetric(), RungeKutta::classical();
        Vortices[2]: Sigma::leapfrog();
        Predators[3]: OneStep::midpoint(), OneStep::trapezoid(), OneStepGauss::<2>::new();
        Amplitudes[2]: OneStep::midpoint();
        Centre[4]: Projected::symmetric(), Gauss::<2>::new();
    }
}

fn regular_systems(solver: Solver) {
    let midpoint = Variational { solver, ..Variational::midpoint() };
    check! {
        Kepler[3]: midpoint, Galerkin { solver, ..Galerkin::<4>::new() };
        DoublePendulum[2]: midpoint;
        Charge[3]: midpoint;
        Chain[2]: midpoint, Newmark { solver, ..Newmark::new(0.25) };
        Chain[2]: Galerkin { solver, ..Galerkin::<3>::new() };
        CoupledMasses[3]: midpoint;
    }
}

#[test]
fn of_regular_systems_by_newton() {
    regular_systems(Solver::Newton);
}

#[test]
fn of_regular_systems_without_a_matrix() {
    regular_systems(Solver::NewtonKrylov);
}

#[test]
fn of_regular_systems() {
    regular_systems(Solver::Automatic);
    check! {
        Kepler[3]: Variational::trapezoid(), Gauss::<8>::new().in_lanes();
        CoupledMasses[3]: Variational::trapezoid(), Gauss::<2>::new();
        DoublePendulum[2]: Gauss::<2>::new();
        Charge[3]: Gauss::<2>::new();
    }
}

#[test]
fn of_systems_with_constraints() {
    check! {
        Bead[5]: Rattle::default(), Constrained::new(Midpoint);
        Blade[3]: Constrained::new(Midpoint);
    }
}

/// A mass on a spring whose rest is far from the origin: where a correction no longer shrinks, its residual
/// is looked at.
#[degenerate_lagrangian(
    coordinates(x, p),
    one_form = p * d(x),
    hamiltonian = p * p / (2.0 * m) + m * (x - rest).powi(2) / 2.0,
)]
struct FarSpring {
    m: f64,
    rest: f64,
}

#[test]
fn beside_a_large_offset() {
    for (exponent, rest, way) in [(-90, 1e8, 1.0), (-40, 1e8, 1.0), (0, 1e8, 1.0), (-90, 1e3 / 7.0, 1e-5)] {
        let (m, steps) = (power(exponent), 200);
        let system = FarSpring { m, rest };
        let start = FarSpringState { x: rest + way, p: 0.0 };
        let mut run = Integrator::new(&system, OneStep::midpoint(), 0.3, start).expect("a start");
        run.take_steps(steps).expect("a bounded motion");
        // Each step of the midpoint rule turns by 2 atan(h/2).
        let turned = 2.0 * f64::atan(0.15) * steps as f64;
        let velocity = run.state().p / m;
        assert!((velocity + way * turned.sin()).abs() < 1e-6 * way, "{exponent}, {rest}: {velocity:e}");
    }
}

/// Masses on springs, of which one is moved.
#[lagrangian(
    coordinates(x[n]),
    lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0)
        - sum(1..n, |j| (x[j] - x[j - 1]).powi(2) / 2.0 + (x[j] - x[j - 1]).powi(4) / 4.0),
)]
struct Springs {
    n: usize,
}

fn moved_in_the_middle<M: Method<Springs, f64>>(n: usize, method: M) -> Vec<f64> {
    let mut start = SpringsState { x: vec![0.0; n], dot_x: vec![0.0; n] };
    start.x[n / 2] = 0.3;
    let system = Springs { n };
    let mut run = Integrator::new(&system, method, 0.05, start).expect("a start");
    run.take_steps(60).unwrap_or_else(|error| panic!("{n} masses: {error}"));
    // Beside the mass that moves the last ones are nothing, and need no iteration of their own.
    let iterations = run.statistics().iterations;
    assert!(iterations < 720, "{n} masses: {iterations}");
    run.state().x
}

#[test]
fn where_a_wave_has_not_arrived() {
    for n in [10, 200] {
        for compare in [
            |n, solver| moved_in_the_middle(n, Variational { solver, ..Variational::midpoint() }),
            |n, solver| moved_in_the_middle(n, Newmark { solver, ..Newmark::new(0.25) }),
            |n, solver| moved_in_the_middle(n, Galerkin { solver, ..Galerkin::<3>::new() }),
            |n, solver| moved_in_the_middle(n, Gauss { solver, ..Gauss::<2>::new() }),
        ] {
            let fixed_point: Vec<f64> = compare(n, Solver::FixedPoint);
            for solver in [Solver::Automatic, Solver::Newton, Solver::NewtonKrylov] {
                let other = compare(n, solver);
                let farthest = apart(&fixed_point, &other);
                assert!(farthest < 1e-14, "{n} masses, {solver:?}: {farthest:e}");
            }
        }
    }
}

/// A planet in metres, seconds and kilograms.
#[degenerate_lagrangian(
    coordinates(r, pr, l, phi),
    one_form = pr * d(r) + l * d(phi),
    hamiltonian = pr.powi(2) / (2.0 * m) + l.powi(2) / (2.0 * m * r.powi(2)) - m * mu / r,
)]
struct Planet {
    m: f64,
    mu: f64,
}

fn stays_on_its_circle<M: Method<Planet, f64>>(m: f64, method: M) {
    let (mu, r) = (1.327e20, 1.496e11);
    let start = PlanetState { r, pr: 0.0, l: m * f64::sqrt(mu * r), phi: 0.0 };
    let planet = Planet { m, mu };
    let mut run = Integrator::new(&planet, method, 86_400.0, start).expect("a start");
    run.take_steps(400).unwrap_or_else(|error| panic!("a mass of {m:e}: {error}"));
    let off = run.state().r / r - 1.0;
    assert!(off.abs() < 1e-13, "a mass of {m:e}: {off:e}");
}

/// The radial momentum is nothing but rounding errors, and is not known to any part of itself.
#[test]
fn a_coordinate_that_is_rounding_errors() {
    for m in [1.0, 3.0, 1e3, 1e10, 5.972e24, 1.898e27] {
        for solver in SOLVERS {
            stays_on_its_circle(m, Sigma { solver, ..Sigma::midpoint() });
        }
        stays_on_its_circle(m, OneStep::midpoint());
        stays_on_its_circle(m, OneStep::trapezoid());
        stays_on_its_circle(m, OneStepGauss::<2>::new());
        stays_on_its_circle(m, Projected::symmetric());
        stays_on_its_circle(m, Gauss::<2>::new());
    }
}
