//! Steps that fail, and how they name the coordinate that a failure counts.

use core::fmt;

use thiserror::Error;

use crate::error::{StepFailure, said};
use crate::name::Name;

said!(StepError);

/// A step that failed, and where. The run keeps the last good state.
///
/// ```
#[doc = include_str!("../../docs/hidden/kepler.txt")]
/// // A head-on fall into the sun, which takes π/√8 units of time.
/// let fall = KeplerState { dot_y: 0.0, ..start };
/// let method = EnergyLimit { method: Variational::trapezoid(), limit: 0.1 };
/// let mut run = Integrator::new(&Kepler, method, 0.01, fall)?;
/// let error = run.take_steps(1000).unwrap_err();
/// assert_eq!((error.step, error.time), (run.steps(), run.time())); // the last good state
/// assert!((1.07..1.12).contains(&error.time), "{error}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, PartialEq, Error)]
#[error("step {step} from t = {time}: {}", Of(failure, *coordinate))]
pub struct StepError {
    /// The number of steps completed before this one.
    pub step: u64,
    /// The time at which the failed step began.
    pub time: f64,
    /// Why.
    pub failure: StepFailure,
    /// The name of the coordinate that `failure` counts, if it counts one.
    pub coordinate: Option<Name>,
}

/// A failure that counts a coordinate, which may have a name.
pub(super) struct Of<'a>(pub(super) &'a StepFailure, pub(super) Option<Name>);

impl fmt::Display for Of<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let &Self(failure, name) = self;
        let named = |f: &mut fmt::Formatter<'_>, place: usize| match name {
            Some(name) => write!(f, "`{name}`"),
            None => write!(f, "coordinate {place}"),
        };
        match *failure {
            StepFailure::NotFinite { coordinate, value } => {
                named(f, coordinate)?;
                write!(
                    f,
                    " became {value}: a collision, a formula that left its domain, or a step that is too long"
                )
            }
            StepFailure::Singular { matrix, column, pivot } => {
                let what = if pivot.is_finite() { "singular" } else { "not finite" };
                write!(f, "{matrix} is {what}: its pivot for ")?;
                named(f, column)?;
                write!(f, " is {pivot:e}")
            }
            StepFailure::Pattern { row, column } => {
                write!(f, "the matrix of the step has an entry in row {row} for ")?;
                named(f, column)?;
                f.write_str(" that its pattern does not have")
            }
            _ => failure.fmt(f),
        }
    }
}
