//! Steps cost what is documented.

use approx::abs_diff_eq;
use dvi_core::prelude::*;
use dvi_tests::zoo::regular::*;

use super::Outcome;

#[test]
fn newton_stands_by() -> Outcome {
    let (system, start) = (Spring { stiffness: 100.0 }, SpringState { x: 1.0, dot_x: 0.0 });
    let mut stiff = Integrator::new(&system, Galerkin::<4>::new(), 0.5, start)?;
    stiff.take_steps(20)?;
    assert!(stiff.statistics().factorisations > 0);
    Ok(())
}

#[test]
fn single_precision_steps_to_its_own_rounding() -> Outcome {
    let start = KeplerState { x: 1.0, y: 0.1, dot_x: -0.2, dot_y: 1.1 };
    let narrow = KeplerStateOf { x: 1.0_f32, y: 0.1, dot_x: -0.2, dot_y: 1.1 };
    let mut single = Integrator::new(&KEPLER, Galerkin::<5>::new(), 0.1_f32, narrow)?;
    let mut double = Integrator::new(&KEPLER, Galerkin::<5>::new(), 0.1, start)?;
    single.take_steps(50)?;
    double.take_steps(50)?;
    for (a, b) in single.q().iter().zip(double.q()) {
        assert!(abs_diff_eq!(f64::from(*a), b, epsilon = 1e-4), "{a} and {b}");
    }
    Ok(())
}
