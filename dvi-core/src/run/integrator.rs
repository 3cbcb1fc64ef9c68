//! A run: a system, a method, what sets the lengths of its steps, and where they have got to.

#[cfg(feature = "alloc")]
use super::Checkpoint;
use super::begun::{Begun, BegunOf, begun, carried, point};
#[cfg(feature = "alloc")]
use super::resume::resumed;
use super::{Obeys, OneLength, Run, StepControl, Stepper};
use crate::error::{StartError, StepFailure};
use crate::mechanics::VectorField;
use crate::methods::{Carries, Sigma, SigmaMemory, Suits, SuitsAnyStep};
use crate::system::start::flatten;
use crate::system::{Same, StateOf};
use crate::{DegenerateLagrangian, Held, Lagrangian, Real, Space};

/// A run of a method on a system: with steps of one length, or of those that a [`StepControl`] `C` chooses.
///
/// As an iterator it yields the state after each step, for ever, or up to the first failure; after that
/// it yields `None`, and [`state`](Run::state) is the last good one: no step ends outside of the domain of
/// L, whatever its equations need of that place ([`StepFailure::LeftDomain`]). [`advance`](Run::advance)
/// takes a step without building a state. What can be asked of a run are the methods of the trait [`Run`].
///
/// ```
#[doc = include_str!("../../docs/hidden/pendulum.txt")]
/// let mut run = Integrator::new(&Pendulum, Gauss::<4>::new(), 0.1, start)?;
/// let third = run.nth(2).unwrap()?; // the state after the third step
/// assert_eq!((run.steps(), run.state()), (3, third));
/// run.take_steps(997)?;
/// assert_eq!(run.time(), 100.0);
/// assert!((run.energy() + 1_f64.cos()).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// [`Reversible`](super::Reversible) shows a run under a control. A control reads the velocity; for
/// L = ½ v·M v − V(q, t) that is one product with M⁻¹ a step.
pub struct Integrator<H, M, T = f64, C = OneLength<T>>
where
    H: Held,
    M: Carries<H::System, T>,
    T: Real,
    C: Carries<H::System, T>,
{
    pub(super) system: H,
    pub(super) stepper: Stepper<H::System, M, T>,
    pub(crate) control: C,
    pub(super) control_memory: C::Memory,
}

impl<H: Held<System: Lagrangian<T>>, M: Carries<H::System, T>, T: Real> Integrator<H, M, T> {
    /// A run from `start` at time 0 with step `h`, which may be negative.
    ///
    /// # Errors
    /// [`StartError`] if a parameter array of the system or an array of the state has the wrong length,
    /// `h` is zero or not finite, a coordinate is not finite, an option of the method is out of range,
    /// the energy or a first derivative of L is not finite at the start ([`StartError::Undefined`]), or the
    /// starting values cannot be computed.
    pub fn new<X>(system: H, method: X, h: T, start: StateOf<H, T>) -> Result<Self, StartError>
    where
        X: Suits<H::System, T, M>,
    {
        Self::new_at(system, method, T::lift(0.0), h, start)
    }

    /// A run from `start` at time `t`; else as [`new`](Self::new).
    ///
    /// # Errors
    /// As [`new`](Self::new), and [`StartError::Parameter`] if `t` is not finite.
    pub fn new_at<X>(system: H, method: X, t: T, h: T, start: StateOf<H, T>) -> Result<Self, StartError>
    where
        X: Suits<H::System, T, M>,
    {
        let (method, length) = (method.suited(), OneLength(h));
        let begun = begun(system.held(), X::steps(&method), &length, t, &start)?;
        Ok(Self::of(system, method, length, begun))
    }

    /// A run of [`Sigma`] that starts at `first`, time 0, and whose first step leads to `second`.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn from_two_points(
        system: H,
        method: Sigma<T>,
        h: T,
        first: StateOf<H, T>,
        second: StateOf<H, T>,
    ) -> Result<Self, StartError>
    where
        H::System: DegenerateLagrangian<T, Suited<Sigma<T>>: Same<Sigma<T>, As = M>>,
        M: Carries<H::System, T, Memory = SigmaMemory<H::System, T>>,
    {
        let (held, t) = (system.held(), T::lift(0.0));
        let (at, [q1, _]) = (point(held, t, &first)?, flatten(held, t + h, &second)?);
        let begin = |q0: &_, _: &_, h| method.begin_between(held, [q0, &q1], t, h);
        let length = OneLength(h);
        let begun =
            carried::<_, OneLength<T>, _, _>(held, &at, t, |q, v| length.begin(held, q, v, t), begin)?;
        let method = <H::System as DegenerateLagrangian<T>>::Suited::<Sigma<T>>::same(method);
        Ok(Self::of(system, method, length, begun))
    }

    /// A run that goes on from `checkpoint`, bit by bit as if the other had not stopped; with another
    /// [step](Checkpoint::with_step_size) from the same momenta.
    ///
    /// # Errors
    /// As [`new_at`](Self::new_at), and [`StartError::Checkpoint`] if it has more or less than this method
    /// carries on this system, or numbers that no run has.
    #[cfg(feature = "alloc")]
    pub fn resume<X>(system: H, method: X, checkpoint: &Checkpoint<T>) -> Result<Self, StartError>
    where
        X: Suits<H::System, T, M>,
    {
        let (method, length) = (method.suited(), OneLength(checkpoint.step_size()));
        let begun = resumed(system.held(), X::steps(&method), &length, checkpoint)?;
        Ok(Self::of(system, method, length, begun))
    }
}

impl<H, M, T: Real, C> Integrator<H, M, T, C>
where
    H: Held<System: Lagrangian<T>>,
    M: Carries<H::System, T>,
    C: Carries<H::System, T>,
{
    /// A run from `start` at time 0 with steps that `control` chooses.
    ///
    /// # Errors
    /// As [`new`](Integrator::new), and [`StartError`] if an option of the control is out of range, or it
    /// does not go with the system or with the method.
    pub fn controlled<X, Y>(
        system: H,
        method: X,
        control: Y,
        start: StateOf<H, T>,
    ) -> Result<Self, StartError>
    where
        X: SuitsAnyStep<H::System, T, M>,
        M: Obeys<Y, H::System, T, C>,
    {
        Self::controlled_at(system, method, control, T::lift(0.0), start)
    }

    /// A run from `start` at time `t`; else as [`controlled`](Self::controlled).
    ///
    /// # Errors
    /// As [`controlled`](Self::controlled), and [`StartError::Parameter`] if `t` is not finite.
    pub fn controlled_at<X, Y>(
        system: H,
        method: X,
        control: Y,
        t: T,
        start: StateOf<H, T>,
    ) -> Result<Self, StartError>
    where
        X: SuitsAnyStep<H::System, T, M>,
        M: Obeys<Y, H::System, T, C>,
    {
        let (method, control) = (method.suited(), M::suited(control));
        let begun = begun(system.held(), X::steps(&method), M::lengths(&control), t, &start)?;
        Ok(Self::of(system, method, control, begun))
    }

    /// A run that goes on from `checkpoint`, bit by bit as if the other had not stopped. What a control
    /// carries from step to step, the length and the direction of the next step among it, is that of the
    /// checkpoint.
    ///
    /// # Errors
    /// As [`controlled_at`](Self::controlled_at), and [`StartError::Checkpoint`] if it has more or less than
    /// method and control carry on this system, or numbers that no run has.
    #[cfg(feature = "alloc")]
    pub fn resume_controlled<X, Y>(
        system: H,
        method: X,
        control: Y,
        checkpoint: &Checkpoint<T>,
    ) -> Result<Self, StartError>
    where
        X: SuitsAnyStep<H::System, T, M>,
        M: Obeys<Y, H::System, T, C>,
    {
        let (method, control) = (method.suited(), M::suited(control));
        let begun = resumed(system.held(), X::steps(&method), M::lengths(&control), checkpoint)?;
        Ok(Self::of(system, method, control, begun))
    }

    pub(super) fn of(system: H, method: M, control: C, begun: BegunOf<H::System, M::Memory, C, T>) -> Self {
        let Begun { q, memory, kept, control_memory, time, statistics } = begun;
        let stepper = Stepper { method, memory, q, time, statistics, failed: false, kept, points: None };
        Self { system, stepper, control, control_memory }
    }

    /// The method that takes the steps.
    #[inline]
    pub fn method(&self) -> &M {
        &self.stepper.method
    }

    /// What the method carries from step to step. Of this can be read:
    ///
    /// | method | functions of its memory |
    /// |---|---|
    /// | `Variational`, `Galerkin`, `Newmark`, `Geodesic`, `Langevin` | `p()`: the momenta ∂L/∂v, with a place for each coordinate; of a rotation the first three are the angular momentum in the body |
    /// | `Rattle`, `Constrained` | `p()`; `multipliers()`: λ of the last step, one for each constraint |
    /// | `Impacts` | `impacts()` of the last step, each an [`Impact`](crate::methods::Impact); how many there were, in `total()` and `grazing()` |
    /// | `Sigma` | `defect()`: p − α(q); `parasitic_mode()`, as it was measured last |
    /// | `Impacts` | `inner()`: the memory of the method inside |
    ///
    /// ```
    #[doc = include_str!("../../docs/hidden/kepler.txt")]
    /// let mut run = Integrator::new(&Kepler, Variational::trapezoid(), 0.01, start)?;
    /// run.take_steps(1000)?;
    /// let ([x, y], [p_x, p_y]) = (run.q(), run.memory().p()) else { panic!("a plane") };
    /// assert!((x * p_y - y * p_x - 1.2).abs() < 1e-12); // the area law, in momenta
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[inline]
    pub fn memory(&self) -> &M::Memory {
        &self.stepper.memory
    }

    /// What the step control carries from step to step. Of [`EnergyMomentum`](super::EnergyMomentum) one
    /// reads here `discrete_energy()`, and its `defect()` in the last step; of
    /// [`ErrorControl`](super::ErrorControl) the `error()` of the last step in units of the tolerance.
    pub fn control_memory(&self) -> &C::Memory {
        &self.control_memory
    }
}

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
