//! The discrete Lagrangian of Newmark's method,
//!
//! L_d(x0, x1) = (η1 − η0)·M(η1 − η0)/(2h) − (h/2)(Ṽ0 + Ṽ1)      η = x − βh² M⁻¹F      Ṽ = V + ½βh² F·M⁻¹F
//!
//! D₁L_d = −η0′ᵀM v0      D₂L_d = η1′ᵀM v1      η′ᵀ = 1 − βh² F′M⁻¹
//! v0 = (η1 − η0)/h − (h/2)M⁻¹F0      v1 = v0 + (h/2)M⁻¹(F0 + F1)
//! D₁D₂L_d = −[M − βh²(F0′ + F1′) + β²h⁴ F0′M⁻¹F1′]/h
//!
//! (Kane, Marsden, Ortiz & West 2000, section 3.2.) M v is the p of the method; the momentum that belongs to
//! x is η′ᵀp.

use super::Newmark;
use crate::discrete::{DiscreteLagrangian, Ends, Span};
use crate::error::{StartError, StepFailure};
use crate::mechanics::pattern::{full, linear_of_all};
use crate::methods::{InnerScheme, VariationalMethod, without_effect_inside};
use crate::space::SquareMatrix;
use crate::space::elimination::multiply_add;
use crate::space::sink::Sink;
use crate::state::Statistics;
use crate::{Linear, Matrix, Real, RegularLagrangian, Separable, Space, Square, System, Vector, Weights};

/// The discrete Lagrangian of [`Newmark`], with the storage that it needs: matrices with room for all
/// entries.
///
/// Its momentum at a point x is p − βh² F′(x)M⁻¹p, with the p of the method. Steps of
/// [`General`](crate::methods::General) are Newmark's from that momentum. Its second derivatives in one
/// point hold third derivatives of V and are not computed.
#[derive(Debug)]
pub struct NewmarkLagrangian<S: System, T: Real = f64> {
    beta: T,
    /// The factors of M.
    mass: Square<S, T>,
    ends: [End<S, T>; 2],
    work: [Vector<S, T>; 2],
}

/// What is known at one end of an interval.
#[derive(Debug)]
struct End<S: System, T: Real> {
    x: Vector<S, T>,
    v: Vector<S, T>,
    force: Vector<S, T>,
    /// F′, row-major.
    stiffness: Matrix<S, T>,
}

fn weights<T: Real>(qq: T, vv: T) -> Weights<T> {
    Weights { qq, qv: T::lift(0.0), vq: T::lift(0.0), vv }
}

impl<S: Separable<T>, T: Real> NewmarkLagrangian<S, T> {
    /// Evaluates everything but L_d.
    fn evaluate(&mut self, span: Span<'_, S, T>, statistics: &mut Statistics) -> Result<(), StepFailure> {
        let Span { system, interval, ends: Ends { q0, delta } } = span;
        let (zero, one, h) = (T::lift(0.0), T::lift(1.0), interval.h);
        let Self { beta, mass, ends: [start, end], work: [l_q, l_v] } = self;
        for i in 0..q0.len() {
            (start.x[i], end.x[i]) = (q0[i], q0[i] + delta[i]);
        }
        for (place, t) in [(&mut *start, interval.t), (&mut *end, interval.time(one))] {
            place.stiffness.fill(zero);
            let End { x, v, force, stiffness } = place;
            system.linearize(x, v, t, weights(one, zero), force, l_v, stiffness);
        }
        system.linearize(&start.x, &start.v, interval.t, weights(zero, one), l_q, l_v, mass.cleared());
        statistics.linearizations += 3;
        statistics.factorisations += 1;
        mass.factor()?;
        let half = T::lift(0.5) * h;
        for i in 0..q0.len() {
            l_q[i] = *beta * h * (end.force[i] - start.force[i]) + half * start.force[i];
            l_v[i] = half * (start.force[i] + end.force[i]);
        }
        mass.solve(l_q);
        mass.solve(l_v);
        for i in 0..q0.len() {
            start.v[i] = delta[i] / h - l_q[i];
            end.v[i] = start.v[i] + l_v[i];
        }
        Ok(())
    }

    /// Adds D₁L_d to `d1`.
    fn add_first(&mut self, span: Span<'_, S, T>, d1: &mut [T]) {
        let Self { beta, ends: [start, _], work: [l_q, l_v], .. } = self;
        let scale = *beta * span.interval.h * span.interval.h;
        span.system.gradient(&start.x, &start.v, span.interval.t, l_q, l_v);
        l_q.fill(T::lift(0.0));
        multiply_add(&start.stiffness, &start.v, l_q);
        for i in 0..d1.len() {
            d1[i] += scale * l_q[i] - l_v[i];
        }
    }
}

impl<S: Separable<T>, T: Real> DiscreteLagrangian<S, T> for NewmarkLagrangian<S, T> {
    fn solver(&self, system: &S, _q: &[T], _v: &[T], _t: T) -> Linear<S, T> {
        linear_of_all(system)
    }

    fn derivatives(
        &mut self,
        span: Span<'_, S, T>,
        d1: &mut [T],
        sum: &mut [T],
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        self.evaluate(span, statistics)?;
        self.add_first(span, d1);
        let Self { beta, ends: [start, end], work: [change, _], .. } = self;
        let h = span.interval.h;
        change.fill(T::lift(0.0));
        multiply_add(&end.stiffness, &end.v, change);
        change.iter_mut().for_each(|entry| *entry = -*entry);
        multiply_add(&start.stiffness, &start.v, change);
        for i in 0..sum.len() {
            sum[i] += T::lift(0.5) * h * (start.force[i] + end.force[i]) + *beta * h * h * change[i];
        }
        Ok(())
    }

    fn linearize<K: Sink<T>>(
        &mut self,
        span: Span<'_, S, T>,
        d1: &mut [T],
        sink: &mut K,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        self.evaluate(span, statistics)?;
        self.add_first(span, d1);
        let Span { system, interval, .. } = span;
        let Self { beta, mass, ends: [start, end], work: [column, product] } = self;
        let (zero, one, h) = (T::lift(0.0), T::lift(1.0), interval.h);
        let both = weights(*beta * h, -one / h);
        system.linearize(&start.x, &start.v, interval.t, both, product, column, sink);
        let second = weights(*beta * h, zero);
        system.linearize(&end.x, &end.v, interval.time(one), second, product, column, sink);
        let n = d1.len();
        for j in 0..n {
            for (i, entry) in column.iter_mut().enumerate() {
                *entry = end.stiffness[i * n + j];
            }
            mass.solve(column);
            product.fill(zero);
            multiply_add(&start.stiffness, column, product);
            for (i, &entry) in product.iter().enumerate() {
                sink.add(i, j, -(*beta * *beta * h * h * h) * entry);
            }
        }
        Ok(())
    }
}

impl<S: Separable<T> + RegularLagrangian<T>, T: Real> VariationalMethod<S, T> for Newmark<T> {
    type DiscreteLagrangian = NewmarkLagrangian<S, T>;

    fn admit(&self, _system: &S) -> Result<(), StartError> {
        if S::FORCED {
            let reason =
                "forces act on the system, and are no part of it: take `Newmark` itself, which has them";
            return Err(StartError::Unsupported { option: "the discrete Lagrangian of `Newmark`", reason });
        }
        self.validate()
    }

    fn discrete_lagrangian(&self, system: &S) -> NewmarkLagrangian<S, T> {
        let space = system.space();
        let end = || End {
            x: space.vector(),
            v: space.vector(),
            force: space.vector(),
            stiffness: space.matrix(),
        };
        NewmarkLagrangian {
            beta: self.beta,
            mass: full(system),
            ends: [end(), end()],
            work: [space.vector(), space.vector()],
        }
    }
}

impl<S: Separable<T> + RegularLagrangian<T>, T: Real> InnerScheme<S, T> for Newmark<T> {
    fn admit_inside(&self) -> Result<(), StartError> {
        without_effect_inside(self.solver, self.stopping, self.summation)
    }
}
