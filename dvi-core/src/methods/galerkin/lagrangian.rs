//! The discrete Lagrangian, stationary in the displacements: its derivatives, and the second ones by
//! eliminating these.
//!
//! With the directions q0 (b, B), q1 (b̄, B̄) and δ of each interior node, and H the second derivatives of
//! h Σⱼ wⱼ L(qʲ, q̇ʲ) along them, ∂L_d/∂δ = 0 gives
//!
//! DᵢL_d = ∂ᵢ(h Σ w L)      DᵢDₖL_d = Hᵢₖ − Hᵢδ Hδδ⁻¹ Hδₖ
//!
//! which are the blocks of q0 and q1 that are left once those of the displacements have been
//! [eliminated](crate::space::linear::blocks).

use super::Galerkin;
use super::coefficients::Coefficients;
use crate::discrete::frequency::{FrequencyIn, GivenFrequency};
use crate::discrete::{DiscreteLagrangian, Ends, Interval, NodeWork, Rule, Span, TwiceDifferentiable};
use crate::error::{StartError, StepFailure};
use crate::mechanics::pattern::linear_of_all;
use crate::memory::Aside;
use crate::methods::collocation::lobatto::Lobatto;
use crate::methods::{InnerScheme, VariationalMethod, without_effect_inside};
use crate::scalar::norm;
use crate::solve::{Convergence, Due, Stopping, iterate, sizes};
use crate::space::linear::{self, blocks};
use crate::space::lines;
use crate::space::sink::{Sink, Transposed};
use crate::state::Statistics;
use crate::{Linear, Matrix, Permutation, Real, RegularLagrangian, Scalar, Space, System, Vector, Weights};

/// The discrete Lagrangian with interior displacements, and the storage that it needs.
#[derive(Debug)]
pub struct GalerkinLagrangian<const NODES: usize, S: System, F, T: Real = f64> {
    method: Galerkin<NODES, F>,
    rule: Lobatto<NODES>,
    differentiation: [[f64; NODES]; NODES],
    storage: Storage<NODES, S, T>,
}

/// The interior displacements, then two entries that are not used; derivatives along these, q0 and q1; and
/// the blocks of second derivatives, transposed.
#[derive(Debug)]
struct Storage<const NODES: usize, S: System, T: Real> {
    displacements: [Vector<S, T>; NODES],
    residuals: [Vector<S, T>; NODES],
    /// In which iterations judge coordinates.
    weights: Vector<S, T>,
    blocks: Aside<[[Matrix<S, T>; NODES]; NODES]>,
    permutation: Permutation<S>,
    node: NodeWork<S, T>,
}

/// One interval, with the coefficients for it.
struct Path<'a, const NODES: usize, S, T> {
    system: &'a S,
    interval: Interval<T>,
    ends: Ends<'a, T>,
    rule: &'a Lobatto<NODES>,
    coefficients: Coefficients<NODES, T>,
}

impl<const NODES: usize, S: RegularLagrangian<T>, T: Real> Path<'_, NODES, S, T> {
    /// How many displacements there are, and the numbers of the directions q0 and q1.
    const INTERIOR: usize = NODES - 2;
    const LEFT: usize = NODES - 2;
    const RIGHT: usize = NODES - 1;

    /// φ̂ and ψ̂ at node `j` of a direction.
    fn along(&self, j: usize, direction: usize) -> [T; 2] {
        if direction == Self::LEFT {
            self.coefficients.direction(j, NODES - 1)
        } else {
            let column = if direction == Self::RIGHT { NODES - 1 } else { direction + 1 };
            [self.coefficients.point[j][column], self.coefficients.velocity[j][column]]
        }
    }

    fn time(&self, j: usize) -> T {
        self.interval.time(T::lift(self.rule.nodes()[j]))
    }

    /// Sets `point` to qʲ and `velocity` to q̇ʲ of node `j`.
    fn place(&self, j: usize, displacements: &[Vector<S, T>; NODES], node: &mut NodeWork<S, T>) {
        let Coefficients { point: phi, velocity: psi, .. } = &self.coefficients;
        let (Ends { q0, delta }, per_h) = (self.ends, T::lift(1.0) / self.interval.h);
        for i in 0..q0.len() {
            let [mut point, mut velocity] =
                [phi, psi].map(|factor| factor[j][0] * q0[i] + factor[j][NODES - 1] * delta[i]);
            for (k, displacement) in displacements.iter().enumerate().take(Self::INTERIOR) {
                point += phi[j][k + 1] * displacement[i];
                velocity += psi[j][k + 1] * displacement[i];
            }
            node.point[i] = point;
            node.velocity[i] = per_h * velocity;
        }
    }

    /// Sets the derivatives along all directions.
    fn differentiate(&self, storage: &mut Storage<NODES, S, T>, statistics: &mut Statistics) {
        let Storage { displacements, residuals, node, .. } = storage;
        for residual in residuals.iter_mut() {
            residual.fill(T::lift(0.0));
        }
        for j in 0..NODES {
            self.place(j, displacements, node);
            let NodeWork { point, velocity, gradient, momentum } = &mut *node;
            self.system.gradient(point, velocity, self.time(j), gradient, momentum);
            statistics.gradients += 1;
            for (direction, residual) in residuals.iter_mut().enumerate() {
                let [phi, psi] =
                    self.along(j, direction).map(|factor| self.coefficients.weights[j] * factor);
                for i in 0..residual.len() {
                    residual[i] += self.interval.h * phi * gradient[i] + psi * momentum[i];
                }
            }
        }
    }

    /// Sets the blocks of second derivatives.
    fn linearize(&self, Storage { displacements, blocks, node, .. }: &mut Storage<NODES, S, T>) {
        let h = self.interval.h;
        blocks.iter_mut().flatten().for_each(|block| block.fill(T::lift(0.0)));
        for j in 0..NODES {
            self.place(j, displacements, node);
            let NodeWork { point, velocity, gradient, momentum } = &mut *node;
            for (r, row) in blocks.iter_mut().enumerate() {
                let [phi, psi] = self.along(j, r).map(|factor| self.coefficients.weights[j] * factor);
                for (k, block) in row.iter_mut().enumerate() {
                    let [point_slope, velocity_slope] = self.along(j, k);
                    let weights = Weights {
                        qq: h * phi * point_slope,
                        qv: phi * velocity_slope,
                        vq: psi * point_slope,
                        vv: psi * velocity_slope / h,
                    };
                    let (t, mut transposed) = (self.time(j), Transposed(block));
                    self.system.linearize(point, velocity, t, weights, gradient, momentum, &mut transposed);
                }
            }
        }
    }

    /// Sets the displacements to those at which L_d is stationary.
    fn settle(
        &self,
        storage: &mut Storage<NODES, S, T>,
        stopping: Stopping,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        for displacement in &mut storage.displacements {
            displacement.fill(T::lift(0.0));
        }
        let q0 = self.ends.q0;
        let convergence = Convergence::new(stopping, stopping.max_iterations);
        iterate(convergence, statistics, |due, statistics| {
            let Storage { weights, displacements, .. } = &mut *storage;
            due.prepare_all(self.system, weights, q0, &mut displacements[..Self::INTERIOR]);
            self.differentiate(storage, statistics);
            self.linearize(storage);
            statistics.linearizations += 1;
            statistics.factorisations += 1;
            if *due == Due::Residual {
                return Self::residual(storage, q0);
            }
            let Storage { displacements, residuals, weights, blocks, permutation, node } = &mut *storage;
            residuals.iter().try_for_each(|residual| norm::finite(residual))?;
            let units = (&weights[..], &mut node.point[..]);
            blocks::eliminate(blocks, permutation, units, residuals, 0..Self::INTERIOR)?;
            let mut correction = T::lift(0.0);
            for (displacement, change) in displacements.iter_mut().zip(residuals.iter()).take(Self::INTERIOR)
            {
                correction =
                    norm::larger(correction, sizes::reduce(self.system, weights, displacement, change));
            }
            Ok(correction)
        })
    }

    /// The residuals of the displacements, relative in each row to Σ |A| times the sizes of what it is
    /// multiplied by (Oettli & Prager 1964).
    #[cold]
    fn residual(storage: &Storage<NODES, S, T>, q0: &[T]) -> Result<T, StepFailure> {
        let Storage { displacements, residuals, blocks, .. } = storage;
        let mut largest = T::lift(0.0);
        for (row, residual) in blocks.iter().zip(residuals).take(Self::INTERIOR) {
            let of = |i: usize| {
                let mut sum = T::lift(0.0);
                for (block, displacement) in row.iter().zip(displacements).take(Self::INTERIOR) {
                    for ((column, &q), &x) in lines(block, q0.len()).zip(q0).zip(displacement.iter()) {
                        sum += Scalar::abs(column[i]) * (Scalar::abs(q) + Scalar::abs(x));
                    }
                }
                sum
            };
            let rows = residual.iter().enumerate().map(|(i, &residual)| (residual, of(i)));
            largest = norm::larger(largest, linear::relative(rows)?);
        }
        Ok(largest)
    }

    /// Leaves the second derivatives of L_d in the blocks of q0 and q1.
    fn complement(&self, storage: &mut Storage<NODES, S, T>) -> Result<(), StepFailure> {
        self.linearize(storage);
        let Storage { residuals, weights, blocks, permutation, node, .. } = storage;
        // Not asked for.
        residuals.iter_mut().for_each(|residual| residual.fill(T::lift(0.0)));
        let units = (&weights[..], &mut node.point[..]);
        blocks::eliminate(blocks, permutation, units, residuals, 0..Self::INTERIOR)
    }
}

/// A path that is stationary in the displacements.
type Settled<'a, const NODES: usize, S, T> = (Path<'a, NODES, S, T>, &'a mut Storage<NODES, S, T>);

/// Adds a block that is stored transposed.
fn add_block<T: Real, K: Sink<T>>(transposed: &[T], n: usize, sink: &mut K) {
    for (column, entries) in lines(transposed, n).enumerate() {
        for (row, &entry) in entries.iter().enumerate() {
            sink.add(row, column, entry);
        }
    }
}

impl<const NODES: usize, S: RegularLagrangian<T>, F: FrequencyIn<T>, T: Real>
    GalerkinLagrangian<NODES, S, F, T>
{
    fn settled<'a>(
        &'a mut self,
        system: &'a S,
        interval: Interval<T>,
        ends: Ends<'a, T>,
        statistics: &mut Statistics,
    ) -> Result<Settled<'a, NODES, S, T>, StepFailure> {
        let Self { method, rule, differentiation, storage } = self;
        let u = method.frequency.fixed() * interval.h;
        let coefficients = Coefficients::new(rule, differentiation, u)?;
        let path = Path { system, interval, ends, rule, coefficients };
        path.settle(storage, method.stopping, statistics)?;
        Ok((path, storage))
    }
}

impl<const NODES: usize, S: RegularLagrangian<T>, F: FrequencyIn<T>, T: Real> DiscreteLagrangian<S, T>
    for GalerkinLagrangian<NODES, S, F, T>
{
    /// The displacements couple what the nodes do not.
    fn solver(&self, system: &S, _q: &[T], _v: &[T], _t: T) -> Linear<S, T> {
        linear_of_all(system)
    }

    fn derivatives(
        &mut self,
        Span { system, interval, ends }: Span<'_, S, T>,
        d1: &mut [T],
        sum: &mut [T],
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let (path, storage) = self.settled(system, interval, ends, statistics)?;
        path.differentiate(storage, statistics);
        let [left, right] = [NODES - 2, NODES - 1].map(|direction| &storage.residuals[direction]);
        for i in 0..d1.len() {
            d1[i] += left[i];
            sum[i] += left[i] + right[i];
        }
        Ok(())
    }

    fn linearize<K: Sink<T>>(
        &mut self,
        Span { system, interval, ends }: Span<'_, S, T>,
        d1: &mut [T],
        sink: &mut K,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let (path, storage) = self.settled(system, interval, ends, statistics)?;
        path.differentiate(storage, statistics);
        for (d1, &left) in d1.iter_mut().zip(storage.residuals[NODES - 2].iter()) {
            *d1 += left;
        }
        path.complement(storage)?;
        add_block(&storage.blocks[NODES - 2][NODES - 1], d1.len(), sink);
        Ok(())
    }
}

impl<const NODES: usize, S: RegularLagrangian<T>, F: FrequencyIn<T>, T: Real> TwiceDifferentiable<S, T>
    for GalerkinLagrangian<NODES, S, F, T>
{
    fn hessian<K: Sink<T>>(
        &mut self,
        Span { system, interval, ends }: Span<'_, S, T>,
        [d11, d12, d21, d22]: [&mut K; 4],
    ) -> Result<(), StepFailure> {
        let n = ends.q0.len();
        let (path, storage) = self.settled(system, interval, ends, &mut Statistics::default())?;
        path.complement(storage)?;
        let [left, right] = [NODES - 2, NODES - 1];
        for (row, column, sink) in
            [(left, left, d11), (left, right, d12), (right, left, d21), (right, right, d22)]
        {
            add_block(&storage.blocks[row][column], n, sink);
        }
        Ok(())
    }
}

impl<const NODES: usize, S, F, T> VariationalMethod<S, T> for Galerkin<NODES, F>
where
    S: RegularLagrangian<T>,
    F: FrequencyIn<T> + GivenFrequency + Clone,
    T: Real,
{
    type DiscreteLagrangian = GalerkinLagrangian<NODES, S, F, T>;

    fn admit(&self, system: &S) -> Result<(), StartError> {
        self.validate::<S, T>(system)
    }

    fn discrete_lagrangian(&self, system: &S) -> GalerkinLagrangian<NODES, S, F, T> {
        let (space, rule) = (system.space(), Lobatto::new());
        let blocks: [[_; NODES]; NODES] = core::array::from_fn(|_| core::array::from_fn(|_| space.matrix()));
        let storage = Storage {
            displacements: space.vectors(),
            residuals: space.vectors(),
            weights: space.vector(),
            blocks: blocks.into(),
            permutation: space.permutation(),
            node: NodeWork::new(system),
        };
        GalerkinLagrangian { method: self.clone(), differentiation: rule.differentiation(), rule, storage }
    }
}

impl<const NODES: usize, S, F, T> InnerScheme<S, T> for Galerkin<NODES, F>
where
    S: RegularLagrangian<T>,
    F: FrequencyIn<T> + GivenFrequency + Clone,
    T: Real,
{
    fn admit_inside(&self) -> Result<(), StartError> {
        // By `stopping` the interior displacements are found.
        without_effect_inside(self.solver, Stopping::default(), self.summation)
    }
}
