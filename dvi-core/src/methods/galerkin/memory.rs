//! What a run with interior displacements carries from step to step.

use super::coefficients::Fit;
use crate::discrete::frequency::Local;
use crate::memory::{Aside, Memory, lasting};
use crate::methods::step::PhaseMemory;
use crate::state::history::History;
use crate::{Coupled, Real, System, Vector};

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
