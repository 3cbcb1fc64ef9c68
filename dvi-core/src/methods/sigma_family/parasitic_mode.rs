//! The parasitic mode, measured while a run goes on: what of the second differences of a run alternates from
//! step to step.
//!
//! D_k = q_{k−1} − 2q_k + q_{k+1}. On an alternating part (−1)ᵏa, D_{k−1} − 2D_k + D_{k+1} is 16a, and
//! D_{k−1} + 2D_k + D_{k+1} is nothing; on a smooth motion the second is 4h²q̈. The mode is compared with a
//! quarter of h²q̈, the size of what a step of second order neglects. Of a motion that turns by the angle θ
//! in a step the ratio is tan²(θ/2). The two roots of a stable step with σ ≠ ½ (Rowley & Marsden 2002,
//! section 4.1) have tan(θ/2) tan(θ'/2) = 1/(1 − 2σ)²: of σ = 0 and 1 the parasitic mode is the mirror image
//! of the solution, π − θ, and of other σ it is nearer to π. They meet at |ωh| = 1/|1 − 2σ|.

mod pace;

use crate::error::StepFailure;
use crate::memory::lasting;
use crate::scalar::norm::{larger, reported};
use crate::{Real, Scalar, Space, System, Vector};

use pace::First;
pub(super) use pace::Pace;

/// How many points are kept besides the present one.
const KEPT: usize = 4;

/// An alternating part below this many units of rounding of the coordinates is noise.
const ROUNDING: f64 = 1024.0;

/// An alternating part below this fraction of the latest increment does no harm, however straight the path.
const HARMLESS: f64 = 1e-5;

/// How much of the size of a coordinate's second differences is forgotten from one look to the next.
const FORGOTTEN: f64 = 1.0 / 64.0;

/// The same of all coordinates together: what is remembered is a bridge over points at which the path is
/// straight.
const FORGOTTEN_TOGETHER: f64 = 1.0 / 8.0;

/// A mode that has changed by no more than this part from one look to the next stays as it is.
const STEADY: f64 = 0.01;

/// The second differences of a coordinate count as no smaller than this fraction of the largest of all.
const FLOOR: f64 = 0.1;

/// How many looks in a row end a run whose mode has become large at once: a path whose curvature changes
/// within a step or two seems to alternate to all looks that see the place, which are five to seven. Of
/// other modes it takes two: where a path is straight, a smooth motion may look as if it alternated, to one
/// look.
const AT_ONCE: u32 = 8;

/// Two looks are enough there too if the last sees the mode this many times above the limit. Where the
/// curvature changes it seems to be up to three times as large as the path is curved.
const SUDDEN: f64 = 16.0;

/// A mode that is this many times as large as a step before has not grown.
const JUMP: f64 = 5.0;

/// The parasitic mode at five consecutive points of a run.
///
/// ```
#[doc = include_str!("../../../docs/hidden/vortices.txt")]
/// let mut run = Integrator::new(&Vortices, Sigma::leapfrog(), 0.1, start)?;
/// run.take_steps(10_000)?;
/// let ParasiticMode { amplitude, relative, .. } = run.memory().parasitic_mode().unwrap();
/// // What a smooth motion of frequency ω = 1/π shows: (ωh/2)².
/// assert!((relative - 2.5e-4).abs() < 2e-5 && amplitude < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParasiticMode<T = f64> {
    /// The largest entry of a = (q_{k−2} − 4q_{k−1} + 6q_k − 4q_{k+1} + q_{k+2})/16: of an alternating part
    /// (−1)ᵏa, the largest entry of a; of a smooth motion, of (h⁴/16) q⁗. In units of the coordinates.
    pub amplitude: T,
    /// 4|a|/|s| in the Euclidean norm, where s is h²q̈ from second differences that do not see what
    /// alternates; or the largest 4|aᵢ|/sᵢ, if that is larger, where sᵢ is at least a tenth of the largest
    /// of all coordinates. Both sizes are the largest of the points that were looked at, of which each look
    /// forgets 1/8, and of a coordinate 1/64. Of a smooth motion of frequency ω it is about (ωh/2)². On a
    /// straight path it says nothing, and may be infinite or no number.
    pub relative: T,
    /// Whether the amplitude is more than rounding errors, 1024 ε max|q|, and more than 10⁻⁵ of the
    /// increment.
    pub is_significant: bool,
}

/// The points from which the mode is measured.
#[derive(Debug)]
pub(super) struct Monitor<S: System, T: Real> {
    /// The points before the present one; point k is at place k mod 4.
    points: [Vector<S, T>; KEPT],
    /// The size of the second differences of each coordinate, and the square of that of all.
    sizes: Vector<S, T>,
    together: T,
    /// The completed steps.
    pub(super) steps: u64,
    pace: Pace,
    /// The run is examined where the number of steps is a multiple of this power of two.
    pub(super) period: u64,
    limit: Option<f64>,
    /// Before which step it was examined last, zero if it was not, and what was measured.
    examined: u64,
    mode: ParasiticMode<T>,
    /// How many looks in a row, the last among them, have seen it above the limit.
    above: u32,
    /// How many looks have passed, of those at each step, since the mode has become large at once.
    since_jump: u32,
    first: First,
}

impl<S: System, T: Real> Monitor<S, T> {
    pub(super) fn new(system: &S, limit: Option<f64>, pace: Pace) -> Self {
        let vector = || system.space().vector();
        Self {
            points: system.space().vectors(),
            sizes: vector(),
            together: T::lift(0.0),
            steps: 0,
            pace,
            period: pace.first_period(),
            limit,
            examined: 0,
            mode: ParasiticMode { amplitude: T::lift(0.0), relative: T::lift(0.0), is_significant: false },
            above: 0,
            since_jump: u32::MAX,
            first: First::default(),
        }
    }

    /// The last examination: before which step, and what it measured.
    pub(super) fn last(&self) -> Option<(u64, ParasiticMode<T>)> {
        (self.examined > 0).then_some((self.examined, self.mode))
    }

    /// Looks at the point before the next step, if it is one of those that are looked at, and returns the
    /// number of steps that may be taken before this is to be done again.
    ///
    /// # Errors
    /// [`StepFailure::ParasiticMode`] if the run is lost.
    pub(super) fn look(&mut self, q: &[T]) -> Result<u64, StepFailure> {
        let (position, kept) = (self.steps & (self.period - 1), KEPT as u64);
        if position > 0 && position + kept < self.period {
            return Ok(self.period - kept - position);
        }
        self.look_closely(q)
    }

    #[inline(never)]
    fn look_closely(&mut self, q: &[T]) -> Result<u64, StepFailure> {
        if self.steps & (self.period - 1) == 0 {
            self.examine(self.steps, q)?;
        }
        // What was measured may have set another period.
        let (position, kept) = (self.steps & (self.period - 1), KEPT as u64);
        if position + kept < self.period {
            return Ok(self.period - kept - position);
        }
        self.note(self.steps, q);
        Ok(1)
    }

    /// Keeps point number `step`.
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
        let mode = match self.last() {
            // A step that failed is tried again.
            Some((last, mode)) if last == step => mode,
            _ => self.measure(step, q),
        };
        let [amplitude, relative] = [mode.amplitude, mode.relative].map(reported);
        let is_growing = self.since_jump >= AT_ONCE || self.above >= AT_ONCE;
        let has_passed = |&limit: &f64| self.above > 1 && (is_growing || relative > SUDDEN * limit);
        let Some(limit) = self.limit.filter(has_passed) else { return Ok(()) };
        // Whoever tries the step again is to be told again.
        self.period = self.period.min(KEPT as u64);
        Err(StepFailure::ParasiticMode { amplitude, relative, limit })
    }

    fn measure(&mut self, step: u64, q: &[T]) -> ParasiticMode<T> {
        let (zero, two) = (T::lift(0.0), T::lift(2.0));
        let Self { points, sizes, together, mode, examined, pace, .. } = self;
        let point = |j: u64| &points[((step + j) % KEPT as u64) as usize];
        let [a, b, c, d] = [point(0), point(1), point(2), point(3)];
        let alternating = |i: usize, e: T| a[i] - T::lift(4.0) * (b[i] + d[i]) + T::lift(6.0) * c[i] + e;
        let smooth = |i: usize, e: T| (a[i] - two * c[i] + e) * T::lift(0.25);
        let (mut amplitude, mut size, mut increment, mut largest) = (zero, zero, zero, zero);
        let (mut turned, mut moved, mut alternated) = (zero, zero, zero);
        for (i, &e) in q.iter().enumerate() {
            let second = smooth(i, e);
            turned += second * second;
            let delta = e - d[i];
            moved += delta * delta;
            let fourth = alternating(i, e);
            alternated += fourth * fourth;
            amplitude = larger(amplitude, Scalar::abs(fourth));
            size = larger(size, Scalar::abs(e));
            increment = larger(increment, Scalar::abs(delta));
        }
        // Where the path has become straight, a mode that stays as it was does no more harm than before.
        let change = Scalar::abs(T::lift(16.0) * mode.amplitude - amplitude);
        let stays = *pace == Pace::WithTheFlow && *examined > 0 && change <= T::lift(STEADY) * amplitude;
        let [kept, remembered] =
            [FORGOTTEN_TOGETHER, FORGOTTEN].map(|part| T::lift(if stays { 1.0 } else { 1.0 - part }));
        *together = larger(turned, *together * kept * kept);
        for (i, &e) in q.iter().enumerate() {
            sizes[i] = larger(Scalar::abs(smooth(i, e)), sizes[i] * remembered);
            largest = larger(largest, sizes[i]);
        }
        let (floor, mut relative) =
            (T::lift(FLOOR) * largest, larger(zero, Scalar::sqrt(alternated / *together)));
        for (i, &e) in q.iter().enumerate() {
            relative = larger(relative, Scalar::abs(alternating(i, e)) / larger(sizes[i], floor));
        }
        // What alternates is 16a here.
        (amplitude, relative) = (amplitude * T::lift(1.0 / 16.0), relative * T::lift(0.25));
        let noise = T::lift(ROUNDING) * T::default_epsilon() * size;
        let is_significant = amplitude > noise && amplitude > T::lift(HARMLESS) * increment;
        let mode = ParasiticMode { amplitude, relative, is_significant };
        if self.pace == Pace::WithTheFlow {
            self.keep_pace(step, &mode, reported(turned), reported(moved));
        }
        let has_jumped = self.last().is_some_and(|(_, last)| mode.relative > T::lift(JUMP) * last.relative);
        let is_jump = self.pace == Pace::EachStep && has_jumped;
        self.since_jump = if is_jump { 0 } else { self.since_jump.saturating_add(1) };
        self.above = if self.is_above(&mode) { self.above.saturating_add(1) } else { 0 };
        (self.examined, self.mode) = (step, mode);
        mode
    }

    #[cfg(feature = "alloc")]
    fn is_sound(&self) -> bool {
        let in_order = self.examined <= self.steps && self.steps < u64::MAX / 2;
        in_order && self.period.is_power_of_two() && self.period <= crate::methods::walk::BLOCK
    }
}

lasting!([S: System, T: Real] Monitor<S, T>, T;
    vectors points, numbers sizes, size together, count steps, count period, count examined, part mode,
    count above, count since_jump, part first; is_sound);

lasting!([T: Real] ParasiticMode<T>, T; size amplitude, size relative, flag is_significant);
