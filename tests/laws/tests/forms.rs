//! What becomes of dq ∧ dp with a frozen frequency, and where it is zero, by the law of every scheme.

use super::Outcome;
use super::structure::lost;
use approx::abs_diff_eq;
use dvi_core::discrete::{Frequency, Rule};
use dvi_core::prelude::*;
use dvi_laws::equations::Equations;
use dvi_laws::formula::Formula;
use dvi_laws::{Case, Options, on};
use dvi_tests::zoo::regular::*;
use num_dual::Dual64;

/// By how much the form changes in steps from coordinates and velocities.
fn defect<S, F, R>(system: S, method: Variational<F, R>, h: f64, start: [&[f64]; 2]) -> Outcome<f64>
where
    S: RegularLagrangian + RegularLagrangian<Dual64> + Formula + 'static,
    F: Frequency + Copy + 'static,
    R: Rule + Copy + 'static,
{
    let (system, subject) = on(system, start, h);
    lost(&Case::new(system, &subject, Options::default(), (method, method), (Equations::Elsewhere, None)))
}

/// The defect of a step whose frequency is frozen at its left end falls like h³.
#[test]
fn the_defect_of_a_frozen_frequency_is_of_third_order() -> Outcome {
    let method = Variational::trapezoid().phase_fitted(Curvature(Reading::LeftFrozen));
    let mut defects = Vec::new();
    for h in [0.04, 0.02, 0.01] {
        defects.push((h, defect(Kepler { mu: 1.0 }, method, h, [&[0.7, 0.1], &[0.2, 1.3]])?));
    }
    let order = convergence_order(&defects).ok_or("an order")?;
    assert!(abs_diff_eq!(order, 3.0, epsilon = 0.2), "{order}: {defects:?}");
    Ok(())
}

/// √z is not differentiable at z = (ωh/2)² = 0, the functions of it that a step uses are.
#[test]
fn a_frequency_of_zero_has_a_tangent_map() -> Outcome {
    let (free, start): (_, [&[f64]; 2]) = (|| Kepler { mu: 0.0 }, [&[0.3, 0.2], &[0.4, -0.6]]);
    for reading in [Reading::LeftFrozen, Reading::Averaged, Reading::Variational] {
        for lost in [
            defect(free(), Variational::simpson().phase_fitted(Curvature(reading)), 0.1, start)?,
            defect(free(), Variational::simpson().phase_fitted(Radial(reading)), 0.1, start)?,
        ] {
            assert!(lost < 1e-13, "{reading:?}: {lost:e}");
        }
    }
    Ok(())
}
