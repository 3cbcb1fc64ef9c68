//! What a run of the σ-family carries from step to step.
//!
//! The increment of a step is Δ = K⁻¹c0 + s. If α is affine, K = σDα − (1−σ)(Dα)ᵀ is constant, the first part
//! alternates with the defect, and s = −(1−σ)h K⁻¹∇H(q_σ) is smooth. If not, the first part is left out, and
//! s is Δ. The history extrapolates s.

use super::parasitic_mode::{Monitor, ParasiticMode};
use crate::discrete::OneNode;
use crate::mechanics::combination::{Inverse, Product};
use crate::mechanics::orientation::FormOrientation;
use crate::memory::lasting;
use crate::solve::Ladder;
use crate::space::scratch;
use crate::state::history::History;
use crate::state::summation;
use crate::{DegenerateLagrangian, Linear, Real, System, Vector};

/// What a run of the σ-family carries from step to step: its defect, its guesses, the measured parasitic
/// mode.
#[derive(Debug)]
pub struct SigmaMemory<S: System, T: Real> {
    pub(super) carried: Carried<S, T>,
    /// With the matrix of Newton's method. Explicit steps do not use it.
    pub(super) ladder: Ladder<Linear<S, T>>,
    pub(super) monitor: Monitor<S, T>,
}

/// The state (q, c) of the two-step map without q, and what its steps are computed with.
#[derive(Debug)]
pub(super) struct Carried<S: System, T: Real> {
    /// c = p − α(q) at the current point.
    pub(super) defect: Vector<S, T>,
    /// Whether c = 0 for all times, so that nothing needs to be done about it.
    pub(super) defect_vanishes: bool,
    /// α at the current point; kept if α is not affine.
    pub(super) one_form: Vector<S, T>,
    /// The last s.
    pub(super) history: History<S, T>,
    /// That of K times `scale`: constant if α is affine, and else frozen for one step.
    pub(super) inverse: Inverse<S, T>,
    pub(super) scale: T,
    /// K' = σ(Dα)ᵀ − (1−σ)Dα; not if σ = ½, where c is just reversed, nor beside `leaps`.
    pub(super) product: Option<Product<S, T>>,
    /// Where σ = 0.
    pub(super) leaps: Option<Leaps<S, T>>,
    pub(super) l_d: OneNode<S, T>,
    pub(super) orientation: FormOrientation<S, T>,
    /// What rounding has left out of the coordinates, if α is affine and σ neither 0 nor 1.
    pub(super) rest: summation::Carried<S, T>,
    pub(super) work: Work<S, T>,
}

/// Vectors that are written before they are read in each step.
#[derive(Debug)]
pub(super) struct Work<S: System, T: Real> {
    /// K⁻¹c0
    pub(super) shift: Vector<S, T>,
    /// s; Δ for Newton's method.
    pub(super) increment: Vector<S, T>,
    pub(super) trial: Vector<S, T>,
    /// In which iterations judge coordinates.
    pub(super) weights: Vector<S, T>,
    /// (D₁ + D₂)L_d; where α is affine and sums are compensated, what rounding leaves out of s.
    pub(super) sum: Vector<S, T>,
    pub(super) next: Vector<S, T>,
}

/// What steps with σ = 0 take.
#[derive(Debug)]
pub(super) struct Leaps<S: System, T: Real> {
    /// K' = −Dα.
    pub(super) product: Product<S, T>,
    /// The point before, q0 + K⁻¹c0.
    pub(super) before: Vector<S, T>,
}

lasting!([S: System, T: Real] Leaps<S, T>, T; numbers before);

lasting!([S: System, T: Real] SigmaMemory<S, T>, T; part carried, part ladder, part monitor);

lasting!([S: System, T: Real] Carried<S, T>, T;
    numbers defect, flag defect_vanishes, numbers one_form, parts leaps, part history,
    part orientation, part rest);

impl<S: System, T: Real> SigmaMemory<S, T> {
    /// c = p − α(q) at the current point, one entry per coordinate: the parasitic mode in p if σ = ½ and α
    /// is affine. Elsewhere c is of order h(1 − 2σ) on an orbit without such a mode.
    pub fn defect(&self) -> &[T] {
        &self.carried.defect
    }

    /// The parasitic mode as it was measured last, over five consecutive points; `None` before that. It is
    /// measured before each step; if α is affine, after 4 to 256 steps, the sooner the larger the mode and
    /// the longer the steps; without a limit, or where α is affine and σ = ½, before every 256th step.
    pub fn parasitic_mode(&self) -> Option<ParasiticMode<T>> {
        self.monitor.last().map(|(_, mode)| mode)
    }
}

impl<S: DegenerateLagrangian<T>, T: Real> Carried<S, T> {
    /// Sets `work.shift` to K⁻¹c0.
    #[inline]
    pub(super) fn shift_by_defect(&mut self, system: &S) {
        let Self { defect, inverse, scale, work, .. } = self;
        scratch!(scaled = system, work.trial);
        for (scaled, &c) in scaled.iter_mut().zip(defect.iter()) {
            *scaled = c * *scale;
        }
        inverse.solve(system, scaled, &mut work.shift);
    }
}
