//! Gauss collocation of a degenerate Lagrangian in class, for the increments Wₖ = h Vₖ of all stages at
//! once, by Newton's method:
//!
//! rᵢ = α(Qᵢ) − p − h Σⱼ aᵢⱼ Fⱼ = 0,   Qᵢ = q + Σₖ aᵢₖ Wₖ,   F = ∂L/∂q(Q, V)
//! ∂rᵢ/∂Wₖ = aᵢₖ Dα(Qᵢ) − aᵢₖ L_qv(Qₖ) − h Σⱼ aᵢⱼ aⱼₖ L_qq(Qⱼ)
//! x1 = x0 + Σᵢ bᵢ Wᵢ,   p1 = p0 + h Σᵢ bᵢ Fᵢ along x,   ϑ(x1, y1) = p1
//!
//! As A is regular and α has no component along y, the rows of y say that F vanishes along y at each stage.

use super::split::{Split, is_x};
use crate::error::{StartError, StepFailure};
use crate::mechanics::pattern::coupled_by_second_derivatives;
use crate::memory::{Memory, lasting};
use crate::methods::collocation::Collocation;
use crate::methods::one_point::OnePoint;
use crate::methods::{self, Carries, Method, PreservedForm, Scheme, Tabulated, VariableStep};
use crate::scalar::norm;
use crate::solve::{Convergence, CoupledEquations, Guess, Stopping, from_either_guess, solve_coupled};
use crate::space::{NodeSum, Sink, Storing};
use crate::state::Statistics;
use crate::{Coupled, ProperlyDegenerate, Real, Space, System, Vector, Weights};

/// Gauss collocation of a degenerate Lagrangian in class ([`ProperlyDegenerate`]) with `S` stages, 1 ≤ `S` ≤
/// 4.
///
/// ```math
/// \alpha(Q_i) = p_0 + h \sum_j a_{ij} F_j, \quad Q_i = q_0 + h \sum_j a_{ij} V_j, \quad
/// F_j = \partial_q L(Q_j, V_j), \qquad \vartheta(q_1) = p_0 + h \sum_i b_i F_i
/// ```
///
/// The order is 2`S`, the method is symmetric, and it preserves Ω whether α is affine or not. With `S` = 1
/// it is [`OneStep::midpoint`](super::OneStep::midpoint). A step is solved by Newton's method for all stages
/// at once, with all second derivatives of L.
///
/// Out of class the same equations have order `S` only and preserve nothing; they are no method then.
///
/// ```
#[doc = include_str!("../../../docs/hidden/predators.txt")]
/// let mut run = Integrator::new(&Predators, OneStepGauss::<3>::new(), 0.1, start)?;
/// assert_eq!(run.method().order(), 6);
/// let energy = run.energy();
/// run.take_steps(10_000)?;
/// assert!((run.energy() - energy).abs() < 1e-7);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OneStepGauss<const S: usize> {
    /// The criterion by which a step counts as solved. Default: to rounding errors.
    pub stopping: Stopping,
}

impl<const S: usize> OneStepGauss<S> {
    /// The method with default options. A number of stages other than 1, 2, 3 or 4 does not compile.
    pub fn new() -> Self
    where
        Self: Tabulated,
    {
        Self::default()
    }
}

impl<const S: usize> Scheme for OneStepGauss<S> {
    fn order(&self) -> usize {
        2 * S
    }
    fn is_symmetric(&self) -> bool {
        true
    }
    fn preserved_form(&self) -> PreservedForm {
        PreservedForm::Omega
    }
}

/// What a run of a method with `STAGES` stages carries.
#[derive(Debug)]
pub struct OneStepGaussMemory<const STAGES: usize, S: System, T: Real> {
    /// With the velocities V of each stage. α is zero along y.
    point: OnePoint<S, T, STAGES>,
    split: Split<S, T>,
    solver: Coupled<STAGES, S, T>,
    /// W
    increments: [Vector<S, T>; STAGES],
    /// The residuals, and then the corrections.
    residuals: [Vector<S, T>; STAGES],
    /// In which the iteration judges coordinates, and work space.
    weights: [Vector<S, T>; 2],
    work: Work<STAGES, S, T>,
}

/// Vectors that are written before they are read.
#[derive(Debug)]
struct Work<const STAGES: usize, S: System, T: Real> {
    /// F
    forces: [Vector<S, T>; STAGES],
    point: Vector<S, T>,
    velocity: Vector<S, T>,
    gradient: Vector<S, T>,
    one_form: Vector<S, T>,
    next: Vector<S, T>,
    momentum: Vector<S, T>,
}

impl<const STAGES: usize, S: System, T: Real> Memory<T> for OneStepGaussMemory<STAGES, S, T> {
    lasting!(T; part point);
}

impl<const STAGES: usize, S: System, T: Real> Carries<S, T> for OneStepGauss<STAGES> {
    type Memory = OneStepGaussMemory<STAGES, S, T>;
}

impl<const STAGES: usize, S: ProperlyDegenerate<T>, T: Real> Method<S, T> for OneStepGauss<STAGES> {
    type Suited<X> = <S as ProperlyDegenerate<T>>::Suited<X>;

    fn begin(
        &self,
        system: &S,
        q: &Vector<S, T>,
        _v: &[T],
        t: T,
        _h: T,
    ) -> Result<Self::Memory, StartError> {
        self.stopping.validate()?;
        let space = system.space();
        let [point, velocity, gradient, one_form, next, momentum, rest] = space.vectors();
        Ok(OneStepGaussMemory {
            point: OnePoint::new(system, q, t, |rates| core::array::from_fn(|_| rates.clone()))?,
            split: Split::new(system),
            solver: coupled_by_second_derivatives(system, [q, &rest], t, STAGES, Storing::Always),
            increments: space.vectors(),
            residuals: space.vectors(),
            weights: space.vectors(),
            work: Work { forces: space.vectors(), point, velocity, gradient, one_form, next, momentum },
        })
    }

    fn step(&self, step: methods::Step<'_, S, T>, memory: &mut Self::Memory) -> Result<(), StepFailure> {
        let methods::Step { system, q, t, h, statistics } = step;
        let (tableau, stopping) = (&Collocation::gauss(), self.stopping);
        let OneStepGaussMemory { point, split, solver, increments, residuals, weights, work } = memory;
        from_either_guess(|guess: Guess| {
            let OnePoint { p, rates, orientation } = &mut *point;
            rates.guess(h, guess, increments.each_mut());
            increments.iter_mut().for_each(|w| w.iter_mut().for_each(|w| *w *= h));
            let mut step = Step { system, tableau, q, p, t, h, increments, work, stage: 0 };
            solve_coupled(&mut step, (system, q), solver, (residuals, weights), stopping, statistics)?;
            step.evaluate(residuals, statistics)?;
            step.end();
            let Work { next, momentum, .. } = &mut *step.work;
            split.solve_y::<Convergence<T>>(system, next, t + h, momentum, stopping, statistics)?;
            norm::finite(next)?;
            // Between two branches Ω changes its sign.
            for stage in 0..STAGES {
                step.place(stage);
                orientation.compare(system, &step.work.point, step.time())?;
            }
            let Work { next, point, .. } = &mut *step.work;
            norm::mean(q, next, point);
            orientation.pass(system, &[(point, t + T::lift(0.5) * h)], (next, t + h))
        })?;
        increments.iter_mut().for_each(|w| w.iter_mut().for_each(|w| *w /= h));
        point.arrive(q, (&work.next, &work.momentum), h, increments.each_ref());
        Ok(())
    }
}

impl<const STAGES: usize, S: ProperlyDegenerate<T>, T: Real> VariableStep<S, T> for OneStepGauss<STAGES> {
    type SuitedToAnyStep<X> = <Self as Method<S, T>>::Suited<X>;
}

/// The equations of a step from `q` at `t`, and the matrix ∂rᵢ/∂Wₖ, in which a node of the sum is a stage.
struct Step<'a, const STAGES: usize, S: System, T: Real> {
    system: &'a S,
    tableau: &'a Collocation<STAGES>,
    q: &'a [T],
    p: &'a [T],
    t: T,
    h: T,
    increments: &'a mut [Vector<S, T>; STAGES],
    work: &'a mut Work<STAGES, S, T>,
    stage: usize,
}

impl<const STAGES: usize, S: ProperlyDegenerate<T>, T: Real> Step<'_, STAGES, S, T> {
    /// The time of the stage.
    fn time(&self) -> T {
        self.t + T::lift(self.tableau.c[self.stage]) * self.h
    }

    /// Sets `work.next` to q0 + Σᵢ bᵢ Wᵢ, and `work.momentum` to p1.
    fn end(&mut self) {
        let Self { system, tableau: Collocation { b, .. }, q, p, h, increments, work, .. } = self;
        let Work { forces, next, momentum, .. } = &mut **work;
        for i in 0..q.len() {
            next[i] = weighted(b, increments, i, q[i]);
            momentum[i] = if is_x(*system, i) {
                p[i] + *h * weighted(b, forces, i, T::lift(0.0))
            } else {
                T::lift(0.0)
            };
        }
    }
}

/// `from` + Σₖ `row`ₖ xₖ of coordinate `i`.
fn weighted<const STAGES: usize, T: Real>(
    row: &[f64; STAGES],
    x: &[impl core::ops::Deref<Target = [T]>; STAGES],
    i: usize,
    from: T,
) -> T {
    row.iter().zip(x).fold(from, |sum, (&a, x)| sum + T::lift(a) * x[i])
}

impl<const STAGES: usize, S: ProperlyDegenerate<T>, T: Real> CoupledEquations<STAGES, S, T>
    for Step<'_, STAGES, S, T>
{
    fn unknowns(&mut self) -> &mut [Vector<S, T>; STAGES] {
        self.increments
    }

    fn evaluate(
        &mut self,
        residuals: &mut [Vector<S, T>; STAGES],
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        for (stage, residual) in residuals.iter_mut().enumerate() {
            self.place(stage);
            let time = self.time();
            let Work { forces, point, velocity, one_form, .. } = &mut *self.work;
            self.system.gradient(point, velocity, time, &mut forces[stage], one_form);
            statistics.gradients += 1;
            for ((r, &form), &p) in residual.iter_mut().zip(one_form.iter()).zip(self.p) {
                *r = form - p;
            }
        }
        for (row, residual) in self.tableau.a.iter().zip(residuals) {
            for (i, r) in residual.iter_mut().enumerate() {
                *r -= self.h * weighted(row, &self.work.forces, i, T::lift(0.0));
            }
        }
        Ok(())
    }
}

impl<const STAGES: usize, S: ProperlyDegenerate<T>, T: Real> NodeSum<STAGES, T> for Step<'_, STAGES, S, T> {
    const FIRST: usize = 0;

    fn place(&mut self, j: usize) {
        self.stage = j;
        let Self { tableau, q, h, increments, work: Work { point, velocity, .. }, .. } = self;
        for i in 0..q.len() {
            point[i] = weighted(&tableau.a[j], increments, i, q[i]);
            velocity[i] = increments[j][i] / *h;
        }
    }

    fn given(&self, i: usize) -> T {
        self.p[i]
    }

    fn weights(&self, r: usize, k: usize) -> Weights<T> {
        let (j, zero) = (self.stage, T::lift(0.0));
        let a = |i: usize, k: usize| T::lift(self.tableau.a[i][k]);
        Weights {
            qq: -self.h * a(r, j) * a(j, k),
            qv: if j == k { -a(r, j) } else { zero },
            vq: if j == r { a(r, k) } else { zero },
            vv: zero,
        }
    }

    fn second_derivatives(&mut self, qq: &mut impl Sink<T>, qv: &mut impl Sink<T>, _vv: &mut impl Sink<T>) {
        let (zero, one) = (T::lift(0.0), T::lift(1.0));
        let none = Weights { qq: zero, qv: zero, vq: zero, vv: zero };
        let time = self.time();
        let Work { point, velocity, gradient, one_form, .. } = &mut *self.work;
        self.system.linearize(point, velocity, time, Weights { qq: one, ..none }, gradient, one_form, qq);
        self.system.linearize(point, velocity, time, Weights { qv: one, ..none }, gradient, one_form, qv);
    }
}
