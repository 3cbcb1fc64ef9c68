//! Derivatives of stiff steps of Gauss collocation, by Newton's method.

use approx::{abs_diff_eq, relative_eq};
use dvi_core::Real;
use dvi_core::prelude::*;
use dvi_tests::Outcome;
use num_dual::{Dual2_64, Dual64};

/// α is curved, and in p = y + y³/3 the motion is that of the oscillator.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = (y + y.powi(3) / 3.0) * d(x),
    hamiltonian = k * (x * x / 2.0 + (y + y.powi(3) / 3.0).powi(2) / 2.0),
)]
struct Curved {
    k: f64,
}

/// By the length of the steps, once and twice, against differences of fourth order.
#[test]
fn derivatives_of_stiff_steps_converge() -> Outcome {
    fn after<T: Real, M: Method<Curved, T>>(method: M, h: T) -> Outcome<T> {
        let start = CurvedStateOf { x: T::lift(0.3), y: T::lift(-0.2) };
        let mut run = Integrator::new(&Curved { k: 60.0 }, method, h, start)?;
        run.take_steps(3)?;
        Ok(run.state().x)
    }
    let (h, d) = (0.1, 1e-5);
    let slope = |[a, b, c, d]: [f64; 4], by: f64| (a - 8.0 * b + 8.0 * c - d) / (12.0 * by);
    let method = Gauss::<4>::new();
    let around = [h - 2.0 * d, h - d, h + d, h + 2.0 * d];
    let (mut values, mut slopes) = ([0.0; 4], [0.0; 4]);
    for (i, h) in around.into_iter().enumerate() {
        values[i] = after(method, h)?;
        slopes[i] = after(method, Dual64::new(h, 1.0))?.eps;
    }
    let (once, twice) = (after(method, Dual64::new(h, 1.0))?, after(method, Dual2_64::new(h, 1.0, 0.0))?);
    let [by_steps, of_slopes] = [slope(values, d), slope(slopes, d)];
    assert!(abs_diff_eq!(once.re, after(method, h)?, epsilon = 1e-13));
    assert!(relative_eq!(once.eps, by_steps, epsilon = 0.0, max_relative = 1e-8), "{once}, {by_steps}");
    assert!(relative_eq!(twice.v1, once.eps, epsilon = 0.0, max_relative = 1e-12), "{twice}, {once}");
    assert!(relative_eq!(twice.v2, of_slopes, epsilon = 0.0, max_relative = 1e-8), "{twice}, {of_slopes}");
    Ok(())
}
