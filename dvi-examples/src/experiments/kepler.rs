//! Runs on Kepler orbits, as the experiments on them measure them: of general methods, of two rules with the
//! same energy error, and of the state of the art, against which general methods must be seen.
//!
//! The state of the art knows that the force is 1/r². The leapfrog on the logarithmic Hamiltonian stays on
//! the exact orbit and errs in the phase alone; regularisation makes the problem an oscillator, which phase
//! fitting solves exactly.

use crate::vocabulary::*;

pub trait KeplerRun: Run<System = Kepler, Scalar = f64> {}

impl<R: Run<System = Kepler, Scalar = f64>> KeplerRun for R {}

pub trait KeplerMethod: VariableStep<Kepler, f64> {}

impl<M: VariableStep<Kepler, f64>> KeplerMethod for M {}

#[derive(Clone, Copy, Default)]
pub struct Course {
    pub steps: f64,
    /// Evaluations of the force per period, those with its derivative included.
    pub evaluations: f64,
    pub energy: f64,
    /// The largest distance from the exact position, where it was asked for.
    pub position: f64,
}

/// A run that takes more steps for one period has left its orbit.
const MOST_STEPS: u64 = 3_000_000;

/// Follows a run for so many periods, and shows time, E − E(0) and place after each step to `look`.
pub fn follow(
    job: &Job<'_>,
    run: &mut impl KeplerRun,
    periods: u64,
    mut look: impl FnMut((f64, f64, [f64; 2])),
) -> Result<Course> {
    let initial = run.energy();
    let mut course = Course::default();
    for done in 0..periods {
        // Half a millionth of a period: what fixed steps may be short of.
        let end = TAU * (done as f64 + 1.0 - 5e-7);
        let mut steps = 0;
        while run.time() < end {
            let energy = run.energy();
            ensure!(steps < MOST_STEPS, "more than {MOST_STEPS} steps for a period, at E = {energy:.3}");
            steps += 1;
            run.advance()?;
            let change = run.energy() - initial;
            course.energy = larger(course.energy, change.abs());
            look((run.time(), change, place(run)));
        }
        job.proceed(1);
    }
    let statistics = run.statistics();
    let per_period = |count: u64| count as f64 / periods as f64;
    course.steps = per_period(statistics.steps);
    course.evaluations = per_period(statistics.gradients + statistics.linearizations);
    Ok(course)
}

/// Follows a run and compares it with the exact positions as well.
pub fn compare(job: &Job<'_>, run: &mut impl KeplerRun, orbit: Orbit, periods: u64) -> Result<Course> {
    let mut position = 0.0f64;
    let course = follow(job, run, periods, |(t, _, q)| position = larger(position, orbit.error(t, &q)))?;
    Ok(Course { position, ..course })
}

/// A run with `steps` steps of the same length per period.
pub fn fixed(method: impl Method<Kepler, f64>, orbit: Orbit, steps: f64) -> Result<impl KeplerRun> {
    Ok(Integrator::new(Kepler {}, method, TAU / steps, orbit.pericentre())?)
}

/// A run with steps by (23), as printed.
pub fn osculating(method: impl KeplerMethod, orbit: Orbit, tolerance: f64) -> Result<impl KeplerRun> {
    let control = Osculating { tolerance, first_step: 1e-4, centre: CentreSpeed::AsPrinted };
    Ok(ControlledIntegrator::new(Kepler {}, method, control, orbit.pericentre())?)
}

/// A run with steps by (23), v_o read per unit of arc length.
pub fn per_arc_length(method: impl KeplerMethod, orbit: Orbit, tolerance: f64) -> Result<impl KeplerRun> {
    Ok(ControlledIntegrator::new(Kepler {}, method, Osculating::new(tolerance, 1e-4), orbit.pericentre())?)
}

/// A run with steps in proportion to r^(3/2), about 1/ε of them per radian of the motion in the mean.
pub fn reversible(method: impl KeplerMethod, orbit: Orbit, epsilon: f64) -> Result<impl KeplerRun> {
    Ok(ControlledIntegrator::new(Kepler {}, method, Reversible::power(epsilon, 1.5), orbit.pericentre())?)
}

/// Of a factor 1000, down to 10⁻⁴.
pub const BISECTIONS: u32 = 17;

/// How the steps of a run are chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Steps {
    /// All of one length; phase fitting takes (19) as a part of L_d.
    Fixed,
    /// By (23) as printed; phase fitting takes (19) at the left end of a step.
    Controlled,
}
pub use Steps::{Controlled, Fixed};

/// Simpson's rule, phase-fitted, against a linear rule: the largest energy error that both have, and the
/// numbers of steps over one period.
pub struct Comparison {
    pub steps: Steps,
    pub e: f64,
    pub reference: &'static str,
    pub energy: f64,
    pub fitted: f64,
    pub linear: f64,
}

pub const SIMPSON: &str = "Simpson, linear";
pub const REFERENCES: [(&str, Quadrature, Colour); 3] = [
    ("midpoint", Quadrature::midpoint(), BLUE),
    ("trapezoid", Quadrature::trapezoid(), GREEN),
    (SIMPSON, Quadrature::simpson(), SLATE),
];

/// How fine the phase-fitted runs are: steps per period, or the reciprocal of the tolerance.
pub fn finenesses(steps: Steps, e: f64) -> [f64; 3] {
    match steps {
        Fixed if e > 0.9 => [2000.0, 8000.0, 32_000.0],
        Fixed => [500.0, 2000.0, 8000.0],
        Controlled => [1e2, 1e3, 1e4],
    }
}

pub fn equal_errors(job: &Job<'_>, steps: Steps, e: f64, fineness: f64) -> Result<Vec<Comparison>> {
    let reading = if steps == Fixed { Reading::Variational } else { Reading::LeftFrozen };
    let fitted = Variational::new(Quadrature::simpson()).phase_fitted(Curvature(reading));
    let fitted = one_period(job, steps, fitted, e, fineness);
    let fitted = fitted.with_context(|| format!("the phase-fitted run at e = {e}"))?;
    let needed = |&(reference, rule, _): &(&'static str, Quadrature, Colour)| {
        // For the same energy error, by bisection.
        let linear = Variational::new(rule).phase_fitted(Unfitted);
        let (mut low, mut high) = (fineness / 30.0, fineness * 30.0);
        for _ in 0..BISECTIONS {
            let middle = (low * high).sqrt();
            // Very coarse runs may fail: they are too coarse.
            let is_fine = |course: Course| course.energy <= fitted.energy;
            let course = one_period(job, steps, linear, e, middle);
            if course.is_ok_and(is_fine) { high = middle } else { low = middle }
        }
        let linear = one_period(job, steps, linear, e, high)?.steps;
        Ok(Comparison { steps, e, reference, energy: fitted.energy, fitted: fitted.steps, linear })
    };
    REFERENCES.iter().map(needed).collect()
}

fn one_period(job: &Job<'_>, steps: Steps, by: impl KeplerMethod, e: f64, fineness: f64) -> Result<Course> {
    let orbit = Orbit { e };
    match steps {
        Fixed => follow(job, &mut fixed(by, orbit, fineness.round())?, 1, |_| ()),
        Controlled => follow(job, &mut osculating(by, orbit, 1.0 / fineness)?, 1, |_| ()),
    }
}

impl Comparison {
    pub fn ratio(&self) -> f64 {
        self.fitted / self.linear
    }
}

#[derive(Clone, Copy, Default)]
pub struct Rival {
    pub course: Course,
    /// The largest distance |r + ex − (1 − e²)| from the conic section.
    pub off_orbit: f64,
}

/// Physical time, summed with compensation.
#[derive(Clone, Copy, Default)]
struct Clock {
    sum: f64,
    rest: f64,
}

impl Clock {
    fn advance(&mut self, dt: f64) {
        let wanted = dt + self.rest;
        let sum = self.sum + wanted;
        self.rest = wanted - (sum - self.sum);
        self.sum = sum;
    }
}

/// Takes so many steps for each of the periods; each returns the time, the position and the energy.
fn by_period(
    job: &Job<'_>,
    Orbit { e }: Orbit,
    steps: u32,
    periods: u64,
    mut step: impl FnMut() -> (Clock, [f64; 2], f64),
) -> Result<Rival> {
    let (mut course, mut off_orbit) = (Course::default(), 0.0);
    job.repeat(periods, || {
        for _ in 0..steps {
            let (clock, [x, y], energy) = step();
            course.energy = larger(course.energy, (energy + 0.5).abs());
            course.position = larger(course.position, Orbit { e }.error(clock.sum, &[x, y]));
            off_orbit = larger(off_orbit, (x.hypot(y) + e * x - (1.0 - e * e)).abs());
        }
        Ok(())
    })?;
    (course.steps, course.evaluations) = (f64::from(steps), f64::from(steps));
    Ok(Rival { course, off_orbit })
}

/// Leapfrog on Λ = ln(½p² + B) − ln(1/r), B = −E(0), with `steps` steps per period (Mikkola & Tanikawa 1999;
/// Preto & Tremaine 1999): drift dq = p ds/(½p² + B), dt = ds/(½p² + B), kick dp = −q ds/r².
pub fn logarithmic_hamiltonian(job: &Job<'_>, orbit: Orbit, steps: u32, periods: u64) -> Result<Rival> {
    let start = orbit.pericentre();
    let (mut q, mut p) = ([start.x, start.y], [start.dot_x, start.dot_y]);
    let (binding, ds) = (0.5, TAU / f64::from(steps));
    let mut clock = Clock::default();
    // ds = dt/r advances by 2π each period, as the eccentric anomaly does.
    by_period(job, orbit, steps, periods, || {
        let drift = |q: [f64; 2], p: [f64; 2], clock: &mut Clock| {
            let dt = 0.5 * ds / (0.5 * dot(p, p) + binding);
            clock.advance(dt);
            [q[0] + dt * p[0], q[1] + dt * p[1]]
        };
        q = drift(q, p, &mut clock);
        let kick = ds / dot(q, q);
        p = [p[0] - kick * q[0], p[1] - kick * q[1]];
        q = drift(q, p, &mut clock);
        (clock, q, 0.5 * dot(p, p) - 1.0 / q[0].hypot(q[1]))
    })
}

/// Levi-Civita's regularisation with the phase-fitted recursion, `steps` steps per period.
///
/// Time is the integral of |u|² over the exact oscillation:
/// ∫|u|² ds = |u|²(h/2 + sin 2ωh/4ω) + |u'/ω|²(h/2 − sin 2ωh/4ω) + u·u' sin²(ωh)/ω², ω = ½.
pub fn levi_civita(job: &Job<'_>, orbit: Orbit, steps: u32, periods: u64) -> Result<Rival> {
    const OMEGA: f64 = 0.5;
    let Orbit { e } = orbit;
    let h = TAU / f64::from(steps);
    let start = LeviCivitaState { u: [(1.0 - e).sqrt(), 0.0], dot_u: [0.0, OMEGA * (1.0 + e).sqrt()] };
    let method = Variational { fitting: Fitting::PhaseAndMomentum, ..Variational::trapezoid() };
    let mut run = Integrator::new(&LeviCivita {}, method.phase_fitted(Constant(OMEGA)), h, start)?;
    run.advance()?;
    let [mut u, mut next]: [[f64; 2]; 2] = [start.u, [run.q()[0], run.q()[1]]];
    let mut clock = Clock::default();
    let (sin, cos) = (OMEGA * h).sin_cos();
    let half = (2.0 * OMEGA * h).sin() / (4.0 * OMEGA);
    let square = |x: [f64; 2]| dot(x, x);
    let velocity = |u: [f64; 2], next: [f64; 2]| [0, 1].map(|i| OMEGA * (next[i] - cos * u[i]) / sin);
    let mut du = velocity(u, next);
    by_period(job, orbit, steps, periods, || {
        clock.advance(
            square(u) * (0.5 * h + half)
                + square(du) / (OMEGA * OMEGA) * (0.5 * h - half)
                + dot(u, du) * (sin / OMEGA).powi(2),
        );
        // The recursion runs in both directions alike, rounding included.
        (u, next) = (next, [0, 1].map(|i| 2.0 * cos * next[i] - u[i]));
        du = velocity(u, next);
        (clock, [u[0] * u[0] - u[1] * u[1], 2.0 * u[0] * u[1]], (2.0 * square(du) - 1.0) / square(u))
    })
}
