//! σ = 0 with affine α in a symmetric gauge, such as ½(x dy − y dx): the leapfrog scheme as it is usually
//! written, explicit, one ∇H a step (Rowley & Marsden 2002, eq. 13).
//!
//! q1 = (q0 + K⁻¹c0) + s   with K = −(Dα)ᵀ, s = −hK⁻¹∇H(q0),   and c1 = −DαΔ,  Δ = q1 − q0.
//!
//! As Dα is antisymmetric there, q0 + K⁻¹c0 is the point before. Over many steps the points are local
//! arrays, which the compiler can keep in registers, and c, which no step needs, is computed at the end.
//!
//! A fast path: a step of four vortices takes 125 instructions and 15 ns, and by the step of all σ 547 and
//! 30 ns (`cargo bench -p dvi-kernels --bench instructions`, with this path and without).

use super::memory::{Carried, Leaps, SigmaMemory};
use super::parasitic_mode::Monitor;
use crate::error::StepFailure;
use crate::mechanics::combination::{Inverse, Product};
use crate::methods::Clock;
use crate::methods::walk::{Walk, walk};
use crate::scalar::norm;
use crate::space::scratch;
use crate::state::Statistics;
use crate::{DegenerateLagrangian, Real, System, Vector};

/// Takes `count` leaps, or as many as succeed, and returns how many; `q`, and what the run carries, are then
/// at the last good point. `None` if steps are no leaps.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn steps<S: DegenerateLagrangian<T>, T: Real>(
    system: &S,
    SigmaMemory { carried, monitor, .. }: &mut SigmaMemory<S, T>,
    q: &mut Vector<S, T>,
    (clock, count): (Clock<T>, u64),
    statistics: &mut Statistics,
) -> Option<(u64, Result<(), StepFailure>)> {
    let Carried { defect, inverse, leaps, l_d, work, .. } = carried;
    let Leaps { product, before } = leaps.as_mut()?;
    let (node, from) = (&mut l_d.work, monitor.steps);
    scratch!(q1 = system, work.next);
    scratch!(q0 = system, node.velocity);
    scratch!(gradient = system, node.gradient);
    scratch!(next = system, work.increment);
    q1.copy_from_slice(q);
    q0.copy_from_slice(before);
    let kept = Kept { q, before, defect, spare: &mut node.momentum };
    let leapfrog =
        Leapfrog { system, inverse, product, monitor: &mut *monitor, clock, kept, q0, q1, gradient, next };
    let (taken, result) = walk(leapfrog, from, count);
    monitor.steps = from + taken;
    statistics.gradients += taken;
    Some((taken, result))
}

/// The last good point, with the point before and the defect there, and storage for a point.
struct Kept<'a, S: System, T: Real> {
    q: &'a mut Vector<S, T>,
    before: &'a mut Vector<S, T>,
    defect: &'a mut Vector<S, T>,
    spare: &'a mut Vector<S, T>,
}

/// The last two points, as the steps move them.
struct Leapfrog<'a, 'b, S: System, T: Real> {
    system: &'a S,
    inverse: &'a Inverse<S, T>,
    product: &'a Product<S, T>,
    monitor: &'a mut Monitor<S, T>,
    clock: Clock<T>,
    kept: Kept<'a, S, T>,
    q0: &'b mut [T],
    q1: &'b mut [T],
    gradient: &'b mut [T],
    next: &'b mut [T],
}

impl<S: DegenerateLagrangian<T>, T: Real> Walk for Leapfrog<'_, '_, S, T> {
    const WATCHED: u64 = 4;
    const ADMITS: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn step(&mut self, number: u64) {
        let Self { system, inverse, clock, q0, q1, gradient, next, .. } = self;
        system.hamiltonian_gradient(q1, clock.after(number).time(), gradient);
        inverse.solve(system, gradient, next);
        for ((q0, q1), &s) in q0.iter_mut().zip(q1.iter_mut()).zip(next.iter()) {
            (*q0, *q1) = (*q1, *q0 + s);
        }
    }

    #[inline]
    fn block(&self) -> u64 {
        self.monitor.period
    }

    #[inline]
    fn watch(&mut self, number: u64) {
        self.monitor.note(self.monitor.steps + number, self.q1);
    }

    #[inline]
    fn admit(&mut self, number: u64) -> Result<(), StepFailure> {
        self.monitor.examine(self.monitor.steps + number, self.kept.q)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn examine(&mut self, steps: u64) -> Result<(), StepFailure> {
        // Copies: what is examined must live in memory.
        scratch!(examined = self.system, *self.kept.spare);
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
        let Self { system, product, kept: Kept { q, before, defect, .. }, q0, q1, next: delta, .. } = self;
        q.copy_from_slice(q1);
        before.copy_from_slice(q0);
        for (delta, (&q1, &q0)) in delta.iter_mut().zip(q1.iter().zip(q0.iter())) {
            *delta = q1 - q0;
        }
        product.apply(system, delta, defect);
    }

    #[inline]
    fn go_back(&mut self) {
        self.q1.copy_from_slice(self.kept.q);
        self.q0.copy_from_slice(self.kept.before);
    }
}
