//! What the compiler knows of a Lagrangian that is affine in the velocities.

use crate::error::StartError;
use crate::space::Sink;
use crate::system::{Degenerate, Lagrangian, Same, System, start};
use crate::{Real, Scalar};

/// A system with L(q, v, t) = α(q, t)·v − H(q, t).
///
/// Dα is the matrix ∂αᵢ/∂qʲ. Its combinations a Dα + b (Dα)ᵀ are what a step solves with: Ω itself is
/// a = −1, b = 1, the matrix of the explicit step a = 0, b = 1 (Rowley & Marsden 2002, eq. 17).
///
/// ```
#[doc = include_str!("../../docs/hidden/predators.txt")]
/// let mut alpha = [0.0; 2];
/// Predators.one_form(&[2.0, 0.5], 0.0, &mut alpha);
/// assert_eq!(alpha, [0.5_f64.ln() / 2.0, 0.0]);
/// let mut gradient = [0.0; 2];
/// Predators.hamiltonian_gradient(&[2.0, 0.5], 0.0, &mut gradient);
/// assert_eq!(gradient, [0.5, -3.0]); // 1 − 1/x and 1 − 2/y
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a degenerate system, and this is for systems with `#[degenerate_lagrangian]`",
    label = "its Lagrangian is regular, a parameter is no number, or it has no attribute",
    note = "regular systems, with `#[lagrangian]`, are stepped by `Variational`, `Galerkin`, `Newmark`, \
        `Gauss` or `RungeKutta`",
    note = "those with constraints by `Constrained`, with impacts by `Impacts`, with rotations or unit \
        vectors by `Geodesic`"
)]
pub trait DegenerateLagrangian<T: Scalar = f64>: Lagrangian<T> + System<Kind = Degenerate> {
    /// `M`, which steps systems of this kind: see [`Method::Suited`](crate::methods::Method::Suited).
    type Suited<M>: Same<M, As = M>;

    /// Whether α is affine in q with constant coefficients, so that Dα is one constant matrix.
    const AFFINE: bool;
    /// Whether Dα couples each coordinate to exactly one other, its conjugate, and to nothing else; then a
    /// Dα + b (Dα)ᵀ is solved by one division per coordinate. True of blocks of coordinates that are coupled
    /// index by index; of other couplings it may be false, and the general solve is taken.
    const MATCHING: bool;
    /// Whether Ω = (Dα)ᵀ − Dα couples each coordinate to exactly one other. Weaker than
    /// [`MATCHING`](Self::MATCHING): diagonal entries of Dα cancel in Ω. True and false of the same
    /// couplings.
    const CANONICAL: bool;

    /// H(q, t).
    fn hamiltonian(&self, q: &[T], t: T) -> T;
    /// Sets `out` to ∇H(q, t) − F(q, t), with the [force](Lagrangian::applied_force) that acts on the
    /// system.
    fn hamiltonian_gradient(&self, q: &[T], t: T, out: &mut [T]);
    /// Sets `out` to ∇H(q, t) − F(q, t) + ∂α/∂t: the right side of Ω q' = ∇H − F + ∂α/∂t, the equation of
    /// the flow.
    fn flow_source(&self, q: &[T], t: T, out: &mut [T]);
    /// Sets `out` to the components of α(q, t).
    fn one_form(&self, q: &[T], t: T, out: &mut [T]);
    /// Adds a Dα + b (Dα)ᵀ to `sink`.
    fn one_form_jacobian<K: Sink<T>>(&self, q: &[T], t: T, a: T, b: T, sink: &mut K);
    /// Where [`CANONICAL`](Self::CANONICAL) holds: sets `out[i]` to the entry of a Dα + b (Dα)ᵀ in row i
    /// and the column of i's conjugate. Elsewhere it leaves zeros.
    fn conjugate_entries(&self, q: &[T], t: T, a: T, b: T, out: &mut [T]);
    /// Where [`CANONICAL`](Self::CANONICAL) holds: the conjugate of coordinate `i`, of any index below the
    /// dimension. Elsewhere `i` itself.
    fn conjugate(&self, i: usize) -> usize;
    /// The end of the coordinates from `i` on whose conjugates lie beside one another, in the same order.
    fn conjugates_end(&self, i: usize) -> usize;
    /// Sets `out` to the gradient ∂J/∂q of declared momentum `index`.
    fn momentum_gradient(&self, index: usize, q: &[T], t: T, out: &mut [T]);
}

/// What a time transformation is at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeTransform<T> {
    /// ρ = dt/dτ, how fast the physical time t passes in the time τ of the run.
    pub rate: T,
    /// H(q, t), the Hamiltonian before the transformation.
    pub hamiltonian: T,
}

/// A system whose time is transformed, by `time_transform = ρ` in its attribute: dt = ρ(q, t) dτ with a
/// positive function ρ.
///
/// A run takes steps of equal length in τ, so they are short in the physical time t where ρ is small. To be
/// variational, the system has two coordinates more, `t` and `energy`, the conjugate of the time:
///
/// ```math
/// L'(q, t, e) = \alpha(q, t) \cdot q' - e\, t' - \rho(q, t)\, (H(q, t) - e), \qquad ' = \mathrm{d}/\mathrm{d}\tau
/// ```
///
/// Its equations of motion are t' = ρ, e' = ρ ∂H/∂t and, where H = e, those of L = α·q̇ − H times ρ (Hairer,
/// Lubich & Wanner 2006, section VIII.2.1, after Poincaré and Sundman). If H does not depend on time,
/// `energy` is a constant of the run, and L' is α·q' − ρ (H − H₀) with H₀ = `energy`. As `t` is a
/// coordinate, the scheme computes it to its own order. L' is in the class of one-step schemes if L is.
///
/// A run is to go on from its checkpoint, with another or a negative step by
/// [`Checkpoint::with_step_size`](crate::run::Checkpoint::with_step_size) if its method is not one of two
/// steps. A run that begins at a state of another has to begin with the energy of that state, and is another
/// motion by the error of the scheme. Diagnostics that speak of time mean τ. `t` and `energy` stand in the
/// equations of a step beside the coordinates, so that units are needed in which their numbers are of
/// moderate size: in units of time 10⁹ times too long, the matrices of a comet's steps count as singular.
///
/// In such a run [`Run::energy`](crate::run::Run::energy) is ρ (H − e): zero on the motion, and in a run the
/// error of H times ρ.
///
/// ```
/// use dvi_core::prelude::*;
///
/// /// Predators y and their prey x. Both are small for a long time and peak in a short one.
/// #[degenerate_lagrangian(
///     coordinates(x, y),
///     one_form = y.ln() / x * d(x),
///     hamiltonian = x + y - x.ln() - 2.0 * y.ln(),
///     time_transform = 1.0 / (x + y),
/// )]
/// struct Predators;
///
/// let start = Predators.with_energy(PredatorsState { x: 0.2, y: 0.1, t: 0.0, energy: 0.0 })?;
/// let mut run = Integrator::new(&Predators, OneStep::midpoint(), 0.02, start)?;
/// run.take_steps(1000)?;
/// let state = run.state();
/// assert_eq!(state.energy, start.energy);
/// assert!(run.time() == 20.0 && state.t != 20.0); // τ and t
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[diagnostic::on_unimplemented(
    message = "the time of `{Self}` is not transformed",
    label = "its attribute has no `time_transform`"
)]
pub trait TimeTransformed<T: Scalar = f64>: Lagrangian<T> + System<Kind = Degenerate> {
    /// ρ and H(q, t) at the point `q` of the extended space.
    fn time_transform_at(&self, q: &[T]) -> TimeTransform<T>;

    /// The state with `energy` set to H(q, t), as a run begins.
    ///
    /// # Errors
    /// [`StartError`], as the start of a run, if an array of the system or of the state has the wrong
    /// length, a coordinate other than `energy` is not finite, or H or ρ is not.
    fn with_energy(&self, state: Self::State<T>) -> Result<Self::State<T>, StartError>
    where
        Self: Sized,
        T: Real,
    {
        start::with_energy(self, &state)
    }
}

/// A system in the class of one-step schemes: there is a half y of the coordinates along which α has no
/// component, so that α = ϑ(x, y)·dx with the other half x (Ellison, Finn, Burby, Kraus, Qin & Tang 2018).
/// Then Ω is regular where ∂ϑ/∂y is.
///
/// The attribute implements it where the formula of α shows that. The class is a property of the formula: α
/// and α + dF have the same motion, and one may be in the class and the other not.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a degenerate system, and one-step schemes are for systems with \
        `#[degenerate_lagrangian]`",
    label = "its Lagrangian is regular, a parameter is no number, or it has no attribute",
    note = "regular systems, with `#[lagrangian]`, are stepped by `Variational`, `Galerkin`, `Newmark`, \
        `Gauss` or `RungeKutta`",
    note = "those with constraints by `Constrained`, with impacts by `Impacts`, with rotations or unit \
        vectors by `Geodesic`"
)]
pub trait ProperlyDegenerate<T: Scalar = f64>: DegenerateLagrangian<T> {
    /// `M`, which steps systems of this kind: see [`Method::Suited`](crate::methods::Method::Suited).
    type Suited<M>: Same<M, As = M>;

    /// The place of a coordinate, below the dimension n, in the order (x, y): below n/2 if α has a component
    /// along it.
    fn place(&self, coordinate: usize) -> usize;
}
