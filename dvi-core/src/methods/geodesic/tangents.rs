//! Equations with an unknown for each tangent vector: how they are solved, those for the velocity of a
//! momentum, and the orientation of their matrix.

use core::mem;

use nalgebra::Vector3;

use super::covectors::{subtract_momentum, velocity};
use super::node::Node;
use super::variation::visit_coupled;
use crate::error::StepFailure;
use crate::mechanics::manifold::sphere::GreatCircle;
use crate::mechanics::manifold::{Block, blocks, set, vector};
use crate::mechanics::orientation::keep;
use crate::memory::lasting;
use crate::scalar::norm;
use crate::solve::{Due, Stopping, newton, sizes};
use crate::space::inertia::{Inertia, inertia};
use crate::space::linear::{power_below, relative, scale, set_scales};
use crate::space::{Sink, SquareMatrix};
use crate::state::Statistics;
use crate::system::{Factor, ManifoldSystem};
use crate::{ManifoldLagrangian, Real, Scalar, Space};

/// A number for each tangent vector.
type Tangent<S, T> = <<S as ManifoldSystem>::Tangent as Space>::Vector<T>;

/// Work space for linearised equations.
#[derive(Debug)]
pub(super) struct Tangents<S: ManifoldSystem, T: Real> {
    pub(super) node: Node<S, T>,
    pub(super) residual: Tangent<S, T>,
    pub(super) matrix: <S::Tangent as Space>::Square<T>,
    /// In which an iteration judges tangent vectors, and what rows are multiplied by, which have units too.
    weights: Tangent<S, T>,
    scales: Tangent<S, T>,
}

/// Equations for a displacement or a velocity, with a place for each coordinate.
pub(super) trait Equations<S: ManifoldSystem, T: Real> {
    /// The size of a block, in which its corrections are judged.
    fn size(&self, block: Block, unknown: &[T]) -> T;

    /// What is solved for: a momentum.
    fn given(&self) -> &[T];

    /// Sets the residual, and adds the entries of its derivative.
    fn linearize<K: Sink<T>>(
        &self,
        unknown: &[T],
        node: &mut Node<S, T>,
        residual: &mut [T],
        entries: &mut K,
        statistics: &mut Statistics,
    );

    /// A unit vector's `unknown` without a correction along its great circle and across.
    fn corrected(&self, block: Block, unknown: Vector3<T>, correction: [T; 2]) -> Vector3<T>;
}

/// Whether coordinates may have units of different size: those of one name have one.
#[inline]
fn has_units<S: ManifoldLagrangian<T>, T: Real>() -> bool {
    S::REPORT.coordinates.len() > 1
}

impl<S: ManifoldLagrangian<T>, T: Real> Tangents<S, T> {
    /// With room for the second derivatives of L. Where they stand does not depend on the point, but the
    /// formulas are defined at (`q`, `v`, `t`).
    pub(super) fn new(system: &S, at: [&[T]; 2], t: T) -> Self {
        let node = Node::new(system);
        let matrix = system.tangent().square(|visit| visit_coupled(system, &node.slots, at, t, visit));
        let [residual, weights, scales] = system.tangent().vectors();
        Self { node, residual, matrix, weights, scales }
    }

    /// Sets the residual and the matrix to those of `equations`.
    #[inline]
    pub(super) fn linearize(
        &mut self,
        equations: &impl Equations<S, T>,
        unknown: &[T],
        statistics: &mut Statistics,
    ) {
        let Self { node, residual, matrix, .. } = self;
        equations.linearize(unknown, node, residual, matrix.cleared(), statistics);
    }

    /// The largest residual, relative to what it is made of.
    ///
    /// # Errors
    /// [`StepFailure::NotFinite`].
    #[cold]
    fn relative_residual(
        &mut self,
        equations: &impl Equations<S, T>,
        system: &S,
        unknown: &[T],
    ) -> Result<T, StepFailure> {
        let Self { node, residual, weights, scales: sums, .. } = self;
        for block in blocks(system) {
            let given = |largest, place: usize| norm::larger(largest, Scalar::abs(equations.given()[place]));
            sums[block.slots()].fill(block.places().fold(T::lift(0.0), given));
        }
        let mut sink: &mut dyn FnMut(usize, usize, T) =
            &mut |row, column, entry| sums[row] += Scalar::abs(entry / weights[column]);
        equations.linearize(unknown, node, residual, &mut sink, &mut Statistics::default());
        relative(residual, sums)
    }

    /// Improves the unknown by Newton's method.
    ///
    /// # Errors
    /// [`StepFailure::NotConverged`], [`StepFailure::Singular`], [`StepFailure::NotFinite`].
    #[inline]
    pub(super) fn solve(
        &mut self,
        equations: &impl Equations<S, T>,
        system: &S,
        unknown: &mut [T],
        stopping: Stopping,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        newton(stopping, statistics, &mut |due, statistics| {
            match mem::replace(due, Due::Nothing) {
                Due::Sizes => {
                    for block in blocks(system) {
                        self.weights[block.slots()].fill(sizes::weight_of(equations.size(block, unknown)));
                    }
                    if has_units::<S, T>() {
                        set_scales(&mut self.scales, &self.weights);
                        self.scales.iter_mut().for_each(|scale| *scale = power_below(*scale));
                    }
                }
                Due::Residual => return self.relative_residual(equations, system, unknown),
                Due::Nothing | Due::Shake | Due::Response => {}
            }
            self.linearize(equations, unknown, statistics);
            statistics.factorisations += 1;
            if has_units::<S, T>() {
                self.matrix.scale_rows(&self.scales);
                scale(&mut self.residual, &self.scales);
                self.matrix.factor_in_any_units()?;
            } else {
                self.matrix.factor()?;
            }
            self.matrix.solve(&mut self.residual);
            for block in blocks(system) {
                let change = &self.residual[block.slots()];
                if block.factor == Factor::Sphere {
                    let corrected =
                        equations.corrected(block, vector(unknown, block), [change[0], change[1]]);
                    set(unknown, block, corrected);
                } else {
                    block.places().zip(change).for_each(|(place, &change)| unknown[place] -= change);
                }
            }
            norm::finite(unknown)?;
            Ok(sizes::largest(&self.weights, &self.residual))
        })
    }
}

/// ∂L/∂v = p for the velocity at a point, as covectors of the manifold.
pub(super) struct Legendre<'a, S, T> {
    pub(super) system: &'a S,
    pub(super) q: &'a [T],
    pub(super) p: &'a [T],
    pub(super) t: T,
}

impl<S: ManifoldLagrangian<T>, T: Real> Legendre<'_, S, T> {
    /// Improves `v`, which begins as rates of displacement, until ∂L/∂v = p.
    pub(super) fn solve(&self, v: &mut [T]) -> Result<(), StepFailure> {
        velocity(self.system, self.q, v);
        let mut tangents = Tangents::new(self.system, [self.q, v], self.t);
        tangents.solve(self, self.system, v, Stopping::default(), &mut Statistics::default())
    }
}

impl<S: ManifoldLagrangian<T>, T: Real> Equations<S, T> for Legendre<'_, S, T> {
    fn size(&self, block: Block, v: &[T]) -> T {
        block.places().fold(T::lift(0.0), |largest, place| norm::larger(largest, Scalar::abs(v[place])))
    }

    fn given(&self) -> &[T] {
        self.p
    }

    fn linearize<K: Sink<T>>(
        &self,
        v: &[T],
        node: &mut Node<S, T>,
        residual: &mut [T],
        entries: &mut K,
        _statistics: &mut Statistics,
    ) {
        let Self { system, q, p, t } = *self;
        node.add_mass(system, [q, v], t, entries);
        residual.fill(T::lift(0.0));
        for block in blocks(system) {
            subtract_momentum(block, p, residual, || at_rest(block, q));
        }
        node.project_momentum(system, T::lift(1.0), residual);
    }

    fn corrected(&self, block: Block, v: Vector3<T>, [along, across]: [T; 2]) -> Vector3<T> {
        let circle = at_rest(block, self.q);
        v - circle.direction * along - circle.axis * across
    }
}

/// The directions at a unit vector that stays where it is.
fn at_rest<T: Real>(block: Block, q: &[T]) -> GreatCircle<T> {
    GreatCircle::new(vector(q, block), Vector3::zeros())
}

/// Whether the mass matrix of the tangent vectors keeps its orientation from step to step, as in
/// [`MassOrientation`](crate::mechanics::orientation::MassOrientation): that at the end of the last step, and
/// storage.
#[derive(Debug)]
pub(super) struct TangentMass<S: ManifoldSystem, T: Real> {
    inertia: Inertia<T>,
    matrix: <S::Tangent as Space>::Matrix<T>,
    removed: Tangent<S, T>,
}

impl<S: ManifoldLagrangian<T>, T: Real> TangentMass<S, T> {
    /// At (`q`, `v`, `t`).
    ///
    /// # Errors
    /// [`StepFailure::Singular`].
    pub(super) fn new(system: &S, node: &mut Node<S, T>, at: [&[T]; 2], t: T) -> Result<Self, StepFailure> {
        let (mut matrix, mut removed) = (system.tangent().matrix(), system.tangent().vector());
        node.add_mass(system, at, t, &mut matrix);
        Ok(Self { inertia: inertia(&mut matrix, &mut removed)?, matrix, removed })
    }

    /// Compares the matrix at the end of a step with the last, and keeps it.
    ///
    /// # Errors
    /// [`StepFailure::Singular`] and [`StepFailure::Orientation`]; the last is kept then.
    pub(super) fn check(
        &mut self,
        system: &S,
        node: &mut Node<S, T>,
        at: [&[T]; 2],
        t: T,
    ) -> Result<(), StepFailure> {
        let Self { inertia: last, matrix, removed } = self;
        matrix.fill(T::lift(0.0));
        node.add_mass(system, at, t, matrix);
        keep(last, inertia(matrix, removed)?)
    }
}

lasting!([S: ManifoldSystem, T: Real] TangentMass<S, T>, T; part inertia);
