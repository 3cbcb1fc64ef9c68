//! The fixed point of affine α, a fast path: s ← −(1−σ)h K⁻¹∇H(q0 + σK⁻¹c0 + σs), with ∇H in place of the
//! derivatives of L_d. A step of the midpoint rule on four vortices takes 1396 instructions and 113 ns, and
//! with the derivatives 2635 and 161 ns (`cargo bench -p dvi-kernels --bench instructions`, with this path
//! and without).

use super::Step;
use super::memory::{Carried, Work};
use crate::error::StepFailure;
use crate::mechanics::combination::Inverse;
use crate::scalar::norm;
use crate::scalar::simd::{apart_if, wide_if};
use crate::solve::{Convergence, Course, Due, Iteration, Judge, Quick, repeat, sizes};
use crate::space::scratch;
use crate::state::Statistics;
use crate::state::summation::Summation;
use crate::{DegenerateLagrangian, Real, Space, Vector};

/// Sets `work.increment` to s, and the gradient of the node to ∇H(q_σ).
#[inline]
pub(super) fn fixed_point<S: DegenerateLagrangian<T>, T: Real>(
    step: &Step<'_, S, T>,
    q: &Vector<S, T>,
    carried: &mut Carried<S, T>,
    budget: usize,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    if step.method.summation == Summation::Compensated {
        return carefully::<true, S, T>(step, q, carried, budget, statistics);
    }
    let quick = Quick::of(Course::fixed_point(step.method.stopping, budget));
    let result = wide_if!(
        !<S::Space as Space>::ON_STACK,
        iterate::<false, S, T>(step, q, carried, quick, statistics)
    );
    match result {
        Err(StepFailure::NotConverged { .. }) => {
            carefully::<false, S, T>(step, q, carried, budget, statistics)
        }
        result => result,
    }
}

/// The same where the quick look has given up; or from what rounding has left out of q0 too, with what it
/// leaves out of s in `work.sum`.
#[inline(never)]
fn carefully<const COMPENSATED: bool, S: DegenerateLagrangian<T>, T: Real>(
    step: &Step<'_, S, T>,
    q: &Vector<S, T>,
    carried: &mut Carried<S, T>,
    budget: usize,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    let convergence = Convergence::fixed_point(step.method.stopping, budget);
    iterate::<COMPENSATED, S, T>(step, q, carried, convergence, statistics)
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
    let Work { increment: s, shift, next, sum: left_out, .. } = work;
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
    let mut nodes = Nodes::<COMPENSATED, _, _, _> {
        step,
        inverse,
        q,
        origin,
        part,
        increment,
        trial,
        weights,
        point,
        gradient,
    };
    repeat(convergence, statistics, &mut nodes)?;
    node.gradient.copy_from_slice(nodes.gradient);
    if COMPENSATED {
        statistics.gradients += nodes.refine(left_out);
    }
    s.copy_from_slice(increment);
    norm::finite(s)
}

/// The nodes q_σ as they are iterated. Long vectors are passed over once: each block of the next node is
/// placed as soon as its s is known.
struct Nodes<'a, const COMPENSATED: bool, S: DegenerateLagrangian<T>, T: Real, P> {
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

/// By so many times its rounding error a node is moved for a difference quotient.
const MAGNIFIED: f64 = 4096.0;

impl<const COMPENSATED: bool, S, T: Real, P: Fn(usize, T) -> T> Nodes<'_, COMPENSATED, S, T, P>
where
    S: DegenerateLagrangian<T>,
{
    const IS_LONG: bool = !COMPENSATED && !<S::Space as Space>::ON_STACK;

    /// Sets s to that of the number next to q_σ, and `left_out` to what it lacks since the node of its
    /// gradient is that number. Near the middle of two numbers either of them has an s that leads back to
    /// it, and which of them an iteration finds depends on the side that it comes from, the same in all
    /// steps. Returns how many gradients that takes: three where the iteration has found the other, or one.
    fn refine(&mut self, left_out: &mut [T]) -> u64 {
        self.set_left_out(left_out);
        let Self { step, inverse, q, part, increment: s, trial, weights: node, point, gradient, .. } = self;
        let sigma = step.method.sigma;
        let mut is_next = true;
        for (k, (point, &node)) in point.iter_mut().zip(node.iter()).enumerate() {
            *point = q[k] + (sigma * s[k] + part(k, sigma * left_out[k]));
            is_next &= *point == node;
        }
        if is_next {
            return 1;
        }
        step.system.hamiltonian_gradient(point, step.node_time(), gradient);
        inverse.solve(step.system, gradient, trial);
        s.copy_from_slice(trial);
        self.set_left_out(left_out);
        3
    }

    /// Sets `left_out` to what s lacks, from the difference quotient of ∇H to a point on the line from the
    /// node to q_σ, and `weights` to the node.
    fn set_left_out(&mut self, left_out: &mut [T]) {
        let Self { step, inverse, q, part, increment: s, trial, weights: node, point, gradient, .. } = self;
        node.copy_from_slice(point);
        for (k, (point, &s)) in point.iter_mut().zip(s.iter()).enumerate() {
            let error = (q[k] - *point) + part(k, step.method.sigma * s);
            *point += T::lift(MAGNIFIED) * error;
        }
        step.system.hamiltonian_gradient(point, step.node_time(), gradient);
        inverse.solve(step.system, gradient, trial);
        for ((left_out, &moved), &s) in left_out.iter_mut().zip(trial.iter()).zip(s.iter()) {
            *left_out = (moved - s) / T::lift(MAGNIFIED);
        }
    }
}

impl<const COMPENSATED: bool, S, T: Real, P: Fn(usize, T) -> T> Iteration<T>
    for &mut Nodes<'_, COMPENSATED, S, T, P>
where
    S: DegenerateLagrangian<T>,
{
    #[inline]
    fn prepare(&mut self, due: &mut Due) {
        due.prepare(self.step.system, self.weights, self.q, self.increment);
        if Nodes::<COMPENSATED, S, T, P>::IS_LONG {
            place([self.origin, self.increment], self.step.method.sigma, (0, &self.part), self.point);
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn improve(&mut self, _due: &mut Due, _statistics: &mut Statistics) -> Result<T, StepFailure> {
        let Nodes { step, inverse, origin, part, increment, trial, weights, point, gradient, .. } =
            &mut **self;
        let (system, sigma, time) = (step.system, step.method.sigma, step.node_time());
        if !Nodes::<COMPENSATED, S, T, P>::IS_LONG {
            place([origin, increment], sigma, (0, &*part), point);
        }
        apart_if(Nodes::<COMPENSATED, S, T, P>::IS_LONG, || {
            system.hamiltonian_gradient(point, time, gradient);
        });
        let mut largest = T::lift(0.0);
        inverse.solve_in_blocks(
            system,
            gradient,
            trial,
            #[cfg_attr(not(debug_assertions), inline(always))]
            |block, s| {
                let (origin, increment) = (&origin[block.clone()], &mut increment[block.clone()]);
                largest = norm::larger(
                    largest,
                    sizes::improve(&weights[block.clone()], increment, s, sizes::replaced),
                );
                if Nodes::<COMPENSATED, S, T, P>::IS_LONG {
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
#[inline]
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
