//! Failures as values: small, `Copy`, with the numbers in them.

mod failure;
mod step;

use thiserror::Error;

use crate::name::{Along, Argument, InArray, Name};

pub use failure::StepFailure;
pub use step::StepError;

/// Errors whose `Debug` is their sentence, which is what `main` prints of an error that it returns, and
/// `expect` too.
macro_rules! said {
    ($($error:ty),+) => {$(
        impl core::fmt::Debug for $error {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                core::fmt::Display::fmt(self, f)
            }
        }
    )+};
}
pub(crate) use said;

said!(LengthError, IndexError, OutsideError, StartError, CheckpointError);

/// An array of a state does not have the length that its system declares.
#[derive(Clone, Copy, PartialEq, Eq, Error)]
#[error("`{array}{}` has length {found}, but the system declares {expected}", InArray(.row))]
pub struct LengthError {
    /// The array.
    pub array: &'static str,
    /// The first index, if it is a row of an array with two indices.
    pub row: Option<usize>,
    /// The declared length.
    pub expected: usize,
    /// The length that was given.
    pub found: usize,
}

/// A formula goes beyond the end of an array.
#[derive(Clone, Copy, PartialEq, Eq, Error)]
#[error("the formulas use index {index} of `{array}`, which has length {len}")]
pub struct IndexError {
    /// The array, a coordinate or a parameter; `q[i]` for the second index of coordinates with two.
    pub array: &'static str,
    /// The index, negative if a formula steps below zero.
    pub index: i64,
    /// The length of the array.
    pub len: usize,
}

/// A function that holds data is evaluated where it is not known.
#[derive(Clone, Copy, PartialEq, Error)]
#[error(
    "`{}` is not known there: its argument {} is {value}, and must be at {} {bound}",
    .argument.function,
    .argument.number,
    if *.value > *.bound { "most" } else { "least" }
)]
pub struct OutsideError {
    /// The argument that leaves the [domain](crate::ScalarField::domain): the name of the `function`, and the
    /// `number` of the argument, counted from 1.
    pub argument: &'static Argument,
    /// Its value.
    pub value: f64,
    /// The end of the domain that it has passed; if the value is not a number, the least value that it may
    /// have.
    pub bound: f64,
}

/// A run that cannot begin.
///
/// ```
#[doc = include_str!("../docs/hidden/pendulum.txt")]
/// use dvi_core::error::StartError;
///
/// let lost = PendulumState { angle: f64::NAN, ..start };
/// let error = Integrator::new(&Pendulum, Variational::trapezoid(), 0.01, lost).unwrap_err();
/// assert!(matches!(error, StartError::NotFinite { .. }));
/// assert_eq!(error.to_string(), "angle = NaN in the state");
/// ```
#[derive(Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum StartError {
    /// The step is zero, infinite or not a number; or it is so short that the time stays what it is or that
    /// 1/h may be infinite, or so long that the time of some later step may be.
    #[error(
        "the step h = {h:e} must move the time, by no less than the smallest number that has all digits, \
         and lead to finite times"
    )]
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
        "{quantity}{} is {value} at the initial state: a parameter is not a number, or the state lies \
         outside of the domain of the formulas",
        Along(.coordinate)
    )]
    Undefined {
        /// What was evaluated.
        quantity: &'static str,
        /// The coordinate that it belongs to; `None` for the energy.
        coordinate: Option<Name>,
        /// Its value.
        value: f64,
    },
    /// The mass matrix, or Ω = −dα, says nothing of a coordinate: its row is zero, so that the motion is not
    /// determined.
    #[error(
        "{matrix} is singular at the initial state: its row for `{entry}` has the size {size:e}, so that \
         nothing determines the motion of this coordinate"
    )]
    Singular {
        /// Which matrix.
        matrix: &'static str,
        /// The coordinate.
        entry: Name,
        /// The sum of the sizes of the entries of its row.
        size: f64,
    },
    /// The mass matrix, or Ω = −dα, says nothing of a coordinate that it does not say of those before it.
    #[error(
        "{matrix} is singular at the initial state: its pivot for `{entry}` is {pivot:e}, so that nothing \
         determines the motion of this coordinate beside those before it"
    )]
    Dependent {
        /// Which matrix.
        matrix: &'static str,
        /// The coordinate.
        entry: Name,
        /// The largest candidate for a pivot.
        pivot: f64,
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
    /// A constraint, or its rate of change, is infinite or not a number at the initial state.
    #[error(
        "constraint {constraint} is {value} at the initial state: a parameter is not a number, or the state lies outside of the \
         domain of its formula"
    )]
    UndefinedConstraint {
        /// Its number, counted from 0 in the order of declaration.
        constraint: usize,
        /// Its value.
        value: f64,
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
    /// The initial state is beyond a surface of impacts.
    #[error(
        "gap {surface} is {gap:e} at the initial state and must not be negative: the state is beyond this surface of impacts"
    )]
    Beyond {
        /// The number of the surface, counted from 0 in the order of declaration.
        surface: usize,
        /// Its gap function, in the units of its formula.
        gap: f64,
    },
    /// The initial state is not on the manifold that is declared: a matrix is no rotation, or a vector has
    /// another length than one or a velocity that would change it.
    #[error(
        "`{block}{}` is off by {defect:e} in the state, and {tolerance:e} is allowed: a rotation is an orthogonal matrix with determinant 1, a \
         unit vector has length 1 and a velocity at right angles to it; `rotations::exp` makes rotations",
        InArray(.index)
    )]
    OffManifold {
        /// The name of the coordinates.
        block: &'static str,
        /// Which of them it is, if they are an array.
        index: Option<usize>,
        /// The largest entry of RᵀR − 1, or the larger of |s·s − 1| and |s·ṡ|/|ṡ|.
        defect: f64,
        /// What is allowed.
        tolerance: f64,
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
    /// The equations for a state on the constraints near another one have no solution.
    #[error("no state on the constraints can be computed near this one: {0}")]
    Projection(StepFailure),
    /// The rates of change of a state cannot be computed.
    #[error("the motion is not determined at this state: {0}")]
    Undetermined(StepFailure),
    /// A checkpoint is not one of this method on this system.
    #[error(transparent)]
    Checkpoint(#[from] CheckpointError),
}

impl StartError {
    /// [`Parameter`](Self::Parameter), unless the `value` of an option is in its `range`.
    pub(crate) fn unless(
        in_range: bool,
        name: &'static str,
        value: f64,
        range: &'static str,
    ) -> Result<(), Self> {
        if in_range { Ok(()) } else { Err(Self::Parameter { name, value, range }) }
    }

    /// [`Unsupported`](Self::Unsupported), unless an option `goes` with the system and with others.
    pub(crate) fn unless_it(goes: bool, option: &'static str, reason: &'static str) -> Result<(), Self> {
        if goes { Ok(()) } else { Err(Self::Unsupported { option, reason }) }
    }
}

/// A checkpoint that does not fit the run that is to go on from it.
#[derive(Clone, Copy, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum CheckpointError {
    /// It has less than method and step control carry.
    #[error(
        "the checkpoint has less than this method and this step control carry on this system: it is one of \
         another method or step control"
    )]
    Short,
    /// It has more than method and step control carry.
    #[error(
        "the checkpoint has {more} numbers more than this method and this step control carry on this system: \
         it is one of another method or step control"
    )]
    Long {
        /// How many numbers and counts were not read.
        more: usize,
    },
    /// What is read is not what was written. The error of the reader has this text.
    #[error(
        "the checkpoint has changed since it was taken: its numbers and counts do not go with its \
         checksum; a text format that rounds numbers does that (serde_json needs its feature \
         `float_roundtrip`)"
    )]
    Changed,
    /// It has numbers or counts that no run has.
    #[error("the checkpoint is damaged: it has numbers or counts that no run has")]
    Damaged,
    /// It has another number of coordinates or velocities.
    #[error("the checkpoint has {found} {what}, but the system has {expected}")]
    Size {
        /// `"coordinates"` or `"velocities"`.
        what: &'static str,
        /// How many the system has.
        expected: usize,
        /// How many the checkpoint has.
        found: usize,
    },
}
