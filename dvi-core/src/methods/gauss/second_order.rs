//! Gauss collocation on q'' = M⁻¹f(q, t) with a constant diagonal M, with the velocities of the stages
//! eliminated.
//!
//! Qᵢ = q + h cᵢ M⁻¹p + h M⁻¹Σⱼ νᵢⱼ Lⱼ,   Lᵢ = hbᵢ f(Qᵢ, t + cᵢh)
//! q⁺ = q + h M⁻¹p + h M⁻¹Σⱼ βⱼ Lⱼ,   p⁺ = p + Σᵢ Lᵢ
//!
//! It is the same method, a Nyström method (Hairer, Nørsett & Wanner 1993, section II.14), and one
//! combination of stages in each sweep where that on (q, p) has two. With νᵢⱼ − νⱼᵢ = βⱼ − βᵢ exactly it is
//! symplectic in the arithmetic (Antoñana, Makazaga & Murua 2025).

use super::memory::Path;
use crate::mechanics::motion::{FirstOrder, weigh_each};
use crate::methods::collocation::packs::{at, combine, moved, replace, sum};
use crate::scalar::Lanes;
use crate::{Real, System};

impl<const STAGES: usize, S: System<Kind: FirstOrder<S, T>>, T: Real> Path<STAGES, S, T> {
    /// Sets the positions of all stages by the forces that are guessed, if the equations are of second order.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn depart(&mut self, system: &S, h: T) {
        let Self { equations, coefficients, renewed: free, y, rest, .. } = self;
        let Some(reciprocals) = S::Kind::reciprocal_masses(equations) else { return };
        let nodes = coefficients.nystrom.nodes;
        for (k, (free, &reciprocal)) in free.iter_mut().zip(reciprocals).enumerate() {
            let by = h * reciprocal;
            let small = Lanes::all(rest[0][k]) + nodes * Lanes::all(by * rest[1][k]);
            *free = small + nodes * Lanes::all(by * y[1][k]);
        }
        self.place::<true>(system, h);
    }

    /// Sets the positions of all stages by the forces, and returns the largest change of one, if they are
    /// not the `FIRST`; `None` if the equations are not of second order.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn place<const FIRST: bool>(&mut self, system: &S, h: T) -> Option<T> {
        let Self { equations, coefficients, terms, stages, y, renewed: free, weights, .. } = self;
        let reciprocals = S::Kind::reciprocal_masses(equations)?;
        let ([displacements, momenta], [places, renewed]) = (&mut terms[..], &mut stages[..]) else {
            return None;
        };
        weigh_each(h, reciprocals, momenta, displacements);
        let set = if FIRST { &mut *places } else { &mut *renewed };
        combine(&coefficients.nystrom.nu, displacements, moved(&y[0], free), set);
        Some(if FIRST { T::lift(0.0) } else { replace(system, weights, places, renewed, |_, _| ()) })
    }

    /// Sets the increment of the coordinates, if the equations are of second order.
    #[inline]
    pub(super) fn displace(&mut self, h: T) {
        let Self { equations, coefficients, terms, y, rest, increment, .. } = self;
        let Some(reciprocals) = S::Kind::reciprocal_masses(equations) else { return };
        for (k, &reciprocal) in reciprocals.iter().enumerate() {
            let by = h * reciprocal;
            let forced = sum(&(coefficients.nystrom.beta * terms[0][k]).0);
            increment[0][k] = by * y[1][k] + (forced + by * rest[1][k]);
        }
    }

    /// Sets the velocities of the stages, if the equations are of second order: steps do without them.
    pub(super) fn set_velocities(&mut self) {
        let Self { equations, coefficients, slopes, terms, y, .. } = self;
        let Some(reciprocals) = S::Kind::reciprocal_masses(equations) else { return };
        combine(&coefficients.mu, &terms[1], at(&y[1]), &mut slopes[0]);
        for (velocity, &reciprocal) in slopes[0].iter_mut().zip(reciprocals) {
            *velocity = *velocity * Lanes::all(reciprocal);
        }
    }
}
