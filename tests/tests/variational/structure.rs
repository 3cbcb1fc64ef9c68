//! What the members of the family preserve: dq ∧ dp, time reversal, momenta, and their order.

use super::Outcome;
use super::phase_space::{Start, return_error, symplectic_defect};
use approx::abs_diff_eq;
use dvi_core::methods::{Method, PreservedForm};
use dvi_core::prelude::*;
use dvi_tests::zoo::regular::*;
use num_dual::Dual64;

fn rules() -> Result<Vec<Quadrature>, StartError> {
    let mut rules = vec![Quadrature::sigma(0.0), Quadrature::sigma(0.3), Quadrature::sigma(1.0)];
    for s in 1..=5 {
        rules.push(Quadrature::gauss(s)?);
    }
    for s in 2..=5 {
        rules.push(Quadrature::lobatto(s)?);
    }
    Ok(rules)
}

/// Checks what `method` says of itself on one system.
#[track_caller]
fn check<S: RegularLagrangian + RegularLagrangian<Dual64>, M>(
    system: &S,
    method: M,
    h: f64,
    start: &Start,
) -> Outcome
where
    M: Method<S, f64> + Method<S, Dual64> + Clone + core::fmt::Debug,
{
    let defect = symplectic_defect(system, &method, h, start, 4)?;
    let name = S::REPORT.system;
    match method.preserved_form() {
        PreservedForm::Canonical => assert!(defect < 2e-12, "{name}, {method:?}: {defect:e}"),
        _ => assert!(defect > 1e-7, "{name}, {method:?} is better than it says: {defect:e}"),
    }
    let error = return_error(system, &method, h, start, 20)?;
    assert_eq!(error < 1e-11, method.is_symmetric(), "{name}, {method:?}: {error:e}");
    Ok(())
}

#[test]
fn every_rule_preserves_the_form_and_the_symmetric_ones_are_reversible() -> Outcome {
    for rule in rules()? {
        let linear = Variational::new(rule);
        check(&Kepler { mu: 1.0 }, linear, 0.05, &(vec![0.7, 0.1], vec![0.2, 1.3]))?;
        let pendulums = DoublePendulum { mass: [1.0, 0.7], length: [1.0, 0.8], g: 1.0 };
        check(&pendulums, linear, 0.05, &(vec![1.2, -0.4], vec![0.3, 0.9]))?;
        let pendulum = SphericalPendulum { g: 1.0 };
        check(&pendulum, linear, 0.05, &(vec![0.9, 0.0], vec![0.1, 1.1]))?;
        check(&Surface { k: 1.3 }, linear, 0.05, &(vec![0.3, 0.2], vec![0.4, -0.7]))?;
        check(&Relativistic { m: 1.0 }, linear, 0.05, &(vec![0.3, 0.2], vec![0.4, -0.6]))?;
        let particle = MagneticParticle { m: 1.0, b: 0.8 };
        check(&particle, linear, 0.05, &(vec![0.3, 0.2, 0.1], vec![0.4, -0.6, 0.2]))?;
        check(&MixedVelocities {}, linear, 0.05, &(vec![0.3, 0.2], vec![0.4, -0.6]))?;
    }
    Ok(())
}

#[test]
fn a_fitted_interpolation_preserves_what_its_reading_says() -> Outcome {
    let (kepler, start) = (Kepler { mu: 1.0 }, (vec![0.7, 0.1], vec![0.2, 1.3]));
    for rule in
        [Quadrature::lobatto(2)?, Quadrature::lobatto(3)?, Quadrature::gauss(2)?, Quadrature::lobatto(4)?]
    {
        for fitting in [Fitting::Phase, Fitting::PhaseAndMomentum] {
            let method = Variational { fitting, ..Variational::new(rule) };
            check(&kepler, method.phase_fitted(Constant(1.1)), 0.1, &start)?;
            for reading in [Reading::LeftFrozen, Reading::Averaged, Reading::Variational] {
                check(&kepler, method.phase_fitted(Radial(reading)), 0.1, &start)?;
                check(&kepler, method.phase_fitted(Curvature(reading)), 0.1, &start)?;
            }
        }
    }
    Ok(())
}

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

#[test]
fn compositions_preserve_what_their_method_does() -> Outcome {
    let (kepler, start) = (Kepler { mu: 1.0 }, (vec![0.7, 0.1], vec![0.2, 1.3]));
    let pendulums = DoublePendulum { mass: [1.0, 0.7], length: [1.0, 0.8], g: 1.0 };
    let verlet = Variational::trapezoid();
    for composition in [
        Composition::triple_jump(verlet),
        Composition::suzuki(verlet),
        Composition::yoshida(verlet),
        Composition::kahan_li_6(verlet),
        Composition::suzuki_umeno(verlet),
        Composition::kahan_li_8(verlet),
    ] {
        check(&kepler, composition, 0.1, &start)?;
    }
    check(
        &pendulums,
        Composition::suzuki(Variational::midpoint()),
        0.1,
        &(vec![1.2, -0.4], vec![0.3, 0.9]),
    )?;
    let fitted = Variational::simpson().phase_fitted(Radial(Reading::Variational));
    check(&kepler, Composition::suzuki(fitted), 0.1, &start)?;
    check(&kepler, Composition::suzuki(fitted.phase_fitted(Radial(Reading::Averaged))), 0.1, &start)
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
