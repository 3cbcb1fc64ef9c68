//! The observed order of convergence.

use crate::Scalar;

/// The slope of the least-squares line through (ln h, ln error).
///
/// `None` with fewer than two different steps, or if a step or an error is not positive and finite.
///
/// ```
#[doc = include_str!("../../docs/hidden/pendulum.txt")]
/// let angle = |h: f64, steps| -> Result<f64, Box<dyn std::error::Error>> {
///     let mut run = Integrator::new(&Pendulum, Variational::trapezoid(), h, start.clone())?;
///     run.take_steps(steps)?;
///     Ok(run.state().angle)
/// };
/// let exact = angle(1e-4, 10_000)?;
/// let errors = [(0.1, (angle(0.1, 10)? - exact).abs()), (0.05, (angle(0.05, 20)? - exact).abs())];
/// assert!((convergence_order(&errors).unwrap() - 2.0).abs() < 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
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
