//! What a run says of its method.

use super::Run;
use crate::methods::{Carries, Method};

/// A run whose method is known when the program is compiled.
///
/// ```
#[doc = include_str!("../../docs/hidden/kepler.txt")]
/// /// The order of the method of any run.
/// fn order<R: WithMethod>(run: &R) -> usize {
///     run.method().order()
/// }
/// assert_eq!(order(&Integrator::new(&Kepler, Gauss::<4>::new(), 0.05, start)?), 8);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait WithMethod: Run {
    /// The method that takes the steps.
    type Method: Method<Self::System, Self::Scalar>;

    /// The method.
    fn method(&self) -> &Self::Method;

    /// What the method carries from step to step. Of this can be read:
    ///
    /// | method | functions of its memory |
    /// |---|---|
    /// | `Variational`, `Galerkin`, `Newmark`, `Geodesic`, `Langevin` | `p()`: the momenta ∂L/∂v, with a place for each coordinate; of a rotation the first three are the angular momentum in the body |
    /// | `Rattle`, `Constrained` | `p()`; `multipliers()`: λ of the last step, one for each constraint; `impulses()` at its two ends |
    /// | `Impacts` | `impacts()` of the last step, each an [`Impact`](crate::methods::Impact); how many there were, in `total()` and `grazing()` |
    /// | `Sigma` | `defect()`: p − α(q); `parasitic_mode()`, as it was measured last, and `parasitic_amplitude()` |
    /// | `Impacts`, `Composition`, `EnergyLimit` | `inner()`: the memory of the method inside |
    ///
    /// ```
    #[doc = include_str!("../../docs/hidden/kepler.txt")]
    /// let mut run = Integrator::new(&Kepler, Variational::trapezoid(), 0.01, start)?;
    /// run.take_steps(1000)?;
    /// let ([x, y], [p_x, p_y]) = (run.q(), run.memory().p()) else { panic!("a plane") };
    /// assert!((x * p_y - y * p_x - 1.2).abs() < 1e-12); // the area law, in momenta
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    fn memory(&self) -> &<Self::Method as Carries<Self::System, Self::Scalar>>::Memory;
}
