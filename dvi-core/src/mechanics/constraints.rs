//! Linear equations with Lagrange multipliers, and what is made of them: points on the constraints,
//! velocities along them.
//!
//! ```text
//! ( A   G(q₀)ᵀ ) ( x )   ( b )
//! ( G(q₁)    0 ) ( ν ) = ( c )
//! ```
//!
//! A is n×n, and there are m constraints. The equations are solved as one system of n + m unknowns, in the
//! storage that their pattern needs: banded along a chain. [`Constraints`] says what G and c are, for
//! constraints of positions and of velocities.

pub(crate) mod consistent;
mod kinds;
pub(crate) mod residuals;
pub(crate) mod scales;
mod solver;
pub(crate) mod turning;

use crate::error::StepFailure;
use crate::mechanics::{Span, legendre};
use crate::scalar::norm;
use crate::scalar::passes::negate;
use crate::solve::{Due, Stopping, newton, sizes};
use crate::space::{LinearEquations, Sink};
use crate::state::Statistics;
use crate::system::{Kind, Same};
use crate::{ConstrainedSystem, NondegenerateLagrangian, Real, Scalar, Space, System};

pub(crate) use solver::ConstraintSolver;

/// One number for each constraint.
pub(crate) type Multipliers<S, T> = <<S as ConstrainedSystem>::Multipliers as Space>::Vector<T>;
/// One number for each coordinate, then one for each constraint.
pub(crate) type Augmented<S, T> = <<S as ConstrainedSystem>::Augmented as Space>::Vector<T>;

/// How constraints of a kind enter the equations: those of positions, g(q, t) = 0, with A = ∂g/∂q, and those
/// of velocities, A(q, t) v + b(q, t) = 0. All functions set `out` to one number for each constraint and
/// **add** a matrix with a row for each to `sink`.
pub trait Constraints<S: System, T: Real>: Kind {
    /// `M`, which steps systems of this kind: see [`Method::Suited`](crate::methods::Method::Suited).
    type Suited<M>: Same<M, As = M>;

    /// Whether positions are constrained.
    const OF_POSITIONS: bool;

    /// A at (`q`, `t`): Aᵀλ is the force of the constraints. Of those of positions `out` is set to g, and has
    /// no meaning else.
    fn forces<K: Sink<T>>(system: &S, q: &[T], t: T, out: &mut [T], sink: &mut K);
    /// What vanishes at the end of a step, with its derivative by Δ. `work` is storage for a point and a
    /// velocity.
    fn of_step<K: Sink<T>>(
        system: &S,
        span: Span<'_, S, T>,
        work: [&mut [T]; 2],
        out: &mut [T],
        sink: &mut K,
    );
    /// What vanishes with the velocity `v`, and A.
    fn of_velocity<K: Sink<T>>(system: &S, q: &[T], v: &[T], t: T, out: &mut [T], sink: &mut K);
    /// What A times the acceleration is, and A.
    fn of_acceleration<K: Sink<T>>(system: &S, q: &[T], v: &[T], t: T, out: &mut [T], sink: &mut K);
}

/// A regular Lagrangian with constraints of one kind.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no constraints",
    label = "its attribute has neither `constraint` nor `nonholonomic`, or a parameter is no number",
    note = "regular systems without constraints are stepped by `Variational`, `Galerkin` or `Newmark`, \
        and degenerate ones by `Sigma` or `OneStep`"
)]
pub trait ConstrainedLagrangian<T: Real = f64>:
    NondegenerateLagrangian<T> + ConstrainedSystem + System<Kind: Constraints<Self, T>> + Sized
{
    /// `M`, which steps systems of this kind: see [`Method::Suited`](crate::methods::Method::Suited).
    type Suited<M>: Same<M, As = M>;
}

#[diagnostic::do_not_recommend]
impl<S, T: Real> ConstrainedLagrangian<T> for S
where
    S: NondegenerateLagrangian<T> + ConstrainedSystem + System<Kind: Constraints<S, T>>,
{
    type Suited<M> = <S::Kind as Constraints<S, T>>::Suited<M>;
}

/// A point and a time at which constraints are evaluated.
#[derive(Clone, Copy)]
pub(crate) struct At<'a, T> {
    pub(crate) q: &'a [T],
    pub(crate) t: T,
}

/// What the lower rows of the equations say.
pub(crate) enum Lower<'a, S, T> {
    /// What vanishes at a position, of constraints of positions.
    Position(At<'a, T>),
    /// What vanishes at the end of a step. The slices are work space.
    Step(Span<'a, S, T>, [&'a mut [T]; 2]),
    /// What vanishes with a velocity.
    Velocity(At<'a, T>, &'a [T]),
    /// What the acceleration with a velocity is to be.
    Acceleration(At<'a, T>, &'a [T]),
}

impl<S: ConstrainedLagrangian<T>, T: Real> Lower<'_, S, T> {
    #[inline]
    fn evaluate<K: Sink<T>>(&mut self, system: &S, c: &mut [T], sink: &mut K) {
        match self {
            Self::Position(At { q, t }) => S::Kind::forces(system, q, *t, c, sink),
            Self::Step(span, [point, velocity]) => {
                S::Kind::of_step(system, *span, [point, velocity], c, sink);
            }
            Self::Velocity(At { q, t }, v) => S::Kind::of_velocity(system, q, v, *t, c, sink),
            Self::Acceleration(At { q, t }, v) => S::Kind::of_acceleration(system, q, v, *t, c, sink),
        }
    }
}

/// The equations, linearised: `upper` evaluates b and the entries of A, to b is added Gᵀν, and `lower`
/// evaluates c and the entries of the lower rows.
pub(crate) struct Bordered<'a, S, T, U> {
    pub(crate) system: &'a S,
    pub(crate) upper: U,
    pub(crate) lower: Lower<'a, S, T>,
    /// ν.
    pub(crate) multipliers: &'a [T],
    /// Where the G is evaluated whose transpose multiplies ν; `None` if it is the matrix of the lower rows.
    pub(crate) forces: Option<At<'a, T>>,
    /// The constraints from this one on are left out: each has the equation ν = 0.
    pub(crate) active: usize,
}

impl<S: ConstrainedLagrangian<T>, T: Real, U: LinearEquations<T>> LinearEquations<T>
    for Bordered<'_, S, T, U>
{
    #[inline]
    fn evaluate<K: Sink<T>>(&mut self, b: &mut [T], sink: &mut K) -> Result<(), StepFailure> {
        let Self { system, upper, lower, multipliers, forces, active } = self;
        let (n, active) = (b.len() - multipliers.len(), *active);
        let (upper_b, lower_b) = b.split_at_mut(n);
        upper.evaluate(upper_b, sink)?;
        if let Some(At { q, t }) = forces {
            let mut entries = |k: usize, j: usize, entry: T| {
                if k < active {
                    upper_b[j] += entry * multipliers[k];
                    sink.add(j, n + k, entry);
                }
            };
            S::Kind::forces(system, q, *t, lower_b, &mut entries);
        }
        let is_same = forces.is_none();
        let mut entries = |k: usize, j: usize, entry: T| {
            if k < active {
                sink.add(n + k, j, entry);
                if is_same {
                    upper_b[j] += entry * multipliers[k];
                    sink.add(j, n + k, entry);
                }
            }
        };
        lower.evaluate(system, lower_b, &mut entries);
        for (k, c) in lower_b.iter_mut().enumerate().skip(active) {
            *c = T::lift(0.0);
            sink.add(n + k, n + k, T::lift(1.0));
        }
        Ok(())
    }
}

/// What is found of a motion along the constraints at one of its points.
pub(crate) struct Tangent<'a, T> {
    /// On the way in a momentum with components across the constraints, on the way out one without.
    pub(crate) p: &'a mut [T],
    /// On the way in a guess of the velocity.
    pub(crate) v: &'a mut [T],
    /// The impulse of the constraints, one number for each; written only.
    pub(crate) impulse: &'a mut [T],
    /// Work space, n numbers.
    pub(crate) work: &'a mut [T],
}

impl<S: ConstrainedLagrangian<T>, T: Real> ConstraintSolver<S, T> {
    /// Adds the impulse Gᵀι to p that makes the velocity v, ∂L/∂v(q, v, t) = p, one that the constraints
    /// admit.
    ///
    /// # Errors
    /// As [`solve`](Self::solve), and [`StepFailure::NotConverged`].
    pub(crate) fn tangent(
        &mut self,
        system: &S,
        at: At<'_, T>,
        tangent: Tangent<'_, T>,
    ) -> Result<(), StepFailure> {
        let Tangent { p, v, impulse, work } = tangent;
        impulse.fill(T::lift(0.0));
        // With an L that is quadratic in v the equations are linear.
        if S::QUADRATIC {
            self.improve_tangent(Due::Nothing, system, at, Tangent { p, v, impulse, work })?;
        } else {
            newton(Stopping::default(), &mut Statistics::default(), &mut |due, _| {
                due.prepare_alone(system, &mut self.weights, v);
                self.improve_tangent(*due, system, at, Tangent { p, v, impulse, work })
            })?;
        }
        // Rounding may have left the velocity off the constraints.
        loop {
            let Self { residuals, scales, solution, .. } = self;
            residuals.evaluate(system, at, v, scales, |j| Scalar::abs(v[j]) + Scalar::abs(solution[j]));
            if residuals.are_settled() {
                match residuals.worst(system, at, v) {
                    None => break,
                    Some((constraint, value)) => {
                        return Err(StepFailure::OffConstraint { constraint, value });
                    }
                }
            }
            self.improve_tangent(Due::Nothing, system, at, Tangent { p, v, impulse, work })?;
        }
        // In the equations the impulse is subtracted.
        negate(impulse);
        self.add_impulse(system, at, impulse, p);
        norm::finite(v).and(norm::finite(p))
    }

    /// One iteration: the size of the correction of the velocity or, where that is due, of the residual.
    fn improve_tangent(
        &mut self,
        due: Due,
        system: &S,
        at: At<'_, T>,
        Tangent { p, v, impulse, work }: Tangent<'_, T>,
    ) -> Result<T, StepFailure> {
        let n = v.len();
        let upper = legendre::Equations { system, points: [at.q, v, p], t: at.t, l_q: work };
        let lower = Lower::Velocity(at, v);
        let (multipliers, active) = (&*impulse, impulse.len());
        let equations = &mut Bordered { system, upper, lower, multipliers, forces: None, active };
        if due == Due::Residual {
            let size = |j: usize| if j < n { v[j] } else { multipliers[j - n] };
            return self.residual(equations, size, |i| if i < n { p[i] } else { T::lift(0.0) });
        }
        self.solve(equations, T::lift(1.0))?;
        self.reduce(v, impulse);
        Ok(sizes::largest(&self.weights, self.parts(n).0))
    }

    /// Adds Gᵀι at a point to a momentum.
    pub(crate) fn add_impulse(&mut self, system: &S, at: At<'_, T>, impulse: &[T], p: &mut [T]) {
        let values = &mut self.solution[at.q.len()..];
        let mut product = |k: usize, j: usize, entry: T| p[j] += entry * impulse[k];
        S::Kind::forces(system, at.q, at.t, values, &mut product);
    }
}
