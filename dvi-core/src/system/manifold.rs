//! What the compiler knows of coordinates that are rotations or unit vectors.

use crate::system::{Manifold, NondegenerateLagrangian, System};
use crate::{Scalar, Space};

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
