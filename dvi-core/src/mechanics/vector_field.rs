//! The vector field q' = X(q, t) of a degenerate Lagrangian.
//!
//! The Euler–Lagrange equations of L = α(q, t)·v − H(q, t) are B v = ∇H + ∂α/∂t with
//! Bᵢⱼ = ∂ᵢαⱼ − ∂ⱼαᵢ, that is B = (Dα)ᵀ − Dα (Rowley & Marsden 2002, section 3.2). B is inverted once if α
//! is linear, by one reciprocal per coordinate if it has canonical shape, and by elimination otherwise.

use crate::error::StepFailure;
use crate::mechanics::combination::{Combination, Inverse};
use crate::scalar::Lanes;
use crate::scalar::lanes::{read_lane, write_lane};
use crate::state::Statistics;
use crate::{DegenerateLagrangian, Real, Space, System, Vector};

/// X = B⁻¹(∇H + ∂α/∂t) with the storage that its evaluation needs.
#[derive(Debug)]
pub(crate) struct VectorField<S: System, T: Real> {
    inverse: Inverse<S, T>,
    gradient: Vector<S, T>,
    entries: Vector<S, T>,
}

impl<S: DegenerateLagrangian<T>, T: Real> VectorField<S, T> {
    /// The vector field of `system`, inverted at (`q`, `t`).
    ///
    /// # Errors
    /// [`StepFailure::Singular`] if Ω is singular at `q`.
    pub(crate) fn new(system: &S, q: &Vector<S, T>, t: T) -> Result<Self, StepFailure> {
        let ([gradient, entries], inverse) =
            (system.space().vectors(), Inverse::new(system, q, t, Self::omega()));
        let mut field = Self { inverse, gradient, entries };
        field.invert(system, q, t, &mut Statistics::default())?;
        Ok(field)
    }

    /// Inverts Ω at another point.
    #[inline]
    fn invert(&mut self, system: &S, q: &[T], t: T, statistics: &mut Statistics) -> Result<(), StepFailure> {
        let prepared = self.inverse.prepare(system, q, t, Self::omega(), &mut self.entries, statistics);
        prepared.map_err(|failure| failure.of(StepFailure::OMEGA))
    }

    fn omega() -> Combination<T> {
        Combination { a: T::lift(-1.0), b: T::lift(1.0) }
    }

    /// Sets `velocity` to X(`q`, `t`).
    ///
    /// # Errors
    /// [`StepFailure::Singular`] if Ω is singular at `q`.
    #[inline]
    pub(crate) fn evaluate(
        &mut self,
        system: &S,
        q: &Vector<S, T>,
        t: T,
        velocity: &mut Vector<S, T>,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        system.flow_source(q, t, &mut self.gradient);
        statistics.gradients += 1;
        self.solve(system, q, t, velocity, statistics)
    }

    /// Sets `out` to X at the points in the lanes of `q`, at the times in those of `t`, bit for bit as
    /// [`evaluate`](Self::evaluate) finds them one by one. What comes with `vector`, one lane, is storage.
    // Apart from a step it would not be compiled for the instructions of that: a step of four vortices with
    // four stages takes a third longer then (`cargo bench -p dvi-benches --bench lanes`).
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn evaluate_in_lanes<const W: usize>(
        &mut self,
        system: &S,
        q: &[Lanes<W, T>],
        t: Lanes<W, T>,
        ([gradient, entries], vector): ([&mut [Lanes<W, T>]; 2], &mut [T]),
        out: &mut [Lanes<W, T>],
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure>
    where
        S: DegenerateLagrangian<Lanes<W, T>>,
    {
        system.flow_source(q, t, gradient);
        statistics.gradients += W as u64;
        if !<S as DegenerateLagrangian<T>>::AFFINE && <S as DegenerateLagrangian<T>>::CANONICAL {
            let Combination { a, b } = Self::omega();
            system.conjugate_entries(q, t, Lanes::all(a), Lanes::all(b), entries);
            return Inverse::<S, T>::of_entries_in_lanes(system, entries, gradient, out);
        }
        if <S as DegenerateLagrangian<T>>::AFFINE
            && let Some(reciprocals) = self.inverse.reciprocals()
        {
            for (j, &reciprocal) in reciprocals.iter().enumerate() {
                let conjugate = DegenerateLagrangian::<T>::conjugate(system, j);
                out[j] = gradient[conjugate] * Lanes::all(reciprocal);
            }
            return Ok(());
        }
        for lane in 0..W {
            if !<S as DegenerateLagrangian<T>>::AFFINE {
                read_lane(lane, q, vector);
                self.invert(system, vector, t.0[lane], statistics)?;
            }
            read_lane(lane, gradient, &mut self.gradient);
            self.inverse.solve(system, &self.gradient, vector);
            write_lane(lane, vector, out);
        }
        Ok(())
    }

    /// Sets `xi` to B⁻¹∇J, the vector field that declared momentum `index` generates.
    ///
    /// # Errors
    /// [`StepFailure::Singular`] if Ω is singular at `q`.
    pub(crate) fn generator(
        &mut self,
        system: &S,
        index: usize,
        q: &Vector<S, T>,
        t: T,
        xi: &mut Vector<S, T>,
    ) -> Result<(), StepFailure> {
        system.momentum_gradient(index, q, t, &mut self.gradient);
        self.solve(system, q, t, xi, &mut Statistics::default())
    }

    #[inline]
    fn solve(
        &mut self,
        system: &S,
        q: &[T],
        t: T,
        out: &mut [T],
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        if !S::AFFINE {
            self.invert(system, q, t, statistics)?;
        }
        self.inverse.solve(system, &self.gradient, out);
        Ok(())
    }
}
