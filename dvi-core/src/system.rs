//! What the compiler knows of a system, as traits.
//!
//! [`Lagrangian`] carries any L(q, v, t): its value, its first derivatives, and one weighted sum of its
//! second derivatives, which is all that a discrete Lagrangian of the quadrature family needs (its D1, D2,
//! D1D1, D1D2 and D2D2 are such sums). [`DegenerateLagrangian`] adds what is special to L = α(q)·v − H(q):
//! the one-form, the Hamiltonian, and products and solves with Dα. [`NondegenerateLagrangian`] adds what is
//! special to an L whose mass matrix ∂²L/∂v∂v is regular: the force, and the structure of that matrix.
//! [`HolonomicLagrangian`] adds the constraints of a system that has some, [`UnilateralLagrangian`] its
//! impacts; [`ManifoldLagrangian`] has rotations or unit vectors among its coordinates.
//!
//! The attribute macros implement these traits. Slices are flat and of length `dimension`, in the
//! order of the declared coordinates, unless a function says that one may be empty; the integrators of
//! this crate pass no others.

pub(crate) mod blocks;
mod constrained;
mod degenerate;
mod held;
mod holonomic;
pub(crate) mod kind;
pub(crate) mod manifold;
pub(crate) mod names;
mod nondegenerate;
mod nonholonomic;
pub(crate) mod packable;
mod pair_sum;
pub(crate) mod report;
pub(crate) mod spinors;
pub(crate) mod stand_in;
pub(crate) mod start;
mod suited;
mod unilateral;

use core::fmt::Debug;

use crate::error::{IndexError, LengthError, OutsideError};
use crate::space::Sink;
use crate::{Real, Scalar, Space};

pub use crate::name::{Axis, Factor, Name};
pub use crate::space::Weights;
pub use constrained::ConstrainedSystem;
pub use degenerate::{DegenerateLagrangian, ProperlyDegenerate, TimeTransform, TimeTransformed};
pub use held::Held;
pub use holonomic::HolonomicLagrangian;
pub use kind::Smooth;
pub(crate) use kind::{Degenerate, Holonomic, Kind, Manifold, Nonholonomic, Regular, Unilateral};
pub use manifold::{ManifoldLagrangian, ManifoldSystem};
pub use nondegenerate::{NondegenerateLagrangian, RegularLagrangian, Separable};
pub use nonholonomic::NonholonomicLagrangian;
pub(crate) use packable::Packable;
pub use pair_sum::PairSum;
pub(crate) use report::CoordinateBlock;
pub use report::Report;
pub use suited::Same;
pub use unilateral::UnilateralLagrangian;

/// A point, velocity or covector of the space of `S`.
pub type Vector<S, T> = <<S as System>::Space as Space>::Vector<T>;
/// A state of the system that `H` holds.
pub(crate) type StateOf<H, T> = <<H as Held>::System as System>::State<T>;
/// A square matrix over the space of `S`.
pub(crate) type Matrix<S, T> = <<S as System>::Space as Space>::Matrix<T>;
/// A square matrix over the space of `S` that is solved with.
pub(crate) type Square<S, T> = <<S as System>::Space as Space>::Square<T>;
/// What solves linear equations over the space of `S`.
pub(crate) type Linear<S, T> = <<S as System>::Space as Space>::Linear<T>;
/// What solves linear equations for several vectors over the space of `S`.
pub(crate) type Coupled<const NODES: usize, S, T> = <<S as System>::Space as Space>::Coupled<NODES, T>;

/// A state with named coordinates, as users see it: (q, v) for a regular system, q for a degenerate one.
///
/// `block_len` gives the size of each coordinate block, as [`System::block_len`] does. States of
/// degenerate systems have no velocities: they leave `v` alone, and it may be empty.
///
/// ```
#[doc = include_str!("../docs/hidden/kepler.txt")]
/// // What the attribute makes beside the struct: fields by the names of the coordinates.
/// let mut run = Integrator::new(&Kepler, Gauss::<4>::new(), 0.05, start)?;
/// let KeplerState { x, y, dot_x, dot_y } = run.nth(99).unwrap()?;
/// assert!((x * dot_y - y * dot_x - 1.2).abs() < 1e-13); // the area law
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait State<T: Scalar>: Sized {
    /// Writes the coordinates into `q` and the velocities into `v`, both in the order of declaration. Of
    /// vectors, all first components stand before all second ones.
    ///
    /// # Errors
    /// [`LengthError`] if an array of the state does not have the length that the system declares.
    fn write(&self, block_len: &dyn Fn(usize) -> usize, q: &mut [T], v: &mut [T])
    -> Result<(), LengthError>;
    /// Reads the coordinates from `q` and the velocities from `v`, both in the order of declaration.
    fn read(block_len: &dyn Fn(usize) -> usize, q: &[T], v: &[T]) -> Self;
    /// Reads as [`read`](Self::read) does, into a state of the same system, whose storage it keeps.
    fn refill(&mut self, block_len: &dyn Fn(usize) -> usize, q: &[T], v: &[T]) {
        *self = Self::read(block_len, q, v);
    }
}

/// A mechanical system, whatever numbers it is computed in: its configuration space, its states, its report.
///
/// ```
#[doc = include_str!("../docs/hidden/kepler.txt")]
/// let names: Vec<String> = Kepler.names().map(|name| name.to_string()).collect();
/// assert_eq!(names, ["x", "y", "dot_x", "dot_y"]);
/// assert!(Kepler.values(&start)?.eq([1.0, 0.0, 0.0, 1.2]));
/// assert_eq!(Kepler::REPORT.momenta, ["angular"]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a system",
    label = "it has neither `#[lagrangian]` nor `#[degenerate_lagrangian]`"
)]
pub trait System: Held<System = Self> {
    /// The shape of the configuration space.
    type Space: Space;
    /// The state with named coordinates.
    type State<T: Scalar>: State<T> + Clone + Debug;
    /// What the compiler saw: formulas, structure, operation counts, sparsity.
    const REPORT: Report;
    /// Whether the Lagrangian is [`Degenerate`] or [`Regular`], or regular with constraints, with impacts,
    /// or on a [`Manifold`].
    type Kind: Kind;
    /// Whether the mass matrix ∂²L/∂v∂v is regular, so that states carry velocities.
    const REGULAR: bool = <Self::Kind as Kind>::REGULAR;

    /// Whether functions that hold data stand in its formulas, of which some may not be known everywhere.
    const HAS_SCALAR_FIELDS: bool = false;

    /// Whether L or a force may be no number on a whole region of positions, as a root or a logarithm of
    /// what may be negative is: then a run looks at its [domain](Lagrangian::domain) where steps end.
    const HAS_DOMAIN: bool = false;

    /// How many [seams](Lagrangian::seam) L and the forces have.
    const SEAMS: usize = 0;

    /// Whether the time is transformed ([`TimeTransformed`]).
    const TIME_TRANSFORMED: bool = false;

    /// Whether none of L, forces and constraints depends on the time; gap functions may.
    const AUTONOMOUS: bool = false;

    /// Whether [forces](Lagrangian::applied_force) act on the system.
    const FORCED: bool = false;

    /// Whether second derivatives take a sum over all pairs, where first ones take a fast sum.
    const FAST_SUM: bool = false;

    /// The configuration space of this system.
    fn space(&self) -> Self::Space;
    /// The size of coordinate block `block`: 1 for a single coordinate, n for `x[n]`, and for each component
    /// of `r[n][3]`. The size of a block `q[n][m]` is n·m; the length of its rows, m, has the number of
    /// blocks in all plus that of the block. Of a block without rows that is 0.
    fn block_len(&self, block: usize) -> usize;
    /// Walks every index that the formulas use and checks it against the arrays that it goes to; before
    /// that, that memory can hold as many coordinates as the sizes say.
    ///
    /// # Errors
    /// [`IndexError`] names the first array that is too short, or that memory ends before, and the index.
    fn check(&self) -> Result<(), IndexError>;

    /// The names of the entries of a state, `x[0]`, `x[1]`, …, `dot_x[0]`, …, of vectors `r[0].x`, `r[0].y`,
    /// …: coordinates in the order of declaration, then the velocities of a regular system.
    fn names(&self) -> impl Iterator<Item = Name>
    where
        Self: Sized,
    {
        names::entries(self).map(|(name, _)| name)
    }

    /// The lengths of the arrays of a state, by the numbers of their blocks, and behind them those of rows:
    /// what the [names](Self::names) follow from.
    fn lengths(&self) -> impl Iterator<Item = usize>
    where
        Self: Sized,
    {
        (0..2 * Self::REPORT.coordinates.len()).map(|block| self.block_len(block))
    }

    /// The entries of a state, in the order of [`names`](Self::names).
    ///
    /// # Errors
    /// [`LengthError`] if an array of the state does not have the length that the system declares.
    fn values<T: Scalar>(&self, state: &Self::State<T>) -> Result<impl Iterator<Item = T>, LengthError>
    where
        Self: Sized,
    {
        let (mut q, mut v) = (self.space().vector(), self.space().vector());
        state.write(&|block| self.block_len(block), &mut q, &mut v)?;
        spinors::lower_all(self, &mut q);
        Ok(names::entries(self).map(move |(name, place)| if name.is_velocity { v[place] } else { q[place] }))
    }

    /// The entries of a state from coordinates and velocities as a run has them, in the order of
    /// [`names`](Self::names).
    fn values_of<T: Scalar>(&self, q: &[T], v: &[T]) -> impl Iterator<Item = T>
    where
        Self: Sized,
    {
        let lowered = spinors::lowered(self, q);
        names::entries(self).map(move |(name, place)| match &lowered {
            _ if name.is_velocity => v[place],
            Some(lowered) => lowered[place],
            None => q[place],
        })
    }

    /// The state with these entries, in the order of [`names`](Self::names); those that are lacking are zero.
    fn state_of<T: Scalar>(&self, values: impl IntoIterator<Item = T>) -> Self::State<T>
    where
        Self: Sized,
    {
        let (mut q, mut v) = (self.space().vector(), self.space().vector());
        for ((name, place), value) in names::entries(self).zip(values) {
            let half: &mut [T] = if name.is_velocity { &mut v } else { &mut q };
            half[place] = value;
        }
        spinors::lift_all(self, &mut q);
        Self::State::read(&|block| self.block_len(block), &q, &v)
    }
}

/// The Lagrangian L(q, v, t) of a system, in numbers of type `T`.
///
/// A system whose parameters are Rust's numbers has it for every [`Scalar`]. One that is generic over the
/// type of its parameters, `struct Kepler<P = f64> { mu: P }`, has it where that type is a
/// [`Parameter`](crate::Parameter) of `T`.
///
/// ```
#[doc = include_str!("../docs/hidden/pendulum.txt")]
/// // L at (q, v, t), and its derivatives: what methods are made of.
/// let (q, v, t) = ([0.5], [2.0], 0.0);
/// assert_eq!(Pendulum.lagrangian(&q, &v, t), 2.0 + 0.5_f64.cos());
/// let (mut l_q, mut l_v) = ([0.0], [0.0]);
/// Pendulum.gradient(&q, &v, t, &mut l_q, &mut l_v);
/// assert_eq!((l_q, l_v), ([-0.5_f64.sin()], [2.0]));
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a system that can be computed in `{T}`",
    label = "it has neither `#[lagrangian]` nor `#[degenerate_lagrangian]`, or a parameter that is no \
        number",
    note = "parameters are numbers of Rust, or of type `Varied<{T}>`"
)]
pub trait Lagrangian<T: Scalar = f64>: System {
    /// L(q, v, t).
    fn lagrangian(&self, q: &[T], v: &[T], t: T) -> T;
    /// Sets `l_q` to ∂L/∂q + F, where F is the [force](Self::applied_force) that acts on the system, and
    /// `l_v` to ∂L/∂v.
    fn gradient(&self, q: &[T], v: &[T], t: T, l_q: &mut [T], l_v: &mut [T]);
    /// Sets the gradients as [`gradient`](Self::gradient) does and **adds** to `sink`, entry (i, j), w.qq
    /// ∂²L/∂qⁱ∂qʲ + w.qv ∂²L/∂qⁱ∂vʲ + w.vq ∂²L/∂vⁱ∂qʲ + w.vv ∂²L/∂vⁱ∂vʲ. With a force F on the system
    /// ∂L/∂qⁱ + Fᵢ stands in the place of ∂L/∂qⁱ: w.qq ∂Fᵢ/∂qʲ + w.qv ∂Fᵢ/∂vʲ comes with it, and none of the
    /// matrices is symmetric. A derivative of F that is not finite, as that of √|v| is at rest, is left out.
    #[allow(clippy::too_many_arguments)]
    fn linearize<K: Sink<T>>(
        &self,
        q: &[T],
        v: &[T],
        t: T,
        w: Weights<T>,
        l_q: &mut [T],
        l_v: &mut [T],
        sink: &mut K,
    );

    /// Sets `out` to the force F(q, v, t) that `force = …` or `force(x) = …` declares, one component for
    /// each coordinate, in units of energy over those of the coordinate; zero if none is declared.
    ///
    /// By the principle of Lagrange and d'Alembert, δ∫L dt + ∫F·δq dt = 0, the equations of motion are d/dt
    /// ∂L/∂v = ∂L/∂q + F; of a degenerate system, Ω q' = ∇H − F + ∂α/∂t (Marsden & West 2001, section 3.1).
    /// So F stands wherever ∂L/∂q does, in the motion and in the discrete equations of every method: with
    /// L_d come the forces that the same rule makes of F.
    #[allow(unused_variables)]
    fn applied_force(&self, q: &[T], v: &[T], t: T, out: &mut [T]) {
        out.fill(T::lift(0.0));
    }

    /// Whether L or a force is not a number at this point because a function that holds data is evaluated
    /// outside of its [domain](crate::ScalarField::domain), and which argument of which function: the first
    /// one that is.
    #[allow(unused_variables)]
    fn outside(&self, q: &[T], v: &[T], t: T) -> Option<OutsideError>
    where
        T: Real,
    {
        None
    }

    /// A finite number where L and forces, and what their conditions compare, are numbers, as far as that
    /// does not depend on velocities, and none outside, if the system [has a domain](System::HAS_DOMAIN).
    #[allow(unused_variables)]
    fn domain(&self, q: &[T], t: T) -> T {
        T::lift(0.0)
    }

    /// What the time transformation of the system is at this point, if it has one ([`TimeTransformed`]).
    #[allow(unused_variables)]
    fn time_transform(&self, q: &[T]) -> Option<TimeTransform<T>> {
        None
    }

    /// The energy E = v·∂L/∂v − L. For degenerate systems this is H(q, t), and `v` may be empty.
    fn energy(&self, q: &[T], v: &[T], t: T) -> T;
    /// The value J(q, v, t) of declared momentum `index` (see [`Report::momenta`]). Momenta of degenerate
    /// systems do not depend on v, which may be empty there.
    fn momentum(&self, index: usize, q: &[T], v: &[T], t: T) -> T;

    /// The value g(q, v, t) of the function whose zeros are declared event `index` (see
    /// [`Report::events`]); not a number if there is no such event. Those of degenerate systems do not
    /// depend on v, which may be empty there.
    fn event(&self, _index: usize, _q: &[T], _v: &[T], _t: T) -> T {
        T::lift(f64::NAN)
    }

    /// Sets `l_q` and `l_v` to ∂g/∂q and ∂g/∂v of declared event `index`, and returns ∂g/∂t.
    fn event_gradient(&self, _index: usize, _q: &[T], _v: &[T], _t: T, _l_q: &mut [T], _l_v: &mut [T]) -> T {
        T::lift(f64::NAN)
    }

    /// The value of seam `index` of [`System::SEAMS`], a number at whose zeros L or a force is not smooth:
    /// the argument of `abs` or `signum`, or a − b where `min`, `max` or the condition of an `if` compares a
    /// with b. What depends on the index of a sum, and so is another number in each term, is no seam; not a
    /// number if there is no such seam. Those of degenerate systems do not depend on v.
    fn seam(&self, _index: usize, _q: &[T], _v: &[T], _t: T) -> T {
        T::lift(f64::NAN)
    }
}
