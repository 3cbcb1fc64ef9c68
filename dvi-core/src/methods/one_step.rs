//! One-step schemes for degenerate systems in class, α = ϑ(x, y)·dx.
//!
//! As α has no component along y, the discrete Lagrangian of a rule with nodes cⱼ and weights wⱼ needs one ȳ for the step,
//!
//! L_d(x0, x1, ȳ) = h Σⱼ wⱼ L((x0 + cⱼΔ, ȳ), Δ/h),   Δ = x1 − x0, stationary in ȳ,
//!
//! so that its step couples two points and not three (Ellison, Finn, Burby, Kraus, Qin & Tang 2018; Burby, Finn &
//! Ellison 2022). With f = ∂L/∂q it is
//!
//! p0 = Σⱼ wⱼ(ϑⱼ − h(1 − cⱼ) f_xⱼ),   0 = Σⱼ wⱼ f_yⱼ,   p1 = p0 + h Σⱼ wⱼ f_xⱼ,   ϑ(x1, y1) = p1
//!
//! The schemes A and B are those of c = 1 and c = 0 with ȳ in place of y.

mod gauss;
mod split;
mod stage;

use crate::error::{StartError, StepFailure};
use crate::mechanics::VectorField;
use crate::mechanics::orientation::FormOrientation;
use crate::methods::{Carries, Method, PreservedForm, Scheme, VariableStep};
use crate::scalar::norm;
use crate::solve::{Guess, Stopping};
use crate::state::Statistics;
use crate::state::history::Rates;
use crate::state::memory::{Memory, lasting};
use crate::{ProperlyDegenerate, Real, Space, System, Vector};
pub use gauss::{OneStepGauss, OneStepGaussMemory};
use split::{Split, copy_x, is_x};
use stage::{Node, Stage, Step};

/// A one-step scheme for degenerate systems in class: [`ProperlyDegenerate`].
///
/// In class, α = ϑ(x, y)·dx has components along one half x of the coordinates only. The schemes couple two points, and not three
/// as [`Sigma`](crate::methods::Sigma) does, so that they have no parasitic mode. With f = ∂L/∂q, v = Δ/h and Δ = x1 − x0 they
/// are
///
/// ```math
/// \begin{aligned}
/// \text{midpoint:} && \vartheta(\tilde q) &= p_0 + \tfrac h2 f_x(\tilde q, v), & f_y(\tilde q, v) &= 0,
///     & p_1 &= p_0 + h f_x(\tilde q, v) \\
/// \text{trapezoid:} && \tfrac12(\vartheta^- + \vartheta^+) &= p_0 + \tfrac h2 f_x^-, & f_y^- + f_y^+ &= 0,
///     & p_1 &= p_0 + \tfrac h2 (f_x^- + f_x^+) \\
/// \text{A:} && \vartheta(q_1) &= p_0 + h f_x(q_0, v(q_0)), & x_1 &= x_0 + h v(q_1) \\
/// \text{B:} && \vartheta(q_1) &= p_0 + h f_x(q_1, v(q_1)), & x_1 &= x_0 + h v(q_0)
/// \end{aligned}
/// ```
///
/// where p = ϑ(q), v(q) is the velocity of x at q, and q̃ = (x0 + ½Δ, ȳ); the signs − and + stand for values at (x0, ȳ) and
/// (x1, ȳ). The first two schemes end with ϑ(q1) = p1.
///
/// | scheme | order | symmetric | preserves |
/// |---|---|---|---|
/// | [`midpoint`](Self::midpoint) | 2 | yes | Ω |
/// | [`trapezoid`](Self::trapezoid) | 2 | yes | Ω |
/// | [`scheme_a`](Self::scheme_a) | 1 | no; B is its adjoint | dϑ ∧ d(x − h v(q)) |
/// | [`scheme_b`](Self::scheme_b) | 1 | no; A is its adjoint | dϑ ∧ d(x + h v(q)) |
///
/// A step is solved by Newton's method with all second derivatives of L. If Ω does not couple the coordinates in pairs, ϑ = p is
/// solved by full elimination of n/2 rows. A step that would lead to another branch of ϑ(x, y) = p ends with
/// [`StepFailure::Orientation`](crate::error::StepFailure::Orientation), as far as Ω has another sign halfway. A system that is not in class has no such scheme, and
/// using one is a compile error: out of class their equations converge to a wrong motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OneStep {
    rule: Rule,
    /// The criterion by which a step counts as solved. Default: to rounding errors.
    pub stopping: Stopping,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Rule {
    A,
    B,
    Midpoint,
    Trapezoid,
}

impl OneStep {
    /// Order 2, symmetric: one node, at the centre.
    pub fn midpoint() -> Self {
        Self::of(Rule::Midpoint)
    }

    /// Order 2, symmetric: a node at each end.
    pub fn trapezoid() -> Self {
        Self::of(Rule::Trapezoid)
    }

    /// Order 1: the scheme A of Ellison et al. 2018.
    pub fn scheme_a() -> Self {
        Self::of(Rule::A)
    }

    /// Order 1: the scheme B of Ellison et al. 2018.
    pub fn scheme_b() -> Self {
        Self::of(Rule::B)
    }

    fn of(rule: Rule) -> Self {
        Self { rule, stopping: Stopping::default() }
    }
}

impl Scheme for OneStep {
    fn order(&self) -> usize {
        match self.rule {
            Rule::A | Rule::B => 1,
            Rule::Midpoint | Rule::Trapezoid => 2,
        }
    }
    fn is_symmetric(&self) -> bool {
        matches!(self.rule, Rule::Midpoint | Rule::Trapezoid)
    }
    fn preserved_form(&self) -> PreservedForm {
        if self.is_symmetric() { PreservedForm::Omega } else { PreservedForm::Conjugate }
    }
}

/// What a run of a one-step scheme carries.
#[derive(Debug)]
pub struct OneStepMemory<S: System, T: Real> {
    /// ϑ at the current point, zero along y.
    p: Vector<S, T>,
    /// The velocity of x at the current point, and zero along y, for the schemes A and B.
    velocity: Vector<S, T>,
    /// The mean rates of change of the last steps, that of y to where it stands in the equations.
    rates: Rates<S, T>,
    orientation: FormOrientation<S, T>,
    split: Split<S, T>,
    stage: Stage<S, T>,
    next: Vector<S, T>,
}

impl<S: System, T: Real> Memory<T> for OneStepMemory<S, T> {
    lasting!(T; numbers p, numbers velocity, part rates, part orientation);
}

impl<S: System, T: Real> Carries<S, T> for OneStep {
    type Memory = OneStepMemory<S, T>;
}

impl<S: ProperlyDegenerate<T>, T: Real> Method<S, T> for OneStep {
    fn begin(&self, system: &S, q: &Vector<S, T>, _v: &[T], t: T, _h: T) -> Result<Self::Memory, StartError> {
        self.stopping.validate()?;
        let split = Split::new(system);
        let [mut p, mut velocity]: [Vector<S, T>; 2] = core::array::from_fn(|_| system.space().vector());
        system.one_form(q, t, &mut p);
        let rates = VectorField::starting(system, q, t)?;
        copy_x(system, &rates, &mut velocity);
        Ok(OneStepMemory {
            p,
            velocity,
            rates: Rates::new(system, rates),
            orientation: FormOrientation::new(system, q, t),
            stage: Stage::new(system, q, t),
            split,
            next: system.space().vector(),
        })
    }

    #[inline]
    fn step(
        &self,
        system: &S,
        memory: &mut Self::Memory,
        q: &mut Vector<S, T>,
        t: T,
        h: T,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        // Where steps are long, extrapolation is off, or leads to another branch.
        self.attempt(system, memory, q, [t, h], Guess::Extrapolated, statistics)
            .or_else(|_| self.attempt(system, memory, q, [t, h], Guess::Zero, statistics))?;
        memory.arrive(system, q, h);
        Ok(())
    }
}

impl<S: ProperlyDegenerate<T>, T: Real> VariableStep<S, T> for OneStep {}

impl OneStep {
    /// Sets `next` to q1, if it is on the branch of ϑ(x, y) = p that q0 is on.
    fn attempt<S: ProperlyDegenerate<T>, T: Real>(
        &self,
        system: &S,
        memory: &mut OneStepMemory<S, T>,
        q: &Vector<S, T>,
        [t, h]: [T; 2],
        guess: Guess,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let half = T::lift(0.5);
        match self.rule {
            Rule::Midpoint | Rule::Trapezoid => memory.guess(system, q, h, half, guess),
            Rule::A | Rule::B => memory.guess(system, q, h, T::lift(1.0), guess),
        }
        match self.rule {
            Rule::Midpoint => self.variational(system, memory, q, [t, h], &[Node::CENTRE], statistics)?,
            Rule::Trapezoid => self.variational(system, memory, q, [t, h], &Node::ENDS, statistics)?,
            Rule::A => self.first_order(system, memory, q, [t, h], Node::END, statistics)?,
            Rule::B => self.first_order(system, memory, q, [t, h], Node::BEGIN, statistics)?,
        }
        norm::finite(&memory.next)?;
        let OneStepMemory { orientation, stage, next, .. } = memory;
        // Between two branches Ω changes its sign.
        norm::mean(q, next, &mut stage.point);
        orientation.compare(system, &stage.point, t + half * h)?;
        orientation.check(system, next, t + h)
    }

    /// Sets `next` to q1 of a symmetric scheme, `stage.momentum` to p1, and `stage.rates` to the rates of change.
    fn variational<S: ProperlyDegenerate<T>, T: Real>(
        &self,
        system: &S,
        memory: &mut OneStepMemory<S, T>,
        q: &Vector<S, T>,
        [t, h]: [T; 2],
        nodes: &[Node],
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let half = T::lift(0.5);
        let OneStepMemory { p, orientation, split, stage, next, .. } = memory;
        stage.momentum.copy_from_slice(p);
        let step = Step { system, q, t, h, nodes, stopping: self.stopping };
        stage.solve(&step, statistics)?;
        // p1 = p0 + h Σ w f_x, from the nodes at the solution.
        let time = stage.kick(&step, statistics);
        // Between two branches Ω changes its sign.
        orientation.compare(system, &stage.point, time)?;
        for i in 0..q.len() {
            let is_x = is_x(system, i);
            // From ȳ on, as far again.
            next[i] =
                if is_x { q[i] + stage.unknown[i] } else { stage.unknown[i] + (stage.unknown[i] - q[i]) };
            stage.rates[i] = if is_x { stage.unknown[i] } else { (stage.unknown[i] - q[i]) / half } / h;
        }
        let end = t + h;
        split.solve_y(system, next, end, &stage.momentum, self.stopping, statistics).or_else(|_| {
            // From where y was, if as far again is too far.
            for i in (0..q.len()).filter(|&i| !is_x(system, i)) {
                next[i] = stage.unknown[i];
            }
            split.solve_y(system, next, end, &stage.momentum, self.stopping, statistics)
        })
    }

    /// The same for A, whose node is at the end, and B, whose node is at the beginning of the interval that comes next.
    fn first_order<S: ProperlyDegenerate<T>, T: Real>(
        &self,
        system: &S,
        memory: &mut OneStepMemory<S, T>,
        q: &Vector<S, T>,
        [t, h]: [T; 2],
        node: Node,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let OneStepMemory { p, velocity, stage, next, .. } = memory;
        stage.momentum.copy_from_slice(p);
        let is_b = node == Node::BEGIN;
        next.copy_from_slice(q);
        let begin = if is_b {
            for i in 0..q.len() {
                next[i] += h * velocity[i];
            }
            t + h
        } else {
            system.gradient(q, velocity, t, &mut stage.gradient, &mut stage.one_form);
            statistics.gradients += 1;
            for i in (0..q.len()).filter(|&i| is_x(system, i)) {
                stage.momentum[i] += h * stage.gradient[i];
            }
            t
        };
        let step = Step { system, q: next, t: begin, h, nodes: &[node], stopping: self.stopping };
        stage.solve(&step, statistics)?;
        for i in 0..q.len() {
            if is_x(system, i) {
                stage.rates[i] = stage.unknown[i] / h;
                if !is_b {
                    next[i] = q[i] + stage.unknown[i];
                }
            } else {
                next[i] = stage.unknown[i];
                stage.rates[i] = (next[i] - q[i]) / h;
            }
        }
        system.one_form(next, t + h, &mut stage.momentum);
        Ok(())
    }
}

impl<S: ProperlyDegenerate<T>, T: Real> OneStepMemory<S, T> {
    /// Sets `stage.unknown` to the guess: Δ along x, and along y the place after the part `c` of the step.
    fn guess(&mut self, system: &S, q: &Vector<S, T>, h: T, c: T, guess: Guess) {
        let Self { rates, stage, .. } = self;
        rates.guess(h, guess, &mut stage.unknown);
        for (i, unknown) in stage.unknown.iter_mut().enumerate() {
            *unknown = if is_x(system, i) { h * *unknown } else { q[i] + c * h * *unknown };
        }
    }

    /// Moves to `next`, with the momentum and the rates of the stage.
    fn arrive(&mut self, system: &S, q: &mut Vector<S, T>, h: T) {
        let Self { p, velocity, rates, stage, next, .. } = self;
        q.copy_from_slice(next);
        p.copy_from_slice(&stage.momentum);
        copy_x(system, &stage.rates, velocity);
        rates.push(h, &stage.rates);
    }
}
