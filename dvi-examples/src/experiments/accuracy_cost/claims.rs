//! What the runs show.

use super::Measured;
use super::problems::{GAUSS_16, KAHAN_LI, RK4};
use crate::claim::{BEYOND, Bound, Claim};
use crate::job::Job;

pub(super) fn claims(job: &Job<'_>, all: &[Measured]) -> Vec<Claim> {
    let of = |problem: &str| all.iter().find(|measured| measured.problem.name == problem);
    let full = |value: Option<f64>| job.only_full(value).flatten();
    let best = |problem| full(of(problem).and_then(|measured| measured.best(GAUSS_16)));
    let evaluations = |problem, name, bound| of(problem).and_then(|all| all.evaluations(name, bound));
    let in_turn = |problem, name, bound| of(problem).and_then(|all| all.in_turn(name, bound));
    let ratio = |of: Option<f64>, to: Option<f64>| full(of.zip(to).map(|(of, to)| of / to));
    let fewer =
        |problem, bound| ratio(evaluations(problem, KAHAN_LI, bound), evaluations(problem, GAUSS_16, bound));
    let at_once =
        |problem, bound| ratio(in_turn(problem, KAHAN_LI, bound), in_turn(problem, GAUSS_16, bound));
    vec![
        Claim::new(BEYOND, "Gauss collocation of order 16 keeps the energy to rounding errors")
            .check("vortices: smallest max|ΔH|/|H|", best("vortices"), Bound::AtMost(1e-14))
            .check("Kepler: smallest max|ΔH|/|H|", best("kepler"), Bound::AtMost(1e-14))
            .check("outer solar system: smallest max|ΔH|/|H|", best("planets"), Bound::AtMost(1e-14)),
        Claim::new(BEYOND, "for 1e-13 it needs fewer evaluations than Kahan–Li 8")
            .check("vortices: Kahan–Li 8 / Gauss 16", fewer("vortices", 1e-13), Bound::AtLeast(5.0))
            .check("Kepler: Kahan–Li 8 / Gauss 16", fewer("kepler", 1e-13), Bound::AtLeast(2.0))
            .check(
                "outer solar system: Kahan–Li 8 / Gauss 16",
                fewer("planets", 1e-13),
                Bound::AtLeast(1.5),
            ),
        Claim::new(BEYOND, "with its stages at once it makes many fewer one after another")
            .check("vortices, stages at once", at_once("vortices", 1e-13), Bound::AtLeast(40.0))
            .check("Kepler, stages at once", at_once("kepler", 1e-13), Bound::AtLeast(16.0))
            .check("outer solar system, stages at once", at_once("planets", 1e-13), Bound::AtLeast(12.0)),
        Claim::new(BEYOND, "for 1e-6 it does not: other methods need fewer evaluations")
            .check(
                "vortices, 1e-6: RK4 / Gauss 16",
                ratio(evaluations("vortices", RK4, 1e-6), evaluations("vortices", GAUSS_16, 1e-6)),
                Bound::AtMost(1.0),
            )
            .check(
                "outer solar system, 1e-6: Kahan–Li 8 / Gauss 16",
                fewer("planets", 1e-6),
                Bound::AtMost(1.0),
            ),
    ]
}
