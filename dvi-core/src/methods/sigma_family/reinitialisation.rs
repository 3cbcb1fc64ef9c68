//! Reinitialisation: the parasitic part is taken from the state of a run, which then goes on along a smooth orbit.
//!
//! (q, c) ↦ (q − a, Φ(q − a)) at the same time, where a is what alternates in q and c = Φ(q) are the smooth orbits
//! (`smooth.rs`). It is done before a step, and belongs to it: if the step fails, so that the run stays, the state is what it
//! was.

use super::leapfrog;
use super::memory::TwoStep;
use super::smooth::Smoothing;
use super::{Sigma, Step};
use crate::error::{StartError, StepFailure};
use crate::methods::Clock;
use crate::state::Statistics;
use crate::state::memory::{Aside, Memory, lasting};
use crate::{DegenerateLagrangian, Real, System, Vector};

/// When the parasitic part is taken from the state of a run of [`Sigma`](super::Sigma), which then goes on from the smooth
/// part at the same time.
///
/// ```math
/// (q, c) \mapsto (\bar q, \Phi(\bar q)), \qquad \bar q = q - a
/// ```
///
/// Here c = p − α(q), Φ(q) is the defect that [`Start::Smooth`](super::Start::Smooth) finds at q, whatever the start of the run
/// was, and a is what alternates from step to step in q: by the same central difference of eighth order along the scheme's own
/// steps, four forward and four backward. It is the state
/// alone that decides, so that runs that go on from a checkpoint do the same. If α is affine and σ = ½, c = 0 afterwards; a run
/// that has c = 0 from the start is left alone.
///
/// **What becomes of the two-form.** The two-step map preserves Σ δq ∧ δp; reinitialisation does not, and a run with it
/// preserves no two-form exactly. On all of T*Q it is a projection onto half of the dimensions. On the tangent vectors of
/// smooth orbits it changes the form by a term that falls faster than h⁹. On those of orbits beside, by terms of the order
/// h² a, and of the order a² if σ = ½ and α is affine.
///
/// **What becomes of the energy.** Reinitialised so often that the mode stays small, the run follows the smooth orbits, on which
/// the two-step map is a one-step method of its order, one or two, that preserves a two-form near Ω. What a reinitialisation
/// takes from a smooth orbit, less than h⁹ of it, adds up: on a pendulum that swings to 115°, with σ = 0 and `Every(1)`, the energy
/// drifts in proportion to time, by 3·10⁻⁵ in a step with h = 0.4 and less than a tenth of that with h = 0.3. With shorter
/// steps no drift was seen: with
/// σ = 0 on the chaotic vortices of Rowley & Marsden, whose energy is lost by t = 250 without, |ΔH| is below 7·10⁻⁵ with
/// h = 0.1 up to t = 10⁴, with [`Every(10)`](Self::Every) and with `Every(100)`, and in the second half at most 1 % larger
/// than in the first; with σ = ½ on Lotka–Volterra in the symmetric gauge, where a run from (2.5, 2) ends before t = 8 without,
/// it is below 6.5·10⁻³ up to t = 1000 with `Every(1)`, `Every(10)` and `Every(30)`. Restarts that leave a mode of third order drift more: a run that
/// begins anew by a Runge–Kutta step after every ten steps has an energy error that grows with time, in proportion to h³.
/// A mode that has become large leaves a part of itself in the energy: on these vortices with h ≤ 0.1 nothing is seen of
/// one that is taken at [`Above(0.01)`](Self::Above), and `Above(0.1)` left up to twice the energy error.
///
/// **What it costs.** As much as 30 to 200 steps, the fewer the shorter the steps. Each iteration takes eight steps, four of them
/// backward: the system must be defined there.
///
/// # Errors
/// A step whose reinitialisation fails, fails with that [`StepFailure`](crate::error::StepFailure), and the run stays where it is:
/// where the iteration does not converge, what it finds is not smooth, or the points around are not in the domain. A schedule of
/// zero steps, and a threshold that is not positive and below the limit, are a [`StartError::Parameter`](crate::error::StartError::Parameter).
///
/// [`TangentMap`](crate::diagnostics::TangentMap) and what is made of it are those of the steps without reinitialisation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub enum Reinitialisation {
    /// The run goes on as the two-step map takes it.
    #[default]
    Never,
    /// Before each step whose number, counted from zero, is a positive multiple of this. For schemes that are not zero-stable it
    /// has to be a few steps: on an orbit of Lotka–Volterra with σ = ¼ and h = 0.05 a run goes on with 10, and ends with 50. The
    /// mode is measured over five points of one orbit: with less than 5 it is not measured, nor is its limit tested.
    Every(u64),
    /// Where the measured [relative size](super::ParasiticMode::relative) of the mode has passed this threshold, which is below
    /// [`Sigma::parasitic_limit`](super::Sigma::parasitic_limit). It is judged as the limit is, and when the limit is. Between two
    /// looks a mode may pass both; the limit then ends the run only if this happens within eight steps of the start or of the
    /// last reinitialisation. Choose a threshold well above (ωh/2)², the relative size that a smooth motion of frequency ω has:
    /// one that the motion itself reaches is passed again and again. Where the mode grows by a factor in a few steps, take
    /// [`Every`](Self::Every).
    Above(f64),
}

impl Reinitialisation {
    pub(super) fn threshold(self) -> Option<f64> {
        match self {
            Self::Above(threshold) => Some(threshold),
            Self::Never | Self::Every(_) => None,
        }
    }

    pub(super) fn validate(self, limit: Option<f64>) -> Result<(), StartError> {
        let (value, range) = match self {
            Self::Every(0) => (0.0, "at least 1 step"),
            Self::Above(value) if !(value > 0.0 && value < limit.unwrap_or(f64::INFINITY)) => {
                (value, "positive, and below parasitic_limit")
            }
            Self::Never | Self::Every(_) | Self::Above(_) => return Ok(()),
        };
        Err(StartError::Parameter { name: "reinitialisation", value, range })
    }

    /// Whether it is time before the step with this number.
    fn is_due(self, step: u64) -> bool {
        matches!(self, Self::Every(period) if step > 0 && step.is_multiple_of(period))
    }

    /// How many of `count` steps from this one on, at least one, can be taken until it is time.
    fn until_due(self, step: u64, count: u64) -> u64 {
        match self {
            Self::Every(period) => count.min(period - step % period),
            Self::Never | Self::Above(_) => count,
        }
    }
}

/// What reinitialises a run, and how often it has.
#[derive(Debug)]
pub(super) struct Renewal<S: System, T: Real> {
    smoothing: Smoothing<S, T>,
    pub(super) count: u64,
}

impl<S: System, T: Real> Memory<T> for Renewal<S, T> {
    lasting!(T; count count);
}

impl<S: DegenerateLagrangian<T>, T: Real> Renewal<S, T> {
    #[cfg_attr(not(feature = "alloc"), allow(clippy::useless_conversion))]
    pub(super) fn new(smoothing: Smoothing<S, T>) -> Aside<Self> {
        Self { smoothing, count: 0 }.into()
    }

    /// Moves the state to a smooth orbit; it stays as it was if there is an error.
    fn renew(
        &mut self,
        step: &Step<'_, S, T>,
        run: &mut TwoStep<S, T>,
        q: &mut Vector<S, T>,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Self { smoothing, count } = self;
        smoothing.smooth(step.system, [q, &run.defect], step.t, statistics)?;
        smoothing.keep(run, q);
        q.copy_from_slice(&smoothing.q);
        run.set_out(step, [&smoothing.q, &smoothing.defect, &smoothing.velocity]);
        run.monitor.restart();
        *count += 1;
        Ok(())
    }

    /// Undoes the last.
    fn undo(&mut self, run: &mut TwoStep<S, T>, q: &mut Vector<S, T>) {
        self.smoothing.take_back(run, q);
        self.count -= 1;
    }

    /// Takes `count` steps, or as many as succeed, and returns how many; with reinitialisations where it is time.
    #[cold]
    #[inline(never)]
    #[allow(clippy::too_many_arguments)]
    pub(super) fn steps(
        &mut self,
        method: &Sigma<T>,
        system: &S,
        run: &mut TwoStep<S, T>,
        q: &mut Vector<S, T>,
        clock: Clock<T>,
        count: u64,
        statistics: &mut Statistics,
    ) -> (u64, Result<(), StepFailure>) {
        let (schedule, mut taken) = (method.reinitialisation, 0);
        // Whether the monitor asks for it, and whether it has been done at the present point.
        let (mut is_asked, mut is_done) = (false, false);
        while taken < count {
            let (clock, number) = (clock.after(taken), run.monitor.steps);
            let step = Step { system, method, t: clock.time(), h: clock.step_size() };
            if !is_done && !run.defect_vanishes && (is_asked || schedule.is_due(number)) {
                if let Err(failure) = self.renew(&step, run, q, statistics) {
                    return (taken, Err(failure));
                }
                is_done = true;
            }
            is_asked = false;
            let wanted = schedule.until_due(number, count - taken);
            let (walked, result) = some_steps(&step, run, q, clock, wanted, statistics);
            taken += walked;
            is_done &= walked == 0;
            match result {
                Ok(()) => {}
                Err(StepFailure::ParasiticMode { limit, .. })
                    if !is_done && schedule.threshold() == Some(limit) =>
                {
                    is_asked = true;
                }
                Err(failure) => {
                    if is_done {
                        self.undo(run, q);
                    }
                    return (taken, Err(failure));
                }
            }
        }
        (taken, Ok(()))
    }
}

/// Takes at least one and at most `count` steps, and returns how many.
fn some_steps<S: DegenerateLagrangian<T>, T: Real>(
    step: &Step<'_, S, T>,
    run: &mut TwoStep<S, T>,
    q: &mut Vector<S, T>,
    clock: Clock<T>,
    count: u64,
    statistics: &mut Statistics,
) -> (u64, Result<(), StepFailure>) {
    if S::AFFINE && step.method.sigma == T::lift(0.0) {
        let (taken, result) = leapfrog::steps(step.system, run, q, clock, count);
        statistics.gradients += taken;
        return (taken, result);
    }
    match run.step(step, q, statistics) {
        Ok(()) => (1, Ok(())),
        Err(failure) => (0, Err(failure)),
    }
}
