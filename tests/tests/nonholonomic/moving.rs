//! Constraints of the velocities with a part that does not depend on them, A v + b = 0.

use approx::abs_diff_eq;
use dvi_core::error::LengthError;
use dvi_core::prelude::*;
use dvi_tests::apart;

use super::Outcome;

/// A homogeneous sphere of mass one that rolls on a turntable: the place of its centre, and the angles by
/// which it has turned about the two axes in the plane, of which only the rates have a meaning. The point of
/// contact moves with the table.
#[lagrangian(
    coordinates(x, y, a, b),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0
        + 0.4 * radius.powi(2) * (dot(a).powi(2) + dot(b).powi(2)) / 2.0,
    nonholonomic = [dot(x) - radius * dot(b) + omega * y, dot(y) + radius * dot(a) - omega * x],
)]
#[derive(Clone, Copy, Debug)]
struct Turntable {
    radius: f64,
    omega: f64,
}

/// The velocity of the centre turns with 2Ω/7, whatever the radius: it goes around in a circle (Routh 1905,
/// art. 209).
fn on_turntable(system: Turntable, t: f64) -> TurntableState {
    let Turntable { radius, omega } = system;
    let rate = 2.0 * omega / 7.0;
    let ([x0, y0], [u, v]) = ([0.7, 0.2], [0.3, -0.5]);
    let (sin, cos) = (rate * t).sin_cos();
    let (x, y) = (x0 + (u * sin - v * (1.0 - cos)) / rate, y0 + (u * (1.0 - cos) + v * sin) / rate);
    // The rates of the angles, integrated from zero with t.
    let (dot_x, dot_y) = (u * cos - v * sin, u * sin + v * cos);
    let [centre_x, centre_y] = [x0 - v / rate, y0 + u / rate];
    let [of_x, of_y] = [
        centre_x * t + (u * (1.0 - cos) + v * sin) / rate / rate,
        centre_y * t - (u * sin - v * (1.0 - cos)) / rate / rate,
    ];
    TurntableState {
        x,
        y,
        a: (omega * of_x - (y - y0)) / radius,
        b: (omega * of_y + (x - x0)) / radius,
        dot_x,
        dot_y,
        dot_a: (omega * x - dot_y) / radius,
        dot_b: (dot_x + omega * y) / radius,
    }
}

#[test]
fn a_sphere_goes_around_on_a_turntable() -> Outcome {
    for system in [Turntable { radius: 0.3, omega: 1.5 }, Turntable { radius: 0.02, omega: -4.0 }] {
        let mut errors = Vec::new();
        for steps in [100_u32, 125, 160, 200] {
            let h = 4.0 / f64::from(steps);
            let method = Constrained::new(Variational::midpoint());
            let mut run = Integrator::new(&system, method, h, on_turntable(system, 0.0))?;
            run.take_steps(u64::from(steps))?;
            let (found, exact) = (run.state(), on_turntable(system, 4.0));
            let values = |state: &TurntableState| -> Result<Vec<f64>, LengthError> {
                Ok(system.values(state)?.collect())
            };
            errors.push((h, apart(&values(&found)?, &values(&exact)?)));
            let TurntableState { x, y, dot_x, dot_y, dot_a, dot_b, .. } = found;
            let Turntable { radius, omega } = system;
            let slip = [dot_x - radius * dot_b + omega * y, dot_y + radius * dot_a - omega * x];
            assert!(slip.iter().all(|slip| slip.abs() < 1e-14 * omega.abs()), "{slip:?}");
        }
        let order = convergence_order(&errors).ok_or("no slope")?;
        assert!(abs_diff_eq!(order, 2.0, epsilon = 0.05), "{order} {errors:?}");
    }
    Ok(())
}
