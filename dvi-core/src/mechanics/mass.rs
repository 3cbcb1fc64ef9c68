//! A constant mass matrix, ready to be solved with.
//!
//! L = ½ v·M v + a(q, t)·v − V(q, t), p = M v + a(q, t), mostly without a. M is inverted once: by one
//! reciprocal per coordinate if it is diagonal, by elimination otherwise.

use super::pattern::mass_entries;
use crate::error::StepFailure;
use crate::scalar::passes::multiply;
use crate::scalar::{norm, smallest_normal};
use crate::space::linear::{scale, set_scales};
use crate::space::{Sink, SquareMatrix};
use crate::{NondegenerateLagrangian, Real, Scalar, Space, Square, System, Vector};

/// M and M⁻¹. Where M is not constant there are no numbers here, so that a step that divides by it fails.
#[derive(Debug)]
pub(crate) struct Mass<S: System, T: Real> {
    /// The diagonal of M, and one over it; no numbers if M is not diagonal.
    masses: Vector<S, T>,
    reciprocals: Vector<S, T>,
    /// If M is not diagonal.
    coupled: Option<Coupled<S, T>>,
}

/// A matrix and its factors.
#[derive(Debug)]
struct Coupled<S: System, T: Real> {
    matrix: Square<S, T>,
    /// Of the matrix whose rows are in units of energies.
    factors: Square<S, T>,
    /// What they are multiplied by for that: velocities for which the diagonal is one.
    scales: Vector<S, T>,
}

impl<S: NondegenerateLagrangian<T>, T: Real> Mass<S, T> {
    /// Of a `system`; a constant M does not depend on the point (`q`, `t`) at which it is evaluated.
    ///
    /// # Errors
    /// [`StepFailure::Singular`].
    pub(crate) fn new(system: &S, q: &[T], t: T) -> Result<Self, StepFailure> {
        const { assert!(S::UNIFORM_MASS || !(S::CONSTANT_MASS || S::SEPARABLE)) };
        let space = system.space();
        let [mut v, mut masses, mut reciprocals]: [Vector<S, T>; 3] = space.vectors();
        if !S::UNIFORM_MASS {
            v.fill(T::lift(f64::NAN));
            return Ok(Self { masses: v.clone(), reciprocals: v, coupled: None });
        }
        if S::DIAGONAL_MASS {
            if S::CONSTANT_MASS {
                v.fill(T::lift(1.0));
                system.conjugate_momentum(q, &v, t, &mut masses);
            } else {
                mass_entries(system, [q, &v], t, |row, column, entry| {
                    if row == column {
                        masses[row] += entry;
                    }
                });
            }
            for (column, (&mass, reciprocal)) in masses.iter().zip(reciprocals.iter_mut()).enumerate() {
                *reciprocal =
                    norm::reciprocal(mass, column).map_err(|failure| failure.of(StepFailure::MASS))?;
            }
            return Ok(Self { masses, reciprocals, coupled: None });
        }
        let mut matrix: Square<S, T> =
            space.square(|visit| mass_entries(system, [q, &v], t, |row, column, _| visit(row, column)));
        let entries = matrix.cleared();
        mass_entries(system, [q, &v], t, |row, column, entry| {
            entries.add(row, column, entry);
            if row == column {
                masses[row] += entry;
            }
        });
        // The root of a mass is a weight of velocities.
        let (mut factors, mut scales) = (matrix.clone(), v);
        masses.iter_mut().for_each(|mass| *mass = Scalar::sqrt(Scalar::abs(*mass)) + smallest_normal::<T>());
        set_scales(&mut scales, &masses);
        factors.scale_rows(&scales);
        factors
            .factor_with_care([&mut masses, &mut reciprocals])
            .map_err(|failure| failure.of(StepFailure::MASS))?;
        masses.fill(T::lift(f64::NAN));
        reciprocals.fill(T::lift(f64::NAN));
        Ok(Self { masses, reciprocals, coupled: Some(Coupled { matrix, factors, scales }) })
    }

    /// 1/m of each coordinate, if M is constant and diagonal.
    #[inline]
    pub(crate) fn reciprocals(&self) -> Option<&[T]> {
        (S::UNIFORM_MASS && S::DIAGONAL_MASS).then_some(&*self.reciprocals)
    }

    /// x·M x, if M is diagonal and positive.
    #[inline]
    pub(crate) fn squared(&self, x: &[T]) -> T {
        x.iter().zip(self.masses.iter()).fold(T::lift(-0.0), |sum, (&x, &mass)| sum + mass * x * x)
    }

    /// Overwrites `p` with M⁻¹`p`.
    #[inline]
    pub(crate) fn solve_in_place(&self, p: &mut [T]) {
        match &self.coupled {
            Some(Coupled { factors, scales, .. }) if !S::DIAGONAL_MASS => {
                scale(p, scales);
                factors.solve(p);
            }
            _ => {
                for (p, &reciprocal) in p.iter_mut().zip(self.reciprocals.iter()) {
                    *p *= reciprocal;
                }
            }
        }
    }

    /// Sets `v` to M⁻¹`p`.
    #[inline]
    pub(crate) fn solve(&self, p: &[T], v: &mut [T]) {
        // What is known when compiled keeps elimination out of the steps with a diagonal matrix.
        match &self.coupled {
            Some(_) if !S::DIAGONAL_MASS => {
                v.copy_from_slice(p);
                self.solve_in_place(v);
            }
            _ => {
                for ((v, &p), &reciprocal) in v.iter_mut().zip(p).zip(self.reciprocals.iter()) {
                    *v = p * reciprocal;
                }
            }
        }
    }

    /// Sets `delta` to h M⁻¹`p`.
    #[inline]
    pub(crate) fn displace(&self, h: T, p: &[T], delta: &mut [T]) {
        match &self.coupled {
            Some(_) if !S::DIAGONAL_MASS => {
                self.solve(p, delta);
                multiply(delta, h);
            }
            _ => {
                for ((delta, &p), &reciprocal) in delta.iter_mut().zip(p).zip(self.reciprocals.iter()) {
                    *delta = p * (h * reciprocal);
                }
            }
        }
    }

    /// Adds `factor` M`x` to `p`.
    #[inline]
    pub(crate) fn multiply_add(&self, factor: T, x: &[T], p: &mut [T]) {
        match &self.coupled {
            Some(Coupled { matrix, .. }) if !S::DIAGONAL_MASS => matrix.multiply_add(factor, x, p),
            _ => {
                for ((p, &x), &mass) in p.iter_mut().zip(x).zip(self.masses.iter()) {
                    *p += factor * mass * x;
                }
            }
        }
    }
}
