//! The exact derivative of a variational step in (q, p).
//!
//! Differentiating p0 = −D₁L_d(q0, q1), p1 = D₂L_d(q0, q1) implicitly:
//!
//! δq1 = −(D₁D₂)⁻¹(δp0 + D₁D₁δq0)
//! δp1 = D₂D₁δq0 + D₂D₂δq1

#[cfg(feature = "alloc")]
use alloc::vec::Vec;

use super::DiscreteHessian;
use crate::discrete::{Interval, TwiceDifferentiable};
use crate::error::StepFailure;
use crate::methods::VariationalMethod;
use crate::space::elimination::{self, multiply_add};
use crate::{Lagrangian, Matrix, Real, Space, System, Vector};

/// The tangent map (δq0, δp0) ↦ (δq1, δp1) of one step of the discrete Lagrangian `L`.
///
/// ```
#[doc = include_str!("../../docs/hidden/pendulum.txt")]
/// use dvi_core::discrete::Interval;
///
/// let method = Variational::trapezoid();
/// let mut run = Integrator::new(&Pendulum, method, 0.1, start)?;
/// let q0 = run.q().to_vec();
/// run.advance()?;
/// let mut map = TangentMap::new(&Pendulum, &method);
/// map.evaluate(&Pendulum, Interval { t: 0.0, h: 0.1 }, &q0, run.q())?;
/// assert!(map.symplectic_defect(&Pendulum) < 1e-15); // dq ∧ dp is preserved
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct TangentMap<S: System, L, T: Real = f64> {
    hessian: DiscreteHessian<S, L, T>,
    factors: Matrix<S, T>,
    permutation: Vector<S, usize>,
    next: [Vector<S, T>; 2],
}

impl<S: Lagrangian<T>, L: TwiceDifferentiable<S, T>, T: Real> TangentMap<S, L, T> {
    /// Storage for steps of `method` on `system`; the map is that of the step given to
    /// [`evaluate`](Self::evaluate).
    pub fn new(system: &S, method: &impl VariationalMethod<S, T, DiscreteLagrangian = L>) -> Self {
        let space = system.space();
        Self {
            hessian: DiscreteHessian::new(system, method),
            factors: space.matrix(),
            permutation: space.array(|| 0),
            next: [space.vector(), space.vector()],
        }
    }

    /// Linearizes the step over `interval` from `q0` to `q1`.
    ///
    /// # Errors
    /// [`StepFailure::Singular`] where D₁D₂L_d is singular, or those of the discrete Lagrangian.
    pub fn evaluate(
        &mut self,
        system: &S,
        interval: Interval<T>,
        q0: &[T],
        q1: &[T],
    ) -> Result<(), StepFailure> {
        self.hessian.evaluate(system, interval, q0, q1)?;
        self.factors.copy_from_slice(&self.hessian.d12);
        elimination::factor(&mut self.factors, &mut self.permutation)
    }

    /// The second derivatives of L_d for the step, `d11`, `d12`, `d21` and `d22`, row-major; on a system with
    /// forces, those of D₁L_d + F⁻ and D₂L_d + F⁺. `d12`, with row i for q0ⁱ and column j for q1ʲ, is the
    /// matrix of the two-form D₁D₂ dq0 ∧ dq1 on Q×Q that each step preserves (Marsden & West 2001, section
    /// 1.3.2; Rowley & Marsden 2002, eq. 17).
    pub fn hessian(&self) -> &DiscreteHessian<S, L, T> {
        &self.hessian
    }

    /// Maps (δq0, δp0), in place, to (δq1, δp1).
    pub fn apply(&mut self, dq: &mut Vector<S, T>, dp: &mut Vector<S, T>) {
        let DiscreteHessian { d11, d21, d22, .. } = &self.hessian;
        let [dq1, dp1] = &mut self.next;
        dq1.copy_from_slice(dp);
        multiply_add(d11, T::lift(1.0), dq, dq1);
        elimination::solve(&self.factors, &self.permutation, dq1);
        dq1.iter_mut().for_each(|x| *x = -*x);
        dp1.fill(T::lift(0.0));
        multiply_add(d21, T::lift(1.0), dq, dp1);
        multiply_add(d22, T::lift(1.0), dq1, dp1);
        dq.copy_from_slice(dq1);
        dp.copy_from_slice(dp1);
    }

    /// max |MᵀJM − J| for the matrix M of the map and J = (0 1; −1 0): zero up to rounding, unless forces
    /// act.
    #[cfg(feature = "alloc")]
    pub fn symplectic_defect(&mut self, system: &S) -> T {
        let images = images(system, |dq, dp| self.apply(dq, dp));
        let dot = |x: &[T], y: &[T]| x.iter().zip(y).fold(T::lift(0.0), |sum, (&x, &y)| sum + x * y);
        let form = |[u, w]: [&[Vector<S, T>; 2]; 2]| dot(&u[0], &w[1]) - dot(&u[1], &w[0]);
        defect(&images, form, form)
    }
}

/// The unit vectors of pairs, and where a map leads them.
#[cfg(feature = "alloc")]
pub(super) fn images<S: Lagrangian<T>, T: Real>(
    system: &S,
    mut map: impl FnMut(&mut Vector<S, T>, &mut Vector<S, T>),
) -> Vec<[[Vector<S, T>; 2]; 2]> {
    let n = system.space().dimension();
    let image = |place: usize| {
        let mut pairs = [(); 2].map(|()| [(); 2].map(|()| system.space().vector()));
        pairs.iter_mut().for_each(|pair| pair[place / n][place % n] = T::lift(1.0));
        let [dq, dp] = &mut pairs[1];
        map(dq, dp);
        pairs
    };
    (0..2 * n).map(image).collect()
}

/// The largest difference of a two-form on pairs and of another one on their images.
#[cfg(feature = "alloc")]
pub(super) fn defect<V, T: Real>(
    images: &[[V; 2]],
    form: impl Fn([&V; 2]) -> T,
    on_images: impl Fn([&V; 2]) -> T,
) -> T {
    let pairs = images.iter().flat_map(|a| images.iter().map(move |b| (a, b)));
    pairs.fold(T::lift(0.0), |defect, ([u, u1], [w, w1])| {
        defect.max(crate::Scalar::abs(on_images([u1, w1]) - form([u, w])))
    })
}
