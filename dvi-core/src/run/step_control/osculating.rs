//! The step control of Kosmas & Vlachos, by the osculating circles at both ends of a step.
//!
//! e = | |R(q1) − R(q0)| − v_o d |, R = 1/k = |v|³/c, c² = |v × a|² = v²a² − (v·a)² (their eq. 23)
//!
//! with the speed v_o = |dR/ds| of the centre of the circle per unit of arc length (their eq. 22), at q0,
//! exactly: Ṙ = |v|(3 v·a/c − v²ċ/c²), c ċ = v²(a·j) − (v·a)(v·j), a = M⁻¹∂L/∂q, j = ȧ, v_o = |Ṙ|/|v|.
//!
//! As printed, d = h: lengths and times are mixed, and e is of first order in h. The distance that the
//! centre moves is v_o |v| h; with d = |v| h, e is the remainder of a Taylor series, of second order.
//! Neither bounds the error of a step: on a circle e = 0 whatever the method does.

use super::rejection::{Accepted, Verdict, step_of_at_most, within};
use super::{ControlledRun, StepControl};
use crate::error::{StartError, StepFailure};
use crate::mechanics::mass::Mass;
use crate::memory::{Memory, lasting};
use crate::methods::{Carries, Method};
use crate::{Real, RegularLagrangian, Scalar, Space, System, Vector, Weights};

/// How far the centre of the osculating circle moves in a step.
///
/// ```
#[doc = include_str!("../../../docs/hidden/kepler.txt")]
/// let reached = |centre| -> Result<f64, Box<dyn std::error::Error>> {
///     let control = Osculating { centre, ..Osculating::new(1e-3, 0.01) };
///     let mut run = Integrator::controlled(&Kepler, Variational::trapezoid(), control, start.clone())?;
///     run.take_steps(100)?;
///     Ok(run.time())
/// };
/// assert_ne!(reached(CentreSpeed::PerArcLength)?, reached(CentreSpeed::AsPrinted)?);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CentreSpeed {
    /// v_o |v| h: v_o is per unit of arc length.
    #[default]
    PerArcLength,
    /// v_o h, as printed.
    AsPrinted,
}

impl CentreSpeed {
    /// The power of h that e is proportional to.
    fn order(self) -> f64 {
        match self {
            Self::PerArcLength => 2.0,
            Self::AsPrinted => 1.0,
        }
    }
}

/// Steps for which $`\left| |1/k_1 - 1/k_2| - v_o d \right|`$ is at most a tolerance (Kosmas & Vlachos, eq.
/// 23): the osculating circle of the path changes little in a step.
///
/// A step that is too long, or fails, is undone and tried again. The next length is h·0.9
/// (tolerance/e)^(1/p), between h/5 and 5h, with the order p of the error e in h. The control is for L = ½
/// v·M v − V(q) with a constant matrix M and forces without velocities, and for the curvature of the path in
/// the Euclidean metric of the coordinates; a V that depends on time explicitly does so in the acceleration,
/// but not in its rate of change. It is not available on straight paths, which have no osculating circle.
///
/// It is here for comparison. It is not reversible, so that energy errors may drift whatever the method.
/// With the distance along the path it may also lock in to a periodic motion, and then they do not: the
/// gallery shows both. [`Reversible`](super::Reversible) is better and cheaper.
///
/// ```
#[doc = include_str!("../../../docs/hidden/kepler.txt")]
/// let control = Osculating::new(1e-3, 0.01);
/// let mut run = Integrator::controlled(&Kepler, Variational::trapezoid(), control, start)?;
/// let energy = run.energy();
/// run.take_steps(1000)?;
/// assert!((run.energy() - energy).abs() < 1e-2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Osculating {
    /// The largest e to accept, a length.
    pub tolerance: f64,
    /// The length of the first step that is tried; negative to run back in time.
    pub first_step: f64,
    /// Which d is meant. Default: the distance along the path.
    pub centre: CentreSpeed,
}

impl Osculating {
    /// The control with the deviation d = |v| h.
    pub fn new(tolerance: f64, first_step: f64) -> Self {
        Self { tolerance, first_step, centre: CentreSpeed::default() }
    }
}

/// The smallest factor from the length of a step to that of the next; after a step that failed too.
const AFTER_FAILURE: f64 = 0.2;

/// The radius of the osculating circle, its rate of change Ṙ, and the speed |v|.
#[derive(Clone, Copy, Debug)]
struct Circle<T> {
    radius: T,
    rate: T,
    speed: T,
}

/// What [`Osculating`] carries from step to step.
#[derive(Debug)]
pub struct OsculatingMemory<S: System, T: Real> {
    /// The length of the next step.
    h: T,
    circle: Circle<T>,
    mass: Mass<S, T>,
    v: Vector<S, T>,
    work: Work<S, T>,
}

#[derive(Debug)]
struct Work<S: System, T: Real> {
    acceleration: Vector<S, T>,
    jerk: Vector<S, T>,
    l_q: Vector<S, T>,
    l_v: Vector<S, T>,
    /// ∂²L/∂q∂q v
    force_rate: Vector<S, T>,
}

impl<S: System, T: Real> OsculatingMemory<S, T> {
    #[cfg(feature = "alloc")]
    fn is_sound(&self) -> bool {
        let zero = T::lift(0.0);
        self.h != zero && self.circle.radius > zero && self.circle.speed > zero
    }
}

impl<S: System, T: Real> Memory<T> for OsculatingMemory<S, T> {
    lasting!(T; number h, part circle; is_sound);
}

impl<T: Real> Memory<T> for Circle<T> {
    lasting!(T; number radius, number rate, number speed);
}

impl<S: RegularLagrangian<T>, T: Real> Work<S, T> {
    /// The osculating circle at (`q`, `v`), by one evaluation of the second derivatives.
    fn circle(&mut self, system: &S, mass: &Mass<S, T>, q: &[T], v: &[T], t: T) -> Circle<T> {
        let (zero, one) = (T::lift(0.0), T::lift(1.0));
        let Self { acceleration, jerk, l_q, l_v, force_rate } = self;
        force_rate.fill(zero);
        let mut product = |i: usize, j: usize, entry: T| force_rate[i] += entry * v[j];
        system.linearize(q, v, t, Weights { qq: one, qv: zero, vq: zero, vv: zero }, l_q, l_v, &mut product);
        mass.solve(l_q, acceleration);
        mass.solve(force_rate, jerk);
        let dot = |x: &[T], y: &[T]| x.iter().zip(y).fold(zero, |sum, (&x, &y)| sum + x * y);
        let (vv, va, aa) = (dot(v, v), dot(v, acceleration), dot(acceleration, acceleration));
        let (vj, aj) = (dot(v, jerk), dot(acceleration, jerk));
        let square = vv * aa - va * va;
        let (speed, c) = (Scalar::sqrt(vv), Scalar::sqrt(square));
        let rate = speed * (T::lift(3.0) * va - vv * (vv * aj - va * vj) / square) / c;
        Circle { radius: vv * speed / c, rate, speed }
    }
}

impl Osculating {
    /// e of a step of length `h` between two circles.
    fn estimate<T: Real>(&self, h: T, start: Circle<T>, end: Circle<T>) -> T {
        let distance = match self.centre {
            CentreSpeed::PerArcLength => Scalar::abs(start.rate * h),
            CentreSpeed::AsPrinted => Scalar::abs(start.rate / start.speed * h),
        };
        Scalar::abs(Scalar::abs(end.radius - start.radius) - distance)
    }

    /// What h is multiplied with after a step with estimate `e`.
    fn factor<T: Real>(&self, e: T) -> T {
        let ratio = Scalar::powf(T::lift(self.tolerance) / e, T::lift(1.0 / self.centre.order()));
        within(T::lift(0.9) * ratio, AFTER_FAILURE, 5.0)
    }
}

impl<S: System, T: Real> Carries<S, T> for Osculating {
    type Memory = OsculatingMemory<S, T>;
}

impl<S: RegularLagrangian<T>, T: Real> StepControl<S, T> for Osculating {
    type Suited<X> = S::Suited<X>;

    const REJECTS: bool = true;

    fn begin(&self, system: &S, q: &[T], v: &[T], t: T) -> Result<(Self::Memory, T), StartError> {
        super::validate(self.tolerance, self.first_step)?;
        if !S::SEPARABLE {
            let reason =
                "it needs L = ½ v·M v − V(q) with a constant matrix M, and forces without velocities";
            return Err(StartError::Unsupported { option: "Osculating", reason });
        }
        let mass = Mass::new(system, q, t).map_err(StartError::Starter)?;
        let [acceleration, jerk, l_q, l_v, force_rate] = system.space().vectors();
        let mut work = Work { acceleration, jerk, l_q, l_v, force_rate };
        let circle = work.circle(system, &mass, q, v, t);
        if !(circle.radius + circle.rate).is_finite() {
            let reason = "the start has no osculating circle: it is at rest, or its path is straight";
            return Err(StartError::Unsupported { option: "Osculating", reason });
        }
        let h = T::lift(self.first_step);
        Ok((OsculatingMemory { h, circle, mass, v: system.space().vector(), work }, h))
    }

    fn step<M: Method<S, T>>(
        &self,
        memory: &mut Self::Memory,
        run: &mut ControlledRun<'_, S, M, T>,
        t: T,
    ) -> Result<T, StepFailure> {
        let OsculatingMemory { h, circle: start, mass, v, work } = memory;
        let Accepted { h: taken, found: (circle, factor), .. } =
            step_of_at_most(run, t, *h, AFTER_FAILURE, |run, h| {
                run.velocity(t + h, v)?;
                run.stepper.statistics.linearizations += 1;
                let circle = work.circle(run.system(), mass, run.q(), v, t + h);
                let e = self.estimate(h, *start, circle);
                let factor = self.factor(e);
                Ok(if e <= T::lift(self.tolerance) {
                    Verdict::Accepted((circle, factor))
                } else {
                    Verdict::TooLong { factor, failure: None }
                })
            })?;
        *start = circle;
        *h = taken * factor;
        Ok(taken)
    }
}
