//! Runs of general methods on Kepler orbits, as the experiments on them measure them.

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
    /// The largest distance |r + ex − (1 − e²)| from the conic section, of regularised runs.
    pub off_orbit: f64,
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
    for period in 1..=periods {
        // Half a millionth of a period: what fixed steps may be short of.
        let end = TAU * (period as f64 - 5e-7);
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

pub fn fixed(method: impl Method<Kepler, f64>, orbit: Orbit, steps: f64) -> Result<impl KeplerRun> {
    Ok(Integrator::new(Kepler {}, method, TAU / steps, orbit.pericentre())?)
}

pub fn osculating(method: impl KeplerMethod, orbit: Orbit, tolerance: f64) -> Result<impl KeplerRun> {
    let control = Osculating { tolerance, first_step: 1e-4, centre: CentreSpeed::AsPrinted };
    Ok(Integrator::controlled(Kepler {}, method, control, orbit.pericentre())?)
}

/// A run with steps by (23), v_o read per unit of arc length.
pub fn per_arc_length(method: impl KeplerMethod, orbit: Orbit, tolerance: f64) -> Result<impl KeplerRun> {
    Ok(Integrator::controlled(Kepler {}, method, Osculating::new(tolerance, 1e-4), orbit.pericentre())?)
}

/// A run with steps in proportion to r^(3/2), about 1/ε of them per radian of the motion in the mean.
pub fn reversible(method: impl KeplerMethod, orbit: Orbit, epsilon: f64) -> Result<impl KeplerRun> {
    Ok(Integrator::controlled(Kepler {}, method, Reversible::power(epsilon, 1.5), orbit.pericentre())?)
}
