//! The functions: first and second derivatives of each where formulas lose digits, overflow or divide by
//! zero, against closed forms that do not; and their symmetries.

use crate::symbolic::functions::{self, UNARY};
use crate::symbolic::{Binary, Expr, Graph, Id, Relation, Unary};

use super::coordinate;
use super::evaluate::evaluate;
use crate::oracle_tests::functions::bessel;

/// A function, its first two derivatives by other formulas, and the points: where a derivative does not
/// exist the closed form is not finite, and neither may be what is generated.
type Extremes = (&'static str, fn(f64) -> f64, fn(f64) -> f64, &'static [f64]);

const REAL: &[f64] = &[0.0, 1e-300, -1e-300, 1e-9, -1e-9, 0.3, 1.0, -1.0, 20.0, -20.0];
const WIDE: &[f64] = &[0.0, 1e-300, 1e-9, -0.3, 1.0, -20.0, 700.0, -700.0, 1e300, -1e300];
const POSITIVE: &[f64] = &[0.0, 1e-90, 1e-9, 0.3, 1.0, 20.0, 700.0, 1e90, 1e300];
const UNIT: &[f64] =
    &[0.0, 1e-300, -1e-9, 0.3, -0.7, 1.0 - 1e-9, 1.0 - f64::EPSILON, f64::EPSILON - 1.0, 1.0, -1.0];

fn sech(x: f64) -> f64 {
    2.0 * (-x.abs()).exp() / (1.0 + (-2.0 * x.abs()).exp())
}

/// 1 − x², exactly rounded up to a few units: 1 − |x| is exact near the ends.
fn rest(x: f64) -> f64 {
    (1.0 - x.abs()) * (1.0 + x.abs())
}

const LN_2: f64 = core::f64::consts::LN_2;
const LN_10: f64 = core::f64::consts::LN_10;

#[rustfmt::skip]
const ROWS: &[Extremes] = &[
    ("sqrt",   |x| 0.5 / x.sqrt(), |x| -0.25 / x.sqrt() / x, POSITIVE),
    ("cbrt",   |x| x.cbrt() / x / 3.0, |x| -2.0 / 9.0 * x.cbrt() / x / x, &[1e-90, -1e-9, 0.3, 1.0, -20.0, 1e90]),
    ("exp",    f64::exp, f64::exp, &[0.0, -20.0, 20.0, 700.0, -700.0, -1e300]),
    ("exp2",   |x| x.exp2() * LN_2, |x| x.exp2() * LN_2 * LN_2, &[0.0, -20.0, 20.0, 1000.0, -1000.0, -1e300]),
    ("exp_m1", f64::exp, f64::exp, &[0.0, -1e-300, -20.0, -50.0, 20.0, 700.0, -700.0]),
    ("ln",     |x| 1.0 / x, |x| -1.0 / x / x, POSITIVE),
    ("ln_1p",  |x| 1.0 / (1.0 + x), |x| -1.0 / (1.0 + x) / (1.0 + x), &[0.0, 1e-300, -0.7, f64::EPSILON - 1.0, 1e100]),
    ("log2",   |x| 1.0 / x / LN_2, |x| -1.0 / x / x / LN_2, POSITIVE),
    ("log10",  |x| 1.0 / x / LN_10, |x| -1.0 / x / x / LN_10, POSITIVE),
    ("sin",    f64::cos, |x| -x.sin(), WIDE),
    ("cos",    |x| -x.sin(), |x| -x.cos(), WIDE),
    ("tan",    |x| x.cos().powi(-2), |x| 2.0 * x.tan() * x.cos().powi(-2), &[0.0, 1e-300, 1e-9, 0.3, 1.5, core::f64::consts::FRAC_PI_2 - 1e-6, -20.0]),
    ("asin",   |x| 1.0 / rest(x).sqrt(), |x| x / rest(x).powf(1.5), UNIT),
    ("acos",   |x| -1.0 / rest(x).sqrt(), |x| -x / rest(x).powf(1.5), UNIT),
    ("atan",   |x| 1.0 / (1.0 + x * x), |x| -2.0 * x / (1.0 + x * x).powi(2), WIDE),
    ("sinh",   f64::cosh, f64::sinh, &[0.0, 1e-300, -1e-9, 20.0, -700.0]),
    ("cosh",   f64::sinh, f64::cosh, &[0.0, 1e-300, -1e-9, 20.0, -700.0]),
    ("tanh",   |x| sech(x) * sech(x), |x| -2.0 * x.tanh() * sech(x) * sech(x), &[0.0, 1e-300, 1e-9, -1.0, 20.0, -30.0, 350.0, -700.0, 720.0, 1e300]),
    ("asinh",  |x| 1.0 / x.hypot(1.0), |x| -x / x.hypot(1.0).powi(3), WIDE),
    ("acosh",  |x| 1.0 / ((x - 1.0).sqrt() * (x + 1.0).sqrt()),
               |x| -x * ((x - 1.0) * (x + 1.0)).powf(-1.5), &[1.0, 1.0 + f64::EPSILON, 1.0 + 1e-9, 1.3, 20.0, 700.0, 1e100, 1e300]),
    ("atanh",  |x| 1.0 / rest(x), |x| 2.0 * x / rest(x).powi(2), UNIT),
    ("abs",    |x| if x == 0.0 { 0.0 } else { x.signum() }, |_| 0.0, WIDE),
    ("signum", |_| 0.0, |_| 0.0, WIDE),
    ("sign",   |_| 0.0, |_| 0.0, WIDE),
    ("erf",    |x| core::f64::consts::FRAC_2_SQRT_PI * (-x * x).exp(),
               |x| -2.0 * x * core::f64::consts::FRAC_2_SQRT_PI * (-x * x).exp(), REAL),
    ("sinc",   |x| -x * bessel(1, x), |x| x * x * bessel(2, x) - bessel(1, x), REAL),
    ("sinc1",  |x| -x * bessel(2, x), |x| x * x * bessel(3, x) - bessel(2, x), &[3.0, -20.0]),
    ("sinc2",  |x| -x * bessel(3, x), |x| x * x * bessel(4, x) - bessel(3, x), &[3.0, -20.0]),
    ("sinc3",  |x| -x * bessel(4, x), |x| x * x * bessel(5, x) - bessel(4, x), &[6.0, -20.0]),
];

/// A graph with two coordinates, x and y.
struct Plane {
    graph: Graph,
    x: Id,
    y: Id,
}

impl Plane {
    fn new() -> Self {
        let mut graph = Graph::new(Vec::new());
        let (x, y) = (coordinate(&mut graph, 0), coordinate(&mut graph, 1));
        Self { graph, x, y }
    }

    /// x² + y²
    fn square(&mut self) -> Expr {
        let squares = [self.x, self.y].map(|of| self.graph.power(of.into(), 2));
        self.graph.sum(&squares)
    }

    fn at(&self, of: Expr, x: f64, y: f64) -> f64 {
        evaluate(&self.graph, of, [x, y])
    }

    /// f, its gradient, and ∂²f by xx, xy, yx, yy.
    fn expanded(&mut self, f: Expr, x: f64, y: f64) -> [f64; 7] {
        let mut values = vec![f];
        let first = [self.x, self.y].map(|by| self.graph.derivative(f, by));
        values.extend(first);
        for derivative in first {
            values.extend([self.x, self.y].map(|by| self.graph.derivative(derivative, by)));
        }
        std::array::from_fn(|entry| self.at(values[entry], x, y))
    }

    fn agree(&mut self, name: &str, f: Expr, (x, y): (f64, f64), expected: [f64; 7]) {
        for (entry, (found, expected)) in self.expanded(f, x, y).into_iter().zip(expected).enumerate() {
            agree(&format!("{name} [{entry}] at ({x:e}, {y:e})"), found, expected);
        }
    }
}

fn agree(what: &str, found: f64, expected: f64) {
    if !expected.is_finite() {
        assert!(!found.is_finite(), "{what} = {found}, but there is none");
        return;
    }
    // Below the smallest normal number digits are lost in any case.
    let allowed = 64.0 * f64::EPSILON * expected.abs() + f64::MIN_POSITIVE;
    assert!((found - expected).abs() <= allowed, "{what} = {found:e}, expected {expected:e}");
}

#[test]
fn every_function_is_as_accurate_as_its_closed_form() {
    assert_eq!(ROWS.len(), UNARY.len());
    for functions::Row { name, function, .. } in UNARY {
        let (_, first, second, points) =
            ROWS.iter().find(|(known, ..)| known == name).expect("every function has a row");
        let mut plane = Plane::new();
        let f = plane.graph.unary(*function, plane.x.into());
        for x in *points {
            let [value, d, _, dd, ..] = plane.expanded(f, *x, 0.0);
            let of_table = function.evaluate(*x);
            assert!(value == of_table || (value.is_nan() && of_table.is_nan()), "{name}({x:e})");
            agree(&format!("{name}'({x:e})"), d, first(*x));
            agree(&format!("{name}''({x:e})"), dd, second(*x));
        }
        if let Some(sign) = function.parity() {
            agree(&format!("{name}(−0.3)"), function.evaluate(-0.3), sign * function.evaluate(0.3));
            let mirrored = plane.graph.unary(*function, Expr::from(plane.x).negated());
            assert_eq!(mirrored, f.scaled(sign), "{name}(−x) is not shared with {name}(x)");
        }
    }
}

/// x^p, whose k-th derivative at 0 is 0 for p > k and does not exist for a fraction p < k.
#[test]
fn powers_at_zero() {
    for power in [0.3, 0.5, 1.3, 1.5, 1.7, 2.0, 2.3, 2.5, 3.5, 5.5] {
        let mut plane = Plane::new();
        let f = plane.graph.binary(Binary::Powf, plane.x.into(), Expr::number(power));
        for x in [0.0, 1e-30, 0.3, 1.0, 1e30] {
            let [value, d, _, dd, ..] = plane.expanded(f, x, 0.0);
            agree(&format!("{x:e}^{power}"), value, x.powf(power));
            agree(&format!("{power}·{x:e}^({power} − 1)"), d, power * x.powf(power - 1.0));
            agree(&format!("({x:e}^{power})''"), dd, power * (power - 1.0) * x.powf(power - 2.0));
        }
    }
}

/// √u with u = x from 1 on and zero before, where the slope of the root itself is infinite.
#[test]
fn a_root_of_a_branch_that_is_zero() {
    let mut plane = Plane::new();
    let x = plane.x.into();
    let u = plane.graph.choose(x, Relation::Less, Expr::ONE, Expr::ZERO, x);
    let f = plane.graph.unary(Unary::Sqrt, u);
    for (x, expected) in [(-3.0, [0.0; 3]), (0.5, [0.0; 3]), (4.0, [2.0, 0.25, -0.03125])] {
        let [value, d, _, dd, ..] = plane.expanded(f, x, 0.0);
        for (found, expected) in [value, d, dd].into_iter().zip(expected) {
            agree(&format!("√u at x = {x}"), found, expected);
        }
    }
}

/// r³, r⁵, by two ways to write each, and r², at the origin and far from it.
#[test]
fn powers_of_a_distance_at_the_origin() {
    for power in [2_u32, 3, 5] {
        for way in 0..3 {
            let mut plane = Plane::new();
            let (square, x, y) = (plane.square(), plane.x.into(), plane.y.into());
            let graph = &mut plane.graph;
            let f = match way {
                0 => graph.binary(Binary::Powf, square, Expr::number(f64::from(power) / 2.0)),
                1 => {
                    let distance = graph.binary(Binary::Hypot, x, y);
                    graph.power(distance, power)
                }
                _ => {
                    let distance = graph.unary(Unary::Sqrt, square);
                    graph.power(distance, power)
                }
            };
            for (x, y) in [(0.0, 0.0), (3.0, 4.0), (-3e-40, 4e-40), (0.0, 1.0), (1e-200, 1e-200)] {
                let r = f64::hypot(x, y);
                let p = f64::from(power);
                // ∂ᵢ rᵖ = p·rᵖ⁻²·xᵢ and ∂ᵢ∂ⱼ rᵖ = p·rᵖ⁻²·(δᵢⱼ + (p − 2)·nᵢ·nⱼ), n = x/r.
                let (n, scale) =
                    (if r > 0.0 { (x / r, y / r) } else { (0.0, 0.0) }, p * r.powi(power as i32 - 2));
                let second = |a: f64, b: f64, on: f64| scale * (on + (p - 2.0) * a * b);
                let expected = [
                    r.powi(power as i32),
                    scale * x,
                    scale * y,
                    second(n.0, n.0, 1.0),
                    second(n.0, n.1, 0.0),
                    second(n.1, n.0, 0.0),
                    second(n.1, n.1, 1.0),
                ];
                let found = plane.expanded(f, x, y);
                for (entry, (found, expected)) in found.iter().zip(expected).enumerate() {
                    // x² underflows at 1e-200: the absolute error is then below 1e-160.
                    assert!(
                        (found - expected).abs() <= 64.0 * f64::EPSILON * expected.abs() + 1e-160,
                        "r^{power} (written in way {way}) [{entry}] at ({x:e}, {y:e}): {found:e}, expected {expected:e}"
                    );
                }
            }
        }
    }
}

/// r itself, and x·r, have no (second) derivative at the origin: no number may stand there.
#[test]
fn what_has_no_derivative_has_no_number() {
    for way in 0..2 {
        let mut plane = Plane::new();
        let (square, x, y) = (plane.square(), plane.x.into(), plane.y.into());
        let graph = &mut plane.graph;
        let r = if way == 0 { graph.unary(Unary::Sqrt, square) } else { graph.binary(Binary::Hypot, x, y) };
        let stretched = graph.multiply(x, r);
        let found = plane.expanded(r, 0.0, 0.0);
        assert!(found[1..].iter().all(|entry| !entry.is_finite()), "{found:?}");
        let found = plane.expanded(stretched, 0.0, 0.0);
        assert_eq!(found[..3], [0.0; 3]);
        assert!(found[3..].iter().all(|entry| !entry.is_finite()), "{found:?}");
    }
}

/// √(x² + y²) by `hypot`: second derivatives keep their digits where one side is far longer, and where
/// squares overflow.
#[test]
fn hypot_across_and_far_away() {
    let mut plane = Plane::new();
    let f = plane.graph.binary(Binary::Hypot, plane.x.into(), plane.y.into());
    for (x, y) in [(1.0, 1e-9), (1e-12, -3.0), (3e200, 4e200), (3e-200, 4e-200), (1e300, 1.0), (5.0, 0.0)] {
        let r = f64::hypot(x, y);
        let (c, s) = (x / r, y / r);
        plane.agree("hypot", f, (x, y), [r, c, s, s * s / r, -s * c / r, -s * c / r, c * c / r]);
    }
}

/// The angle of a point, near the origin, far from it, and close to an axis: c/r, −s/r and their derivatives
/// with s = a/r, c = b/r.
#[test]
fn angles_near_and_far() {
    let mut plane = Plane::new();
    let f = plane.graph.binary(Binary::Atan2, plane.x.into(), plane.y.into());
    let points = [
        (3.0, 4.0),
        (5e-160, 2e-160),
        (-5e160, 2e160),
        (1e-300, -3e-300),
        (1e-300, 1e-300),
        (3e300, 1e300),
        (1e-200, -3.0),
        (3.0, 1e-200),
        (0.0, 2.0),
        (0.0, -1e-170),
        (2e160, 0.0),
    ];
    for (a, b) in points {
        let r = f64::hypot(a, b);
        let (s, c) = (a / r, b / r);
        let (twice, difference) = (2.0 * s * c / r / r, (s - c) * (s + c) / r / r);
        let expected = [a.atan2(b), c / r, -s / r, -twice, difference, difference, twice];
        plane.agree("atan2", f, (a, b), expected);
    }
}

/// x^y at x = 0: xʸ·ln x and xʸ·ln² x vanish for y > 0, xʸ⁻¹·(1 + y·ln x) for y > 1; elsewhere there is no
/// derivative.
#[test]
fn powers_with_exponents_that_vary_at_zero() {
    const NONE: f64 = f64::NAN;
    let mut plane = Plane::new();
    let f = plane.graph.binary(Binary::Powf, plane.x.into(), plane.y.into());
    let at_zero = [
        (3.5, [0.0; 7]),
        (2.0, [0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0]),
        (1.5, [0.0, 0.0, 0.0, NONE, 0.0, 0.0, 0.0]),
        (0.5, [0.0, NONE, 0.0, NONE, NONE, NONE, 0.0]),
        (0.0, [1.0, NONE, NONE, NONE, NONE, NONE, NONE]),
        (-1.0, [NONE; 7]),
    ];
    for (y, expected) in at_zero {
        plane.agree("x^y", f, (0.0, y), expected);
    }
    for (x, y) in [(1e-100, 2.0), (1e-200, 3.0), (1e-300, 1.0), (0.3, -2.5), (1e100, 2.5)] {
        let (x, y): (f64, f64) = (x, y);
        let (power, slope, ln) = (x.powf(y), x.powf(y - 1.0), x.ln());
        let mixed = slope * (1.0 + y * ln);
        let expected =
            [power, y * slope, power * ln, y * (y - 1.0) * x.powf(y - 2.0), mixed, mixed, power * ln * ln];
        plane.agree("x^y", f, (x, y), expected);
    }
    // A power of a negative number has no derivative by its exponent, be it too small for a number or not.
    assert!([-1.0, -1e-200].into_iter().all(|x| plane.expanded(f, x, 2.0)[2].is_nan()));
}
