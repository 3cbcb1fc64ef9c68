//! The step of any discrete Lagrangian: p0 = −D₁L_d(q0, q0 + Δ) by Newton's method, p1 = p0 + (D₁ + D₂)L_d.

use crate::discrete::{DiscreteLagrangian, Ends, Interval, Span, solve_by_newton};
use crate::error::{StartError, StepFailure};
use crate::mechanics::legendre::Legendre;
use crate::memory::{Memory, lasting};
use crate::methods::{Carries, Method, PreservedForm, Scheme, VariableStep};
use crate::methods::{InnerScheme, VariationalMethod};
use crate::scalar::norm;
use crate::solve::Stopping;
use crate::state::Statistics;
use crate::state::history::History;
use crate::state::rates::is_similar;
use crate::system::Unconstrained;
use crate::system::start::evaluate;
use crate::{Lagrangian, Linear, Real, Space, System, Vector};

/// The general step of the discrete Lagrangian of `scheme`, by Newton's method, on degenerate and on regular
/// systems (Marsden & West 2001, eqs. 1.5.2 and 1.5.3). Runs start from p = ∂L/∂v, which is α(q) for a
/// degenerate system.
///
/// The methods of this crate have faster steps of the same equations, and guards and starts of their own.
/// This one is for discrete Lagrangians that have no method yet, and what the others are tested against. It
/// has no guards: a parasitic mode is not limited, and a step across a place where Ω or the mass matrix
/// changes its sign passes if it has a solution. What is inside may not have options that have no effect
/// here: see [`InnerScheme`]. [`EnergyLimit`](crate::methods::EnergyLimit) around it ends a run whose energy
/// tells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct General<M> {
    /// What has a discrete Lagrangian.
    pub scheme: M,
    /// The criterion by which a step counts as solved. Default: to rounding errors.
    pub stopping: Stopping,
}

impl<M> General<M> {
    /// The method with default options.
    pub fn new(scheme: M) -> Self {
        Self { scheme, stopping: Stopping::default() }
    }
}

/// The momentum of a run, what its next step is guessed from, and work space.
#[derive(Debug)]
pub struct GeneralMemory<S: System, L, T: Real> {
    p: Vector<S, T>,
    /// The mean velocities Δ/h of the last steps.
    history: History<S, T>,
    last_step: T,
    l_d: L,
    solver: Linear<S, T>,
    residual: Vector<S, T>,
    increment: Vector<S, T>,
    sum: Vector<S, T>,
    next: Vector<S, T>,
}

impl<S: Lagrangian<T>, L, T: Real> GeneralMemory<S, L, T> {
    /// The discrete momentum at the current point, one entry per coordinate.
    pub fn p(&self) -> &[T] {
        &self.p
    }

    /// Makes `p` the discrete momentum at the current point: that of a two-step run, for instance. Entries
    /// beyond the dimension are left out.
    pub fn set_p(&mut self, p: &[T]) {
        for (kept, &p) in self.p.iter_mut().zip(p) {
            *kept = p;
        }
        self.history.clear();
    }
}

impl<S: System, L, T: Real> Memory<T> for GeneralMemory<S, L, T> {
    lasting!(T; numbers p, part history, number last_step);
}

impl<M: Scheme> Scheme for General<M> {
    fn order(&self) -> usize {
        self.scheme.order()
    }
    fn is_symmetric(&self) -> bool {
        self.scheme.is_symmetric()
    }
    fn preserved_form(&self) -> PreservedForm {
        self.scheme.preserved_form()
    }
}

impl<S: Lagrangian<T>, T: Real, M: VariationalMethod<S, T>> Carries<S, T> for General<M> {
    type Memory = GeneralMemory<S, M::DiscreteLagrangian, T>;
}

impl<S: Lagrangian<T> + System<Kind: Unconstrained>, T: Real, M: InnerScheme<S, T>> Method<S, T>
    for General<M>
{
    fn begin(&self, system: &S, q: &Vector<S, T>, v: &[T], t: T, _h: T) -> Result<Self::Memory, StartError> {
        self.admit(system)?;
        self.scheme.admit_inside()?;
        let space = system.space();
        let [mut p, mut seed, mut l_q]: [Vector<S, T>; 3] = space.vectors();
        seed[..v.len()].copy_from_slice(v);
        evaluate(system, q, &seed, t)?;
        system.gradient(q, &seed, t, &mut l_q, &mut p);
        if S::REGULAR {
            // A singular mass matrix is found before the first step.
            let mut same = seed.clone();
            let mut legendre = Legendre::new(system, q, &seed, t);
            legendre.solve(system, q, &p, t, &mut same, false).map_err(StartError::Starter)?;
        }
        let l_d = self.scheme.discrete_lagrangian(system);
        let solver = l_d.solver(system, q, &seed, t);
        Ok(GeneralMemory {
            p,
            history: History::new(system, Some(seed)),
            last_step: T::lift(0.0),
            l_d,
            solver,
            residual: space.vector(),
            increment: space.vector(),
            sum: space.vector(),
            next: space.vector(),
        })
    }

    fn step(
        &self,
        system: &S,
        memory: &mut Self::Memory,
        q: &mut Vector<S, T>,
        t: T,
        h: T,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let GeneralMemory { p, history, last_step, l_d, solver, residual, increment, sum, next } = memory;
        // `sum` is not in use yet.
        history.extrapolate(increment);
        increment.iter_mut().for_each(|delta| *delta *= h);
        let (interval, storage) = (Interval { t, h }, (solver, [residual, &mut *sum]));
        solve_by_newton(l_d, system, interval, [q, p], increment, storage, self.stopping, statistics)?;
        sum.fill(T::lift(0.0));
        memory.residual.fill(T::lift(0.0));
        let ends = Ends { q0: q, delta: increment };
        l_d.derivatives(Span { system, interval, ends }, &mut memory.residual, sum, statistics)?;
        for i in 0..q.len() {
            next[i] = q[i] + increment[i];
            sum[i] += p[i];
        }
        norm::finite(next).and(norm::finite(sum))?;
        q.copy_from_slice(next);
        p.copy_from_slice(sum);
        if !is_similar(h, *last_step) {
            history.clear();
        }
        *last_step = h;
        history.push_scaled(increment, T::lift(1.0) / h);
        Ok(())
    }

    fn velocity(
        &self,
        system: &S,
        memory: &Self::Memory,
        q: &Vector<S, T>,
        t: T,
        v: &mut Vector<S, T>,
    ) -> Result<(), StepFailure> {
        if !S::REGULAR {
            return Ok(());
        }
        memory.history.extrapolate(v);
        Legendre::new(system, q, v, t).solve_near(system, q, &memory.p, t, v, false)
    }
}

impl<S: Lagrangian<T> + System<Kind: Unconstrained>, T: Real, M: InnerScheme<S, T>> VariableStep<S, T>
    for General<M>
{
}

impl<S: Lagrangian<T>, T: Real, M: VariationalMethod<S, T>> VariationalMethod<S, T> for General<M> {
    type DiscreteLagrangian = M::DiscreteLagrangian;

    fn admit(&self, system: &S) -> Result<(), StartError> {
        self.stopping.validate()?;
        self.scheme.admit(system)
    }

    fn discrete_lagrangian(&self, system: &S) -> M::DiscreteLagrangian {
        self.scheme.discrete_lagrangian(system)
    }
}
