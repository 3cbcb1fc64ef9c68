//! Names of the entries of a state, for tables and for errors, and where blocks of coordinates live.

use core::fmt;

/// Where the coordinates of a block live: the configuration space is the product of these.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Factor {
    /// ℝⁿ: `x`, or `x[n]`.
    #[default]
    Line,
    /// SO(3): `R: SO3` or `R[n]: SO3`. The coordinates are the nine entries of a rotation matrix, row by
    /// row, which takes vectors of the body to those of space. The velocities are the three entries of the
    /// angular velocity in the body, ω with Ṙ = R ω̂, ω̂ x = ω × x.
    Rotation,
    /// S²: `s: S2` or `s[n]: S2`. The coordinates are the entries of a unit vector, the velocities those of
    /// its rate of change. Of a degenerate system, whose states have these entries too, the flat coordinates
    /// are four, those of a spinor z with s = z†σz.
    Sphere,
}

impl Factor {
    /// How many velocities belong to so many coordinates, those of one rotation or one unit vector.
    #[inline]
    pub fn velocities(self, coordinates: usize) -> usize {
        match self {
            Self::Line | Self::Sphere => coordinates,
            Self::Rotation => 3,
        }
    }

    /// The dimension of so many coordinates, those of one rotation or one unit vector.
    #[inline]
    pub fn dimension(self, coordinates: usize) -> usize {
        match self {
            Self::Line => coordinates,
            Self::Rotation => 3,
            Self::Sphere => 2,
        }
    }
}

/// Which component of a vector a block of coordinates has: `r[n][3]` has a block for each.
///
/// ```
/// use dvi_core::system::Axis;
///
/// assert_eq!(Axis { number: 1, of: 3 }.to_string(), ".y");
/// assert_eq!(Axis { number: 1, of: 4 }.to_string(), "[1]");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Axis {
    /// Counted from 0.
    pub number: u8,
    /// The number of components.
    pub of: u8,
}

impl fmt::Display for Axis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match ["x", "y", "z"].get(usize::from(self.number)).filter(|_| self.of <= 3) {
            Some(axis) => write!(f, ".{axis}"),
            None => write!(f, "[{}]", self.number),
        }
    }
}

/// The name of an entry of a state: `x`, `x[3]`, `q[2][3]`, `r[3].x`, `dot_x[3]`, `omega_R[2]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Name {
    /// The name of the block of coordinates.
    pub block: &'static str,
    /// Whether it is the velocity.
    pub is_velocity: bool,
    /// The first index, of coordinates with two.
    pub row: Option<usize>,
    /// The index in an array of coordinates, or in a row.
    pub index: Option<usize>,
    /// The component, of vectors.
    pub axis: Option<Axis>,
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
        write!(f, "{prefix}{}", self.block)?;
        InArray(&self.row).fmt(f)?;
        InArray(&self.index).fmt(f)?;
        self.axis.map_or(Ok(()), |axis| write!(f, "{axis}"))
    }
}

/// `[3]`, or nothing.
pub(crate) struct InArray<'a>(pub(crate) &'a Option<usize>);

impl fmt::Display for InArray<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.map_or(Ok(()), |index| write!(f, "[{index}]"))
    }
}

/// An argument of a function that formulas call.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Argument {
    /// The function, by the name that the formulas call it by.
    pub function: &'static str,
    /// Which of its arguments, counted from 1.
    pub number: usize,
}

/// " along `x[3]`", or nothing.
pub(crate) struct Along<'a>(pub(crate) &'a Option<Name>);

impl fmt::Display for Along<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.map_or(Ok(()), |name| write!(f, " along `{name}`"))
    }
}
