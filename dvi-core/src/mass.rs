//! The constant mass matrix of a separable system, ready to be solved with.
//!
//! L = ½ v·M v − V(q, t), p = M v. M is inverted once: by one reciprocal per coordinate if it is diagonal, by
//! elimination otherwise.

use crate::error::StepFailure;
use crate::{
    Lagrangian, Matrix, Permutation, Real, RegularLagrangian, Space, Vector, Weights, elimination, norm,
};

/// M and M⁻¹.
#[derive(Debug)]
pub(crate) struct Mass<S: Lagrangian, T: Real> {
    /// The diagonal of M, and one over it; zeros if M is not diagonal.
    masses: Vector<S, T>,
    reciprocals: Vector<S, T>,
    /// If M is not diagonal.
    dense: Option<Dense<S, T>>,
}

/// A matrix and its factors.
#[derive(Debug)]
struct Dense<S: Lagrangian, T: Real> {
    matrix: Matrix<S, T>,
    factors: Matrix<S, T>,
    permutation: Permutation<S>,
}

impl<S: RegularLagrangian, T: Real> Mass<S, T> {
    /// Of a separable `system`; M does not depend on the point (`q`, `t`) at which it is evaluated.
    ///
    /// # Errors
    /// [`StepFailure::Singular`].
    pub(crate) fn new(system: &S, q: &[T], t: T) -> Result<Self, StepFailure> {
        let space = system.space();
        let [mut v, mut l_q, mut l_v]: [Vector<S, T>; 3] = core::array::from_fn(|_| space.vector());
        if S::DIAGONAL_MASS {
            v.fill(T::lift(1.0));
            system.gradient(q, &v, t, &mut l_q, &mut l_v);
            let (masses, mut reciprocals) = (l_v, v);
            for (column, (&mass, reciprocal)) in masses.iter().zip(reciprocals.iter_mut()).enumerate() {
                *reciprocal = norm::reciprocal(mass, column)?;
            }
            return Ok(Self { masses, reciprocals, dense: None });
        }
        let (mut matrix, mut permutation) = (space.matrix(), space.permutation());
        let zero = T::lift(0.0);
        let weights = Weights { qq: zero, qv: zero, vq: zero, vv: T::lift(1.0) };
        system.linearize(q, &v, t, weights, &mut l_q, &mut l_v, &mut matrix);
        let mut factors = matrix.clone();
        elimination::factor(&mut factors, &mut permutation)?;
        let [masses, reciprocals] = [space.vector(), space.vector()];
        Ok(Self { masses, reciprocals, dense: Some(Dense { matrix, factors, permutation }) })
    }

    /// Sets `v` to M⁻¹`p`.
    #[inline(always)]
    pub(crate) fn solve(&self, p: &[T], v: &mut [T]) {
        // What is known when compiled keeps elimination out of the steps with a diagonal matrix.
        match &self.dense {
            Some(Dense { factors, permutation, .. }) if !S::DIAGONAL_MASS => {
                v.copy_from_slice(p);
                elimination::solve(factors, permutation, v);
            }
            _ => {
                for ((v, &p), &reciprocal) in v.iter_mut().zip(p).zip(self.reciprocals.iter()) {
                    *v = p * reciprocal;
                }
            }
        }
    }

    /// Adds `factor` M`x` to `p`.
    #[inline(always)]
    pub(crate) fn multiply_add(&self, factor: T, x: &[T], p: &mut [T]) {
        match &self.dense {
            Some(Dense { matrix, .. }) if !S::DIAGONAL_MASS => {
                for (p, row) in p.iter_mut().zip(matrix.chunks_exact(x.len())) {
                    let product = row.iter().zip(x).fold(T::lift(0.0), |sum, (&m, &x)| sum + m * x);
                    *p += factor * product;
                }
            }
            _ => {
                for ((p, &x), &mass) in p.iter_mut().zip(x).zip(self.masses.iter()) {
                    *p += factor * mass * x;
                }
            }
        }
    }
}
