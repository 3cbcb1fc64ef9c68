//! The discrete Lagrangian, stationary in the displacements: its derivatives, and the second ones by
//! eliminating these.
//!
//! With the unknowns x of a [step](super::displaced), the δ of the interior nodes among them, and H the
//! matrix of its equations, ∂L_d/∂δ = 0 gives
//!
//! (D₁ + D₂)L_d = r₀      D₁L_d = r_{s−1}      H* = H − H_δ H_δδ⁻¹ H^δ
//!
//! where H* is what is left of H, in columns by q0 at the same Δ, D₁ + D₂, and by Δ, D₂, once the
//! displacements have been [eliminated](crate::space::linear::blocks).

use super::Galerkin;
use super::coefficients::Fit;
use super::displaced::second_derivatives;
use crate::discrete::frequency::{FrequencyIn, GivenFrequency};
use crate::discrete::{DiscreteLagrangian, Ends, Interval, NodeWork, Span, TwiceDifferentiable};
use crate::error::{StartError, StepFailure};
use crate::mechanics::pattern::linear_of_all;
use crate::memory::Aside;
use crate::methods::VariationalMethod;
use crate::scalar::norm;
use crate::solve::{Convergence, Due, Stopping, iterate, sizes};
use crate::space::linear::{self, blocks};
use crate::space::lines;
use crate::space::sink::{Places, Sink, Transposed};
use crate::state::Statistics;
use crate::{Linear, Matrix, Permutation, Real, RegularLagrangian, Scalar, Space, System, Vector, Weights};

/// The discrete Lagrangian with interior displacements, and the storage that it needs.
#[derive(Debug)]
pub struct GalerkinLagrangian<const NODES: usize, S: System, F, T: Real = f64> {
    method: Galerkin<NODES, F>,
    fit: Fit<NODES, T>,
    storage: Storage<NODES, S, T>,
}

/// The unknowns of a step; derivatives along δ of the interior nodes, along both ends, and along q0; and the
/// blocks of second derivatives, in columns by δ, q0 at the same Δ, and Δ, transposed.
#[derive(Debug)]
struct Storage<const NODES: usize, S: System, T: Real> {
    /// q0, the displacements of the interior nodes, and Δ.
    unknowns: [Vector<S, T>; NODES],
    residuals: [Vector<S, T>; NODES],
    /// In which iterations judge coordinates.
    weights: Vector<S, T>,
    blocks: Aside<[[Matrix<S, T>; NODES]; NODES]>,
    /// Second derivatives of L at a node: by q and q, q and v, v and q, v and v.
    second: [Matrix<S, T>; 4],
    /// What a direction makes of them: by q and by v.
    rows: [Matrix<S, T>; 2],
    permutation: Permutation<S>,
    node: NodeWork<S, T>,
}

/// One interval, with the coefficients for it.
struct Path<'a, const NODES: usize, S, T> {
    system: &'a S,
    interval: Interval<T>,
    fit: &'a Fit<NODES, T>,
}

impl<const NODES: usize, S: RegularLagrangian<T>, T: Real> Path<'_, NODES, S, T> {
    /// How many displacements there are, and what stands behind them.
    const INTERIOR: usize = NODES - 2;
    const BOTH: usize = NODES - 2;
    const LAST: usize = NODES - 1;

    /// The unknown of a column, and the direction of a row.
    fn unknown(column: usize) -> usize {
        if column == Self::BOTH {
            0
        } else if column == Self::LAST {
            Self::LAST
        } else {
            column + 1
        }
    }

    /// Sets the derivatives along all directions.
    fn differentiate(&self, storage: &mut Storage<NODES, S, T>, statistics: &mut Statistics) {
        let Storage { unknowns, residuals, node, .. } = storage;
        self.fit.differentiate((self.system, self.interval), unknowns, node, residuals, statistics);
        residuals[..Self::LAST].rotate_left(1);
    }

    /// Sets the blocks of second derivatives.
    fn linearize(&self, storage: &mut Storage<NODES, S, T>) {
        let Storage { unknowns, blocks, second, rows, node, .. } = storage;
        let (zero, one, h) = (T::lift(0.0), T::lift(1.0), self.interval.h);
        let per_h = one / h;
        blocks.iter_mut().flatten().for_each(|block| block.fill(zero));
        for j in 0..NODES {
            self.fit.coefficients.place(j, h, unknowns, [&mut node.point, &mut node.velocity]);
            second.iter_mut().for_each(|derivative| derivative.fill(zero));
            let (t, [qq, qv, vq, vv]) = (self.fit.time(self.interval, j), &mut *second);
            let mut mixed = Places(|row, column, entry| {
                qv.add(column, row, entry);
                if !S::FORCED {
                    vq.add(row, column, entry);
                }
            });
            second_derivatives((self.system, t), node, &mut Transposed(qq), &mut mixed, &mut Transposed(vv));
            if S::FORCED {
                let NodeWork { point, velocity, gradient, momentum } = &mut *node;
                let weights = Weights { qq: zero, qv: zero, vq: one, vv: zero };
                let sink = &mut Transposed(vq);
                self.system.linearize(point, velocity, t, weights, gradient, momentum, sink);
            }
            let ([qq, qv, vq, vv], [by_q, by_v]) = (&*second, &mut *rows);
            for (r, row) in blocks.iter_mut().enumerate() {
                let [phi, psi] = self.fit.coefficients.weighted_direction(j, Self::unknown(r));
                for i in 0..by_q.len() {
                    by_q[i] = h * phi * qq[i] + psi * vq[i];
                    by_v[i] = phi * qv[i] + per_h * psi * vv[i];
                }
                for (k, block) in row.iter_mut().enumerate() {
                    let [phi, psi] = self.fit.coefficients.slopes(j, Self::unknown(k));
                    for i in 0..block.len() {
                        block[i] += phi * by_q[i] + psi * by_v[i];
                    }
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
        let convergence = Convergence::new(stopping, stopping.max_iterations);
        iterate(convergence, statistics, |due, statistics| {
            let Storage { unknowns, weights, .. } = &mut *storage;
            let (q0, rest) = unknowns.split_at_mut(1);
            due.prepare_all(self.system, weights, &q0[0], &mut rest[..Self::INTERIOR]);
            self.differentiate(storage, statistics);
            self.linearize(storage);
            statistics.linearizations += NODES as u64;
            statistics.factorisations += 1;
            if *due == Due::Residual {
                return Self::residual(storage);
            }
            let Storage { unknowns, residuals, weights, blocks, permutation, node, .. } = &mut *storage;
            residuals.iter().try_for_each(|residual| norm::finite(residual))?;
            let units = (&weights[..], &mut node.point[..]);
            blocks::eliminate(blocks, permutation, units, residuals, 0..Self::INTERIOR)?;
            let corrections = unknowns[1..Self::LAST].iter_mut().zip(residuals.iter());
            Ok(corrections.fold(T::lift(0.0), |largest, (displacement, change)| {
                norm::larger(largest, sizes::reduce(self.system, weights, displacement, change))
            }))
        })
    }

    /// The residuals of the displacements, relative in each row to Σ |A| times the sizes of what it is
    /// multiplied by (Oettli & Prager 1964).
    #[cold]
    fn residual(
        Storage { unknowns, residuals, blocks, .. }: &Storage<NODES, S, T>,
    ) -> Result<T, StepFailure> {
        let (q0, displacements) = (&unknowns[0], &unknowns[1..Self::LAST]);
        let mut largest = T::lift(0.0);
        for (row, residual) in blocks.iter().zip(residuals).take(Self::INTERIOR) {
            let of = |i: usize| {
                let mut sum = T::lift(0.0);
                for (block, displacement) in row.iter().zip(displacements) {
                    for ((column, &q), &x) in lines(block, q0.len()).zip(q0.iter()).zip(displacement.iter())
                    {
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

    /// Leaves the second derivatives of L_d in the last two rows and columns of blocks.
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

/// Adds a block that is stored transposed, or subtracts it.
fn add_block<T: Real, K: Sink<T>>(transposed: &[T], factor: f64, n: usize, sink: &mut K) {
    for (column, entries) in lines(transposed, n).enumerate() {
        for (row, &entry) in entries.iter().enumerate() {
            sink.add(row, column, T::lift(factor) * entry);
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
        let Self { method, fit, storage } = self;
        fit.to(method.frequency.fixed() * interval.h)?;
        let path = Path { system, interval, fit };
        storage.unknowns.iter_mut().for_each(|unknown| unknown.fill(T::lift(0.0)));
        storage.unknowns[0].copy_from_slice(ends.q0);
        storage.unknowns[NODES - 1].copy_from_slice(ends.delta);
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
        let [both, left] = [NODES - 2, NODES - 1].map(|direction| &storage.residuals[direction]);
        for i in 0..d1.len() {
            d1[i] += left[i];
            sum[i] += both[i];
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
        for (d1, &left) in d1.iter_mut().zip(storage.residuals[NODES - 1].iter()) {
            *d1 += left;
        }
        path.complement(storage)?;
        add_block(&storage.blocks[NODES - 1][NODES - 1], 1.0, d1.len(), sink);
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
        // Of rows (D₁ + D₂)L_d and D₁L_d, in columns by q0 at the same Δ, and by Δ.
        let [both, last] = [NODES - 2, NODES - 1];
        let [b00, b01, b10, b11] = [(both, both), (both, last), (last, both), (last, last)]
            .map(|(row, column)| &storage.blocks[row][column]);
        add_block(b11, 1.0, n, d12);
        for (sink, terms) in [
            (d11, &[(b10, 1.0), (b11, -1.0)][..]),
            (d22, &[(b01, 1.0), (b11, -1.0)]),
            (d21, &[(b00, 1.0), (b01, -1.0), (b10, -1.0), (b11, 1.0)]),
        ] {
            terms.iter().for_each(|&(block, sign)| add_block(block, sign, n, sink));
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
        let space = system.space();
        let blocks: [[_; NODES]; NODES] = core::array::from_fn(|_| core::array::from_fn(|_| space.matrix()));
        let storage = Storage {
            unknowns: space.vectors(),
            residuals: space.vectors(),
            weights: space.vector(),
            blocks: blocks.into(),
            second: core::array::from_fn(|_| space.matrix()),
            rows: core::array::from_fn(|_| space.matrix()),
            permutation: space.permutation(),
            node: NodeWork::new(system),
        };
        GalerkinLagrangian { method: self.clone(), fit: Fit::new(), storage }
    }
}
