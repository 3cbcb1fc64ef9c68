//! g(q, t) = 0: at the end of a step g(q1, t1) = 0, of velocities G v + ∂g/∂t = 0, with G = ∂g/∂q.

use super::Constraints;
use crate::mechanics::Span;
use crate::scalar::passes::negate;
use crate::space::Sink;
use crate::system::Holonomic;
use crate::{HolonomicLagrangian, Real};

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
        for ((point, &q), &delta) in point.iter_mut().zip(q0).zip(delta) {
            *point = q + delta;
        }
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
