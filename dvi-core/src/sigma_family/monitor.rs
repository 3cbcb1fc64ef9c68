//! The parasitic mode, measured: what of the second differences of a run alternates from step to step.
//!
//! D_k = q_{k−1} − 2q_k + q_{k+1}. On an alternating part (−1)ᵏa, D_{k−1} − 2D_k + D_{k+1} is 16a, and
//! D_{k−1} + 2D_k + D_{k+1} is nothing; on a smooth motion the second is 4h²q̈. The mode is compared with a quarter of
//! h²q̈, the size of what a step of second order neglects. Of a motion that turns by the angle θ in a step the ratio is
//! tan²(θ/2). The solution of a stable step with σ ≠ ½ has θ < π/2, and the parasitic mode is its mirror image, π − θ
//! (the two roots of Rowley & Marsden 2002, section 4.1, meet at θ = π/2).

use crate::error::StepFailure;
use crate::norm::{larger, reported};
use crate::walk::BLOCK;
use crate::{Lagrangian, Real, Scalar, Space, Vector};

/// How many points are kept besides the present one.
const KEPT: usize = 4;

/// An alternating part below this many units of rounding of the coordinates is noise.
const ROUNDING: f64 = 1024.0;

/// An alternating part below this fraction of the latest increment does no harm, however straight the path.
const HARMLESS: f64 = 1e-6;

/// How much of the size of a coordinate's second differences is forgotten from one look to the next.
const FORGOTTEN: f64 = 1.0 / 64.0;

/// The second differences of a coordinate count as no smaller than this fraction of the largest of all.
const FLOOR: f64 = 0.1;

/// A mode that is large from the first steps on, as it is where steps are long, may become this many times as large.
const GROWTH: f64 = 3.0;

/// By how many radians the motion turns while the mode may grow e-fold; from this follows when to look again.
const RADIANS: f64 = 4.0;

/// The parasitic mode at five consecutive points of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParasiticMode<T = f64> {
    /// The largest entry of a = (q_{k−2} − 4q_{k−1} + 6q_k − 4q_{k+1} + q_{k+2})/16: of an alternating part (−1)ᵏa,
    /// the largest entry of a; of a smooth motion, of (h⁴/16) q⁗. In units of the coordinates.
    pub amplitude: T,
    /// 4|a|/|s| in the Euclidean norm, where s is h²q̈ from second differences that do not see what alternates; or the
    /// largest 4|aᵢ|/sᵢ, if that is larger, where sᵢ is the largest of the points that were looked at, of which each
    /// look forgets 1/64, and at least a tenth of the largest of all coordinates. Of a smooth motion of frequency ω it
    /// is about (ωh/2)².
    pub relative: T,
    /// Whether the amplitude is more than rounding errors, 1024 ε max|q|, and more than 10⁻⁶ of the increment.
    pub is_significant: bool,
}

/// When a run is examined.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Pace {
    /// Before each step: the mode may grow by a factor from step to step.
    EachStep,
    /// Before the mode can have become too large, if it grows at a rate of the flow: after 4 to 256 steps.
    WithTheFlow,
    /// Before every 256th step: the mode does not grow, or nobody minds.
    Seldom,
}

/// The points from which the mode is measured.
#[derive(Debug)]
pub(super) struct Monitor<S: Lagrangian, T: Real> {
    /// The points before the present one; point k is at place k mod 4.
    points: [Vector<S, T>; KEPT],
    /// The size of the second differences of each coordinate.
    sizes: Vector<S, T>,
    /// The completed steps.
    pub(super) steps: u64,
    pace: Pace,
    /// The run is examined where the number of steps is a multiple of this power of two.
    period: u64,
    limit: Option<f64>,
    /// The last examination: before which step, what it measured, and the limit in force since the first.
    latest: Option<(u64, ParasiticMode<T>)>,
    in_force: f64,
}

impl<S: Lagrangian, T: Real> Monitor<S, T> {
    pub(super) fn new(system: &S, limit: Option<f64>, pace: Pace) -> Self {
        let vector = || system.space().vector();
        Self {
            points: core::array::from_fn(|_| vector()),
            sizes: vector(),
            steps: 0,
            pace,
            period: match pace {
                Pace::EachStep => 1,
                Pace::WithTheFlow => KEPT as u64,
                Pace::Seldom => BLOCK,
            },
            limit,
            latest: None,
            in_force: limit.unwrap_or(super::PARASITIC_LIMIT),
        }
    }

    pub(super) fn restore(&mut self, from: &Self) {
        for (point, from) in self.points.iter_mut().zip(&from.points) {
            point.copy_from_slice(from);
        }
        self.sizes.copy_from_slice(&from.sizes);
        (self.steps, self.period) = (from.steps, from.period);
        (self.latest, self.in_force) = (from.latest, from.in_force);
    }

    pub(super) fn latest(&self) -> Option<ParasiticMode<T>> {
        self.latest.map(|(_, mode)| mode)
    }

    /// The number of steps from one examination to the next, a power of two.
    #[inline(always)]
    pub(super) fn period(&self) -> u64 {
        self.period
    }

    /// Takes note of the point before the next step, if it is one of those that are looked at.
    ///
    /// # Errors
    /// [`StepFailure::ParasiticMode`] if the run is lost.
    #[inline(always)]
    pub(super) fn look(&mut self, q: &[T]) -> Result<(), StepFailure> {
        if (self.steps + KEPT as u64) & (self.period - 1) > KEPT as u64 {
            Ok(())
        } else {
            self.look_closely(q)
        }
    }

    #[inline(never)]
    fn look_closely(&mut self, q: &[T]) -> Result<(), StepFailure> {
        let verdict = if self.steps & (self.period - 1) == 0 { self.examine(self.steps, q) } else { Ok(()) };
        self.note(self.steps, q);
        verdict
    }

    /// Keeps point number `step`.
    #[inline(always)]
    pub(super) fn note(&mut self, step: u64, q: &[T]) {
        self.points[(step % KEPT as u64) as usize].copy_from_slice(q);
    }

    /// Measures the mode at `q`, point number `step`, and the four before it.
    ///
    /// # Errors
    /// [`StepFailure::ParasiticMode`] if the run is lost.
    #[inline(never)]
    pub(super) fn examine(&mut self, step: u64, q: &[T]) -> Result<(), StepFailure> {
        if step < KEPT as u64 {
            return Ok(());
        }
        let mode = match self.latest {
            // A step that failed is tried again.
            Some((last, mode)) if last == step => mode,
            _ => self.measure(step, q),
        };
        let relative = reported(mode.relative);
        match self.limit {
            Some(_) if mode.is_significant && relative > self.in_force => {
                let amplitude = reported(mode.amplitude);
                Err(StepFailure::ParasiticMode { amplitude, relative, limit: self.in_force })
            }
            _ => Ok(()),
        }
    }

    fn measure(&mut self, step: u64, q: &[T]) -> ParasiticMode<T> {
        let (zero, two) = (T::lift(0.0), T::lift(2.0));
        let Self { points, sizes, .. } = self;
        let point = |j: u64| &points[((step + j) % KEPT as u64) as usize];
        let [a, b, c, d] = [point(0), point(1), point(2), point(3)];
        let alternating = |i: usize, e: T| a[i] - T::lift(4.0) * (b[i] + d[i]) + T::lift(6.0) * c[i] + e;
        let remembered = T::lift(1.0 - FORGOTTEN);
        let (mut amplitude, mut size, mut increment, mut largest) = (zero, zero, zero, zero);
        let (mut turned, mut moved, mut alternated) = (zero, zero, zero);
        for (i, &e) in q.iter().enumerate() {
            let smooth = (a[i] - two * c[i] + e) * T::lift(0.25);
            turned += smooth * smooth;
            let delta = e - d[i];
            moved += delta * delta;
            sizes[i] = larger(Scalar::abs(smooth), sizes[i] * remembered);
            largest = larger(largest, sizes[i]);
            let fourth = alternating(i, e);
            alternated += fourth * fourth;
            amplitude = larger(amplitude, Scalar::abs(fourth));
            size = larger(size, Scalar::abs(e));
            increment = larger(increment, Scalar::abs(delta));
        }
        let (floor, mut relative) =
            (T::lift(FLOOR) * largest, larger(zero, Scalar::sqrt(alternated / turned)));
        for (i, &e) in q.iter().enumerate() {
            relative = larger(relative, Scalar::abs(alternating(i, e)) / larger(sizes[i], floor));
        }
        // What alternates is 16a here.
        (amplitude, relative) = (amplitude * T::lift(1.0 / 16.0), relative * T::lift(0.25));
        let noise = T::lift(ROUNDING) * T::default_epsilon() * size;
        let is_significant = amplitude > noise && amplitude > T::lift(HARMLESS) * increment;
        let mode = ParasiticMode { amplitude, relative, is_significant };
        if self.pace == Pace::WithTheFlow {
            self.keep_pace(&mode, reported(turned), reported(moved));
        }
        self.latest = Some((step, mode));
        mode
    }

    /// Sets the limit in force after the first look, and when to look again: `turned`/`moved` is the square of the
    /// angle by which the motion turns in a step.
    fn keep_pace(&mut self, mode: &ParasiticMode<T>, turned: f64, moved: f64) {
        let relative = if mode.is_significant { reported(mode.relative) } else { 0.0 };
        if self.latest.is_none() {
            self.in_force = self.in_force.max(GROWTH * relative);
        }
        // (steps · angle)² ≤ (RADIANS ln(limit/relative))², which is false of what is not a number.
        let room = RADIANS * Scalar::ln((self.in_force / relative).clamp(1.0, f64::MAX));
        let fits = |steps: u64| (steps * steps) as f64 * turned <= room * room * moved;
        self.period = KEPT as u64;
        while self.period < BLOCK && fits(2 * self.period) {
            self.period *= 2;
        }
    }
}
