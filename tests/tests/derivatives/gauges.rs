//! Lotka–Volterra by hand.

use dvi_tests::systems::LotkaVolterra;
use dvi_tests::zoo::gauges::{OneSided, OneSidedShifted, SymmetricShifted};

use crate::derivatives::oracle::{ByHand, Number, Random};

macro_rules! lotka_volterra {
    ($($system:ident: |$x:ident, $y:ident| $alpha:expr;)*) => {$(
        impl ByHand for $system {
            fn alpha<D: Number>(&self, q: &[D], _t: D) -> Vec<D> {
                let ($x, $y) = (q[0], q[1]);
                $alpha.to_vec()
            }
            fn energy<D: Number>(&self, q: &[D], _t: D) -> D {
                (0..2).map(|i| q[i] * self.a[i] + q[i].ln() * self.b[i]).sum()
            }
            fn point(&self, random: &mut Random) -> Vec<f64> {
                self.within(random, 0.2, 3.0)
            }
        }
    )*};
}

lotka_volterra! {
    LotkaVolterra: |x, y| [y.ln() / x / 2.0, -x.ln() / y / 2.0];
    OneSided: |x, y| [y.ln() / x, D::zero()];
    OneSidedShifted: |x, y| [y + y.ln() / x, x];
    SymmetricShifted: |x, y| [y + y.ln() / x / 2.0, x - x.ln() / y / 2.0];
}
