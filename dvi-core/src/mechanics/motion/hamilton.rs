//! q' = v, where ∂L/∂v(q, v, t) = p, and p' = ∂L/∂q(q, v, t), on T*Q.

use super::{AtStages, FirstOrder, FirstOrderAtStages, InLanes, OneByOne, Point, Rates, StageWork, points};
use crate::error::{StartError, StepFailure};
use crate::mechanics::legendre::Legendre;
use crate::mechanics::mass::Mass;
use crate::mechanics::orientation::MassOrientation;
use crate::mechanics::pattern::of_second_derivatives;
use crate::memory::lasting;
use crate::scalar::{Lanes, norm};
use crate::space::{LinearEquations, LinearSolver, Storing};
use crate::state::Statistics;
use crate::system::{Regular, Unilateral};
use crate::{
    Linear, NondegenerateLagrangian, Real, RegularLagrangian, Scalar, Sink, Space, System,
    UnilateralLagrangian, Vector, Weights,
};

/// Hamilton's equations of a regular system, on T*Q, in terms of L.
#[derive(Debug)]
pub struct HamiltonsEquations<S: System, T: Real> {
    /// p at the present point.
    p: Vector<S, T>,
    /// p = M v + a(q, t), if M is constant.
    mass: Mass<S, T>,
    /// No velocity: p is a(q, t) there.
    rest: Vector<S, T>,
    /// That of an M that depends on the state.
    transform: Option<Transform<S, T>>,
}

impl<S: NondegenerateLagrangian<T>, T: Real> HamiltonsEquations<S, T> {
    /// Sets `v` to M⁻¹(`p` − a), if M is constant.
    #[inline]
    fn divide(&self, system: &S, q: &[T], p: &[T], t: T, v: &mut [T]) {
        if S::CONSTANT_MASS {
            return self.mass.solve(p, v);
        }
        system.conjugate_momentum(q, &self.rest, t, v);
        for (v, &p) in v.iter_mut().zip(p) {
            *v = p - *v;
        }
        self.mass.solve_in_place(v);
    }
}

/// The Legendre transform at the points of a step.
#[derive(Debug)]
struct Transform<S: System, T: Real> {
    legendre: Legendre<S, T>,
    orientation: MassOrientation<S, T>,
    /// The velocity at the present point, from which the first of a step is sought.
    velocity: Vector<S, T>,
    /// The last velocity within a step.
    latest: Vector<S, T>,
    /// Between the velocities at the ends of a step.
    between: Vector<S, T>,
}

lasting!([S: System, T: Real] HamiltonsEquations<S, T>, T; numbers p, parts transform);

lasting!([S: System, T: Real] Transform<S, T>, T; part orientation, numbers velocity);

impl<S: RegularLagrangian<T>, T: Real> FirstOrder<S, T> for Regular {
    type Suited<M> = M;
    type Point<P: Scalar> = Point<Vector<S, P>, 2>;
    type Equations = HamiltonsEquations<S, T>;

    const HAS_VELOCITY_FORCES: bool = !S::SEPARABLE;
    const OF_SECOND_ORDER: bool = S::SEPARABLE && S::DIAGONAL_MASS;

    fn points<P: Scalar, const COUNT: usize>(system: &S) -> [Self::Point<P>; COUNT] {
        points(system.space())
    }
    fn begin(system: &S, q: &Vector<S, T>, v: &[T], t: T) -> Result<HamiltonsEquations<S, T>, StartError> {
        let space = system.space();
        let [mut force, mut p, rest]: [Vector<S, T>; 3] = space.vectors();
        system.gradient(q, v, t, &mut force, &mut p);
        let mass = Mass::new(system, q, t).map_err(StartError::Starter)?;
        if S::UNIFORM_MASS {
            return Ok(HamiltonsEquations { p, mass, rest, transform: None });
        }
        let [mut velocity, latest, between] = space.vectors();
        velocity.copy_from_slice(v);
        let orientation = MassOrientation::new(system, q, v, t).map_err(StartError::Starter)?;
        let legendre = Legendre::new(system, q, v, t);
        let transform = Some(Transform { legendre, orientation, velocity, latest, between });
        Ok(HamiltonsEquations { p, mass, rest, transform })
    }
    fn gather(equations: &mut HamiltonsEquations<S, T>, q: &Vector<S, T>, y: &mut Self::Point<T>) {
        let [coordinates, momenta] = &mut y.0;
        coordinates.copy_from_slice(q);
        momenta.copy_from_slice(&equations.p);
        if let Some(Transform { velocity, latest, .. }) = &mut equations.transform {
            latest.copy_from_slice(velocity);
        }
    }
    fn guess(equations: &HamiltonsEquations<S, T>, slope: &mut Self::Point<T>) {
        if let Some(Transform { latest, .. }) = &equations.transform {
            slope.0[0].copy_from_slice(latest);
        }
    }
    #[inline]
    fn evaluate_part(
        equations: &mut HamiltonsEquations<S, T>,
        system: &S,
        part: usize,
        y: &Self::Point<T>,
        t: T,
        slope: &mut Self::Point<T>,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let ([q, p], [velocity, force]) = (&y.0, &mut slope.0);
        if part == 1 {
            system.force(q, velocity, t, force);
            statistics.gradients += 1;
        } else if !S::UNIFORM_MASS
            && let Some(Transform { legendre, latest, .. }) = &mut equations.transform
        {
            legendre.solve(system, q, p, t, velocity)?;
            latest.copy_from_slice(velocity);
        } else {
            equations.divide(system, q, p, t, velocity);
        }
        Ok(())
    }
    #[inline]
    fn reciprocal_masses(equations: &HamiltonsEquations<S, T>) -> Option<&[T]> {
        if S::SEPARABLE { equations.mass.reciprocals() } else { None }
    }
    fn arrive(
        equations: &mut HamiltonsEquations<S, T>,
        system: &S,
        y: &Self::Point<T>,
        q: &mut Vector<S, T>,
        t: T,
    ) -> Result<(), StepFailure> {
        let [arrival, momentum] = &y.0;
        norm::finite(arrival).and(norm::finite(momentum))?;
        if !S::UNIFORM_MASS
            && let Some(Transform { legendre, orientation, velocity, latest, between }) =
                &mut equations.transform
        {
            // The velocity of the last stage leads to the one that belongs to the new momentum, if there is
            // one.
            legendre.solve(system, arrival, momentum, t, latest)?;
            if !S::QUADRATIC {
                // Between two branches of ∂L/∂v(v) = p the mass matrix changes its sign.
                norm::mean(velocity, latest, between);
                orientation.check(system, arrival, between, t)?;
            }
            orientation.check(system, arrival, latest, t)?;
            velocity.copy_from_slice(latest);
        }
        equations.p.copy_from_slice(momentum);
        q.copy_from_slice(arrival);
        Ok(())
    }
    fn velocity(
        equations: &HamiltonsEquations<S, T>,
        system: &S,
        q: &[T],
        t: T,
        v: &mut [T],
    ) -> Result<(), StepFailure> {
        match &equations.transform {
            Some(Transform { velocity, .. }) => v.copy_from_slice(velocity),
            None => equations.divide(system, q, &equations.p, t, v),
        }
        Ok(())
    }
}

#[diagnostic::do_not_recommend]
impl<const W: usize, S, T: Real> FirstOrderAtStages<InLanes, W, S, T> for Regular
where
    S: RegularLagrangian<T> + RegularLagrangian<Lanes<W, T>>,
{
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn evaluate_at_stages(
        equations: &mut HamiltonsEquations<S, T>,
        at: &AtStages<'_, W, S, T>,
        work: &mut StageWork<W, S, T>,
        out: &mut Vector<S, Lanes<W, T>>,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let [q, p] = &at.y.0;
        if at.part == 1 {
            at.system.force(q, at.velocity, at.t, out);
            statistics.gradients += W as u64;
            return Ok(());
        }
        let Some(reciprocals) = equations.mass.reciprocals() else {
            return <Self as FirstOrderAtStages<OneByOne, W, S, T>>::evaluate_at_stages(
                equations, at, work, out, statistics,
            );
        };
        if <S as NondegenerateLagrangian<T>>::CONSTANT_MASS {
            for ((velocity, &p), &reciprocal) in out.iter_mut().zip(p.iter()).zip(reciprocals) {
                *velocity = p * Lanes::all(reciprocal);
            }
            return Ok(());
        }
        // A velocity of zero.
        let StageWork { entries: rest, .. } = work;
        at.system.conjugate_momentum(q, rest, at.t, out);
        for ((velocity, &p), &reciprocal) in out.iter_mut().zip(p.iter()).zip(reciprocals) {
            *velocity = (p - *velocity) * Lanes::all(reciprocal);
        }
        Ok(())
    }
}

impl<S: RegularLagrangian<T>, T: Real> Rates<S, T> for Regular {
    fn rates(system: &S, q: &Vector<S, T>, v: &[T], t: T) -> Result<Vector<S, T>, StepFailure> {
        acceleration(system, [q, v], t)
    }
}

impl<S: UnilateralLagrangian<T>, T: Real> Rates<S, T> for Unilateral {
    fn rates(system: &S, q: &Vector<S, T>, v: &[T], t: T) -> Result<Vector<S, T>, StepFailure> {
        acceleration(system, [q, v], t)
    }
}

fn acceleration<S: NondegenerateLagrangian<T>, T: Real>(
    system: &S,
    [q, v]: [&[T]; 2],
    t: T,
) -> Result<Vector<S, T>, StepFailure> {
    let [mut acceleration, mut vector]: [Vector<S, T>; 2] = system.space().vectors();
    if S::SEPARABLE {
        system.force(q, &[], t, &mut vector);
        Mass::new(system, q, t)?.solve(&vector, &mut acceleration);
    } else {
        let mut solver: Linear<S, T> = of_second_derivatives(system, q, v, t, Storing::Always);
        vector.fill(T::lift(1.0));
        let solved = solver.solve(&mut SecondOrder { system, q, v, t }, &vector, &mut acceleration);
        solved.map_err(|failure| failure.of(StepFailure::MASS))?;
    }
    norm::finite(&acceleration)?;
    Ok(acceleration)
}

/// ∂²L/∂v∂v a = ∂L/∂q − ∂²L/∂v∂q v − ∂²L/∂t∂v, the Euler–Lagrange equations.
pub(super) struct SecondOrder<'a, S, T> {
    pub(super) system: &'a S,
    pub(super) q: &'a [T],
    pub(super) v: &'a [T],
    pub(super) t: T,
}

impl<S: NondegenerateLagrangian<T>, T: Real> LinearEquations<T> for SecondOrder<'_, S, T> {
    fn evaluate<K: Sink<T>>(&mut self, b: &mut [T], sink: &mut K) -> Result<(), StepFailure> {
        let Self { system, q, v, t } = *self;
        let transport = Weights { vq: T::lift(1.0), ..Weights::none() };
        let [mut l_v, mut transported]: [Vector<S, T>; 2] = system.space().vectors();
        system.linearize(q, v, t, Weights::mass(), b, &mut l_v, sink);
        let mut product = |i: usize, j: usize, entry: T| transported[i] += entry * v[j];
        system.linearize(q, v, t, transport, b, &mut l_v, &mut product);
        system.momentum_rate(q, v, t, &mut l_v);
        for ((b, &transported), &rate) in b.iter_mut().zip(transported.iter()).zip(l_v.iter()) {
            *b -= transported + rate;
        }
        Ok(())
    }
}
