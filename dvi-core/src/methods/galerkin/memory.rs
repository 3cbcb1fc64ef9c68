//! What a run with interior displacements carries from step to step.

use super::Galerkin;
use super::coefficients::Fit;
use super::interior::InteriorNodes;
use crate::discrete::frequency::{Frequency, Local};
use crate::error::StartError;
use crate::mechanics::pattern::coupled_by_second_derivatives;
use crate::memory::{Aside, Memory, lasting};
use crate::methods::step::{Carried, PhaseMemory};
use crate::solve::{Ladder, Solver};
use crate::space::Storing;
use crate::state::history::History;
use crate::{Coupled, Lagrangian, NondegenerateLagrangian, Real, Space, System, Vector};

/// Without a heap, a matrix of fixed size is made on the stack, where threads have two megabytes.
const MOST_BYTES: usize = 1 << 20;

/// What a run with interior displacements carries.
pub(super) type GalerkinMemory<const NODES: usize, S, T, I> =
    PhaseMemory<S, T, Path<NODES, S, T, I>, Aside<Coupled<NODES, S, T>>>;

/// The path of a step, and how the next one is guessed.
#[derive(Debug)]
pub struct Path<const NODES: usize, S: System, T: Real, I> {
    /// The interior nodes, where L = ½ v·M v − V(q, t) and there is no frequency.
    pub(super) interior: Option<I>,
    /// Elsewhere, and where Newton's method takes all steps, their displacements.
    pub(super) displacements: Option<Displacements<NODES, S, T>>,
    pub(super) fit: Fit<NODES, T>,
    /// The frequencies at both ends of the step.
    pub(super) ends: [Local<S, T>; 2],
    /// q0, the displacements of the interior nodes, and Δ.
    pub(super) unknowns: [Vector<S, T>; NODES],
    /// (D₁ + D₂)L_d, ∂L_d/∂δ of the interior nodes, and p0 + D₁L_d; then the corrections of the unknowns.
    pub(super) residuals: [Vector<S, T>; NODES],
    /// In which iterations judge coordinates, and work space.
    pub(super) weights: [Vector<S, T>; 2],
}

/// δ/h² of each interior node, of the last steps; the first and the last entry are not used.
#[derive(Debug)]
pub(super) struct Displacements<const NODES: usize, S: System, T: Real> {
    pub(super) nodes: [History<S, T>; NODES],
}

lasting!([const NODES: usize, S: System, T: Real] Displacements<NODES, S, T>, T; parts nodes);

lasting!([const NODES: usize, S: System, T: Real, I: Memory<T>] Path<NODES, S, T, I>, T;
    parts interior, parts displacements);

impl<const NODES: usize, F: Frequency, E> Galerkin<NODES, F, E> {
    /// Of a run from (q, v, t), whose steps have the length h.
    ///
    /// # Errors
    /// Those of [`Galerkin::validate`]; [`StartError::Unsupported`] where Newton's matrix is too large for
    /// the stack; [`StartError::Starter`].
    pub(super) fn depart_from<S: NondegenerateLagrangian<T>, T: Real, I: InteriorNodes<NODES, S, T>>(
        &self,
        system: &S,
        [q, v]: [&[T]; 2],
        [t, h]: [T; 2],
    ) -> Result<GalerkinMemory<NODES, S, T, I>, StartError> {
        self.validate::<S, T>(system)?;
        let solver = match self.solver.in_numbers::<T>() {
            // Any L has no fixed point.
            Solver::Automatic if !S::SEPARABLE => Solver::Newton,
            solver => solver,
        };
        if solver != Solver::FixedPoint && size_of::<Coupled<NODES, S, T>>() > MOST_BYTES {
            let reason = "its matrix for so many nodes and coordinates takes more than a megabyte of the stack; take \
                          Solver::FixedPoint, fewer nodes, or a heap: the feature `alloc`";
            return Err(StartError::Unsupported { option: "Newton's method", reason });
        }
        let (space, eliminates) = (system.space(), S::SEPARABLE && F::UNFITTED);
        let histories = || Displacements { nodes: core::array::from_fn(|_| History::new(system, None)) };
        let reading = self.frequency.reading();
        let carried = Carried::new(system, q, v, t, self.summation)?;
        let mut path = Path {
            interior: eliminates.then(|| I::new(system)),
            displacements: (!eliminates || matches!(solver, Solver::Newton | Solver::NewtonKrylov))
                .then(histories),
            fit: Fit::new(),
            ends: [Local::new(system), Local::new(system)],
            unknowns: space.vectors(),
            residuals: space.vectors(),
            weights: space.vectors(),
        };
        if reading.is_none() {
            path.fit.to(self.frequency.fixed::<T>() * h).map_err(StartError::Starter)?;
        }
        let ladder = Ladder::new(solver, || newton_matrix(system, [q, v], t, solver.storing()));
        Ok(PhaseMemory { carried, ladder, own: path })
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
    coupled_by_second_derivatives(system, points, t, NODES - 1, storing).into()
}
