//! σ = 0 with affine α: explicit, one ∇H a step.
//!
//! q1 = (q0 + K⁻¹c0) + s   with K = −(Dα)ᵀ, s = −hK⁻¹∇H(q0),   and c1 = −DαΔ,  Δ = q1 − q0.
//!
//! Only s has to wait for the gradient: the point ahead, q0 + K⁻¹c0, was left by the step before. In a
//! symmetric gauge, ½(x dy − y dx), it is the point before: q2 = q0 + 2s, the leapfrog scheme as it is
//! usually written (Rowley & Marsden 2002, eq. 13). Over many steps the points are local arrays, which the
//! compiler can keep in registers, and c, which no step needs, is computed at the end: 128 instructions a
//! step of four vortices, and 250 where each state is read.

use super::memory::{Carried, Leaps, Work};
use super::parasitic_mode::Monitor;
use crate::error::StepFailure;
use crate::mechanics::combination::{Inverse, Product};
use crate::methods::Clock;
use crate::methods::walk::{Walk, walk};
use crate::scalar::norm;
use crate::scalar::passes::add;
use crate::space::scratch;
use crate::{DegenerateLagrangian, Real, System, Vector};

/// What a run with σ = 0 carries.
type Parts<'a, S, T> = (&'a mut Carried<S, T>, &'a mut Leaps<S, T>, &'a mut Monitor<S, T>);

/// Takes `count` steps, or as many as succeed, and returns how many; `q`, and what the run carries, are then
/// at the last good point.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn steps<S: DegenerateLagrangian<T>, T: Real>(
    system: &S,
    (carried, leaps, monitor): Parts<'_, S, T>,
    q: &mut Vector<S, T>,
    clock: Clock<T>,
    count: u64,
) -> (u64, Result<(), StepFailure>) {
    let Carried { defect, inverse, scale, l_d, work, .. } = carried;
    let Leaps { product, ahead, reverses, storage: [delta, c] } = leaps;
    let from = monitor.steps;
    let node = &mut l_d.work;
    let kept = Kept { ahead, defect, spare: &mut node.momentum, q };
    let storage = [&mut node.point, &mut node.velocity, &mut node.gradient];
    let run = Run { system, inverse, product, monitor: &mut *monitor, clock, kept };
    let (taken, result) = if *reverses {
        run.steps(count, (storage, work), |q0, _, ahead| ahead.copy_from_slice(q0))
    } else {
        run.steps(count, (storage, work), |q0, q1, ahead| {
            let by = (system, &*inverse, *scale, &*product);
            look_ahead(by, [q0, q1], [delta, c], ahead);
        })
    };
    monitor.steps = from + taken;
    (taken, result)
}

/// Sets `ahead` to q1 + K⁻¹c1, for what `scale` K is the inverse of; with storage.
#[inline(never)]
fn look_ahead<S: DegenerateLagrangian<T>, T: Real>(
    (system, inverse, scale, product): (&S, &Inverse<S, T>, T, &Product<S, T>),
    [q0, q1]: [&[T]; 2],
    [delta, c]: [&mut Vector<S, T>; 2],
    ahead: &mut [T],
) {
    for i in 0..q0.len() {
        delta[i] = q1[i] - q0[i];
    }
    product.apply(system, delta, c);
    c.iter_mut().for_each(|c| *c *= scale);
    inverse.solve(system, c, ahead);
    for i in 0..q0.len() {
        ahead[i] += q1[i];
    }
}

/// What the steps are computed with, and what they leave.
struct Run<'a, S: System, T: Real> {
    system: &'a S,
    inverse: &'a Inverse<S, T>,
    product: &'a Product<S, T>,
    monitor: &'a mut Monitor<S, T>,
    clock: Clock<T>,
    kept: Kept<'a, S, T>,
}

/// The last good point, with the point ahead and the defect there, and storage for a point.
struct Kept<'a, S: System, T: Real> {
    q: &'a mut Vector<S, T>,
    ahead: &'a mut Vector<S, T>,
    defect: &'a mut Vector<S, T>,
    spare: &'a mut Vector<S, T>,
}

impl<S: DegenerateLagrangian<T>, T: Real> Run<'_, S, T> {
    /// With the rule that sets the point ahead, its last argument, from q0 and q1.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn steps(
        self,
        count: u64,
        ([point, velocity, of_h], work): ([&mut Vector<S, T>; 3], &mut Work<S, T>),
        look_ahead: impl FnMut(&[T], &[T], &mut [T]),
    ) -> (u64, Result<(), StepFailure>) {
        let Self { system, kept, .. } = &self;
        scratch!(q0 = system, *point);
        scratch!(q1 = system, work.next);
        scratch!(ahead = system, *velocity);
        scratch!(gradient = system, *of_h);
        scratch!(s = system, work.increment);
        q1.copy_from_slice(kept.q);
        ahead.copy_from_slice(kept.ahead);
        let before = self.monitor.steps;
        walk(Leapfrog { run: self, look_ahead, q0, q1, ahead, gradient, s }, before, count)
    }
}

/// The last points, as the steps move them.
struct Leapfrog<'a, 'b, S: System, T: Real, L> {
    run: Run<'a, S, T>,
    look_ahead: L,
    q0: &'b mut [T],
    q1: &'b mut [T],
    ahead: &'b mut [T],
    gradient: &'b mut [T],
    s: &'b mut [T],
}

impl<S: DegenerateLagrangian<T>, T: Real, L: FnMut(&[T], &[T], &mut [T])> Walk
    for Leapfrog<'_, '_, S, T, L>
{
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn step(&mut self, number: u64) {
        let Self { run: Run { system, inverse, clock, .. }, q0, q1, ahead, gradient, s, .. } = self;
        system.hamiltonian_gradient(q1, clock.after(number).time(), gradient);
        inverse.solve(system, gradient, s);
        q0.copy_from_slice(q1);
        add(ahead, s, q1);
        (self.look_ahead)(q0, q1, ahead);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn block(&self) -> u64 {
        self.run.monitor.period()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn watch(&mut self, number: u64) {
        let monitor = &mut *self.run.monitor;
        monitor.note(monitor.steps + number, self.q1);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn admit(&mut self, number: u64) -> Result<(), StepFailure> {
        let Run { monitor, kept, .. } = &mut self.run;
        monitor.examine(monitor.steps + number, kept.q)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn examine(&mut self, steps: u64) -> Result<(), StepFailure> {
        // Copies: what is examined must live in memory.
        scratch!(examined = self.run.system, *self.run.kept.spare);
        examined.copy_from_slice(self.q1);
        norm::finite(examined)?;
        if steps == 1 {
            return Ok(());
        }
        examined.copy_from_slice(self.q0);
        norm::finite(examined)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn keep(&mut self) {
        let Self { run: Run { system, product, kept, .. }, q0, q1, ahead, s, .. } = self;
        kept.q.copy_from_slice(q1);
        kept.ahead.copy_from_slice(ahead);
        for (s, (&q1, &q0)) in s.iter_mut().zip(q1.iter().zip(q0.iter())) {
            *s = q1 - q0;
        }
        product.apply(system, s, kept.defect);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn go_back(&mut self) {
        self.q1.copy_from_slice(self.run.kept.q);
        self.ahead.copy_from_slice(self.run.kept.ahead);
    }
}
