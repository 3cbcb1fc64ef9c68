//! Accuracy and cost: the largest error of the energy against evaluations of the gradient, for methods of
//! order 2 to 16, on four vortices, on a Kepler orbit, and on the outer solar system.
//!
//! The cost is counted, not timed, so that it is the same on every machine. The benchmark `accuracy`
//! measures times.

use dvi_core::discrete::{Trapezoid, Unfitted};
use rayon::prelude::*;

use crate::models::{Case, Kepler, Orbit, outer_solar_system, quasi_periodic};
use crate::vocabulary::*;

/// The methods, with the number of stages that can be evaluated at once.
#[rustfmt::skip]
const METHODS: [(&str, u64, Colour); 6] = [
    ("order 2",    1, SLATE),
    ("RK4",        1, INK),
    ("Kahan–Li 8", 1, GREEN),
    ("Gauss 4",    2, AMBER),
    ("Gauss 8",    4, VERMILLION),
    ("Gauss 16",   8, BLUE),
];
const RK4: usize = 1;
const KAHAN_LI: usize = 2;
const GAUSS_16: usize = 5;

/// What one run has cost, and how well it has kept the energy.
struct Course {
    steps: u64,
    /// Evaluations of ∇H, or of the force.
    evaluations: u64,
    /// The same one after another, if all stages of a step are evaluated at once.
    in_turn: u64,
    /// max |H − H(0)| / |H(0)|, over all steps.
    error: f64,
}

/// How the work of a run is counted.
type Work = fn(&Course) -> u64;

/// A motion up to one time.
struct Problem {
    name: &'static str,
    title: String,
    /// The most steps of each of [`METHODS`].
    most: [f64; 6],
    /// A run by one of them with a number of steps.
    run: Box<Steps>,
}

type Steps = dyn Fn(&Job<'_>, usize, u64) -> Result<Course> + Send + Sync;

/// All runs of one problem: those of each of the methods.
struct Measured {
    problem: Problem,
    courses: [Vec<Course>; 6],
    /// Runs that did not come to their end.
    failures: Vec<String>,
}

impl Measured {
    /// The least work with which the method keeps the energy to `bound`.
    fn least(&self, method: usize, bound: f64, work: Work) -> Option<f64> {
        let within = self.courses[method].iter().filter(|course| course.error <= bound);
        within.map(work).min().map(|count| count as f64)
    }

    /// How much more one method takes than another.
    fn ratio(&self, [of, to]: [usize; 2], bound: f64, work: Work) -> Option<f64> {
        Some(self.least(of, bound, work)? / self.least(to, bound, work)?)
    }
}

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    // Many runs in a full one, and few that are shorter.
    let (runs, ratio) = job.choose((33, 2f64.powf(0.25)), (5, 4.0));
    let share = job.choose(1.0, 0.05);
    let counts =
        |most: f64| (0..runs).rev().map(|k| (most / ratio.powi(k)).round() as u64).collect::<Vec<_>>();
    let problems = [vortices(share), kepler(share), planets(share)];
    job.expect(problems.iter().flat_map(|problem| problem.most.map(counts)).flatten().sum());
    let measure = |problem: Problem| {
        let mut measured = Measured { problem, courses: Default::default(), failures: Vec::new() };
        for (method, (name, ..)) in METHODS.into_iter().enumerate() {
            let counts = counts(measured.problem.most[method]);
            let run = |&steps| (steps, (measured.problem.run)(job, method, steps));
            for (steps, run) in counts.par_iter().map(run).collect::<Vec<_>>() {
                match run {
                    Ok(course) => measured.courses[method].push(course),
                    Err(error) => {
                        let problem = measured.problem.name;
                        measured.failures.push(format!("{problem}, {name} with {steps} steps: {error}."));
                    }
                }
            }
        }
        measured
    };
    let all: Vec<Measured> = problems.into_par_iter().map(measure).collect();
    let all: [Measured; 3] = all.try_into().ok().context("three problems")?;
    let columns = ["problem", "method", "steps", "evaluations", "evaluations_in_turn", "energy_error"];
    let rows = all.iter().flat_map(|Measured { problem, courses, .. }| {
        courses.iter().zip(METHODS).flat_map(move |(courses, (name, ..))| {
            courses.iter().map(move |course| {
                let counts = [course.steps, course.evaluations, course.in_turn].map(|count| count as f64);
                ([problem.name, name], counts.into_iter().chain([course.error]))
            })
        })
    });
    job.publish(figure(&all), Table::of(&columns, rows)?)?;
    let notes = all.iter().flat_map(|measured| measured.failures.clone()).collect();
    Ok(Outcome { claims: claims(job, &all), references: vec![], notes })
}

/// One run, its energy looked at after each step.
fn follow<S: Lagrangian>(
    job: &Job<'_>,
    (system, start): (S, S::State<f64>),
    method: impl Method<S, f64>,
    stages: u64,
    [end, steps]: [f64; 2],
) -> Result<Course> {
    let mut run = Integrator::new(&system, method, end / steps, start)?;
    let (initial, mut error, steps) = (run.energy(), 0.0, steps as u64);
    job.follow(&mut run, steps, |run| error = larger(error, ((run.energy() - initial) / initial).abs()))?;
    let statistics = run.statistics();
    let evaluations = statistics.gradients + statistics.linearizations;
    Ok(Course { steps, evaluations, in_turn: evaluations.div_ceil(stages), error })
}

/// A run by one of [`METHODS`], of which the first and the third are those of the problem.
fn by<S: Lagrangian>(
    job: &Job<'_>,
    begin: (S, S::State<f64>),
    second: impl Method<S, f64>,
    composed: impl Method<S, f64>,
    method: usize,
    span: [f64; 2],
) -> Result<Course>
where
    RungeKutta: Method<S, f64>,
    Gauss<2>: Method<S, f64>,
    Gauss<4>: Method<S, f64>,
    Gauss<8>: Method<S, f64>,
{
    let stages = METHODS[method].1;
    match method {
        0 => follow(job, begin, second, stages, span),
        RK4 => follow(job, begin, RungeKutta::classical(), stages, span),
        KAHAN_LI => follow(job, begin, composed, stages, span),
        3 => follow(job, begin, Gauss::<2>::new(), stages, span),
        4 => follow(job, begin, Gauss::<4>::new(), stages, span),
        _ => follow(job, begin, Gauss::<8>::new(), stages, span),
    }
}

fn vortices(share: f64) -> Problem {
    let end = 1000.0 * share;
    Problem {
        name: "vortices",
        title: format!("Four vortices, up to *t* = {end}"),
        most: [1e6, 3e5, 2e4, 2e5, 2e4, 4e3].map(|most| most * share),
        run: Box::new(move |job, method, steps| {
            let Case { vortices, start } = quasi_periodic();
            let composed = Composition::kahan_li_8(Gauss::<1>::new());
            by(job, (vortices, start), Sigma::midpoint(), composed, method, [end, steps as f64])
        }),
    }
}

/// Compensated sums, as those of Gauss collocation are.
fn verlet() -> Variational<Unfitted, Trapezoid> {
    Variational { summation: Summation::Compensated, ..Variational::trapezoid() }
}

fn kepler(share: f64) -> Problem {
    let periods = (100.0 * share).round();
    Problem {
        name: "kepler",
        title: format!("Kepler orbit, *e* = 0.6, {periods} periods"),
        most: [2e6, 5e5, 4e4, 4e5, 4e4, 8e3].map(|most| most * share),
        run: Box::new(move |job, method, steps| {
            let begin = (Kepler {}, Orbit { e: 0.6 }.pericentre());
            let composed = Composition::kahan_li_8(verlet());
            by(job, begin, verlet(), composed, method, [TAU * periods, steps as f64])
        }),
    }
}

fn planets(share: f64) -> Problem {
    let end = 1e6 * share;
    let days = if share == 1.0 { "10⁶".to_owned() } else { end.to_string() };
    Problem {
        name: "planets",
        title: format!("Outer solar system, {days} days"),
        most: [1e6, 2e5, 2e4, 2e5, 2e4, 4e3].map(|most| most * share),
        run: Box::new(move |job, method, steps| {
            let composed = Composition::kahan_li_8(verlet());
            by(job, outer_solar_system(), verlet(), composed, method, [end, steps as f64])
        }),
    }
}

fn claims(job: &Job<'_>, all: &[Measured; 3]) -> Vec<Claim> {
    let [vortices, _, planets] = all;
    let named = || ["vortices", "Kepler", "outer solar system"].into_iter().zip(all);
    let best =
        |of: &Measured| job.only_full(of.courses[GAUSS_16].iter().map(|run| run.error).reduce(f64::min));
    let fewer =
        |of: &Measured, pair, bound| job.only_full(of.ratio(pair, bound, |course| course.evaluations));
    let at_once =
        |of: &Measured| job.only_full(of.ratio([KAHAN_LI, GAUSS_16], 1e-13, |course| course.in_turn));
    let [rk4, kahan_li] = [[RK4, GAUSS_16], [KAHAN_LI, GAUSS_16]];
    vec![
        beyond("Gauss collocation of order 16 keeps the energy to rounding errors")
            .each(named(), |claim, (name, of)| {
                claim.of(name).at_most("smallest max|ΔH|/|H|", best(of), 1e-14)
            }),
        beyond("for 1e-13 it needs fewer evaluations than Kahan–Li 8").each(
            named().zip([5.0, 2.0, 1.5]),
            |claim, ((name, of), low)| {
                claim.of(name).at_least("Kahan–Li 8 / Gauss 16", fewer(of, kahan_li, 1e-13), low)
            },
        ),
        beyond("with its stages at once it makes many fewer one after another")
            .each(named().zip([40.0, 16.0, 12.0]), |claim, ((name, of), low)| {
                claim.at_least(format!("{name}, stages at once"), at_once(of), low)
            }),
        beyond("for 1e-6 it does not: other methods need fewer evaluations")
            .at_most("vortices, 1e-6: RK4 / Gauss 16", fewer(vortices, rk4, 1e-6), 1.0)
            .at_most("outer solar system, 1e-6: Kahan–Li 8 / Gauss 16", fewer(planets, kahan_li, 1e-6), 1.0),
    ]
}

/// A column for each problem, with evaluations counted all, and those counted once that can be made together.
fn figure(all: &[Measured; 3]) -> Figure {
    let panel = |measured: &Measured, label: &str, work: Work| {
        let x = Axis::logarithmic(label).within(2e3, 4e6);
        let y = Axis::logarithmic("max|Δ*H*| / |*H*|").within(1e-16, 1.0);
        let methods = METHODS.into_iter().zip(&measured.courses);
        Panel::new(measured.problem.title.clone(), x, y).each(
            methods,
            |panel, ((name, _, colour), courses)| {
                let points: Vec<_> =
                    courses.iter().map(|course| [work(course) as f64, course.error]).collect();
                let stroke = if name == "RK4" { Stroke::dashed(colour) } else { Stroke::solid(colour) };
                panel.line(points.clone(), stroke).labelled(name).dots(points, 2.2, colour)
            },
        )
    };
    let row = |label: &str, work: Work| {
        let [left, middle, right] = all.each_ref().map(|measured| panel(measured, label, work));
        vec![left.without_legend(), middle.without_legend(), right.legend_at(Corner::Beside).weight(1.35)]
    };
    Figure::new(
        "Accuracy against cost: largest error of the energy over evaluations of the gradient",
        "Order 2 is the midpoint rule (σ = ½) on vortices and Störmer–Verlet else, and Kahan–Li 8 is \
         composed of these",
    )
    .row(360.0, row("evaluations", |course| course.evaluations))
    .row(360.0, row("evaluations, all stages of a step at once", |course| course.in_turn))
    .footer(
        "Steps of one length. Gauss 4, 8, 16: collocation with 2, 4, 8 stages; in lanes its stages are \
         evaluated at once, in the lower row they count once. Hairer, Lubich & Wanner 2006.",
    )
}
