//! Accuracy and cost: the largest error of the energy against evaluations of the gradient, for methods of
//! order 2 to 16, on four vortices, on a Kepler orbit, and on the outer solar system.
//!
//! The cost is counted, not timed, so that it is the same on every machine. The benchmark `accuracy`
//! measures times.

mod claims;
mod picture;
mod problems;

use anyhow::Result;
use rayon::prelude::*;

use crate::claim::larger;
use crate::gallery::{Experiment, Outcome};
use crate::job::Job;
use crate::output::{Table, number};
use problems::Problem;

pub const EXPERIMENT: Experiment = Experiment {
    name: "accuracy-cost",
    title: "Accuracy and cost of methods of order 2 to 16",
    share: 20.0,
    run,
};

/// What one run has cost, and how well it has kept the energy.
#[derive(Clone, Copy, Debug)]
struct Course {
    steps: u64,
    /// Evaluations of ∇H, or of the force.
    evaluations: u64,
    /// Stages that can be evaluated at once.
    stages: u64,
    /// max |H − H(0)| / |H(0)|, over all steps.
    error: f64,
}

impl Course {
    fn evaluations(&self) -> u64 {
        self.evaluations
    }

    /// Evaluations one after another, if all stages of a step are evaluated at once.
    fn in_turn(&self) -> u64 {
        self.evaluations.div_ceil(self.stages)
    }
}

/// The runs of one method on one problem.
struct Series {
    name: &'static str,
    courses: Vec<Course>,
}

impl Series {
    /// The least work of the runs that keep the energy to `bound`.
    fn least(&self, bound: f64, work: fn(&Course) -> u64) -> Option<f64> {
        let within = self.courses.iter().filter(|course| course.error <= bound);
        within.map(work).min().map(|count| count as f64)
    }
}

/// All series of one problem.
struct Measured {
    problem: Problem,
    series: Vec<Series>,
    /// Runs that did not come to their end.
    failures: Vec<String>,
}

impl Measured {
    /// The least number of evaluations with which the method keeps the energy to `bound`.
    fn evaluations(&self, name: &str, bound: f64) -> Option<f64> {
        self.series(name)?.least(bound, Course::evaluations)
    }

    /// The same with the stages of a step counted once.
    fn in_turn(&self, name: &str, bound: f64) -> Option<f64> {
        self.series(name)?.least(bound, Course::in_turn)
    }

    /// The smallest error of the method.
    fn best(&self, name: &str) -> Option<f64> {
        let Series { courses, .. } = self.series(name)?;
        courses.iter().map(|course| course.error).reduce(f64::min)
    }

    fn series(&self, name: &str) -> Option<&Series> {
        self.series.iter().find(|series| series.name == name)
    }
}

fn run(job: &Job<'_>) -> Result<Outcome> {
    let problems = problems::all(job);
    job.expect(problems.iter().map(Problem::steps).sum());
    let measured: Vec<Measured> = problems.into_par_iter().map(|problem| measure(job, problem)).collect();
    job.publish(EXPERIMENT.name, picture::figure(&measured), table(&measured)?)?;
    Ok(Outcome {
        claims: claims::claims(job, &measured),
        references: Vec::new(),
        notes: measured.iter().flat_map(|measured| measured.failures.clone()).collect(),
    })
}

fn measure(job: &Job<'_>, problem: Problem) -> Measured {
    let mut measured = Measured { problem, series: Vec::new(), failures: Vec::new() };
    for contender in &measured.problem.contenders {
        let runs: Vec<_> =
            contender.counts.par_iter().map(|&steps| (steps, (contender.run)(job, steps))).collect();
        let mut series = Series { name: contender.name, courses: Vec::new() };
        for (steps, run) in runs {
            match run {
                Ok(course) => series.courses.push(course),
                Err(error) => {
                    let Problem { name, .. } = measured.problem;
                    measured
                        .failures
                        .push(format!("{name}, {} with {steps} steps: {error}.", contender.name));
                }
            }
        }
        measured.series.push(series);
    }
    measured
}

fn table(all: &[Measured]) -> Result<Table> {
    let columns = ["problem", "method", "steps", "evaluations", "evaluations_in_turn", "energy_error"];
    let mut table = Table::new(&columns)?;
    for Measured { problem, series, .. } in all {
        for Series { name, courses } in series {
            for course in courses {
                let counts =
                    [course.steps, course.evaluations, course.in_turn()].map(|count| count.to_string());
                let names = [problem.name, name].map(str::to_owned);
                table.row(names.into_iter().chain(counts).chain([number(course.error)]))?;
            }
        }
    }
    Ok(table)
}

/// The larger of an error and |`energy` − `initial`| / |`initial`|.
fn noted(error: f64, energy: f64, initial: f64) -> f64 {
    larger(error, ((energy - initial) / initial).abs())
}
