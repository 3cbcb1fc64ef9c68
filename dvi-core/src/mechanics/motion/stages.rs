//! The equations of motion at all stages of a step, of which each has a lane: evaluated one by one, or in
//! the lanes.

use super::{FirstOrder, PackedOf, PointOf};
use crate::error::StepFailure;
use crate::scalar::Lanes;
use crate::scalar::lanes::{read_lane, write_lane};
use crate::state::Statistics;
use crate::{Real, Space, System, Vector};

/// Stages are evaluated one by one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct OneByOne;

/// Stages are evaluated at once, in the lanes of one pack.
///
/// ```
#[doc = include_str!("../../../docs/hidden/pendulum.txt")]
/// let method: Gauss<8, InLanes> = Gauss::new().in_lanes();
/// let mut run = Integrator::new(&Pendulum, method, 0.3, start.clone())?;
/// let mut alone = Integrator::new(&Pendulum, Gauss::<8>::new(), 0.3, start)?;
/// run.take_steps(100)?;
/// alone.take_steps(100)?;
/// assert_eq!(run.state(), alone.state()); // bit for bit
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct InLanes;

/// What the evaluation of stages works with.
#[derive(Debug)]
pub struct StageWork<const W: usize, S: System<Kind: FirstOrder<S, T>>, T: Real> {
    /// One stage.
    pub(crate) point: PointOf<S, T>,
    pub(crate) slope: PointOf<S, T>,
    /// All stages: forces or ∇H, or X itself.
    pub(super) gradient: Vector<S, Lanes<W, T>>,
    /// Of Ω; of a regular system, the velocity zero.
    pub(super) entries: Vector<S, Lanes<W, T>>,
}

impl<const W: usize, S: System<Kind: FirstOrder<S, T>>, T: Real> StageWork<W, S, T> {
    pub(crate) fn new(system: &S) -> Self {
        let space = system.space();
        let [point, slope] = S::Kind::points(system);
        Self { point, slope, gradient: space.vector(), entries: space.vector() }
    }
}

/// Where an entry of X is evaluated: in the points `y` at the times `t`.
#[derive(Debug)]
pub struct AtStages<'a, const W: usize, S: System<Kind: FirstOrder<S, T>>, T: Real> {
    pub(crate) system: &'a S,
    /// Which entry.
    pub(crate) part: usize,
    pub(crate) y: &'a PackedOf<S, T, Lanes<W, T>>,
    /// The velocities there, or a guess of them.
    pub(crate) velocity: &'a Vector<S, Lanes<W, T>>,
    pub(crate) t: Lanes<W, T>,
}

/// Sets `terms`ₖ to `weights` times `packs`ₖ.
#[inline]
pub(crate) fn weigh<const W: usize, T: Real>(
    weights: Lanes<W, T>,
    packs: &[Lanes<W, T>],
    terms: &mut [Lanes<W, T>],
) {
    weigh_by(|_| weights, packs, terms);
}

/// Sets `terms`ₖ to `h` times `factors`ₖ and `packs`ₖ.
#[inline]
pub(crate) fn weigh_each<const W: usize, T: Real>(
    h: T,
    factors: &[T],
    packs: &[Lanes<W, T>],
    terms: &mut [Lanes<W, T>],
) {
    weigh_by(|k| Lanes::all(h * factors[k]), packs, terms);
}

/// The loop is one over blocks, because over single packs the compiler would take lanes of several packs
/// together, and load and store them one by one.
#[inline]
fn weigh_by<const W: usize, T: Real>(
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

/// For which instructions steps are compiled.
pub trait Evaluation {
    /// Whether for the widest of the processor.
    const WIDE: bool;
}

impl Evaluation for OneByOne {
    const WIDE: bool = false;
}

impl Evaluation for InLanes {
    const WIDE: bool = true;
}

/// The equations of motion of a system `S` at the `W` stages of a step, evaluated as `E` says.
#[diagnostic::on_unimplemented(
    message = "the equations of motion of `{S}` cannot be evaluated in lanes",
    label = "it is no system, it has constraints, impacts, rotations or unit vectors, or a parameter of it \
        is not of one type in all of them",
    note = "`Gauss` without `in_lanes` takes parameters of type `Varied`"
)]
pub trait FirstOrderAtStages<E, const W: usize, S: System, T: Real>: FirstOrder<S, T> {
    /// Sets `out` to an entry of X at all stages, as [`FirstOrder::evaluate_part`] does at one.
    ///
    /// # Errors
    /// As there, of the first stage that fails.
    fn evaluate_at_stages(
        equations: &mut Self::Equations,
        at: &AtStages<'_, W, S, T>,
        work: &mut StageWork<W, S, T>,
        out: &mut Vector<S, Lanes<W, T>>,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure>
    where
        S: System<Kind = Self>;
}

impl<K: FirstOrder<S, T>, const W: usize, S: System, T: Real> FirstOrderAtStages<OneByOne, W, S, T> for K {
    #[inline]
    fn evaluate_at_stages(
        equations: &mut Self::Equations,
        at: &AtStages<'_, W, S, T>,
        work: &mut StageWork<W, S, T>,
        out: &mut Vector<S, Lanes<W, T>>,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure>
    where
        S: System<Kind = Self>,
    {
        let StageWork { point, slope, .. } = work;
        // Forces of equations of second order depend on positions alone.
        let of_positions = Self::OF_SECOND_ORDER && at.part > 0;
        let parts = if of_positions { 1 } else { at.y.len() };
        for stage in 0..W {
            for (to, from) in point.iter_mut().zip(at.y.iter()).take(parts) {
                read_lane(stage, from, to);
            }
            if !of_positions {
                read_lane(stage, at.velocity, &mut slope[0]);
            }
            Self::evaluate_part(equations, at.system, at.part, point, at.t.0[stage], slope, statistics)?;
            write_lane(stage, &slope[at.part], out);
        }
        Ok(())
    }
}
