//! What a system says of a sum over all pairs of its bodies.

use crate::space::Sink;
use crate::{Lagrangian, Scalar, Weights};

/// A system whose energy has a sum over all pairs of `bodies` bodies, of a function of their distance:
///
/// ```math
/// L(q, v, t) = L_\mathrm{rest}(q, v, t) - \sum_{j<k} w_j w_k\, K(r_{jk}^2),
/// \qquad r_{jk}^2 = \sum_{a<D} (q_{a,j} - q_{a,k})^2
/// ```
///
/// The attribute implements it where it finds such a sum in L or H: `sum_pairs(0..n, |j, k| …)` over all n
/// bodies, where n is known at run time only and is the length of an array for each coordinate of a body.
/// The sum is a term, or a factor of a term whose others depend on parameters alone. It sums products of
/// weights, which are parameters with one index, the same for j as for k, and of K. In K the coordinates
/// stand in `(x[j] - x[k]).powi(2) + …`, as such or as a `hypot` in the plane; no other index, coordinate,
/// velocity or the time stands there. Other ways to write the same are not recognised, such as sums over
/// ordered pairs, or a sum within a bracket. If there are several such sums it is the first. There are no
/// constraints, impacts, rotations or unit vectors. `fast_sum::FastSum`, with the feature `fast-sums`, is
/// for such systems.
#[diagnostic::on_unimplemented(
    message = "no sum over all pairs of bodies of a function of their distance is seen in the energy of \
        `{Self}`",
    label = "its pairs cannot be summed fast",
    note = "such a sum is written `sum_pairs(0..n, |j, k| w[j] * w[k] * f((x[j] - x[k]).powi(2) + (y[j] - y[k]).powi(2)))`, with arrays \
            of coordinates and weights whose length n is known at run time only",
    note = "it is a term of `lagrangian = …` or `hamiltonian = …`, of a system without constraints or \
        impacts"
)]
pub trait PairSum<T: Scalar, const D: usize>: Lagrangian<T> {
    /// The number of bodies.
    fn bodies(&self) -> usize;
    /// The place in q of coordinate `axis`, below `D`, of the first body; those of the others follow.
    fn place(&self, axis: usize) -> usize;
    /// w of a body.
    fn weight(&self, body: usize) -> T;
    /// K.
    fn kernel(&self, r2: T) -> T;
    /// dK/d(r²).
    fn kernel_slope(&self, r2: T) -> T;
    /// L without the sum.
    fn rest_lagrangian(&self, q: &[T], v: &[T], t: T) -> T;
    /// Sets what [`gradient`](Lagrangian::gradient) does, without the sum.
    fn rest_gradient(&self, q: &[T], v: &[T], t: T, l_q: &mut [T], l_v: &mut [T]);
    /// Does what [`linearize`](Lagrangian::linearize) does, without the sum.
    #[expect(clippy::too_many_arguments, reason = "as many as `linearize` has")]
    fn rest_linearize<K: Sink<T>>(
        &self,
        q: &[T],
        v: &[T],
        t: T,
        w: Weights<T>,
        l_q: &mut [T],
        l_v: &mut [T],
        sink: &mut K,
    );
    /// The [energy](Lagrangian::energy) without the sum. Of a degenerate system it is H without the sum; `v`
    /// is not read, and may be empty.
    fn rest_energy(&self, q: &[T], v: &[T], t: T) -> T;

    /// Of a regular system: sets what [`force`](crate::NondegenerateLagrangian::force) does, without the
    /// sum.
    #[allow(unused_variables)]
    fn rest_force(&self, q: &[T], v: &[T], t: T, out: &mut [T]) {
        out.fill(T::lift(f64::NAN));
    }
    /// Of a degenerate system: sets what
    /// [`hamiltonian_gradient`](crate::DegenerateLagrangian::hamiltonian_gradient) does, without the sum.
    #[allow(unused_variables)]
    fn rest_hamiltonian_gradient(&self, q: &[T], t: T, out: &mut [T]) {
        out.fill(T::lift(f64::NAN));
    }
    /// The same for [`flow_source`](crate::DegenerateLagrangian::flow_source).
    #[allow(unused_variables)]
    fn rest_flow_source(&self, q: &[T], t: T, out: &mut [T]) {
        out.fill(T::lift(f64::NAN));
    }
}
