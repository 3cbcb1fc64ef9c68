//! The largest Lyapunov exponent of a run of the σ-family.
//!
//! λ = lim (1/t) ln |M_k … M_1 δ| with the exact tangent map M of each step and δ scaled back to length
//! one after each (Benettin et al. 1980).

use super::TangentMap;
use crate::error::StepError;
use crate::norm::reported;
use crate::{DegenerateLagrangian, Integrator, Real, Scalar, Sigma, Space, Vector};

/// The growth of a perturbation along a run, accumulated step by step.
///
/// Perturbations live in (q, p), so the exponent is that of the two-step map, parasitic mode included.
#[derive(Debug)]
pub struct LyapunovExponent<S: DegenerateLagrangian, T: Real = f64> {
    map: TangentMap<S, T>,
    dq: Vector<S, T>,
    dp: Vector<S, T>,
    origin: Vector<S, T>,
    growth: T,
    elapsed: T,
}

impl<S: DegenerateLagrangian, T: Real> LyapunovExponent<S, T> {
    /// For the given run, from its current state; the first perturbation points nowhere in particular
    /// and keeps p = α(q).
    pub fn new(run: &Integrator<'_, S, Sigma<T>, T>) -> Self {
        let (system, space) = (run.system(), run.system().space());
        let mut dq: Vector<S, T> = space.vector();
        for (i, x) in dq.iter_mut().enumerate() {
            *x = Scalar::cos(T::lift(1.0 + i as f64));
        }
        let mut jacobian = space.matrix();
        system.one_form_jacobian(run.q(), run.time(), T::lift(1.0), T::lift(0.0), &mut jacobian);
        let mut dp = space.vector();
        crate::elimination::multiply_add(&jacobian, &dq, &mut dp);
        let mut exponent = Self {
            map: TangentMap::new(system),
            dq,
            dp,
            origin: space.vector(),
            growth: T::lift(0.0),
            elapsed: T::lift(0.0),
        };
        exponent.renormalise();
        exponent
    }

    /// Takes one step of the run and lets the perturbation grow with it. Nothing is allocated.
    ///
    /// # Errors
    /// As [`Integrator::advance`], and [`Singular`](crate::StepFailure::Singular) if the step has no
    /// tangent map; the run has then completed its step.
    pub fn advance(&mut self, run: &mut Integrator<'_, S, Sigma<T>, T>) -> Result<(), StepError> {
        let (t, h, sigma, step) = (run.time(), run.step_size(), run.method().sigma, run.steps());
        self.origin.copy_from_slice(run.q());
        run.advance()?;
        self.map.evaluate(run.system(), sigma, t, h, &self.origin, run.q()).map_err(|failure| StepError {
            step,
            time: reported(t),
            failure,
        })?;
        self.map.apply(&mut self.dq, &mut self.dp);
        let length = self.renormalise();
        self.growth += Scalar::ln(length);
        self.elapsed += Scalar::abs(h);
        Ok(())
    }

    /// Scales the perturbation to length one and returns the length it had.
    fn renormalise(&mut self) -> T {
        let squares = |x: &[T]| x.iter().fold(T::lift(0.0), |sum, &x| sum + x * x);
        let length = Scalar::sqrt(squares(&self.dq) + squares(&self.dp));
        for x in self.dq.iter_mut().chain(self.dp.iter_mut()) {
            *x /= length;
        }
        length
    }

    /// The mean rate of growth so far, per unit of time; `None` before the first step.
    pub fn exponent(&self) -> Option<T> {
        (self.elapsed > T::lift(0.0)).then(|| self.growth / self.elapsed)
    }

    /// ln of the factor by which the perturbation has grown.
    pub fn growth(&self) -> T {
        self.growth
    }

    /// The time over which it has grown.
    pub fn elapsed(&self) -> T {
        self.elapsed
    }
}
