//! The classical Runge–Kutta method, beside which others are set.

/// One step of it.
pub fn rk4<const N: usize>(y: &[f64; N], h: f64, f: impl Fn(&[f64; N]) -> [f64; N]) -> [f64; N] {
    let moved = |by: f64, slope: &[f64; N]| std::array::from_fn(|i| y[i] + by * slope[i]);
    let first = f(y);
    let second = f(&moved(0.5 * h, &first));
    let third = f(&moved(0.5 * h, &second));
    let fourth = f(&moved(h, &third));
    std::array::from_fn(|i| y[i] + h / 6.0 * (first[i] + 2.0 * (second[i] + third[i]) + fourth[i]))
}
