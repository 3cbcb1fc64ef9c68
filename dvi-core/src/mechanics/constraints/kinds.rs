//! How the two kinds of constraints enter the equations.
//!
//! Of positions, g(q, t) = 0: at the end of a step g(q1, t1) = 0, of velocities G v + ∂g/∂t = 0, with G =
//! ∂g/∂q. Of velocities, a(q, v, t) = A(q, t) v + b(q, t) = 0: of a step h a = 0 at its middle, with the
//! velocity Δ/h (Cortés & Martínez 2001).

use super::Constraints;
use crate::mechanics::Span;
use crate::scalar::passes::{add, multiply, negate};
use crate::space::Sink;
use crate::system::{Holonomic, Nonholonomic};
use crate::{HolonomicLagrangian, NonholonomicLagrangian, Real};

impl<S: HolonomicLagrangian<T>, T: Real> Constraints<S, T> for Holonomic {
    type Suited<M> = M;

    const OF_POSITIONS: bool = true;

    fn forces<K: Sink<T>>(system: &S, q: &[T], t: T, out: &mut [T], sink: &mut K) {
        system.constraint_jacobian(q, t, out, sink);
    }
    fn of_step<K: Sink<T>>(
        system: &S,
        Span { interval, q0, delta, .. }: Span<'_, S, T>,
        [point, _]: [&mut [T]; 2],
        out: &mut [T],
        sink: &mut K,
    ) {
        add(q0, delta, point);
        system.constraint_jacobian(point, interval.time(T::lift(1.0)), out, sink);
    }
    fn of_velocity<K: Sink<T>>(system: &S, q: &[T], v: &[T], t: T, out: &mut [T], sink: &mut K) {
        system.constraint_jacobian(q, t, out, sink);
        system.constraint_rate(q, v, t, out);
    }
    fn of_acceleration<K: Sink<T>>(system: &S, q: &[T], v: &[T], t: T, out: &mut [T], sink: &mut K) {
        system.constraint_jacobian(q, t, out, sink);
        system.constraint_curvature(q, v, t, out);
        negate(out);
    }
}

impl<S: NonholonomicLagrangian<T>, T: Real> Constraints<S, T> for Nonholonomic {
    type Suited<M> = M;

    const OF_POSITIONS: bool = false;

    fn forces<K: Sink<T>>(system: &S, q: &[T], t: T, out: &mut [T], sink: &mut K) {
        // A does not depend on the velocity.
        system.velocity_constraint_jacobian(q, q, t, [T::lift(0.0), T::lift(1.0)], out, sink);
    }
    fn of_step<K: Sink<T>>(
        system: &S,
        Span { interval, q0, delta, .. }: Span<'_, S, T>,
        [point, velocity]: [&mut [T]; 2],
        out: &mut [T],
        sink: &mut K,
    ) {
        let (half, h) = (T::lift(0.5), interval.h);
        for i in 0..q0.len() {
            point[i] = q0[i] + half * delta[i];
            velocity[i] = delta[i] / h;
        }
        let (t, weights) = (interval.time(half), [half * h, T::lift(1.0)]);
        system.velocity_constraint_jacobian(point, velocity, t, weights, out, sink);
        multiply(out, h);
    }
    fn of_velocity<K: Sink<T>>(system: &S, q: &[T], v: &[T], t: T, out: &mut [T], sink: &mut K) {
        system.velocity_constraint_jacobian(q, v, t, [T::lift(0.0), T::lift(1.0)], out, sink);
    }
    fn of_acceleration<K: Sink<T>>(system: &S, q: &[T], v: &[T], t: T, out: &mut [T], sink: &mut K) {
        system.velocity_constraint_jacobian(q, v, t, [T::lift(0.0), T::lift(1.0)], out, sink);
        system.velocity_constraint_rate(q, v, t, out);
        negate(out);
    }
}
