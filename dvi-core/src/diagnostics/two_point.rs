//! The exact derivative of the two-step map (q0, q1) ↦ (q1, q2), and the two-form that it preserves.
//!
//! Differentiating D₂L_d(q0, q1) + D₁L_d(q1, q2) = 0:
//!
//! δq2 = −(D₁D₂L_d(q1, q2))⁻¹ [D₂D₁L_d(q0, q1) δq0 + (D₂D₂L_d(q0, q1) + D₁D₁L_d(q1, q2)) δq1]
//!
//! The map preserves Ω_d = ∂²L_d/∂q0ⁱ∂q1ʲ dq0ⁱ ∧ dq1ʲ (Rowley & Marsden 2002, eq. 17).

use super::DiscreteHessian;
use crate::discrete::{Interval, TwiceDifferentiable};
use crate::error::StepFailure;
use crate::methods::VariationalMethod;
use crate::space::elimination::{self, multiply_add};
#[cfg(feature = "alloc")]
use crate::space::lines;
use crate::{Lagrangian, Matrix, Permutation, Real, Space, System, Vector};

/// The tangent map (δq0, δq1) ↦ (δq1, δq2) of one step of the discrete Lagrangian `L`.
///
/// ```
#[doc = include_str!("../../docs/hidden/vortices.txt")]
/// use dvi_core::discrete::Interval;
///
/// let mut run = Integrator::new(&Vortices, Sigma::midpoint(), 0.1, start)?;
/// let mut points = vec![run.q().to_vec()];
/// for _ in 0..2 {
///     run.advance()?;
///     points.push(run.q().to_vec());
/// }
/// let mut map = TwoPointTangentMap::new(&Vortices, run.method());
/// map.evaluate(&Vortices, Interval { t: 0.0, h: 0.1 }, [&points[0], &points[1], &points[2]])?;
/// assert!(map.two_form_defect(&Vortices) < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct TwoPointTangentMap<S: System, L, T: Real = f64> {
    before: DiscreteHessian<S, L, T>,
    after: DiscreteHessian<S, L, T>,
    factors: Matrix<S, T>,
    permutation: Permutation<S>,
    next: Vector<S, T>,
}

impl<S: Lagrangian<T>, L: TwiceDifferentiable<S, T>, T: Real> TwoPointTangentMap<S, L, T> {
    /// Storage for steps of `method` on `system`; the map is that of the points given to
    /// [`evaluate`](Self::evaluate).
    pub fn new(system: &S, method: &impl VariationalMethod<S, T, DiscreteLagrangian = L>) -> Self {
        let space = system.space();
        Self {
            before: DiscreteHessian::new(system, method),
            after: DiscreteHessian::new(system, method),
            factors: space.matrix(),
            permutation: space.permutation(),
            next: space.vector(),
        }
    }

    /// Linearizes the step from (q0, q1) to (q1, q2); `points` are the three, and `interval` is that from q0
    /// to q1.
    ///
    /// # Errors
    /// [`StepFailure::Singular`] where D₁D₂L_d(q1, q2) is singular, or those of the discrete Lagrangian.
    pub fn evaluate(
        &mut self,
        system: &S,
        interval: Interval<T>,
        points: [&[T]; 3],
    ) -> Result<(), StepFailure> {
        let [q0, q1, q2] = points;
        self.before.evaluate(system, interval, q0, q1)?;
        let next = Interval { t: interval.t + interval.h, ..interval };
        self.after.evaluate(system, next, q1, q2)?;
        self.factors.copy_from_slice(&self.after.d12);
        elimination::factor(&mut self.factors, &mut self.permutation)
    }

    /// Maps (δq0, δq1), in place, to (δq1, δq2).
    pub fn apply(&mut self, dq0: &mut Vector<S, T>, dq1: &mut Vector<S, T>) {
        let next = &mut self.next;
        next.fill(T::lift(0.0));
        multiply_add(&self.before.d21, dq0, next);
        multiply_add(&self.before.d22, dq1, next);
        multiply_add(&self.after.d11, dq1, next);
        elimination::solve(&self.factors, &self.permutation, next);
        dq0.copy_from_slice(dq1);
        for (dq1, &next) in dq1.iter_mut().zip(next.iter()) {
            *dq1 = -next;
        }
    }

    /// max |AᵀΩ₁A − Ω₀| for the matrix A of the map, Ω₀ at (q0, q1) and Ω₁ at (q1, q2): zero up to
    /// rounding, unless forces act.
    #[cfg(feature = "alloc")]
    pub fn two_form_defect(&mut self, system: &S) -> T {
        let n = system.space().dimension();
        let unit = |a: usize| {
            let mut pair: [Vector<S, T>; 2] = [system.space().vector(), system.space().vector()];
            pair[a / n][a % n] = T::lift(1.0);
            pair
        };
        let images: alloc::vec::Vec<_> = (0..2 * n)
            .map(|a| {
                let mut image = unit(a);
                let [dq0, dq1] = &mut image;
                self.apply(dq0, dq1);
                image
            })
            .collect();
        let mut defect = T::lift(0.0);
        for a in 0..2 * n {
            for b in 0..2 * n {
                let pulled_back = pairing(&self.after.d12, &images[a], &images[b]);
                let original = pairing(&self.before.d12, &unit(a), &unit(b));
                defect = defect.max(crate::Scalar::abs(pulled_back - original));
            }
        }
        defect
    }
}

/// Ω(u, w) = u₀ᵀ D w₁ − w₀ᵀ D u₁.
#[cfg(feature = "alloc")]
fn pairing<T: Real, V: core::ops::Deref<Target = [T]>>(d: &[T], u: &[V; 2], w: &[V; 2]) -> T {
    let n = u[0].len();
    let form = |x: &[T], y: &[T]| {
        let rows = x.iter().zip(lines(d, n));
        rows.fold(T::lift(0.0), |sum, (&x, row)| {
            row.iter().zip(y).fold(sum, |sum, (&d, &y)| sum + x * d * y)
        })
    };
    form(&u[0], &w[1]) - form(&w[0], &u[1])
}
