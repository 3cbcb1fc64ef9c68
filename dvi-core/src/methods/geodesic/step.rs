//! One step along a geodesic: p0 = −D₁L_d for the displacement, and what it leads to.
//!
//! Where L = ½ v·M v − V(q, t) and the nodes of the rule are at the two ends, the step is a kick, a drift
//! along a geodesic, a kick,
//!
//! p½ = p0 + h w0 f0      p½ = −D₁K_d for the displacement      p1 = D₂K_d + h w1 f1
//!
//! with the forces f as p is, the torque in the body of a rotation and s × ∂L/∂s of a unit vector, and K_d
//! the discrete Lagrangian of ½ v·M v. It is the general step, because there the forces of the first end do
//! not depend on the displacement, and those of the last do no work where the last point is held. It
//! evaluates one force. Where M is a mass of each block alone, the drift is free: its displacement is
//! h p½/m, and p½ stays what it is.

use super::covectors::{force, increment_of, velocity};
use super::equations::{Begin, nodes};
use super::memory::{Arrival, GeodesicMemory, Kicks};
use crate::discrete::Interval;
use crate::discrete::quadrature::Rule;
use crate::error::StepFailure;
use crate::mechanics::manifold::{self, blocks, vector};
use crate::scalar::norm::{self, reported};
use crate::scalar::passes::{divide, kick, multiply};
use crate::solve::{Stopping, from_either_guess};
use crate::space::SquareMatrix;
use crate::state::Statistics;
use crate::system::Factor;
use crate::{ManifoldLagrangian, Real};

/// The weights h w of the two ends.
#[inline]
fn impulses<R: Rule, T: Real>(rule: &R, h: T) -> [T; 2] {
    nodes(rule, h).fold([T::lift(0.0); 2], |[first, last], [c, weight]| {
        if c == T::lift(0.0) { [first + weight, last] } else { [first, last + weight] }
    })
}

impl<S: ManifoldLagrangian<T>, T: Real> GeodesicMemory<S, T> {
    /// Finds the end of a step from time t, of length h.
    #[inline]
    pub(super) fn solve<R: Rule>(
        &mut self,
        rule: &R,
        (system, q): (&S, &[T]),
        interval: Interval<T>,
        stopping: Stopping,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Self { p, rates, lifted, carried, kicks, orientation, is_positive, p0, tangents, arrival } =
            self;
        let (h, end) = (interval.h, interval.time(T::lift(1.0)));
        let [first, last] = impulses(rule, h);
        p0.copy_from_slice(p);
        if let Some(Kicks { force, .. }) = kicks {
            kick(p0, first, force);
        }
        let mass = kicks.as_ref().map(|kicks| &kicks.mass);
        let free = kicks.as_ref().and_then(|kicks| kicks.free.as_ref());
        let begin = Begin { system, rule, interval, q, p: p0, mass };
        if let Some(inverses) = free {
            for ((u, &inverse), &p) in arrival.displacement.iter_mut().zip(inverses.iter()).zip(p0.iter()) {
                *u = h * (inverse * p);
            }
            check(system, &arrival.displacement)?;
        } else {
            from_either_guess(|guess| {
                let displacement = &mut arrival.displacement;
                rates.guess(h, guess, [&mut *displacement]);
                multiply(displacement, h);
                tangents.solve(&begin, system, displacement, stopping, statistics)?;
                check(system, displacement)
            })?;
            // The determinant of the equations has the sign of that of a short step.
            let is_odd = h < T::lift(0.0) && tangents.residual.len() % 2 == 1;
            if tangents.matrix.is_positive() != (*is_positive ^ is_odd) {
                return Err(StepFailure::Branch);
            }
        }
        let Arrival { displacement, increment, lifted: next, q: q1, v, p: p1, force: f1 } = arrival;
        for block in blocks(system) {
            increment_of(block, begin.path(displacement), lifted, increment);
        }
        carried.add(lifted, increment, next);
        manifold::lower(system, next, q1);
        if free.is_some() {
            p1.copy_from_slice(p0);
        } else {
            begin.balance(displacement, tangents, p1, statistics);
        }
        if kicks.is_some() {
            system.force(q1, &[], end, f1);
            force(system, q1, f1);
            statistics.gradients += 1;
            kick(p1, last, f1);
        }
        norm::finite(q1).and(norm::finite(p1))?;
        divide(displacement, h);
        if let Some(orientation) = orientation {
            v.copy_from_slice(displacement);
            velocity(system, q1, v);
            orientation.check(system, &mut tangents.node, [q1, v], end)?;
        }
        Ok(())
    }

    /// Moves to the end of the step.
    #[inline]
    pub(super) fn keep(&mut self, q: &mut [T], h: T) {
        let Self { p, rates, lifted, carried, kicks, arrival, .. } = self;
        if let Some(Kicks { force, .. }) = kicks {
            force.copy_from_slice(&arrival.force);
        }
        carried.advance(lifted, &arrival.increment, &arrival.lifted);
        q.copy_from_slice(&arrival.q);
        p.copy_from_slice(&arrival.p);
        rates.push(h, [&arrival.displacement]);
    }
}

/// Beyond half a turn a geodesic is not the shortest way.
#[inline]
fn check<S: ManifoldLagrangian<T>, T: Real>(system: &S, displacement: &[T]) -> Result<(), StepFailure> {
    let half = T::lift(core::f64::consts::PI);
    for block in blocks(system).filter(|block| block.factor != Factor::Line) {
        let angle = vector(displacement, block).norm();
        // That an angle is a number was seen where it was solved for.
        if angle >= half {
            let (block, index, angle) = (block.name, block.index, reported(angle));
            return Err(StepFailure::HalfTurn { block, index, angle });
        }
    }
    Ok(())
}
