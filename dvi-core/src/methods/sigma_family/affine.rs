//! The fixed point of affine α, a fast path: s ← −(1−σ)h K⁻¹∇H(q0 + σK⁻¹c0 + σs), with ∇H in place of the
//! derivatives of L_d. A step of the midpoint rule on four vortices takes 1390 instructions.

use super::Step;
use super::memory::{Carried, Work};
use crate::error::StepFailure;
use crate::mechanics::combination::Inverse;
use crate::scalar::norm;
use crate::scalar::simd::{apart_if, widest_if};
use crate::solve::{Convergence, Course, Due, Iteration, Judge, Quick, repeat, sizes};
use crate::space::scratch;
use crate::state::Statistics;
use crate::state::summation::Summation;
use crate::{DegenerateLagrangian, Real, Space, Vector};

/// Sets `work.increment` to s, and the gradient of the node to ∇H(q_σ).
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn fixed_point<S: DegenerateLagrangian<T>, T: Real>(
    step: &Step<'_, S, T>,
    q: &Vector<S, T>,
    carried: &mut Carried<S, T>,
    budget: usize,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    if step.method.summation == Summation::Compensated {
        return compensated(step, q, carried, budget, statistics);
    }
    let quick = Quick::of(Course::fixed_point(step.method.stopping, budget));
    let result = widest_if(
        !<S::Space as Space>::ON_STACK,
        #[cfg_attr(not(debug_assertions), inline(always))]
        || iterate::<false, S, T>(step, q, carried, quick, statistics),
    );
    match result {
        Err(StepFailure::NotConverged { .. }) => carefully(step, q, carried, budget, statistics),
        result => result,
    }
}

/// The same where the quick look has given up.
#[cold]
#[inline(never)]
fn carefully<S: DegenerateLagrangian<T>, T: Real>(
    step: &Step<'_, S, T>,
    q: &Vector<S, T>,
    carried: &mut Carried<S, T>,
    budget: usize,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    let convergence = Convergence::fixed_point(step.method.stopping, budget);
    iterate::<false, S, T>(step, q, carried, convergence, statistics)
}

/// The same from what rounding has left out of q0 too, until nothing is left to gain.
#[inline(never)]
fn compensated<S: DegenerateLagrangian<T>, T: Real>(
    step: &Step<'_, S, T>,
    q: &Vector<S, T>,
    carried: &mut Carried<S, T>,
    budget: usize,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    let convergence = Convergence::fixed_point(step.method.stopping.exhaustive(), budget);
    iterate::<true, S, T>(step, q, carried, convergence, statistics)
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn iterate<const COMPENSATED: bool, S: DegenerateLagrangian<T>, T: Real>(
    step: &Step<'_, S, T>,
    q: &Vector<S, T>,
    carried: &mut Carried<S, T>,
    convergence: impl Judge<T>,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    let Carried { defect_vanishes, history, inverse, l_d, rest, work, .. } = carried;
    let Work { increment: s, shift, next, .. } = work;
    let (node, sigma) = (&mut l_d.work, step.method.sigma);
    scratch!(increment = step.system, node.velocity);
    scratch!(trial = step.system, work.trial);
    scratch!(weights = step.system, work.weights);
    scratch!(point = step.system, node.point);
    scratch!(gradient = step.system, node.momentum);
    history.extrapolate(increment);
    let has_shift = !*defect_vanishes;
    // Where the iteration would be without s; with compensated sums in two parts, of which the small one is
    // added to σs first.
    let (origin, apart): (&[T], &[T]) = if COMPENSATED {
        for (i, (apart, &shift)) in next.iter_mut().zip(shift.iter()).enumerate() {
            let left_out = rest.left_out_of(i);
            *apart = if has_shift { sigma * shift + left_out } else { left_out };
        }
        (q, next)
    } else if has_shift {
        for ((next, &q), &shift) in next.iter_mut().zip(q.iter()).zip(shift.iter()) {
            *next = q + sigma * shift;
        }
        (next, &[])
    } else {
        (q, &[])
    };
    let part = |k: usize, near: T| if COMPENSATED { near + apart[k] } else { near };
    let nodes = Nodes { step, inverse, q, origin, part, increment, trial, weights, point, gradient };
    repeat(convergence, statistics, nodes)?;
    s.copy_from_slice(increment);
    node.gradient.copy_from_slice(gradient);
    norm::finite(increment)
}

/// The nodes q_σ as they are iterated. Long vectors are passed over once: each block of the next node is
/// placed as soon as its s is known.
struct Nodes<'a, S: DegenerateLagrangian<T>, T: Real, P> {
    step: &'a Step<'a, S, T>,
    inverse: &'a Inverse<S, T>,
    q: &'a [T],
    origin: &'a [T],
    /// What is added to `origin`, of its place and σs.
    part: P,
    increment: &'a mut [T],
    trial: &'a mut [T],
    weights: &'a mut [T],
    point: &'a mut [T],
    gradient: &'a mut [T],
}

impl<S: DegenerateLagrangian<T>, T: Real, P: Fn(usize, T) -> T> Nodes<'_, S, T, P> {
    const IS_LONG: bool = !<S::Space as Space>::ON_STACK;
}

impl<S: DegenerateLagrangian<T>, T: Real, P: Fn(usize, T) -> T> Iteration<T> for Nodes<'_, S, T, P> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn prepare(&mut self, due: &mut Due) {
        due.prepare(self.step.system, self.weights, self.q, self.increment);
        if Self::IS_LONG {
            place([self.origin, self.increment], self.step.method.sigma, (0, &self.part), self.point);
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn improve(&mut self, _due: &mut Due, _statistics: &mut Statistics) -> Result<T, StepFailure> {
        let Self { step, inverse, origin, part, increment, trial, weights, point, gradient, .. } = self;
        let (system, sigma, time) = (step.system, step.method.sigma, step.node_time());
        if !Self::IS_LONG {
            place([origin, increment], sigma, (0, &*part), point);
        }
        apart_if(
            Self::IS_LONG,
            #[cfg_attr(not(debug_assertions), inline(always))]
            || system.hamiltonian_gradient(point, time, gradient),
        );
        let mut largest = T::lift(0.0);
        inverse.solve_in_blocks(
            system,
            gradient,
            trial,
            #[cfg_attr(not(debug_assertions), inline(always))]
            |block, s| {
                let (origin, increment) = (&origin[block.clone()], &mut increment[block.clone()]);
                largest = norm::larger(largest, sizes::renew(&weights[block.clone()], increment, s));
                if Self::IS_LONG {
                    place([origin, increment], sigma, (block.start, &*part), &mut point[block]);
                }
            },
        );
        Ok(largest)
    }

    fn count(&self, times: u64, statistics: &mut Statistics) {
        statistics.gradients += times;
    }
}

/// Sets `point`, which begins with coordinate `first`, to `origin` + σs, in which σs is what `part` makes of
/// it.
#[cfg_attr(not(debug_assertions), inline(always))]
fn place<T: Real>(
    [origin, s]: [&[T]; 2],
    sigma: T,
    (first, part): (usize, impl Fn(usize, T) -> T),
    point: &mut [T],
) {
    for (k, ((point, &origin), &s)) in (first..).zip(point.iter_mut().zip(origin).zip(s)) {
        *point = origin + part(k, sigma * s);
    }
}
