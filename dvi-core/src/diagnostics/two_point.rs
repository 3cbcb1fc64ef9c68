//! The exact derivative of the two-step map (q0, q1) ↦ (q1, q2), and the two-form that it preserves.
//!
//! It is that of the step from q1 in (q, p), with p1 = D₂L_d(q0, q1):
//!
//! δp1 = D₂D₁L_d(q0, q1) δq0 + D₂D₂L_d(q0, q1) δq1
//!
//! The map preserves Ω_d = ∂²L_d/∂q0ⁱ∂q1ʲ dq0ⁱ ∧ dq1ʲ (Rowley & Marsden 2002, eq. 17).

#[cfg(feature = "alloc")]
use super::tangent::{defect, images};
use super::{DiscreteHessian, TangentMap};
use crate::discrete::{Interval, TwiceDifferentiable};
use crate::error::StepFailure;
use crate::methods::VariationalMethod;
use crate::space::elimination::multiply_add;
#[cfg(feature = "alloc")]
use crate::space::lines;
use crate::{Lagrangian, Real, Space, System, Vector};

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
    after: TangentMap<S, L, T>,
    dp: Vector<S, T>,
}

impl<S: Lagrangian<T>, L: TwiceDifferentiable<S, T>, T: Real> TwoPointTangentMap<S, L, T> {
    /// Storage for steps of `method` on `system`; the map is that of the points given to
    /// [`evaluate`](Self::evaluate).
    pub fn new(system: &S, method: &impl VariationalMethod<S, T, DiscreteLagrangian = L>) -> Self {
        Self {
            before: DiscreteHessian::new(system, method),
            after: TangentMap::new(system, method),
            dp: system.space().vector(),
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
        self.after.evaluate(system, Interval { t: interval.t + interval.h, ..interval }, q1, q2)
    }

    /// Maps (δq0, δq1), in place, to (δq1, δq2).
    pub fn apply(&mut self, dq0: &mut Vector<S, T>, dq1: &mut Vector<S, T>) {
        self.dp.fill(T::lift(0.0));
        multiply_add(&self.before.d21, T::lift(1.0), dq0, &mut self.dp);
        multiply_add(&self.before.d22, T::lift(1.0), dq1, &mut self.dp);
        dq0.copy_from_slice(dq1);
        self.after.apply(dq1, &mut self.dp);
    }

    /// max |AᵀΩ₁A − Ω₀| for the matrix A of the map, Ω₀ at (q0, q1) and Ω₁ at (q1, q2): zero up to
    /// rounding, unless forces act.
    #[cfg(feature = "alloc")]
    pub fn two_form_defect(&mut self, system: &S) -> T {
        let images = images(system, |dq0, dq1| self.apply(dq0, dq1));
        let of =
            |d: &[T], [u, w]: [&[Vector<S, T>; 2]; 2]| pairing(d, &u[0], &w[1]) - pairing(d, &w[0], &u[1]);
        let [before, after] = [&self.before.d12, &self.after.hessian().d12];
        defect(&images, |pair| of(before, pair), |pair| of(after, pair))
    }
}

/// uᵀ D w.
#[cfg(feature = "alloc")]
fn pairing<T: Real>(d: &[T], u: &[T], w: &[T]) -> T {
    let rows = u.iter().zip(lines(d, u.len()));
    rows.fold(T::lift(0.0), |sum, (&x, row)| row.iter().zip(w).fold(sum, |sum, (&d, &y)| sum + x * d * y))
}
