//! The exact derivative of a variational step in (q, p).
//!
//! Differentiating p0 = −D₁L_d(q0, q1), p1 = D₂L_d(q0, q1) implicitly:
//!
//! δq1 = −(D₁D₂)⁻¹(δp0 + D₁D₁δq0)
//! δp1 = D₂D₁δq0 + D₂D₂δq1
//!
//! The last line, of the step before, makes of it the derivative of the two-step map (q0, q1) ↦ (q1, q2),
//! which preserves Ω_d = ∂²L_d/∂q0ⁱ∂q1ʲ dq0ⁱ ∧ dq1ʲ (Rowley & Marsden 2002, eq. 17).

#[cfg(feature = "alloc")]
use alloc::vec::Vec;

use crate::discrete::{DiscreteLagrangian, Interval, Nodes, Span};
use crate::error::StepFailure;
use crate::methods::VariationalMethod;
#[cfg(feature = "alloc")]
use crate::scalar::passes::dot;
use crate::scalar::passes::negate;
use crate::space::elimination::{self, multiply_add};
#[cfg(feature = "alloc")]
use crate::space::lines;
use crate::{Lagrangian, Matrix, Real, Space, System, Vector};

/// The tangent map (δq0, δp0) ↦ (δq1, δp1) of one step of a discrete Lagrangian with the nodes `N`.
///
/// ```
#[doc = include_str!("../../docs/hidden/pendulum.txt")]
/// use dvi_core::{Space, System, discrete::Interval};
///
/// let method = Variational::trapezoid();
/// let mut run = Integrator::new(&Pendulum, method, 0.1, start)?;
/// let q0 = run.q().to_vec();
/// run.advance()?;
/// let mut map = TangentMap::new(&Pendulum, &method);
/// map.evaluate(&Pendulum, Interval { t: 0.0, h: 0.1 }, &q0, run.q())?;
/// assert!(map.symplectic_defect(&Pendulum) < 1e-15); // dq ∧ dp is preserved
///
/// let [mut dq, mut dp] = Pendulum.space().vectors::<f64, 2>();
/// dq[0] = 1.0;
/// map.apply(&mut dq, &mut dp); // where a start that is 1 further leads, to first order
/// assert!((dq[0] - (1.0 - 0.1_f64.powi(2) / 2.0 * 1.0_f64.cos())).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct TangentMap<S: System, N, T: Real = f64> {
    discrete: DiscreteLagrangian<S, N, T>,
    hessian: [Matrix<S, T>; 4],
    factors: Matrix<S, T>,
    permutation: Vector<S, usize>,
    ends: [Vector<S, T>; 2],
    next: [Vector<S, T>; 2],
}

impl<S: Lagrangian<T>, N: Nodes<T>, T: Real> TangentMap<S, N, T> {
    /// Storage for steps of `method` on `system`; the map is that of the step given to
    /// [`evaluate`](Self::evaluate).
    pub fn new(system: &S, method: &impl VariationalMethod<S, T, Nodes = N>) -> Self {
        let space = system.space();
        Self {
            discrete: method.discrete_lagrangian(system),
            hessian: [(); 4].map(|()| space.matrix()),
            factors: space.matrix(),
            permutation: space.array(0),
            ends: space.vectors(),
            next: space.vectors(),
        }
    }

    /// Linearizes the step over `interval` from `q0` to `q1`. Slices shorter than the dimension count as
    /// continued by zeros.
    ///
    /// # Errors
    /// [`StepFailure::Singular`] where D₁D₂L_d is singular.
    pub fn evaluate(
        &mut self,
        system: &S,
        interval: Interval<T>,
        q0: &[T],
        q1: &[T],
    ) -> Result<(), StepFailure> {
        let zero = T::lift(0.0);
        let [start, delta] = &mut self.ends;
        for (i, (start, delta)) in start.iter_mut().zip(delta.iter_mut()).enumerate() {
            let [from, to] = [q0, q1].map(|q| q.get(i).copied().unwrap_or(zero));
            (*start, *delta) = (from, to - from);
        }
        self.hessian.iter_mut().for_each(|matrix| matrix.fill(zero));
        self.discrete.hessian(Span { system, interval, q0: start, delta }, self.hessian.each_mut());
        self.factors.copy_from_slice(&self.hessian[1]);
        elimination::factor(&mut self.factors, &mut self.permutation)
    }

    /// D₁D₁L_d, D₁D₂L_d, D₂D₁L_d and D₂D₂L_d for the step, row-major; on a system with forces, the
    /// derivatives of D₁L_d + F⁻ and D₂L_d + F⁺. D₁D₂L_d, with row i for q0ⁱ and column j for q1ʲ, is the
    /// matrix of the two-form D₁D₂ dq0 ∧ dq1 on Q×Q that each step preserves (Marsden & West 2001, section
    /// 1.3.2; Rowley & Marsden 2002, eq. 17).
    pub fn hessian(&self) -> [&[T]; 4] {
        self.hessian.each_ref().map(|matrix| &matrix[..])
    }

    /// Maps (δq0, δp0), in place, to (δq1, δp1).
    pub fn apply(&mut self, dq: &mut Vector<S, T>, dp: &mut Vector<S, T>) {
        let [d11, _, d21, d22] = &self.hessian;
        let [dq1, dp1] = &mut self.next;
        dq1.copy_from_slice(dp);
        multiply_add(d11, T::lift(1.0), dq, dq1);
        elimination::solve(&self.factors, &self.permutation, dq1);
        negate(dq1);
        dp1.fill(T::lift(0.0));
        multiply_add(d21, T::lift(1.0), dq, dp1);
        multiply_add(d22, T::lift(1.0), dq1, dp1);
        dq.copy_from_slice(dq1);
        dp.copy_from_slice(dp1);
    }

    /// Maps (δq0, δq1), in place, to (δq1, δq2), where this map is that of the step from q1 to q2 and
    /// `before` that of the step from q0 to q1.
    pub fn apply_after(&mut self, before: &Self, dq0: &mut Vector<S, T>, dq1: &mut Vector<S, T>) {
        let [_, _, d21, d22] = &before.hessian;
        let mut dp = self.ends[1].clone();
        dp.fill(T::lift(0.0));
        multiply_add(d21, T::lift(1.0), dq0, &mut dp);
        multiply_add(d22, T::lift(1.0), dq1, &mut dp);
        dq0.copy_from_slice(dq1);
        self.apply(dq1, &mut dp);
    }

    /// max |MᵀJM − J| for the matrix M of the map and J = (0 1; −1 0): zero up to rounding, unless forces
    /// act.
    #[cfg(feature = "alloc")]
    pub fn symplectic_defect(&mut self, system: &S) -> T {
        let images = images(system, |dq, dp| self.apply(dq, dp));
        let form = |[u, w]: [&[Vector<S, T>; 2]; 2]| dot(&u[0], &w[1]) - dot(&u[1], &w[0]);
        defect(&images, form, form)
    }

    /// max |AᵀΩ₁A − Ω₀| for the matrix A of the map of [two points](Self::apply_after), Ω₀ of the step
    /// `before` and Ω₁ of this one: zero up to rounding, unless forces act.
    ///
    /// ```
    #[doc = include_str!("../../docs/hidden/vortices.txt")]
    /// use dvi_core::discrete::Interval;
    ///
    /// let mut run = Integrator::new(&Vortices, Sigma::midpoint(), 0.1, start)?;
    /// let mut maps = [(); 2].map(|()| TangentMap::new(&Vortices, run.method()));
    /// for map in &mut maps {
    ///     let (interval, from) = (Interval { t: run.time(), h: 0.1 }, run.q().to_vec());
    ///     run.advance()?;
    ///     map.evaluate(&Vortices, interval, &from, run.q())?;
    /// }
    /// let [before, map] = &mut maps;
    /// assert!(map.two_form_defect(before, &Vortices) < 1e-14);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[cfg(feature = "alloc")]
    pub fn two_form_defect(&mut self, before: &Self, system: &S) -> T {
        let images = images(system, |dq0, dq1| self.apply_after(before, dq0, dq1));
        // uᵀ D w
        let pairing = |d: &[T], u: &[T], w: &[T]| {
            let rows = u.iter().zip(lines(d, u.len()));
            rows.fold(T::lift(0.0), |sum, (&x, row)| {
                row.iter().zip(w).fold(sum, |sum, (&d, &y)| sum + x * d * y)
            })
        };
        let of =
            |d: &[T], [u, w]: [&[Vector<S, T>; 2]; 2]| pairing(d, &u[0], &w[1]) - pairing(d, &w[0], &u[1]);
        defect(&images, |pair| of(&before.hessian[1], pair), |pair| of(&self.hessian[1], pair))
    }
}

/// The unit vectors of pairs, and where a map leads them.
#[cfg(feature = "alloc")]
fn images<S: Lagrangian<T>, T: Real>(
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
fn defect<V, T: Real>(
    images: &[[V; 2]],
    form: impl Fn([&V; 2]) -> T,
    on_images: impl Fn([&V; 2]) -> T,
) -> T {
    let pairs = images.iter().flat_map(|a| images.iter().map(move |b| (a, b)));
    pairs.fold(T::lift(0.0), |defect, ([u, u1], [w, w1])| {
        defect.max(crate::Scalar::abs(on_images([u1, w1]) - form([u, w])))
    })
}
