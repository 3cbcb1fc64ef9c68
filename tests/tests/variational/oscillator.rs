//! The oscillator of the fitted frequency: steps of several lengths, small frequencies, resonances.

use super::Outcome;
use dvi_core::discrete::Rule;
use dvi_core::prelude::*;
use dvi_tests::larger;
use dvi_tests::zoo::regular::{PLANE, PlanarState, SPRING, SpringState};

fn rules() -> Result<Vec<Quadrature>, StartError> {
    let mut rules = vec![Quadrature::new(&[0.1, 0.4, 0.95], &[0.3, 0.5, 0.2])?, Quadrature::sigma(0.3)];
    for s in 1..=5 {
        rules.push(Quadrature::gauss(s)?);
    }
    for s in 2..=5 {
        rules.push(Quadrature::lobatto(s)?);
    }
    Ok(rules)
}

/// S = Σ w cos((1 − 2c)u).
fn cosine_sum(rule: &impl Rule, u: f64) -> f64 {
    rule.nodes().iter().zip(rule.weights()).map(|(c, w)| w * ((1.0 - 2.0 * c) * u).cos()).sum()
}

/// The forces inside are evaluated in each iteration and once for the momentum, that at the end once if
/// there is a node at one of the ends.
#[test]
fn no_force_is_evaluated_where_no_node_is() -> Outcome {
    let start = SpringState { x: 0.3, dot_x: 0.8 };
    for rule in rules()? {
        let mut run = Integrator::new(&SPRING, Variational::new(rule), 0.1, start)?;
        run.take_steps(100)?;
        let (of, inside) = (run.statistics(), rule.interior_nodes());
        let at_ends = if inside < rule.nodes().len() { of.steps } else { 0 };
        assert_eq!(of.gradients, inside as u64 * (of.iterations + of.steps) + at_ends, "{rule:?}");
    }
    Ok(())
}

/// On an ellipse, with steps of a length that follows the distance: with the phase alone fitted, momenta are
/// off by a factor that differs from step to step.
#[test]
fn steps_of_different_lengths_are_exact_where_momenta_are_fitted_too() -> Outcome {
    for rule in [Quadrature::gauss(1)?, Quadrature::lobatto(3)?, Quadrature::lobatto(4)?] {
        let phase = Variational::new(rule).phase_fitted(Constant(1.0));
        let both = Variational { fitting: Fitting::PhaseAndMomentum, ..phase };
        let mut errors = [0.0; 2];
        for (method, error) in [phase, both].into_iter().zip(&mut errors) {
            let start = PlanarState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 0.5 };
            let mut run = Integrator::controlled(&PLANE, method, Reversible::power(0.3, 1.0), start)?;
            while run.steps() < 1000 {
                run.advance()?;
                let (sin, cos) = run.time().sin_cos();
                *error = larger(*error, larger((run.q()[0] - cos).abs(), (run.q()[1] - 0.5 * sin).abs()));
            }
        }
        assert!(errors[0] > 1e-6 && errors[1] < 1e-12, "{rule:?}: {errors:?}");
    }
    Ok(())
}

#[test]
fn small_frequencies_lose_no_digits() -> Outcome {
    let start = SpringState { x: 0.3, dot_x: 0.8 };
    for rule in rules()? {
        let linear = Variational::new(rule);
        let mut reference = Integrator::new(&SPRING, linear, 0.1, start)?;
        reference.take_steps(50)?;
        for omega in [0.0, 1e-300, 1e-160, 1e-12, 1e-8] {
            let mut run = Integrator::new(&SPRING, linear.phase_fitted(Constant(omega)), 0.1, start)?;
            run.take_steps(50)?;
            let error = (run.q()[0] - reference.q()[0]).abs();
            assert!(error < 1e-13, "{rule:?}, ω = {omega:e}: {error:e}");
        }
    }
    Ok(())
}

#[test]
fn a_resonance_is_an_error_and_not_a_number() -> Outcome {
    let start = SpringState { x: 0.3, dot_x: 0.8 };
    let two_point_gauss = 2.720_699_046_35;
    for (rule, u) in [
        (Quadrature::gauss(2)?, two_point_gauss),
        (Quadrature::lobatto(2)?, core::f64::consts::FRAC_PI_2),
        (Quadrature::lobatto(3)?, core::f64::consts::PI),
        (Quadrature::lobatto(4)?, 2.0 * core::f64::consts::PI),
    ] {
        let method = Variational::new(rule).phase_fitted(Constant(1.0));
        let error = Integrator::new(&SPRING, method, u, start).err();
        assert!(
            matches!(error, Some(StartError::Starter(StepFailure::Resonance { u: found, .. })) if (found - u).abs() < 1e-12),
            "{rule:?}: {error:?}"
        );
        assert!(cosine_sum(&rule, u).abs() < 1e-9 || u.sin().abs() < 1e-9);
    }
    Ok(())
}
