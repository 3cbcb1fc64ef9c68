//! Projected schemes: what becomes of Ω.

use dvi_core::Real;
use dvi_core::methods::Method;
use dvi_core::prelude::*;
use dvi_tests::Outcome;
use dvi_tests::filling;
use dvi_tests::steps::{jacobian, stepped};
use dvi_tests::zoo::particles::Mirror;
use nalgebra::DMatrix;
use num_dual::Dual64;

const MIRROR: [f64; 4] = [0.4, 0.3, 0.2, 0.5];

/// a Dα + b (Dα)ᵀ
fn combined<S: DegenerateLagrangian<T>, T: Real>(system: &S, q: &[T], t: f64, [a, b]: [f64; 2]) -> Vec<T> {
    let n = q.len();
    let mut entries = vec![T::lift(0.0); n * n];
    let [time, a, b] = [t, a, b].map(T::lift);
    system.one_form_jacobian(q, time, a, b, &mut filling(&mut entries, n));
    entries
}

/// (Dα)ᵀ − Dα, the matrix of dα.
fn omega<S: DegenerateLagrangian<f64>>(system: &S, q: &[f64], t: f64) -> DMatrix<f64> {
    DMatrix::from_row_slice(q.len(), q.len(), &combined(system, q, t, [-1.0, 1.0]))
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

/// λ of the step from q0 to q1, from the sum of its equations.
fn lambda<S: DegenerateLagrangian<Dual64>>(
    system: &S,
    [q0, q1]: [&[Dual64]; 2],
    [t, h]: [f64; 2],
) -> Vec<Dual64> {
    let n = q0.len();
    let mut lambda = vec![Dual64::from_re(0.0); n];
    let half = Dual64::from_re(0.5);
    let form = |q: &[Dual64], t: f64| {
        let mut form = vec![Dual64::from_re(0.0); n];
        system.one_form(q, Dual64::from_re(t), &mut form);
        form
    };
    let lifted = |q: &[Dual64], t: f64, lambda: &[Dual64]| {
        let entries = combined(system, q, t, [0.0, 1.0]);
        let row =
            |i: usize| (0..n).fold(Dual64::from_re(0.0), |sum, j| sum + entries[i * n + j] * lambda[j]);
        (0..n).map(row).collect::<Vec<_>>()
    };
    // Ω λ ≈ defect, by a fixed point: λ is small.
    let inverse = {
        let entries = combined(system, q0, t, [-1.0, 1.0]);
        DMatrix::from_fn(n, n, |i, j| entries[i * n + j].re).try_inverse().expect("Ω is regular")
    };
    for _ in 0..60 {
        // α(q0) + α(q1) − 2α(q̃) + (Dα(q0) + Dα(q1))ᵀλ = 0
        let middle: Vec<Dual64> = (0..n).map(|i| (q0[i] + q1[i]) * half + lambda[i]).collect();
        let (start, end, centre) = (form(q0, t), form(q1, t + h), form(&middle, t + h / 2.0));
        let (one, two) = (lifted(q0, t, &lambda), lifted(q1, t + h, &lambda));
        let residual: Vec<Dual64> =
            (0..n).map(|i| (start[i] + end[i] - centre[i] - centre[i] + one[i] + two[i]) * half).collect();
        for i in 0..n {
            let change = (0..n).fold(Dual64::from_re(0.0), |sum, j| sum + residual[j] * inverse[(i, j)]);
            lambda[i] -= change;
        }
    }
    lambda
}

/// With ζ = Σ ∂αⱼ/∂qⁱ λʲ dλⁱ, a step makes of dα + dζ at q0 the same at q1, to rounding errors.
#[test]
fn a_step_preserves_the_form_of_its_ends() -> Outcome {
    let (t, n) = (0.2, MIRROR.len());
    let method = Projected::symmetric();
    for h in [0.05, 0.1, 0.5] {
        let functions = jacobian(&MIRROR, 4 * n, |q0| {
            let q1 = stepped(&Mirror, &method, q0, [t, h], 1)?;
            let lambda = lambda(&Mirror, [q0, &q1], [t, h]);
            let zeta = |q: &[Dual64], t: f64| {
                let entries = combined(&Mirror, q, t, [0.0, 1.0]);
                (0..n)
                    .map(|i| {
                        (0..n).fold(Dual64::from_re(0.0), |sum, j| sum + entries[i * n + j] * lambda[j])
                    })
                    .collect::<Vec<_>>()
            };
            let (before, after) = (zeta(q0, t), zeta(&q1, t + h));
            Ok([q1, lambda, before, after].concat())
        })?;
        let part = |k: usize| functions.rows(k * n, n).into_owned();
        let [tangent, lambda, before, after] = [0, 1, 2, 3].map(part);
        // dζ of ζᵢ dλⁱ.
        let d = |zeta: &DMatrix<f64>| zeta.transpose() * &lambda - lambda.transpose() * zeta;
        let end = stepped(&Mirror, &method, &MIRROR, [t, h], 1)?;
        let at_start = omega(&Mirror, &MIRROR, t) + d(&before);
        let at_end = tangent.transpose() * omega(&Mirror, &end, t + h) * &tangent + d(&after);
        let (lost, without) = ((&at_end - &at_start).amax(), defect(&Mirror, &method, &MIRROR, h, 1)?);
        assert!(lost < 1e-13, "h = {h}: {lost:e}, and {without:e} of Ω");
    }
    Ok(())
}
