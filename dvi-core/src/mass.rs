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
pub(crate) enum Mass<S: Lagrangian, T: Real> {
    Diagonal { masses: Vector<S, T>, reciprocals: Vector<S, T> },
    Dense { matrix: Matrix<S, T>, factors: Matrix<S, T>, permutation: Permutation<S> },
}

impl<S: RegularLagrangian, T: Real> Mass<S, T> {
    /// Of a separable `system`; M does not depend on the point (`q`, `t`) at which it is evaluated.
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
            return Ok(Self::Diagonal { masses, reciprocals });
        }
        let (mut matrix, mut permutation) = (space.matrix(), space.permutation());
        let zero = T::lift(0.0);
        let weights = Weights { qq: zero, qv: zero, vq: zero, vv: T::lift(1.0) };
        system.linearize(q, &v, t, weights, &mut l_q, &mut l_v, &mut matrix);
        let mut factors = matrix.clone();
        elimination::factor(&mut factors, &mut permutation)?;
        Ok(Self::Dense { matrix, factors, permutation })
    }

    /// Sets `v` to M⁻¹`p`.
    #[inline(always)]
    pub(crate) fn solve(&self, p: &[T], v: &mut [T]) {
        match self {
            Self::Diagonal { reciprocals, .. } => {
                for ((v, &p), &reciprocal) in v.iter_mut().zip(p).zip(reciprocals.iter()) {
                    *v = p * reciprocal;
                }
            }
            // Never built for such a system; saying so keeps elimination out of its steps.
            Self::Dense { .. } if S::DIAGONAL_MASS => {}
            Self::Dense { factors, permutation, .. } => {
                v.copy_from_slice(p);
                elimination::solve(factors, permutation, v);
            }
        }
    }

    /// Adds `factor` M`x` to `p`.
    #[inline(always)]
    pub(crate) fn multiply_add(&self, factor: T, x: &[T], p: &mut [T]) {
        match self {
            Self::Diagonal { masses, .. } => {
                for ((p, &x), &mass) in p.iter_mut().zip(x).zip(masses.iter()) {
                    *p += factor * mass * x;
                }
            }
            Self::Dense { .. } if S::DIAGONAL_MASS => {}
            Self::Dense { matrix, .. } => {
                for (p, row) in p.iter_mut().zip(matrix.chunks_exact(x.len())) {
                    let product = row.iter().zip(x).fold(T::lift(0.0), |sum, (&m, &x)| sum + m * x);
                    *p += factor * product;
                }
            }
        }
    }
}
