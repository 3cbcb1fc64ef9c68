//! The equations of motion as ordinary differential equations of first order, y' = X(y, t): what the
//! baselines solve.

pub(crate) mod constrained;
mod flow_on_q;
mod hamilton;
mod stages;

use core::fmt::Debug;
use core::ops::{Deref, DerefMut};

use crate::error::{StartError, StepFailure};
use crate::memory::{Memory, lasting};
use crate::state::Statistics;
use crate::system::{Kind, Regular, Same};
use crate::{Lagrangian, Real, Scalar, Sink, Space, System, Vector, Weights};

pub use stages::InLanes;
pub(crate) use stages::{AtStages, StageWork, weigh, weigh_each};
pub(crate) use stages::{Evaluation, FirstOrderAtStages, OneByOne};

/// A point y, or its velocity: `K` vectors of the space.
#[derive(Clone, Debug)]
pub struct Point<V, const K: usize>([V; K]);

impl<V, const K: usize> Deref for Point<V, K> {
    type Target = [V];
    #[inline]
    fn deref(&self) -> &[V] {
        &self.0
    }
}

impl<V, const K: usize> DerefMut for Point<V, K> {
    #[inline]
    fn deref_mut(&mut self) -> &mut [V] {
        &mut self.0
    }
}

lasting!([T: Copy, V: DerefMut<Target = [T]>, const K: usize] Point<V, K>, T; vectors 0);

/// So many points of zeros.
fn points<X: Space, P: Scalar, const K: usize, const COUNT: usize>(
    space: X,
) -> [Point<X::Vector<P>, K>; COUNT] {
    core::array::from_fn(|_| Point(space.vectors()))
}

/// The rates of change of a kind of system at a state.
#[diagnostic::on_unimplemented(
    message = "the motion of `{S}` cannot be computed in `{T}`",
    label = "it is no system, it has rotations or unit vectors, or a parameter of it is no number"
)]
pub trait Rates<S: System, T: Real>: Kind {
    /// The acceleration of the motion through (`q`, `v`, `t`); of a degenerate system, which has no
    /// velocities, the rate of change of the coordinates.
    ///
    /// # Errors
    /// [`StepFailure::Singular`] where Ω or the mass matrix is singular;
    /// [`StepFailure::RedundantConstraint`].
    fn rates(system: &S, q: &Vector<S, T>, v: &[T], t: T) -> Result<Vector<S, T>, StepFailure>;
}

/// The equations of motion of `S` with their storage.
pub(crate) type EquationsOf<S, T> = <<S as System>::Kind as FirstOrder<S, T>>::Equations;
/// A point y of the equations of motion of `S`, or its velocity.
pub(crate) type PointOf<S, T> = <<S as System>::Kind as FirstOrder<S, T>>::Point<T>;
/// The same in packs of type `P`, of numbers of type `T`.
pub(crate) type PackedOf<S, T, P> = <<S as System>::Kind as FirstOrder<S, T>>::Point<P>;

/// The equations of the stages of a collocation step, as Newton's method solves them for velocities: those
/// with momenta, ∂L/∂v(Qᵢ, Vᵢ) = p + h Σⱼ aᵢⱼ ∂L/∂q(Qⱼ, Vⱼ), unless they are others.
pub trait StageEquations<S: System, T: Real> {
    /// Sets `residual` to what vanishes where `v` is the velocity at (`q`, `t`), and `force` to what drives
    /// the motion there: ∂L/∂v, from which p is still to be subtracted, and p'; of a degenerate system on Q
    /// Ωv − ∇H − ∂α/∂t, and ∇H + ∂α/∂t.
    fn residual(system: &S, [q, v]: [&[T]; 2], t: T, force: &mut [T], residual: &mut [T])
    where
        S: Lagrangian<T>,
    {
        system.gradient(q, v, t, force, residual);
    }
    /// The weights of the second derivatives at stage j in that of the residual of stage r along h times the
    /// velocity of stage k, where each stage has its own p: for whether r = j and j = k, aᵣⱼ and aⱼₖ, and h
    /// and 1/h. That of L_vv is the weight of [`newton_matrix`](Self::newton_matrix).
    fn newton_weights([row, column]: [bool; 2], [before, after]: [T; 2], [h, per_h]: [T; 2]) -> Weights<T> {
        let if_so = |is: bool, weight: T| if is { weight } else { T::lift(0.0) };
        Weights {
            qq: -h * before * after,
            qv: if_so(column, -before),
            vq: if_so(row, after),
            vv: if_so(row && column, per_h),
        }
    }
    /// Adds what stands beside L_qq, L_qv and L_vq in that derivative, at (q, v), t of a step of length h:
    /// L_vv, or the rate of Dα.
    fn newton_matrix<K: Sink<T>>(
        system: &S,
        [q, v]: [&[T]; 2],
        [t, _h]: [T; 2],
        [l_q, l_v]: [&mut [T]; 2],
        sink: &mut K,
    ) where
        S: Lagrangian<T>,
    {
        if S::REGULAR {
            system.linearize(q, v, t, Weights::mass(), l_q, l_v, sink);
        }
    }
}

impl<S: System, T: Real> StageEquations<S, T> for Regular {}

/// The equations of motion of a system `S`, y' = X(y, t), in the arithmetic of `T`: of a regular one
/// Hamilton's in terms of L (Marsden & Ratiu 1999, section 7.2).
///
/// ```math
/// \begin{aligned}
/// \text{degenerate:} \quad & y = q, & \Omega\, \dot q &= \nabla H + \partial_t \alpha \\
/// \text{regular:} \quad & y = (q, p), & \dot q &= v \ \text{ with } \ \partial_v L(q, v, t) = p, \quad \dot p = \partial_q L(q, v, t)
/// \end{aligned}
/// ```
#[diagnostic::on_unimplemented(
    message = "the equations of motion of `{S}` cannot be solved in `{T}`",
    label = "it is no system, it has constraints, impacts, rotations or unit vectors, or a parameter of it \
        is no number",
    note = "systems with `constraint = …` or `nonholonomic = …` are stepped by `Constrained` with any rule, \
        and those with `constraint = …` by `Rattle` too",
    note = "systems with `impact = …` are stepped by `Impacts` around a variational method",
    note = "systems with rotations `R: SO3` or unit vectors `s: S2` are stepped by `Geodesic`"
)]
pub trait FirstOrder<S: System, T: Real>: Kind + StageEquations<S, T> {
    /// y: q, or q and p; in numbers of type `T`, or in packs of them.
    type Point<P: Scalar>: Debug + DerefMut<Target = [Vector<S, P>]> + Memory<P>;
    /// The equations, with the storage that their evaluation needs, and all of y but q.
    type Equations: Memory<T>;
    /// `M`, which steps systems of this kind: see [`Method::Suited`](crate::methods::Method::Suited).
    type Suited<M>: Same<M, As = M>;

    /// So many points of zeros.
    fn points<P: Scalar, const COUNT: usize>(system: &S) -> [Self::Point<P>; COUNT];
    /// The equations at (`q`, `v`, `t`).
    ///
    /// # Errors
    /// [`StartError::Starter`] where Ω or the mass matrix is singular.
    fn begin(system: &S, q: &Vector<S, T>, v: &[T], t: T) -> Result<Self::Equations, StartError>;
    /// Sets `y` to the present point.
    fn gather(equations: &mut Self::Equations, q: &Vector<S, T>, y: &mut Self::Point<T>);
    /// Sets `slope` to X(`y`, `t`).
    ///
    /// # Errors
    /// [`StepFailure::Singular`] where Ω or the mass matrix is singular, [`StepFailure::NotConverged`] where
    /// no velocity belongs to the momentum.
    fn evaluate(
        equations: &mut Self::Equations,
        system: &S,
        y: &Self::Point<T>,
        t: T,
        slope: &mut Self::Point<T>,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        Self::guess(equations, slope);
        for part in 0..y.len() {
            Self::evaluate_part(equations, system, part, y, t, slope, statistics)?;
        }
        Ok(())
    }
    /// Sets the velocity of `slope` to the last one within the step, if it is needed as a guess.
    fn guess(_equations: &Self::Equations, _slope: &mut Self::Point<T>) {}
    /// Sets entry `part` of `slope`, a guess of X(`y`, `t`), to that of X: to the velocity that belongs to
    /// the momentum, or to the force at the velocity of `slope`.
    ///
    /// # Errors
    /// As [`evaluate`](Self::evaluate).
    fn evaluate_part(
        equations: &mut Self::Equations,
        system: &S,
        part: usize,
        y: &Self::Point<T>,
        t: T,
        slope: &mut Self::Point<T>,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure>;
    /// Whether the force depends on velocities, so that it is evaluated again where these have converged.
    const HAS_VELOCITY_FORCES: bool = false;
    /// Whether p' is a force of positions and time alone and q' = p/m: the equations are q'' = f(q, t) then.
    const OF_SECOND_ORDER: bool = false;
    /// 1/m for each coordinate, if the equations are of second order.
    fn reciprocal_masses(_equations: &Self::Equations) -> Option<&[T]> {
        None
    }
    /// Whether Ω, of a degenerate system, has kept its orientation at a point within a step.
    ///
    /// # Errors
    /// [`StepFailure::Orientation`].
    fn compare(_: &mut Self::Equations, _system: &S, _y: &Self::Point<T>, _t: T) -> Result<(), StepFailure> {
        Ok(())
    }
    /// Moves to `y`, the end of a step; all but `q` is kept here.
    ///
    /// # Errors
    /// [`StepFailure::NotFinite`], and [`StepFailure::Orientation`] where Ω or the mass matrix has lost its
    /// orientation; nothing has moved then.
    fn arrive(
        equations: &mut Self::Equations,
        system: &S,
        y: &Self::Point<T>,
        q: &mut Vector<S, T>,
        t: T,
    ) -> Result<(), StepFailure>;
    /// Sets `v` to the velocity at the present point; states of degenerate systems carry none.
    ///
    /// # Errors
    /// As [`evaluate`](Self::evaluate).
    fn velocity(_: &Self::Equations, _: &S, _q: &[T], _t: T, _v: &mut [T]) -> Result<(), StepFailure> {
        Ok(())
    }
}
