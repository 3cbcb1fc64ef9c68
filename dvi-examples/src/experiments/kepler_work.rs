//! Work and precision on Kepler orbits: evaluations of the force per period against the largest errors over
//! many periods, for all families of this library, with the state of the art beside.

use rayon::prelude::*;

use super::kepler::{Course, KeplerMethod, compare, fixed, osculating, reversible};
use super::rivals::{levi_civita, logarithmic_hamiltonian};
use crate::models::Orbit;
use crate::vocabulary::*;

const ECCENTRICITIES: [f64; 4] = [0.2, 0.5, 0.8, 0.95];

/// The eccentricities and the methods that the figure shows; the table has all.
const SHOWN: [f64; 2] = [0.2, 0.95];
const DRAWN: [&str; 6] = [
    "Verlet",
    "fitted, averaged",
    "fitted, variational",
    "Galerkin, order 6",
    "log-*H* leapfrog",
    "Levi-Civita, fitted",
];

/// A method over its accuracies.
struct Contender {
    name: &'static str,
    stroke: Stroke,
    /// What `run` takes: ε, steps per period, or a tolerance.
    knobs: &'static [f64],
    run: fn(Case<'_>, f64) -> Result<Course>,
}

/// An orbit for so many periods.
type Case<'a> = (&'a Job<'a>, Orbit, u64);

const EPSILONS: &[f64] = &[0.2, 0.1, 0.05, 0.02, 0.01, 0.005];
/// Compositions take many steps in one.
const LONG_EPSILONS: &[f64] = &[1.0, 0.5, 0.2, 0.1, 0.05, 0.02];

fn by(method: impl KeplerMethod, (job, orbit, periods): Case<'_>, epsilon: f64) -> Result<Course> {
    compare(job, &mut reversible(method, orbit, epsilon)?, orbit, periods)
}

fn verlet_with_fixed_steps((job, orbit, periods): Case<'_>, steps: f64) -> Result<Course> {
    compare(job, &mut fixed(Variational::trapezoid(), orbit, steps)?, orbit, periods)
}

fn as_in_the_paper((job, orbit, periods): Case<'_>, tolerance: f64) -> Result<Course> {
    let method = Variational::simpson().phase_fitted(Curvature(Reading::LeftFrozen));
    compare(job, &mut osculating(method, orbit, tolerance)?, orbit, periods)
}

fn averaged(case: Case<'_>, epsilon: f64) -> Result<Course> {
    by(Variational::simpson().phase_fitted(Radial(Reading::Averaged)), case, epsilon)
}

fn variational(case: Case<'_>, epsilon: f64) -> Result<Course> {
    by(Variational::new(Quadrature::lobatto(4)?).phase_fitted(Radial(Reading::Variational)), case, epsilon)
}

#[rustfmt::skip]
fn contenders() -> [Contender; 13] {
    let of = |name, stroke, knobs, run| Contender { name, stroke, knobs, run };
    let (solid, dashed) = (Stroke::solid, Stroke::dashed);
    [
        of("Verlet, fixed steps",  dashed(SLATE),     &[100.0, 300.0, 1000.0, 3000.0, 10_000.0], verlet_with_fixed_steps),
        of("Verlet",               solid(SLATE),      EPSILONS, |case, epsilon| by(Variational::trapezoid(), case, epsilon)),
        of("Simpson, linear",      solid(SKY),        EPSILONS, |case, epsilon| by(Variational::simpson(), case, epsilon)),
        of("the paper: (19), (23)", solid(AMBER),     &[0.03, 0.01, 0.003, 0.001], as_in_the_paper),
        of("fitted, averaged",     solid(BLUE),       EPSILONS, averaged),
        of("fitted, variational",  solid(VERMILLION), EPSILONS, variational),
        of("Verlet, Suzuki 4",     solid(GREEN),      LONG_EPSILONS, |case, epsilon| by(Composition::suzuki(Variational::trapezoid()), case, epsilon)),
        of("Verlet, Kahan–Li 8",   dashed(GREEN),     LONG_EPSILONS, |case, epsilon| by(Composition::kahan_li_8(Variational::trapezoid()), case, epsilon)),
        of("Galerkin, order 4",    solid(PURPLE).opacity(0.4), LONG_EPSILONS, |case, epsilon| by(Galerkin::<3>::new(), case, epsilon)),
        of("Galerkin, order 6",    solid(PURPLE),     LONG_EPSILONS, |case, epsilon| by(Galerkin::<4>::new(), case, epsilon)),
        of("Galerkin, order 8",    dashed(PURPLE),    LONG_EPSILONS, |case, epsilon| by(Galerkin::<5>::new(), case, epsilon)),
        of("log-*H* leapfrog",     solid(AMBER),      &[25.0, 100.0, 400.0, 1600.0], |(job, orbit, periods), n| Ok(logarithmic_hamiltonian(job, orbit, n as u32, periods)?.course)),
        of("Levi-Civita, fitted",  dashed(INK),       &[8.0, 16.0, 32.0], |(job, orbit, periods), n| Ok(levi_civita(job, orbit, n as u32, periods)?.course)),
    ]
}

struct Curve {
    contender: usize,
    e: f64,
    courses: Vec<Course>,
    /// Runs that did not come to their end.
    failures: Vec<String>,
}

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let (periods, long) = (job.choose(100, 10), job.choose(100_000, 1000));
    let all = contenders();
    let pairs: Vec<(usize, f64)> =
        ECCENTRICITIES.iter().flat_map(|&e| (0..all.len()).map(move |contender| (contender, e))).collect();
    let runs: usize = pairs.iter().map(|&(contender, _)| all[contender].knobs.len()).sum();
    job.expect(runs as u64 * periods + 3 * long);
    let curve = |(contender, e)| {
        let Contender { name, knobs, run, .. } = &all[contender];
        let course = |&knob: &f64| run((job, Orbit { e }, periods), knob);
        let told = |knob: &f64| format!("{}, e = {e}, at {knob}", name.replace('*', ""));
        let (courses, failures) = attempts(*knobs, course, told);
        Curve { contender, e, courses, failures }
    };
    let curves: Vec<Curve> = pairs.into_par_iter().map(curve).collect();
    let orbit = Orbit { e: 0.95 };
    let leapfrog = logarithmic_hamiltonian(job, orbit, 25, long)?;
    let [regular, shorter] = each([8, 32], |steps| levi_civita(job, orbit, steps, long))?;
    let columns =
        ["method", "e", "steps_per_period", "evaluations_per_period", "energy_error", "position_error"];
    let rows = curves.iter().flat_map(|Curve { contender, e, courses, .. }| {
        let name = all[*contender].name;
        courses.iter().map(move |c| ([name], [*e, c.steps, c.evaluations, c.energy, c.position]))
    });
    job.publish(figure(&all, &curves), Table::of(&columns, rows)?)?;
    // Numbers of independent programs.
    let [averaged, variational] = [4, 5].map(|contender| job.only_full(energy(&curves, contender)));
    let references = vec![
        Check::new("averaged, e = 0.95, ε = 0.02: max|ΔE|", averaged, Bound::Near(4.506e-7, 1e-10)),
        Check::new("variational, e = 0.95, ε = 0.02: max|ΔE|", variational, Bound::Near(9.527e-8, 1e-11)),
    ];
    // By what fitting divides the error.
    let [averaged, variational] = [4, 5].map(|fitted| Some(energy(&curves, 2)? / energy(&curves, fitted)?));
    let regularised =
        "regularised, Kepler's problem is an oscillator, and phase fitting is exact at 8 steps a period";
    let rounding = "max|ΔE| at 32 steps a period, where more rounding is left";
    let claims = vec![
        beyond("phase fitting with r^(−3/2) gains three orders of magnitude at the same steps")
            .at_least("e = 0.95, ε = 0.02: max|ΔE| of Simpson, linear / averaged", averaged, 1000.0)
            .at_least("e = 0.95, ε = 0.02: max|ΔE| of Simpson, linear / variational", variational, 1000.0),
        beyond("the logarithmic Hamiltonian leapfrog errs in the phase alone, at 25 evaluations a period")
            .at_most("max|ΔE|", leapfrog.course.energy, 1e-10)
            .at_most("largest distance from the exact orbit", leapfrog.off_orbit, 1e-10),
        beyond(regularised)
            .at_most("max|ΔE|", regular.course.energy, 1e-12)
            .at_most(rounding, shorter.course.energy, 1e-10)
            .at_most("largest position error", regular.course.position, 1e-8),
    ];
    Ok(Outcome { claims, references, notes: curves.into_iter().flat_map(|curve| curve.failures).collect() })
}

/// The error of the energy at e = 0.95 and the ε = 0.02 of the other experiments.
fn energy(curves: &[Curve], contender: usize) -> Option<f64> {
    let curve = curves.iter().find(|curve| curve.e == 0.95 && curve.contender == contender)?;
    curve.courses.get(3).map(|course| course.energy)
}

fn figure(all: &[Contender], curves: &[Curve]) -> Figure {
    let row = |title: &str, label: &str, of: fn(&Course) -> f64| {
        let panels = SHOWN.map(|e| {
            let shown = curves.iter().map(|curve| (curve, &all[curve.contender]));
            let shown = shown.filter(|(curve, method)| curve.e == e && DRAWN.contains(&method.name));
            let work = ("evaluations of the force per period", [5.0, 5e4]);
            let empty =
                Panel::loglog(format!("{title} error over work, *e* = {e}"), work, (label, [1e-15, 10.0]));
            empty.marked(shown.map(|(curve, Contender { name, stroke, .. })| {
                let points = curve.courses.iter().map(|course| [course.evaluations, of(course)]);
                (*name, *stroke, points.collect())
            }))
        });
        panels.into()
    };
    let position = "largest distance from the exact position   [*a*]";
    Figure::of(
        "Reversible steps in proportion to *r*^(3/2); six of 13 methods and two of four eccentricities: the \
         table has all",
    )
    .row_with_legend(390.0, row("Energy", "max|*E* − *E*(0)|   [μ/*a*]", |course| course.energy), 1.3)
    .row_with_legend(390.0, row("Position", position, |course| course.position), 1.3)
    .footer(
        "Evaluations include those of derivatives. Log-*H*: Mikkola & Tanikawa 1999, Preto & Tremaine 1999.",
    )
}
