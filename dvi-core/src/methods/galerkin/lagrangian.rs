//! The discrete Lagrangian, stationary in the displacements: its second derivatives, by eliminating these.
//!
//! With the matrix H of the [equations](super::displaced) of a path, ∂L_d/∂δ = 0 gives
//!
//! (D₁ + D₂)L_d = r₀      D₁L_d = r_{s−1}      H* = H − H_δ H_δδ⁻¹ H^δ
//!
//! where H* is what is left of H, in columns by q0 at the same Δ, D₁ + D₂, and by Δ, D₂, once the
//! displacements have been [eliminated](crate::space::linear::blocks).

use super::Galerkin;
use super::coefficients::Fit;
use super::displaced::Displaced;
use crate::discrete::frequency::{FrequencyIn, GivenFrequency};
use crate::discrete::{NodeWork, Span, TwiceDifferentiable};
use crate::error::{StartError, StepFailure};
use crate::methods::VariationalMethod;
use crate::scalar::norm;
use crate::solve::{Due, newton, sizes};
use crate::space::Sink;
use crate::space::linear::{Blocks, assemble, blocks, residual_of_nodes};
use crate::space::lines;
use crate::state::Statistics;
use crate::{Real, RegularLagrangian, Space, System, Vector};

/// The discrete Lagrangian with interior displacements, and the storage that it needs.
#[derive(Debug)]
pub struct GalerkinLagrangian<const NODES: usize, S: System, F, T: Real = f64> {
    method: Galerkin<NODES, F>,
    fit: Fit<NODES, T>,
    /// q0, the displacements of the interior nodes, and Δ.
    unknowns: [Vector<S, T>; NODES],
    residuals: [Vector<S, T>; NODES],
    /// In which iterations judge coordinates, work space, and zeros.
    weights: [Vector<S, T>; 3],
    node: NodeWork<S, T>,
    /// In rows and columns of the displacements, of Δ and of q0.
    second: Blocks<NODES, S::Space, T>,
}

/// Solves for the displacements with the right-hand sides `x`, and leaves H* in the last two rows and columns
/// of `second`.
fn eliminate<const NODES: usize, S: RegularLagrangian<T>, F: FrequencyIn<T>, T: Real>(
    second: &mut Blocks<NODES, S::Space, T>,
    path: &mut Displaced<'_, NODES, S, F, T>,
    weights: &[T],
    x: &mut [Vector<S, T>; NODES],
) -> Result<(), StepFailure> {
    let Blocks { rows, second: of_node, permutation } = second;
    let n = permutation.len();
    assemble(path, of_node, rows, n, 0);
    // The row and the column of q0 come first there.
    rows.iter_mut().for_each(|row| row.rotate_left(1));
    rows.rotate_left(1);
    x.rotate_left(1);
    blocks::eliminate(rows, permutation, (weights, &mut of_node[0][..n]), x, 0..NODES - 2)?;
    x.rotate_right(1);
    Ok(())
}

impl<const NODES: usize, S: RegularLagrangian<T>, F: FrequencyIn<T>, T: Real> TwiceDifferentiable<S, T>
    for GalerkinLagrangian<NODES, S, F, T>
{
    fn hessian<K: Sink<T>>(
        &mut self,
        Span { system, interval, ends }: Span<'_, S, T>,
        [d11, d12, d21, d22]: [&mut K; 4],
    ) -> Result<(), StepFailure> {
        let Self { method, fit, unknowns, residuals, weights: [weights, sums, zeros], node, second } = self;
        fit.to(method.frequency.fixed() * interval.h)?;
        unknowns.iter_mut().for_each(|unknown| unknown.fill(T::lift(0.0)));
        unknowns[0].copy_from_slice(ends.q0);
        unknowns[NODES - 1].copy_from_slice(ends.delta);
        let path = &mut Displaced::<_, _, F, _> {
            system,
            interval,
            p0: zeros,
            fitted: None,
            fit,
            unknowns,
            node,
            j: 0,
        };
        newton(method.stopping, &mut Statistics::default(), |due, statistics| {
            due.prepare_all(system, weights, ends.q0, &mut path.unknowns[1..NODES - 1]);
            path.differentiate(residuals, statistics);
            // The ends are given.
            residuals[NODES - 1].fill(T::lift(0.0));
            residuals.iter().try_for_each(|residual| norm::finite(residual))?;
            if *due == Due::Residual {
                return residual_of_nodes(path, weights, residuals, sums);
            }
            eliminate(second, path, weights, residuals)?;
            let corrections = path.unknowns.iter_mut().zip(&*residuals).take(NODES - 1).skip(1);
            Ok(corrections.fold(T::lift(0.0), |largest, (displacement, change)| {
                norm::larger(largest, sizes::reduce(system, weights, displacement, change))
            }))
        })?;
        eliminate(second, path, weights, residuals)?;
        // Of rows D₁L_d and (D₁ + D₂)L_d, in columns by Δ, and by q0 at the same Δ.
        let [left, both] = [NODES - 2, NODES - 1].map(|row| &second.rows[row]);
        let [left_delta, left_both] = [&left[NODES - 2], &left[NODES - 1]];
        let [both_delta, both_both] = [&both[NODES - 2], &both[NODES - 1]];
        add_block(left_delta, 1.0, ends.q0.len(), d12);
        for (sink, terms) in [
            (d11, &[(left_both, 1.0), (left_delta, -1.0)][..]),
            (d22, &[(both_delta, 1.0), (left_delta, -1.0)]),
            (d21, &[(both_both, 1.0), (both_delta, -1.0), (left_both, -1.0), (left_delta, 1.0)]),
        ] {
            terms.iter().for_each(|&(block, sign)| add_block(block, sign, ends.q0.len(), sink));
        }
        Ok(())
    }
}

/// Adds a block that is stored transposed, or subtracts it.
fn add_block<T: Real, K: Sink<T>>(transposed: &[T], factor: f64, n: usize, sink: &mut K) {
    for (column, entries) in lines(transposed, n).enumerate() {
        for (row, &entry) in entries.iter().enumerate() {
            sink.add(row, column, T::lift(factor) * entry);
        }
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
        GalerkinLagrangian {
            method: self.clone(),
            fit: Fit::new(),
            unknowns: space.vectors(),
            residuals: space.vectors(),
            weights: space.vectors(),
            node: NodeWork::new(system),
            second: Blocks::new(space),
        }
    }
}
