//! One name in two spellings, one expression from a macro or written out, names of all shapes.

use approx::assert_abs_diff_eq;
use dvi_core::degenerate_lagrangian;
use dvi_core::lagrangian;
use dvi_core::{Scalar, System};

const fn same<T: Scalar>(x: T) -> T {
    x
}

/// `r#x` is `x`, wherever it stands.
#[degenerate_lagrangian(
    coordinates(r#x, y, r#type, z),
    one_form = x * d(r#y) + r#type * d(z),
    hamiltonian = r#x * r#g + g * r#type.powi(2) + { let r#q = g; q * r#y } + sum(0..n, |r#j| z * h[j] * r#h[r#j])
        + r#f(x) + r#n as f64 + r#match * self.r#g,
    functions(r#f = [same::<_>, same, self::same]),
    momenta(r#p = x, r#struct = r#type),
)]
#[derive(Debug)]
pub struct Raw {
    pub(super) g: f64,
    pub(super) r#h: Vec<f64>,
    pub(super) r#n: usize,
    pub(super) r#match: f64,
}

#[test]
fn the_report_has_one_spelling() {
    let text = format!("{}", Raw::REPORT);
    assert!(!text.contains("r#"), "{text}");
    assert!(text.contains("∂H/∂type = 2·type·g"), "{text}");
    assert!(text.contains("`x`, `type`"), "{text}");
}

#[test]
fn one_name_has_one_value() {
    let system = Raw { g: 2.0, h: vec![1.0, 3.0], n: 2, r#match: 5.0 };
    // x·v_y + type·v_z − H at q = 1/2, v = 1/4
    let energy = 0.5 * 2.0 + 2.0 * 0.25 + 2.0 * 0.5 + 0.5 * 10.0 + 0.5 + 2.0 + 5.0 * 2.0;
    assert_abs_diff_eq!(super::value(&system, 4), (0.25 - energy), epsilon = 1e-14);
    let start = RawState { x: 1.0, y: 0.0, r#type: 0.5, z: 0.0 };
    assert_abs_diff_eq!(start.x, 1.0_f64, epsilon = f64::EPSILON);
}

macro_rules! body {
    ($name:ident, $row:expr, $column:literal, $range:expr, $size:literal, $number:ty, $sum:expr, $one_form:expr, $force:expr) => {
        /// Entries and indices from a macro.
        #[lagrangian(
                    coordinates(R: SO3, z[$size]),
                    lagrangian = omega(R)[0].powi(2) + omega(R)[1].powi(2) + omega(R)[$row].powi($row) - R[$row][$column] * g
                        + sum($range, |j| dot(z[j]).powi(2) + $sum * z[$column] + w[j] + (w[$row] - z[$row]).powi($row)),
                )]
        #[derive(Debug)]
        pub struct $name {
            pub(super) g: $number,
            pub(super) w: [f64; $size],
        }

        /// A list from a macro.
        #[degenerate_lagrangian(
                    coordinates(x, y), one_form = $one_form, hamiltonian = $sum * x * y, force = $force
                )]
        #[derive(Debug)]
        pub struct Listed;
    };
}
body!(FromMacro, 2, 0, 0..3, 3, f64, 1.0 + 2.0, [0.0, x], [-x, y]);

/// The same, written out.
#[lagrangian(
    coordinates(R: SO3, z[3]),
    lagrangian = omega(R)[0].powi(2) + omega(R)[1].powi(2) + omega(R)[(2)].powi(2) - R[(2)][((0))] * g
        + sum(0..3, |j| dot(z[j]).powi(2) + (1.0 + 2.0) * z[0] + w[j] + (w[2] - z[2]).powi(2)),
)]
#[derive(Debug)]
pub struct WrittenOut {
    pub(super) g: f64,
    pub(super) w: [f64; 3],
}

/// Names that hide a rotation.
#[lagrangian(
    coordinates(R: SO3, z[2]),
    lagrangian = omega(R)[0].powi(2) + omega(R)[1].powi(2) + omega(R)[2].powi(2)
        + { let R = R[0][1] + 1.0; R * R } + sum(0..2, |R| dot(z[R]).powi(2) - z[R]) + R[2][2],
)]
#[derive(Debug)]
pub struct Hidden;

#[test]
fn what_a_macro_writes_is_what_is_written() {
    let (g, w) = (9.81, [1.0, 2.0, 3.0]);
    let [q, v] = [[0.3, 0.7, 0.2, 0.9, 0.1, 0.4, 0.6, 0.8, 0.5, 1.5, 2.5, 3.5], [0.2; 12]];
    let [from_macro, written_out] = [
        dvi_core::Lagrangian::lagrangian(&FromMacro { g, w }, &q, &v, 0.0_f64),
        dvi_core::Lagrangian::lagrangian(&WrittenOut { g, w }, &q, &v, 0.0),
    ];
    let by_hand = 3.0 * 0.04 - 0.6 * g + 3.0 * (0.04 + 3.0 * 1.5 + (3.0_f64 - 3.5).powi(2)) + 6.0;
    assert_abs_diff_eq!(from_macro, by_hand, epsilon = 1e-13);
    assert_eq!(from_macro.to_bits(), written_out.to_bits());
    let hidden = dvi_core::Lagrangian::lagrangian(&Hidden, &q[..11], &v[..11], 0.0_f64);
    let by_hand = 3.0 * 0.04 + 1.7 * 1.7 + 2.0 * 0.04 - 1.5 - 2.5 + 0.5;
    assert_abs_diff_eq!(hidden, by_hand, epsilon = 1e-13);
    // α = x dy and H = 3 x y at q = 1/2, v = 1/4
    assert_abs_diff_eq!(super::value(&Listed, 2), (0.125 - 0.75), epsilon = 1e-15);
}

/// A name that Rust would write otherwise.
#[allow(non_camel_case_types)]
mod names {
    use super::degenerate_lagrangian;

    /// A system.
    #[degenerate_lagrangian(coordinates(x_, y), one_form = x_ * d(y), hamiltonian = x_ * x_)]
    #[derive(Clone, Copy, Debug)]
    pub struct A_;
}
pub use names::{A_, A_State};

#[test]
fn a_state_is_called_after_its_system() {
    let start = A_State { x_: 1.0, y: 0.0 };
    assert!(super::Integrator::new(&A_, super::Sigma::midpoint(), 0.1, start).is_ok());
}
