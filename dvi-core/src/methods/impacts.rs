//! Impacts: steps of a variational method that are divided where a gap closes, with a jump of the momentum
//! there.

mod closing;
mod gaps;
mod impulse;
mod jump;
mod memory;
mod passage;

use crate::error::{StartError, StepFailure};
use crate::methods::{Carries, FreeFlight, Here, Method, PreservedForm, Scheme, Step, scheme};
use crate::system::Same;
use crate::system::start::evaluate;
use crate::{ConstrainedSystem, Real, UnilateralLagrangian, Vector};
pub use memory::Impact;
use memory::ImpactsMemory;
use passage::Passage;

/// What is kept at an impact, beside the components of the momentum along the surface.
///
/// ```
/// use dvi_core::prelude::*;
///
/// #[lagrangian(coordinates(y), lagrangian = dot(y).powi(2) / 2.0 - y, impact = y)]
/// struct Ball;
///
/// let start = BallState { y: 1.0, dot_y: 0.0 };
/// let method = Impacts { restitution: 0.8, ..Impacts::reflecting(Variational::midpoint()) };
/// assert_eq!(method.collision, Collision::Reflection);
/// let mut run = Integrator::new(&Ball, method, 0.01, start)?;
/// run.take_steps(200)?; // it has met the floor once, at t = √2
/// assert!((run.energy() - 0.8 * 0.8).abs() < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Collision {
    /// The discrete energy: that of the flight before the impact and of the one after it are the same
    /// (Fetecau, Marsden, Ortiz & West 2003, eqs. 3.9 and 3.10). The steps are symplectic.
    #[default]
    Variational,
    /// The energy E at the point of impact. The steps are not symplectic.
    Reflection,
}

/// The steps of a variational method on a system with impacts, `impact = g`, whose motion stays where g(q,
/// t) ≥ 0.
///
/// A step in which a gap closes is divided at the time of the impact, t + αh, which is an unknown of the
/// step beside the point of impact q̃ and the impulse λ:
///
/// ```math
/// \begin{aligned}
/// p_0 &= -D_1 L_d(q_0, \tilde q;\ \alpha h), & g(\tilde q, t + \alpha h) &= 0, & \tilde p^- &= D_2 L_d(q_0, \tilde q;\ \alpha h) \\
/// \tilde p^+ &= -D_1 L_d(\tilde q, q_1;\ (1 - \alpha)h), & \tilde p^+ &= \tilde p^- + \lambda\, \tfrac{\partial g}{\partial q}, & p_1 &= D_2 L_d(\tilde q, q_1;\ (1 - \alpha)h)
/// \end{aligned}
/// ```
///
/// and one equation for λ, which [`Collision`] chooses: the discrete energies −∂L_d/∂h of both flights are
/// the same, up to −λ ∂g/∂t where the surface moves; or the energies at q̃ are. A step may have several
/// impacts, on one surface or on several; with more than 16 it fails with [`StepFailure::Accumulation`].
/// Steps end at the times t0 + kh, whether there are impacts or not.
///
/// | | [`new`](Self::new) | [`reflecting`](Self::reflecting) |
/// |---|---|---|
/// | keeps | the discrete energy | the energy at the point of impact |
/// | two-form dq ∧ dp | preserved | preserved between impacts |
/// | order | that of the method: 2 or 1 | that of the method, [`Galerkin`](crate::methods::Galerkin) too |
/// | restitution below 1, forces, L with time | refused | yes |
///
/// E_d differs from E by a term that depends on the length of the flight, so with [`Collision::Variational`]
/// each impact changes the energy by a small amount of the order h² that depends on α. As α is as good as
/// random, these amounts add up as in a random walk. Where energies count more than the two-form, take
/// [`reflecting`](Self::reflecting): the experiment `bounces` of the gallery compares them. A state between
/// two points of the run is that of a shorter step, whose last flight has another E_d: behind an impact its
/// velocity differs from [`Impact::v`] by as much.
///
/// A step without an impact is one of the method, and evaluates all gaps and their rates of change at its
/// two ends, which needs the velocities there.
///
/// An impact is looked for where a gap is negative at the end of a flight, and where it falls at the
/// beginning, rises at the end, and the tangents there meet below zero, or the cubic through gaps and rates
/// does; a gap that is a convex function of the time is not missed. A gap that closes and opens again more
/// often within one step may pass unseen: steps are to be short against the features of the surfaces. Where
/// a step is so long that the velocity leads away from a surface before the path has reached it, there is no
/// impact, and the step is divided there.
///
/// Restitution e < 1 takes away 1 − e² of the energy of the motion towards the surface, so that
/// $`\dot g^+ = -e\, \dot g^-`$ where L is quadratic in the velocities. A run back in time gains it, with
/// 1/e. It is the same for all surfaces.
///
/// ```
/// use dvi_core::prelude::*;
///
/// /// A ball above the floor.
/// #[lagrangian(coordinates(y), lagrangian = dot(y).powi(2) / 2.0 - y, impact = y)]
/// struct Ball;
///
/// // It falls for √2 units of time, and rises again.
/// let start = BallState { y: 1.0, dot_y: 0.0 };
/// let method = Impacts::new(Variational::midpoint());
/// let mut run = Integrator::new(&Ball, method, 0.02, start)?;
/// run.take_steps(70)?;
/// assert_eq!(run.memory().impacts().len(), 0);
/// run.advance()?;
/// let [impact] = run.memory().impacts() else { panic!("one impact") };
/// assert!((impact.time - 2.0_f64.sqrt()).abs() < 1e-14);
/// assert!((impact.impulse - 2.0 * 2.0_f64.sqrt()).abs() < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impacts<M> {
    /// What takes the system from impact to impact.
    pub scheme: M,
    /// What is kept at an impact. Default: [`Collision::Variational`].
    pub collision: Collision,
    /// The coefficient of restitution e, above 0 and up to 1; below 1 it goes with [`Collision::Reflection`]
    /// only. Default: 1, elastic.
    pub restitution: f64,
}

impl<M> Impacts<M> {
    /// Elastic impacts that keep the discrete energy, up to 16 in a step. Behind an impact the derivative of
    /// the state by a parameter, exact for these steps, has an error of the order h against that of the
    /// motion, where the state has h²: a fit takes [`reflecting`](Self::reflecting), which has h² in both.
    pub fn new(scheme: M) -> Self {
        Self { scheme, collision: Collision::Variational, restitution: 1.0 }
    }

    /// Elastic impacts that keep the energy at the point of impact, up to 16 in a step.
    pub fn reflecting(scheme: M) -> Self {
        Self { collision: Collision::Reflection, ..Self::new(scheme) }
    }
}

scheme! {
    [M: Scheme] Impacts<M>, |method|
    order: method.scheme.order(),
    is_symmetric: method.scheme.is_symmetric(),
    preserved_form: match method.collision {
        Collision::Variational => method.scheme.preserved_form(),
        Collision::Reflection => PreservedForm::Nothing,
    },
}

impl<S: ConstrainedSystem, T: Real, M: Carries<S, T>> Carries<S, T> for Impacts<M> {
    type Memory = ImpactsMemory<S, M::Memory, T>;
}

/// `X` if `S` has impacts, and unknown if it has not: rustc asks nothing of the scheme then.
type IfUnilateral<S, X, T> = <<S as UnilateralLagrangian<T>>::Suited<X> as Same<X>>::As;

impl<S: UnilateralLagrangian<T>, T: Real, M> Method<S, T> for Impacts<M>
where
    IfUnilateral<S, M, T>: FreeFlight<S, T>,
{
    type Suited<X> = IfUnilateral<S, X, T>;

    fn begin(&self, system: &S, q: &Vector<S, T>, v: &[T], t: T, h: T) -> Result<Self::Memory, StartError> {
        let e = self.restitution;
        StartError::unless(e > 0.0 && e <= 1.0, "restitution", e, "above 0 and up to 1")?;
        let refused = if self.collision == Collision::Reflection {
            None
        } else if S::FORCED || !S::AUTONOMOUS {
            Some(
                "energy is not conserved between impacts: forces act on the system, or L depends on the time; take \
                 `Impacts::reflecting`",
            )
        } else if e != 1.0 {
            Some("it is for elastic impacts; with a restitution below 1 take `Impacts::reflecting`")
        } else if IfUnilateral::<S, M, T>::DISCRETE_ENERGY.is_none() {
            Some("the method has no discrete energy; take `Impacts::reflecting`")
        } else {
            None
        };
        if let Some(reason) = refused {
            return Err(StartError::Unsupported { option: "Collision::Variational", reason });
        }
        evaluate(system, q, v, t)?;
        gaps::admit(system, [q, v], t, h)?;
        ImpactsMemory::new(system, q, || self.scheme.depart(system, q, v, t, h))
    }

    const HAS_JUMPS: bool = true;

    fn place(
        &self,
        memory: &mut Self::Memory,
        index: usize,
        q: &mut Vector<S, T>,
        [before, behind]: [&mut Vector<S, T>; 2],
    ) -> Option<T> {
        let impact = memory.impacts().get(index)?;
        q.copy_from_slice(&impact.q);
        before.copy_from_slice(&impact.v_before);
        behind.copy_from_slice(&impact.v);
        Some(impact.part)
    }

    fn step(&self, step: Step<'_, S, T>, memory: &mut Self::Memory) -> Result<(), StepFailure> {
        let Step { system, q, t, h, statistics } = step;
        let counts = [memory.total, memory.grazing];
        let impacts = core::mem::take(&mut memory.count);
        if impacts > 0 {
            core::mem::swap(&mut memory.events, &mut memory.earlier);
        }
        memory.start.take(q, &memory.inner);
        memory.is_divided = false;
        let (left, is_at_wall, is_there, turns) = (h, false, true, 0);
        let passage =
            Passage { method: self, system, memory, q, statistics, t, left, h, is_at_wall, is_there, turns };
        passage.take().inspect_err(|_| {
            let begin = if memory.is_divided { &memory.before } else { &memory.start };
            begin.go_back(q, &mut memory.inner);
            [memory.total, memory.grazing] = counts;
            if impacts > 0 {
                core::mem::swap(&mut memory.events, &mut memory.earlier);
            }
            memory.count = impacts;
        })
    }

    fn velocity(&self, here: Here<'_, S, T>, memory: &Self::Memory, v: &mut [T]) -> Result<(), StepFailure> {
        M::carried(&memory.inner).velocity(here, v)
    }
}
