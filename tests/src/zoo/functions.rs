//! Every function that a formula may use, and `if`.

use dvi_core::degenerate_lagrangian;

/// Every function of the table and every way to write a power, on 0 < x, y < 1.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form    = {
        let s: f64 = x * y;
        let r = 1.0 + x + 2.0 * y;
        (s.sin() + r.ln() + s.exp() * y.sqrt()) * d(x) + (s.atan() - r.recip() + x.tanh()) * d(y)
    },
    hamiltonian = {
        let s = x * y;
        let r = 1.0 + x + 2.0 * y;
        let roots = r.sqrt() + s.cbrt() - (-r).cbrt();
        let exponentials = s.exp() + (x - y).exp2() + (-s).exp_m1();
        let logarithms = r.ln() + s.ln_1p() + r.log2() + (2.0 * s).log10();
        let circular = (x - y).sin() + (y - 2.0 * x).cos() + s.tan();
        let inverse = s.asin() + (-s / 2.0).asin() + (x - y).acos() + (x / y).atan();
        let hyperbolic = (-s).sinh() + (x - y).cosh() + r.tanh();
        let areas = (x - y).asinh() + r.acosh() + (s - x).atanh();
        let signs = (x - y).abs() * s + (y - x).signum() * (x + s) + (x - 2.0).abs();
        let two = r.atan2(x - y) + (y - x).atan2(-r) + x.hypot(-2.0 * y);
        let powers = r.powi(3) + s.powi(-2) + x.powi(0) + r.powi(1) + (x + y).powi(7);
        let reals = r.powf(2.0) + s.powf(-1.5) + r.powf(0.5) + s.powf(-1.0) + r.powf(0.3) + s.powf(y) + 2.0_f64.powf(x)
            + x.powf(r) + r.powf(-2.7);
        let others = (3.0 * s).sinc() + s.recip() + x.mul_add(y, r) + (100.0 * x).to_radians() + y.to_degrees() + f64::sin(r);
        roots + exponentials + logarithms + circular + inverse + hyperbolic + areas + signs + two + powers
            + reals + others + 3 as f64 * x
    },
)]
#[derive(Clone, Debug)]
pub struct EveryFunction {}

/// Branches, in H and in α, on both sides of their seams.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form    = (if x > edge { y * y * y } else { y + x * y }) * d(x) + 3.0 * x * d(y),
    hamiltonian = {
        let near = if x < y && y <= edge || !(x >= -edge) { x.powi(3) * y } else { (x + y).sin() };
        let far = if x * x + y * y > 1.0 { y * y } else if (y > 0.0) { x * y } else { x * x };
        near - 2.0 * far * x.cos()
    },
)]
#[derive(Clone, Debug)]
pub struct Branches {
    /// Where the branches change.
    pub edge: f64,
}
