//! What a run of the σ-family carries from step to step.
//!
//! For affine α the increment splits as Δ = K⁻¹c0 + s, K = σDα − (1−σ)(Dα)ᵀ, where the first part
//! alternates with the defect and s = −(1−σ)h K⁻¹∇H is smooth; the history extrapolates s. For
//! nonlinear α it extrapolates Δ.

use super::monitor::{Monitor, Pace, ParasiticMode};
use super::{Sigma, Step, affine, nonlinear};
use crate::discrete::{DiscreteLagrangian, Ends, Interval, OneNode, Span};
use crate::error::{StartError, StepFailure};
use crate::mechanics::combination::{Combination, Inverse, Product};
use crate::mechanics::orientation::FormOrientation;
use crate::mechanics::pattern::of_second_derivatives;
use crate::memory::{Memory, lasting};
use crate::solve::{Ladder, Solver};
use crate::space::scratch;
use crate::state::Statistics;
use crate::state::history::History;
use crate::state::summation::Carried;
use crate::{DegenerateLagrangian, Lagrangian, Linear, Real, Space, System, Vector};

/// What a run of the σ-family carries from step to step: its defect, its guesses, the measured parasitic
/// mode.
#[derive(Debug)]
pub struct SigmaMemory<S: System, T: Real> {
    /// c = p − α(q) at the current point.
    pub(super) defect: Vector<S, T>,
    /// Whether c = 0 for all times, so that nothing needs to be done about it.
    pub(super) defect_vanishes: bool,
    /// α at the current point; kept if α is not affine.
    pub(super) one_form: Vector<S, T>,
    pub(super) history: History<S, T>,
    /// The matrix of the fixed point: constant if α is affine, and else frozen for one step.
    pub(super) inverse: Inverse<S, T>,
    /// −1/((1−σ)h), the scale of `inverse` if α is affine and σ ≠ 1.
    pub(super) scale: T,
    /// K' = σ(Dα)ᵀ − (1−σ)Dα; kept if α is affine and c is not just reversed.
    pub(super) product: Option<Product<S, T>>,
    /// Kept if α is affine and σ = 0.
    pub(super) ahead: Option<Ahead<S, T>>,
    pub(super) l_d: OneNode<S, T>,
    /// With the matrix of Newton's method. Explicit steps do not use it.
    pub(super) ladder: Ladder<Linear<S, T>>,
    pub(super) monitor: Monitor<S, T>,
    pub(super) orientation: FormOrientation<S, T>,
    /// What rounding has left out of the coordinates, if α is affine and σ neither 0 nor 1.
    pub(super) carried: Carried<S, T>,
    pub(super) work: Work<S, T>,
}

/// Vectors that are written before they are read in each step.
#[derive(Debug)]
pub(super) struct Work<S: System, T: Real> {
    /// K⁻¹c0; p0 if α is not affine.
    pub(super) shift: Vector<S, T>,
    /// q0 + K⁻¹c0, which outlives the step, if α is affine and σ = 0.
    pub(super) ahead: Vector<S, T>,
    /// The smooth part of the increment.
    pub(super) increment: Vector<S, T>,
    pub(super) trial: Vector<S, T>,
    /// In which iterations judge coordinates.
    pub(super) weights: Vector<S, T>,
    /// (D₁ + D₂)L_d
    pub(super) sum: Vector<S, T>,
    pub(super) next: Vector<S, T>,
}

impl<S: Lagrangian<T>, T: Real> Work<S, T> {
    fn new(system: &S) -> Self {
        let vector = || system.space().vector();
        Self {
            shift: vector(),
            ahead: vector(),
            increment: vector(),
            trial: vector(),
            weights: vector(),
            sum: vector(),
            next: vector(),
        }
    }
}

/// How the point ahead, q1 + K⁻¹c1, follows from q0 and q1.
#[derive(Debug)]
pub(super) enum Ahead<S: System, T: Real> {
    /// It is q0.
    Reversal,
    /// K⁻¹c1 is a multiple of Δ in each coordinate.
    Diagonal(Vector<S, T>),
    /// By a product and a solve, with storage for Δ and c1.
    General([Vector<S, T>; 2]),
}

impl<S: DegenerateLagrangian<T>, T: Real> Ahead<S, T> {
    /// For c1 = `product` Δ and K⁻¹c = `scale` `inverse` c.
    pub(super) fn new(system: &S, product: &Product<S, T>, inverse: &Inverse<S, T>, scale: T) -> Self {
        let [mut delta, mut c]: [Vector<S, T>; 2] = [system.space().vector(), system.space().vector()];
        if !S::MATCHING {
            return Self::General([delta, c]);
        }
        delta.fill(scale);
        product.apply(system, &delta, &mut c);
        let mut factors = delta;
        inverse.solve(system, &c, &mut factors);
        let reversal = factors.iter().all(|&factor| factor == T::lift(-1.0));
        if reversal { Self::Reversal } else { Self::Diagonal(factors) }
    }
}

impl<S: System, T: Real> Memory<T> for SigmaMemory<S, T> {
    lasting!(
        T;
        numbers defect, flag defect_vanishes, numbers one_form, part history, part ladder, part monitor, part orientation,
        part carried, part work,
    );
}

impl<S: System, T: Real> Memory<T> for Work<S, T> {
    lasting!(T; numbers ahead);
}

impl<S: System, T: Real> SigmaMemory<S, T> {
    /// c = p − α(q) at the current point, one entry per coordinate.
    pub fn defect(&self) -> &[T] {
        &self.defect
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
        crate::scalar::norm::largest(&self.defect)
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
        memory.defect_vanishes = true;
        if S::AFFINE && method.sigma != T::lift(1.0) {
            // The first increment is about that of the field where the run begins.
            let Self { inverse, history, l_d, work, .. } = &mut memory;
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
        q0: &Vector<S, T>,
        q1: &Vector<S, T>,
        t: T,
        h: T,
    ) -> Result<Self, StartError> {
        let mut memory = Self::new(system, method, q0, t, h)?;
        let work = &mut memory.work;
        for i in 0..q0.len() {
            work.increment[i] = q1[i] - q0[i];
        }
        // c0 = p0 − α(q0) = −D₁L_d − α(q0).
        let (mut unused, mut sum) = (Statistics::default(), system.space().vector());
        let ends = Ends { q0, delta: &work.increment };
        let span = Span { system, interval: Interval { t, h }, ends };
        system.one_form(q0, t, &mut memory.one_form);
        memory.defect.copy_from_slice(&memory.one_form);
        let derivatives = memory.l_d.derivatives(span, &mut memory.defect, &mut sum, &mut unused);
        derivatives.map_err(StartError::Starter)?;
        memory.defect.iter_mut().for_each(|c| *c = -*c);
        crate::scalar::norm::finite(&memory.defect).map_err(StartError::Starter)?;
        memory.aim(system, method, q0);
        Ok(memory)
    }

    /// Prepares the first step from `q` with the present defect, by about `work.increment`.
    fn aim(&mut self, system: &S, method: &Sigma<T>, q: &[T]) {
        if S::AFFINE && method.sigma != T::lift(1.0) {
            self.shift_by_defect(system);
            let work = &mut self.work;
            for i in 0..q.len() {
                work.increment[i] -= work.shift[i];
                work.ahead[i] = q[i] + work.shift[i];
            }
        }
        self.history.begin_again(&self.work.increment);
    }

    fn new(system: &S, method: &Sigma<T>, q: &Vector<S, T>, t: T, h: T) -> Result<Self, StartError> {
        let (space, sigma) = (system.space(), method.sigma);
        let left = T::lift(1.0) - sigma;
        let explicit = if S::AFFINE { method.is_end() } else { sigma == T::lift(0.0) };
        let combination = fixed_point_matrix::<S, T>(method, h);
        let mut inverse = Inverse::new(system, q, t, combination);
        let rest: Vector<S, T> = space.vector();
        let mut work = Work::new(system);
        if S::AFFINE {
            let mut unused = Statistics::default();
            inverse
                .prepare(system, q, t, combination, &mut work.trial, &mut unused)
                .map_err(StartError::Starter)?;
        }
        let product = (S::AFFINE && !method.is_midpoint())
            .then(|| Product::new(system, q, t, Combination { a: -left, b: sigma }));
        let scale = fixed_point_scale(method, h);
        let ahead = product
            .as_ref()
            .filter(|_| sigma == T::lift(0.0))
            .map(|product| Ahead::new(system, product, &inverse, scale));
        let solver = if explicit { Solver::FixedPoint } else { method.solver.in_numbers::<T>() };
        let mut one_form = space.vector();
        system.one_form(q, t, &mut one_form);
        let (limit, pace) = pace(system, method, q, t);
        Ok(Self {
            defect: space.vector(),
            defect_vanishes: false,
            one_form,
            history: History::new(system, None),
            inverse,
            scale,
            product,
            ahead,
            l_d: OneNode::new(system, sigma),
            ladder: Ladder::new(solver, || of_second_derivatives(system, q, &rest, t, solver.storing())),
            monitor: Monitor::new(system, limit, pace),
            orientation: FormOrientation::new(system, q, t),
            carried: Carried::new(system, method.summation),
            work,
        })
    }

    /// Prepares a step that is a part of one of the length `whole`. On a smooth orbit the defect is of first
    /// order in that length and, if σ = ½, of second, so that its first term is taken for the whole.
    pub(super) fn shorten(
        &mut self,
        step: &Step<'_, S, T>,
        q: &Vector<S, T>,
        whole: T,
    ) -> Result<(), StepFailure> {
        let Step { system, method, t, h } = *step;
        if S::AFFINE {
            let (matrix, unused) = (fixed_point_matrix::<S, T>(method, h), &mut Statistics::default());
            self.inverse.prepare(system, q, t, matrix, &mut self.work.trial, unused)?;
            self.scale = fixed_point_scale(method, h);
        }
        let part = h / whole;
        let factor = if method.is_midpoint() { part * part } else { part };
        self.defect.iter_mut().for_each(|c| *c *= factor);
        self.ladder.begin_again();
        self.work.increment.fill(T::lift(0.0));
        self.aim(system, method, q);
        Ok(())
    }

    /// Takes one step from `q`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn step(
        &mut self,
        step: &Step<'_, S, T>,
        q: &mut Vector<S, T>,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        if S::AFFINE {
            affine::step(step, self, q, statistics)
        } else {
            nonlinear::step(step, self, q, statistics)
        }
    }

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

/// The limit of the parasitic mode, and when the mode is measured.
fn pace<S: DegenerateLagrangian<T>, T: Real>(
    system: &S,
    method: &Sigma<T>,
    q: &[T],
    t: T,
) -> (Option<f64>, Pace) {
    let one = T::lift(1.0);
    match method.parasitic_limit {
        // The mode is only reversed.
        _ if S::AFFINE && method.is_midpoint() => (None, Pace::Seldom),
        None => (None, Pace::Seldom),
        // Where Dα is antisymmetric, K' = −K: c is reversed, and a gradient added to it.
        limit
            if S::AFFINE && Product::new(system, q, t, Combination { a: one, b: one }).vanishes(system) =>
        {
            (limit, Pace::WithTheFlow)
        }
        limit => (limit, Pace::EachStep),
    }
}

/// Affine and σ ≠ 1: K times −1/((1−σ)h), whose inverse maps ∇H to s. Else K.
/// Nonlinear and σ = 0: (Dα)ᵀ.
pub(super) fn fixed_point_matrix<S: DegenerateLagrangian<T>, T: Real>(
    method: &Sigma<T>,
    h: T,
) -> Combination<T> {
    let sigma = method.sigma;
    let left = T::lift(1.0) - sigma;
    if S::AFFINE && sigma != T::lift(1.0) {
        let scale = fixed_point_scale(method, h);
        Combination { a: sigma * scale, b: -left * scale }
    } else if !S::AFFINE && sigma == T::lift(0.0) {
        Combination { a: T::lift(0.0), b: T::lift(1.0) }
    } else {
        Combination { a: sigma, b: -left }
    }
}

fn fixed_point_scale<T: Real>(method: &Sigma<T>, h: T) -> T {
    T::lift(-1.0) / ((T::lift(1.0) - method.sigma) * h)
}
