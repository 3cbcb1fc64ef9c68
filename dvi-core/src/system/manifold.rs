//! What the compiler knows of coordinates that are rotations or unit vectors.

use crate::system::{Manifold, NondegenerateLagrangian, Same, System};
use crate::{Scalar, Space};

/// A system with rotations or unit vectors, whatever numbers it is computed in.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a regular system with rotations or unit vectors",
    label = "its Lagrangian is degenerate, or none of its coordinates is declared as `R: SO3` or `s: S2`",
    note = "regular systems without these are stepped by `Variational`, `Galerkin` or `Newmark`, and \
        degenerate ones by `Sigma` or `OneStep`"
)]
pub trait ManifoldSystem: System {
    /// The space of tangent vectors.
    type Tangent: Space;

    /// The space of tangent vectors of this system. Its dimension is that of the manifold: 3 for a rotation,
    /// 2 for a unit vector.
    fn tangent(&self) -> Self::Tangent;
}

/// A regular Lagrangian on ℝⁿ × SO(3) × … × S² × …, declared by coordinates such as `R: SO3` and `s[n]: S2`.
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
///
/// ```
/// use dvi_core::prelude::*;
///
/// /// A unit vector that moves freely.
/// #[lagrangian(coordinates(s: S2), lagrangian = sum(0..3, |i| dot(s[i]).powi(2)) / 2.0)]
/// struct Free;
///
/// // It follows a great circle, around once in 2π units of time.
/// let start = FreeState { s: [1.0, 0.0, 0.0], dot_s: [0.0, 1.0, 0.0] };
/// let mut run = Integrator::new(&Free, Geodesic::midpoint(), 0.1, start)?;
/// run.take_steps(100)?;
/// assert!((run.state().s[0] - 10_f64.cos()).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a regular system with rotations or unit vectors in `{T}`",
    label = "its Lagrangian is degenerate, none of its coordinates is declared as `R: SO3` or `s: S2`, \
        or a parameter is no number",
    note = "regular systems without these are stepped by `Variational`, `Galerkin` or `Newmark`, and \
        degenerate ones by `Sigma` or `OneStep`"
)]
pub trait ManifoldLagrangian<T: Scalar = f64>:
    NondegenerateLagrangian<T> + ManifoldSystem + System<Kind = Manifold>
{
    /// `M`, which steps systems of this kind: see [`Method::Suited`](crate::methods::Method::Suited).
    type Suited<M>: Same<M, As = M>;
}
