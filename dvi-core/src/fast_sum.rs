//! Sums over all pairs of many bodies, by the fast multipole method, with the feature `fast-sums`.
//!
//! The energy of n bodies that act on each other has n²/2 terms. [`FastSum`] is a system in the place of one
//! with such a sum: near bodies are summed one by one, and what groups of bodies do to others far away is
//! expanded in polynomials, so that the work grows like n where bodies fill a region, a curve or a surface
//! with some density. It grows faster where there are clusters of less than a ten-thousandth of the extent
//! of all bodies, which are divided into few cubes or none: one body far away from all others makes it so.
//!
//! ```
//! use dvi_core::fast_sum::FastSum;
//! use dvi_core::prelude::*;
//!
//! /// Vortices whose cores have the radius `core`.
//! #[degenerate_lagrangian(
//!     coordinates(x[gamma.len()], y[gamma.len()]),
//!     one_form = sum(0..gamma.len(), |j| gamma[j] * x[j] * d(y[j])),
//!     hamiltonian = sum_pairs(0..gamma.len(), |j, k| gamma[j] * gamma[k]
//!         * ((x[j] - x[k]).powi(2) + (y[j] - y[k]).powi(2) + core * core).ln()) / (4.0 * PI),
//! )]
//! struct Blobs {
//!     gamma: Vec<f64>,
//!     core: f64,
//! }
//!
//! let n = 500;
//! let blobs = Blobs { gamma: vec![1.0 / n as f64; n], core: 0.05 };
//! let start = BlobsState {
//!     x: (0..n).map(|j| (0.1 * j as f64).cos() * (1.0 + j as f64 / 500.0)).collect(),
//!     y: (0..n).map(|j| (0.1 * j as f64).sin()).collect(),
//! };
//! let fast = FastSum::new(&blobs, 1e-8)?;
//! assert!(fast.measured_error(&start, 100)? < 1e-8);
//!
//! // Stages are solved no further than forces are known.
//! let method = Gauss::<1> { stopping: Stopping { tolerance: 1e-9, ..Stopping::default() }, ..Gauss::new() };
//! let mut run = Integrator::new(&fast, method, 0.01, start)?;
//! let energy = run.energy();
//! run.take_steps(10)?;
//! assert!((run.energy() - energy).abs() < 1e-8 * energy.abs());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # What is computed
//!
//! Cubes are divided until they hold few bodies. Where two cubes of one size do not touch, the kernel K(r²)
//! between them is replaced by its interpolant in products of Chebyshev polynomials of both places (Fong &
//! Darve 2009). What far cubes do in a cube is made of fewer functions than there are such products;
//! expansions are kept in those, level by level (H²-matrices, Hackbusch & Börm 2002). This makes of the sum
//! over pairs another function of the places, H̃, for a given division into cubes. The gradient is that of
//! H̃, not an approximation to the gradient of H: so the motion conserves H̃ as far as the method does, and
//! forces of bodies on each other have the symmetries that H̃ has. H̃ depends on differences of places only
//! approximately, so momenta are conserved as far as the tolerance goes.
//!
//! In a long run these errors may add up: by a small part of the tolerance in a unit of time.
//!
//! Bodies are summed one by one, too, where K has no numbers at the distances of far cubes, whether bodies
//! are there or not, as ln(1 − r²/b²) beyond b; and where K changes so little between cubes that rounding
//! errors of K would be seen in the forces, as that of ln(r² + c²) deep in a core.
//!
//! Places are to lie within 2⁵⁰⁰, some 3 · 10¹⁵⁰, of each other, so that their distances can be squared:
//! elsewhere energy and forces are no numbers, and nothing is summed.
//!
//! A kernel may have a pole at a distance of far cubes, or oscillate faster than cubes are wide. So each
//! evaluation holds the sums of eight bodies from all regions against sums over all others. Where they
//! differ by more than ten times the tolerance, as a part of the largest sum of the absolute values of
//! terms, all bodies are summed one by one: the forces are right, and take as long as all pairs.
//! [`FastSum::operations`] tells. What is wrong for a few bodies only may be missed.
//!
//! A body that crosses from one cube to the next changes the division. There H̃ and the forces jump by some
//! part of the tolerance. An iteration that is to solve an implicit step further than that may go on between
//! two sides of a jump: give such methods a [`Stopping`](crate::solve::Stopping) whose tolerance is not far
//! below that of the sum. With the default, to rounding errors, steps take more iterations, or fail.

/// The value of an expression, computed by the widest instructions that the processor has.
macro_rules! widest {
    ($body:expr) => {
        $crate::scalar::widest_if(
            true,
            #[cfg_attr(not(debug_assertions), inline(always))]
            || $body,
        )
    };
}

mod basis;
mod directions;
mod expansion;
mod interpolant;
mod lists;
mod locals;
mod matrix;
mod moments;
mod neighbours;
mod packs;
mod quantity;
mod shares;
mod spot_check;
mod subspace;
mod system;
mod transfer;
mod tree;
mod work;

use core::cell::RefCell;
use core::fmt;

use thiserror::Error;

use self::expansion::Expansion;
use self::packs::Pack;
use self::quantity::{Gradient, Potential, Quantity};
use self::tree::NotFinite;
use self::work::{Operations, Work};
use crate::error::{IndexError, LengthError};
use crate::shown::shown;
use crate::{PairSum, Space, State, Vector};

/// There is no fast sum of a system.
///
/// ```
#[doc = include_str!("../docs/hidden/blobs.txt")]
/// let blobs = Blobs { weight: vec![1.0; 500] };
/// let Err(error) = FastSum::new(&blobs, 1e-12) else { panic!("no fast sum is so close") };
/// assert!(matches!(error, FastSumError::Tolerance { least: 1e-10, .. }));
/// ```
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum FastSumError {
    /// The sum over pairs cannot be had to such a tolerance.
    #[error(
        "the tolerance of a fast sum is to be between {least:e} and {largest:e}, and it is {tolerance:e}",
        largest = LARGEST
    )]
    #[non_exhaustive]
    Tolerance {
        /// What was asked for.
        tolerance: f64,
        /// The least one, in so many dimensions.
        least: f64,
    },
    /// The formulas of the system read a parameter that is not there.
    #[error(transparent)]
    Index(#[from] IndexError),
}

/// In space the matrices for less would take more than a gigabyte.
const LEAST_IN_SPACE: f64 = 1e-6;
const LEAST: f64 = 1e-10;
const LARGEST: f64 = 1e-2;

/// A system like `S`, in which a sum over all pairs of bodies is computed by the fast multipole method.
///
/// `S` is a degenerate or a regular system. It takes the methods that `S` takes and evaluates forces and
/// energies fast. Second derivatives of its Lagrangian by places are those of `S`, at the cost of the sum
/// over pairs: take methods whose steps are explicit or solved by the fixed point.
///
/// In space an evaluation takes longer than in the plane, and so do the matrices for it, which take memory
/// besides: some 0.1 GB for a tolerance of 1e-3, and several times as much for 1e-6.
///
/// An evaluation takes memory for its cubes, which is kept for the next one; it allocates when there are
/// more cubes than ever before. For cubes of a size that was not there before it computes matrices, which
/// takes the time of many evaluations: where the extent of the bodies doubles, or where they come together.
///
/// It is for one thread at a time, which may share its work with others: `ensemble` and `run::Together` do
/// not take it, nor `Gauss::in_lanes`.
///
/// H̃ belongs to the tolerance: a run that is resumed from a checkpoint with another one goes on in another
/// H̃.
///
/// ```
#[doc = include_str!("../docs/hidden/blobs.txt")]
/// let n = 500;
/// let blobs = Blobs { weight: vec![1.0; n] };
/// let angle = |j: usize| 0.1 * j as f64;
/// let start = BlobsState {
///     x: (0..n).map(|j| angle(j).cos() * (1.0 + j as f64 / 500.0)).collect(),
///     y: (0..n).map(|j| angle(j).sin()).collect(),
/// };
/// let fast = FastSum::new(&blobs, 1e-6)?;
/// assert!(fast.measured_error(&start, 100)? < 1e-6);
/// assert!(fast.operations(&start)?.pairs < 500 * 499); // not all pairs are summed
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct FastSum<'s, S, const D: usize> {
    system: &'s S,
    tolerance: f64,
    inner: RefCell<(Expansion<D>, Work<D>)>,
}

shown! {
    [S: fmt::Debug, const D: usize] FastSum<'_, S, D>, |fast|
    system: fast.system,
    tolerance: fast.tolerance
}

// A bound less than below: so a system without such a sum is refused once.
impl<'s, S: PairSum<f64, D>, const D: usize> FastSum<'s, S, D> {
    /// Sums the pairs of `system` with forces of a relative error of about `tolerance`, ‖∇H̃ − ∇H‖/‖∇H‖ over
    /// all bodies. Tests find it below the tolerance for ln(r² + c²) with several c, with bodies in a
    /// square, near a line and in clusters, and for 1/√(r² + c²) in space, r² and two kernels more. It is
    /// larger where the forces on most bodies cancel, and, by up to ten times or so, near rounding, where
    /// bodies fill a thin strip, and where one weight is that of all others together. For other systems than
    /// these, ask [`measured_error`](Self::measured_error).
    ///
    /// # Errors
    /// [`FastSumError::Tolerance`] if the tolerance is not between 1e-10, in space 1e-6, and 1e-2;
    /// [`FastSumError::Index`] as of [`check`](crate::System::check).
    pub fn new(system: &'s S, tolerance: f64) -> Result<Self, FastSumError> {
        system.check()?;
        let least = if D > 2 { LEAST_IN_SPACE } else { LEAST };
        if !(least..=LARGEST).contains(&tolerance) {
            return Err(FastSumError::Tolerance { tolerance, least });
        }
        // One more divides the error by 3 to 4 where bodies lie on a line, by more elsewhere.
        let order = (-1.75 * tolerance.log10()).ceil() as usize + if D > 2 { 3 } else { 2 };
        let inner = RefCell::new((Expansion::new(order, 0.03 * tolerance), Work::new(tolerance)));
        Ok(Self { system, tolerance, inner })
    }
}

impl<'s, S, const D: usize> FastSum<'s, S, D>
where
    S: PairSum<f64, D> + PairSum<Pack, D> + Sync,
{
    /// The relative error of the forces at a state, ‖∇H̃ − ∇H‖/‖∇H‖ of the sums over pairs, over some
    /// `bodies` from all regions, against sums over all pairs of each. No number where a coordinate is none.
    ///
    /// # Errors
    /// [`LengthError`] if an array of the state does not have the length that the system declares.
    pub fn measured_error(&self, state: &S::State<f64>, bodies: usize) -> Result<f64, LengthError> {
        let has_numbers = self.pair_gradient(&self.point(state)?, |_, _| ());
        let (_, work) = &*self.inner.borrow();
        let error = || work.error::<Gradient>(&|r2| self.system.kernel_slope(r2), bodies);
        Ok(if has_numbers { error() } else { f64::NAN })
    }

    /// What an evaluation of the forces takes at a state: the `pairs` of bodies that are summed one by one,
    /// of which all bodies have n(n − 1), and the `products` in the matrices between groups of bodies.
    /// Nothing where a coordinate is no number.
    ///
    /// # Errors
    /// [`LengthError`] if an array of the state does not have the length that the system declares.
    pub fn operations(&self, state: &S::State<f64>) -> Result<Operations, LengthError> {
        let has_numbers = self.pair_gradient(&self.point(state)?, |_, _| ());
        let (expansion, work) = &*self.inner.borrow();
        Ok(if has_numbers { work.operations(expansion) } else { Operations::default() })
    }

    /// The coordinates of a state.
    fn point(&self, state: &S::State<f64>) -> Result<Vector<S, f64>, LengthError> {
        let (mut q, mut v) = (self.system.space().vector(), self.system.space().vector());
        state.write(&|block| self.system.block_len(block), &mut q, &mut v)?;
        Ok(q)
    }

    fn places<'q>(&self, q: &'q [f64]) -> [&'q [f64]; D] {
        let bodies = PairSum::<f64, D>::bodies(self.system);
        core::array::from_fn(|axis| {
            let first = PairSum::<f64, D>::place(self.system, axis);
            &q[first..first + bodies]
        })
    }

    /// Calls `each` with each body, its weight, and the sums of Q over all others, of which `factor` is what
    /// depends on the squared distance.
    fn sums<Q: Quantity<D>>(
        &self,
        q: &[f64],
        factor: impl Fn(Pack) -> Pack + Sync,
        mut each: impl FnMut(usize, f64, [f64; D]),
    ) -> Result<(), NotFinite> {
        let mut inner = self.inner.borrow_mut();
        let (expansion, work) = &mut *inner;
        let weight = |body: usize| PairSum::<f64, D>::weight(self.system, body);
        let kernel = |r2: Pack| self.system.kernel(r2);
        let found = work.evaluate::<Q>(expansion, &weight, &kernel, &factor, self.places(q))?;
        found.for_each(|(body, sums)| each(body, weight(body), sums));
        Ok(())
    }

    /// H̃, or no number where a coordinate is none.
    fn pair_energy(&self, q: &[f64]) -> f64 {
        let mut energy = 0.0;
        let found = self.sums::<Potential>(
            q,
            #[inline]
            |r2| self.system.kernel(r2),
            |_, weight, sums| energy += 0.5 * weight * sums[0],
        );
        if found.is_ok() { energy } else { f64::NAN }
    }

    /// Calls `each` with each body and its part of ∇H̃. Without numbers where a coordinate is none, and
    /// returns whether there are some.
    fn pair_gradient(&self, q: &[f64], mut each: impl FnMut(usize, [f64; D])) -> bool {
        let found = self.sums::<Gradient>(
            q,
            #[inline]
            |r2| self.system.kernel_slope(r2),
            |body, weight, sums| each(body, sums.map(|sum| 2.0 * weight * sum)),
        );
        if found.is_err() {
            (0..PairSum::<f64, D>::bodies(self.system)).for_each(|body| each(body, [f64::NAN; D]));
        }
        found.is_ok()
    }
}
