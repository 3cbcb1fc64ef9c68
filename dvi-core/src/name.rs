//! Names of the entries of a state, for tables and for errors.

use core::fmt;

use crate::system::Factor;

/// The name of an entry of a state: `x`, `x[3]`, `dot_x[3]`, `omega_R[2]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Name {
    /// The name of the block of coordinates.
    pub block: &'static str,
    /// Whether it is the velocity.
    pub is_velocity: bool,
    /// The index in an array of coordinates.
    pub index: Option<usize>,
    /// Where the block lives.
    pub factor: Factor,
}

impl fmt::Display for Name {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let prefix = match (self.is_velocity, self.factor) {
            (false, _) => "",
            (true, Factor::Line | Factor::Sphere) => "dot_",
            (true, Factor::Rotation) => "omega_",
        };
        match self.index {
            Some(index) => write!(f, "{prefix}{}[{index}]", self.block),
            None => write!(f, "{prefix}{}", self.block),
        }
    }
}

/// " along `x[3]`", or nothing.
pub(crate) struct Along<'a>(pub(crate) &'a Option<Name>);

impl fmt::Display for Along<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.map_or(Ok(()), |name| write!(f, " along `{name}`"))
    }
}
