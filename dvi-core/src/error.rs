//! Failures as values: small, `Copy`, with the numbers in them.

use thiserror::Error;

use crate::name::Name;

/// An array of a state does not have the length that its system declares.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("`{array}` has length {found}, but the system declares {expected}")]
pub struct LengthError {
    /// The array.
    pub array: &'static str,
    /// The declared length.
    pub expected: usize,
    /// The length that was given.
    pub found: usize,
}

/// A formula goes beyond the end of an array.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("the formulas use index {index} of `{array}`, which has length {len}")]
pub struct IndexError {
    /// The array, a coordinate or a parameter.
    pub array: &'static str,
    /// The index, negative if a formula steps below zero.
    pub index: i64,
    /// The length of the array.
    pub len: usize,
}

/// A function that holds data is evaluated where it is not known.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error(
    "`{}` is not known there: its argument {} is {value}, and must be at {} {bound}",
    .argument.function,
    .argument.number,
    if *.value > *.bound { "most" } else { "least" }
)]
pub struct OutsideError {
    /// The argument that leaves the [domain](crate::ScalarField::domain).
    pub argument: &'static Argument,
    /// Its value.
    pub value: f64,
    /// The end of the domain that it has passed; if the value is not a number, the least value that it may have.
    pub bound: f64,
}

/// An argument of a function that formulas call.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Argument {
    /// The function, by the name that the formulas call it by.
    pub function: &'static str,
    /// Which of its arguments, counted from 1.
    pub number: usize,
}

/// A run that cannot begin.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum StartError {
    /// The step is zero, infinite or not a number.
    #[error("the step h = {h} must be finite and different from zero")]
    Step {
        /// The step that was given.
        h: f64,
    },
    /// An option of the method is out of its range.
    #[error("{name} = {value} is out of range: {range}")]
    Parameter {
        /// The option.
        name: &'static str,
        /// The value that was given.
        value: f64,
        /// What is allowed.
        range: &'static str,
    },
    /// An option does not go with the system or with another option.
    #[error("{option} is not available here: {reason}")]
    Unsupported {
        /// The option.
        option: &'static str,
        /// What it needs.
        reason: &'static str,
    },
    /// A coordinate or velocity of the initial state is infinite or not a number.
    #[error("{entry} = {value} in the state")]
    NotFinite {
        /// Its name.
        entry: Name,
        /// Its value.
        value: f64,
    },
    /// The energy, or a derivative of L, is infinite or not a number at the initial state.
    #[error(
        "{quantity} is {value} at the initial state: a parameter is not a number, or the state lies outside of the \
         domain of the formulas"
    )]
    Undefined {
        /// What was evaluated.
        quantity: &'static str,
        /// Its coordinate, counted from 0 in the flat state; `None` for the energy.
        coordinate: Option<usize>,
        /// Its value.
        value: f64,
    },
    /// The time transformation is not positive at the initial state.
    #[error("the time transformation is {rate} at the initial state: it must be positive and finite")]
    TimeRate {
        /// ρ.
        rate: f64,
    },
    /// In a system whose time is transformed, the coordinate `energy` is not the value of the Hamiltonian.
    #[error(
        "the coordinate `energy` is {energy}, but the Hamiltonian is {hamiltonian} at the initial state: begin with \
         `system.with_energy(state)`"
    )]
    EnergyCoordinate {
        /// The coordinate.
        energy: f64,
        /// H before the time transformation.
        hamiltonian: f64,
    },
    /// The initial state is not on a constraint.
    #[error(
        "constraint {constraint} is {value:e} at the initial state and has to be zero: begin with \
         `system.projected(t, &state)`"
    )]
    OffConstraint {
        /// Its number, counted from 0 in the order of declaration.
        constraint: usize,
        /// Its value, in the units of its formula.
        value: f64,
    },
    /// The initial velocity leads away from a constraint, or is not admitted by one of velocities.
    #[error(
        "the initial velocity is not one along constraint {constraint}: its rate of change, or a constraint of velocities itself, is \
         {rate:e} and has to be zero; begin with `system.projected(t, &state)`"
    )]
    AcrossConstraint {
        /// Its number, counted from 0 in the order of declaration.
        constraint: usize,
        /// G v + ∂g/∂t, in units of the formula over time; of a constraint of velocities its value.
        rate: f64,
    },
    /// No state on the constraints was found near one.
    #[error(
        "no state on all constraints was found near this one: constraint {constraint} is still {value:e}; the constraints \
         contradict each other, or the state is too far away"
    )]
    Inconsistent {
        /// The number of the constraint with the largest value, counted from 0 in the order of declaration.
        constraint: usize,
        /// That value.
        value: f64,
    },
    /// A function that holds data is not known at the initial state.
    #[error(transparent)]
    Outside(#[from] OutsideError),
    /// An array of the state has the wrong length.
    #[error(transparent)]
    Length(#[from] LengthError),
    /// A parameter array is too short for the formulas.
    #[error(transparent)]
    Index(#[from] IndexError),
    /// The step that computes the starting values failed.
    #[error("the starting step failed: {0}")]
    Starter(StepFailure),
    /// The rates of change of a state cannot be computed.
    #[error("the motion is not determined at this state: {0}")]
    Undetermined(StepFailure),
    /// A checkpoint is not one of this method on this system.
    #[error(transparent)]
    Checkpoint(#[from] CheckpointError),
}

/// A checkpoint that does not fit the run that is to go on from it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum CheckpointError {
    /// It has less than the method carries.
    #[error("the checkpoint has less than this method on this system carries: it is one of another run")]
    Short,
    /// It has more than the method carries.
    #[error(
        "the checkpoint has {more} numbers more than this method on this system carries: it is one of another run"
    )]
    Long {
        /// How many numbers and counts were not read.
        more: usize,
    },
    /// It has numbers or counts that no run has.
    #[error("the checkpoint is damaged: it has numbers or counts that no run has")]
    Damaged,
    /// It has another number of velocities.
    #[error("the checkpoint has {found} velocities, but the system has {expected}")]
    Velocities {
        /// The dimension of the system, or zero if it is degenerate.
        expected: usize,
        /// The velocities of the checkpoint.
        found: usize,
    },
    /// It has another number of coordinates.
    #[error("the checkpoint has {found} coordinates, but the system has {expected}")]
    Coordinates {
        /// The dimension of the system.
        expected: usize,
        /// The coordinates of the checkpoint.
        found: usize,
    },
}

/// Why a step could not be completed.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum StepFailure {
    /// The iteration ran out of its budget or moved away from a solution.
    #[error(
        "no convergence: after {iterations} iterations the correction is {correction:e}, \
         {tolerance:e} was asked for; a smaller step helps"
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
        /// S = Σ w cos((1 − 2c)u), which multiplies the new point; with interior displacements, what multiplies
        /// it in place of S.
        cosine_sum: f64,
    },
    /// A matrix has an entry where its pattern, which decided its storage when the run began, has none.
    #[error("the matrix of the step has an entry ({row}, {column}) that its pattern does not have")]
    Pattern {
        /// The coordinate of its row, counted from 0.
        row: usize,
        /// That of its column.
        column: usize,
    },
    /// The frequency of a phase-fitted interpolation is not a number, or infinite.
    #[error("phase fitting breaks down: the frequency is {omega}; it is not defined at this state")]
    Frequency {
        /// The frequency, or its product with the step.
        omega: f64,
    },
    /// A matrix that must be solved with is singular to working precision.
    #[error(
        "singular matrix: pivot {pivot:e} in column {column}; Ω, the mass matrix, or the discrete Lagrangian is degenerate here"
    )]
    Singular {
        /// The column without a usable pivot.
        column: usize,
        /// The largest candidate.
        pivot: f64,
    },
    /// The gradient of a constraint vanishes, or depends linearly on those of the constraints before it: it says nothing that these do
    /// not say, or contradicts them. Its multiplier is not determined then.
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
    /// A step turns the gradient of a constraint by a right angle or more, or leads away from a constraint that does not move by more than
    /// 45°, in the metric of the mass matrix: the equations of the step have several solutions then, and this one need not be that of the
    /// motion.
    #[error(
        "the step turns the gradient of constraint {constraint} by a right angle or more, where its equations have other solutions \
         than the motion: a smaller step helps, unless the constraint is singular on the way"
    )]
    Turned {
        /// Its number, counted from 0 in the order of declaration.
        constraint: usize,
    },
    /// The equations of a step with constraints have been solved on another branch than that of the motion, as a rod may point to
    /// either side: the determinant of G(q1) M⁻¹ G(q0)ᵀ has another sign than that of a short step.
    #[error(
        "the step comes out at another solution of its constraints than that of the motion: a smaller step helps, unless the \
         constraints are singular on the way"
    )]
    Branch,
    /// The energy has changed by more than the limit of the run ([`EnergyLimit`](crate::methods::EnergyLimit)).
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
    /// The parasitic mode of a two-step method has taken over: what the run computes is no longer its motion.
    #[error(
        "the parasitic mode has reached {relative:.3} times a quarter of the smooth second differences, amplitude \
         {amplitude:e}; the limit is {limit}: take another sigma or method, or smaller steps for a later end"
    )]
    ParasiticMode {
        /// Its amplitude in the coordinates.
        amplitude: f64,
        /// Its size, relative to h²q̈/4: see [`ParasiticMode::relative`](crate::methods::ParasiticMode::relative).
        relative: f64,
        /// The largest relative size that was allowed.
        limit: f64,
    },
    /// A two-step method has no smooth orbit here: what was found alternates too much for its increments. The step is too
    /// long for [`Start::Smooth`](crate::methods::Start::Smooth) and [`Reinitialisation`](crate::methods::Reinitialisation).
    #[error(
        "the scheme has no smooth orbit at this step: {alternating:e} alternates beside an increment of {increment:e}; a \
         smaller step helps"
    )]
    NotSmooth {
        /// The largest entry of the central difference of eighth order of the points.
        alternating: f64,
        /// That of the increment h q'.
        increment: f64,
    },
    /// Ω or the mass matrix has changed its orientation within the step: it is singular somewhere on the way, and the
    /// motion does not lead across. What is watched is the sign of a pair of coordinates, the sign of the Pfaffian of Ω, or
    /// the number of negative eigenvalues of the mass matrix, at the end of each step. So two passages within one step are
    /// not seen, nor a positive and a negative eigenvalue of a mass matrix that change their signs in one step, nor two
    /// pivots of Ω that vanish together, unless Ω couples the coordinates in pairs.
    #[error(
        "{matrix} has changed its sign within the step, from {before:e} to {after:e}: it is singular in between, and \
         the motion is not determined there"
    )]
    Orientation {
        /// Which matrix.
        matrix: &'static str,
        /// At the start of the step: the entry of Ω that has changed its sign, if Ω couples the coordinates in pairs; else
        /// the smallest pivot of Ω, with the sign of the Pfaffian; or the smallest pivot of the mass matrix on the side of
        /// zero that has been left.
        before: f64,
        /// The same at the end of the step.
        after: f64,
    },
    /// The density of steps that a step control carries along is no density any more.
    #[error(
        "the density of steps became {density:e}; it must be positive and finite: a smaller epsilon helps"
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
    /// A step control asks for a step that does not advance the time.
    #[error(
        "the step control asks for h = {h:e}, which does not advance the time: a collision, or a demand out of reach"
    )]
    StepLength {
        /// The step, perhaps not finite.
        h: f64,
    },
    /// The physical time would stand still or run backwards: the time transformation is not positive any more at the end of
    /// the step, or was negative on the way.
    #[error(
        "the physical time went at the rate {rate:e} in the step and must go forward: the time transformation is not positive on \
         the way, or the step is too short for the digits of the time"
    )]
    TimeRate {
        /// ρ at the end of the step, or its mean over the step if that is smaller.
        rate: f64,
    },
    /// A function that holds data was evaluated outside of its table. The argument is the one at the state where the step began
    /// or, if that lies inside, at the first point outside on a parabola that the motion follows from there, up to two steps
    /// ahead: iterates of a step and their guesses lie beyond it. Where the motion itself stays inside, a smaller step helps.
    #[error("the step leaves a table: {0}")]
    Outside(OutsideError),
    /// A coordinate became infinite or not a number: a collision, a formula that left its domain, or a step that is too long.
    #[error(
        "coordinate {coordinate} became {value}: a collision, a formula that left its domain, or a step that is too long"
    )]
    NotFinite {
        /// The flat index of the coordinate.
        coordinate: usize,
        /// Its value.
        value: f64,
    },
}

/// A step that failed, and where. The run keeps the last good state.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("step {step} from t = {time}: {failure}")]
pub struct StepError {
    /// The number of steps completed before this one.
    pub step: u64,
    /// The time at which the failed step began.
    pub time: f64,
    /// Why.
    pub failure: StepFailure,
}

/// The result of a step is returned through every call of a run: with failures of seven words in place of five, steps of
/// phase-fitted schemes took 13 % to 16 % more instructions.
const _: () = assert!(size_of::<StepFailure>() <= 40);
