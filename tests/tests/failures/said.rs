//! What users read of a failure: `Debug`, which `main` prints of an error that it returns, is its sentence.

use core::error::Error;
use core::fmt::{Debug, Display};

use dvi_core::error::{CheckpointError, IndexError, LengthError};
use dvi_core::prelude::*;

/// Masses that are driven away.
#[lagrangian(
    coordinates(y, x[4]),
    lagrangian = dot(y).powi(2) / 2.0 + sum(0..4, |j| dot(x[j]).powi(2) / 2.0 + x[j].exp()),
)]
struct Driven {}

fn are_one<E: Debug + Display>(error: &E) {
    assert_eq!(format!("{error:?}"), error.to_string());
}

#[test]
fn errors_of_a_step_are_their_sentences() -> Result<(), Box<dyn Error>> {
    let start = DrivenState { y: 0.0, dot_y: 0.0, x: [0.0, 0.1, 600.0, 0.2], dot_x: [0.0; 4] };
    let mut run = Integrator::new(&Driven {}, Variational::trapezoid(), 0.1, start)?;
    let error = run.take_steps(10).err().ok_or("no error")?;
    assert!(matches!(error.failure, StepFailure::NotFinite { coordinate: 3, .. }), "{error}");
    let message = error.to_string();
    assert!(
        message.starts_with(&format!("step {} from t = {}: coordinate 3 became ", error.step, error.time)),
        "{message}"
    );
    are_one(&error);
    are_one(&error.failure);
    let boxed: Box<dyn Error> = error.into();
    assert_eq!(format!("{boxed:?}"), message);
    Ok(())
}

#[test]
fn errors_of_a_start_are_their_sentences() {
    let start = DrivenState { y: f64::NAN, dot_y: 0.0, x: [0.0; 4], dot_x: [0.0; 4] };
    let error = Integrator::new(&Driven {}, Variational::trapezoid(), 0.1, start).err();
    let error = error.expect("a state that is no number");
    assert_eq!(format!("{error:?}"), "y = NaN in the state");
    are_one(&error);
    are_one(&LengthError { array: "x", expected: 3, found: 2 });
    are_one(&IndexError { array: "x", index: 3, len: 2 });
    are_one(&CheckpointError::Short);
}
