//! What the compiler knows of a Lagrangian with a regular mass matrix.

use crate::Scalar;
use crate::system::{Lagrangian, Regular, Same, System};

/// A system whose mass matrix M = ∂²L/∂v∂v is regular, so that the Legendre transform (q, v) ↦ (q, p =
/// ∂L/∂v) is invertible, at least locally (Marsden & Ratiu 1999, section 7.2). There may be constraints
/// beside L.
///
/// ```
#[doc = include_str!("../../docs/hidden/pendulum.txt")]
/// // What the compiler has seen: Störmer–Verlet steps are explicit.
/// assert!(<Pendulum as NondegenerateLagrangian>::SEPARABLE);
/// let (mut force, mut p) = ([0.0], [0.0]);
/// Pendulum.force(&[0.5], &[], 0.0, &mut force);
/// Pendulum.conjugate_momentum(&[0.5], &[2.0], 0.0, &mut p);
/// assert_eq!((force, p), ([-0.5_f64.sin()], [2.0]));
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a regular system, and this is for systems with `#[lagrangian]`",
    label = "its Lagrangian is degenerate, a parameter is no number, or it has no attribute",
    note = "degenerate systems, with `#[degenerate_lagrangian]`, are stepped by `Sigma`, `OneStep`, \
        `Projected`, `Gauss` or `RungeKutta`"
)]
pub trait NondegenerateLagrangian<T: Scalar = f64>: Lagrangian<T> {
    /// Whether L = ½ v·M v − V(q, t) with a constant matrix M: M depends on none of q, v and t, and no term
    /// is linear in v. Then p = M v, whatever forces act.
    const CONSTANT_MASS: bool;
    /// Whether L = ½ v·M v + a(q, t)·v − V(q, t) with a constant matrix M, as
    /// [`CONSTANT_MASS`](Self::CONSTANT_MASS) where a is zero. Then p = M v + a(q, t): in rotating frames,
    /// and of charges in a magnetic field.
    const UNIFORM_MASS: bool;
    /// Whether, with [`CONSTANT_MASS`](Self::CONSTANT_MASS), no force depends on v either. Then the
    /// trapezoidal discrete Lagrangian gives an explicit step, that of Störmer and Verlet (Marsden & West
    /// 2001, section 2.6).
    const SEPARABLE: bool;
    /// Whether M has entries on its diagonal only, so that it is solved by divisions.
    const DIAGONAL_MASS: bool;
    /// Whether L is a polynomial of degree at most two in v, so that p = ∂L/∂v is affine in v.
    const QUADRATIC: bool;

    /// Sets `out` to ∂L/∂q + F alone, with the [force](Lagrangian::applied_force) that acts on the system.
    /// Where [`SEPARABLE`](Self::SEPARABLE) holds, this is F − ∇V(q, t): `v` is not read, and may be empty.
    fn force(&self, q: &[T], v: &[T], t: T, out: &mut [T]);
    /// Sets `out` to p = ∂L/∂v(q, v, t) alone.
    fn conjugate_momentum(&self, q: &[T], v: &[T], t: T, out: &mut [T]);
    /// Sets `out` to ∂²L/∂t∂v: the rate at which p = ∂L/∂v changes where q and v do not.
    fn momentum_rate(&self, q: &[T], v: &[T], t: T, out: &mut [T]);
}

/// A system with a regular mass matrix and without constraints or impacts.
///
/// ```
#[doc = include_str!("../../docs/hidden/pendulum.txt")]
/// /// The kinetic energy ½ p·v of a regular system without terms that are linear in v.
/// fn kinetic<S: RegularLagrangian>(system: &S, q: &[f64], v: &[f64]) -> f64 {
///     let mut p = vec![0.0; q.len()];
///     system.conjugate_momentum(q, v, 0.0, &mut p);
///     p.iter().zip(v).map(|(p, v)| p * v / 2.0).sum()
/// }
/// assert_eq!(kinetic(&Pendulum, &[1.0], &[3.0]), 4.5);
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a regular system without constraints or impacts, and this is for systems \
        with `#[lagrangian]`",
    label = "its Lagrangian is degenerate, it has constraints, impacts, rotations or unit vectors, a \
        parameter is no number, or it has no attribute",
    note = "degenerate systems, with `#[degenerate_lagrangian]`, are stepped by `Sigma`, `OneStep`, \
        `Projected`, `Gauss` or `RungeKutta`",
    note = "systems with `constraint = …` or `nonholonomic = …` are stepped by `Constrained` with any rule, \
        and those with `constraint = …` by `Rattle` too",
    note = "systems with `impact = …` are stepped by `Impacts` around a variational method",
    note = "systems with rotations `R: SO3` or unit vectors `s: S2` are stepped by `Geodesic`"
)]
pub trait RegularLagrangian<T: Scalar = f64>: NondegenerateLagrangian<T> + System<Kind = Regular> {
    /// `M`, which steps systems of this kind: see [`Method::Suited`](crate::methods::Method::Suited).
    type Suited<M>: Same<M, As = M>;
}

/// A system with L = ½ v·M v − V(q, t) and a constant matrix M. The attribute implements it where
/// [`SEPARABLE`](NondegenerateLagrangian::SEPARABLE) holds.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not separable: its Lagrangian is not ½ v·M v − V(q, t) with a constant matrix M, \
        or a force depends on velocities",
    label = "its report says what the mass matrix and the forces depend on",
    note = "`Variational` and `Galerkin` step any regular system, and `Constrained` any one with constraints"
)]
pub trait Separable<T: Scalar = f64>: NondegenerateLagrangian<T> {
    /// `M`, which steps systems of this kind: see [`Method::Suited`](crate::methods::Method::Suited).
    type Suited<M>: Same<M, As = M>;
}
