//! RATTLE: the constrained step of the trapezoidal rule where L is separable.
//!
//! p½ = p0 + (h/2)F(q0) + G(q0)ᵀι0      q1 = q0 + h M⁻¹p½, with g(q1) = 0
//! p1 = p½ + (h/2)F(q1) + G(q1)ᵀι1, with G(q1) M⁻¹p1 + ∂g/∂t = 0
//!
//! h ι0 is found by Newton's method, whose matrix is G(q1) M⁻¹ G(q0)ᵀ, and ι1 from linear equations with
//! G(q1) M⁻¹ G(q1)ᵀ.

mod arrival;
mod refinement;
mod rows;
mod stride;

use crate::error::{StartError, StepFailure};
use crate::mechanics::constraints::consistent::{self, Among};
use crate::mechanics::mass::Mass;
use crate::memory::{Memory, lasting};
use crate::methods::constrained::Impulses;
use crate::methods::{Carries, Clock, Here, Method, PreservedForm, Scheme, Step, Steps, VariableStep};
use crate::solve::{Convergence, Stopping};
use crate::space::SquareMatrix;
use crate::system::Same;
use crate::{ConstrainedSystem, HolonomicLagrangian, Real, Separable, Vector};
use arrival::{Arrival, constrain};
use refinement::Refinement;
use rows::{fill, named};
use stride::Point;

/// RATTLE (Andersen 1983), for [`Separable`] systems with constraints: the step of
/// [`Constrained`](crate::methods::Constrained) around
/// [`Variational::trapezoid`](crate::methods::Variational::trapezoid), without second derivatives of L.
///
/// A step evaluates the force once. Its linear equations have one unknown for each constraint and a full
/// matrix, and the gradients of all constraints are kept with an entry for each coordinate; from about ten
/// constraints on, the equations of `Constrained` are cheaper, which are banded along a chain. With sizes
/// that are fixed at compile time all of that is part of the run: with a hundred rods in the plane 0.7 MB,
/// on the stack of the thread that begins it. With sizes that are known at run time only it is on the heap.
///
/// Where a coordinate is light against others that a constraint couples with it as a run begins, velocities
/// are corrected until they keep the constraints. With masses that differ by a factor of 10¹⁶ and more its
/// matrix is singular to rounding, and `Constrained` goes on.
///
/// What is said of `Constrained`, of its structure and its order, is true of this method. Positions are
/// those of SHAKE (Ryckaert, Ciccotti & Berendsen 1977) with a start on the constraints.
///
/// ```
/// use dvi_core::prelude::*;
///
/// /// Two masses on a rigid rod, in the plane.
/// #[lagrangian(
///     coordinates(x[2], y[2]),
///     lagrangian = sum(0..2, |i| (dot(x[i]).powi(2) + dot(y[i]).powi(2)) / 2.0),
///     constraint = (x[1] - x[0]).powi(2) + (y[1] - y[0]).powi(2) - 1.0,
/// )]
/// struct Dumbbell;
///
/// let start = DumbbellState { x: [0.0, 1.0], y: [0.0; 2], dot_x: [0.0; 2], dot_y: [0.0, 1.0] };
/// let mut run = Integrator::new(&Dumbbell, Rattle::default(), 0.01, start)?;
/// run.take_steps(1000)?;
/// // The centre of mass moves uniformly, and the ends around it.
/// assert!((run.state().y.iter().sum::<f64>() / 2.0 - 5.0).abs() < 1e-12);
/// let tension: Vec<f64> = run.memory().multipliers().collect();
/// assert!((tension[0] + 0.25).abs() < 1e-4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rattle {
    /// The criterion by which a step counts as solved. Default: to rounding errors.
    pub stopping: Stopping,
}

/// Where a run of [`Rattle`] is, and work space.
#[derive(Debug)]
pub struct RattleMemory<S: ConstrainedSystem, T: Real> {
    point: Point<S, T>,
    mass: Mass<S, T>,
    /// Whether M is diagonal and positive.
    is_metric: bool,
    /// Whether the determinant of G M⁻¹ Gᵀ is positive where the run begins.
    is_positive: bool,
    /// If coordinates are light against the others.
    refinement: Option<Refinement<S, T>>,
    work: Arrival<S, T>,
}

impl<S: ConstrainedSystem, T: Real> Memory<T> for RattleMemory<S, T> {
    lasting!(T; part point, flag is_positive);
}

impl<S: ConstrainedSystem, T: Real> RattleMemory<S, T> {
    /// p = M v at the current point, one entry per coordinate.
    pub fn p(&self) -> &[T] {
        &self.point.here.p
    }

    /// The Lagrange multipliers λ of the last step: see
    /// [`ConstrainedMemory::multipliers`](crate::methods::ConstrainedMemory::multipliers).
    pub fn multipliers(&self) -> impl Iterator<Item = T> + '_ {
        self.point.here.impulses.over(self.point.last_step)
    }

    /// The impulses of the last step: see
    /// [`ConstrainedMemory::impulses`](crate::methods::ConstrainedMemory::impulses).
    pub fn impulses(&self) -> [&[T]; 2] {
        [&self.point.here.impulses.first, &self.point.here.impulses.last]
    }
}

impl Scheme for Rattle {
    fn order(&self) -> usize {
        2
    }
    fn is_symmetric(&self) -> bool {
        true
    }
    fn preserved_form(&self) -> PreservedForm {
        PreservedForm::Canonical
    }
}

impl<S: ConstrainedSystem, T: Real> Carries<S, T> for Rattle {
    type Memory = RattleMemory<S, T>;
}

impl<S: HolonomicLagrangian<T> + Separable<T>, T: Real> Method<S, T> for Rattle {
    type Suited<X> = <S as Separable<T>>::Suited<<<S as HolonomicLagrangian<T>>::Suited<X> as Same<X>>::As>;

    fn begin(&self, system: &S, q: &Vector<S, T>, v: &[T], t: T, h: T) -> Result<Self::Memory, StartError> {
        self.stopping.validate()?;
        consistent::check(system, [q, v], t, Among::Steps { h, tolerance: self.stopping.tolerance })?;
        let mass = Mass::new(system, q, t).map_err(StartError::Starter)?;
        let mut work = Arrival::new(system);
        let Arrival { q: at, place, values, .. } = &mut work;
        at.copy_from_slice(q);
        constrain(system, q, t, values, &mut place.rows);
        system.force(q, &[], t, &mut place.force);
        mass.multiply_add(T::lift(1.0), v, &mut place.p);
        work.place.measure(&mass);
        work.align::<Convergence<T>>((system, &mass), t).map_err(StartError::Starter)?;
        let Arrival { place, gram, .. } = &mut work;
        fill(gram, [&place.rows, &place.solved], &place.squares);
        gram.factor().map_err(named).map_err(StartError::Starter)?;
        let is_positive = gram.is_positive();
        let mut refinement = Refinement::for_light_coordinates(system, [q, v], t);
        if let Some(refinement) = &mut refinement {
            work.refine(system, &mass, t, refinement).map_err(StartError::Starter)?;
        }
        let mut point = Point::new(system);
        point.here.restore(&work.place);
        point.here.impulses = Impulses::new(system);
        let is_metric = mass.reciprocals().is_some_and(|all| all.iter().all(|&one| one > T::lift(0.0)));
        Ok(RattleMemory { point, mass, is_metric, is_positive, refinement, work })
    }

    #[inline]
    fn step(&self, step: Step<'_, S, T>, memory: &mut Self::Memory) -> Result<(), StepFailure> {
        let Step { system, q, t, h, statistics } = step;
        let one = Steps { system, q, clock: Clock::new(t, h), count: 1, statistics };
        if memory.strides(system) && self.stride(one, memory) == Some(1) {
            return Ok(());
        }
        self.take(Step { system, q, t, h, statistics }, memory)
    }

    #[inline]
    fn steps(&self, steps: Steps<'_, S, T>, memory: &mut Self::Memory) -> Result<(), StepFailure> {
        let Steps { system, q, clock, count, statistics } = steps;
        let (mut taken, mut strides) = (0, memory.strides(system));
        while taken < count {
            if strides {
                let (clock, count) = (clock.after(taken), count - taken);
                let more = self.stride(Steps { system, q, clock, count, statistics }, memory);
                // What leads to no number is taken again step by step, to see where it arises.
                strides = more.is_some();
                taken += more.unwrap_or(0);
                statistics.steps += more.unwrap_or(0);
            }
            if taken < count {
                let (t, h) = (clock.after(taken).time(), clock.step_size());
                self.take(Step { system, q, t, h, statistics }, memory)?;
                taken += 1;
                statistics.steps += 1;
            }
        }
        Ok(())
    }

    fn velocity(
        &self,
        _here: Here<'_, S, T>,
        memory: &Self::Memory,
        v: &mut Vector<S, T>,
    ) -> Result<(), StepFailure> {
        memory.mass.solve(&memory.point.here.p, v);
        Ok(())
    }
}

impl<S: HolonomicLagrangian<T> + Separable<T>, T: Real> VariableStep<S, T> for Rattle {
    type SuitedToAnyStep<X> = <Self as Method<S, T>>::Suited<X>;
}
