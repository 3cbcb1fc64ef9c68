//! The gaps at a point, and what rounding errors make of them.

use crate::error::{StartError, StepFailure};
use crate::mechanics::constraints::Multipliers;
use crate::scalar::norm::reported;
use crate::{ConstrainedSystem, Real, Scalar, Space, UnilateralLagrangian};

/// The gap functions at a point, and their rates of change there.
#[derive(Debug)]
pub(super) struct Gaps<S: ConstrainedSystem, T: Real> {
    pub(super) gap: Multipliers<S, T>,
    pub(super) rate: Multipliers<S, T>,
}

impl<S: UnilateralLagrangian<T>, T: Real> Gaps<S, T> {
    pub(super) fn new(system: &S) -> Self {
        Self { gap: system.multipliers().vector(), rate: system.multipliers().vector() }
    }

    /// Evaluates them.
    ///
    /// # Errors
    /// [`StepFailure::Gap`].
    pub(super) fn look(&mut self, system: &S, q: &[T], v: &[T], t: T) -> Result<(), StepFailure> {
        system.gap(q, t, &mut self.gap);
        system.gap_rate(q, v, t, &mut self.rate);
        let values = self.gap.iter().zip(self.rate.iter()).enumerate();
        for (surface, (&gap, &rate)) in values {
            // Where a gap is closed it is not asked for the rate, which may have none behind the surface.
            if !gap.is_finite() || (gap >= T::lift(0.0) && !rate.is_finite()) {
                let value = reported(if gap.is_finite() { rate } else { gap });
                return Err(StepFailure::Gap { surface, value });
            }
        }
        Ok(())
    }
}

/// Sets `gap` to the gaps at (`q`, `t`), and hands over the terms of |∂g/∂q|(|q| + |h v|), each with the
/// number of its surface. Rounding errors of the coordinates, and of their changes in a step of length `h`,
/// are errors of the gap of that size.
pub(super) fn terms<S: UnilateralLagrangian<T>, T: Real>(
    system: &S,
    [q, v]: [&[T]; 2],
    [t, h]: [T; 2],
    gap: &mut [T],
    mut add: impl FnMut(usize, T),
) {
    let mut sizes = |surface: usize, j: usize, entry: T| {
        add(surface, Scalar::abs(entry) * (Scalar::abs(q[j]) + Scalar::abs(h * v[j])));
    };
    system.gap_jacobian(q, t, gap, &mut sizes);
}

/// A start may be beyond a surface by so many rounding errors.
const ROUNDINGS: f64 = 1e4;

/// Whether a run with steps of length `h` can begin at (`q`, `v`, `t`).
///
/// # Errors
/// [`StartError::Beyond`] with the first surface that it is beyond; [`StartError::Starter`] where a gap is
/// no number.
pub(super) fn admit<S: UnilateralLagrangian<T>, T: Real>(
    system: &S,
    [q, v]: [&[T]; 2],
    t: T,
    h: T,
) -> Result<(), StartError> {
    let [mut gap, mut size]: [Multipliers<S, T>; 2] = system.multipliers().vectors();
    terms(system, [q, v], [t, h], &mut gap, |surface, term| size[surface] += term);
    let rounding = T::lift(ROUNDINGS) * T::default_epsilon();
    for (surface, (&gap, &size)) in gap.iter().zip(size.iter()).enumerate() {
        if !gap.is_finite() {
            return Err(StartError::Starter(StepFailure::Gap { surface, value: reported(gap) }));
        }
        if gap < -rounding * size {
            return Err(StartError::Beyond { surface, gap: reported(gap) });
        }
    }
    Ok(())
}
