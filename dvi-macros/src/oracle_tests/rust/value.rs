//! The values of the interpreted subset.

use std::rc::Rc;

/// The type of an integer. A literal without a suffix takes that of what it meets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Kind {
    Usize,
    I64,
    I32,
    Open,
    F64,
}

/// What a field of the struct holds.
#[derive(Clone, Debug)]
pub(crate) enum Nested {
    Number(f64),
    Count(usize),
    List(Vec<Rc<Nested>>),
}

#[derive(Clone, Debug)]
pub(crate) enum Value {
    Unit,
    Bool(bool),
    Integer(i128, Kind),
    Real(f64),
    Text(String),
    Tuple(Vec<Value>),
    /// A part of an array of the machine.
    View {
        array: usize,
        start: usize,
        length: usize,
    },
    /// A place in the struct.
    Place(Rc<Nested>),
    /// The weights of the four blocks: qq, qv, vq, vv.
    Weights([f64; 4]),
    /// A function of several variables at a point, and the axes that were asked for so far.
    Expansion {
        place: String,
        at: Vec<f64>,
        axes: Vec<usize>,
    },
    /// First or second derivatives of an expansion.
    Derivatives(Box<Value>, usize),
    /// The struct itself.
    System,
    /// An `Err`, in words.
    Failure(String),
}

impl Value {
    /// An integer, or a field of type `usize`.
    pub(crate) fn integer(&self) -> i128 {
        match self {
            Self::Integer(value, _) => *value,
            Self::Place(place) => match **place {
                Nested::Count(count) => count as i128,
                ref other => panic!("{other:?} is no integer"),
            },
            other => panic!("{other:?} is no integer"),
        }
    }

    /// A real number, or a field that is one.
    pub(crate) fn real(&self) -> f64 {
        match self {
            Self::Real(value) => *value,
            Self::Place(place) => match **place {
                Nested::Number(value) => value,
                Nested::Count(count) => count as f64,
                ref other => panic!("{other:?} is no number"),
            },
            other => panic!("{other:?} is no number"),
        }
    }
}

impl Kind {
    /// Whether a value of this type can hold the number.
    pub(super) fn holds(self, value: i128) -> bool {
        match self {
            Self::Usize => u64::try_from(value).is_ok(),
            Self::I64 | Self::Open => i64::try_from(value).is_ok(),
            Self::I32 => i32::try_from(value).is_ok(),
            Self::F64 => false,
        }
    }

    /// The type of an operation on two integers.
    pub(super) fn joined(self, other: Self) -> Self {
        match (self, other) {
            (Self::Open, kind) | (kind, Self::Open) => kind,
            _ => {
                assert_eq!(self, other, "integers of different types");
                self
            }
        }
    }
}
