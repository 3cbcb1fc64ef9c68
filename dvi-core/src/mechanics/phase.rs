//! Where a run on T*Q is, and what its next step is guessed from: all that a checkpoint needs besides the
//! coordinates.

use crate::error::{StartError, StepFailure};
use crate::mechanics::legendre::Legendre;
use crate::mechanics::mass::Mass;
use crate::mechanics::orientation::MassOrientation;
use crate::memory::lasting;
use crate::scalar::norm;
use crate::scalar::passes::{kick, multiply};
use crate::state::history::History;
use crate::state::rates::is_similar;
use crate::state::summation::{Carried, Summation};
use crate::{NondegenerateLagrangian, Real, Space, System, Vector};

/// The momentum and the force at the current point, and the last increments.
#[derive(Debug)]
pub(crate) struct PhasePoint<S: System, T: Real> {
    /// p = ∂L/∂v.
    pub(crate) p: Vector<S, T>,
    /// ∂L/∂q; it is kept if L is separable.
    pub(crate) force: Vector<S, T>,
    /// The mean velocities Δ/h of the last steps.
    history: History<S, T>,
    /// The length of the step before; zero before the first.
    last_step: T,
    /// What rounding has left out of q and of p.
    pub(crate) carried: [Carried<S, T>; 2],
}

/// The end of a step: q1, p1 and, if L is separable, ∂L/∂q there.
pub(crate) struct Arrival<'a, T> {
    pub(crate) q: &'a [T],
    pub(crate) p: &'a [T],
    pub(crate) force: &'a [T],
}

impl<T: Real> Arrival<'_, T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn finite<S: NondegenerateLagrangian<T>>(&self) -> Result<(), StepFailure> {
        norm::finite(self.q).and(norm::finite(self.p))?;
        if S::SEPARABLE { norm::finite(self.force) } else { Ok(()) }
    }
}

impl<S: NondegenerateLagrangian<T>, T: Real> PhasePoint<S, T> {
    /// At (`q`, `v`, `t`).
    ///
    /// # Errors
    /// [`StartError::Starter`] if momentum or force is no number.
    pub(crate) fn new(system: &S, q: &[T], v: &[T], t: T, summation: Summation) -> Result<Self, StartError> {
        let space = system.space();
        let [mut force, mut p, mut mean]: [Vector<S, T>; 3] = space.vectors();
        system.gradient(q, v, t, &mut force, &mut p);
        norm::finite(&p).and(norm::finite(&force)).map_err(StartError::Starter)?;
        mean.copy_from_slice(v);
        let carried = [Carried::new(system, summation), Carried::new(system, summation)];
        Ok(Self { p, force, history: History::new(system, Some(mean)), last_step: T::lift(0.0), carried })
    }

    /// Whether the last steps may be extrapolated to one of length `h`.
    #[inline]
    pub(crate) fn extrapolates_to(&self, h: T) -> bool {
        is_similar(h, self.last_step)
    }

    /// Sets `increment` to the guess of Δ for a step of length `h`: extrapolated from the steps before if
    /// they had about this length; else that of a free motion, where the mass matrix is constant, or of one
    /// that `falls`, which moves from rest too, if L is separable.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn guess(&self, mass: &Mass<S, T>, h: T, falls: bool, increment: &mut [T]) {
        if S::CONSTANT_MASS && !self.extrapolates_to(h) {
            increment.copy_from_slice(&self.p);
            if S::SEPARABLE && falls {
                kick(increment, T::lift(0.5) * h, &self.force);
            }
            mass.solve_in_place(increment);
        } else {
            self.history.extrapolate(increment);
        }
        multiply(increment, h);
    }

    /// Sets `q1` to q0 + Δ.
    pub(crate) fn reach(&self, q: &[T], increment: &[T], q1: &mut [T]) {
        self.carried[0].add(q, increment, q1);
    }

    /// Sets `p1` to p0 and `impulse`.
    pub(crate) fn kick(&self, impulse: &[T], p1: &mut [T]) {
        self.carried[1].add(&self.p, impulse, p1);
    }

    /// Moves to the end of a step of length `h`, which has changed q and p by Δ and (D₁ + D₂)L_d.
    ///
    /// # Errors
    /// [`StepFailure::NotFinite`]; nothing has moved then.
    pub(crate) fn advance(
        &mut self,
        q: &mut [T],
        to: &Arrival<'_, T>,
        [delta, impulse]: [&[T]; 2],
        h: T,
    ) -> Result<(), StepFailure> {
        to.finite::<S>()?;
        let [of_q, of_p] = &mut self.carried;
        of_q.advance(q, delta, to.q);
        of_p.advance(&mut self.p, impulse, to.p);
        if S::SEPARABLE {
            self.force.copy_from_slice(to.force);
        }
        self.remember(delta, h);
        Ok(())
    }

    /// The same where sums are plain, with Δ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn advance_plainly(
        &mut self,
        q: &mut [T],
        to: &Arrival<'_, T>,
        increment: &[T],
        h: T,
    ) -> Result<(), StepFailure> {
        to.finite::<S>()?;
        self.set(q, to);
        self.remember(increment, h);
        Ok(())
    }

    /// Adds an impulse to the momentum. The next step is guessed from `velocity`, about what the impulse
    /// leads to.
    pub(crate) fn jump(&mut self, impulse: &[T], velocity: &[T]) {
        for (p, &impulse) in self.p.iter_mut().zip(impulse) {
            *p += impulse;
        }
        self.history.begin_again(velocity);
        self.last_step = T::lift(0.0);
    }

    #[inline]
    fn remember(&mut self, increment: &[T], h: T) {
        if !self.extrapolates_to(h) {
            self.history.clear();
        }
        self.last_step = h;
        self.history.push_scaled(increment, T::lift(1.0) / h);
    }

    /// Sets coordinates, momentum and force where sums are plain.
    #[inline]
    pub(crate) fn set(&mut self, q: &mut [T], to: &Arrival<'_, T>) {
        q.copy_from_slice(to.q);
        self.p.copy_from_slice(to.p);
        if S::SEPARABLE {
            self.force.copy_from_slice(to.force);
        }
    }
}

lasting!([S: System, T: Real] PhasePoint<S, T>, T;
    numbers p, numbers force, part history, number last_step, parts carried);

/// The mass matrix ∂²L/∂v∂v of a run.
#[derive(Debug)]
pub(crate) struct Inertial<S: System, T: Real> {
    /// p = M v, if M is constant.
    pub(crate) mass: Mass<S, T>,
    /// That of an M that depends on the state, which is watched.
    orientation: Option<MassOrientation<S, T>>,
}

impl<S: NondegenerateLagrangian<T>, T: Real> Inertial<S, T> {
    /// At (`q`, `v`, `t`).
    ///
    /// # Errors
    /// [`StartError::Starter`] where the matrix is singular.
    pub(crate) fn new(system: &S, q: &[T], v: &[T], t: T) -> Result<Self, StartError> {
        let orientation = (!S::CONSTANT_MASS).then(|| MassOrientation::new(system, q, v, t)).transpose();
        Ok(Self {
            orientation: orientation.map_err(StartError::Starter)?,
            mass: Mass::new(system, q, t).map_err(StartError::Starter)?,
        })
    }

    /// Whether the matrix has kept its orientation at (`q`, `t`), which was reached with Δ = `increment`;
    /// `velocity` is storage.
    #[inline]
    pub(crate) fn check(
        &mut self,
        system: &S,
        [q, increment]: [&[T]; 2],
        [t, h]: [T; 2],
        velocity: &mut [T],
    ) -> Result<(), StepFailure> {
        if !S::CONSTANT_MASS
            && let Some(orientation) = &mut self.orientation
        {
            let per_h = T::lift(1.0) / h;
            for (v, &delta) in velocity.iter_mut().zip(increment) {
                *v = delta * per_h;
            }
            orientation.check(system, q, velocity, t)?;
        }
        Ok(())
    }

    /// Sets `v` to the velocity with ∂L/∂v = p at (`q`, `t`).
    pub(crate) fn velocity(
        &self,
        system: &S,
        phase: &PhasePoint<S, T>,
        q: &[T],
        t: T,
        v: &mut [T],
    ) -> Result<(), StepFailure> {
        if S::CONSTANT_MASS {
            self.mass.solve(&phase.p, v);
            return Ok(());
        }
        phase.history.extrapolate(v);
        let mut legendre = Legendre::new(system, q, v, t);
        legendre.solve(system, q, &phase.p, t, v).or_else(|_| {
            // Extrapolated, a velocity may be beyond what L is defined for.
            v.fill(T::lift(0.0));
            legendre.solve(system, q, &phase.p, t, v)
        })
    }
}

lasting!([S: System, T: Real] Inertial<S, T>, T; parts orientation);
