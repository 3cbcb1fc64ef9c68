//! Linear equations for several vectors over a space at once, as those of the interior points of a step.

use core::cell::RefCell;
use core::fmt::Debug;
use core::ops::{Deref, DerefMut};

use super::blocks;
#[cfg(feature = "alloc")]
use super::{LinearEquations, LinearSolver, RunTimeSolver, Storing};
#[cfg(feature = "alloc")]
use crate::RunTime;
use crate::error::StepFailure;
use crate::memory::Aside;
use crate::space::Weights;
#[cfg(feature = "alloc")]
use crate::space::{lines, lines_mut};
use crate::{Real, Scalar, Sink, Space};

/// A matrix of blocks, one row of blocks for each equation r and one column for each unknown vector k: a sum
/// over the nodes of a rule,
///
/// Σⱼ qqⱼᵣₖ L_qq + qvⱼᵣₖ L_qv + vqⱼᵣₖ L_vq + vvⱼᵣₖ L_vv.
pub trait NodeSum<const NODES: usize, T> {
    /// The first unknown vector, and the first equation.
    const FIRST: usize;

    /// Goes to node `j`.
    fn place(&mut self, j: usize);
    /// The weights of the second derivatives at the node in block (`r`, `k`).
    fn weights(&self, r: usize, k: usize) -> Weights<T>;
    /// Adds the second derivatives of L at the node to sinks: L_qq, L_qv and L_vv.
    fn second_derivatives(&mut self, qq: &mut impl Sink<T>, qv: &mut impl Sink<T>, vv: &mut impl Sink<T>);

    /// What is given in row `i` of each equation, beside what the unknowns add.
    fn given(&self, i: usize) -> T;

    /// Whether L_vq is (L_qv)ᵀ: not where forces that depend on velocities stand beside ∂L/∂q.
    const MIXED_ARE_TRANSPOSED: bool = true;
    /// Where [`MIXED_ARE_TRANSPOSED`](Self::MIXED_ARE_TRANSPOSED) does not hold: adds L_vq at the node to a
    /// sink.
    fn momentum_by_position(&mut self, _vq: &mut impl Sink<T>) {}
}

/// What solves for the vectors from [`NodeSum::FIRST`] to `NODES`, with the storage that it needs.
pub trait CoupledSolver<const NODES: usize, T: Real>: Debug {
    /// Overwrites the vectors from the first unknown one with the solution, whose entries have the sizes one
    /// over `weights`.
    ///
    /// # Errors
    /// As [`LinearSolver::solve`](crate::space::LinearSolver::solve).
    fn solve<M: NodeSum<NODES, T>, V: DerefMut<Target = [T]>>(
        &mut self,
        matrix: &mut M,
        weights: &[T],
        vectors: &mut [V; NODES],
    ) -> Result<(), StepFailure>;
}

/// Block by block, where sizes are known when the program is compiled.
#[derive(Debug)]
pub struct Blocks<const NODES: usize, S: Space, T: Scalar> {
    /// Transposed; those before the first unknown vector are not used.
    pub(crate) rows: Aside<[[S::Matrix<T>; NODES]; NODES]>,
    /// L_qq, L_qv, L_vv and, where it is not (L_qv)ᵀ, L_vq at a node.
    pub(crate) second: [S::Matrix<T>; 4],
    pub(crate) permutation: S::Vector<usize>,
}

impl<const NODES: usize, S: Space, T: Scalar> Blocks<NODES, S, T> {
    pub(crate) fn new(space: S) -> Self {
        let rows: [[_; NODES]; NODES] = core::array::from_fn(|_| core::array::from_fn(|_| space.matrix()));
        Self {
            rows: rows.into(),
            second: core::array::from_fn(|_| space.matrix()),
            permutation: space.array(0),
        }
    }
}

impl<const NODES: usize, S: Space, T: Real> CoupledSolver<NODES, T> for Blocks<NODES, S, T> {
    fn solve<M: NodeSum<NODES, T>, V: DerefMut<Target = [T]>>(
        &mut self,
        matrix: &mut M,
        weights: &[T],
        vectors: &mut [V; NODES],
    ) -> Result<(), StepFailure> {
        let Self { rows, second, permutation } = self;
        assemble(matrix, second, rows, permutation.len(), M::FIRST);
        let scales = &mut second[0][..permutation.len()];
        blocks::eliminate(rows, permutation, (weights, scales), vectors, M::FIRST..NODES)
    }
}

/// Sets `rows`, of blocks that are stored transposed, from the row and the column `first` on; `second` is
/// room for L_qq, L_qv, L_vv and, where it is not (L_qv)ᵀ, L_vq at a node.
pub(crate) fn assemble<const NODES: usize, T: Real, M: NodeSum<NODES, T>, D>(
    matrix: &mut M,
    second: &mut [D; 4],
    rows: &mut [[D; NODES]; NODES],
    n: usize,
    first: usize,
) where
    D: DerefMut<Target = [T]> + Sink<T>,
{
    for block in rows[first..].as_flattened_mut() {
        block.fill(T::lift(0.0));
    }
    for j in 0..NODES {
        matrix.place(j);
        for derivative in &mut *second {
            derivative.fill(T::lift(0.0));
        }
        let [qq, qv, vv, vq] = &mut *second;
        matrix.second_derivatives(qq, qv, vv);
        if !M::MIXED_ARE_TRANSPOSED {
            matrix.momentum_by_position(vq);
        }
        for (r, row) in rows.iter_mut().enumerate().skip(first) {
            for (k, block) in row.iter_mut().enumerate().skip(first) {
                add_transposed::<_, _, M, NODES>(matrix.weights(r, k), second, n, block);
            }
        }
    }
}

/// Adds the transpose of the weighted sum of second derivatives L_qq, L_qv, L_vv and L_vq.
#[inline]
fn add_transposed<T: Scalar, D: Deref<Target = [T]>, M: NodeSum<NODES, T>, const NODES: usize>(
    w: Weights<T>,
    [qq, qv, vv, vq]: &[D; 4],
    n: usize,
    block: &mut [T],
) {
    for i in 0..n {
        for j in 0..n {
            let (here, across) = (i * n + j, j * n + i);
            let vq = if M::MIXED_ARE_TRANSPOSED { qv[here] } else { vq[across] };
            block[here] += w.qq * qq[across] + w.qv * qv[across] + w.vq * vq + w.vv * vv[here];
        }
    }
}

/// Gives the entries of the matrix to `add`, part by part: the equation and the unknown vector of the block,
/// the row and the column in it.
pub(crate) fn entries<const NODES: usize, T: Real, M: NodeSum<NODES, T>>(
    matrix: &mut M,
    add: impl FnMut([usize; 2], [usize; 2], T),
) {
    // Several sinks pass on to it, one at a time.
    let add = RefCell::new(add);
    for node in 0..NODES {
        matrix.place(node);
        let mut weights = [[Weights::none(); NODES]; NODES];
        for (r, row) in weights.iter_mut().enumerate().skip(M::FIRST) {
            for (k, weights) in row.iter_mut().enumerate().skip(M::FIRST) {
                *weights = matrix.weights(r, k);
            }
        }
        // Adds an entry to each block, times what is asked of its weights.
        let add = |i: usize, j: usize, entry: T, weight: fn(&Weights<T>) -> T| {
            for (r, row) in weights.iter().enumerate().skip(M::FIRST) {
                for (k, w) in row.iter().enumerate().skip(M::FIRST) {
                    add.borrow_mut()([r, k], [i, j], weight(w) * entry);
                }
            }
        };
        matrix.second_derivatives(
            &mut |i, j, entry| add(i, j, entry, |w| w.qq),
            &mut |i, j, entry| {
                add(i, j, entry, |w| w.qv);
                if M::MIXED_ARE_TRANSPOSED {
                    add(j, i, entry, |w| w.vq);
                }
            },
            &mut |i, j, entry| add(i, j, entry, |w| w.vv),
        );
        if !M::MIXED_ARE_TRANSPOSED {
            matrix.momentum_by_position(&mut |i, j, entry| add(i, j, entry, |w| w.vq));
        }
    }
}

/// The solver of a [`RunTime`] space: one system of linear equations for all vectors.
#[cfg(feature = "alloc")]
#[derive(Debug)]
pub struct RunTimeCoupled<T: Real> {
    solver: RunTimeSolver<T>,
    b: alloc::vec::Vec<T>,
    x: alloc::vec::Vec<T>,
}

#[cfg(feature = "alloc")]
impl<T: Real> RunTimeCoupled<T> {
    /// For so many unknown vectors, and blocks that each have the entries that `entries` visits.
    pub(crate) fn new(
        space: RunTime,
        unknown: usize,
        storing: Storing,
        entries: impl FnOnce(&mut dyn FnMut(usize, usize)),
    ) -> Self {
        let n = space.dimension;
        let all = RunTime { dimension: n * unknown };
        let solver = RunTimeSolver::new(all, storing, |visit| {
            entries(&mut |i, j| {
                for k in 0..unknown * unknown {
                    visit(k / unknown * n + i, k % unknown * n + j);
                }
            });
        });
        Self { solver, b: all.vector(), x: all.vector() }
    }
}

#[cfg(feature = "alloc")]
struct Flat<'a, const NODES: usize, T, M> {
    matrix: &'a mut M,
    b: &'a [T],
    n: usize,
}

#[cfg(feature = "alloc")]
impl<const NODES: usize, T: Real, M: NodeSum<NODES, T>> LinearEquations<T> for Flat<'_, NODES, T, M> {
    fn evaluate<K: Sink<T>>(&mut self, b: &mut [T], sink: &mut K) -> Result<(), StepFailure> {
        let Self { matrix, b: given, n } = self;
        b.copy_from_slice(given);
        entries(*matrix, |[r, k], [i, j], entry| {
            sink.add((r - M::FIRST) * *n + i, (k - M::FIRST) * *n + j, entry);
        });
        Ok(())
    }
}

#[cfg(feature = "alloc")]
impl<const NODES: usize, T: Real> CoupledSolver<NODES, T> for RunTimeCoupled<T> {
    fn solve<M: NodeSum<NODES, T>, V: DerefMut<Target = [T]>>(
        &mut self,
        matrix: &mut M,
        weights: &[T],
        vectors: &mut [V; NODES],
    ) -> Result<(), StepFailure> {
        let Self { solver, b, x } = self;
        let n = vectors[0].len();
        for (b, vector) in lines_mut(b, n).zip(&vectors[M::FIRST..]) {
            b.copy_from_slice(vector);
        }
        solver.solve(&mut Flat::<NODES, T, _> { matrix, b, n }, weights, x)?;
        for (x, vector) in lines(x, n).zip(&mut vectors[M::FIRST..]) {
            vector.copy_from_slice(x);
        }
        Ok(())
    }
}
