//! One-forms with the differential of a function added: what `gauge = auto` makes of them.

use dvi_core::prelude::*;
use dvi_core::{ProperlyDegenerate, Space};
use dvi_tests::{filling, larger};

/// Points in the first quadrant, with logarithms and roots.
const POINTS: [[f64; 10]; 3] = [
    [0.7, 1.3, 0.4, 0.9, 1.6, 0.5, 0.3, 1.2, 0.8, 0.6],
    [1.1, 0.3, 0.8, 1.4, 0.6, 1.2, 0.5, 0.9, 1.3, 0.4],
    [0.2, 0.9, 1.5, 0.5, 1.3, 0.8, 1.1, 0.6, 0.7, 1.4],
];

/// The matrix a Dα + b (Dα)ᵀ, row by row.
fn jacobian<S: DegenerateLagrangian<f64>>(system: &S, q: &[f64], t: f64, [a, b]: [f64; 2]) -> Vec<f64> {
    let mut entries = vec![0.0; q.len() * q.len()];
    system.one_form_jacobian(q, t, a, b, &mut filling(&mut entries, q.len()));
    entries
}

fn apart(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs() / (1.0 + a.abs())).fold(0.0, larger)
}

/// Two one-forms of the same motion: the same Ω and the same ∇H + ∂α/∂t, and no component of the second
/// along its half.
fn have_the_same_motion<S: DegenerateLagrangian<f64>, G: ProperlyDegenerate<f64>>(declared: &S, gauged: &G) {
    let n = declared.space().dimension();
    for point in POINTS {
        let (q, t) = (&point[..n], 0.3);
        let (one, other) = (jacobian(declared, q, t, [1.0, -1.0]), jacobian(gauged, q, t, [1.0, -1.0]));
        assert!(apart(&one, &other) < 1e-12, "Ω of {}: {one:?} and {other:?}", G::REPORT.system);
        let source = |f: &dyn Fn(&mut [f64])| {
            let mut source = vec![0.0; n];
            f(&mut source);
            source
        };
        let one = source(&|to| declared.flow_source(q, t, to));
        let other = source(&|to| gauged.flow_source(q, t, to));
        assert!(apart(&one, &other) < 1e-12, "∇H of {}: {one:?} and {other:?}", G::REPORT.system);
        let form = source(&|to| gauged.one_form(q, t, to));
        for i in (0..n).filter(|&i| 2 * gauged.place(i) >= n) {
            assert_eq!(form[i], 0.0, "{}, component {i}", G::REPORT.system);
        }
    }
}

#[test]
fn a_gauge_is_found_for_twenty_systems() {
    macro_rules! check {
        ($($name:ident($($coordinates:tt)*): $form:expr, $hamiltonian:expr;)+) => {$({
            let declared = {
                #[degenerate_lagrangian(coordinates($($coordinates)*), one_form = $form, hamiltonian = $hamiltonian)]
                #[allow(dead_code, reason = "not every system has both")]
                struct $name { k: f64, g: [f64; 3] }
                $name { k: 0.7, g: [1.0, -2.0, 0.5] }
            };
            #[degenerate_lagrangian(
                coordinates($($coordinates)*),
                one_form = $form,
                hamiltonian = $hamiltonian,
                gauge = auto,
            )]
            #[allow(dead_code, reason = "not every system has both")]
            struct $name { k: f64, g: [f64; 3] }
            let gauged = $name { k: declared.k, g: declared.g };
            have_the_same_motion(&declared, &gauged);
            assert!($name::REPORT.formulas.iter().any(|formula| formula.name == "F"), "{}", stringify!($name));
        })+};
    }
    check!(
        Vortices(x[3], y[3]): sum(0..3, |j| g[j] / 2.0 * (x[j] * d(y[j]) - y[j] * d(x[j]))), k * x[0] * y[1];
        PreySymmetric(x, y): (y + y.ln() / (2.0 * x)) * d(x) + (x - x.ln() / (2.0 * y)) * d(y), k * x + g[0] * y;
        Reciprocal(x, y): (x + 1.0 / y) * d(y) - k * y * d(x), x * y + g[0];
        Polynomial(x, y): (x * y.powi(3) + x.powi(2) * y) * d(y) + x * y * d(x), k * x + g[0] * y;
        Exponential(x, y): x * (k * y).exp() * d(y) + x.exp() * y * d(x), x * y + g[0];
        Gaussian(x, y): (x + x * y * (-y * y).exp()) * d(y) - y * x * d(x), k * x + g[0] * y;
        Root(x, y): x * (1.0 + y * y).sqrt() * y * d(y) + y.powi(2) * d(x), k * x + g[0] * y;
        Powers(x, y): x * y.powf(1.5) * d(y) - y.sqrt() * d(x), k * x + g[0] * y;
        Field(x, y): -k * y / (1.0 + x * x) * d(x) + k * x * (y / 2.0).sinh() * d(y), x * y + g[0];
        Branches(x, y): x * (if x > 1.0 { y } else { 2.0 * y + 1.0 }) * d(y) + y * d(x), k * x + g[0] * y;
        Driven(x, y): (1.0 + t / 2.0) * (x * d(y) - y * d(x)), k * x * x + g[0] * y * y * t;
        Four(x, y, u, w): (y * y + w * x + y * w.sin()) * d(x) + (w + y * u + 2.0 * u * y.exp()) * d(u)
            + (x * w.sin() + u * u * y.exp()) * d(y) + x * y * w.cos() * d(w), k * x * u + g[0] * y * w;
        Rotor(x, px, angle, l): 0.5 * (px * d(x) - x * d(px)) + (l - k * x) * d(angle) - k * angle * d(x),
            px * px / 2.0 + l * l / (2.0 * x * x) + g[0] * x;
        Lattice(u[3], w[3]): sum(0..3, |j| (w[j] + u[j] * u[(j + 1) % 3]) * d(u[j]) - u[j] * d(w[j])),
            k * u[0] * w[1] + g[0] * u[2];
        Pairs(x[3], y[3]): sum(0..3, |j| y[j] * d(x[j])) + sum_pairs(0..3, |i, j| x[i] * x[j] * (d(y[i]) + d(y[j]))),
            k * x[0] * y[1] + g[0] * x[2];
        Errors(x, y): x * (y / 2.0).erf() * d(y) + y.powi(3) * x * d(x), k * x + g[0] * y;
        Shear(x, y): x * (2.0 * y + 1.0).ln() * d(y) + (y + x * x).sin() * d(x), k * x + g[0] * y;
        Seventh(x, y): x * (1.0 + 1.0 / 49.0 * y).sqrt() * d(y) + (x * x * y).exp() * d(x), k * x + g[0] * y;
        Step(x, y): x * y.tanh() * d(y) + (x * x * y).exp() * d(x), k * x + g[0] * y;
        Fraction(x, y): x * y.powf(0.1) * d(y) + (x * x * y).exp() * d(x), k * x + g[0] * y;
        Powers4(a, b, p, q): a * d(p) + b * d(q) + (a + b + p + q).powi(6) * (d(a) + d(b) + d(p) + d(q)), k * a * p + g[0] * b;
        Pairs5(x0, p0, x1, p1, x2, p2, x3, p3, x4, p4): (p0 * d(x0) - x0 * d(p0) + p1 * d(x1) - x1 * d(p1) + p2 * d(x2)
            - x2 * d(p2) + p3 * d(x3) - x3 * d(p3) + p4 * d(x4) - x4 * d(p4)) / 2.0, k * x0 + g[0] * p4 * x2;
    );
}

/// Where there is a choice, no parameter is divided by, so that it may be zero; where there is none, the
/// report says so.
#[test]
fn parameters_stand_in_denominators_as_a_last_resort() {
    macro_rules! sentences {
        ($form:expr) => {{
            #[degenerate_lagrangian(coordinates(x, y), one_form = $form, hamiltonian = x * x + y * y, gauge = auto)]
            struct Any {
                k: f64,
            }
            let mut form = [0.0_f64; 2];
            Any { k: 0.0 }.one_form(&[0.7, 0.4], 0.0, &mut form);
            let said = Any::REPORT.structure.iter().any(|sentence| sentence.contains("F is divided by `k`"));
            (form.iter().all(|form| form.is_finite()), said)
        }};
    }
    let root = sentences!((x * (1.0 + k * y).sqrt() * d(y) - y * d(x)) / 2.0);
    let cube = sentences!((x * (1.0 + k * y).powi(3) * d(y) - y * d(x)) / 2.0);
    let cosine = sentences!(x * (k * y).sin() * d(y) + (x * x * y).exp() * d(x));
    assert_eq!([root, cube, cosine], [(true, false), (true, false), (false, true)]);
}
