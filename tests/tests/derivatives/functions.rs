//! The functions by hand.

use std::f64::consts::PI;

use dvi_tests::zoo::functions::{EveryFunction, OwnFunction};

use dvi_tests::Numbers;

use crate::derivatives::oracle::{ByHand, Number};

impl ByHand for EveryFunction {
    fn alpha<D: Number>(&self, q: &[D], _t: D) -> Vec<D> {
        let (x, y) = (q[0], q[1]);
        let (s, r) = (x * y, x + y + y + 1.0);
        vec![s.sin() + r.ln() + s.exp() * y.sqrt(), s.atan() - r.recip() + x.tanh()]
    }
    #[rustfmt::skip]
    fn energy<D: Number>(&self, q: &[D], _t: D) -> D {
        let (x, y) = (q[0], q[1]);
        let (s, r, e) = (x * y, x + y + y + 1.0, x - y);
        let sign = |on: bool| D::from(if on { 1.0 } else { -1.0 });
        [
            r.sqrt(), s.cbrt(), r.cbrt(),
            s.exp(), e.exp2(), (-s).exp() - 1.0,
            r.ln(), s.ln_1p(), r.log2(), (s * 2.0).log10(),
            e.sin(), (y - x - x).cos(), s.tan(),
            s.asin(), -(s / 2.0).asin(), e.acos(), (x / y).atan(),
            -s.sinh(), e.cosh(), r.tanh(),
            e.asinh(), r.acosh(), (s - x).atanh(),
            sign(x > y) * e * s, sign(y > x) * (x + s), -x + 2.0,
            // Both angles from the arc tangent: above the axis, and left of the origin.
            D::from(PI / 2.0) - (e / r).atan(), (e / r).atan() + sign(y > x) * PI,
            (x * x + y * y * 4.0).sqrt(),
            r * r * r, (s * s).recip(), D::one(), r, (x + y).powi(4) * (x + y).powi(3),
            r * r, (s * s * s).sqrt().recip(), r.sqrt(), s.recip(), r.powf(0.3), (s.ln() * y).exp(),
            (x * 2.0_f64.ln()).exp(), (r * x.ln()).exp(), r.powf(-2.7),
            (s * 3.0).sph_j0(), s.recip(), s + r, x * 100.0 * (PI / 180.0), y * (180.0 / PI), r.sin(), x * 3.0,
        ].into_iter().sum()
    }
    fn point(&self, random: &mut Numbers) -> Vec<f64> {
        self.within(random, 0.2, 0.8)
    }
}

impl ByHand for OwnFunction {
    fn alpha<D: Number>(&self, q: &[D], _t: D) -> Vec<D> {
        let component = |j: usize| q[j] + (q[j] - q[2 + j] * 2.0).cosh().ln();
        vec![D::zero(), D::zero(), component(0), component(1)]
    }
    /// exp(ln cosh s) = cosh s
    fn energy<D: Number>(&self, q: &[D], _t: D) -> D {
        (q[0] * q[3]).cosh().ln() + (q[0] * q[2] + q[1] * q[3]).cosh()
    }
}
