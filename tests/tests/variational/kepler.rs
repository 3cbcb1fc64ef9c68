//! One period of Kepler's problem against the values of independent programs, orders, and invariants.

use approx::abs_diff_eq;
use core::f64::consts::TAU;
use dvi_core::discrete::{FrequencyIn, Rule};
use dvi_core::methods::Method;
use dvi_core::prelude::*;
use dvi_tests::larger;
use dvi_tests::zoo::regular::{Kepler, KeplerState};

type Outcome = Result<(), Box<dyn core::error::Error>>;
type Period = (KeplerState, f64);

const SYSTEM: Kepler = Kepler { mu: 1.0 };

/// At the pericentre of an orbit with period 2π.
fn pericentre(e: f64) -> KeplerState {
    KeplerState { x: 1.0 - e, y: 0.0, dot_x: 0.0, dot_y: ((1.0 + e) / (1.0 - e)).sqrt() }
}

/// The state after one period of `steps` steps, and max |ΔE| on the way.
fn period<F: FrequencyIn<f64>, R: Rule>(
    method: Variational<F, R>,
    e: f64,
    steps: u64,
) -> Result<Period, Box<dyn core::error::Error>> {
    let mut run = Integrator::new(&SYSTEM, method, TAU / steps as f64, pericentre(e))?;
    let initial = run.energy();
    let mut largest: f64 = 0.0;
    for _ in 0..steps {
        run.advance()?;
        largest = larger(largest, (run.energy() - initial).abs());
    }
    Ok((run.state(), largest))
}

#[test]
fn one_period_has_the_reference_values() -> Outcome {
    let (verlet, energy) = period(Variational::trapezoid(), 0.2, 200)?;
    assert!(abs_diff_eq!(verlet.x, 0.799_989_183_048_22, epsilon = 1e-11), "{verlet:?}");
    assert!((verlet.y + 0.004_327_113_757_24).abs() < 1e-11, "{verlet:?}");
    assert!(abs_diff_eq!(energy, 1.287_935_994_34e-4, epsilon = 1e-13), "{energy:e}");
    let fitted = Variational::trapezoid().phase_fitted(Curvature(Reading::LeftFrozen));
    let (fitted, energy) = period(fitted, 0.2, 200)?;
    assert!(abs_diff_eq!(fitted.x, 0.799_914_909_563_45, epsilon = 1e-11), "{fitted:?}");
    assert!((fitted.y + 0.011_460_521_261_26).abs() < 1e-11, "{fitted:?}");
    assert!(abs_diff_eq!(energy, 3.101_285_800_05e-4, epsilon = 1e-13), "{energy:e}");
    Ok(())
}

#[test]
fn fixed_point_and_newton_find_the_same_steps() -> Outcome {
    for reading in [Reading::LeftFrozen, Reading::Averaged, Reading::Variational] {
        for rule in [Quadrature::gauss(1)?, Quadrature::lobatto(3)?, Quadrature::gauss(2)?] {
            let method = |solver| {
                let rule = Variational { solver, ..Variational::new(rule) };
                rule.phase_fitted(Radial(reading))
            };
            let (a, _) = period(method(Solver::FixedPoint), 0.3, 100)?;
            let (b, _) = period(method(Solver::Newton), 0.3, 100)?;
            assert!(
                larger((a.x - b.x).abs(), (a.y - b.y).abs()) < 1e-12,
                "{reading:?}, {rule:?}: {a:?} {b:?}"
            );
        }
    }
    Ok(())
}

/// The exact position at time t, by Kepler's equation t = E − e sin E.
fn exact(e: f64, t: f64) -> [f64; 2] {
    let mut anomaly = t;
    for _ in 0..100 {
        anomaly -= (anomaly - e * anomaly.sin() - t) / (1.0 - e * anomaly.cos());
    }
    [anomaly.cos() - e, (1.0 - e * e).sqrt() * anomaly.sin()]
}

/// The observed order of the position after two units of time.
fn order<F: FrequencyIn<f64> + Copy, R: Rule>(
    method: Variational<F, R>,
    e: f64,
) -> Result<f64, Box<dyn core::error::Error>> {
    order_from(method, e, 100)
}

/// The same with `steps` steps, and twice and four times as many.
fn order_from<M: Method<Kepler, f64> + Copy>(
    method: M,
    e: f64,
    steps: u64,
) -> Result<f64, Box<dyn core::error::Error>> {
    let ([x, y], mut errors) = (exact(e, 2.0), Vec::new());
    for steps in [steps, 2 * steps, 4 * steps] {
        let h = 2.0 / steps as f64;
        let mut run = Integrator::new(&SYSTEM, method, h, pericentre(e))?;
        run.take_steps(steps)?;
        errors.push((h, (run.q()[0] - x).hypot(run.q()[1] - y)));
    }
    convergence_order(&errors).ok_or_else(|| "no order".into())
}

#[test]
fn the_order_is_that_of_the_interpolation_whatever_the_rule() -> Outcome {
    for rule in [
        Quadrature::gauss(1)?,
        Quadrature::lobatto(2)?,
        Quadrature::lobatto(3)?,
        Quadrature::lobatto(5)?,
        Quadrature::gauss(5)?,
    ] {
        let found = order(Variational::new(rule), 0.2)?;
        assert!(abs_diff_eq!(found, 2.0, epsilon = 0.1), "{rule:?}: {found}");
        let found = order(Variational::new(rule).phase_fitted(Constant(1.0)), 0.2)?;
        assert!(abs_diff_eq!(found, 2.0, epsilon = 0.1), "fitted {rule:?}: {found}");
    }
    let found = order(Variational::sigma(0.3), 0.2)?;
    assert!(abs_diff_eq!(found, 1.0, epsilon = 0.1), "{found}");
    Ok(())
}

#[test]
fn a_radial_frequency_has_order_three_if_frozen_and_else_four() -> Outcome {
    for (reading, expected) in
        [(Reading::LeftFrozen, 3.0), (Reading::Averaged, 4.0), (Reading::Variational, 4.0)]
    {
        for rule in [Quadrature::lobatto(3)?, Quadrature::lobatto(4)?, Quadrature::gauss(3)?] {
            let found = order(Variational::new(rule).phase_fitted(Radial(reading)), 0.2)?;
            assert!(abs_diff_eq!(found, expected, epsilon = 0.1), "{reading:?}, {rule:?}: {found}");
        }
    }
    for reading in [Reading::LeftFrozen, Reading::Averaged, Reading::Variational] {
        let found = order(Variational::simpson().phase_fitted(Curvature(reading)), 0.2)?;
        assert!(abs_diff_eq!(found, 2.0, epsilon = 0.1), "{reading:?}: {found}");
    }
    Ok(())
}

#[test]
fn compositions_of_verlet_have_orders_four_six_and_eight() -> Outcome {
    let verlet = Variational::trapezoid();
    for (method, steps, expected) in [
        (Composition::triple_jump(verlet), 100, 4.0),
        (Composition::suzuki(verlet), 50, 4.0),
        (Composition::yoshida(verlet), 50, 6.0),
        (Composition::kahan_li_6(verlet), 20, 6.0),
        (Composition::suzuki_umeno(verlet), 12, 8.0),
        (Composition::kahan_li_8(verlet), 10, 8.0),
    ] {
        let found = order_from(method, 0.2, steps)?;
        assert!(abs_diff_eq!(found, expected, epsilon = 0.2), "{}: {found}", method.name());
    }
    Ok(())
}
