//! Derivatives at points where the rules of differentiation give 0/0, against limits found by hand.

use approx::relative_eq;
use dvi_core::Weights;
use dvi_core::prelude::*;
use dvi_tests::filling;

/// ∂L/∂q and ∂²L/∂q∂q.
fn position_derivatives<S: Lagrangian, const N: usize>(system: &S, q: [f64; N]) -> ([f64; N], Vec<f64>) {
    let (mut gradient, mut momentum, mut matrix) = ([0.0; N], [0.0; N], vec![0.0; N * N]);
    let weights = Weights { qq: 1.0, qv: 0.0, vq: 0.0, vv: 0.0 };
    let at_rest = [0.0; N];
    system.linearize(&q, &at_rest, 0.0, weights, &mut gradient, &mut momentum, &mut filling(&mut matrix, N));
    (gradient, matrix)
}

/// ∇H and ∂²H/∂q∂q at a point: L = α·v − H with v = 0.
pub(super) fn at_point<S: DegenerateLagrangian, const N: usize>(
    system: &S,
    q: [f64; N],
) -> ([f64; N], Vec<f64>) {
    let (mut gradient, (_, matrix)) = ([0.0; N], position_derivatives(system, q));
    system.hamiltonian_gradient(&q, 0.0, &mut gradient);
    (gradient, matrix.iter().map(|entry| -entry).collect())
}

/// The first derivatives at the origin are zero, and the second ones these, which may be no numbers.
#[track_caller]
fn assert_at_origin<const N: usize>(hamiltonian: &str, found: ([f64; N], Vec<f64>), second: &[f64]) {
    let is_same = |(a, b): (&f64, &f64)| a == b || a.is_nan() && b.is_nan();
    let is_right = found.0 == [0.0; N] && found.1.iter().zip(second).all(is_same);
    assert!(is_right && found.1.len() == second.len(), "{hamiltonian}: {found:?}");
}

/// Of coordinates, α and the number of coordinates: a name, H, and its second derivatives at the origin, row
/// by row.
macro_rules! at_the_origin {
    ($test:ident, $coordinates:tt, $form:expr, $n:literal;
        $($name:ident: $hamiltonian:expr => $second:expr;)+) => {
        $(
            #[degenerate_lagrangian(coordinates $coordinates, one_form = $form, hamiltonian = $hamiltonian)]
            struct $name;
        )+

        #[test]
        fn $test() {
            $(assert_at_origin(stringify!($hamiltonian), at_point(&$name, [0.0; $n]), &$second);)+
        }
    };
}

at_the_origin! {
    derivatives_at_the_origin_are_limits, (x, y), y * d(x), 2;
    PowerOfX: x.powf(1.5) * x.powf(1.5) + y * y => [0.0, 0.0, 0.0, 2.0];
    Cube: (x * x + y * y).powf(1.5) => [0.0; 4];
    SquareOfHypot: x.hypot(y).powi(2) => [2.0, 0.0, 0.0, 2.0];
    RootOfFourth: x.powi(4).sqrt() + y.powi(2) => [2.0, 0.0, 0.0, 2.0];
    RootOfSquare: (x * x + y * y).powi(2).sqrt() => [2.0, 0.0, 0.0, 2.0];
    CubeRoot: x.cbrt().powi(6) + y.cbrt().powi(9) => [2.0, 0.0, 0.0, 0.0];
    Quarter: (x * x + 4 * y * y).powf(1.75) => [0.0; 4];
    TimesCosine: (x * x + y * y).powf(1.5) * x.cos() => [0.0; 4];
    TimesX: { let r = x.hypot(y); r * r * r * x } => [0.0; 4];
    Product: (x * y).powi(2).powf(1.5) => [0.0; 4];
    SeveralTerms: (x * x + y * y).powf(1.5) * y.exp() + (x * x + 3 * y * y).powf(2.5) - x.hypot(y).powi(3) * x
        => [0.0; 4];
    Powers: (x * x + y * y).powf(1.25) + x.hypot(y).powf(2.5) => [0.0; 4];
    SquareOfSize: x.abs().powi(2) + (y * y).sqrt().powi(2) => [2.0, 0.0, 0.0, 2.0];
    CosineOfSize: x.abs().cos() + y.abs().cosh() => [-1.0, 0.0, 0.0, 1.0];
    SizeTimesSine: x.abs() * x.abs().sin() + y.abs().hypot(1.0) => [2.0, 0.0, 0.0, 1.0];
    ReciprocalOfSize: 1 / (1 + x.abs().powi(2)) - (x - y).abs().powi(2) => [-4.0, 2.0, 2.0, -2.0];
    Fifth: x.hypot(y).powi(5) * (1 + x) + y.powi(2) => [0.0, 0.0, 0.0, 2.0];
    PowerThatVaries: y * y - x.powf(2 + y) => [-2.0, 0.0, 0.0, 2.0];
}

// The first derivative alone has a limit that the compiler finds; the second is not a number, never another
// number.
at_the_origin! {
    second_derivatives_without_a_limit_are_no_numbers, (x, y), y * d(x), 2;
    Cosine: x.hypot(y).cos() => [f64::NAN; 4];
    HyperbolicCosine: x.hypot(y).cosh() => [f64::NAN; 4];
    CosineOfRoot: (x * x + y * y).sqrt().cos() => [f64::NAN; 4];
    ThreeQuarters: (x * x + y * y).powf(0.75) => [f64::NAN; 4];
    RootOfThreeHalves: x.hypot(y).powf(1.5) => [f64::NAN; 4];
}

// Sums are grouped as they are written.
at_the_origin! {
    second_derivatives_at_the_origin_of_space_are_limits, (x, y, z, w), x * d(y) + z * d(w), 4;
    ThreeHalves: (x * x + y * y + z * z).powf(1.5) => [0.0; 16];
    FiveQuarters: (x * x + y * y + z * z + w * w).powf(1.25) => [0.0; 16];
    CubeOfRoot: (x * x + y * y + z * z).sqrt().powi(3) => [0.0; 16];
    TimesRoot: { let r2 = x * x + y * y + z * z; r2 * r2.sqrt() } => [0.0; 16];
    Weighted: (2.0 * x * x + 0.5 * y.powi(2) + z * z).powf(1.5) => [0.0; 16];
}

/// At the end of a domain the limit is another one: ∂(√x sin √x)/∂x is 1 at 0, and is not found.
#[degenerate_lagrangian(coordinates(x, y), one_form = y * d(x), hamiltonian = x.sqrt() * x.sqrt().sin() + y)]
struct EndOfDomain;

/// The same, where the end of the domain is hidden in a square: −½ at the origin.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = y * d(x),
    hamiltonian = (x.sqrt().powi(2) + y * y).sqrt().cos(),
)]
struct HiddenEnd;

#[test]
fn no_limit_is_made_up_at_the_end_of_a_domain() {
    for first in [at_point(&EndOfDomain, [0.0; 2]).0, at_point(&HiddenEnd, [0.0; 2]).0] {
        assert!(first[0].is_nan(), "{first:?}");
    }
}

/// r³ of a particle in space, as a sum over an array; and of each of two particles.
#[lagrangian(
    coordinates(x[3], y[3]),
    lagrangian = sum(0..3, |i| dot(x[i]).powi(2) + dot(y[i]).powi(2)) / 2
        - sum(0..3, |i| x[i].powi(2)).powf(1.5) - sum(0..3, |i| x[i] * x[i] + y[i] * y[i]).sqrt().powi(3)
        - sum(0..3, |i| y[i].powi(2)).powf(1.75),
)]
struct Cubes;

/// Powers whose exponents are indices or parameters: 1 + u + u² and uⁿ.
#[lagrangian(coordinates(u), lagrangian = dot(u).powi(2) / 2 - sum(0..3, |j| u.powf(j as f64)) - u.powf(n))]
struct IndexPowers {
    n: f64,
}

/// Fermi's and Bose's functions, whose exponentials overflow long before their values matter.
#[lagrangian(coordinates(u), lagrangian = dot(u).powi(2) / 2 - 1 / (1 + (u / a).exp()) - u / (u / a).exp_m1())]
struct Steep {
    a: f64,
}

#[test]
fn powers_of_distances_that_are_sums_over_arrays_have_limits() {
    assert_eq!(position_derivatives(&Cubes, [0.0; 6]), ([0.0; 6], vec![0.0; 36]));
}

#[test]
fn powers_with_exponents_that_are_not_literal_have_derivatives_at_zero() {
    for (n, slope, curvature) in [(0.0, 0.0, 0.0), (1.0, 1.0, 0.0), (2.0, 0.0, 2.0), (3.5, 0.0, 0.0)] {
        let (gradient, matrix) = position_derivatives(&IndexPowers { n }, [0.0]);
        assert_eq!((gradient, matrix), ([-1.0 - slope], vec![-2.0 - curvature]), "n = {n}");
    }
}

#[test]
fn steep_walls_have_derivatives_on_both_sides() {
    let system = Steep { a: 1e-3 };
    for (u, gradient) in [(2.0, 0.0), (-2.0, 1.0)] {
        let found = position_derivatives(&system, [u]);
        assert_eq!(found, ([gradient], vec![0.0]), "u = {u}");
    }
    // e^(u/a) is 20.
    let (gradient, _) = position_derivatives(&system, [1e-3 * 20_f64.ln()]);
    let exact = 20.0 / 441.0 / 1e-3 - (1.0 / 19.0 - 20_f64.ln() * 20.0 / 361.0);
    assert!(relative_eq!(gradient[0], exact, epsilon = 0.0, max_relative = 1e-14), "{gradient:?} {exact}");
}
