//! The symplectic-energy-momentum scheme: steps of such a length that the discrete energy stays the same.
//!
//! The scheme of Kane, Marsden & Ortiz 1999 with the variational midpoint rule, on a spring that stiffens
//! and on a Kepler orbit, beside the same rule with steps of one length: discrete energy, energy, angular
//! momentum, lengths of the steps and distance from the motion. With the trapezoidal rule the scheme ends
//! where its equation has no solution.

mod claims;
mod ending;
mod picture;
mod series;

use anyhow::Result;
use dvi_core::prelude::*;

use crate::claim::larger;
use crate::gallery::{Experiment, Outcome};
use crate::job::Job;
use crate::models::{Kepler, Orbit, StiffeningSpring, StiffeningSpringState};
use ending::Ending;
use series::Series;

pub const EXPERIMENT: Experiment = Experiment {
    name: "energy-momentum",
    title: "Steps that keep the discrete energy, and where there are none",
    share: 1.5,
    run,
};

const START: StiffeningSpringState = StiffeningSpringState { x: 1.0, y: 0.3, dot_x: 0.0, dot_y: 0.5 };
const ORBIT: Orbit = Orbit { e: 0.5 };
/// The lengths of the first steps, the longest first.
const ON_SPRING: [f64; 4] = [0.1, 0.05, 0.025, 0.0125];
const ON_ORBIT: [f64; 4] = [0.02, 0.01, 0.005, 0.0025];
/// The time up to which runs are compared with the motion.
const COMPARED: f64 = 50.0;
/// The time between two points of the reference.
const FINE: f64 = 0.02;

/// A system with a start and with what is known of it.
struct Motion<'a, S: RegularLagrangian<f64>> {
    name: &'static str,
    system: &'a S,
    start: fn() -> S::State<f64>,
    /// V as a function of r².
    potential: fn(f64) -> f64,
    /// Where the particle is at a time.
    position: &'a dyn Fn(f64) -> [f64; 2],
}

/// The runs that belong to one length of the first step.
struct Runs {
    /// With steps that keep the discrete energy.
    kept: Series,
    /// With as many steps of one length, the mean of those.
    mean: Series,
    /// With steps of one length and at most as many evaluations of derivatives in the same time as with
    /// those of the first kind.
    work: Series,
}

/// All that is measured.
struct Measured {
    /// By the length of the first step.
    spring: [Runs; 4],
    kepler: [Runs; 4],
    /// The largest distance of two references for the spring.
    between_references: f64,
    ending: Ending,
}

/// Points of the motion of the spring at multiples of a time.
struct Reference {
    every: f64,
    states: Vec<StiffeningSpringState>,
}

fn run(job: &Job<'_>) -> Result<Outcome> {
    let steps = job.choose(100_000, 10_000);
    job.expect(2 * steps * (ON_SPRING.len() + ON_ORBIT.len()) as u64);
    let [fine, double] = [FINE, 2.0 * FINE].map(Reference::new);
    let (fine, double) = (fine?, double?);
    let spring = Motion {
        name: "spring",
        system: &StiffeningSpring {},
        start: || START,
        potential: |r2| r2 / 2.0 + r2 * r2 / 4.0,
        position: &|t| fine.position(t),
    };
    let kepler = Motion {
        name: "Kepler",
        system: &Kepler {},
        start: || ORBIT.pericentre(),
        potential: |r2| -1.0 / r2.sqrt(),
        position: &|t| ORBIT.position(t),
    };
    let measured = Measured {
        spring: all(job, &spring, ON_SPRING, steps)?,
        kepler: all(job, &kepler, ON_ORBIT, steps)?,
        between_references: fine.distance(&double),
        ending: Ending::new()?,
    };
    job.publish(EXPERIMENT.name, picture::figure(&measured), picture::table(&measured)?)?;
    Ok(Outcome { claims: claims::claims(&measured), references: vec![], notes: vec![] })
}

fn all<S: RegularLagrangian<f64>>(
    job: &Job<'_>,
    motion: &Motion<'_, S>,
    lengths: [f64; 4],
    steps: u64,
) -> Result<[Runs; 4]> {
    let [first, second, third, fourth] = lengths.map(|h| Runs::new(job, motion, h, steps));
    Ok([first?, second?, third?, fourth?])
}

impl Runs {
    fn new<S: RegularLagrangian<f64>>(
        job: &Job<'_>,
        motion: &Motion<'_, S>,
        h: f64,
        steps: u64,
    ) -> Result<Self> {
        let (rule, start) = (Variational::midpoint(), motion.start);
        let control = EnergyMomentum::new(h);
        let run = ControlledIntegrator::new(motion.system, rule, control, start())?;
        let kept = Series::new(job, "energy-momentum", motion, run, steps)?;
        // A run that was interrupted at its beginning has no mean length.
        let usable = |length: f64| if length > 0.0 && length.is_finite() { length } else { h };
        let h = usable(kept.mean_length());
        let run = Integrator::new(motion.system, rule, h, start())?;
        let mean = Series::new(job, "one length", motion, run, steps)?;
        let h = usable(h * mean.work_of_a_step() / kept.work_of_a_step());
        let run = Integrator::new(motion.system, rule, h, start())?;
        let steps = (COMPARED / h).ceil() as u64;
        job.expect(steps);
        let work = Series::new(job, "one length, same work", motion, run, steps)?;
        Ok(Self { kept, mean, work })
    }
}

impl Reference {
    fn new(every: f64) -> Result<Self> {
        let mut run = Integrator::new(&StiffeningSpring {}, Gauss::<4>::new(), every, START)?;
        let mut states = vec![START];
        for _ in 0..(COMPARED / every).round() as u64 {
            run.advance()?;
            states.push(run.state());
        }
        Ok(Self { every, states })
    }

    /// By one step from the last point before; not a number beyond the end.
    fn position(&self, t: f64) -> [f64; 2] {
        let index = (t / self.every).floor();
        let rest = t - index * self.every;
        let Some(&state) = self.states.get(index as usize) else { return [f64::NAN; 2] };
        let system = StiffeningSpring {};
        // A rest below zero is one of rounding.
        let Ok(mut run) = Integrator::new(&system, Gauss::<4>::new(), rest.max(1e-12), state) else {
            return [f64::NAN; 2];
        };
        run.advance().map_or([f64::NAN; 2], |()| [run.q()[0], run.q()[1]])
    }

    /// The largest distance from one with points twice as far apart.
    fn distance(&self, double: &Self) -> f64 {
        let pairs = self.states.iter().step_by(2).zip(&double.states);
        pairs.map(|(a, b)| (a.x - b.x).hypot(a.y - b.y)).fold(0.0, larger)
    }
}
