//! Why steps fail.

use thiserror::Error;

use super::step::Of;
use crate::error::{OutsideError, said};
use crate::name::InArray;

said!(StepFailure);

/// Why a step could not be completed.
///
/// ```
#[doc = include_str!("../../docs/hidden/kepler.txt")]
/// // A head-on fall into the sun, which steps of one length would jump over.
/// let fall = KeplerState { dot_y: 0.0, ..start };
/// let method = EnergyLimit { method: Variational::trapezoid(), limit: 0.1 };
/// let mut run = Integrator::new(&Kepler, method, 0.01, fall)?;
/// let error = run.take_steps(1000).unwrap_err();
/// match error.failure {
///     StepFailure::Energy { start, limit, .. } => assert_eq!((start, limit), (-1.0, 0.1)),
///     other => panic!("{other}"),
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum StepFailure {
    /// The iteration ran out of its budget or moved away from a solution.
    #[error(
        "no convergence: after {iterations} iterations the correction is {correction:e}, {tolerance:e} was \
         asked for; a smaller step helps, unless a formula jumps there, as dry friction does at rest: \
         there write it without a jump, as with `tanh`"
    )]
    NotConverged {
        /// Iterations taken.
        iterations: usize,
        /// The largest component of the last correction.
        correction: f64,
        /// The largest correction that would have been accepted.
        tolerance: f64,
    },
    /// A phase-fitted interpolation does not exist, or does not determine the step, near this step length.
    #[error(
        "phase fitting breaks down at u = ωh = {u}: sin u = {sine:e}, Σ w cos((1 − 2c)u) = {cosine_sum:e}; a smaller \
         step helps"
    )]
    Resonance {
        /// ωh, in radians.
        u: f64,
        /// sin u, by which the interpolation divides.
        sine: f64,
        /// S = Σ w cos((1 − 2c)u), which multiplies the new point; with interior displacements, what
        /// multiplies it in place of S.
        cosine_sum: f64,
    },
    /// A matrix has an entry where its pattern, which decided its storage when the run began, has none.
    #[error("{}", Of(self, None))]
    Pattern {
        /// The coordinate of its row, counted from 0.
        row: usize,
        /// That of its column.
        column: usize,
    },
    /// The frequency of a phase-fitted interpolation is not a number, or infinite.
    #[error(
        "phase fitting breaks down: the frequency is {omega}, at this state or where the step leads; there \
         a smaller step helps"
    )]
    Frequency {
        /// The frequency, or its product with the step.
        omega: f64,
    },
    /// A matrix that must be solved with is singular to working precision.
    #[error("{}", Of(self, None))]
    Singular {
        /// Which matrix.
        matrix: &'static str,
        /// The column without a usable pivot.
        column: usize,
        /// The largest candidate.
        pivot: f64,
    },
    /// The gradient of a constraint vanishes, or depends linearly on those of the constraints before it: it
    /// says nothing that these do not say, or contradicts them. Its multiplier is not determined then. In a
    /// gradient of size one, a part of 10⁻⁹ that those before it do not have is lost in rounding, one of
    /// 10⁻⁶ as a rule not.
    #[error(
        "constraint {constraint} is redundant here, or contradicts those before it: its gradient vanishes or depends on theirs \
         (pivot {pivot:e} in units of the others)"
    )]
    RedundantConstraint {
        /// Its number, counted from 0 in the order of declaration.
        constraint: usize,
        /// The pivot without which the equations have no solution.
        pivot: f64,
    },
    /// A step turns the gradient of a constraint of positions by a right angle or more, or leads away from
    /// one that does not move by more than 45°, in the metric of the mass matrix: the equations of the step
    /// have several solutions then, and this one need not be that of the motion.
    #[error(
        "the step turns the gradient of constraint {constraint} by a right angle or more, or leads away from it by more than 45°, where \
         its equations have other solutions than the motion: a smaller step helps, unless the constraint is singular on the way"
    )]
    Turned {
        /// Its number, counted from 0 in the order of declaration.
        constraint: usize,
    },
    /// The equations of a step have been solved on another branch than that of the motion: the determinant
    /// of their matrix has another sign than that of a short step. With constraints, where a rod may point
    /// to either side, that is the one of G(q1) M⁻¹ G(q0)ᵀ.
    #[error(
        "the step comes out at another solution of its equations than that of the motion: a smaller step helps, unless constraints are \
         singular on the way"
    )]
    Branch,
    /// A step turns a rotation, or moves a unit vector, by half a turn or more, where a geodesic is not the
    /// shortest way and the equations of the step have other solutions than the motion.
    #[error(
        "`{block}{}` would turn by {angle} radians in one step, half a turn or more: a smaller step helps",
        InArray(.index)
    )]
    HalfTurn {
        /// The name of the coordinates.
        block: &'static str,
        /// Which of them it is, if they are an array.
        index: Option<usize>,
        /// The angle.
        angle: f64,
    },
    /// Impacts follow each other so fast that a step has too many of them: they accumulate where the motion
    /// comes to rest on a surface, or the step is too long.
    #[error(
        "a step has more than {impacts} impacts, the last on surface {surface} at t = {time}: they accumulate, as those of a ball that \
         comes to rest, or the step is too long"
    )]
    Accumulation {
        /// The surface of the last one, counted from 0 in the order of declaration.
        surface: usize,
        /// How many impacts a step of this method may have.
        impacts: usize,
        /// The time of the last one.
        time: f64,
    },
    /// Events follow each other ever faster: after each of them the state was set, and the next one came in
    /// a small part of a step.
    #[error(
        "event {event} is the last of {count} hops, at t = {time}: they accumulate, as those of a ball that \
         comes to rest"
    )]
    Hops {
        /// The condition, counted from 0.
        event: usize,
        /// How many hops there were.
        count: usize,
        /// The time of the last one.
        time: f64,
    },
    /// The motion is led back to a [seam](crate::Lagrangian::seam) from either side, as by dry friction at
    /// rest: it has crossed it again and again in small parts of a step, and does not leave it.
    #[error(
        "the motion crosses seam {seam}, where a formula is not smooth, again and again, the last time at \
         t = {time}: it does not leave it, as a body at rest does not under dry friction; there write it \
         without a jump, as with `tanh`"
    )]
    Seam {
        /// Its number, counted from 0, as the report lists them.
        seam: usize,
        /// The time of the last crossing.
        time: f64,
    },
    /// A gap function, or its rate of change, is infinite or not a number.
    #[error(
        "the gap of surface {surface}, or its rate of change, became {value}: its formula left its domain"
    )]
    Gap {
        /// The surface, counted from 0 in the order of declaration.
        surface: usize,
        /// The value.
        value: f64,
    },
    /// The motion lies on a surface and is pressed on it: it neither leaves nor bounces.
    #[error(
        "the motion lies on surface {surface} and does not leave it: its gap is {gap:e}, and the rate of change of it {rate:e}; such a \
         contact is no impact, a constraint would keep it"
    )]
    Contact {
        /// The surface, counted from 0 in the order of declaration.
        surface: usize,
        /// Its gap function.
        gap: f64,
        /// The rate of change of that.
        rate: f64,
    },
    /// A velocity does not keep a constraint to rounding errors, however often its equations are solved:
    /// they say too little of what is asked.
    #[error(
        "constraint {constraint} of the velocity, or its rate of change, is still {value:e}, more than rounding errors: it depends on those \
         before it but for rounding, or masses differ by too much"
    )]
    OffConstraint {
        /// Its number, counted from 0 in the order of declaration.
        constraint: usize,
        /// Its value.
        value: f64,
    },
    /// A constraint is infinite or not a number.
    #[error(
        "constraint {constraint} became {value}: a formula that left its domain, or a step that is too long"
    )]
    UndefinedConstraint {
        /// Its number, counted from 0 in the order of declaration.
        constraint: usize,
        /// Its value.
        value: f64,
    },
    /// A condition of [`Events`](crate::run::Events) is not a number.
    #[error("condition {event} of the events is not a number here")]
    UndefinedEvent {
        /// Its number, counted from 0.
        event: usize,
    },
    /// The energy has changed by more than the limit of the run
    /// ([`EnergyLimit`](crate::methods::EnergyLimit)).
    #[error(
        "the energy was {start:e} at the start and would become {now:e}; the limit of its change is {limit:e}"
    )]
    Energy {
        /// The energy at the start of the run.
        start: f64,
        /// The energy after the step that failed.
        now: f64,
        /// The largest change that was allowed.
        limit: f64,
    },
    /// The parasitic mode of a two-step method has taken over: what the run computes is no longer its
    /// motion.
    #[error(
        "the parasitic mode has reached {relative:.3} times a quarter of the smooth second differences, amplitude \
         {amplitude:e}; the limit is {limit}: take another sigma or method, or smaller steps for a later end"
    )]
    ParasiticMode {
        /// Its amplitude in the coordinates.
        amplitude: f64,
        /// Its size, relative to h²q̈/4: see
        /// [`ParasiticMode::relative`](crate::methods::ParasiticMode::relative).
        relative: f64,
        /// The largest relative size that was allowed.
        limit: f64,
    },
    /// Ω or the mass matrix has changed its orientation within the step: it is singular somewhere on the
    /// way, and the motion does not lead across. What is watched is the sign of a pair of coordinates, the
    /// sign of the Pfaffian of Ω, or the number of negative eigenvalues of the mass matrix, at the end of
    /// each step. So two passages within one step are not seen, nor a positive and a negative eigenvalue of
    /// a mass matrix that change their signs in one step, nor two pivots of Ω that vanish together, unless Ω
    /// couples the coordinates in pairs.
    #[error(
        "{matrix} has changed its sign within the step, from {before:e} to {after:e}: it is singular in between, and \
         the motion is not determined there"
    )]
    Orientation {
        /// Which matrix.
        matrix: &'static str,
        /// At the start of the step: the entry of Ω that has changed its sign, if Ω couples the coordinates
        /// in pairs; else the smallest pivot of Ω, with the sign of the Pfaffian; or the smallest pivot of
        /// the mass matrix on the side of zero that has been left.
        before: f64,
        /// The same at the end of the step.
        after: f64,
    },
    /// The density of steps that a step control carries along is no density any more.
    #[error(
        "the density of steps became {density:e}; it must be positive and finite: a smaller epsilon helps, \
         unless the density is zero or infinite at this place, as a power of the distance is at the origin"
    )]
    Density {
        /// Its value.
        density: f64,
    },
    /// No length of the step near the last one gives the discrete energy of the run.
    #[error(
        "no step keeps the discrete energy: the best length found, h = {h:e}, leaves a defect of {defect:e}; a shorter first step \
         or another rule may help"
    )]
    EnergyStep {
        /// The length with the smallest defect that was found.
        h: f64,
        /// The discrete energy of that step without that of the run.
        defect: f64,
    },
    /// No step, however short, has an error within the tolerance of the run
    /// ([`ErrorControl`](crate::run::ErrorControl)).
    #[error(
        "no step meets the tolerance: the shortest that was tried, h = {h:e}, has an estimated error of {error:e} times what is \
         allowed; a collision, or a demand out of reach"
    )]
    Tolerance {
        /// The length of the shortest step that was tried.
        h: f64,
        /// Its estimated error, in units of what the tolerance allows.
        error: f64,
    },
    /// A step control asks for a step that does not advance the time, or leads to none that is finite, or is
    /// so short that 1/h may be infinite.
    #[error(
        "the step control asks for h = {h:e}, which does not advance the time, leads to none that is \
         finite, or is below the smallest number that has all digits: a collision, or a demand out of \
         reach"
    )]
    StepLength {
        /// The step, perhaps not finite.
        h: f64,
    },
    /// A run is asked for a state at a time, or to [advance to one](crate::run::Dense::advance_to), that it
    /// has passed, in the direction in which it goes, or that is not finite. It has taken no step, and can
    /// go on to another time.
    #[error("the run is at t = {now} and does not come to t = {target} in its direction of time")]
    Unreachable {
        /// The time of the run, or where its last step began if states within that can be asked for.
        now: f64,
        /// The time that was asked for.
        target: f64,
    },
    /// The physical time would stand still or run backwards: the time transformation is not positive any
    /// more at the end of the step, or was negative on the way.
    #[error(
        "the physical time went at the rate {rate:e} in the step and must go forward: the time transformation is not positive on \
         the way, or the step is too short for the digits of the time"
    )]
    TimeRate {
        /// ρ at the end of the step, or its mean over the step if that is smaller.
        rate: f64,
    },
    /// A function that holds data was evaluated outside of its table. The argument is the one at the state
    /// where the step began or, if that lies inside, at the first point outside on a parabola that the
    /// motion follows from there, up to two steps ahead: iterates of a step and their guesses lie beyond it.
    /// Where the motion itself stays inside, a smaller step helps.
    #[error("the step leaves a table: {0}")]
    Outside(OutsideError),
    /// The step ends outside of the domain of L or of a force: the argument of a root, a logarithm or a
    /// power is negative there, that of an inverse function out of its range, or a function that is called
    /// is no number.
    #[error(
        "the step ends outside of the domain of a formula, as beyond the zero of what a root or a \
         logarithm is taken of: the motion leads there, or the step is too long"
    )]
    LeftDomain,
    /// A coordinate became infinite or not a number: a collision, a formula that left its domain, or a step
    /// that is too long.
    #[error("{}", Of(self, None))]
    NotFinite {
        /// The flat index of the coordinate; a [`StepError`](crate::error::StepError) has its name.
        coordinate: usize,
        /// Its value.
        value: f64,
    },
}

/// The result of a step is returned through every call of a run: with failures of seven words in place of
/// five, steps of phase-fitted schemes took 13 % to 16 % more instructions.
const _: () = assert!(size_of::<StepFailure>() <= 40);

impl StepFailure {
    pub(crate) const DISCRETE_LAGRANGIAN: &'static str = "the matrix D₁D₂L_d of the discrete Lagrangian";
    pub(crate) const MASS: &'static str = "the mass matrix";
    #[cfg(feature = "random")]
    pub(crate) const MASS_ROOT: &'static str = "the root of the mass matrix";
    pub(crate) const OMEGA: &'static str = "Ω = −dα";
    pub(crate) const STAGES: &'static str = "the matrix of the equations of the stages";

    /// The same where it is `matrix` that is solved with.
    #[cold]
    pub(crate) fn of(self, matrix: &'static str) -> Self {
        match self {
            Self::Singular { column, pivot, .. } => Self::Singular { matrix, column, pivot },
            other => other,
        }
    }

    /// The place of the coordinate that it counts.
    pub(crate) fn coordinate(&self) -> Option<usize> {
        match *self {
            Self::NotFinite { coordinate: place, .. }
            | Self::Singular { column: place, .. }
            | Self::Pattern { column: place, .. } => Some(place),
            _ => None,
        }
    }
}
