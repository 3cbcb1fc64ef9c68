//! Frequencies of the user's own, and steps that failed because of a frequency.

use super::Outcome;
use crate::error_control::Detour;
use dvi_core::discrete::Frequency;
use dvi_core::prelude::*;
use dvi_core::{Real, Scalar};
use dvi_tests::zoo::regular::*;

const START: KeplerState = KeplerState { x: 0.8, y: 0.0, dot_x: 0.0, dot_y: 1.2 };

/// r^(−3/2), without derivatives.
#[derive(Clone, Copy, Debug)]
struct Power(Option<Reading>);

impl Frequency for Power {
    fn reading(&self) -> Option<Reading> {
        self.0
    }

    fn at<T: Real>(&self, q: &[T], _v: &[T], _a: &[T]) -> T {
        Scalar::powf(q[0] * q[0] + q[1] * q[1], T::lift(-0.75))
    }
}

/// A frequency that gives nothing at all.
#[derive(Clone, Copy, Debug)]
struct Empty(Reading);

impl Frequency for Empty {
    fn reading(&self) -> Option<Reading> {
        Some(self.0)
    }
}

#[test]
fn a_frequency_without_what_its_reading_needs_is_refused() -> Outcome {
    let begin = |reading| {
        let method = Variational::simpson().phase_fitted(Power(reading));
        Integrator::new(&KEPLER, method, 0.1, START)
    };
    assert_eq!(
        begin(Some(Reading::Variational)).err(),
        Some(StartError::Unsupported {
            option: "Reading::Variational",
            reason: "Frequency::derivatives is not implemented; take Reading::Averaged",
        })
    );
    let constant = StartError::Unsupported {
        option: "a frequency that is not read from the motion",
        reason: "Frequency::fixed does not give a finite number",
    };
    assert_eq!(begin(None).err(), Some(constant));
    let galerkin = Galerkin::<3>::new().phase_fitted(Power(None));
    assert_eq!(Integrator::new(&KEPLER, galerkin, 0.1, START).err(), Some(constant));
    for reading in [Reading::LeftFrozen, Reading::Averaged] {
        begin(Some(reading))?.take_steps(10)?;
        let empty = Variational::simpson().phase_fitted(Empty(reading));
        let mut run = Integrator::new(&KEPLER, empty, 0.1, START)?;
        let error = run.advance().err();
        let undefined = |omega: f64| omega.is_nan();
        assert!(
            matches!(error, Some(StepError { step: 0, failure: StepFailure::Frequency { omega }, .. }) if undefined(omega)),
            "{reading:?}: {error:?}"
        );
        assert_eq!(run.q(), [0.8, 0.0]);
    }
    Ok(())
}

/// Where a motion begins at rest the guess of a free motion goes nowhere, and has no curvature.
#[test]
fn a_curvature_is_read_from_rest() -> Outcome {
    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 - (x * x + 4.0 * y * y) / 2.0,
    )]
    struct Springs;
    fn errors<M: Method<Springs, f64> + Copy>(method: M) -> Outcome<[f64; 2]> {
        let error = |steps: u32| {
            let start = SpringsState { x: 1.0, y: 0.5, dot_x: 0.0, dot_y: 0.0 };
            let mut run = Integrator::new(&Springs, method, 2.0 / f64::from(steps), start)?;
            run.take_steps(steps.into())?;
            Ok::<_, Box<dyn core::error::Error>>(
                (run.q()[0] - 2_f64.cos()).hypot(run.q()[1] - 4_f64.cos() / 2.0),
            )
        };
        Ok([error(40)?, error(80)?])
    }
    let curvature = Curvature(Reading::Averaged);
    let [coarse, fine] = errors(Variational::simpson().phase_fitted(curvature))?;
    assert!((3.9..4.1).contains(&(coarse / fine)) && fine < 1e-4, "{coarse:e} {fine:e}");
    let [coarse, fine] = errors(Galerkin::<3>::new().phase_fitted(curvature))?;
    assert!((14.0..18.0).contains(&(coarse / fine)) && fine < 1e-6, "{coarse:e} {fine:e}");
    Ok(())
}

#[test]
fn a_resonant_step_leaves_the_coefficients_of_no_step_behind() -> Outcome {
    let method = Variational::simpson().phase_fitted(Constant(2.0));
    let start = PlanarState { x: 1.0, y: 0.5, dot_x: 0.0, dot_y: 0.0 };
    let end = |long| -> Outcome<[f64; 2]> {
        let mut run = Integrator::controlled(&PLANE, method, Detour { h: 0.1, long }, start)?;
        run.take_steps(200)?;
        Ok([run.q()[0], run.q()[1]])
    };
    assert_eq!(end(Some(core::f64::consts::FRAC_PI_2))?, end(None)?);
    Ok(())
}
