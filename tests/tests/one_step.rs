//! One-step schemes of systems in class: failures, and how the class is seen.

use approx::assert_relative_eq;
use dvi_core::prelude::*;
use dvi_core::{ProperlyDegenerate, Space};
use dvi_examples::models::{TokamakInClass, TokamakInClassState};
use dvi_tests::Outcome;
use dvi_tests::laws::systems::{Belt, Mixed};
use dvi_tests::zoo::gauges::OneSided;

const PREY: OneSided = OneSided { a: [1.0, 1.0], b: [-1.0, -2.0] };

/// The places of the halves, for blocks of every kind.
#[test]
fn places_count_the_half_with_components_first() {
    let places = |system: &dyn Fn(usize) -> usize, n: usize| -> Vec<usize> { (0..n).map(system).collect() };
    assert_eq!(places(&|i| ProperlyDegenerate::<f64>::place(&Mixed, i), 4), [2, 0, 3, 1]);
    let ring = Belt { n: 3 };
    assert_eq!(places(&|i| ProperlyDegenerate::<f64>::place(&ring, i), 6), [0, 1, 2, 3, 4, 5]);
    assert_eq!(places(&|i| ProperlyDegenerate::<f64>::place(&PREY, i), 2), [0, 1]);
}

/// y leaves the domain of ln y, and Ω is not singular there but none.
#[test]
fn a_formula_that_leaves_its_domain_is_no_singular_form() -> Outcome {
    #[degenerate_lagrangian(coordinates(x, y), one_form = y.ln() * d(x), hamiltonian = x.exp() + y - x - 2.0 * y.ln())]
    #[derive(Clone, Debug)]
    struct Exponential;

    let mut failures = 0;
    for method in [OneStep::midpoint(), OneStep::trapezoid()] {
        for h in 1..=20 {
            let start = ExponentialState { x: 0.3, y: 1.0 };
            let mut run = Integrator::new(&Exponential, method, f64::from(h) / 2.0, start)?;
            let Err(failed) = run.take_steps(3) else { continue };
            let is_no_form =
                matches!(failed.failure, StepFailure::Orientation { after, .. } if after.is_nan());
            assert!(!is_no_form, "{method:?}: {failed}");
            failures += 1;
        }
    }
    assert!(failures > 10, "{failures}");
    Ok(())
}

/// The class is seen wherever the indices of an array of literal size can be enumerated.
#[test]
fn the_class_is_seen_in_arrays() {
    fn places<S: ProperlyDegenerate>(system: &S) -> Vec<usize> {
        (0..system.space().dimension()).map(|i| system.place(i)).collect()
    }
    macro_rules! check {
        ($($name:ident: $form:expr => $places:expr),+ $(,)?) => {$({
            #[degenerate_lagrangian(coordinates(z[4]), one_form = $form, hamiltonian = z[0] * z[1] + z[2] * z[3])]
            struct $name;
            assert_eq!(places(&$name), $places, stringify!($name));
        })+};
    }
    check!(
        Ahead: sum(0..2, |j| z[j].powi(3) * d(z[j + 2])) => [2, 3, 0, 1],
        Behind: sum(2..4, |j| z[j - 2].powi(3) * d(z[j])) => [2, 3, 0, 1],
        Even: sum(0..2, |j| z[2 * j].powi(3) * d(z[2 * j + 1])) => [2, 0, 3, 1],
        Around: sum(0..2, |j| z[j + 2].powi(3) * d(z[(j + 1) % 2])) => [0, 1, 2, 3],
        Pairs: sum_pairs(0..2, |j, k| z[j + 2].powi(3) * d(z[j]) + z[k + 2].powi(3) * d(z[k])) => [0, 1, 2, 3],
    );
}

/// What reports say of the σ-family.
#[test]
fn reports_say_which_sigma_can_be_used() {
    macro_rules! structure {
        ($form:expr) => {{
            #[degenerate_lagrangian(coordinates(x, y), one_form = $form, hamiltonian = x * x + y * y)]
            struct Any;
            Any::REPORT.structure.join("\n")
        }};
    }
    let affine = structure!(x * d(y) - y * d(x));
    assert!(affine.contains("any σ can be used where Dα is antisymmetric"), "{affine}");
    let bent = structure!(y.powi(3) * d(x));
    assert!(bent.contains("σ = ½ alone can be used"), "{bent}");
}

/// What is left of the equations where they hold to rounding errors, of angles of a million here, is no
/// kick.
#[test]
fn momenta_are_kept_however_large_the_angles_are() -> Outcome {
    let system = TokamakInClass { q: 2.0, mu: 6e-5 };
    let start = TokamakInClassState { r: 0.2, theta: 1e6, phi: 2e6, u: 1.2e-2 };
    let mut run = Integrator::new(&system, OneStep::midpoint(), 60.0, start)?;
    let before = run.momentum(0).ok_or("no momentum")?;
    for _ in 0..500 {
        run.advance()?;
        assert_relative_eq!(run.momentum(0).ok_or("no momentum")?, before, max_relative = 1e-14);
    }
    Ok(())
}
