//! What a run of the σ-family carries from step to step.
//!
//! The increment of a step is Δ = K⁻¹c0 + s. If α is affine, K = σDα − (1−σ)(Dα)ᵀ is constant, the first part
//! alternates with the defect, and s = −(1−σ)h K⁻¹∇H(q_σ) is smooth. If not, the first part is left out, and
//! s is Δ. The history extrapolates s.

use super::Sigma;
use super::parasitic_mode::{Monitor, Pace, ParasiticMode};
use crate::discrete::{DiscreteLagrangian, Ends, Interval, OneNode, Span};
use crate::error::{StartError, StepFailure};
use crate::mechanics::combination::{Combination, Inverse, Product};
use crate::mechanics::orientation::FormOrientation;
use crate::mechanics::pattern::of_second_derivatives;
use crate::memory::{Memory, lasting};
use crate::scalar::norm;
use crate::scalar::passes::add;
use crate::solve::{Ladder, Solver};
use crate::space::scratch;
use crate::state::Statistics;
use crate::state::history::History;
use crate::state::summation;
use crate::{DegenerateLagrangian, Linear, Real, Space, System, Vector};

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
    /// K' = σ(Dα)ᵀ − (1−σ)Dα, if α is affine; not if σ = ½, where c is just reversed, nor beside `leaps`.
    pub(super) product: Option<Product<S, T>>,
    /// Where σ = 0 and Dα is constant and antisymmetric.
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

/// What steps with σ = 0 take where Dα is antisymmetric.
#[derive(Debug)]
pub(super) struct Leaps<S: System, T: Real> {
    /// K' = −Dα.
    pub(super) product: Product<S, T>,
    /// The point before, q0 + K⁻¹c0.
    pub(super) before: Vector<S, T>,
}

impl<S: System, T: Real> Memory<T> for Leaps<S, T> {
    lasting!(T; numbers before);
}

impl<S: System, T: Real> Memory<T> for SigmaMemory<S, T> {
    lasting!(T; part carried, part ladder, part monitor);
}

impl<S: System, T: Real> Memory<T> for Carried<S, T> {
    lasting!(
        T;
        numbers defect, flag defect_vanishes, numbers one_form, parts leaps, part history,
        part orientation, part rest,
    );
}

impl<S: System, T: Real> SigmaMemory<S, T> {
    /// c = p − α(q) at the current point, one entry per coordinate.
    pub fn defect(&self) -> &[T] {
        &self.carried.defect
    }

    /// The parasitic mode as it was measured last, over five consecutive points; `None` before that. It is
    /// measured before each step; if Dα is constant and antisymmetric, after 4 to 256 steps, the sooner the
    /// larger the mode and the longer the steps; without a limit, or where α is affine and σ = ½, before
    /// every 256th step.
    pub fn parasitic_mode(&self) -> Option<ParasiticMode<T>> {
        self.monitor.latest()
    }

    /// max |c|: the amplitude of the parasitic mode in p if σ = ½ and α is affine. Elsewhere c is of order
    /// h(1 − 2σ) on an orbit without such a mode, and says little of it; take
    /// [`parasitic_mode`](Self::parasitic_mode).
    pub fn parasitic_amplitude(&self) -> T {
        norm::largest(self.defect())
    }
}

impl<S: DegenerateLagrangian<T>, T: Real> SigmaMemory<S, T> {
    /// For a run on the constraint p = α(q) that stays on it.
    pub(super) fn without_defect(
        system: &S,
        method: &Sigma<T>,
        q: &Vector<S, T>,
        t: T,
        h: T,
    ) -> Result<Self, StartError> {
        let mut memory = Self::new(system, method, q, t, h)?;
        let Carried { defect_vanishes, inverse, history, l_d, work, .. } = &mut memory.carried;
        *defect_vanishes = true;
        if S::AFFINE && method.sigma != T::lift(1.0) {
            // The first increment is about that of the field where the run begins.
            system.hamiltonian_gradient(q, t, &mut l_d.work.gradient);
            inverse.solve(system, &l_d.work.gradient, &mut work.increment);
            history.begin_again(&work.increment);
        }
        Ok(memory)
    }

    /// For a run whose first step leads from `q0` to `q1`: p0 = −D₁L_d(q0, q1).
    pub(super) fn between(
        system: &S,
        method: &Sigma<T>,
        [q0, q1]: [&Vector<S, T>; 2],
        t: T,
        h: T,
    ) -> Result<Self, StartError> {
        let mut memory = Self::new(system, method, q0, t, h)?;
        let Carried { defect, one_form, l_d, work: Work { increment, sum, .. }, .. } = &mut memory.carried;
        for i in 0..q0.len() {
            increment[i] = q1[i] - q0[i];
        }
        // c0 = p0 − α(q0) = −D₁L_d − α(q0).
        defect.copy_from_slice(one_form);
        let span = Span { system, interval: Interval { t, h }, ends: Ends { q0, delta: increment } };
        l_d.derivatives(span, defect, sum, &mut Statistics::default()).map_err(StartError::Starter)?;
        defect.iter_mut().for_each(|c| *c = -*c);
        norm::finite(defect).map_err(StartError::Starter)?;
        memory.aim(system, method, q0);
        Ok(memory)
    }

    fn new(system: &S, method: &Sigma<T>, q: &Vector<S, T>, t: T, h: T) -> Result<Self, StartError> {
        let (space, sigma) = (system.space(), method.sigma);
        let explicit = if S::AFFINE { method.is_end() } else { sigma == T::lift(0.0) };
        let (scale, matrix) = scaled_matrix::<S, T>(method, h);
        let mut inverse = Inverse::new(system, q, t, matrix);
        let [shift, increment, mut trial, weights, sum, next, rest, mut one_form] = space.vectors();
        if S::AFFINE {
            let unused = &mut Statistics::default();
            inverse.prepare(system, q, t, matrix, &mut trial, unused).map_err(StartError::Starter)?;
        }
        let one = T::lift(1.0);
        let product = (S::AFFINE && !method.is_midpoint())
            .then(|| Product::new(system, q, t, Combination { a: sigma - one, b: sigma }));
        let symmetric = Combination { a: one, b: one };
        let reverses = S::AFFINE && Product::new(system, q, t, symmetric).vanishes(system);
        let (leaps, product) = match product {
            Some(product) if reverses && sigma == T::lift(0.0) => {
                (Some(Leaps { product, before: space.vector() }), None)
            }
            product => (None, product),
        };
        let solver = if explicit { Solver::FixedPoint } else { method.solver.in_numbers::<T>() };
        let newton = || of_second_derivatives(system, q, &rest, t, solver.storing());
        system.one_form(q, t, &mut one_form);
        let (limit, pace) = match method.parasitic_limit {
            // The mode is only reversed.
            _ if S::AFFINE && method.is_midpoint() => (None, Pace::Seldom),
            None => (None, Pace::Seldom),
            // K' = −K: c is reversed, and a gradient added to it.
            limit if reverses => (limit, Pace::WithTheFlow),
            limit => (limit, Pace::EachStep),
        };
        Ok(Self {
            ladder: Ladder::new(solver, newton),
            monitor: Monitor::new(system, limit, pace),
            carried: Carried {
                defect: space.vector(),
                defect_vanishes: false,
                one_form,
                history: History::new(system, None),
                inverse,
                scale,
                product,
                leaps,
                l_d: OneNode::new(system, sigma),
                orientation: FormOrientation::new(system, q, t),
                rest: summation::Carried::new(system, method.summation),
                work: Work { shift, increment, trial, weights, sum, next },
            },
        })
    }

    /// Prepares the first step from `q` with the present defect, by about `work.increment`.
    fn aim(&mut self, system: &S, method: &Sigma<T>, q: &[T]) {
        let carried = &mut self.carried;
        if S::AFFINE && method.sigma != T::lift(1.0) {
            carried.shift_by_defect(system);
            let Work { shift, increment, .. } = &mut carried.work;
            for i in 0..q.len() {
                increment[i] -= shift[i];
            }
            if let Some(Leaps { before, .. }) = &mut carried.leaps {
                add(q, shift, before);
            }
        }
        carried.history.begin_again(&carried.work.increment);
    }

    /// Prepares a step of length `h` that is a part of one of the length `whole`. On a smooth orbit the
    /// defect is of first order in that length and, if σ = ½, of second, so that its first term is taken for
    /// the whole.
    pub(super) fn shorten(
        &mut self,
        system: &S,
        method: &Sigma<T>,
        q: &Vector<S, T>,
        t: T,
        [h, whole]: [T; 2],
    ) -> Result<(), StepFailure> {
        let Carried { defect, inverse, scale, work, .. } = &mut self.carried;
        if S::AFFINE {
            let matrix;
            (*scale, matrix) = scaled_matrix::<S, T>(method, h);
            inverse.prepare(system, q, t, matrix, &mut work.trial, &mut Statistics::default())?;
        }
        let part = h / whole;
        let factor = if method.is_midpoint() { part * part } else { part };
        defect.iter_mut().for_each(|c| *c *= factor);
        work.increment.fill(T::lift(0.0));
        self.ladder.begin_again();
        self.aim(system, method, q);
        Ok(())
    }
}

impl<S: DegenerateLagrangian<T>, T: Real> Carried<S, T> {
    /// Sets `work.shift` to K⁻¹c0.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn shift_by_defect(&mut self, system: &S) {
        let Self { defect, inverse, scale, work, .. } = self;
        scratch!(scaled = system, work.trial);
        for (scaled, &c) in scaled.iter_mut().zip(defect.iter()) {
            *scaled = c * *scale;
        }
        inverse.solve(system, scaled, &mut work.shift);
    }
}

/// The scale of the matrix that is inverted, and the matrix, K times it. If α is affine and σ ≠ 1, the scale
/// is −1/((1−σ)h), so that the inverse maps ∇H to s; else one.
pub(super) fn scaled_matrix<S: DegenerateLagrangian<T>, T: Real>(
    method: &Sigma<T>,
    h: T,
) -> (T, Combination<T>) {
    let (sigma, one) = (method.sigma, T::lift(1.0));
    let left = one - sigma;
    let scale = if S::AFFINE && sigma != one { -one / (left * h) } else { one };
    (scale, Combination { a: sigma * scale, b: -left * scale })
}
