//! The methods, and what one is to a run. [Choosing a method](crate::guide::choosing_a_method) says where to
//! begin, why, and when to change.
//!
//! The forms here are preserved by every step, to rounding, on systems without friction: see
//! [`PreservedForm`]. A prime says that it is the form in other coordinates, which differ by a multiple of a
//! power of the step.
//!
//! # For regular systems
//!
//! | method | order | preserves | when to take it |
//! |---|---|---|---|
//! | [`Variational::trapezoid`] | 2 | dq ∧ dp | first, if L = ½ v·Mv − V(q, t) with a constant M, and no force with velocities: Störmer–Verlet, explicit |
//! | [`Variational::midpoint`] | 2 | dq ∧ dp | first, for other L |
//! | [`Variational::new`], [`simpson`](Variational::simpson), [`sigma`](Variational::sigma) | 1, 2 | dq ∧ dp | to try rules of up to five nodes |
//! | [`Variational::phase_fitted`] | 1, 2 | dq ∧ dp or nothing | if the motion has a frequency that is known, or can be read from it |
//! | [`Galerkin`] | 4, 6, …, 16 | dq ∧ dp | for many digits: 3 to 9 nodes; from 4 on `in_lanes()` evaluates the forces of the interior nodes at once |
//! | [`Gauss`] | 2, 4, …, 16 | dq ∧ dp | for energies to rounding errors: 1 to 8 stages, with short steps and `Gauss::<8>::new().in_lanes()`; for [`ErrorControl`](crate::run::ErrorControl) |
//! | [`Newmark`] | 2 | dq' ∧ dp | for stiff forces: with γ = ½, stable at every step for β = ¼ |
//! | [`Langevin`](struct.Langevin.html) | 2 | nothing | in a heat bath, for the L of `trapezoid()`: averages over long runs |
//! | [`RungeKutta`] | 2, 4 | nothing | to compare with |
//!
//! # With constraints, with impacts, on rotations and unit vectors
//!
//! | method | order | preserves | when to take it |
//! |---|---|---|---|
//! | [`Rattle`] | 2 | dq ∧ dp | first, with constraints of positions and the L of `trapezoid()` |
//! | [`Constrained`] | 1, 2 | dq ∧ dp | for other L, and for constraints of velocities, under which no form can be preserved |
//! | [`Impacts::reflecting`] | 1, 2 | nothing | first, with impacts: keeps the energy at each; also around [`Galerkin`], with its order |
//! | [`Impacts::new`] | 1, 2 | dq ∧ dp | with impacts, if the form counts more: keeps the discrete energy |
//! | [`Geodesic`] | 1, 2 | dq ∧ dp | with rotations `R: SO3` and unit vectors `s: S2` |
//!
//! # For degenerate systems
//!
//! | method | order | preserves | when to take it |
//! |---|---|---|---|
//! | [`Sigma::midpoint`] | 2 | a form on Q×Q | first, if α is affine, as that of vortices is: the implicit midpoint rule, which preserves Ω then |
//! | [`Sigma::new`], [`leapfrog`](Sigma::leapfrog) | 2 | a form on Q×Q | for the family of Rowley & Marsden, on α with a constant antisymmetric Dα such as ½(x dy − y dx); explicit for σ = 0 and 1; where the parasitic mode grows, another method |
//! | [`OneStep`] | 2 | Ω | first, if α is not affine and has no component along one half of the coordinates, as it stands or with `gauge = auto` |
//! | [`OneStepGauss`] | 2, 4, 6, 8 | Ω | for many digits, with such α: 1 to 4 stages |
//! | [`Gauss`] | 2, 4, …, 16 | Ω if α is affine | first, for all other α, with an eye on the energy; for the last digits of the energy |
//! | [`Projected`] | 2 | Ω if α is affine | for all other α, if momenta of cyclic coordinates and Ω, to terms of order h⁵ in a step, count more than digits |
//! | [`RungeKutta`] | 2, 4 | nothing | to compare with |
//!
//! The lengths of unit vectors `s: S2` are kept by [`Sigma::midpoint`] and [`Projected`] where α is affine,
//! and by [`Gauss`]. Others are refused, and [`RungeKutta`] loses the lengths with its order.
//!
//! # Around another method
//!
//! | method | order | preserves | when to take it |
//! |---|---|---|---|
//! | [`Composition`] | 4, 6, 8 | what it does | for many digits: several steps of a symmetric method of order 2 make one, explicit if they are |
//! | [`EnergyLimit`] | that of the method | what it does | to end a run whose energy has gone astray |
//!
//! # What else is here
//!
//! [`Scheme`] says of a method what the tables say, [`Method`] is what a run asks of it. The other traits are
//! for methods of your own, and for code that is generic over methods.

mod collocation;
mod composition;
mod constrained;
mod context;
mod energy_limit;
mod flight;
mod galerkin;
mod gauss;
mod geodesic;
mod impacts;
mod kept;
#[cfg(feature = "random")]
mod langevin;
mod newmark;
mod one_point;
mod one_step;
mod projected;
mod runge_kutta;
mod scheme;
mod sigma_family;
mod step;
mod suits;
mod tabulated;
mod together;
mod tolerance;
mod variational;
mod variational_method;
mod walk;

use crate::discrete::Span;
use crate::error::{StartError, StepFailure};
use crate::memory::Memory;
use crate::state::Statistics;
use crate::system::Same;
use crate::{Lagrangian, Real, System, Vector};

pub use composition::Composition;
pub use constrained::{Constrained, Rattle};
pub use context::{Clock, Here, Step, Steps};
pub use energy_limit::EnergyLimit;
pub use flight::FreeFlight;
pub use galerkin::Galerkin;
pub use gauss::Gauss;
pub use geodesic::Geodesic;
pub use impacts::{Collision, Impact, Impacts};
pub(crate) use kept::Kept;
#[cfg(feature = "random")]
pub use langevin::Langevin;
pub use newmark::Newmark;
pub use one_step::{OneStep, OneStepGauss};
pub use projected::Projected;
pub use runge_kutta::RungeKutta;
pub(crate) use scheme::scheme;
pub use scheme::{PreservedForm, Scheme};
pub(crate) use sigma_family::SigmaMemory;
pub use sigma_family::{ParasiticMode, Sigma, Start};
pub use suits::{Suits, SuitsAnyStep, VariableStep};
pub use tabulated::Tabulated;
#[cfg(feature = "alloc")]
pub(crate) use together::Companion;
pub use together::InStep;
pub use tolerance::Tolerance;
pub use variational::{Fitting, Variational};
pub use variational_method::VariationalMethod;

/// Jumps of the velocity in a step, at most.
pub(crate) const JUMPS: usize = 16;

/// What runs carry for a method, or for a [step control](crate::run::StepControl).
///
/// It is known for systems of either kind, so that a method meets the question whether it can step a system
/// at one place only, where a run begins, and the user reads one error.
pub trait Carries<S: System, T: Real> {
    /// What is carried from step to step besides the coordinates: momenta, guesses, work space.
    type Memory: Memory<T>;
}

/// The discrete energy E_d = −∂L_d/∂h of a step, for L that does not depend on time (Marsden & West 2001,
/// section 4.2), with storage for a point and a velocity.
pub type DiscreteEnergy<M, S, T> = fn(&M, Span<'_, S, T>, &mut [Vector<S, T>; 2]) -> T;

/// A method that can step a system `S` in the arithmetic of `T`.
///
/// ```
#[doc = include_str!("../docs/hidden/pendulum.txt")]
/// /// By how much the energy of a pendulum has changed after 1000 steps of any method.
/// fn change(method: impl Method<Pendulum, f64>) -> Result<f64, Box<dyn std::error::Error>> {
///     let start = PendulumState { angle: 1.0, dot_angle: 0.0 };
///     let mut run = Integrator::new(&Pendulum, method, 0.2, start)?;
///     let energy = run.energy();
///     run.take_steps(1000)?;
///     Ok((run.energy() - energy).abs())
/// }
/// assert!(change(Variational::trapezoid())? < 5e-3);
/// assert!(change(Gauss::<4>::new())? < 1e-10);
/// assert!(change(RungeKutta::heun())? > 0.1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait Method<S: Lagrangian<T>, T: Real>: Scheme + Carries<S, T> {
    /// `M`, and nothing else has to be said in a method of your own. One for systems of one kind may take it
    /// from the trait of that kind, as `<S as RegularLagrangian<T>>::Suited<M>`: then rustc reports once,
    /// where a run begins, that a system is of another kind.
    type Suited<M>: Same<M, As = M>;

    /// Prepares a run with step `h` from (`q`, `t`), with velocity `v` if the system is regular; for
    /// degenerate systems `v` is empty. Everything that needs memory is allocated here.
    ///
    /// # Errors
    /// [`StartError::Parameter`] if an option is out of range; [`StartError::Starter`] if the starting
    /// values cannot be computed, or a matrix that is the same for all steps is singular.
    fn begin(&self, system: &S, q: &Vector<S, T>, v: &[T], t: T, h: T) -> Result<Self::Memory, StartError>;

    /// Prepares a run that goes on from a checkpoint, as [`begin`](Self::begin) does, for a memory that is
    /// [loaded](Memory::load) next.
    ///
    /// # Errors
    /// As [`begin`](Self::begin).
    fn begin_again(
        &self,
        system: &S,
        q: &Vector<S, T>,
        v: &[T],
        t: T,
        h: T,
    ) -> Result<Self::Memory, StartError> {
        self.begin(system, q, v, t, h)
    }

    /// The memory of a run that begins anew where `before` was its memory: `begun`, as [`begin`](Self::begin)
    /// has prepared it, with what a new beginning does not change, such as noise that has been used up.
    fn begun_anew(&self, _before: &Self::Memory, begun: Self::Memory) -> Self::Memory {
        begun
    }

    /// Takes a step, without allocation.
    ///
    /// # Errors
    /// Any [`StepFailure`]; the point and the dynamical part of `memory` are then as they were before.
    fn step(&self, step: Step<'_, S, T>, memory: &mut Self::Memory) -> Result<(), StepFailure>;

    /// Takes a part of the step of length `whole` that a run has taken from there, on a copy `memory` of
    /// what it carried, which takes nothing but such parts: the state between two points of the run. `taken`
    /// is what it carries at the end of that step. The part is a [step](Self::step) of its length, unless
    /// the memory depends on the length of steps, or the equations may have several solutions.
    ///
    /// # Errors
    /// As [`step`](Self::step).
    fn part_of_step(
        &self,
        part: Step<'_, S, T>,
        _whole: T,
        memory: &mut Self::Memory,
        _taken: &Self::Memory,
    ) -> Result<(), StepFailure> {
        self.step(part, memory)
    }

    /// Whether the [places](Self::place) that are known are jumps of the velocity, as at an impact.
    const HAS_JUMPS: bool = false;

    /// Sets `q` to the `index`-th of the places within the last step that are known, such as the stages of a
    /// method of high order, whose steps are long, or impacts, and `v` to the velocity there or, at
    /// [jumps](Self::HAS_JUMPS), to those before it and behind it, and returns the part of the step; in
    /// their order, from the first one on. Of degenerate systems there is no `v`. There are none if nothing
    /// else is said. A search for events looks at up to eight, and at up to 16 jumps.
    fn place(
        &self,
        _memory: &mut Self::Memory,
        _index: usize,
        _q: &mut Vector<S, T>,
        _v: [&mut Vector<S, T>; 2],
    ) -> Option<T> {
        None
    }

    /// Sets `v` to the velocity at the current point. There is nothing to do for degenerate systems.
    ///
    /// # Errors
    /// [`StepFailure`] if the momenta of the run have no velocity: the mass matrix is singular there.
    fn velocity(&self, _: Here<'_, S, T>, _memory: &Self::Memory, _v: &mut [T]) -> Result<(), StepFailure> {
        Ok(())
    }

    /// Takes steps, or as many as succeed, and counts them. A method with something to gain from many steps
    /// at once does better than one after the other.
    ///
    /// # Errors
    /// As [`step`](Self::step), from the first step that fails.
    #[inline]
    fn steps(&self, steps: Steps<'_, S, T>, memory: &mut Self::Memory) -> Result<(), StepFailure> {
        steps.one_by_one(self, memory)
    }

    /// The discrete energy of its steps, if it is known.
    const DISCRETE_ENERGY: Option<DiscreteEnergy<Self, S, T>> = None;

    /// Whether [`local_error`](Self::local_error) is known.
    const ESTIMATES_LOCAL_ERROR: bool = false;

    /// An estimate of the error of the last step, which was taken from time `t` with length `h`, in units of
    /// `tolerance`, without allocation; infinite if the method has none. It is of the order h<sup>p+1</sup>
    /// of the error, with the [order](Scheme::order) p. `usual` is the length that steps had before: a step
    /// that begins at rest may have the error that is allowed in what its force makes in that time.
    ///
    /// # Errors
    /// [`StepFailure`] if the equations of motion cannot be evaluated where the step began.
    fn local_error(
        &self,
        _system: &S,
        _memory: &mut Self::Memory,
        _t: T,
        [_h, _usual]: [T; 2],
        _tolerance: Tolerance,
        _statistics: &mut Statistics,
    ) -> Result<T, StepFailure> {
        Ok(T::lift(f64::INFINITY))
    }
}
