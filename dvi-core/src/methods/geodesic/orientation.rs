//! Whether the mass matrix of the tangent vectors keeps its orientation from step to step, as in
//! [`MassOrientation`](crate::mechanics::orientation::MassOrientation).

use super::node::{Between, By, Node};
use crate::discrete::NodeWork;
use crate::error::StepFailure;
use crate::mechanics::orientation::keep;
use crate::memory::{Memory, lasting};
use crate::space::inertia::{Inertia, inertia};
use crate::system::ManifoldSystem;
use crate::{ManifoldLagrangian, Real, Space, Weights};

type Matrix<S, T> = <<S as ManifoldSystem>::Tangent as Space>::Matrix<T>;
type Tangent<S, T> = <<S as ManifoldSystem>::Tangent as Space>::Vector<T>;

/// The mass matrix at the end of the last step, and storage.
#[derive(Debug)]
pub(super) struct TangentMass<S: ManifoldSystem, T: Real> {
    inertia: Inertia<T>,
    matrix: Matrix<S, T>,
    removed: Tangent<S, T>,
}

impl<S: ManifoldLagrangian<T>, T: Real> TangentMass<S, T> {
    /// At (`q`, `v`, `t`).
    ///
    /// # Errors
    /// [`StepFailure::Singular`].
    pub(super) fn new(
        system: &S,
        node: &mut Node<S, T>,
        [q, v]: [&[T]; 2],
        t: T,
    ) -> Result<Self, StepFailure> {
        let (mut matrix, mut removed) = (system.tangent().matrix(), system.tangent().vector());
        let inertia = evaluate::<S, T>(system, node, [q, v], t, &mut matrix, &mut removed)?;
        Ok(Self { inertia, matrix, removed })
    }

    /// Compares the matrix at the end of a step with the last, and keeps it.
    ///
    /// # Errors
    /// [`StepFailure::Singular`] and [`StepFailure::Orientation`]; the last is kept then.
    pub(super) fn check(
        &mut self,
        system: &S,
        node: &mut Node<S, T>,
        [q, v]: [&[T]; 2],
        t: T,
    ) -> Result<(), StepFailure> {
        let Self { inertia, matrix, removed } = self;
        keep(inertia, evaluate::<S, T>(system, node, [q, v], t, matrix, removed)?)
    }
}

fn evaluate<S: ManifoldLagrangian<T>, T: Real>(
    system: &S,
    node: &mut Node<S, T>,
    [q, v]: [&[T]; 2],
    t: T,
    matrix: &mut Matrix<S, T>,
    removed: &mut Tangent<S, T>,
) -> Result<Inertia<T>, StepFailure> {
    node.rest(system, q, v);
    matrix.fill(T::lift(0.0));
    let Node { work: NodeWork { point, velocity, gradient, momentum }, first, tangents, .. } = node;
    let mut between = Between::<S, T, _>::new(first, first, tangents, [By::Velocity; 2], matrix);
    system.linearize(point, velocity, t, Weights::mass(), gradient, momentum, &mut between);
    inertia(matrix, removed)
}

impl<S: ManifoldSystem, T: Real> Memory<T> for TangentMass<S, T> {
    lasting!(T; part inertia);
}
