//! Accuracy and cost: the largest error of the energy against evaluations of the gradient, for methods of
//! order 2 to 16, on four vortices, on a Kepler orbit, and on the outer solar system.
//!
//! The cost is counted, not timed, so that it is the same on every machine. The benchmark `accuracy`
//! measures times.

use crate::vocabulary::*;

/// The methods, with the number of stages that can be evaluated at once.
#[rustfmt::skip]
const METHODS: [(&str, f64, Stroke); 6] = [
    ("order 2",    1.0, solid(SLATE)),
    ("RK4",        1.0, dashed(INK)),
    ("Kahan–Li 8", 1.0, solid(GREEN)),
    ("Gauss 4",    2.0, solid(AMBER)),
    ("Gauss 8",    4.0, solid(VERMILLION)),
    ("Gauss 16",   8.0, solid(BLUE)),
];
const RK4: usize = 1;
const KAHAN_LI: usize = 2;
const GAUSS_16: usize = 5;

/// The problems, with the most steps of each method.
const PROBLEMS: [(&str, &str, [f64; 6]); 3] = [
    ("vortices", "Four vortices", [1e6, 3e5, 2e4, 2e5, 2e4, 4e3]),
    ("kepler", "Kepler orbit, *e* = 0.6", [2e6, 5e5, 4e4, 4e5, 4e4, 8e3]),
    ("planets", "Outer solar system", [1e6, 2e5, 2e4, 2e5, 2e4, 4e3]),
];

/// Steps, evaluations of ∇H or of the force, those in turn with all stages at once, and max|ΔH| / |H|.
type Course = [f64; 4];
const ALL: usize = 1;
const IN_TURN: usize = 2;

/// All runs of one problem by one of the methods, and those that did not come to their end.
type Curve = (Vec<Course>, Vec<String>);

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    // Many runs in a full one, and few that are shorter.
    let (runs, by) = job.choose((33, 2f64.powf(0.25)), (5, 4.0));
    let share = job.choose(1.0, 0.05);
    let counts = |most: f64| (0..runs).rev().map(move |k| (share * most / f64::powi(by, k)).round() as u64);
    job.expect(PROBLEMS.iter().flat_map(|(.., most)| most.map(counts)).flatten().sum());
    let all = side_by_side([0, 1, 2], |problem: usize| {
        let (problem_name, _, most) = PROBLEMS[problem];
        side_by_side([0, 1, 2, 3, 4, 5], |method: usize| {
            let told = |steps| format!("{problem_name}, {} with {steps} steps", METHODS[method].0);
            Ok(attempts(counts(most[method]), |steps| solve(job, problem, method, steps, share), told))
        })
    })?;
    let curves = || {
        let all = all.iter().zip(PROBLEMS);
        all.flat_map(|(of, (name, ..))| of.iter().zip(METHODS).map(move |(curve, of)| (name, of.0, curve)))
    };
    let rows = curves().map(|(problem, method, (all, _))| ([problem, method], [], all.iter().copied()));
    let table = curve_table("problem,method,steps,evaluations,evaluations_in_turn,energy_error", rows);
    job.publish(figure(&all), table)?;
    let notes = curves().flat_map(|(.., (_, failures))| failures.clone()).collect();
    Ok(Outcome { claims: claims(job, &all), references: vec![], notes })
}

fn solve(job: &Job<'_>, problem: usize, method: usize, steps: u64, share: f64) -> Result<Course> {
    // Compensated sums, as those of Gauss collocation are.
    let verlet = Variational { summation: Summation::Compensated, ..Variational::trapezoid() };
    let steps = steps as f64;
    match problem {
        0 => {
            let (Case { vortices, start }, methods) =
                (quasi_periodic(), (Sigma::midpoint(), Gauss::<1>::new()));
            by(job, Problem::new(&vortices, start), methods, method, [1000.0 * share, steps])
        }
        1 => {
            let orbit = Problem::new(&Kepler {}, Orbit { e: 0.6 }.pericentre());
            by(job, orbit, (verlet, verlet), method, [TAU * (100.0 * share).round(), steps])
        }
        _ => {
            let (system, start) = outer_solar_system();
            by(job, Problem::new(&system, start), (verlet, verlet), method, [1e6 * share, steps])
        }
    }
}

/// A run by one of [`METHODS`], with that of order 2 and the one that Kahan and Li's is composed of.
fn by<'a, S: Lagrangian, M: Method<S, f64> + 'a>(
    job: &Job<'_>,
    begin: Problem<'a, S>,
    (second, composed): (impl Method<S, f64> + 'a, M),
    method: usize,
    [end, steps]: [f64; 2],
) -> Result<Course>
where
    Composition<M>: Method<S, f64>,
    RungeKutta: Method<S, f64>,
    Gauss<2>: Method<S, f64>,
    Gauss<4>: Method<S, f64>,
    Gauss<8>: Method<S, f64>,
{
    let h = end / steps;
    let mut run = match method {
        0 => begin.any(second, h)?,
        RK4 => begin.any(RungeKutta::classical(), h)?,
        KAHAN_LI => begin.any(Composition::kahan_li_8(composed), h)?,
        3 => begin.any(Gauss::<2>::new(), h)?,
        4 => begin.any(Gauss::<4>::new(), h)?,
        _ => begin.any(Gauss::<8>::new(), h)?,
    };
    let (initial, mut error) = (run.energy(), 0.0);
    job.follow(&mut run, steps as u64, |run| {
        error = larger(error, ((run.energy() - initial) / initial).abs());
    })?;
    let statistics = run.statistics();
    let evaluations = (statistics.gradients + statistics.linearizations) as f64;
    Ok([steps, evaluations, (evaluations / METHODS[method].1).ceil(), error])
}

fn claims(job: &Job<'_>, all: &[[Curve; 6]; 3]) -> Vec<Claim> {
    let [vortices, _, planets] = all;
    let named = || ["vortices", "Kepler", "outer solar system"].into_iter().zip(all);
    let best = |of: &[Curve; 6]| job.only_full(least(of[GAUSS_16].0.iter().map(|course| course[3])));
    // How much more work a method takes than Gauss 16 to keep the energy to a bound.
    let ratio = |of: &[Curve; 6], method: usize, bound: f64, work: usize| {
        let [of, to] = [method, GAUSS_16].map(|method| {
            let within = of[method].0.iter().filter(|course| course[3] <= bound);
            within.map(|course| course[work]).reduce(f64::min)
        });
        job.only_full(of.zip(to).map(|(of, to)| of / to))
    };
    let fewer = "for 1e-13 it needs fewer evaluations than Kahan–Li 8";
    let many_fewer = "with its stages at once it makes many fewer one after another";
    let of_planets = ratio(planets, KAHAN_LI, 1e-6, ALL);
    vec![
        beyond("Gauss collocation of order 16 keeps the energy to rounding errors")
            .each(named(), |all, (name, of)| all.of(name).at_most("smallest max|ΔH|/|H|", best(of), 1e-14)),
        beyond(fewer).each(named().zip([5.0, 2.0, 1.5]), |claim, ((name, of), low)| {
            claim.of(name).at_least("Kahan–Li 8 / Gauss 16", ratio(of, KAHAN_LI, 1e-13, ALL), low)
        }),
        beyond(many_fewer).each(named().zip([40.0, 16.0, 12.0]), |claim, ((name, of), low)| {
            claim.at_least(format!("{name}, stages at once"), ratio(of, KAHAN_LI, 1e-13, IN_TURN), low)
        }),
        beyond("for 1e-6 it does not: other methods need fewer evaluations")
            .at_most("vortices, 1e-6: RK4 / Gauss 16", ratio(vortices, RK4, 1e-6, ALL), 1.0)
            .at_most("outer solar system, 1e-6: Kahan–Li 8 / Gauss 16", of_planets, 1.0),
    ]
}

fn figure(all: &[[Curve; 6]; 3]) -> Figure {
    let row = |label: &str, work: usize| {
        let panels = all.iter().zip(PROBLEMS).map(|(curves, (_, title, _))| {
            let lines = METHODS.into_iter().zip(curves).map(|((name, _, stroke), (courses, _))| {
                (name, stroke, courses.iter().map(|course| [course[work], course[3]]).collect())
            });
            Panel::loglog(title, (label, [2e3, 4e6]), ("max|Δ*H*| / |*H*|", [1e-16, 1.0])).marked(lines)
        });
        panels.collect()
    };
    Figure::of("Order 2: midpoint (σ = ½) on vortices, Störmer–Verlet else; Kahan–Li 8 is composed of these")
        .row_with_legend(360.0, row("evaluations", ALL), 1.35)
        .row_with_legend(360.0, row("evaluations, all stages of a step at once", IN_TURN), 1.35)
        .footer("Steps of one length. Gauss 4, 8, 16: 2, 4, 8 stages. Hairer, Lubich & Wanner 2006.")
}
