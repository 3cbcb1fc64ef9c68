//! A function of several variables, and expansions of such by dual numbers.

use dvi_core::Scalar;
use dvi_core::field::Expansion;
use num_dual::HyperDual64;

/// A function of D variables, of this period in each, that treats none as the other and is no product.
pub fn smooth<const D: usize, T: Scalar>(period: f64, at: [T; D]) -> T {
    let wave = |i: usize| (at[i] * T::lift(core::f64::consts::TAU / period) + T::lift(0.3 + i as f64)).sin();
    let sum = (0..D).fold(T::lift(0.0), |sum, i| sum + wave(i) * T::lift(0.5 + 0.25 * i as f64));
    sum + wave(0) * wave(D - 1)
}

/// Value, gradient and Hessian of a function by dual numbers.
pub fn by_dual_numbers<const D: usize>(
    at: [f64; D],
    f: impl Fn([HyperDual64; D]) -> HyperDual64,
) -> Expansion<D> {
    let mut expansion = Expansion { value: 0.0, gradient: [0.0; D], hessian: [[0.0; D]; D] };
    for i in 0..D {
        for j in 0..D {
            let mut x = at.map(HyperDual64::from);
            x[i].eps1 = 1.0;
            x[j].eps2 = 1.0;
            let f = f(x);
            (expansion.value, expansion.gradient[i], expansion.hessian[i][j]) = (f.re, f.eps1, f.eps1eps2);
        }
    }
    expansion
}
