//! The observed order of convergence.

use crate::Scalar;

/// The slope of the least-squares line through (ln h, ln error).
///
/// `None` with fewer than two different steps, or if a step or an error is not positive and finite.
pub fn convergence_order(errors: &[(f64, f64)]) -> Option<f64> {
    let usable = |x: f64| x > 0.0 && x.is_finite();
    if !errors.iter().all(|&(h, error)| usable(h) && usable(error)) {
        return None;
    }
    let count = errors.len() as f64;
    let logarithms = || errors.iter().map(|&(h, error)| (Scalar::ln(h), Scalar::ln(error)));
    let (x_sum, y_sum) = logarithms().fold((0.0, 0.0), |sums, (x, y)| (sums.0 + x, sums.1 + y));
    let (x_mean, y_mean) = (x_sum / count, y_sum / count);
    let (xx, xy) = logarithms().fold((0.0, 0.0), |(xx, xy), (x, y)| {
        (xx + (x - x_mean) * (x - x_mean), xy + (x - x_mean) * (y - y_mean))
    });
    (xx > 0.0).then(|| xy / xx)
}
