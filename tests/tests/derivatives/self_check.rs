//! Systems that a self-check refuses if it is wrong itself: that they compile is most of the test.

use approx::assert_abs_diff_eq;
use dvi_core::prelude::*;

/// A zero has the sign that Rust gives it, that of an empty sum too.
#[degenerate_lagrangian(
    coordinates(x, y, u[N], v[N]),
    one_form = y * d(x) + sum(0..N, |i| v[i] * d(u[i])),
    hamiltonian = sum(0..N, |i| x * (i as f64 * x).signum() + y * (y * sum(0..i, |j| u[j])).signum()),
)]
struct SignsOfZero<const N: usize>;

/// A difference that is zero everywhere is left out, and with it the sign that it would have.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = y * d(x),
    hamiltonian = (x * (x - x)).signum() * y + (y * (x - x)).atan2(x) + x * y,
)]
struct DifferenceOfNothing;

/// Functions of large constants have rounding errors that their values do not show.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = y * d(x),
    hamiltonian = (PI.powi(5) * 1001.0).sin() * x * x + (PI.powi(7) * 1.1 * y * y).cos(),
)]
struct LargeConstants;

/// Where the derivative of a sine of a large number is small, the second is not.
#[degenerate_lagrangian(
    coordinates(x[4], y[4], z[2], w[2]),
    lagrangian = {
        let a0 = sum_pairs(0..=4 - 1, |_i, _j| PI).powi(2) + b[1];
        1.atan2(a0.powi(5).sin())
    } + x[0] * dot(y[0]) + x[1] * dot(y[1]) + x[2] * dot(y[2]) + x[3] * dot(y[3]) + sum(0..2, |i| z[i] * dot(w[i])),
)]
struct TurningPoint {
    b: Vec<f64>,
}

/// A product with an empty sum is zero, and its root has no derivative: such points say nothing.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = y * d(x),
    hamiltonian = (product(0..M, |i| sum(i + 1..M, |j| 1.0 + (j as f64))) * x).cbrt() + y * y,
)]
struct RootOfNothing<const M: usize>;

/// An intermediate value may overflow in another order of operations.
#[degenerate_lagrangian(
    coordinates(x[n], y[n]),
    one_form = sum(0..n, |i| x[i] * d(y[i])),
    hamiltonian = x[0] / (1.5 + (product(0..n, |_i| (40.0 * sum_pairs(0..n, |j, _k| y[j])).cosh())
        * product(0..n, |i| sum(0..i, |_j| 1.0))).powi(2)),
)]
struct NearOverflow {
    n: usize,
}

/// Sums over components are written out, and so are those over pairs of them. Up to the first component there
/// is nothing: a sum is 0 there, and a product 1.
#[lagrangian(
    coordinates(r[N][3], s[N][6]),
    lagrangian = sum(0..N, |i| (dot(r[i]).norm_squared() + dot(s[i]).norm_squared()) / 2
        - sum(0..3, |k| r[i][k] * (sum(0..k, |l| a[l]) + product(0..k, |l| a[l]) * sum_pairs(k..3, |l, m| a[l] - a[m])))
        - sum_pairs(0..6, |k, l| s[i][k] * s[i][l] * (l as f64))
        - sum_ordered_pairs(0..3, |k, l| r[i][k] * a[l] * s[i][1])),
)]
struct Components<const N: usize> {
    a: [f64; 3],
}

#[test]
fn sums_over_components_are_those_by_hand() {
    let (a, r, s) = ([0.5, -1.25, 3.0], [2.0, -0.75, 1.5], [0.25, 3.0, -1.0, 0.5, -2.0, 1.75]);
    let mut expected = r[0] * ((a[0] - a[1]) + (a[0] - a[2]) + (a[1] - a[2]));
    expected += r[1] * (a[0] + a[0] * (a[1] - a[2])) + r[2] * (a[0] + a[1]);
    for l in 0..6 {
        expected += s[..l].iter().sum::<f64>() * s[l] * l as f64;
    }
    for k in 0..3 {
        expected += r[k] * (a.iter().sum::<f64>() - a[k]) * s[1];
    }
    // Each component has a block of its own.
    let q: Vec<f64> = r.iter().chain(&s).copied().collect();
    assert_abs_diff_eq!(Components::<1> { a }.energy(&q, &[0.0; 9], 0.0), expected, epsilon = 1e-12);
}

#[test]
fn a_zero_keeps_its_sign() {
    for [x, y, u] in [[-0.5, -0.25, 0.75], [0.5, 0.25, 0.75], [-0.5, 0.25, -0.75]] {
        let inner = |i: usize| [u, 0.0][..i].iter().sum::<f64>();
        let term = |i: usize| x * (i as f64 * x).signum() + y * (y * inner(i)).signum();
        let expected: f64 = (0..2).map(term).sum();
        assert_eq!(SignsOfZero::<2>.hamiltonian(&[x, y, u, 0.0, 0.0, 0.0], 0.0), expected);
    }
}

#[test]
fn roots_of_nothing_are_zero() {
    assert_eq!(RootOfNothing::<3>.hamiltonian(&[0.7, 2.0], 0.0), 4.0);
    let constant = (std::f64::consts::PI.powi(5) * 1001.0).sin();
    assert_abs_diff_eq!(LargeConstants.hamiltonian(&[2.0, 0.0], 0.0) - 4.0 * constant, 1.0, epsilon = 1e-9);
    assert!(f64::is_finite(TurningPoint { b: vec![0.0, 1.0] }.hamiltonian(&[0.0; 12], 0.0)));
    assert_eq!(DifferenceOfNothing.hamiltonian(&[2.0, 3.0], 0.0), 9.0);
    assert_eq!(NearOverflow { n: 2 }.hamiltonian(&[3.0, 1.0, 0.01, 0.02], 0.0), 2.0);
}
