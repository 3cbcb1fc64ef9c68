//! The trapezoidal rule with linear interpolation on L = ½ v·M v − V(q, t): Störmer–Verlet, in the form
//! kick–drift–kick, with plain sums. One ∂L/∂q a step, no iteration, no factorisation.
//!
//! p½ = p0 + (h/2) F(q0, t)    q1 = q0 + h M⁻¹p½    p1 = p½ + (h/2) F(q1, t + h)
//!
//! A fast path: a step of Kepler's problem takes 25 instructions and 17 ns, and by
//! [`step`](crate::methods::step) 135 and 22 ns (`cargo bench -p dvi-kernels --bench instructions`, with
//! this path and without).
//!
//! Source: Hairer, Lubich & Wanner 2003, "Geometric numerical integration illustrated by the Störmer–Verlet
//! method".

use crate::error::StepFailure;
use crate::mechanics::mass::Mass;
use crate::mechanics::phase::{Arrival, Inertial, PhasePoint};
use crate::methods::Clock;
use crate::methods::step::Carried;
use crate::methods::walk::{Walk, walk};
use crate::scalar::{norm, passes};
use crate::space::scratch;
use crate::{NondegenerateLagrangian, Real, Space, Vector};

/// Takes `count` steps, or as many as succeed, and returns how many; `q` and `memory` are then at the last
/// good point.
#[inline]
pub(super) fn steps<S: NondegenerateLagrangian<T>, T: Real>(
    system: &S,
    Carried { phase, inertial: Inertial { mass, .. }, work }: &mut Carried<S, T>,
    q: &mut Vector<S, T>,
    clock: Clock<T>,
    count: u64,
) -> (u64, Result<(), StepFailure>) {
    scratch!(q1 = system, work.node.point);
    scratch!(p1 = system, work.node.momentum);
    scratch!(f1 = system, work.trial);
    scratch!(v = system, work.node.velocity);
    q1.copy_from_slice(q);
    p1.copy_from_slice(&phase.p);
    f1.copy_from_slice(&phase.force);
    let half = T::lift(0.5) * clock.step_size();
    walk(Kicks { system, mass, clock, half, q, phase, q1, p1, f1, v, owed: false }, 0, count)
}

/// The present point, momentum and force, and where they are kept.
struct Kicks<'a, S: NondegenerateLagrangian<T>, T: Real> {
    system: &'a S,
    mass: &'a Mass<S, T>,
    clock: Clock<T>,
    half: T,
    q: &'a mut Vector<S, T>,
    phase: &'a mut PhasePoint<S, T>,
    q1: &'a mut [T],
    p1: &'a mut [T],
    f1: &'a mut [T],
    v: &'a mut [T],
    /// Whether the half kick that ends a step is still to come: with that of the next step it takes one pass
    /// over memory.
    owed: bool,
}

impl<S: NondegenerateLagrangian<T>, T: Real> Kicks<'_, S, T> {
    /// Kicks the momentum by (h/2)F, in the way that is given, and moves the point on.
    #[inline]
    fn move_on(&mut self, kick: impl Fn(T, T) -> T) {
        let Self { half, q1, p1, f1, v, .. } = self;
        if let Some(reciprocals) = self.mass.reciprocals() {
            // In one pass over memory.
            for (((p, &f), q), &reciprocal) in
                p1.iter_mut().zip(f1.iter()).zip(q1.iter_mut()).zip(reciprocals)
            {
                *p = kick(*p, *half * f);
                *q += *p * (self.clock.step_size() * reciprocal);
            }
        } else {
            for (p, &f) in p1.iter_mut().zip(f1.iter()) {
                *p = kick(*p, *half * f);
            }
            self.mass.solve(p1, v);
            passes::kick(q1, self.clock.step_size(), v);
        }
    }

    /// Ends the last step.
    #[inline]
    fn complete(&mut self) {
        if core::mem::take(&mut self.owed) {
            passes::kick(self.p1, self.half, self.f1);
        }
    }
}

impl<S: NondegenerateLagrangian<T>, T: Real> Walk for Kicks<'_, S, T> {
    const ALONE: bool = <S::Space as Space>::ON_STACK;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn step(&mut self, number: u64) {
        if self.owed {
            self.move_on(|p, impulse| (p + impulse) + impulse);
        } else {
            self.move_on(|p, impulse| p + impulse);
        }
        self.owed = true;
        let Self { q1, f1, .. } = self;
        self.system.force(q1, &[], self.clock.after(number + 1).time(), f1);
    }

    #[inline]
    fn examine(&mut self, _steps: u64) -> Result<(), StepFailure> {
        self.complete();
        scratch!(examined = self.system, *self.v);
        examined.copy_from_slice(self.q1);
        norm::finite(examined)?;
        // A collision shows in the force, which is in the momentum.
        examined.copy_from_slice(self.p1);
        norm::finite(examined)
    }

    #[inline]
    fn keep(&mut self) {
        self.phase.set(self.q, &Arrival { q: self.q1, p: self.p1, force: self.f1 });
    }

    #[inline]
    fn go_back(&mut self) {
        self.owed = false;
        self.q1.copy_from_slice(self.q);
        self.p1.copy_from_slice(&self.phase.p);
        self.f1.copy_from_slice(&self.phase.force);
    }
}
