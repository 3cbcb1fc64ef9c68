//! Velocities of coordinates that are light against the others.
//!
//! What a run carries is p = M v. A light coordinate gets and loses large momenta within a step, as the
//! constraints ask of it, and keeps a small one: rounding errors of the large ones make its velocity one
//! across the constraints. What is left of the constraints is taken away once more then, from a momentum
//! that is small already.

use super::arrival::Arrival;
use crate::error::StepFailure;
use crate::mechanics::constraints::residuals::Residuals;
use crate::mechanics::constraints::scales::{balance, scale_coordinates};
use crate::mechanics::constraints::{At, Augmented, Multipliers};
use crate::mechanics::mass::Mass;
use crate::solve::Convergence;
use crate::{ConstrainedSystem, HolonomicLagrangian, Real, Scalar, Separable, Space, Vector};

/// What it needs.
#[derive(Debug)]
pub(super) struct Refinement<S: ConstrainedSystem, T: Real> {
    residuals: Residuals<S, T>,
    /// The impulse so far.
    impulse: Multipliers<S, T>,
}

/// The unit that the constraints give a coordinate is smaller by this factor than that of its mass, if it is
/// light. Rounding errors grow by the square of it.
const LIGHT: f64 = 1.0 / 32.0;

impl<S: HolonomicLagrangian<T> + Separable<T>, T: Real> Refinement<S, T> {
    /// Where there are light coordinates.
    pub(super) fn for_light_coordinates(system: &S, [q, v]: [&[T]; 2], t: T) -> Option<Self> {
        let mut units: Augmented<S, T> = system.augmented().vector();
        balance(system, At { q, t }, v, units.split_at_mut(q.len()));
        let mut of_masses: Vector<S, T> = system.space().vector();
        scale_coordinates(system, [q, v], t, &mut of_masses);
        let is_light =
            units.iter().zip(of_masses.iter()).any(|(&unit, &of_mass)| unit < T::lift(LIGHT) * of_mass);
        let impulse = system.multipliers().vector();
        is_light.then(|| Self { residuals: Residuals::new(system, &units[..q.len()]), impulse })
    }
}

impl<S: HolonomicLagrangian<T> + Separable<T>, T: Real> Arrival<S, T> {
    /// Aligns the momentum until the constraints are kept.
    #[cold]
    pub(super) fn refine(
        &mut self,
        system: &S,
        mass: &Mass<S, T>,
        t: T,
        Refinement { residuals, impulse }: &mut Refinement<S, T>,
    ) -> Result<(), StepFailure> {
        loop {
            let Self { q, place, vector: v, .. } = self;
            mass.solve(&place.p, v);
            residuals.evaluate(system, At { q, t }, v, |j| Scalar::abs(v[j]));
            if residuals.are_settled() {
                return residuals.admit(system, At { q, t }, v);
            }
            impulse.copy_from_slice(&place.impulses.last);
            self.align::<Convergence<T>>((system, mass), t)?;
            for (sum, &before) in self.place.impulses.last.iter_mut().zip(impulse.iter()) {
                *sum += before;
            }
        }
    }
}
