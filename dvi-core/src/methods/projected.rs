//! The variational midpoint scheme of a degenerate Lagrangian, projected onto p = α(q) (Kraus 2017).
//!
//! The scheme σ = ½ leaves the surface p = α(q), on which the motion is: that is its parasitic mode. A
//! projection moves both ends of a step by a vector λ along the directions that Ω makes of the constraint,
//!
//! (q̃0, p̃0) = (q0 + aλ, α(q0) + a Dα(q0)ᵀλ),   (q̃1, p̃1) = (q1 + bλ, α(q1) + b Dα(q1)ᵀλ),
//!
//! between which stand the equations p̃0 = −D₁L_d(q̃0, q̃1) and p̃1 = D₂L_d(q̃0, q̃1) for q1 and λ: 2n
//! unknowns. The symmetric projection has a = b = 1, since the midpoint scheme reverses what is off the
//! surface; the standard one has a = 0, b = −1.

use crate::error::{StartError, StepFailure};
use crate::mechanics::pattern::coupled_by_second_derivatives;
use crate::memory::{Memory, lasting};
use crate::methods::one_point::OnePoint;
use crate::methods::{self, Carries, Method, PreservedForm, Scheme, VariableStep};
use crate::scalar::norm;
use crate::solve::{CoupledEquations, Stopping, from_either_guess, solve_coupled};
use crate::space::{NodeSum, Sink, Storing};
use crate::state::Statistics;
use crate::system::spinors;
use crate::{Coupled, DegenerateLagrangian, Real, Space, System, Vector, Weights};

/// The variational midpoint scheme with a projection onto p = α(q), for any degenerate system.
///
/// ```math
/// \begin{aligned}
/// \alpha(q_0) + a\, D\alpha(q_0)^T \lambda &= -D_1 L_d(\tilde q_0, \tilde q_1), & \tilde q_0 &= q_0 + a \lambda \\
/// \alpha(q_1) + b\, D\alpha(q_1)^T \lambda &= D_2 L_d(\tilde q_0, \tilde q_1), & \tilde q_1 &= q_1 + b \lambda
/// \end{aligned}
/// ```
///
/// | projection | a, b | order | symmetric |
/// |---|---|---|---|
/// | [`symmetric`](Self::symmetric) | 1, 1 | 2 | yes |
/// | [`standard`](Self::standard) | 0, −1 | 2 | no |
///
/// The schemes are for one-forms that no gauge brings into the class of [`OneStep`](super::OneStep), which
/// is to be preferred where it can be used. They couple two points and have no parasitic mode. Where α is
/// affine with constant coefficients, λ = 0 and both are the implicit midpoint rule, which preserves Ω.
///
/// Elsewhere they do not preserve Ω exactly: with ζ = Σᵢⱼ ∂αⱼ/∂qⁱ λʲ dλⁱ, a step makes of dα + a² dζ at q0
/// the form dα + b² dζ at q1. As λ is of the order h², the symmetric projection changes Ω by terms of the
/// order h⁵ in a step, the standard one by h⁴. The energy of both drifts, by terms of the order h⁴ per unit
/// of time for the symmetric one and h³ for the standard one. Where a motion has a reversing symmetry, as
/// that of a guiding centre in a magnetic mirror, the symmetric one shows no drift: its energy error is no
/// larger after 2·10⁵ steps than after a tenth of them. Source: Kraus 2017, *Projected variational
/// integrators for degenerate Lagrangian systems*, with the midpoint rule.
///
/// A step is solved by Newton's method for 2n unknowns.
///
/// ```
/// use dvi_core::prelude::*;
///
/// /// Predators and prey with components of α along both: in no class of one-step schemes as it stands.
/// #[degenerate_lagrangian(
///     coordinates(x, y),
///     one_form = (y.ln() / x * d(x) - x.ln() / y * d(y)) / 2.0,
///     hamiltonian = x + y - x.ln() - 2.0 * y.ln(),
/// )]
/// struct Predators;
///
/// let start = PredatorsState { x: 1.0, y: 0.5 };
/// let mut run = Integrator::new(&Predators, Projected::symmetric(), 0.05, start)?;
/// let energy = run.energy();
/// run.take_steps(10_000)?;
/// assert!((run.energy() - energy).abs() < 1e-2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projected {
    /// a and b.
    factors: [f64; 2],
    /// The criterion by which a step counts as solved. Default: to rounding errors.
    pub stopping: Stopping,
}

impl Projected {
    /// Order 2, symmetric: both ends are moved.
    pub fn symmetric() -> Self {
        Self { factors: [1.0, 1.0], stopping: Stopping::default() }
    }

    /// Order 2, not symmetric: the end is moved.
    pub fn standard() -> Self {
        Self { factors: [0.0, -1.0], stopping: Stopping::default() }
    }
}

impl Scheme for Projected {
    fn order(&self) -> usize {
        2
    }
    fn is_symmetric(&self) -> bool {
        self.factors == [1.0, 1.0]
    }
    fn preserved_form(&self) -> PreservedForm {
        PreservedForm::OmegaIfAffine
    }
}

/// What a run of a projected scheme carries.
#[derive(Debug)]
pub struct ProjectedMemory<S: System, T: Real> {
    point: OnePoint<S, T>,
    solver: Coupled<NODES, S, T>,
    /// From 1: Δ = q1 − q0 and λ.
    unknowns: [Vector<S, T>; NODES],
    /// The residuals from 1, and then the corrections.
    residuals: [Vector<S, T>; NODES],
    /// In which the iteration judges coordinates, and work space.
    weights: [Vector<S, T>; 2],
    work: Work<S, T>,
}

/// The points q0, (q̃0 + q̃1)/2 and q1, at which second derivatives are taken. The equations are as many as
/// unknown vectors, one less.
const NODES: usize = 3;

#[derive(Debug)]
struct Work<S: System, T: Real> {
    /// (q̃0 + q̃1)/2, q̃1 − q̃0 over h, and q1.
    middle: Vector<S, T>,
    velocity: Vector<S, T>,
    end: Vector<S, T>,
    gradient: Vector<S, T>,
    one_form: Vector<S, T>,
    /// λ/h.
    slope: Vector<S, T>,
    rest: Vector<S, T>,
}

impl<S: System, T: Real> Memory<T> for ProjectedMemory<S, T> {
    lasting!(T; part point);
}

impl<S: System, T: Real> Carries<S, T> for Projected {
    type Memory = ProjectedMemory<S, T>;
}

impl<S: DegenerateLagrangian<T>, T: Real> Method<S, T> for Projected {
    type Suited<X> = S::Suited<X>;

    fn begin(
        &self,
        system: &S,
        q: &Vector<S, T>,
        _v: &[T],
        t: T,
        _h: T,
    ) -> Result<Self::Memory, StartError> {
        self.stopping.validate()?;
        if !S::AFFINE {
            spinors::refuse::<S>("`Projected` where α is not affine")?;
        }
        let space = system.space();
        let [middle, velocity, end, gradient, one_form, slope, rest] = space.vectors();
        Ok(ProjectedMemory {
            point: OnePoint::new(system, q, t, |rates| [rates])?,
            solver: coupled_by_second_derivatives(system, [q, &rest], t, NODES - 1, Storing::Always),
            unknowns: space.vectors(),
            residuals: space.vectors(),
            weights: space.vectors(),
            work: Work { middle, velocity, end, gradient, one_form, slope, rest },
        })
    }

    fn step(&self, step: methods::Step<'_, S, T>, memory: &mut Self::Memory) -> Result<(), StepFailure> {
        let methods::Step { system, q, t, h, statistics } = step;
        let [a, b] = self.factors.map(T::lift);
        let ProjectedMemory { point, solver, unknowns, residuals, weights, work } = memory;
        from_either_guess(|guess| {
            let OnePoint { p, rates, orientation } = &mut *point;
            // λ is smaller than the error of Δ.
            let [_, delta, lambda] = &mut *unknowns;
            rates.guess(h, guess, [&mut *delta]);
            delta.iter_mut().for_each(|delta| *delta *= h);
            lambda.fill(T::lift(0.0));
            let mut step = Step { system, q, p, t, h, a, b, unknowns, work, node: 0 };
            solve_coupled(&mut step, (system, q), solver, (residuals, weights), self.stopping, statistics)?;
            step.place();
            let [centre, after] = step.times();
            let Work { middle, end, one_form, .. } = &mut *work;
            norm::finite(end)?;
            system.one_form(end, after, one_form);
            // Between two branches Ω changes its sign.
            orientation.pass(system, &[(middle, centre)], (end, after))
        })?;
        let [_, delta, _] = unknowns;
        delta.iter_mut().for_each(|delta| *delta /= h);
        point.arrive(q, (&work.end, &work.one_form), h, [delta]);
        Ok(())
    }
}

impl<S: DegenerateLagrangian<T>, T: Real> VariableStep<S, T> for Projected {
    type SuitedToAnyStep<X> = <Self as Method<S, T>>::Suited<X>;
}

/// The equations of a step from `q` at `t`:
///
/// r₁ = α(q0) + a Dα(q0)ᵀλ − α(q̃) + ½h ∂L/∂q(q̃, ṽ)      r₂ = α(q̃) + ½h ∂L/∂q(q̃, ṽ) − α(q1) − b Dα(q1)ᵀλ
struct Step<'a, S: System, T: Real> {
    system: &'a S,
    q: &'a [T],
    /// α(q0)
    p: &'a [T],
    t: T,
    h: T,
    a: T,
    b: T,
    unknowns: &'a mut [Vector<S, T>; NODES],
    work: &'a mut Work<S, T>,
    /// Where second derivatives are taken.
    node: usize,
}

impl<S: DegenerateLagrangian<T>, T: Real> Step<'_, S, T> {
    /// (q̃0 + q̃1)/2 = q0 + Δ/2 + (a + b)λ/2 and q̃1 − q̃0 = Δ + (b − a)λ, as the factors of λ.
    fn lambda(&self) -> [T; 2] {
        [T::lift(0.5) * (self.a + self.b), self.b - self.a]
    }

    /// Sets the points and velocities.
    fn place(&mut self) {
        let [in_middle, in_velocity] = self.lambda();
        let Self { q, h, unknowns: [_, delta, lambda], work, .. } = self;
        for i in 0..q.len() {
            work.middle[i] = q[i] + T::lift(0.5) * delta[i] + in_middle * lambda[i];
            work.velocity[i] = (delta[i] + in_velocity * lambda[i]) / *h;
            work.end[i] = q[i] + delta[i];
            work.slope[i] = lambda[i] / *h;
        }
    }

    /// The time in the middle and at the end.
    fn times(&self) -> [T; 2] {
        [self.t + T::lift(0.5) * self.h, self.t + self.h]
    }
}

impl<S: DegenerateLagrangian<T>, T: Real> CoupledEquations<NODES, S, T> for Step<'_, S, T> {
    fn unknowns(&mut self) -> &mut [Vector<S, T>; NODES] {
        self.unknowns
    }

    fn evaluate(
        &mut self,
        [_, r1, r2]: &mut [Vector<S, T>; NODES],
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        self.place();
        let [centre, after] = self.times();
        let Self { system, q, p, t, h, a, b, unknowns: [_, _, lambda], work, .. } = self;
        let Work { middle, velocity, end, gradient, one_form, .. } = &mut **work;
        let (zero, half) = (T::lift(0.0), T::lift(0.5) * *h);
        system.gradient(middle, velocity, centre, gradient, one_form);
        for i in 0..q.len() {
            r1[i] = p[i] - one_form[i] + half * gradient[i];
            r2[i] = one_form[i] + half * gradient[i];
        }
        for (row, factor, point, time) in [(&mut *r1, *a, *q, *t), (&mut *r2, -*b, &**end, after)] {
            // Dα(q)ᵀλ
            let mut product = |i: usize, j: usize, entry: T| row[i] += entry * lambda[j];
            system.one_form_jacobian(point, time, zero, factor, &mut product);
        }
        system.one_form(end, after, one_form);
        for (r2, &form) in r2.iter_mut().zip(one_form.iter()) {
            *r2 -= form;
        }
        statistics.gradients += 1;
        Ok(())
    }
}

/// The derivatives of r₁ and r₂ by Δ and λ. L_qq of node 2, at q1, stands for the second derivative of α·λ.
impl<S: DegenerateLagrangian<T>, T: Real> NodeSum<NODES, T> for Step<'_, S, T> {
    const FIRST: usize = 1;

    fn place(&mut self, j: usize) {
        self.node = j;
    }

    fn given(&self, i: usize) -> T {
        self.p[i]
    }

    fn weights(&self, r: usize, k: usize) -> Weights<T> {
        let Self { h, a, b, .. } = *self;
        let [in_middle, in_velocity] = self.lambda();
        let (zero, one, half) = (T::lift(0.0), T::lift(1.0), T::lift(0.5));
        let none = Weights { qq: zero, qv: zero, vq: zero, vv: zero };
        match (self.node, r, k) {
            (0, 1, 2) => Weights { qv: a, ..none },
            (1, r, k) => {
                // What the unknown does to q̃ and to hṽ; α(q̃) stands in r₁ and r₂ with opposite signs.
                let [point, motion] = if k == 1 { [half, one] } else { [in_middle, in_velocity] };
                let sign = if r == 1 { -one } else { one };
                Weights { qq: half * h * point, qv: half * motion, vq: sign * point, vv: zero }
            }
            (2, 2, 1) => Weights { qq: -b, vq: -one, ..none },
            (2, 2, 2) => Weights { qv: -b, ..none },
            _ => none,
        }
    }

    fn second_derivatives(&mut self, qq: &mut impl Sink<T>, qv: &mut impl Sink<T>, _vv: &mut impl Sink<T>) {
        let [centre, after] = self.times();
        let Self { system, q, t, h, work, .. } = self;
        let Work { middle, velocity, end, gradient, one_form, slope, rest } = &mut **work;
        let (zero, one) = (T::lift(0.0), T::lift(1.0));
        let none = Weights { qq: zero, qv: zero, vq: zero, vv: zero };
        let (point, time): (&[T], T) = [(*q, *t), (&**middle, centre), (&**end, after)][self.node];
        system.linearize(point, rest, time, Weights { qv: one, ..none }, gradient, one_form, qv);
        match self.node {
            1 => {
                system.linearize(point, velocity, time, Weights { qq: one, ..none }, gradient, one_form, qq);
            }
            2 => {
                // h L_qq at (q, λ/h) without that at (q, 0), which is of H.
                let w = Weights { qq: *h, ..none };
                system.linearize(point, slope, time, w, gradient, one_form, qq);
                let w = Weights { qq: -*h, ..none };
                system.linearize(point, rest, time, w, gradient, one_form, qq);
            }
            _ => {}
        }
    }
}
