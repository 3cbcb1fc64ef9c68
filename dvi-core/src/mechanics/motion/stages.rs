//! The equations of motion at all stages of a step, of which each has a lane: evaluated one by one, or in
//! the lanes.

use core::fmt;

use super::{EquationsOf, FirstOrder, Motion, PackedOf, PointOf};
use crate::error::StepFailure;
use crate::mechanics::vector_field::LaneWork;
use crate::scalar::lanes::{read_lane, write_lane};
use crate::scalar::simd::widest_if;
use crate::scalar::{Lanes, norm};
use crate::state::Statistics;
use crate::{Real, Scalar, Space, System, Vector};

/// Stages are evaluated one by one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct OneByOne;

/// Stages are evaluated at once, in the lanes of one pack.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct InLanes;

/// What the evaluation of stages works with.
pub struct StageWork<const W: usize, S: System<Kind: Motion<S, T>>, T: Real> {
    /// One stage.
    point: PointOf<S, T>,
    slope: PointOf<S, T>,
    vector: Vector<S, T>,
    /// All stages: forces or ∇H, or X itself.
    pub(super) gradient: Vector<S, Lanes<W, T>>,
    /// Of Ω; of a regular system, the velocity zero.
    pub(super) entries: Vector<S, Lanes<W, T>>,
}

impl<const W: usize, S: System<Kind: Motion<S, T>>, T: Real> StageWork<W, S, T> {
    pub(crate) fn new(system: &S) -> Self {
        let space = system.space();
        let [point, slope] = S::Kind::points(system);
        Self { point, slope, vector: space.vector(), gradient: space.vector(), entries: space.vector() }
    }

    /// For the vector field of a degenerate system.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn of_field(&mut self) -> LaneWork<'_, W, T> {
        let Self { vector, gradient, entries, .. } = self;
        LaneWork { gradient, entries, vector }
    }
}

impl<const W: usize, S: System<Kind: Motion<S, T>>, T: Real> fmt::Debug for StageWork<W, S, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("StageWork").finish_non_exhaustive()
    }
}

/// What is evaluated at the stages: X in the points `y` at the times `t`.
pub struct AtStages<'a, const W: usize, S: System<Kind: Motion<S, T>>, T: Real> {
    pub(crate) system: &'a S,
    pub(crate) y: &'a PackedOf<S, T, Lanes<W, T>>,
    pub(crate) t: Lanes<W, T>,
}

/// The slopes of the stages, a guess of X, of which an evaluation renews entry `part`.
pub struct Slopes<'a, const W: usize, S: System<Kind: Motion<S, T>>, T: Real> {
    /// K.
    pub(crate) slopes: &'a mut PackedOf<S, T, Lanes<W, T>>,
    /// L = h b K of this entry.
    pub(crate) terms: &'a mut Vector<S, Lanes<W, T>>,
    pub(crate) part: usize,
    /// h b.
    pub(crate) weights: Lanes<W, T>,
    /// The units of changes.
    pub(crate) units: &'a [T],
    /// The largest changes of a velocity so far, of each stage first, as the stages are beside one another.
    pub(crate) changes: [T; W],
}

impl<const W: usize, S: System<Kind: Motion<S, T>>, T: Real> Slopes<'_, W, S, T> {
    /// Renews number `j`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn renew(&mut self, j: usize, renewed: Lanes<W, T>) {
        let (slope, unit) = (&mut self.slopes[self.part][j], self.units[j]);
        for stage in 0..W {
            let change = Scalar::abs(renewed.0[stage] - slope.0[stage]) * unit;
            self.changes[stage] = norm::larger(self.changes[stage], change);
        }
        *slope = renewed;
        self.terms[j] = self.weights * renewed;
    }

    /// Takes over that the entry has been renewed in its place, where nothing is asked of its changes.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn renewed(&mut self) {
        weigh(|_| self.weights, &self.slopes[self.part], self.terms);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn renew_all(&mut self, renewed: &[Lanes<W, T>]) {
        for (j, &renewed) in renewed.iter().enumerate() {
            self.renew(j, renewed);
        }
    }
}

/// Sets `terms`ₖ to `weights`(k) times `packs`ₖ. The loop is one over blocks, because over single packs the
/// compiler would take lanes of several packs together, and load and store them one by one.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn weigh<const W: usize, T: Real>(
    weights: impl Fn(usize) -> Lanes<W, T>,
    packs: &[Lanes<W, T>],
    terms: &mut [Lanes<W, T>],
) {
    let (blocks, left) = packs.as_chunks::<BLOCK>();
    let (term_blocks, terms_left) = terms.as_chunks_mut::<BLOCK>();
    let mut first = 0;
    for (terms, packs) in term_blocks.iter_mut().zip(blocks) {
        for k in 0..BLOCK {
            terms[k] = weights(first + k) * packs[k];
        }
        first += BLOCK;
    }
    for (k, (term, &pack)) in terms_left.iter_mut().zip(left).enumerate() {
        *term = weights(first + k) * pack;
    }
}

/// How many packs are taken at once.
const BLOCK: usize = 4;

impl<const W: usize, S: System<Kind: Motion<S, T>>, T: Real> fmt::Debug for Slopes<'_, W, S, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Slopes").field("part", &self.part).finish_non_exhaustive()
    }
}

impl<const W: usize, S: System<Kind: Motion<S, T>>, T: Real> fmt::Debug for AtStages<'_, W, S, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("AtStages").field("t", &self.t).finish_non_exhaustive()
    }
}

/// For which instructions steps are compiled.
pub trait Evaluation {
    /// Runs `steps`, a closure that is `#[cfg_attr(not(debug_assertions), inline(always))]` where it is
    /// written.
    fn run<R>(steps: impl FnOnce() -> R) -> R;
}

impl Evaluation for OneByOne {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<R>(steps: impl FnOnce() -> R) -> R {
        steps()
    }
}

impl Evaluation for InLanes {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<R>(steps: impl FnOnce() -> R) -> R {
        widest_if(true, steps)
    }
}

/// How the equations of motion are evaluated at the `W` stages of a step.
pub trait StageEvaluation<const W: usize, S: System<Kind: Motion<S, T>>, T: Real>: Evaluation {
    /// Renews an entry of the slopes by that of X at all stages, as [`FirstOrder::evaluate_part`] does at
    /// one.
    ///
    /// # Errors
    /// As there, of the first stage that fails.
    fn evaluate_part(
        equations: &mut EquationsOf<S, T>,
        at: &AtStages<'_, W, S, T>,
        work: &mut StageWork<W, S, T>,
        slopes: &mut Slopes<'_, W, S, T>,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure>;
}

impl<const W: usize, S: System<Kind: FirstOrder<S, T>>, T: Real> StageEvaluation<W, S, T> for OneByOne {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn evaluate_part(
        equations: &mut EquationsOf<S, T>,
        at: &AtStages<'_, W, S, T>,
        work: &mut StageWork<W, S, T>,
        slopes: &mut Slopes<'_, W, S, T>,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        one_by_one(equations, at, work, slopes, statistics)
    }
}

impl<const W: usize, S: System<Kind: FirstOrderInLanes<W, S, T>>, T: Real> StageEvaluation<W, S, T>
    for InLanes
{
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn evaluate_part(
        equations: &mut EquationsOf<S, T>,
        at: &AtStages<'_, W, S, T>,
        work: &mut StageWork<W, S, T>,
        slopes: &mut Slopes<'_, W, S, T>,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        S::Kind::evaluate_in_lanes(equations, at, work, slopes, statistics)
    }
}

/// The equations of motion of a system `S` at `W` points at once.
#[diagnostic::on_unimplemented(
    message = "the equations of motion of `{S}` cannot be evaluated in lanes",
    label = "it is no system, it has constraints, impacts, rotations or unit vectors, or a parameter of it is not of one type in all of them",
    note = "`Gauss` without `in_lanes` takes parameters of type `Varied`"
)]
pub trait FirstOrderInLanes<const W: usize, S: System, T: Real>: FirstOrder<S, T> {
    /// As [`StageEvaluation::evaluate_part`].
    ///
    /// # Errors
    /// As there.
    fn evaluate_in_lanes(
        equations: &mut EquationsOf<S, T>,
        at: &AtStages<'_, W, S, T>,
        work: &mut StageWork<W, S, T>,
        slopes: &mut Slopes<'_, W, S, T>,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure>
    where
        S: System<Kind = Self>;
}

/// Evaluates the stages one by one.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn one_by_one<const W: usize, S: System<Kind: FirstOrder<S, T>>, T: Real>(
    equations: &mut EquationsOf<S, T>,
    at: &AtStages<'_, W, S, T>,
    work: &mut StageWork<W, S, T>,
    slopes: &mut Slopes<'_, W, S, T>,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    let StageWork { point, slope, gradient, .. } = work;
    for stage in 0..W {
        for (to, from) in [(&mut *point, at.y), (&mut *slope, &*slopes.slopes)] {
            for (to, from) in to.iter_mut().zip(from.iter()) {
                read_lane(stage, from, to);
            }
        }
        let t = at.t.0[stage];
        S::Kind::evaluate_part(equations, at.system, slopes.part, point, t, slope, statistics)?;
        write_lane(stage, &slope[slopes.part], gradient);
    }
    slopes.renew_all(gradient);
    Ok(())
}
