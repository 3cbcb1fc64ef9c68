//! Orders 4, 6 and 8, also where the interpolation is fitted.

use approx::abs_diff_eq;
use core::f64::consts::TAU;
use dvi_core::methods::Method;
use dvi_core::prelude::*;
use dvi_tests::{apart, run};

use crate::galerkin::systems::{KEPLER, Outcome, double_pendulum, pericentre};

fn observed<S: Lagrangian, M: Method<S, f64> + Copy>(
    (system, start): (&S, &S::State<f64>),
    method: M,
    time: f64,
    steps: [u64; 4],
    reference: &[f64],
) -> Result<f64, Box<dyn core::error::Error>> {
    let mut errors = Vec::new();
    for steps in steps {
        errors.push((
            time / steps as f64,
            apart(&run(system, method, start.clone(), time, steps)?, reference),
        ));
    }
    convergence_order(&errors).ok_or_else(|| "no slope".into())
}

#[test]
fn orders_are_four_six_and_eight_on_kepler() -> Outcome {
    let (start, reference, time) = (pericentre(0.3), [0.7, 0.0], 4.0 * TAU);
    let at = (&KEPLER, &start);
    let three = observed(at, Galerkin::<3>::new(), time, [800, 1000, 1200, 1600], &reference)?;
    let four = observed(at, Galerkin::<4>::new(), time, [320, 400, 480, 640], &reference)?;
    let five = observed(at, Galerkin::<5>::new(), time, [160, 180, 200, 240], &reference)?;
    for (found, order) in [(three, 4.0), (four, 6.0), (five, 8.0)] {
        assert!(abs_diff_eq!(found, order, epsilon = 0.2), "{found}, not {order}");
    }
    let orders = [Galerkin::<3>::new().order(), Galerkin::<4>::new().order(), Galerkin::<5>::new().order()];
    assert_eq!(orders, [4, 6, 8]);
    Ok(())
}

#[test]
fn fitted_interpolation_keeps_the_orders() -> Outcome {
    let (start, reference, time) = (pericentre(0.3), [0.7, 0.0], 4.0 * TAU);
    let at = (&KEPLER, &start);
    for omega in [0.7, 1.3] {
        let frequency = Constant(omega);
        let three = observed(
            at,
            Galerkin::<3>::new().phase_fitted(frequency),
            time,
            [800, 1000, 1200, 1600],
            &reference,
        )?;
        let four = observed(
            at,
            Galerkin::<4>::new().phase_fitted(frequency),
            time,
            [320, 400, 480, 640],
            &reference,
        )?;
        let five = observed(
            at,
            Galerkin::<5>::new().phase_fitted(frequency),
            time,
            [160, 180, 200, 240],
            &reference,
        )?;
        for (found, order) in [(three, 4.0), (four, 6.0), (five, 8.0)] {
            assert!(abs_diff_eq!(found, order, epsilon = 0.2), "omega = {omega}: {found}, not {order}");
        }
    }
    let averaged = Galerkin::<3>::new().phase_fitted(Radial(Reading::Averaged));
    let found = observed(at, averaged, time, [200, 240, 280, 320], &reference)?;
    assert!(abs_diff_eq!(found, 4.0, epsilon = 0.2), "averaged: {found}");
    Ok(())
}

fn check_order<const S: usize>(steps: [u64; 4], reference: &[f64]) -> Outcome {
    let (system, start) = double_pendulum();
    let found = observed((&system, &start), Galerkin::<S>::new(), 1.0, steps, reference)?;
    assert!(abs_diff_eq!(found, (2 * S - 2) as f64, epsilon = 0.2), "{S} nodes: {found}");
    Ok(())
}

#[test]
fn orders_are_four_six_and_eight_on_the_double_pendulum() -> Outcome {
    let (system, start) = double_pendulum();
    let reference = run(&system, Galerkin::<5>::new(), start, 1.0, 400)?;
    // Another method, extrapolated, agrees with it.
    let midpoint = |steps| run(&system, Variational::midpoint(), start, 1.0, steps);
    let (coarse, fine) = (midpoint(4000)?, midpoint(8000)?);
    let extrapolated: Vec<f64> = coarse.iter().zip(&fine).map(|(c, f)| f + (f - c) / 3.0).collect();
    assert!(apart(&reference, &extrapolated) < 1e-10, "{reference:?} {extrapolated:?}");
    check_order::<3>([32, 48, 64, 96], &reference)?;
    check_order::<4>([16, 24, 32, 48], &reference)?;
    check_order::<5>([48, 56, 64, 80], &reference)
}
