//! What the compiler knows of coordinates that are rotations or unit vectors.

use crate::system::{Manifold, NondegenerateLagrangian, System};
use crate::{Scalar, Space};

/// Where the coordinates of a block live: the configuration space is the product of these.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Factor {
    /// ℝⁿ: `x`, or `x[n]`.
    #[default]
    Line,
    /// SO(3): `R: SO3`. The coordinates are the nine entries of a rotation matrix, row by row, which takes
    /// vectors of the body to those of space. The velocities are the three entries of the angular velocity
    /// in the body, ω with Ṙ = R ω̂, ω̂ x = ω × x.
    Rotation,
    /// S²: `s: S2`. The coordinates are the entries of a unit vector, the velocities those of its rate of
    /// change.
    Sphere,
}

impl Factor {
    /// How many velocities a block of so many coordinates has.
    pub fn velocities(self, coordinates: usize) -> usize {
        match self {
            Self::Line | Self::Sphere => coordinates,
            Self::Rotation => 3,
        }
    }

    /// The dimension of a block of so many coordinates.
    pub fn dimension(self, coordinates: usize) -> usize {
        match self {
            Self::Line => coordinates,
            Self::Rotation => 3,
            Self::Sphere => 2,
        }
    }
}

/// A system with rotations or unit vectors, whatever numbers it is computed in.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no rotations and no unit vectors",
    label = "none of its coordinates is declared as `R: SO3` or `s: S2`",
    note = "regular systems without these are stepped by `Variational`, `Galerkin` or `Newmark`"
)]
pub trait ManifoldSystem: System {
    /// The space of tangent vectors.
    type Tangent: Space;

    /// The space of tangent vectors of this system. Its dimension is that of the manifold: 3 for a rotation,
    /// 2 for a unit vector.
    fn tangent(&self) -> Self::Tangent;
}

/// A regular Lagrangian on ℝⁿ × SO(3) × … × S² × …, declared by coordinates such as `R: SO3` and `s: S2`.
///
/// The functions of its other traits take vectors with a place for each coordinate. The angular velocity of
/// a rotation has the first three of its nine places, and the other six are not read. Derivatives with
/// respect to coordinates are those of the formula, as if the entries of a rotation or of a unit vector were
/// independent; methods take from them what is tangent.
///
/// ```math
/// \frac{\mathrm{d}}{\mathrm{d}t} \frac{\partial L}{\partial \omega} = \frac{\partial L}{\partial \omega} \times \omega + f, \qquad
/// f \cdot \eta = \frac{\partial L}{\partial R} : R \hat \eta
/// ```
///
/// are the equations of motion of a rotation, those of Euler and Poincaré (Marsden & Ratiu 1999, section
/// 13.5).
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no rotations and no unit vectors in `{T}`",
    label = "none of its coordinates is declared as `R: SO3` or `s: S2`, or a parameter is no number",
    note = "regular systems without these are stepped by `Variational`, `Galerkin` or `Newmark`"
)]
pub trait ManifoldLagrangian<T: Scalar = f64>:
    NondegenerateLagrangian<T> + ManifoldSystem + System<Kind = Manifold>
{
}
