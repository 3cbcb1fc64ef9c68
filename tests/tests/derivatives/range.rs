//! Quotients of exponentials, high powers, and products of literals, where squares and powers of their parts
//! are beyond the range of numbers: values, first and second derivatives against closed forms.

use approx::assert_abs_diff_eq;
use dvi_core::prelude::*;

use super::limits::at_point;

/// Of H = f(x, y): a name, f, a point, f there, and what the logarithmic derivatives of f are there, ∂ ln f
/// by x and by y, and their derivatives by x, by y, and by the other.
macro_rules! near_the_ends {
    ($($name:ident: $hamiltonian:expr, at [$x:expr, $y:expr], $value:expr, $slopes:expr, $bends:expr;)*) => {
        $(
            #[degenerate_lagrangian(coordinates(x, y), one_form = y * d(x), hamiltonian = $hamiltonian)]
            struct $name;
        )*

        #[test]
        fn derivatives_are_numbers_where_formulas_are() {
            $(
                let ([a, b], [aa, ab, bb], f): ([f64; 2], [f64; 3], f64) = ($slopes, $bends, $value);
                let ([by_x, by_y], second) = at_point(&$name, [$x, $y]);
                let value = $name.hamiltonian(&[$x, $y], 0.0);
                // Each with what it is added up from.
                let mixed = [a * b, ab];
                let products = [[1.0, 0.0], [a, 0.0], [b, 0.0], [a * a, aa], mixed, mixed, [b * b, bb]];
                for (found, [one, two]) in [value, by_x, by_y].into_iter().chain(second).zip(products) {
                    let size = (f * one).abs() + (f * two).abs();
                    assert_abs_diff_eq!(found, f * (one + two), epsilon = 2e-13 * size);
                }
            )*
        }
    };
}

/// e^(−1)/(1 + e^(−1)).
const RATIO: f64 = 0.268_941_421_369_995_1;

near_the_ends! {
    // Quotients of exponentials: squares of denominators are larger than all numbers. A slope below the
    // rounding of what it is added up from is zero.
    Logistic: x.exp() / (1 + x.exp()), at [373.0, 0.0], 1.0, [0.0, 0.0], [0.0; 3];
    LogisticFarther: x.exp() / (1 + x.exp()), at [700.0, 0.0], 1.0, [0.0, 0.0], [0.0; 3];
    Tangent: (x.exp() - (-x).exp()) / (x.exp() + (-x).exp()), at [373.0, 0.0], 1.0, [0.0, 0.0], [0.0; 3];
    Share: y * x.exp() / (1 + x.exp()), at [700.0, 3.0], 3.0, [0.0, 1.0 / 3.0], [0.0, 0.0, -1.0 / 9.0];
    Softmax: x.exp() / (x.exp() + y.exp()), at [373.0, 372.0], 1.0 - RATIO, [RATIO, -RATIO],
        [RATIO * (RATIO - 1.0), RATIO * (1.0 - RATIO), RATIO * (RATIO - 1.0)];
    Exponentials: x.exp() / y.exp(), at [380.0, 379.0], core::f64::consts::E, [1.0, -1.0], [0.0; 3];
    Sines: x.sinh() / y.sinh(), at [700.0, 699.5], 0.5_f64.exp(), [1.0, -1.0], [0.0; 3];
    // High powers of quotients and products: those of each part are larger than all numbers, or smaller.
    Zonal: (6.378e6 / x).powi(50), at [7e6, 0.0], (6.378_f64 / 7.0).powi(50), [-50.0 / 7e6, 0.0],
        [50.0 / 49e12, 0.0, 0.0];
    ZonalInPlane: (6.378e6 / x.hypot(y)).powi(51), at [7e6, 0.0], (6.378_f64 / 7.0).powi(51),
        [-51.0 / 7e6, 0.0], [51.0 / 49e12, 0.0, -51.0 / 49e12];
    Scaled: (x * 1e-3).powi(120), at [1e3, 0.0], 1.0, [0.12, 0.0], [-0.12e-3, 0.0, 0.0];
    Product: (x * y).powi(400), at [1e-12, 1e12], 1.0, [400e12, 400e-12], [-400e24, 0.0, -400e-24];
    Quotient: x.powi(300) / y.powi(300), at [20.0, 20.0], 1.0, [15.0, -15.0], [-0.75, 0.0, 0.75];
    Difference: ((x - y) / 7e6).powi(60), at [14e6, 7e6], 1.0, [60.0 / 7e6, -60.0 / 7e6],
        [-60.0 / 49e12, 60.0 / 49e12, -60.0 / 49e12];
    Wall: 1e-120 / x.powi(12), at [1e-10, 0.0], 1.0, [-12e10, 0.0], [12e20, 0.0, 0.0];
    // Literals whose product is no number, or has lost digits.
    Small: (1e-160 * x) * (1e-160 * y) * 1e300, at [1e10, 1e10], 1.0, [1e-10, 1e-10], [-1e-20, 0.0, -1e-20];
    Smaller: (3e-162 * x).powi(2) * 1e300, at [1e12, 0.0], 9.0, [2e-12, 0.0], [-2e-24, 0.0, 0.0];
    Large: 1e155 * x * 1e155 * y * 1e-300, at [1.0, 1.0], 1e10, [1.0, 1.0], [-1.0, 0.0, -1.0];
}
