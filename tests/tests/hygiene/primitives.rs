//! Systems of all kinds where the names of the primitive types mean something else.
#![allow(dead_code, non_camel_case_types)]

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
    pub(super) gamma: Vec<::core::primitive::f64>,
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

/// A body and a direction.
#[::dvi_core::lagrangian(
    coordinates(R: SO3, s: S2, w),
    lagrangian = omega(R)[0].powi(2) + omega(R)[1].powi(2) + omega(R)[2].powi(2) + dot(w).powi(2)
        + dot(s[0]).powi(2) + dot(s[1]).powi(2) + dot(s[2]).powi(2) - R[2][2] * g * s[2],
)]
#[derive(Debug)]
pub struct Body {
    pub(super) g: f64,
}

/// Bodies above a floor.
#[::dvi_core::lagrangian(
    coordinates(x[n], y[n]),
    lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0 + dot(y[j]).powi(2))
        + sum_pairs(0..n, |j, k| 1.0 / (x[j] - x[k]).hypot(y[j] - y[k])),
    impact(i in 0..n) = x[i],
)]
#[derive(Debug)]
pub struct Bodies {
    pub(super) n: ::core::primitive::usize,
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
    let system = AtRunTime { gamma: vec![1.0; 3] };
    let expected = 3.0 * 0.125 + 0.125 - (0.5_f64.hypot(0.5).powf(0.5) + 1.5);
    assert!((super::value(&system, 8) - expected).abs() < 1e-15);
    // L = Σ v²/2 − cos(x)·g
    let chain = Chain::<2, f64> { g: 2.0 };
    let expected = 2.0 * (0.03125 - 2.0 * 0.5_f64.cos());
    assert!((super::value(&chain, 2) - expected).abs() < 1e-15);
}
