//! Where runs of four equal vortices meet a Poincaré section, for Figs. 4 and 5.
//!
//! With Q_n = ½ Σ_a z_{a+1} e^{−2πi na/4} and φ = arg Q₃: R₁ + iP₁ = Q₂e^{−iφ}, R₂ = Im Q₁e^{−iφ}, and the
//! section is R₂ = 0, dR₂/dt > 0. These pairs are canonical and remove translation and rotation, but the
//! coordinates that Pullin & Saffman used, and the paper with them, may be others.

use crate::vocabulary::*;

/// The schemes that the sections compare: VI2 with σ = ½, RK4, and Gauss collocation of order six.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scheme {
    Vi2,
    Rk4,
    Gauss6,
}

impl Scheme {
    pub fn name(self) -> &'static str {
        match self {
            Scheme::Vi2 => "VI2",
            Scheme::Rk4 => "RK4",
            Scheme::Gauss6 => "Gauss6",
        }
    }
}

pub const fn runs([small, middle, large]: [f64; 3]) -> [(Scheme, f64); 6] {
    let (vi2, rk4) = (Scheme::Vi2, Scheme::Rk4);
    [(vi2, small), (vi2, middle), (vi2, large), (rk4, small), (rk4, middle), (rk4, large)]
}

#[derive(Clone)]
pub struct Crossings {
    pub scheme: Scheme,
    pub h: f64,
    pub end: f64,
    pub labels: Labels,
    /// [t, R₁, P₁] of each crossing.
    pub points: Vec<[f64; 3]>,
    /// H − H(0); the beginning is the first tenth of the time.
    pub error: Envelope,
    /// By what factor a displacement of 1e-10 at the end grows in 2000 units of time more.
    pub growth: f64,
    pub failure: Option<StepError>,
}

/// The orders of the vortices, which are equal: up to symmetry there are these three.
pub type Labels = [usize; 4];
pub const LABELS: [Labels; 3] = [[0, 1, 2, 3], [0, 2, 1, 3], [0, 1, 3, 2]];

impl Crossings {
    pub fn last(&self) -> f64 {
        self.points.last().map_or(0.0, |&[t, ..]| t)
    }

    pub fn places(&self) -> Vec<[f64; 2]> {
        self.points.iter().map(|&[_, r1, p1]| [r1, p1]).collect()
    }
}

/// R₁, P₁ and R₂ of a state.
fn coordinates(state: &FourPoints, labels: Labels) -> [f64; 3] {
    let [x, y] = [state.x, state.y].map(|all| labels.map(|j| all[j]));
    let (ux, uy) = (x[0] - x[2], y[0] - y[2]);
    let (wx, wy) = (x[1] - x[3], y[1] - y[3]);
    let q1 = [0.5 * (ux + wy), 0.5 * (uy - wx)];
    let q2 = [0.5 * (x[0] - x[1] + x[2] - x[3]), 0.5 * (y[0] - y[1] + y[2] - y[3])];
    let q3 = [0.5 * (ux - wy), 0.5 * (uy + wx)];
    let length = q3[0].hypot(q3[1]);
    let (cos, sin) = (q3[0] / length, q3[1] / length);
    [q2[0] * cos + q2[1] * sin, q2[1] * cos - q2[0] * sin, q1[1] * cos - q1[0] * sin]
}

pub fn cost(runs: &[(Scheme, f64)], end: f64) -> u64 {
    runs.iter().map(|(_, h)| (end / h) as u64).sum()
}

#[derive(Clone, Copy)]
pub struct Motion<'a> {
    pub job: &'a Job<'a>,
    pub case: &'a Case,
    pub end: f64,
}

pub const LYAPUNOV_STEPS: u64 = 100_000;

impl Motion<'_> {
    pub fn compare<const N: usize>(self, runs: [(Scheme, f64); N]) -> Result<[Crossings; N]> {
        side_by_side(runs, |run| self.crossings(run, LABELS[0]))
    }

    /// The section of one run with the vortices in the given order.
    pub fn crossings(self, (scheme, h): (Scheme, f64), labels: Labels) -> Result<Crossings> {
        let (end, points, error) = (self.end, Vec::new(), Envelope::new(self.end, 300, 0.1 * self.end));
        let blank = Crossings { scheme, h, end, labels, points, error, growth: f64::NAN, failure: None };
        match scheme {
            Scheme::Vi2 => self.gather(Sigma::midpoint(), blank),
            Scheme::Rk4 => self.gather(RungeKutta::classical(), blank),
            Scheme::Gauss6 => self.gather(Gauss::<3>::new(), blank),
        }
    }

    fn gather(self, method: impl Method<FourVortices, f64> + Copy, mut all: Crossings) -> Result<Crossings> {
        let Self { job, case: Case { vortices, start }, end } = self;
        let (h, labels) = (all.h, all.labels);
        let mut run = Integrator::new(vortices, method, h, *start)?;
        let (initial, steps) = (run.energy(), (end / h) as u64);
        let height = |state: &FourPoints| coordinates(state, labels)[2];
        let mut before = height(&run.state());
        let mut events = run.events([Direction::Rising], |_, state| [height(state)])?;
        let mut done = 0;
        while done < steps {
            let found = events.advance();
            let after = height(&events.run().state());
            match found {
                // Where the motion only touches the section within a step, the place is as accurate as the
                // root of the error of the step.
                Ok(Some(Event { time, state, .. })) if before < 0.0 && after >= 0.0 => {
                    let [r1, p1, _] = coordinates(&state, labels);
                    all.points.push([time, r1, p1]);
                }
                Ok(_) => {}
                Err(error) => {
                    all.failure = Some(error);
                    break;
                }
            }
            let run = events.run();
            if run.steps() > done {
                (done, before) = (run.steps(), after);
                all.error.push(run.time(), run.energy() - initial);
                job.proceed(1);
            }
        }
        job.proceed(steps - done);
        all.growth = growth(vortices, run.state(), method, h).unwrap_or(f64::NAN);
        Ok(all)
    }

    /// The largest Lyapunov exponent by the tangent map of VI2 (h = 0.2, t = 2·10⁴).
    pub fn lyapunov_exponent(self) -> Result<Option<f64>> {
        let mut run = Integrator::new(&self.case.vortices, Sigma::midpoint(), 0.2, self.case.start)?;
        let mut exponent = LyapunovExponent::new(&run);
        self.job.repeat(LYAPUNOV_STEPS, || exponent.advance(&mut run))?;
        Ok(exponent.exponent())
    }
}

/// By what factor a small displacement grows in 2000 units of time: exponential growth reaches the size
/// of the motion and saturates at some 1e10, on a torus the growth is linear.
fn growth<M>(vortices: &FourVortices, start: FourPoints, method: M, h: f64) -> Result<f64>
where
    M: Method<FourVortices, f64> + Copy,
{
    const DISPLACEMENT: f64 = 1e-10;
    let mut displaced = start;
    displaced.x[0] += DISPLACEMENT;
    let end = |start| Problem::new(vortices, start).up_to(method, h, 2000.0);
    Ok(Problem::new(vortices, start).apart(&end(start)?, &end(displaced)?)? / DISPLACEMENT)
}
