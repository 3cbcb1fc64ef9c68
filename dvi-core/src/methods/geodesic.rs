//! Variational integrators on manifolds: the discrete Lagrangian is a quadrature rule of L on a geodesic
//! between the two ends. In the moving frame of the body the discrete Euler–Lagrange equations of a rotation
//! are those of Euler and Poincaré (Marsden, Pekarsky & Shkoller 1999).

mod covectors;
mod equations;
mod memory;
mod node;
mod step;
mod tangents;
mod variation;

use crate::discrete::Interval;
use crate::discrete::quadrature::{Midpoint, Quadrature, Rule, Trapezoid};
use crate::error::{StartError, StepFailure};
use crate::mechanics::manifold;
use crate::methods::{Carries, Here, Method, PreservedForm, Step, VariableStep, scheme};
use crate::solve::Stopping;
use crate::space::SquareMatrix;
use crate::state::Statistics;
use crate::system::ManifoldSystem;
use crate::system::start::evaluate;
use crate::{ManifoldLagrangian, Real, Space, Vector};

use covectors::{force, momentum};
use equations::has_spheres;
use memory::{GeodesicMemory, Kicks, inverse_masses, is_positive, mass_at};
use tangents::{Legendre, TangentMass};

/// The variational integrator for coordinates that are rotations, `R: SO3`, or unit vectors, `s: S2`, or
/// arrays of them, beside numbers.
///
/// ```math
/// L_d(q_0, q_1) = h \sum_j w_j\, L(\gamma(c_j), \gamma'(c_j)/h, t + c_j h), \qquad
/// \gamma(c) = \begin{cases} R_0 \exp(c\, \hat u) & \text{in SO(3), with } \omega = u/h \\
/// \text{a great circle} & \text{on S²} \\ x_0 + c\, \Delta & \text{of numbers} \end{cases}
/// ```
///
/// A step solves p0 = −D₁L_d(q0, q1) by Newton's method for the displacement, three numbers of a rotation
/// and two of a unit vector, and moves along it (Marsden, Pekarsky & Shkoller 1999; Lee, Leok & McClamroch
/// 2007, 2009). By the trapezoidal rule it is explicit where L = ½ v·M v − V(q, t), M couples nothing, and a
/// rotation has three equal moments of inertia: of spherical pendulums that hang by themselves, and of
/// rotors with forces between them. A run carries a rotation as a quaternion, with what rounding leaves out
/// of it. Its length says nothing, so that it need not be corrected: the matrix that is made of it is
/// orthogonal to rounding after 10⁷ steps as after one, which the experiment `top` of the gallery measures.
///
/// The steps preserve the canonical form on T*Q and the momenta of rotations of space that leave L as it is.
/// Their order is two for every rule that is exact for linear functions, and one for others; a
/// [`Composition`](crate::methods::Composition) of symmetric steps has a higher one. A step by half a turn
/// or more is an error. A run begins at rotation matrices and unit vectors to 4096 units of rounding, with
/// velocities tangent to them; [`rotations`](crate::rotations) has functions that make some.
///
/// ```
/// use dvi_core::prelude::*;
/// use dvi_core::rotations;
///
/// /// A heavy symmetric top that stands on its tip, with the symmetry axis along the third axis of the body.
/// #[lagrangian(
///     coordinates(R: SO3),
///     lagrangian = (across * (omega(R)[0].powi(2) + omega(R)[1].powi(2)) + along * omega(R)[2].powi(2)) / 2.0
///         - weight * R[2][2],
///     momenta(
///         spin = along * omega(R)[2],
///         vertical = across * (R[2][0] * omega(R)[0] + R[2][1] * omega(R)[1]) + along * R[2][2] * omega(R)[2],
///     ),
/// )]
/// struct Top {
///     across: f64,
///     along: f64,
///     weight: f64,
/// }
///
/// let top = Top { across: 1.0, along: 0.5, weight: 1.0 };
/// let tilted = rotations::exp([0.3, 0.0, 0.0]);
/// let start = TopState { R: tilted, omega_R: [0.0, 0.0, 8.0] };
/// let mut run = Integrator::new(&top, Geodesic::trapezoid(), 0.01, start)?;
/// let [energy, vertical] = [run.energy(), run.momentum(1).unwrap()];
/// run.take_steps(10_000)?;
/// assert!((run.energy() - energy).abs() < 1e-3);
/// assert!((run.momentum(1).unwrap() - vertical).abs() < 1e-11);
/// assert!(rotations::defect(&run.state().R) < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Geodesic<R = Quadrature> {
    /// Nodes and weights.
    pub rule: R,
    /// The criterion by which a step counts as solved. Default: to rounding errors.
    pub stopping: Stopping,
}

impl<R> Geodesic<R> {
    /// Any rule.
    pub fn new(rule: R) -> Self {
        Self { rule, stopping: Stopping::default() }
    }
}

impl Geodesic<Midpoint> {
    /// L_d = h L(γ(½), γ'(½)/h).
    pub fn midpoint() -> Self {
        Self::new(Midpoint)
    }
}

impl Geodesic<Trapezoid> {
    /// L_d = (h/2)[L(q0, γ'(0)/h) + L(q1, γ'(1)/h)].
    pub fn trapezoid() -> Self {
        Self::new(Trapezoid)
    }
}

scheme! {
    [R: Rule] Geodesic<R>, |method|
    order: if method.rule.is_exact_for_linear() { 2 } else { 1 },
    is_symmetric: method.rule.is_symmetric(),
    preserved_form: PreservedForm::Canonical,
}

impl<S: ManifoldSystem, R, T: Real> Carries<S, T> for Geodesic<R> {
    type Memory = GeodesicMemory<S, T>;
}

impl<S: ManifoldLagrangian<T>, R: Rule, T: Real> Method<S, T> for Geodesic<R> {
    type Suited<X> = S::Suited<X>;

    fn begin(&self, system: &S, q: &Vector<S, T>, v: &[T], t: T, _h: T) -> Result<Self::Memory, StartError> {
        Quadrature::new(self.rule.nodes(), self.rule.weights())?;
        self.stopping.validate()?;
        evaluate(system, q, v, t)?;
        manifold::check(system, [q, v])?;
        let [mut seed, mut l_q, mut l_v]: [Vector<S, T>; 3] = system.space().vectors();
        momentum(system, q, v, &mut seed);
        system.gradient(q, v, t, &mut l_q, &mut l_v);
        let mut memory = GeodesicMemory::new(system, [q, v], t, seed);
        momentum(system, q, &l_v, &mut memory.p);
        manifold::lift(system, q, &mut memory.lifted);
        let legendre = Legendre { system, q, p: &memory.p, t };
        let tangents = &mut memory.tangents;
        tangents.linearize(&legendre, v, &mut Statistics::default());
        tangents.matrix.factor_in_any_units().map_err(StartError::Starter)?;
        memory.is_positive = tangents.matrix.is_positive();
        let mass = if S::CONSTANT_MASS { Some(mass_at(system, [q, v], t)) } else { None };
        let is_definite = |mass| !has_spheres::<S, T>() || is_positive(system, mass);
        if !mass.as_ref().is_some_and(is_definite) {
            let orientation = TangentMass::new(system, &mut tangents.node, [q, v], t);
            memory.orientation = Some(orientation.map_err(StartError::Starter)?);
        }
        if S::SEPARABLE && self.rule.interior_nodes() == 0 {
            system.force(q, &[], t, &mut l_q);
            force(system, q, &mut l_q);
            memory.kicks = mass.map(|mass| Kicks { free: inverse_masses(system, &mass), mass, force: l_q });
        }
        Ok(memory)
    }

    #[inline]
    fn step(&self, step: Step<'_, S, T>, memory: &mut Self::Memory) -> Result<(), StepFailure> {
        let Step { system, q, t, h, statistics } = step;
        memory.solve(&self.rule, (system, q), Interval { t, h }, self.stopping, statistics)?;
        memory.keep(q, h);
        Ok(())
    }

    fn velocity(&self, here: Here<'_, S, T>, memory: &Self::Memory, v: &mut [T]) -> Result<(), StepFailure> {
        let Here { system, q, t } = here;
        memory.rates.extrapolate([v]);
        Legendre { system, q, p: &memory.p, t }.solve(v)
    }
}

impl<S: ManifoldLagrangian<T>, R: Rule, T: Real> VariableStep<S, T> for Geodesic<R> {
    type SuitedToAnyStep<X> = <Self as Method<S, T>>::Suited<X>;
}
