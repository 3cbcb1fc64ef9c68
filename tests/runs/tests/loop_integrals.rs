//! Poincaré's integral invariant of one-step schemes: ∮ p dx around a loop of points that are all stepped,
//! with the derivative along the loop from its Fourier series.

use core::f64::consts::PI;
use dvi_tests::Outcome;

use dvi_core::mechanics::VectorField;
use dvi_core::methods::Method;
use dvi_core::prelude::*;
use dvi_core::state::Statistics;
use dvi_core::{ProperlyDegenerate, Space};
use dvi_examples::models::TokamakInClass;
use dvi_tests::larger;
use dvi_tests::steps::stepped;
use dvi_tests::zoo::gauges::OneSided;

const STEPS: u64 = 3000;

/// `count` points of an ellipse with these half axes around a point, each coordinate at a phase of its own.
fn ellipse<const N: usize>(count: usize, centre: [f64; N], axes: [f64; N]) -> Vec<Vec<f64>> {
    let at = |k: usize| {
        let s = 2.0 * PI * k as f64 / count as f64;
        (0..N).map(|i| centre[i] + axes[i] * (s - PI / 2.0 * i as f64).cos()).collect()
    };
    (0..count).map(at).collect()
}

/// ∮ Σ ϑᵢ d(xᵢ + shift · x'ᵢ) at time t: exact for what the points resolve.
fn integral<S: ProperlyDegenerate>(system: &S, points: &[Vec<f64>], t: f64, shift: f64) -> Outcome<f64> {
    let n = system.space().dimension();
    let (mut form, mut rates) = (system.space().vector(), system.space().vector());
    let (mut momenta, mut moved) = (Vec::new(), Vec::new());
    for q in points {
        let mut point = system.space().vector();
        point.copy_from_slice(q);
        system.one_form(&point, t, &mut form);
        let mut field = VectorField::new(system, &point, t)?;
        field.evaluate(system, &point, t, &mut rates, &mut Statistics::default())?;
        momenta.push(form.to_vec());
        moved.push((0..n).map(|i| q[i] + shift * rates[i]).collect::<Vec<f64>>());
    }
    // Constants add nothing to the integral, and rounding of what they are a part of.
    centre(&mut momenta);
    centre(&mut moved);
    let (mut sum, count) = (0.0, points.len());
    for j in 0..count {
        for k in (0..count).filter(|&k| k != j) {
            // The derivative of the trigonometric polynomial through all points, at point j.
            let apart = (j as f64 - k as f64) * PI / count as f64;
            let sign = if (j + k) % 2 == 0 { 0.5 } else { -0.5 };
            let weight = sign / apart.tan() * 2.0 * PI / count as f64;
            sum += weight * (0..n).map(|i| momenta[j][i] * moved[k][i]).sum::<f64>();
        }
    }
    Ok(sum)
}

/// Takes the mean of all vectors from each.
fn centre(vectors: &mut [Vec<f64>]) {
    let count = vectors.len() as f64;
    for i in 0..vectors[0].len() {
        let mean = vectors.iter().map(|vector| vector[i]).sum::<f64>() / count;
        vectors.iter_mut().for_each(|vector| vector[i] -= mean);
    }
}

/// By how much, relative to its size, the integral of a loop changes in all steps, at most.
fn change<S: ProperlyDegenerate, M: Method<S, f64>>(
    system: &S,
    method: &M,
    points: Vec<Vec<f64>>,
    h: f64,
    shift: f64,
) -> Outcome<f64> {
    let before = integral(system, &points, 0.0, shift)?;
    let (mut points, mut largest) = (points, 0.0);
    for part in 0..3 {
        let t = part as f64 * (STEPS / 3) as f64 * h;
        for q in &mut points {
            *q = stepped(system, method, q, [t, h], STEPS / 3)?;
        }
        let after = integral(system, &points, t + (STEPS / 3) as f64 * h, shift)?;
        largest = larger(largest, ((after - before) / before).abs());
    }
    Ok(largest)
}

#[test]
fn loop_integrals_are_kept_over_three_thousand_steps() -> Outcome {
    fn check<S: ProperlyDegenerate>(system: &S, points: &[Vec<f64>], h: f64, bound: f64) -> Outcome {
        let schemes = [
            (OneStep::midpoint(), 0.0),
            (OneStep::trapezoid(), 0.0),
            (OneStep::scheme_a(), -h),
            (OneStep::scheme_b(), h),
        ];
        for (method, shift) in schemes {
            let change = change(system, &method, points.to_vec(), h, shift)?;
            assert!(change < bound, "{}, {method:?}, h = {h}: {change:e}", S::REPORT.system);
        }
        let change = change(system, &OneStepGauss::<2>::new(), points.to_vec(), h, 0.0)?;
        assert!(change < bound, "{}, Gauss, h = {h}: {change:e}", S::REPORT.system);
        Ok(())
    }
    let prey = OneSided { a: [1.0, 1.0], b: [-1.0, -2.0] };
    let around_prey = ellipse(64, [1.0, 1.75], [0.05, 0.05]);
    check(&prey, &around_prey, 0.05, 1e-11)?;
    check(&prey, &around_prey, 0.1, 1e-11)?;
    // Further away from the equilibrium at (1, 2) the scheme A has no solution with such a step.
    check(&prey, &ellipse(64, [1.0, 2.0], [0.005, 0.005]), 0.5, 1e-11)?;
    // A passing orbit; no component of α is affine. The angle φ grows to some hundreds, and with it what
    // rounding is seen.
    let tokamak = TokamakInClass { q: 2.0, mu: 6e-5 };
    let around_orbit = ellipse(256, [0.2, 0.1, 0.0, 0.012], [0.005, 0.05, 0.02, 2e-4]);
    check(&tokamak, &around_orbit, 10.0, 1e-9)?;
    check(&tokamak, &around_orbit, 20.0, 1e-9)?;
    // What does not preserve the form is seen: Ω by the scheme A, and by Runge–Kutta.
    let lost = change(&prey, &OneStep::scheme_a(), around_prey.clone(), 0.05, 0.0)?;
    assert!(lost > 1e-5, "{lost:e}");
    let lost = change(&prey, &RungeKutta::classical(), around_prey, 0.1, 0.0)?;
    assert!(lost > 1e-8, "{lost:e}");
    Ok(())
}
