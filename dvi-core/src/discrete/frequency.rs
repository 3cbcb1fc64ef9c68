//! The frequency that a phase-fitted interpolation is fitted to.
//!
//! Kosmas & Vlachos interpolate between q0 and q1 by sin ωt and cos ωt. ω may be given, or taken from the
//! motion: from the curvature of the path (their eq. 19), or from the ratio of acceleration to distance. How
//! it is taken, the [`Reading`], decides what a step preserves.

mod local;

use core::fmt::Debug;

use crate::error::{StartError, StepFailure};
use crate::scalar::norm;
use crate::scalar::passes::dot;
use crate::{NondegenerateLagrangian, Real, Scalar, Space};

pub(crate) use local::Local;

/// How a frequency that depends on the motion enters a step from q0 to q1.
///
/// ```
#[doc = include_str!("../../docs/hidden/kepler.txt")]
/// let fitted = |reading| Variational::simpson().phase_fitted(Radial(reading));
/// // Only what reads both ends of a step alike takes the same way back.
/// assert!(!fitted(Reading::LeftFrozen).is_symmetric());
/// assert!(fitted(Reading::Averaged).is_symmetric());
/// let mut run = Integrator::new(&Kepler, fitted(Reading::Averaged), 0.1, start)?;
/// let energy = run.energy();
/// run.take_steps(10_000)?;
/// assert!((run.energy() - energy).abs() < 1e-4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reading {
    /// ω at (q0, v0), held constant: what Kosmas & Vlachos do. The step is neither symplectic (its defect is
    /// O(h³)) nor reversible, and with fixed or with reversible steps the energy drifts like O(h³)t.
    LeftFrozen,
    /// The mean of ω at both ends, held constant in the derivatives of L_d. Reversible, hence without drift
    /// on reversible orbits; not symplectic.
    Averaged,
    /// The mean of ω at both ends, differentiated with the rest of L_d. Symplectic and reversible; the most
    /// expensive of the three: a step needs the second derivatives of L.
    Variational,
}

/// A rule for the frequency ω of a step, in radians per unit of time.
pub trait Frequency: Debug {
    /// Whether it is zero, and the interpolation linear.
    const UNFITTED: bool = false;
    /// Whether ω depends on the velocity.
    const OF_VELOCITY: bool = false;

    /// How the motion is read; `None` if the frequency does not depend on it.
    fn reading(&self) -> Option<Reading> {
        None
    }

    /// The frequency, where it does not depend on the motion: needed if [`reading`](Self::reading) is
    /// `None`. Not a number unless it is given; a run that needs it is then refused.
    fn fixed<T: Real>(&self) -> T {
        T::lift(f64::NAN)
    }

    /// ω at (q, v), from the acceleration a = M⁻¹∂L/∂q: needed if the frequency is read from the motion. Not
    /// a number unless it is given; a step that needs it then fails.
    fn at<T: Real>(&self, _q: &[T], _v: &[T], _a: &[T]) -> T {
        T::lift(f64::NAN)
    }

    /// ω at (q, v, a) after setting its derivatives by each of them: needed for [`Reading::Variational`].
    /// `None` unless they are given; a run with that reading is then refused.
    fn derivatives<T: Real>(&self, _at: [&[T]; 3], _derivatives: [&mut [T]; 3]) -> Option<T> {
        None
    }

    /// Checks the options.
    ///
    /// # Errors
    /// [`StartError::Parameter`] names the option that is out of range.
    fn validate(&self) -> Result<(), StartError> {
        Ok(())
    }
}

/// No frequency: linear interpolation, the limit ω → 0.
///
/// ```
#[doc = include_str!("../../docs/hidden/pendulum.txt")]
/// /// What holds a run names its method, and that its interpolation is linear.
/// struct Experiment {
///     run: Integrator<Pendulum, Variational<Unfitted, Trapezoid>>,
/// }
/// let run = Integrator::new(Pendulum, Variational::trapezoid(), 0.01, start)?;
/// let mut experiment = Experiment { run };
/// experiment.run.take_steps(100)?;
/// assert_eq!(experiment.run.steps(), 100);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Unfitted;

impl Frequency for Unfitted {
    const UNFITTED: bool = true;

    fn fixed<T: Real>(&self) -> T {
        T::lift(0.0)
    }
}

/// One frequency for all coordinates and all times. Symplectic, and with steps of one length and symmetric
/// rules exact on oscillators of that frequency: from rest, and from a velocity with
/// [`Fitting::PhaseAndMomentum`](crate::methods::Fitting::PhaseAndMomentum).
///
/// ```
/// use dvi_core::prelude::*;
///
/// #[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0 - 2.0 * x * x)]
/// struct Spring; // with frequency 2
///
/// let start = SpringState { x: 1.0, dot_x: 0.0 };
/// let method = Variational::trapezoid().phase_fitted(Constant(2.0));
/// let mut run = Integrator::new(&Spring, method, 0.5, start)?; // six steps a period
/// run.take_steps(100)?;
/// assert!((run.state().x - 100_f64.cos()).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constant(
    /// ω ≥ 0.
    pub f64,
);

impl Frequency for Constant {
    fn fixed<T: Real>(&self) -> T {
        T::lift(self.0)
    }

    fn validate(&self) -> Result<(), StartError> {
        let in_range = (0.0..f64::INFINITY).contains(&self.0);
        StartError::unless(in_range, "omega", self.0, "0 <= omega, finite")
    }
}

/// Whether `frequency` gives what its reading needs, `system` can be read, and options are in range.
///
/// # Errors
/// [`StartError::Unsupported`] names the method of [`Frequency`] that is missing, or what the system has;
/// else as [`Frequency::validate`].
pub(crate) fn admit<S: NondegenerateLagrangian<T>, F: Frequency, T: Real>(
    frequency: &F,
    system: &S,
) -> Result<(), StartError> {
    frequency.validate()?;
    let lacks_derivatives = || {
        let [point, mut dq, mut dv, mut da] = system.space().vectors::<T, 4>();
        frequency.derivatives([&point; 3], [&mut dq, &mut dv, &mut da]).is_none()
    };
    let (option, reason) = match frequency.reading() {
        Some(_) if !S::SEPARABLE => (
            "a frequency read from the motion",
            "it needs L = ½ v·M v − V(q, t) with a constant matrix M, and forces without velocities",
        ),
        None if !frequency.fixed::<T>().is_finite() => (
            "a frequency that is not read from the motion",
            "Frequency::fixed does not give a finite number",
        ),
        Some(Reading::Variational) if lacks_derivatives() => {
            ("Reading::Variational", "Frequency::derivatives is not implemented; take Reading::Averaged")
        }
        None | Some(Reading::LeftFrozen | Reading::Averaged | Reading::Variational) => return Ok(()),
    };
    Err(StartError::Unsupported { option, reason })
}

/// ω = |v × a|/|v|², the angular velocity of the osculating circle (Kosmas & Vlachos, eq. 19), in any number
/// of dimensions as |a⊥|/|v|, where a⊥ = a − (v·a/v²)v is the acceleration across the path.
///
/// At both ends v is the mean velocity Δ/h; for [`Reading::LeftFrozen`] it is that of the motion. On Kepler
/// orbits it changes fast at the pericentre; [`Radial`] is smoother there and gives order 4.
///
/// On a straight path ω = 0 has a kink, as |x| has at 0. With [`Reading::Variational`] its derivatives are
/// left out there: the step is that of the neighbouring paths, but a run on dual numbers is no tangent map
/// at such a point.
///
/// ```
#[doc = include_str!("../../docs/hidden/kepler.txt")]
/// // On a circle the path turns with the frequency of the motion, and so do the steps.
/// let circle = KeplerState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 };
/// let method = Variational::simpson().phase_fitted(Curvature(Reading::Averaged));
/// let mut run = Integrator::new(&Kepler, method, 0.1, circle)?;
/// run.take_steps(100)?;
/// assert!((run.state().x - 10_f64.cos()).abs() < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Curvature(
    /// How it enters the step.
    pub Reading,
);

impl Frequency for Curvature {
    const OF_VELOCITY: bool = true;

    fn reading(&self) -> Option<Reading> {
        Some(self.0)
    }

    #[inline]
    fn at<T: Real>(&self, _q: &[T], v: &[T], a: &[T]) -> T {
        area(v, a) / dot(v, v)
    }

    fn derivatives<T: Real>(&self, [q, v, a]: [&[T]; 3], [dq, dv, da]: [&mut [T]; 3]) -> Option<T> {
        let omega = self.at(q, v, a);
        let (vv, area) = (dot(v, v), area(v, a));
        let ratio = dot(v, a) / vv;
        // ∂ω/∂a = a⊥/(|v||a⊥|), ∂ω/∂v = −(v·a/v²)∂ω/∂a − ωv/v². On a straight path a⊥ has no direction.
        let per_area = if area > T::lift(0.0) { T::lift(1.0) / area } else { T::lift(0.0) };
        dq.fill(T::lift(0.0));
        for i in 0..v.len() {
            da[i] = per_area * (a[i] - ratio * v[i]);
            dv[i] = -ratio * da[i] - omega / vv * v[i];
        }
        Some(omega)
    }
}

/// |v||a⊥|, the area that v and a span.
fn area<T: Real>(v: &[T], a: &[T]) -> T {
    let (vv, va, aa) = (dot(v, v), dot(v, a), dot(a, a));
    let difference = vv * aa - va * va;
    // Where more than two digits would cancel, the path is nearly straight, and a⊥ is summed by itself.
    let square = if difference > T::lift(1.0 / 64.0) * (vv * aa) {
        difference
    } else {
        let ratio = va / vv;
        v.iter().zip(a).fold(T::lift(0.0), |sum, (&v, &a)| {
            let across = a - ratio * v;
            sum + across * across
        }) * vv
    };
    // √ has no derivative at zero.
    if square == T::lift(0.0) { square } else { Scalar::sqrt(square) }
}

/// ω = √(|a|/|q|): the frequency of the oscillator q'' = −ω²q with the same acceleration at the same
/// distance from the origin. On Kepler orbits it is r^(−3/2), and the averaged and the variational reading
/// are of order 4 there with Simpson's rule or a better one.
///
/// ```
#[doc = include_str!("../../docs/hidden/kepler.txt")]
/// let method = Variational::simpson();
/// let mut plain = Integrator::new(&Kepler, method, 0.05, start.clone())?;
/// let mut fitted = Integrator::new(&Kepler, method.phase_fitted(Radial(Reading::Averaged)), 0.05, start)?;
/// let energy = plain.energy();
/// let mut errors = [0.0_f64; 2];
/// for _ in 0..400 {
///     plain.advance()?;
///     fitted.advance()?;
///     let changes = [plain.energy() - energy, fitted.energy() - energy];
///     errors = [errors[0].max(changes[0].abs()), errors[1].max(changes[1].abs())];
/// }
/// assert!(errors[0] > 100.0 * errors[1], "{errors:?}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Radial(
    /// How it enters the step.
    pub Reading,
);

impl Frequency for Radial {
    fn reading(&self) -> Option<Reading> {
        Some(self.0)
    }

    #[inline]
    fn at<T: Real>(&self, q: &[T], _v: &[T], a: &[T]) -> T {
        // The reciprocal does not wait for the acceleration.
        let ratio = dot(a, a) * (T::lift(1.0) / dot(q, q));
        // √ has no derivative at zero.
        if ratio == T::lift(0.0) { T::lift(0.0) } else { Scalar::sqrt(Scalar::sqrt(ratio)) }
    }

    fn derivatives<T: Real>(&self, [q, v, a]: [&[T]; 3], [dq, dv, da]: [&mut [T]; 3]) -> Option<T> {
        let omega = self.at(q, v, a);
        let half = T::lift(0.5) * omega;
        // Without an acceleration, where ω = 0 has a kink, the derivative is left out.
        let per_a = if omega == T::lift(0.0) { T::lift(0.0) } else { half / dot(a, a) };
        let per_q = half / dot(q, q);
        dv.fill(T::lift(0.0));
        for i in 0..q.len() {
            da[i] = per_a * a[i];
            dq[i] = -per_q * q[i];
        }
        Some(omega)
    }
}

/// Whether a frequency, or its product with the step, is a finite number.
///
/// # Errors
/// [`StepFailure::Frequency`].
pub(crate) fn defined<T: Real>(omega: T) -> Result<(), StepFailure> {
    if omega.is_finite() { Ok(()) } else { Err(StepFailure::Frequency { omega: norm::reported(omega) }) }
}

/// sin u and what multiplies the new point count as zero below this.
const RESONANCE: f64 = 1e-4;

/// Whether there is a step for u = ωh, with `sinc` = sin u/u and what multiplies the new point times its
/// square.
///
/// # Errors
/// [`StepFailure::Resonance`] where there is none, and [`StepFailure::Frequency`].
#[inline]
pub(crate) fn determined<T: Real>(u: T, sinc: T, cosine_sum: T) -> Result<(), StepFailure> {
    let small = T::lift(RESONANCE);
    if Scalar::abs(sinc) > small && Scalar::abs(cosine_sum) > small {
        return Ok(());
    }
    defined(u)?;
    let u = norm::reported(u);
    let (sine, cosine_sum) = (u * norm::reported(sinc), norm::reported(cosine_sum));
    Err(StepFailure::Resonance { u, sine, cosine_sum })
}
