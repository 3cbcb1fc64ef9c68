//! What is declared of a system, and what reports say of its structure.

use dvi_core::mechanics::Rates;
use dvi_core::prelude::*;
use dvi_tests::configurations::quasi_periodic;
use dvi_tests::zoo::regular::{DoublePendulum, Gravity, MagneticParticle, Relativistic, RunTimeChain};
use dvi_tests::{Outcome, apart};

#[test]
fn an_undeclared_momentum_is_none() -> Outcome {
    let (system, start) = quasi_periodic();
    let run = Integrator::new(&system, Sigma::midpoint(), 0.1, start)?;
    assert_eq!(run.momentum(3), None);
    assert_eq!(run.discrete_momentum(3)?, None);
    let names: Vec<_> = run.momenta().map(|(name, _)| name).collect();
    assert_eq!(names, ["impulse_x", "impulse_y", "angular"]);
    Ok(())
}

#[test]
fn reports_say_what_the_mass_matrix_is_like() {
    for (report, sentence) in [
        (Gravity::<3>::REPORT, "L = ½ v·M v − V(q, t) with a constant diagonal mass matrix M."),
        (RunTimeChain::REPORT, "L = ½ v·M v − V(q, t) with a constant full mass matrix M."),
        (
            RunTimeChain::REPORT,
            "The trapezoidal (Störmer–Verlet) step is explicit up to one factorisation for the whole run.",
        ),
        (DoublePendulum::REPORT, "The full mass matrix depends on q."),
        (DoublePendulum::REPORT, "The trapezoidal step is implicit in general."),
        (DoublePendulum::REPORT, "Begin with `Variational::midpoint()`."),
        (Relativistic::REPORT, "The full mass matrix depends on v."),
        (
            Relativistic::REPORT,
            "L is no polynomial of degree two in v: v is found from p = ∂L/∂v by iteration.",
        ),
        (MagneticParticle::REPORT, "The diagonal mass matrix is constant, but L is not ½ v·M v − V(q, t)."),
    ] {
        assert!(report.structure.contains(&sentence), "{}: {:?}", report.system, report.structure);
    }
}

/// Pendulums that do not touch, with α and H apart.
#[degenerate_lagrangian(
    coordinates(x[n], p[n]),
    one_form = sum(0..n, |i| p[i] * d(x[i])),
    hamiltonian = sum(0..n, |i| p[i].powi(2) / 2.0 - x[i].cos()),
)]
struct Apart {
    n: usize,
}

#[degenerate_lagrangian(
    coordinates(x[n], p[n]),
    lagrangian = sum(0..n, |i| p[i] * dot(x[i]) - p[i].powi(2) / 2.0 + x[i].cos()),
)]
struct InOneSum {
    n: usize,
}

#[degenerate_lagrangian(
    coordinates(x[n], p[n]),
    lagrangian = scale * sum(0..n, |i| scale * (p[i] * dot(x[i]) - p[i].powi(2) / 2.0 + x[i].cos())),
)]
struct Scaled {
    n: usize,
    scale: f64,
}

#[test]
fn a_lagrangian_in_one_sum_has_the_form_that_it_has_in_two() -> Outcome {
    fn rates<S>(system: &S, state: &S::State<f64>) -> Outcome<Vec<f64>>
    where
        S: DegenerateLagrangian + System<Kind: Rates<S, f64>>,
    {
        const { assert!(S::AFFINE && S::CANONICAL) };
        let alpha = S::REPORT.formulas.iter().find(|formula| formula.name == "α").ok_or("no α")?;
        assert!(!alpha.text.contains("cos"), "{}", alpha.text);
        Ok(system.values(&system.vector_field(0.0, state)?)?.collect())
    }
    let (x, p) = (vec![0.5, 0.1, 0.2], vec![0.3; 3]);
    let in_two = rates(&Apart { n: 3 }, &ApartState { x: x.clone(), p: p.clone() })?;
    let in_one = rates(&InOneSum { n: 3 }, &InOneSumState { x: x.clone(), p: p.clone() })?;
    let scaled = rates(&Scaled { n: 3, scale: 0.7 }, &ScaledState { x, p })?;
    assert!(apart(&in_two, &in_one) < 1e-13 && apart(&in_two, &scaled) < 1e-13);
    Ok(())
}
