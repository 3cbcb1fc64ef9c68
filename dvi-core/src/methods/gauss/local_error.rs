//! An estimate of the error of a step of Gauss collocation, from its defect all over the step.
//!
//! The collocation polynomial u, of degree S, leaves the defect d = X(u, t) − u', which vanishes at the
//! nodes. By the formula of Alekseev & Gröbner (Hairer, Nørsett & Wanner 1993, theorem I.14.5) the error at
//! the end of the step is, to first order,
//!
//! h ∫₀¹ R(s) d(s) ds = h Σₖ Rₖ mₖ,    mₖ = ∫₀¹ Pₖ(s) d(s) ds
//!
//! with the derivative R of the flow from s to the end, and its coefficients Rₖ in Legendre polynomials Pₖ.
//! The defect is taken at the S + 1 extrema of P_S: at both ends of the step, and once in each gap between
//! two nodes. With the nodes, where it vanishes, they are a rule of degree 2S,
//!
//! mₖ = S/(2S+1) Σⱼ bⱼ Pₖ(sⱼ) d(sⱼ),    k = 0 … S,
//!
//! with the weights b of Lobatto's rule: m₀ is S/(2S+1) times what this rule and that of Gauss differ by, an
//! embedded formula. Where X is smooth d is nearly a multiple of P_S, mₖ is of order h²ˢ⁻ᵏ and Rₖ of order
//! hᵏ, so that all terms are of the order h²ˢ⁺¹ that the error has. Where X has a jump or a kink in the
//! step, m₀ is as large as d, and the error is about h m₀.
//!
//! Rₖ is not computed. R follows the derivative of X, and where X is as 1/r and its S-th coefficient,
//! relative to X, as (ṙh/r)ˢ, that of its derivative is S + 1 times that. So with the largest defect over
//! the largest slope for the former
//!
//! |error| ≈ h Σₖ ρᵏ |mₖ|,    ρˢ = (S+1) max|d|/max|X|
//!
//! where the rounding of X, and that of the times at which it is evaluated, is no part of the error. It
//! costs S + 1 evaluations of X. A change of X that comes and goes between two of these 2S + 1 points is
//! seen by none of them.

use super::memory::Path;
use crate::error::StepFailure;
use crate::mechanics::motion::{AtStages, Evaluation, FirstOrder, FirstOrderAtStages};
use crate::methods::collocation::packs::{at, combine, sum};
use crate::methods::tolerance::{Tolerance, in_units_of};
use crate::scalar::simd::widest_if;
use crate::scalar::{Lanes, norm};
use crate::state::Statistics;
use crate::{Real, Scalar, System};

/// Of the largest momentum of late, what is kept from step to step.
const FORGETTING: f64 = 0.9;

impl<const STAGES: usize, S: System<Kind: FirstOrder<S, T>>, T: Real> Path<STAGES, S, T> {
    /// The estimated error of the step that has been taken last, from time `t` with length `h`, in units of
    /// `tolerance`. The momentum is meant that there was of late, also where it is zero for a moment. A step
    /// that begins at rest makes all of its momentum, and is as wrong in it however short it is, where a
    /// force begins as a power of the time: so the momentum is meant that this force makes in a step of the
    /// usual length.
    pub(super) fn local_error<E: Evaluation>(
        &mut self,
        system: &S,
        t: T,
        [h, usual]: [T; 2],
        tolerance: Tolerance,
        statistics: &mut Statistics,
    ) -> Result<T, StepFailure>
    where
        S::Kind: FirstOrderAtStages<E, STAGES, S, T>,
    {
        widest_if(
            E::WIDE,
            #[inline]
            || {
                self.evaluate_defects::<E>(system, [t, h], statistics)?;
                self.estimate(t, [h, usual], tolerance)
            },
        )
    }

    /// Sets `increment` to the defect at the start of the step, and `slopes` to those at the other extrema,
    /// but for those of q where q' = p/m: there the defect is a multiple of P_S.
    #[inline]
    fn evaluate_defects<E>(
        &mut self,
        system: &S,
        [t, h]: [T; 2],
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure>
    where
        S::Kind: FirstOrderAtStages<E, STAGES, S, T>,
    {
        self.set_velocities();
        let Self { equations, coefficients, completed, slopes, stages, renewed, y, increment, work, .. } =
            self;
        let (extrema, first) = (&coefficients.extrema, Self::FIRST_PART);
        S::Kind::evaluate(equations, system, y, t, increment, statistics)?;
        for part in 0..first {
            completed[part].copy_from_slice(&slopes[part]);
        }
        // Forces depend on positions and, where they depend on momenta too, on all parts.
        let integrals = extrema.integrals.map(|column| column * Lanes::all(h));
        for part in 0..y.len() - first {
            combine(&integrals, &completed[part], at(&y[part]), &mut stages[part]);
        }
        for part in first..y.len() {
            let t = Lanes::all(t) + extrema.c * Lanes::all(h);
            let at = AtStages { system, part, y: &*stages, velocity: &slopes[0], t };
            S::Kind::evaluate_at_stages(equations, &at, work, renewed, statistics)?;
            slopes[part].copy_from_slice(renewed);
        }
        for part in 0..y.len() {
            for (start, slopes) in increment[part].iter_mut().zip(completed[part].iter()) {
                *start -= sum(&(extrema.at_start * *slopes).0);
            }
            if part >= first {
                for (defects, pack) in slopes[part].iter_mut().zip(completed[part].iter()) {
                    for (j, &slope) in pack.0.iter().enumerate() {
                        *defects -= extrema.values[j] * Lanes::all(slope);
                    }
                }
            }
        }
        Ok(())
    }

    /// The error that the defects lead to, in units of `tolerance`.
    #[inline]
    fn estimate(&mut self, t: T, [h, usual]: [T; 2], tolerance: Tolerance) -> Result<T, StepFailure> {
        let Self { coefficients, completed, slopes, y, increment, next, .. } = &*self;
        let (extrema, first, last) = (&coefficients.extrema, Self::FIRST_PART, y.len() - 1);
        let (zero, one) = (T::lift(0.0), T::lift(1.0));
        let largest_of = |packs: &[Lanes<STAGES, T>]| {
            packs.iter().fold(zero, |most, pack| norm::larger(most, norm::largest(&pack.0)))
        };
        let sizes = [0, last].map(|part| {
            let at_start = norm::largest(&increment[part]);
            let defect =
                if part < first { at_start } else { norm::larger(at_start, largest_of(&slopes[part])) };
            [defect, norm::larger(defect, largest_of(&completed[part]))]
        });
        let mut relative = zero;
        for (part, [defect, speed]) in sizes.into_iter().enumerate().take(y.len()) {
            norm::finite(&increment[part])?;
            relative = norm::larger(relative, in_units_of(defect, speed));
        }
        let last_power = T::lift((STAGES + 1) as f64) * relative;
        let (rho, mut powers) = (Scalar::powf(last_power, T::lift(1.0 / STAGES as f64)), [one; STAGES]);
        for k in 1..STAGES {
            powers[k] = powers[k - 1] * rho;
        }
        let length = Scalar::abs(h);
        let (before, after) = (norm::largest(&y[last]), norm::largest(&next[last]));
        let usual = norm::larger(length, Scalar::abs(usual));
        // A step that begins behind a seam has gone on from rest for some rounding errors.
        let at_rest = before == zero
            || (S::SEAMS > 0 && before <= Scalar::sqrt(T::default_epsilon()) * sizes[1][1] * usual);
        let during = if at_rest { usual } else { length };
        let present = norm::larger(before, after) + sizes[1][1] * during;
        let momentum = norm::larger(present, T::lift(FORGETTING) * self.momentum);
        let mut largest = zero;
        for (part, [_, speed]) in sizes.into_iter().enumerate().take(y.len()) {
            let mut rounding = speed;
            if !S::AUTONOMOUS {
                let changes =
                    completed[part].iter().map(|pack| norm::largest(&(*pack - Lanes::all(pack.0[0])).0));
                rounding += changes.fold(zero, norm::larger) * Scalar::abs(t / h);
            }
            let rounding = T::default_epsilon() * rounding;
            for (j, &start) in increment[part].iter().enumerate() {
                let moments = if part < first {
                    last_power * Scalar::abs(start) * T::lift(1.0 / (2 * STAGES + 1) as f64)
                } else {
                    let defects = slopes[part][j];
                    let mut moments = extrema.moments_of_start * Lanes::all(start);
                    for (column, &defect) in extrema.moments.iter().zip(&defects.0) {
                        moments += *column * Lanes::all(defect);
                    }
                    let (of_points, of_start) = extrema.last_moment;
                    let last_moment = of_start * start + sum(&(of_points * defects).0);
                    let mut terms = powers;
                    for (term, &moment) in terms.iter_mut().zip(&moments.0) {
                        *term *= Scalar::abs(moment);
                    }
                    sum(&terms) + last_power * Scalar::abs(last_moment)
                };
                let error = h * norm::larger(zero, moments - rounding);
                let allowed = match part {
                    0 => {
                        tolerance.of_coordinate(norm::larger(Scalar::abs(y[0][j]), Scalar::abs(next[0][j])))
                    }
                    _ => T::lift(tolerance.relative) * momentum,
                };
                largest = norm::larger(largest, in_units_of(error, allowed));
            }
        }
        self.momentum = momentum;
        Ok(largest)
    }
}
