//! What a run with interior displacements carries from step to step.

use super::coefficients::Coefficients;
use super::interior::{Departure, InteriorNodes};
use super::steps::Step;
use crate::discrete::frequency::{FrequencyIn, Local};
use crate::error::{StartError, StepFailure};
use crate::mechanics::pattern::coupled_by_second_derivatives;
use crate::mechanics::phase::{Arrival, Increments, Inertial, PhasePoint};
use crate::memory::{Aside, Memory, lasting};
use crate::methods::collocation::lobatto::Lobatto;
use crate::scalar::norm;
use crate::solve::{Ladder, Solver};
use crate::space::Storing;
use crate::state::Statistics;
use crate::state::history::History;
use crate::{Coupled, Lagrangian, NondegenerateLagrangian, Real, Space, System, Vector};

/// Without a heap, a matrix of fixed size is made on the stack, where threads have two megabytes.
const MOST_BYTES: usize = 1 << 20;

/// The phase point of a run with interior displacements, its path between the points and its work space.
#[derive(Debug)]
pub struct GalerkinMemory<const NODES: usize, S: System, T: Real, I> {
    pub(super) ladder: Ladder<Aside<Coupled<NODES, S, T>>>,
    pub(super) path: Path<NODES, S, T, I>,
}

/// Where the run is, and how it goes on from there.
#[derive(Debug)]
pub(super) struct Path<const NODES: usize, S: System, T: Real, I> {
    pub(super) rule: Lobatto<NODES>,
    differentiation: [[f64; NODES]; NODES],
    pub(super) coefficients: Coefficients<NODES, T>,
    /// The frequencies at both ends of the step.
    ends: [Local<S, T>; 2],
    pub(super) phase: PhasePoint<S, T>,
    pub(super) inertial: Inertial<S, T>,
    /// The interior nodes, where L = ½ v·M v − V(q, t) and there is no frequency.
    pub(super) interior: Option<I>,
    /// Elsewhere, their displacements.
    displacements: Option<Displacements<NODES, S, T>>,
    pub(super) work: Work<NODES, S, T>,
}

/// δ/h² of each interior node, of the last steps; the first and the last entry are not used.
#[derive(Debug)]
struct Displacements<const NODES: usize, S: System, T: Real> {
    nodes: [History<S, T>; NODES],
}

impl<const NODES: usize, S: System, T: Real> Memory<T> for Displacements<NODES, S, T> {
    lasting!(T; parts nodes);
}

/// Vectors that are written before they are read in each step.
#[derive(Debug)]
pub(super) struct Work<const NODES: usize, S: System, T: Real> {
    /// q0, the displacements of the interior nodes, and Δ.
    pub(super) unknowns: [Vector<S, T>; NODES],
    /// (D₁ + D₂)L_d, ∂L_d/∂δ of the interior nodes, and p0 + D₁L_d; then the corrections of the unknowns.
    pub(super) residuals: [Vector<S, T>; NODES],
    /// In which iterations judge coordinates.
    pub(super) weights: Vector<S, T>,
    pub(super) point: Vector<S, T>,
    pub(super) velocity: Vector<S, T>,
    /// ∂L/∂q at a node.
    pub(super) gradient: Vector<S, T>,
    /// ∂L/∂v at a node, or p1.
    pub(super) momentum: Vector<S, T>,
    pub(super) next: Vector<S, T>,
    /// ∂L/∂q at q0 and at q1.
    pub(super) first_force: Vector<S, T>,
    pub(super) next_force: Vector<S, T>,
}

impl<const NODES: usize, S: NondegenerateLagrangian<T>, T: Real, I: InteriorNodes<NODES, S, T>>
    GalerkinMemory<NODES, S, T, I>
{
    /// p = ∂L/∂v at the current point, one entry per coordinate.
    pub fn p(&self) -> &[T] {
        &self.path.phase.p
    }

    pub(super) fn new<F: FrequencyIn<T>, E>(
        step: &Step<'_, NODES, S, F, T, E>,
        q: &Vector<S, T>,
        v: &[T],
    ) -> Result<Self, StartError> {
        let Step { system, method, t, .. } = *step;
        let rule = Lobatto::new();
        let a = rule.differentiation();
        let solver = match method.solver.in_numbers::<T>() {
            // Any L has no fixed point.
            Solver::Automatic if !S::SEPARABLE => Solver::Newton,
            solver => solver,
        };
        if solver != Solver::FixedPoint && size_of::<Coupled<NODES, S, T>>() > MOST_BYTES {
            let reason = "its matrix for so many nodes and coordinates takes more than a megabyte of the stack; take \
                          Solver::FixedPoint, fewer nodes, or a heap: the feature `alloc`";
            return Err(StartError::Unsupported { option: "Newton's method", reason });
        }
        let reading = method.frequency.reading();
        let eliminates = S::SEPARABLE && F::UNFITTED;
        let histories = || Displacements { nodes: core::array::from_fn(|_| History::new(system, None)) };
        let mut path = Path {
            rule,
            differentiation: a,
            coefficients: Coefficients::new(&rule, &a, T::lift(0.0)).map_err(StartError::Starter)?,
            ends: [Local::new(system, reading), Local::new(system, reading)],
            phase: PhasePoint::new(system, q, v, t, method.summation)?,
            inertial: Inertial::new(system, q, v, t)?,
            interior: eliminates.then(|| I::new(system)),
            displacements: (!eliminates).then(histories),
            work: Work::new(system),
        };
        if reading.is_none() {
            path.fit(method.frequency.fixed() * step.h).map_err(StartError::Starter)?;
        }
        let matrix = || newton_matrix(system, [q, v], t, solver.storing());
        let ladder = Ladder::new(solver, matrix);
        Ok(Self { ladder, path })
    }
}

/// Storage for the equations of Newton's method, apart from the rest: with nine nodes it is some 80 n²
/// numbers for n coordinates.
#[inline(never)]
fn newton_matrix<const NODES: usize, S: Lagrangian<T>, T: Real>(
    system: &S,
    points: [&[T]; 2],
    t: T,
    storing: Storing,
) -> Aside<Coupled<NODES, S, T>> {
    let matrix = coupled_by_second_derivatives(system, points, t, NODES - 1, storing);
    #[cfg(feature = "alloc")]
    let matrix = Aside::new(matrix);
    matrix
}

impl<const NODES: usize, S: System, T: Real, I: Memory<T>> Memory<T> for GalerkinMemory<NODES, S, T, I> {
    lasting!(T; part path, part ladder);
}

impl<const NODES: usize, S: System, T: Real, I: Memory<T>> Memory<T> for Path<NODES, S, T, I> {
    lasting!(T; part phase, part inertial, parts interior, parts displacements);
}

impl<const NODES: usize, S: NondegenerateLagrangian<T>, T: Real, I: InteriorNodes<NODES, S, T>>
    Path<NODES, S, T, I>
{
    /// Sets `v` to the velocity at the present point.
    pub(super) fn velocity(&self, system: &S, q: &[T], t: T, v: &mut [T]) -> Result<(), StepFailure> {
        self.inertial.velocity(system, &self.phase, q, t, v)
    }

    /// Sets the unknowns to their guess. Where there are interior nodes, the step before is continued. Else
    /// they are extrapolated from the steps before if these had about this length; if not, the path is
    /// straight, and its velocity is taken from the momentum if L is separable.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn guess<F, E>(&mut self, step: &Step<'_, NODES, S, F, T, E>, q: &[T]) {
        let Self { phase, inertial, interior, displacements, work, .. } = self;
        let similar = phase.extrapolates_to(step.h);
        let (before, last) = work.unknowns.split_at_mut(NODES - 1);
        let (start, inside) = before.split_at_mut(1);
        let increment = &mut last[0];
        start[0].copy_from_slice(q);
        if let (Some(interior), Some(mass)) = (interior, inertial.constant()) {
            interior.depart(&Departure { q, phase, mass, h: step.h });
            for k in 0..q.len() {
                [increment[k], _] = interior.increments(k);
                for (node, displacement) in inside.iter_mut().enumerate() {
                    displacement[k] = interior.displacement(node + 1, k, q[k], increment[k]);
                }
            }
            return;
        }
        let histories = displacements.iter().flat_map(|displacements| &displacements.nodes[1..]);
        for (displacement, history) in inside.iter_mut().zip(histories) {
            if similar {
                history.extrapolate(displacement);
                scale(displacement, step.h * step.h);
            } else {
                displacement.fill(T::lift(0.0));
            }
        }
        phase.guess(inertial.constant(), &phase.p, step.h, increment);
    }

    /// The coefficients for the frequency at the current unknowns.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn read_frequency<F: FrequencyIn<T>, E>(
        &mut self,
        step: &Step<'_, NODES, S, F, T, E>,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let frequency = &step.method.frequency;
        if F::UNFITTED {
            return self.fit(frequency.fixed() * step.h);
        }
        let ([start, end], Some(mass), Some(_)) =
            (&mut self.ends, self.inertial.constant(), frequency.reading())
        else {
            return self.fit(frequency.fixed() * step.h);
        };
        let Work { unknowns, velocity, next, next_force, .. } = &mut self.work;
        let (q, increment, per_h) = (&unknowns[0], &unknowns[NODES - 1], T::lift(1.0) / step.h);
        for i in 0..q.len() {
            next[i] = q[i] + increment[i];
            velocity[i] = increment[i] * per_h;
        }
        step.system.force(next, &[], step.node_time(1.0), next_force);
        statistics.gradients += 1;
        start.evaluate(frequency, mass, q, velocity, &self.phase.force)?;
        end.evaluate(frequency, mass, next, velocity, next_force)?;
        let omega = T::lift(0.5) * (start.omega + end.omega);
        self.fit(omega * step.h)
    }

    /// Adds an impulse to the momentum, which leads to about `velocity`.
    pub(super) fn jump(&mut self, impulse: &[T], velocity: &[T]) {
        self.phase.jump(impulse, velocity);
        if let Some(interior) = &mut self.interior {
            interior.forget();
        }
    }

    /// Makes the coefficients those for `u` = ωh, if they are not.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn fit(&mut self, u: T) -> Result<(), StepFailure> {
        if !self.coefficients.is_for(u) {
            self.coefficients = Coefficients::new(&self.rule, &self.differentiation, u)?;
        }
        Ok(())
    }

    /// Moves to `work.next`, `work.momentum` and `work.next_force` at the time `end`, if they are numbers
    /// and the mass matrix has kept its orientation. The increments are the last of the unknowns, and the
    /// first of the residuals.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn complete(
        &mut self,
        system: &S,
        [h, end]: [T; 2],
        q: &mut Vector<S, T>,
    ) -> Result<(), StepFailure> {
        let Work { next, momentum, first_force, next_force, velocity, unknowns, residuals, .. } =
            &mut self.work;
        let by = Increments { q: &unknowns[NODES - 1], p: &residuals[0] };
        norm::finite(next).and(norm::finite(momentum))?;
        self.inertial.check(system, [next, by.q], [end, h], velocity)?;
        let similar = self.phase.extrapolates_to(h);
        if self.interior.is_some() {
            first_force.copy_from_slice(&self.phase.force);
        }
        self.phase.advance(q, &Arrival { q: next, p: momentum, force: next_force }, by, h)?;
        if let Some(interior) = &mut self.interior {
            interior.remember(h, first_force);
        }
        let per_h = T::lift(1.0) / h;
        let histories = self.displacements.iter_mut().flat_map(|displacements| &mut displacements.nodes);
        for (history, displacement) in histories.zip(unknowns).take(NODES - 1).skip(1) {
            if !similar {
                history.clear();
            }
            history.push_scaled(displacement, per_h * per_h);
        }
        Ok(())
    }
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn scale<T: Real>(x: &mut [T], factor: T) {
    for x in x {
        *x *= factor;
    }
}

impl<const NODES: usize, S: Lagrangian<T>, T: Real> Work<NODES, S, T> {
    fn new(system: &S) -> Self {
        let vector = || system.space().vector();
        Self {
            unknowns: system.space().vectors(),
            residuals: system.space().vectors(),
            weights: vector(),
            point: vector(),
            velocity: vector(),
            gradient: vector(),
            momentum: vector(),
            next: vector(),
            first_force: vector(),
            next_force: vector(),
        }
    }
}
