//! Steps that are taken back and tried again with a shorter length.

use super::ControlledRun;
use crate::error::StepFailure;
use crate::methods::Method;
use crate::scalar::norm::larger;
use crate::{Lagrangian, Real};

/// What a control says of a step that it has taken.
pub(super) enum Verdict<A, T> {
    Accepted(A),
    /// A step of the length times `factor` is tried next. Where that ends with steps that are too short,
    /// `failure` tells why, or the failure before it.
    TooLong {
        factor: T,
        failure: Option<StepFailure>,
    },
}

/// A step that was accepted.
pub(super) struct Accepted<A, T> {
    pub(super) h: T,
    /// What the control found out about it.
    pub(super) found: A,
    /// Whether it is the first that was tried.
    pub(super) is_first: bool,
}

/// Takes a step from time `t`: of length `h`, or of the first shorter one that `judge` accepts. What follows
/// a step that fails is shorter by the factor `after_failure`.
///
/// # Errors
/// The last failure, when the steps have become too short.
pub(super) fn step_of_at_most<S: Lagrangian<T>, M: Method<S, T>, T: Real, A>(
    run: &mut ControlledRun<'_, S, M, T>,
    t: T,
    mut h: T,
    after_failure: f64,
    mut judge: impl FnMut(&mut ControlledRun<'_, S, M, T>, T) -> Result<Verdict<A, T>, StepFailure>,
) -> Result<Accepted<A, T>, StepFailure> {
    let (mut is_first, mut failed) = (true, None);
    loop {
        let (factor, failure) = match run.step(t, h).and_then(|()| judge(run, h)) {
            Ok(Verdict::Accepted(found)) => return Ok(Accepted { h, found, is_first }),
            Ok(Verdict::TooLong { factor, failure }) => (factor, failure),
            // The failure of a longer step tells more than that the steps became too short.
            Err(failure @ StepFailure::StepLength { .. }) => return Err(failed.unwrap_or(failure)),
            Err(failure) => (T::lift(after_failure), Some(failure)),
        };
        run.go_back();
        run.stepper.statistics.rejected += 1;
        is_first = false;
        failed = failure.or(failed);
        h *= factor;
    }
}

/// A factor for the length of a step within bounds; the least one where it is not a number.
pub(super) fn within<T: Real>(factor: T, least: f64, most: f64) -> T {
    let [least, most] = [least, most].map(T::lift);
    if factor > most { most } else { larger(least, factor) }
}
