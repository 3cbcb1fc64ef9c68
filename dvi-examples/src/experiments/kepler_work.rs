//! Work and precision on Kepler orbits: evaluations of the force per period against the largest errors over
//! many periods, for all families of this library, with the state of the art beside.

use super::kepler::*;
use super::regularised::{levi_civita, logarithmic_hamiltonian};
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

const EPSILONS: &[f64] = &[0.2, 0.1, 0.05, 0.02, 0.01, 0.005];
/// Compositions take many steps in one.
const LONG: &[f64] = &[1.0, 0.5, 0.2, 0.1, 0.05, 0.02];

/// The methods over their accuracies: ε, steps per period, or a tolerance.
#[rustfmt::skip]
const CONTENDERS: [(&str, Stroke, &[f64]); 13] = [
    ("Verlet, fixed steps",   dashed(SLATE),     &[100.0, 300.0, 1000.0, 3000.0, 10_000.0]),
    ("Verlet",                solid(SLATE),      EPSILONS),
    ("Simpson, linear",       solid(SKY),        EPSILONS),
    ("the paper: (19), (23)", solid(AMBER),      &[0.03, 0.01, 0.003, 0.001]),
    ("fitted, averaged",      solid(BLUE),       EPSILONS),
    ("fitted, variational",   solid(VERMILLION), EPSILONS),
    ("Verlet, Suzuki 4",      solid(GREEN),      LONG),
    ("Verlet, Kahan–Li 8",    dashed(GREEN),     LONG),
    ("Galerkin, order 4",     solid(PURPLE),     LONG),
    ("Galerkin, order 6",     solid(PURPLE),     LONG),
    ("Galerkin, order 8",     dashed(PURPLE),    LONG),
    ("log-*H* leapfrog",      solid(AMBER),      &[25.0, 100.0, 400.0, 1600.0]),
    ("Levi-Civita, fitted",   dashed(INK),       &[8.0, 16.0, 32.0]),
];

/// An orbit for so many periods.
type Case<'a> = (&'a Job<'a>, Orbit, u64);

fn course(contender: usize, case: Case<'_>, knob: f64) -> Result<Course> {
    let ((job, orbit, periods), verlet, simpson) = (case, Variational::trapezoid(), Variational::simpson());
    let fitted = Variational::new(Quadrature::lobatto(4)?).phase_fitted(Radial(Reading::Variational));
    let frozen = simpson.phase_fitted(Curvature(Reading::LeftFrozen));
    match contender {
        0 => compare(job, &mut fixed(verlet, orbit, knob)?, orbit, periods),
        1 => by(verlet, case, knob),
        2 => by(simpson, case, knob),
        3 => compare(job, &mut osculating(frozen, orbit, knob)?, orbit, periods),
        4 => by(simpson.phase_fitted(Radial(Reading::Averaged)), case, knob),
        5 => by(fitted, case, knob),
        6 => by(Composition::suzuki(verlet), case, knob),
        7 => by(Composition::kahan_li_8(verlet), case, knob),
        8 => by(Galerkin::<3>::new(), case, knob),
        9 => by(Galerkin::<4>::new(), case, knob),
        10 => by(Galerkin::<5>::new(), case, knob),
        11 => logarithmic_hamiltonian(job, orbit, knob as u32, periods),
        _ => levi_civita(job, orbit, knob as u32, periods),
    }
}

fn by(method: impl KeplerMethod, (job, orbit, periods): Case<'_>, epsilon: f64) -> Result<Course> {
    compare(job, &mut reversible(method, orbit, epsilon)?, orbit, periods)
}

/// The courses of one method on one orbit, and the runs that did not come to their end.
struct Curve {
    contender: usize,
    e: f64,
    courses: Vec<Course>,
    failures: Vec<String>,
}

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let (periods, long) = (job.choose(100, 10), job.choose(100_000, 1000));
    let pairs: Vec<_> = ECCENTRICITIES.iter().flat_map(|&e| (0..13).map(move |k| (k, e))).collect();
    let runs: usize = CONTENDERS.iter().map(|(.., knobs)| 4 * knobs.len()).sum();
    job.expect(runs as u64 * periods + 3 * long);
    let curve = |(contender, e): (usize, f64)| {
        let (name, _, knobs) = CONTENDERS[contender];
        let told = |knob: &f64| format!("{}, e = {e}, at {knob}", name.replace('*', ""));
        let (courses, failures) =
            attempts(knobs, |&knob| course(contender, (job, Orbit { e }, periods), knob), told);
        Curve { contender, e, courses, failures }
    };
    let curves: Vec<Curve> = pairs.into_par_iter().map(curve).collect();
    let orbit = Orbit { e: 0.95 };
    let leapfrog = logarithmic_hamiltonian(job, orbit, 25, long)?;
    let [regular, shorter] = each([8, 32], |steps| levi_civita(job, orbit, steps, long))?;
    let rows = curves.iter().map(|Curve { contender, e, courses, .. }| {
        let rows = courses.iter().map(|c| [c.steps, c.evaluations, c.energy, c.position]);
        ([CONTENDERS[*contender].0], [*e], rows)
    });
    let columns = "method,e,steps_per_period,evaluations_per_period,energy_error,position_error";
    job.publish(figure(&curves), curve_table(columns, rows))?;
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
            .at_most("max|ΔE|", leapfrog.energy, 1e-10)
            .at_most("largest distance from the exact orbit", leapfrog.off_orbit, 1e-10),
        beyond(regularised)
            .at_most("max|ΔE|", regular.energy, 1e-12)
            .at_most(rounding, shorter.energy, 1e-10)
            .at_most("largest position error", regular.position, 1e-8),
    ];
    Ok(Outcome { claims, references, notes: curves.into_iter().flat_map(|curve| curve.failures).collect() })
}

/// The error of the energy at e = 0.95 and the ε = 0.02 of the other experiments.
fn energy(curves: &[Curve], contender: usize) -> Option<f64> {
    let curve = curves.iter().find(|curve| curve.e == 0.95 && curve.contender == contender)?;
    curve.courses.get(3).map(|course| course.energy)
}

fn figure(curves: &[Curve]) -> Figure {
    let row = |title: &str, label: &str, of: fn(&Course) -> f64| {
        let panels = SHOWN.map(|e| {
            let shown = curves.iter().map(|curve| (curve, CONTENDERS[curve.contender]));
            let shown = shown.filter(|(curve, (name, ..))| curve.e == e && DRAWN.contains(name));
            let lines = shown.map(|(curve, (name, stroke, _))| {
                (name, stroke, curve.courses.iter().map(|course| [course.evaluations, of(course)]).collect())
            });
            let (x, y) = (("evaluations of the force per period", [5.0, 5e4]), (label, [1e-15, 10.0]));
            Panel::loglog(format!("{title} error over work, *e* = {e}"), x, y).marked(lines)
        });
        panels.into()
    };
    let position = "largest distance from the exact position   [*a*]";
    Figure::of("Reversible steps in proportion to *r*^(3/2); the table has more methods and eccentricities")
        .row_with_legend(390.0, row("Energy", "max|*E* − *E*(0)|   [μ/*a*]", |course| course.energy), 1.3)
        .row_with_legend(390.0, row("Position", position, |course| course.position), 1.3)
        .footer("Log-*H*: Mikkola & Tanikawa 1999, Preto & Tremaine 1999.")
}
