//! Systems of all kinds where neither primitive types nor the prelude nor crates mean what they should.
#![allow(dead_code, missing_debug_implementations, non_camel_case_types, unused_macros)]

type f32 = u8;
type f64 = ::core::primitive::f32;
type i64 = u8;
type i128 = u8;
type isize = u8;
type usize = u8;
type bool = u8;
type char = u8;
type str = u8;
type u8 = ();

struct Option;
struct Result;
struct Some;
struct None;
struct Ok;
struct Err;
struct Vec;
struct Box;
struct String;
struct K;
struct W;
struct Fixed;
struct RunTime;
trait Copy {}
trait Clone {}
trait Debug {}
trait PartialEq {}
trait From {}
trait Fn {}
trait Sized {}
trait Scalar {}
trait Iterator {}
trait Sink {}
trait Space {}
trait ConstrainedSystem {}
trait HolonomicLagrangian {}
trait NonholonomicLagrangian {}
trait ManifoldSystem {}
trait ManifoldLagrangian {}
trait UnilateralLagrangian {}
fn drop() {}
mod core {}
mod std {}
mod alloc {}
mod dvi_core {}
macro_rules! unreachable {
    () => {};
}
macro_rules! vec {
    () => {};
}

/// Vortices of a number that the run knows.
#[::dvi_core::degenerate_lagrangian(
    coordinates(x[gamma.len()], y[gamma.len()], u, w),
    one_form = sum(0..gamma.len(), |j| gamma[j] * x[j] * d(y[j])) + u * d(w),
    hamiltonian = sum_pairs(0..gamma.len(), |j, k|
        if x[j] < x[k] { (x[j] - x[k]).powi(2) } else { (y[(j + 1) % gamma.len()] - y[k]).powi(4) })
        + u.hypot(w).powf(u) + gamma.len() as f64 * u,
    momenta(all = sum(0..gamma.len(), |j| gamma[j] * y[j])),
)]
#[derive(Debug)]
pub struct AtRunTime {
    pub(super) gamma: ::std::vec::Vec<::core::primitive::f64>,
}

/// Vortices on the stack.
#[::dvi_core::degenerate_lagrangian(
    coordinates(x[N], y[N]),
    one_form = sum(0..N, |j| x[j] * d(y[j])),
    hamiltonian = sum_pairs(0..N, |j, k| ((x[j] - x[k]).powi(2) + (y[j] - y[k]).powi(2)).ln()),
)]
#[derive(Debug)]
pub struct Stacked<const N: ::core::primitive::usize>;

/// A system with a time of its own.
#[::dvi_core::degenerate_lagrangian(
    coordinates(x, y),
    one_form = x * d(y),
    hamiltonian = x * y * g,
    time_transform = 1.0 + x * x,
    gauge = x * y,
)]
#[derive(Debug)]
pub struct Timed {
    pub(super) g: ::core::primitive::f64,
}

/// A chain with friction.
#[::dvi_core::lagrangian(
    coordinates(x[N]),
    lagrangian = sum(0..N, |j| dot(x[j]).powi(2) / 2.0 - x[j].cos() * g),
    force(x) = |i| -dot(x[i]),
    constraint(i in 1..N) = (x[i] - x[i - 1]).powi(2),
)]
#[derive(Debug)]
pub struct Chain<const N: ::core::primitive::usize, P> {
    pub(super) g: P,
}

/// Masses of a number that the run knows.
#[::dvi_core::lagrangian(
    coordinates(x[mass.len()], u),
    lagrangian = sum(0..mass.len(), |j| mass[j] * dot(x[j]).powi(2)) + (1.0 + dot(u).powi(2)).sqrt()
        - sum_pairs(0..mass.len(), |j, k| if x[j] < x[k] { x[j] } else { x[k] * u }),
    momenta(all = sum(0..mass.len(), |j| mass[j] * dot(x[j]))),
)]
pub struct Masses {
    pub(super) mass: ::std::vec::Vec<::core::primitive::f64>,
}

/// A chain whose length the run knows.
#[::dvi_core::lagrangian(
    coordinates(x[mass.len()]),
    lagrangian = sum(0..mass.len(), |j| mass[j] * dot(x[j]).powi(2)),
    constraint(j in 0..mass.len() - 1) = x[j + 1] - mass[j] * x[j],
)]
pub struct Linked {
    pub(super) mass: ::std::vec::Vec<::core::primitive::f64>,
}

/// Constraints of the velocities, and names that generated code might use.
#[::dvi_core::lagrangian(
    coordinates(q[weights.len()], nonholonomic),
    lagrangian = sum(0..weights.len(), |v| dot(q[v]).powi(2)) + dot(nonholonomic).powi(2),
    nonholonomic(v in 0..weights.len()) = weights[v] * dot(q[v]) - g0 * nonholonomic * q[v],
    nonholonomic = nonholonomic * dot(nonholonomic) - sink,
)]
pub struct Rolling {
    pub(super) weights: ::std::vec::Vec<::core::primitive::f64>,
    pub(super) g0: ::core::primitive::f64,
    pub(super) sink: ::core::primitive::f64,
}

/// Rotations and unit vectors, likewise; `omega` is a field too.
#[::dvi_core::lagrangian(
    coordinates(r#type: SO3, dot: S2, q[weights.len()]),
    lagrangian = sum(0..weights.len(), |v| weights[v] * dot(q[v]).powi(2))
        + sum(0..3, |v| dot(dot[v]).powi(2))
        + omega * (omega(r#type)[0].powi(2) + omega(r#type)[1].powi(2) + omega(r#type)[2].powi(2))
        - r#type[0][1] * dot[2] * tangent,
)]
pub struct Turning {
    pub(super) weights: ::std::vec::Vec<::core::primitive::f64>,
    pub(super) omega: ::core::primitive::f64,
    pub(super) tangent: ::core::primitive::f64,
}

/// Impacts, likewise.
#[::dvi_core::lagrangian(
    coordinates(q[n], impact),
    lagrangian = sum(0..n, |v| dot(q[v]).powi(2)) + dot(impact).powi(2),
    impact(v in 0..n) = weights[v] * q[v] - g0 * impact,
    impact = impact * impact - sink * t,
)]
pub struct Walled {
    pub(super) n: ::core::primitive::usize,
    pub(super) weights: ::std::vec::Vec<::core::primitive::f64>,
    pub(super) g0: ::core::primitive::f64,
    pub(super) sink: ::core::primitive::f64,
}

/// A function of two numbers, and a blade.
#[::dvi_core::lagrangian(
    coordinates(x, y),
    lagrangian = dot(x).powi(2) / 2.0 + dot(y).powi(2) - psi(x, y),
    nonholonomic = dot(x) - y * dot(y),
)]
#[derive(Debug)]
pub struct Blade<Psi> {
    pub(super) psi: Psi,
}

#[test]
fn the_numbers_are_those_of_the_formulas() {
    // L = Σ γ x v_y + u v_w − H at q = 1/2, v = 1/4, where all bodies are at one place and the sum over
    // pairs is zero.
    let system = AtRunTime { gamma: ::std::vec![1.0; 3] };
    let expected = 3.0 * 0.125 + 0.125 - (0.5_f64.hypot(0.5).powf(0.5) + 1.5);
    assert!((super::value(&system, 8) - expected).abs() < 1e-15);
    // L = Σ v²/2 − cos(x)·g
    let chain = Chain::<2, ::core::primitive::f64> { g: 2.0 };
    let expected = 2.0 * (0.03125 - 2.0 * 0.5_f64.cos());
    assert!((super::value(&chain, 2) - expected).abs() < 1e-15);
}
