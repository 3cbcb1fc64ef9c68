//! What runs of the σ-family conserve.

use super::{Integrator, Run};
use crate::error::StepFailure;
use crate::mechanics::VectorField;
use crate::methods::Sigma;
use crate::{DegenerateLagrangian, Held, Real, Space};

impl<H: Held<System = S>, S: DegenerateLagrangian<T>, T: Real> Integrator<H, Sigma<T>, T> {
    /// The discrete momentum J_d = J(q) + c·ξ(q), ξ = B⁻¹∇J, of declared momentum `index`.
    ///
    /// By the discrete Noether theorem D₂L_d·ξ − f is conserved, where f is defined by
    /// L_ξ α = df (Marsden & West 2001, section 1.3.3). As D₂L_d = p = α + c and df = d(α·ξ − J), this is
    /// J_d up to a constant. Exact if ξ is affine in q and f affine, or quadratic with σ = ½.
    ///
    /// # Errors
    /// [`StepFailure::Singular`] if Ω is singular at the current point. `Ok(None)` if there is no such
    /// momentum.
    pub fn discrete_momentum(&self, index: usize) -> Result<Option<T>, StepFailure> {
        let Some(momentum) = self.momentum(index) else { return Ok(None) };
        let (system, q, t) = (self.system(), &self.stepper.q, self.time());
        let mut field = VectorField::new(system, q, t)?;
        let mut xi = system.space().vector();
        field.generator(system, index, q, t, &mut xi)?;
        let along = self.stepper.memory.defect().iter().zip(xi.iter());
        Ok(Some(along.fold(momentum, |sum, (&c, &xi)| sum + c * xi)))
    }
}
