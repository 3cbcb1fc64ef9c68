//! Projected schemes: what becomes of Ω.

use dvi_core::prelude::*;
use dvi_tests::steps::{jacobian, stepped};
use dvi_tests::zoo::particles::Mirror;
use dvi_tests::{Outcome, filling};
use nalgebra::DMatrix;
use num_dual::Dual64;

const MIRROR: [f64; 4] = [0.4, 0.3, 0.2, 0.5];

/// (Dα)ᵀ − Dα, the matrix of dα.
fn omega<S: DegenerateLagrangian<f64>>(system: &S, q: &[f64], t: f64) -> DMatrix<f64> {
    let n = q.len();
    let mut entries = vec![0.0; n * n];
    system.one_form_jacobian(q, t, -1.0, 1.0, &mut filling(&mut entries, n));
    DMatrix::from_row_slice(n, n, &entries)
}

/// By how much one step, or some, change Ω.
fn defect<S, M>(system: &S, method: &M, q0: &[f64], h: f64, steps: u64) -> Outcome<f64>
where
    S: DegenerateLagrangian<Dual64> + DegenerateLagrangian<f64>,
    M: Method<S, Dual64> + Method<S, f64>,
{
    let t = 0.2;
    let tangent = jacobian(q0, q0.len(), |q| stepped(system, method, q, [t, h], steps))?;
    let end = stepped(system, method, q0, [t, h], steps)?;
    let after = omega(system, &end, t + steps as f64 * h);
    Ok((tangent.transpose() * after * &tangent - omega(system, q0, t)).amax())
}

/// The defect of a step is of order h λ², five.
#[test]
fn omega_is_nearly_preserved() -> Outcome {
    let steps = [0.2, 0.1, 0.05];
    let slope = |method: Projected, count: &dyn Fn(f64) -> u64| {
        let mut defects = Vec::new();
        for h in steps {
            defects.push((h, defect(&Mirror, &method, &MIRROR, h, count(h))?));
        }
        convergence_order(&defects).ok_or_else(|| Box::<dyn core::error::Error>::from("no slope"))
    };
    let (one, until_two) = (|_: f64| 1, |h: f64| (2.0 / h).round() as u64);
    let method = Projected::symmetric();
    let found = [slope(method, &one)?, slope(method, &until_two)?];
    assert!((found[0] - 5.0).abs() < 0.2 && (found[1] - 4.0).abs() < 0.2, "{found:?}");
    // Gauss collocation with as many evaluations changes Ω a thousand times more.
    let projected = defect(&Mirror, &method, &MIRROR, 0.1, 20)?;
    let gauss = defect(&Mirror, &Gauss::<1>::new(), &MIRROR, 0.1, 20)?;
    assert!(1e3 * projected < gauss, "{projected:e} and {gauss:e}");
    Ok(())
}
