//! The largest Lyapunov exponent of a run of a variational method.
//!
//! λ = lim (1/t) ln |M_k … M_1 δ| with the exact tangent map M of each step and δ scaled back to length
//! one after each (Benettin et al. 1980).

use super::TangentMap;
use crate::discrete::{Interval, Nodes};
use crate::error::StepError;
use crate::methods::{Method, VariationalMethod};
use crate::run::{Integrator, Run, StepControl};
use crate::scalar::passes::divide;
use crate::system::start::step_error;
use crate::{Held, Lagrangian, Real, Scalar, Space, System, Vector, Weights};

/// The growth of a perturbation along a run, accumulated step by step.
///
/// Perturbations live in (q, p), so the exponent of a degenerate system is that of the two-step map,
/// parasitic mode included.
///
/// ```
#[doc = include_str!("../../docs/hidden/pendulum.txt")]
/// // Upside down, a small angle grows like e^t.
/// let start = PendulumState { angle: core::f64::consts::PI, dot_angle: 0.0 };
/// let mut run = Integrator::new(&Pendulum, Variational::trapezoid(), 0.01, start)?;
/// let mut exponent = LyapunovExponent::new(&run);
/// for _ in 0..10_000 {
///     exponent.advance(&mut run)?;
/// }
/// assert!((exponent.exponent().unwrap() - 1.0).abs() < 0.03);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct LyapunovExponent<S: System, N, T: Real = f64> {
    map: TangentMap<S, N, T>,
    dq: Vector<S, T>,
    dp: Vector<S, T>,
    origin: Vector<S, T>,
    growth: T,
    elapsed: T,
}

impl<S: Lagrangian<T>, N: Nodes<T>, T: Real> LyapunovExponent<S, N, T> {
    /// The exponent of the given run, from its current state on. The first perturbation has a direction of
    /// no significance, and that of a degenerate system keeps p = α(q).
    pub fn new<H: Held<System = S>, M, C: StepControl<S, T>>(run: &Integrator<H, M, T, C>) -> Self
    where
        M: Method<S, T> + VariationalMethod<S, T, Nodes = N>,
    {
        let (system, space) = (run.system(), run.system().space());
        let direction = |offset: usize| {
            let mut vector: Vector<S, T> = space.vector();
            for (i, x) in vector.iter_mut().enumerate() {
                *x = Scalar::cos(T::lift((1 + offset + i) as f64));
            }
            vector
        };
        let dq = direction(0);
        let dp =
            if S::REGULAR { direction(dq.len()) } else { Self::along(system, run.q(), run.time(), &dq) };
        let mut exponent = Self {
            map: TangentMap::new(system, run.method()),
            dq,
            dp,
            origin: space.vector(),
            growth: T::lift(0.0),
            elapsed: T::lift(0.0),
        };
        exponent.renormalise();
        exponent
    }

    /// By how much p = ∂L/∂v = α(q) changes with q.
    fn along(system: &S, q: &[T], t: T, dq: &[T]) -> Vector<S, T> {
        let space = system.space();
        let [rest, mut l_q, mut l_v, mut dp]: [Vector<S, T>; 4] = space.vectors();
        let zero = T::lift(0.0);
        let weights = Weights { qq: zero, qv: zero, vq: T::lift(1.0), vv: zero };
        let mut product = |i: usize, j: usize, entry: T| dp[i] += entry * dq[j];
        system.linearize(q, &rest, t, weights, &mut l_q, &mut l_v, &mut product);
        dp
    }

    /// Takes one step of the run and lets the perturbation grow with it. Nothing is allocated.
    ///
    /// # Errors
    /// As [`Run::advance`], and [`Singular`](crate::error::StepFailure::Singular) if the step has no
    /// tangent map; the run has then completed its step.
    pub fn advance<H: Held<System = S>, M, C: StepControl<S, T>>(
        &mut self,
        run: &mut Integrator<H, M, T, C>,
    ) -> Result<(), StepError>
    where
        M: Method<S, T> + VariationalMethod<S, T, Nodes = N>,
    {
        let (t, step) = (run.time(), run.steps());
        self.origin.copy_from_slice(run.q());
        run.advance()?;
        let interval = Interval { t, h: run.step_size() };
        let evaluated = self.map.evaluate(run.system(), interval, &self.origin, run.q());
        evaluated.map_err(|failure| step_error(run.system(), step, t, failure))?;
        self.map.apply(&mut self.dq, &mut self.dp);
        let length = self.renormalise();
        self.growth += Scalar::ln(length);
        self.elapsed += Scalar::abs(interval.h);
        Ok(())
    }

    /// Scales the perturbation to length one and returns the length it had.
    fn renormalise(&mut self) -> T {
        let squares = |x: &[T]| x.iter().fold(T::lift(0.0), |sum, &x| sum + x * x);
        let length = Scalar::sqrt(squares(&self.dq) + squares(&self.dp));
        divide(&mut self.dq, length);
        divide(&mut self.dp, length);
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
}
