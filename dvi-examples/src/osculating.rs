//! The step control of Kosmas & Vlachos, by the osculating circles at both ends of a step.
//!
//! e = | |R(q1) − R(q0)| − v_o d |, R = 1/k = |v|³/c, c² = |v × a|² = v²a² − (v·a)² (their eq. 23)
//!
//! with the speed v_o = |dR/ds| of the centre of the circle per unit of arc length (their eq. 22), at q0,
//! exactly: Ṙ = |v|(3 v·a/c − v²ċ/c²), c ċ = v²(a·j) − (v·a)(v·j), a = ∂L/∂q, j = ȧ, v_o = |Ṙ|/|v|.
//!
//! As printed, d = h: lengths and times are mixed, and e is of first order in h. The distance that the
//! centre moves is v_o |v| h; with d = |v| h, e is the remainder of a Taylor series, of second order.
//! Neither bounds the error of a step: on a circle e = 0 whatever the method does.

use dvi_core::error::CheckpointError;
use dvi_core::methods::Carries;
use dvi_core::prelude::*;
use dvi_core::run::ControlledRun;
use dvi_core::state::{Memory, Record};
use dvi_core::{Space, Vector, Weights};

/// How far the centre of the osculating circle moves in a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CentreSpeed {
    /// v_o |v| h: v_o is per unit of arc length.
    #[default]
    PerArcLength,
    /// v_o h, as printed.
    AsPrinted,
}

/// Steps for which e is at most a tolerance: the osculating circle of the path changes little in a step.
///
/// A step that is too long, or fails, is undone and tried again. The next length is h·0.9
/// (tolerance/e)^(1/p), between h/5 and 5h, with the order p of e in h. The control is for L = ½ v·v − V(q)
/// on paths that are not straight, which have no osculating circle. It is not reversible, so that energy
/// errors may drift whatever the method; with the distance along the path it may also lock in to a periodic
/// motion, and then they do not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Osculating {
    /// The largest e to accept, a length.
    pub tolerance: f64,
    /// The length of the first step that is tried.
    pub first_step: f64,
    /// Which d is meant.
    pub centre: CentreSpeed,
}

/// The smallest factor from the length of a step to that of the next; after a step that failed too.
const AFTER_FAILURE: f64 = 0.2;

/// The radius of the osculating circle, its rate of change Ṙ, and the speed |v|.
#[derive(Clone, Copy, Debug, Default)]
struct Circle {
    radius: f64,
    rate: f64,
    speed: f64,
}

/// What [`Osculating`] carries from step to step: the circle, and the length of the next step.
#[derive(Debug)]
pub struct OsculatingMemory<S: System> {
    h: f64,
    circle: Circle,
    v: Vector<S, f64>,
    work: [Vector<S, f64>; 3],
}

impl<S: System> Memory<f64> for OsculatingMemory<S> {
    fn restore(&mut self, from: &Self) {
        (self.h, self.circle) = (from.h, from.circle);
    }
    fn save(&self, record: &mut Record<f64>) {
        let Circle { radius, rate, speed } = self.circle;
        record.numbers(&[self.h, radius, rate, speed]);
    }
    fn load(&mut self, record: &mut Record<f64>) -> Result<(), CheckpointError> {
        let mut read = [0.0; 4];
        record.read(&mut read)?;
        let [h, radius, rate, speed] = read;
        (self.h, self.circle) = (h, Circle { radius, rate, speed });
        let is_sound = h != 0.0 && radius > 0.0 && speed > 0.0;
        if is_sound { Ok(()) } else { Err(CheckpointError::Damaged) }
    }
}

/// The osculating circle at (`q`, `v`), by one evaluation of the second derivatives.
fn circle<S: RegularLagrangian>(
    system: &S,
    [q, v]: [&[f64]; 2],
    t: f64,
    work: &mut [Vector<S, f64>; 3],
) -> Circle {
    let [a, j, l_v] = work;
    j.fill(0.0);
    let weights = Weights { qq: 1.0, qv: 0.0, vq: 0.0, vv: 0.0 };
    let mut jerk = |row: usize, column: usize, entry: f64| j[row] += entry * v[column];
    system.linearize(q, v, t, weights, a, l_v, &mut jerk);
    let dot = |x: &[f64], y: &[f64]| x.iter().zip(y).fold(0.0, |sum, (x, y)| sum + x * y);
    let (vv, va, aa, vj, aj) = (dot(v, v), dot(v, a), dot(a, a), dot(v, j), dot(a, j));
    let square = vv * aa - va * va;
    let (speed, c) = (vv.sqrt(), square.sqrt());
    let rate = speed * (3.0 * va - vv * (vv * aj - va * vj) / square) / c;
    Circle { radius: vv * speed / c, rate, speed }
}

impl Osculating {
    /// The control with the deviation d = |v| h.
    pub fn new(tolerance: f64, first_step: f64) -> Self {
        Self { tolerance, first_step, centre: CentreSpeed::default() }
    }

    /// e of a step of length `h` between two circles.
    fn estimate(&self, h: f64, start: Circle, end: Circle) -> f64 {
        let distance = match self.centre {
            CentreSpeed::PerArcLength => (start.rate * h).abs(),
            CentreSpeed::AsPrinted => (start.rate / start.speed * h).abs(),
        };
        ((end.radius - start.radius).abs() - distance).abs()
    }

    /// What h is multiplied with after a step with estimate `e`; the least where that is not a number.
    fn factor(&self, e: f64) -> f64 {
        let order = match self.centre {
            CentreSpeed::PerArcLength => 2.0,
            CentreSpeed::AsPrinted => 1.0,
        };
        let factor = 0.9 * (self.tolerance / e).powf(1.0 / order);
        if factor > 5.0 { 5.0 } else { factor.max(AFTER_FAILURE) }
    }
}

impl<S: System> Carries<S, f64> for Osculating {
    type Memory = OsculatingMemory<S>;
}

impl<S: RegularLagrangian> StepControl<S, f64> for Osculating {
    type Suited<X> = S::Suited<X>;

    const REJECTS: bool = true;

    fn begin(&self, system: &S, q: &[f64], v: &[f64], t: f64) -> Result<(Self::Memory, f64), StartError> {
        let mut work = system.space().vectors();
        let circle = circle(system, [q, v], t, &mut work);
        if !S::SEPARABLE || !(circle.radius + circle.rate).is_finite() {
            let reason = "it needs L = ½ v·v − V(q), and a start that moves on a path that is not straight";
            return Err(StartError::Unsupported { option: "Osculating", reason });
        }
        let h = self.first_step;
        Ok((OsculatingMemory { h, circle, v: system.space().vector(), work }, h))
    }

    fn step<M: Method<S, f64>>(
        &self,
        memory: &mut Self::Memory,
        run: &mut ControlledRun<'_, S, M, f64>,
        t: f64,
    ) -> Result<f64, StepFailure> {
        let OsculatingMemory { h, circle: start, v, work } = memory;
        let (mut length, mut failed) = (*h, None);
        loop {
            let taken = run.step(t, length).and_then(|()| run.velocity(t + length, v));
            let factor = match taken {
                Ok(()) => {
                    run.statistics().linearizations += 1;
                    let circle = circle(run.system(), [run.q(), v], t + length, work);
                    let e = self.estimate(length, *start, circle);
                    if e <= self.tolerance {
                        (*start, *h) = (circle, length * self.factor(e));
                        return Ok(length);
                    }
                    self.factor(e)
                }
                // The failure of a longer step tells more than that the steps became too short.
                Err(failure @ StepFailure::StepLength { .. }) => return Err(failed.unwrap_or(failure)),
                Err(failure) => {
                    failed = Some(failure);
                    AFTER_FAILURE
                }
            };
            run.go_back();
            run.statistics().rejected += 1;
            length *= factor;
        }
    }
}
