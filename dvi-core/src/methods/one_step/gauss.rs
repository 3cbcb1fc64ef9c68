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
use crate::mechanics::VectorField;
use crate::mechanics::orientation::FormOrientation;
use crate::mechanics::pattern::coupled_by_second_derivatives;
use crate::memory::{Memory, lasting};
use crate::methods::collocation::Collocation;
use crate::methods::{Carries, Method, PreservedForm, Scheme, VariableStep};
use crate::scalar::norm;
use crate::solve::{Convergence, Due, Guess, Stopping, iterate, sizes};
use crate::space::{CoupledSolver, NodeSum, Sink, Storing, linear};
use crate::state::Statistics;
use crate::state::rates::is_similar;
use crate::{Coupled, ProperlyDegenerate, Real, Scalar, Space, System, Vector, Weights};

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
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OneStepGauss<const S: usize> {
    /// The criterion by which a step counts as solved. Default: to rounding errors.
    pub stopping: Stopping,
}

impl<const S: usize> OneStepGauss<S> {
    /// The method with default options. A number of stages other than 1, 2, 3 or 4 does not compile.
    pub fn new() -> Self {
        const { assert!(S >= 1 && S <= 4, "Gauss collocation is available with 1, 2, 3 or 4 stages") };
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
    /// ϑ at the current point, zero along y.
    p: Vector<S, T>,
    /// The velocities V of the last step.
    completed: [Vector<S, T>; STAGES],
    last_step: T,
    orientation: FormOrientation<S, T>,
    tableau: Collocation<STAGES>,
    continuation: [[f64; STAGES]; STAGES],
    split: Split<S, T>,
    solver: Coupled<STAGES, S, T>,
    /// The unknowns W, and F at the stages.
    increments: [Vector<S, T>; STAGES],
    forces: [Vector<S, T>; STAGES],
    /// The residuals, and then the corrections.
    residuals: [Vector<S, T>; STAGES],
    /// In which the iteration judges coordinates.
    weights: Vector<S, T>,
    work: Work<S, T>,
}

/// Vectors that are written before they are read.
#[derive(Debug)]
struct Work<S: System, T: Real> {
    point: Vector<S, T>,
    velocity: Vector<S, T>,
    gradient: Vector<S, T>,
    one_form: Vector<S, T>,
    next: Vector<S, T>,
    momentum: Vector<S, T>,
}

impl<const STAGES: usize, S: System, T: Real> Memory<T> for OneStepGaussMemory<STAGES, S, T> {
    lasting!(T; numbers p, vectors completed, number last_step, part orientation);
}

/// Sets `point` to Qᵢ.
fn place<const STAGES: usize, T: Real>(
    row: &[f64; STAGES],
    q: &[T],
    increments: &[impl core::ops::Deref<Target = [T]>; STAGES],
    point: &mut [T],
) {
    for (n, (point, &q)) in point.iter_mut().zip(q).enumerate() {
        *point = row.iter().zip(increments).fold(q, |sum, (&a, w)| sum + T::lift(a) * w[n]);
    }
}

impl<const STAGES: usize, S: ProperlyDegenerate<T>, T: Real> OneStepGaussMemory<STAGES, S, T> {
    fn new(system: &S, q: &Vector<S, T>, t: T) -> Result<Self, StartError> {
        let space = system.space();
        let mut p = space.vector();
        system.one_form(q, t, &mut p);
        let rates = VectorField::starting(system, q, t)?;
        let tableau = Collocation::gauss();
        let rest: Vector<S, T> = space.vector();
        Ok(Self {
            p,
            completed: core::array::from_fn(|_| rates.clone()),
            last_step: T::lift(0.0),
            orientation: FormOrientation::new(system, q, t),
            tableau,
            continuation: tableau.continuation(),
            split: Split::new(system),
            solver: coupled_by_second_derivatives(system, [q, &rest], t, STAGES, Storing::Always),
            increments: space.vectors(),
            weights: space.vector(),
            forces: space.vectors(),
            residuals: space.vectors(),
            work: Work {
                point: space.vector(),
                velocity: space.vector(),
                gradient: space.vector(),
                one_form: space.vector(),
                next: space.vector(),
                momentum: space.vector(),
            },
        })
    }

    /// The increments of the last polynomial continued, those of its last slope where the step has another
    /// length, or zero.
    fn guess(&mut self, h: T, guess: Guess) {
        let continues = is_similar(h, self.last_step);
        for (i, increment) in self.increments.iter_mut().enumerate() {
            for (n, w) in increment.iter_mut().enumerate() {
                let row = self.continuation[i].iter().zip(&self.completed);
                *w = match guess {
                    Guess::Zero => T::lift(0.0),
                    Guess::Extrapolated if continues => {
                        h * row.fold(T::lift(0.0), |sum, (&l, v)| sum + T::lift(l) * v[n])
                    }
                    Guess::Extrapolated => h * self.completed[STAGES - 1][n],
                };
            }
        }
    }

    fn step(
        &mut self,
        system: &S,
        q: &mut Vector<S, T>,
        [t, h]: [T; 2],
        stopping: Stopping,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        // Where steps are long, extrapolation is off, or leads to another branch.
        self.attempt(system, q, [t, h], stopping, Guess::Extrapolated, statistics)
            .or_else(|_| self.attempt(system, q, [t, h], stopping, Guess::Zero, statistics))?;
        q.copy_from_slice(&self.work.next);
        self.p.copy_from_slice(&self.work.momentum);
        for (completed, increment) in self.completed.iter_mut().zip(&self.increments) {
            for (v, &w) in completed.iter_mut().zip(increment.iter()) {
                *v = w / h;
            }
        }
        self.last_step = h;
        Ok(())
    }

    /// Sets `work.next` to q1 and `work.momentum` to p1, if q1 and the stages are on the branch of ϑ(x, y) =
    /// p that q0 is on.
    fn attempt(
        &mut self,
        system: &S,
        q: &Vector<S, T>,
        [t, h]: [T; 2],
        stopping: Stopping,
        guess: Guess,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        self.newton(system, q, [t, h], stopping, guess, statistics)?;
        self.differentiate(system, q, [t, h], statistics);
        let Self { p, orientation, tableau, split, increments, forces, work, .. } = &mut *self;
        let Work { point, next, momentum, .. } = work;
        place(&tableau.b, q, increments, next);
        for (i, (momentum, &p)) in momentum.iter_mut().zip(p.iter()).enumerate() {
            let impulse = tableau.b.iter().zip(forces.iter()).map(|(&b, f)| T::lift(b) * f[i]);
            let impulse = impulse.fold(T::lift(0.0), |sum, term| sum + term);
            *momentum = if is_x(system, i) { p + h * impulse } else { T::lift(0.0) };
        }
        split.solve_y::<Convergence<T>>(system, next, t + h, momentum, stopping, statistics)?;
        norm::finite(next)?;
        // Between two branches Ω changes its sign.
        for (row, &c) in tableau.a.iter().zip(&tableau.c) {
            place(row, q, increments, point);
            orientation.compare(system, point, t + T::lift(c) * h)?;
        }
        norm::mean(q, next, point);
        orientation.compare(system, point, t + T::lift(0.5) * h)?;
        orientation.check(system, next, t + h)
    }

    /// Solves for the increments.
    fn newton(
        &mut self,
        system: &S,
        q: &Vector<S, T>,
        [t, h]: [T; 2],
        stopping: Stopping,
        guess: Guess,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        self.guess(h, guess);
        let convergence = Convergence::new(stopping, stopping.max_iterations);
        iterate(convergence, statistics, |due, statistics| {
            due.prepare_all(system, &mut self.weights, q, &mut self.increments);
            self.differentiate(system, q, [t, h], statistics);
            self.residuals.iter().try_for_each(|residual| norm::finite(residual))?;
            statistics.linearizations += STAGES as u64;
            statistics.factorisations += 1;
            let Self { p, tableau, increments, residuals, weights, solver, work, .. } = &mut *self;
            let mut matrix = Linearized { system, tableau, q, increments, t, h, node: 0, work };
            let size =
                |j: usize| increments.iter().fold(Scalar::abs(q[j]), |size, w| size + Scalar::abs(w[j]));
            if *due == Due::Residual {
                return linear::residual_of_nodes(&mut matrix, size, |i| p[i], residuals, weights);
            }
            solver.solve(&mut matrix, weights, residuals)?;
            let mut correction = T::lift(0.0);
            for (increment, change) in increments.iter_mut().zip(&*residuals) {
                correction = norm::larger(correction, sizes::reduce(system, weights, increment, change));
            }
            Ok(correction)
        })?;
        self.increments.iter().try_for_each(|increment| norm::finite(increment))
    }

    /// Sets `forces` to F and `residuals` to r.
    fn differentiate(&mut self, system: &S, q: &[T], [t, h]: [T; 2], statistics: &mut Statistics) {
        let Self { p, tableau, increments, forces, residuals, work, .. } = self;
        let Work { point, velocity, one_form, .. } = work;
        for (i, force) in forces.iter_mut().enumerate() {
            place(&tableau.a[i], q, increments, point);
            for (v, &w) in velocity.iter_mut().zip(increments[i].iter()) {
                *v = w / h;
            }
            system.gradient(point, velocity, t + T::lift(tableau.c[i]) * h, force, one_form);
            statistics.gradients += 1;
            for ((r, &form), &p) in residuals[i].iter_mut().zip(one_form.iter()).zip(p.iter()) {
                *r = form - p;
            }
        }
        for (row, residual) in tableau.a.iter().zip(residuals.iter_mut()) {
            for (&a, force) in row.iter().zip(forces.iter()) {
                let factor = h * T::lift(a);
                for (r, &force) in residual.iter_mut().zip(force.iter()) {
                    *r -= factor * force;
                }
            }
        }
    }
}

/// The matrix ∂rᵢ/∂Wₖ at the current increments; a node of the sum is a stage.
struct Linearized<'a, const STAGES: usize, S: System, T: Real> {
    system: &'a S,
    tableau: &'a Collocation<STAGES>,
    q: &'a [T],
    increments: &'a [Vector<S, T>; STAGES],
    t: T,
    h: T,
    node: usize,
    work: &'a mut Work<S, T>,
}

impl<const STAGES: usize, S: ProperlyDegenerate<T>, T: Real> NodeSum<STAGES, T>
    for Linearized<'_, STAGES, S, T>
{
    const FIRST: usize = 0;

    fn place(&mut self, j: usize) {
        self.node = j;
        let Work { point, velocity, .. } = &mut *self.work;
        place(&self.tableau.a[j], self.q, self.increments, point);
        for (v, &w) in velocity.iter_mut().zip(self.increments[j].iter()) {
            *v = w / self.h;
        }
    }

    fn weights(&self, r: usize, k: usize) -> Weights<T> {
        let (j, zero) = (self.node, T::lift(0.0));
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
        let time = self.t + T::lift(self.tableau.c[self.node]) * self.h;
        let Work { point, velocity, gradient, one_form, .. } = &mut *self.work;
        self.system.linearize(point, velocity, time, Weights { qq: one, ..none }, gradient, one_form, qq);
        self.system.linearize(point, velocity, time, Weights { qv: one, ..none }, gradient, one_form, qv);
    }
}

impl<const STAGES: usize, S: System, T: Real> Carries<S, T> for OneStepGauss<STAGES> {
    type Memory = OneStepGaussMemory<STAGES, S, T>;
}

impl<const STAGES: usize, S: ProperlyDegenerate<T>, T: Real> Method<S, T> for OneStepGauss<STAGES> {
    fn begin(
        &self,
        system: &S,
        q: &Vector<S, T>,
        _v: &[T],
        t: T,
        _h: T,
    ) -> Result<Self::Memory, StartError> {
        self.stopping.validate()?;
        OneStepGaussMemory::new(system, q, t)
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
        memory.step(system, q, [t, h], self.stopping, statistics)
    }
}

impl<const STAGES: usize, S: ProperlyDegenerate<T>, T: Real> VariableStep<S, T> for OneStepGauss<STAGES> {}
