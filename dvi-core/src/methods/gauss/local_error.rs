//! An estimate of the error of a step of Gauss collocation.
//!
//! The collocation polynomial u, of degree S, leaves the defect d = X(u, t) − u', which vanishes at the nodes. By the formula of
//! Alekseev & Gröbner (Hairer, Nørsett & Wanner 1993, theorem I.14.5) the error at the end of the step is, to first order,
//!
//! h ∫₀¹ R(s) d(s) ds
//!
//! with the derivative R of the flow from s to the end. Of both factors the S-th Legendre polynomial P_S is what counts: d = dₛP_S + …
//! since it vanishes at the zeros of P_S, and what R has below the degree S is orthogonal to that. As ∫P_S² = 1/(2S+1), the error is
//!
//! h Rₛdₛ/(2S+1),    with the coefficients Rₛ of R and dₛ of d.
//!
//! At the start of the step |P_S| = 1, so |dₛ| is |d(0)| = |X(y, t) − u'(0)| but for terms of higher order. Rₛ is not computed: R follows
//! the derivative of X, and where X is as 1/r and its S-th coefficient, relative to X, as (ṙh/r)ˢ, that of its derivative is S + 1 times
//! that. So d(0) is taken for both:
//!
//! |error| ≈ (S+1)/(2S+1) · max|d(0)|/max|X| · h |d(0)|
//!
//! The estimate is of order h²ˢ⁺¹, as the error is, and costs one evaluation of X.

use super::memory::Path;
use crate::error::StepFailure;
use crate::mechanics::motion::FirstOrder;
use crate::methods::tolerance::{Tolerance, in_units_of};
use crate::scalar::norm;
use crate::state::Statistics;
use crate::{Real, Scalar, System};

impl<const STAGES: usize, S: System<Kind: FirstOrder<S, T>>, T: Real> Path<STAGES, S, T> {
    /// The estimated error of the step that has been taken last, from time `t` with length `h`, in units of `tolerance`. A step that begins at
    /// rest makes all of its momentum, and is as wrong in it however short it is, where a force begins as a power of the time: so the
    /// momentum is meant that this force makes in a step of the usual length.
    pub(super) fn local_error(
        &mut self,
        system: &S,
        t: T,
        [h, usual]: [T; 2],
        tolerance: Tolerance,
        statistics: &mut Statistics,
    ) -> Result<T, StepFailure> {
        self.set_velocities();
        let Self { equations, coefficients, slopes, y, increment: defect, next, .. } = self;
        S::Kind::evaluate(equations, system, y, t, defect, statistics)?;
        let at_start = coefficients.at_start();
        let zero = T::lift(0.0);
        let (mut relative, mut largest) = (zero, zero);
        for part in 0..y.len() {
            norm::finite(&defect[part])?;
            let mut speed = zero;
            for (defect, slopes) in defect[part].iter_mut().zip(slopes[part].iter()) {
                let continued = slopes.0.iter().zip(&at_start).fold(zero, |sum, (&k, &l)| sum + l * k);
                speed = norm::larger(speed, norm::largest(&slopes.0));
                *defect = h * (*defect - continued);
            }
            let increment = Scalar::abs(h) * speed;
            relative = norm::larger(relative, in_units_of(&defect[part], |_| increment));
            let size = |j: usize| norm::larger(Scalar::abs(y[part][j]), Scalar::abs(next[part][j]));
            let error = if part == 0 {
                in_units_of(&defect[part], |j| tolerance.of_coordinate(size(j)))
            } else {
                let most = norm::larger(norm::largest(&y[part]), norm::largest(&next[part]));
                let is_at_rest = norm::largest(&y[part]) == zero;
                let made = if is_at_rest {
                    norm::larger(Scalar::abs(h), Scalar::abs(usual)) * speed
                } else {
                    increment
                };
                let allowed = tolerance.of_momentum(most + made);
                in_units_of(&defect[part], |_| allowed)
            };
            largest = norm::larger(largest, error);
        }
        Ok(T::lift((STAGES + 1) as f64 / (2 * STAGES + 1) as f64) * relative * largest)
    }
}
