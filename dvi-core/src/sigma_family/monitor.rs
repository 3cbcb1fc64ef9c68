//! The parasitic mode, measured: what of the second differences of a run alternates from step to step.
//!
//! D_k = q_{k−1} − 2q_k + q_{k+1}. A motion that turns by the angle θ in a step has |D_{k+1} − D_k|/|D_{k+1} + D_k| =
//! tan(θ/2); on an alternating part, D changes its sign from step to step and the ratio is large. The solution of a
//! stable step with σ ≠ ½ has θ < π/2, and the parasitic mode is its mirror image, π − θ (the two roots of
//! Rowley & Marsden 2002, section 4.1, meet at θ = π/2).

use crate::error::StepFailure;
use crate::norm::{larger, reported};
use crate::{Lagrangian, Real, Scalar, Space, Vector};

/// How many points are kept besides the present one.
const KEPT: usize = 4;

/// How often a run is examined if α is affine: where the parasitic mode grows, it does so at a rate of the flow.
pub(crate) const PERIOD: u64 = crate::walk::BLOCK;

/// An alternating part below this many units of rounding of the coordinates is noise.
const ROUNDING: f64 = 1024.0;

/// An alternating part below this fraction of the latest increment does no harm, however straight the path.
const HARMLESS: f64 = 1e-6;

/// The parasitic mode at five consecutive points of a run, the coordinates taken together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParasiticMode<T = f64> {
    /// The largest entry of (q_{k−2} − 4q_{k−1} + 6q_k − 4q_{k+1} + q_{k+2})/16: of an alternating part (−1)ᵏa, the
    /// largest entry of a; of a smooth motion, of (h⁴/16) q⁗. In units of the coordinates.
    pub amplitude: T,
    /// |D_{k+1} − D_k|/|D_{k+1} + D_k| in the Euclidean norm of all coordinates, D_k the second differences: the
    /// smaller of the values of both pairs. Of a smooth motion of frequency ω it is about ωh/2; it is one where as
    /// much of the second difference alternates as does not.
    pub relative: T,
    /// Whether the amplitude is more than rounding errors, 1024 ε max|q|, and more than 10⁻⁶ of the increment.
    pub is_significant: bool,
}

/// The points from which the mode is measured.
#[derive(Debug)]
pub(super) struct Monitor<S: Lagrangian, T: Real> {
    /// The points before the present one; point k is at place k mod 4.
    points: [Vector<S, T>; KEPT],
    /// The completed steps.
    pub(super) steps: u64,
    /// Zero if the run is examined before each step, else all ones, below the period.
    mask: u64,
    limit: Option<f64>,
    latest: Option<ParasiticMode<T>>,
}

impl<S: Lagrangian, T: Real> Monitor<S, T> {
    /// Examines the run before each step if `always`, and else once in a period.
    pub(super) fn new(system: &S, limit: Option<f64>, always: bool) -> Self {
        let mask = if always { 0 } else { PERIOD - 1 };
        let points = core::array::from_fn(|_| system.space().vector());
        Self { points, steps: 0, mask, limit, latest: None }
    }

    pub(super) fn restore(&mut self, from: &Self) {
        for (point, from) in self.points.iter_mut().zip(&from.points) {
            point.copy_from_slice(from);
        }
        (self.steps, self.latest) = (from.steps, from.latest);
    }

    pub(super) fn latest(&self) -> Option<ParasiticMode<T>> {
        self.latest
    }

    /// Takes note of the point before the next step, if it is one of those that are looked at.
    ///
    /// # Errors
    /// [`StepFailure::ParasiticMode`] if the run is lost.
    #[inline(always)]
    pub(super) fn look(&mut self, q: &[T]) -> Result<(), StepFailure> {
        if (self.steps + KEPT as u64) & self.mask > KEPT as u64 { Ok(()) } else { self.look_closely(q) }
    }

    #[inline(never)]
    fn look_closely(&mut self, q: &[T]) -> Result<(), StepFailure> {
        let verdict = if self.steps & self.mask == 0 { self.examine(self.steps, q) } else { Ok(()) };
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
        let mode = self.measure(step, q);
        self.latest = Some(mode);
        match self.limit {
            Some(limit) if mode.is_significant && mode.relative > T::lift(limit) => {
                let [amplitude, relative] = [mode.amplitude, mode.relative].map(reported);
                Err(StepFailure::ParasiticMode { amplitude, relative, limit })
            }
            _ => Ok(()),
        }
    }

    fn measure(&self, step: u64, q: &[T]) -> ParasiticMode<T> {
        let (zero, two) = (T::lift(0.0), T::lift(2.0));
        let point = |j: u64| &self.points[((step + j) % KEPT as u64) as usize];
        let [a, b, c, d] = [point(0), point(1), point(2), point(3)];
        // The squares of |D_{k+1} − D_k| and |D_{k+1} + D_k|, of both pairs.
        let (mut alternating, mut smooth) = ([zero; 2], [zero; 2]);
        let (mut amplitude, mut size, mut increment) = (zero, zero, zero);
        for (i, &e) in q.iter().enumerate() {
            let second = |x: T, y: T, z: T| x - two * y + z;
            let differences = [second(a[i], b[i], c[i]), second(b[i], c[i], d[i]), second(c[i], d[i], e)];
            for pair in 0..2 {
                let (difference, sum) =
                    (differences[pair + 1] - differences[pair], differences[pair + 1] + differences[pair]);
                alternating[pair] += difference * difference;
                smooth[pair] += sum * sum;
            }
            let fourth = second(differences[0], differences[1], differences[2]);
            amplitude = larger(amplitude, Scalar::abs(fourth));
            size = larger(size, Scalar::abs(e));
            increment = larger(increment, Scalar::abs(e - d[i]));
        }
        let amplitude = amplitude * T::lift(1.0 / 16.0);
        let [first, second] = [0, 1].map(|pair| {
            let nothing = alternating[pair] == zero;
            if nothing { zero } else { Scalar::sqrt(alternating[pair] / smooth[pair]) }
        });
        let noise = T::lift(ROUNDING) * T::default_epsilon() * size;
        ParasiticMode {
            amplitude,
            relative: if first < second { first } else { second },
            is_significant: amplitude > noise && amplitude > T::lift(HARMLESS) * increment,
        }
    }
}
