//! The variational midpoint scheme of a degenerate Lagrangian, projected onto p = α(q) (Kraus 2017).
//!
//! The scheme σ = ½ leaves the surface p = α(q), on which the motion is: that is its parasitic mode. The
//! symmetric projection moves both ends of a step by a vector λ along the directions that Ω makes of the
//! constraint, to the same side, since the midpoint scheme reverses what is off the surface.

mod equations;

use crate::error::{StartError, StepFailure};
use crate::mechanics::pattern::coupled_by_second_derivatives;
use crate::memory::lasting;
use crate::methods::one_point::OnePoint;
use crate::methods::{self, Carries, Method, PreservedForm, VariableStep, scheme};
use crate::scalar::norm;
use crate::scalar::passes::{divide, multiply};
use crate::solve::{Stopping, from_either_guess, solve_coupled};
use crate::space::Storing;
use crate::system::spinors;
use crate::{Coupled, DegenerateLagrangian, Real, Space, System, Vector};
use equations::{NODES, Step, Work};

/// The variational midpoint scheme with the symmetric projection onto p = α(q), for any degenerate system.
///
/// ```math
/// \begin{aligned}
/// \alpha(q_0) + D\alpha(q_0)^T \lambda &= -D_1 L_d(\tilde q_0, \tilde q_1), & \tilde q_0 &= q_0 + \lambda \\
/// \alpha(q_1) + D\alpha(q_1)^T \lambda &= D_2 L_d(\tilde q_0, \tilde q_1), & \tilde q_1 &= q_1 + \lambda
/// \end{aligned}
/// ```
///
/// Its order is 2, and it is symmetric. It is for one-forms that no gauge brings into the class of
/// [`OneStep`](super::OneStep), which is to be preferred where it can be used. It couples two points and has
/// no parasitic mode. Where α is affine with constant coefficients, λ = 0 and it is the implicit midpoint
/// rule, which preserves Ω.
///
/// Elsewhere a step changes Ω by terms of the order h⁵. Its energy drifts, by terms of the order h⁴ per unit
/// of time. Where a motion has a reversing symmetry, as that of a guiding centre in a magnetic mirror, none
/// is seen. Source: Kraus 2017, *Projected variational integrators for degenerate Lagrangian systems*, with
/// the midpoint rule.
///
/// A step is solved by Newton's method for 2n unknowns.
///
/// ```
/// use dvi_core::prelude::*;
///
/// /// Predators and prey with components of α along both: in no class of one-step schemes as it stands.
/// #[degenerate_lagrangian(
///     coordinates(x, y),
///     one_form = (y.ln() / x * d(x) - x.ln() / y * d(y)) / 2.0,
///     hamiltonian = x + y - x.ln() - 2.0 * y.ln(),
/// )]
/// struct Predators;
///
/// let start = PredatorsState { x: 1.0, y: 0.5 };
/// let mut run = Integrator::new(&Predators, Projected::symmetric(), 0.05, start)?;
/// let energy = run.energy();
/// run.take_steps(10_000)?;
/// assert!((run.energy() - energy).abs() < 1e-2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projected {
    /// The criterion by which a step counts as solved. Default: to rounding errors.
    pub stopping: Stopping,
}

impl Projected {
    /// The method with default options.
    pub fn symmetric() -> Self {
        Self { stopping: Stopping::default() }
    }
}

scheme! {
    [] Projected, |_|
    order: 2,
    is_symmetric: true,
    preserved_form: PreservedForm::OmegaIfAffine,
}

/// What a run of a projected scheme carries.
#[derive(Debug)]
pub struct ProjectedMemory<S: System, T: Real> {
    point: OnePoint<S, T>,
    solver: Coupled<NODES, S, T>,
    /// From 1: Δ = q1 − q0 and λ.
    unknowns: [Vector<S, T>; NODES],
    /// The residuals from 1, and then the corrections.
    residuals: [Vector<S, T>; NODES],
    /// In which the iteration judges coordinates, and work space.
    weights: [Vector<S, T>; 2],
    work: Work<S, T>,
}

lasting!([S: System, T: Real] ProjectedMemory<S, T>, T; part point);

impl<S: System, T: Real> Carries<S, T> for Projected {
    type Memory = ProjectedMemory<S, T>;
}

impl<S: DegenerateLagrangian<T>, T: Real> Method<S, T> for Projected {
    type Suited<X> = S::Suited<X>;

    fn begin(&self, system: &S, q: &Vector<S, T>, _: &[T], t: T, _: T) -> Result<Self::Memory, StartError> {
        self.stopping.validate()?;
        if !S::AFFINE {
            spinors::refuse::<S>("`Projected` where α is not affine")?;
        }
        let space = system.space();
        let [middle, velocity, end, gradient, one_form, slope, rest] = space.vectors();
        Ok(ProjectedMemory {
            point: OnePoint::new(system, q, t, |rates| [rates])?,
            solver: coupled_by_second_derivatives(system, [q, &rest], t, NODES - 1, Storing::Always),
            unknowns: space.vectors(),
            residuals: space.vectors(),
            weights: space.vectors(),
            work: Work { middle, velocity, end, gradient, one_form, slope, rest },
        })
    }

    fn step(&self, step: methods::Step<'_, S, T>, memory: &mut Self::Memory) -> Result<(), StepFailure> {
        let methods::Step { system, q, t, h, statistics } = step;
        let ProjectedMemory { point, solver, unknowns, residuals, weights, work } = memory;
        from_either_guess(|guess| {
            let OnePoint { p, rates, orientation } = &mut *point;
            // λ is smaller than the error of Δ.
            let [_, delta, lambda] = &mut *unknowns;
            rates.guess(h, guess, [&mut *delta]);
            multiply(delta, h);
            lambda.fill(T::lift(0.0));
            let mut step = Step { system, q, p, t, h, unknowns, work, node: 0 };
            solve_coupled(&mut step, (system, q), solver, (residuals, weights), self.stopping, statistics)?;
            step.place();
            let [centre, after] = step.times();
            let Work { middle, end, one_form, .. } = &mut *work;
            norm::finite(end)?;
            system.one_form(end, after, one_form);
            // Between two branches Ω changes its sign.
            orientation.pass(system, &[(middle, centre)], (end, after))
        })?;
        let [_, delta, _] = unknowns;
        divide(delta, h);
        point.arrive(q, (&work.end, &work.one_form), h, [delta]);
        Ok(())
    }
}

impl<S: DegenerateLagrangian<T>, T: Real> VariableStep<S, T> for Projected {
    type SuitedToAnyStep<X> = <Self as Method<S, T>>::Suited<X>;
}
