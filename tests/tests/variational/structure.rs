//! What becomes of dq ∧ dp with a frozen frequency, without one, and at an equilibrium.

use super::Outcome;
use super::phase_space::symplectic_defect;
use approx::abs_diff_eq;
use dvi_core::prelude::*;
use dvi_tests::zoo::regular::*;

/// The defect of a step whose frequency is frozen at its left end falls like h³.
#[test]
fn the_defect_of_a_frozen_frequency_is_of_third_order() -> Outcome {
    let (kepler, start) = (Kepler { mu: 1.0 }, (vec![0.7, 0.1], vec![0.2, 1.3]));
    let method = Variational::trapezoid().phase_fitted(Curvature(Reading::LeftFrozen));
    let mut defects = Vec::new();
    for h in [0.08, 0.04, 0.02] {
        defects.push((h, symplectic_defect(&kepler, &method, h, &start, 1)?));
    }
    let order = convergence_order(&defects).ok_or("an order")?;
    assert!(abs_diff_eq!(order, 3.0, epsilon = 0.2), "{order}: {defects:?}");
    Ok(())
}

#[lagrangian(coordinates(theta), lagrangian = dot(theta).powi(2) / 2.0 + theta.cos())]
#[derive(Clone, Debug)]
struct Pendulum;

#[lagrangian(coordinates(x, y), lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0)]
#[derive(Clone, Debug)]
struct Free;

/// At an equilibrium too, where the values have converged before the first iteration and nothing tells how
/// far the derivatives are.
#[test]
fn a_run_on_dual_numbers_is_a_tangent_map() -> Outcome {
    let equilibrium = (vec![0.0], vec![0.0]);
    let explicit = symplectic_defect(&Pendulum, &Variational::trapezoid(), 0.1, &equilibrium, 50)?;
    assert!(explicit < 1e-13, "{explicit:e}");
    let implicit = symplectic_defect(&Pendulum, &Variational::midpoint(), 0.1, &equilibrium, 50)?;
    assert!(implicit < 1e-13, "{implicit:e}");
    let fixed_point = Variational { solver: Solver::FixedPoint, ..Variational::midpoint() };
    let by_fixed_point = symplectic_defect(&Pendulum, &fixed_point, 0.1, &equilibrium, 50)?;
    assert!(by_fixed_point < 1e-13, "{by_fixed_point:e}");
    let beside = symplectic_defect(&Pendulum, &Variational::midpoint(), 0.1, &(vec![0.3], vec![0.1]), 50)?;
    assert!(beside < 1e-11, "{beside:e}");
    Ok(())
}

/// √z is not differentiable at z = (ωh/2)² = 0, the functions of it that a step uses are.
#[test]
fn a_frequency_of_zero_has_a_tangent_map() -> Outcome {
    let start = (vec![0.3, 0.2], vec![0.4, -0.6]);
    for reading in [Reading::LeftFrozen, Reading::Averaged, Reading::Variational] {
        let curvature = Variational::simpson().phase_fitted(Curvature(reading));
        let radial = Variational::simpson().phase_fitted(Radial(reading));
        for defect in [
            symplectic_defect(&Free, &curvature, 0.1, &start, 4)?,
            symplectic_defect(&Free, &radial, 0.1, &start, 4)?,
        ] {
            assert!(defect < 1e-13, "{reading:?}: {defect:e}");
        }
    }
    Ok(())
}
