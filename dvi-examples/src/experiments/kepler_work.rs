//! Work and precision on Kepler orbits: evaluations of the force per period against the largest errors of
//! energy and position over many periods, for all families of this library, with the state of the art
//! beside.

use anyhow::Result;
use dvi_core::prelude::*;
use rayon::prelude::*;

use super::kepler::{Course, compare, fixed, osculating, reversible};
use super::rivals;
use crate::claim::{BEYOND, Bound, Check, Claim};
use crate::figure::{
    AMBER, Axis, BLUE, Corner, Figure, GREEN, INK, PURPLE, Panel, SKY, SLATE, Stroke, VERMILLION,
};
use crate::gallery::{Experiment, Outcome};
use crate::job::Job;
use crate::models::Orbit;
use crate::output::{Table, number};

pub const EXPERIMENT: Experiment =
    Experiment { name: "kepler-work", title: "Work and precision on Kepler orbits", share: 30.0, run };

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
    run: fn(&Job<'_>, Orbit, f64, u64) -> Result<Course>,
}

const EPSILONS: &[f64] = &[0.2, 0.1, 0.05, 0.02, 0.01, 0.005];
/// Compositions take many steps in one.
const LONG_EPSILONS: &[f64] = &[1.0, 0.5, 0.2, 0.1, 0.05, 0.02];

fn contenders() -> Vec<Contender> {
    vec![
        Contender {
            name: "Verlet, fixed steps",
            stroke: Stroke::dashed(SLATE),
            knobs: &[100.0, 300.0, 1000.0, 3000.0, 10_000.0],
            run: |job, orbit, n, periods| {
                compare(job, &mut fixed(Variational::trapezoid(), orbit, n)?, orbit, periods)
            },
        },
        Contender {
            name: "Verlet",
            stroke: Stroke::solid(SLATE),
            knobs: EPSILONS,
            run: |job, orbit, epsilon, periods| {
                compare(job, &mut reversible(Variational::trapezoid(), orbit, epsilon)?, orbit, periods)
            },
        },
        Contender {
            name: "Simpson, linear",
            stroke: Stroke::solid(SKY),
            knobs: EPSILONS,
            run: |job, orbit, epsilon, periods| {
                compare(job, &mut reversible(Variational::simpson(), orbit, epsilon)?, orbit, periods)
            },
        },
        Contender {
            name: "the paper: (19), (23)",
            stroke: Stroke::solid(AMBER),
            knobs: &[0.03, 0.01, 0.003, 0.001],
            run: |job, orbit, tolerance, periods| {
                let method = Variational::simpson().phase_fitted(Curvature(Reading::LeftFrozen));
                compare(job, &mut osculating(method, orbit, tolerance)?, orbit, periods)
            },
        },
        Contender {
            name: "fitted, averaged",
            stroke: Stroke::solid(BLUE),
            knobs: EPSILONS,
            run: |job, orbit, epsilon, periods| {
                let method = Variational::simpson().phase_fitted(Radial(Reading::Averaged));
                compare(job, &mut reversible(method, orbit, epsilon)?, orbit, periods)
            },
        },
        Contender {
            name: "fitted, variational",
            stroke: Stroke::solid(VERMILLION),
            knobs: EPSILONS,
            run: |job, orbit, epsilon, periods| {
                let method =
                    Variational::new(Quadrature::lobatto(4)?).phase_fitted(Radial(Reading::Variational));
                compare(job, &mut reversible(method, orbit, epsilon)?, orbit, periods)
            },
        },
        Contender {
            name: "Verlet, Suzuki 4",
            stroke: Stroke::solid(GREEN),
            knobs: LONG_EPSILONS,
            run: |job, orbit, epsilon, periods| {
                let method = Composition::suzuki(Variational::trapezoid());
                compare(job, &mut reversible(method, orbit, epsilon)?, orbit, periods)
            },
        },
        Contender {
            name: "Verlet, Kahan–Li 8",
            stroke: Stroke::dashed(GREEN),
            knobs: LONG_EPSILONS,
            run: |job, orbit, epsilon, periods| {
                let method = Composition::kahan_li_8(Variational::trapezoid());
                compare(job, &mut reversible(method, orbit, epsilon)?, orbit, periods)
            },
        },
        Contender {
            name: "Galerkin, order 4",
            stroke: Stroke::solid(PURPLE).opacity(0.4),
            knobs: LONG_EPSILONS,
            run: |job, orbit, epsilon, periods| {
                compare(job, &mut reversible(Galerkin::<3>::new(), orbit, epsilon)?, orbit, periods)
            },
        },
        Contender {
            name: "Galerkin, order 6",
            stroke: Stroke::solid(PURPLE),
            knobs: LONG_EPSILONS,
            run: |job, orbit, epsilon, periods| {
                compare(job, &mut reversible(Galerkin::<4>::new(), orbit, epsilon)?, orbit, periods)
            },
        },
        Contender {
            name: "Galerkin, order 8",
            stroke: Stroke::dashed(PURPLE),
            knobs: LONG_EPSILONS,
            run: |job, orbit, epsilon, periods| {
                compare(job, &mut reversible(Galerkin::<5>::new(), orbit, epsilon)?, orbit, periods)
            },
        },
        Contender {
            name: "log-*H* leapfrog",
            stroke: Stroke::solid(AMBER),
            knobs: &[25.0, 100.0, 400.0, 1600.0],
            run: |job, orbit, n, periods| {
                Ok(rivals::logarithmic_hamiltonian(job, orbit, n as u32, periods)?.course)
            },
        },
        Contender {
            name: "Levi-Civita, fitted",
            stroke: Stroke::dashed(INK),
            knobs: &[8.0, 16.0, 32.0],
            run: |job, orbit, n, periods| Ok(rivals::levi_civita(job, orbit, n as u32, periods)?.course),
        },
    ]
}

impl Contender {
    fn is_drawn(&self) -> bool {
        DRAWN.contains(&self.name)
    }
}

/// One method on one orbit.
struct Curve {
    contender: usize,
    e: f64,
    courses: Vec<Course>,
    /// Runs that did not come to their end.
    failures: Vec<String>,
}

fn run(job: &Job<'_>) -> Result<Outcome> {
    let periods = job.choose(100, 10);
    let all = contenders();
    let pairs: Vec<(usize, f64)> =
        ECCENTRICITIES.iter().flat_map(|&e| (0..all.len()).map(move |contender| (contender, e))).collect();
    let runs: usize = pairs.iter().map(|&(contender, _)| all[contender].knobs.len()).sum();
    let long = job.choose(100_000, 1000);
    job.expect(runs as u64 * periods + 3 * long);
    let curves: Vec<Curve> =
        pairs.into_par_iter().map(|(contender, e)| curve(job, &all, contender, e, periods)).collect();
    let orbit = Orbit { e: 0.95 };
    let leapfrog = rivals::logarithmic_hamiltonian(job, orbit, 25, long)?;
    let regular = rivals::levi_civita(job, orbit, 8, long)?;
    let shorter = rivals::levi_civita(job, orbit, 32, long)?;
    job.publish(EXPERIMENT.name, figure(&all, &curves, periods), table(&all, &curves)?)?;
    let failures = curves.iter().flat_map(|curve| curve.failures.clone());
    Ok(Outcome {
        claims: claims(&curves, [leapfrog, regular, shorter]),
        references: references(job, &curves),
        notes: failures.collect(),
    })
}

fn curve(job: &Job<'_>, all: &[Contender], contender: usize, e: f64, periods: u64) -> Curve {
    let Contender { name, knobs, run, .. } = &all[contender];
    let mut curve = Curve { contender, e, courses: Vec::new(), failures: Vec::new() };
    for &knob in *knobs {
        match run(job, Orbit { e }, knob, periods) {
            Ok(course) => curve.courses.push(course),
            Err(error) => {
                curve.failures.push(format!("{}, e = {e}, at {knob}: {error}.", name.replace('*', "")));
            }
        }
    }
    curve
}

/// The error of the energy at e = 0.95 and the ε = 0.02 of the other experiments.
fn energy(curves: &[Curve], contender: usize) -> Option<f64> {
    let curve = curves.iter().find(|curve| curve.e == 0.95 && curve.contender == contender)?;
    curve.courses.get(3).map(|course| course.energy)
}

/// Numbers of independent programs.
fn references(job: &Job<'_>, curves: &[Curve]) -> Vec<Check> {
    let full = |contender| job.only_full(energy(curves, contender)).flatten();
    vec![
        Check::new("averaged, e = 0.95, ε = 0.02: max|ΔE|", full(4), Bound::Near(4.506e-7, 1e-10)),
        Check::new("variational, e = 0.95, ε = 0.02: max|ΔE|", full(5), Bound::Near(9.527e-8, 1e-11)),
    ]
}

fn claims(curves: &[Curve], [leapfrog, regular, shorter]: [rivals::Rival; 3]) -> Vec<Claim> {
    let energy = |contender| energy(curves, contender);
    let (simpson, averaged, variational) = (energy(2), energy(4), energy(5));
    let gain = simpson.zip(averaged).map(|(simpson, averaged)| simpson / averaged);
    vec![
        Claim::new(BEYOND, "phase fitting with r^(−3/2) gains three orders of magnitude at the same steps")
            .check("e = 0.95, ε = 0.02: max|ΔE| of Simpson, linear / averaged", gain, Bound::AtLeast(1000.0))
            .check(
                "e = 0.95, ε = 0.02: max|ΔE| of Simpson, linear / variational",
                simpson.zip(variational).map(|(simpson, variational)| simpson / variational),
                Bound::AtLeast(1000.0),
            ),
        Claim::new(
            BEYOND,
            "the logarithmic Hamiltonian leapfrog errs in the phase alone, at 25 evaluations a period",
        )
        .check("max|ΔE|", leapfrog.course.energy, Bound::AtMost(1e-10))
        .check("largest distance from the exact orbit", leapfrog.off_orbit, Bound::AtMost(1e-10)),
        Claim::new(
            BEYOND,
            "regularised, Kepler's problem is an oscillator, and phase fitting is exact at 8 steps a period",
        )
        .check("max|ΔE|", regular.course.energy, Bound::AtMost(1e-12))
        .check(
            "max|ΔE| at 32 steps a period, where more rounding is left",
            shorter.course.energy,
            Bound::AtMost(1e-10),
        )
        .check("largest position error", regular.course.position, Bound::AtMost(1e-8)),
    ]
}

fn figure(all: &[Contender], curves: &[Curve], periods: u64) -> Figure {
    let panels = |title: &str, label: &str, of: fn(&Course) -> f64| {
        let panel = |(i, e): (usize, f64)| {
            let work = Axis::logarithmic("evaluations of the force per period").within(5.0, 5e4);
            let error = Axis::logarithmic(label).within(1e-15, 10.0);
            let empty = Panel::new(format!("{title} error over work, *e* = {e}"), work, error);
            let shown = curves.iter().filter(|curve| curve.e == e && all[curve.contender].is_drawn());
            let panel = shown.fold(empty, |panel, curve| {
                let points: Vec<_> =
                    curve.courses.iter().map(|course| [course.evaluations, of(course)]).collect();
                let Contender { name, stroke, .. } = &all[curve.contender];
                panel.line(points.clone(), *stroke).labelled(*name).dots(points, 2.6, stroke.colour())
            });
            if i == 1 { panel.legend_at(Corner::Beside).weight(1.3) } else { panel.without_legend() }
        };
        SHOWN.into_iter().enumerate().map(panel).collect::<Vec<_>>()
    };
    let [gain, best] = [(2, 4), (2, 5)].map(|(one, other)| {
        energy(curves, one).zip(energy(curves, other)).map_or(f64::NAN, |(one, other)| one / other)
    });
    Figure::new(
        format!("Kepler orbits: largest errors over up to {periods} periods against evaluations of the force"),
        format!(
            "Reversible steps in proportion to *r*^(3/2); at *e* = 0.95, ε = 0.02 fitting divides |Δ*E*| of Simpson \
             by {gain:.0} (averaged), {best:.0} (variational)"
        ),
    )
    .row(390.0, panels("Energy", "max|*E* − *E*(0)|   [μ/*a*]", |course| course.energy))
    .row(390.0, panels("Position", "largest distance from the exact position   [*a*]", |course| course.position))
    .footer("Six of 13 methods and two of four eccentricities; the table has all. Evaluations include those with a derivative. Log-*H*: Mikkola & Tanikawa 1999, Preto & Tremaine 1999.")
}

fn table(all: &[Contender], curves: &[Curve]) -> Result<Table> {
    let columns =
        ["method", "e", "steps_per_period", "evaluations_per_period", "energy_error", "position_error"];
    let mut table = Table::new(&columns)?;
    for Curve { contender, e, courses, .. } in curves {
        for &Course { steps, evaluations, energy, position } in courses {
            let numbers = [*e, steps, evaluations, energy, position].map(number);
            table.row([all[*contender].name.replace('*', "")].into_iter().chain(numbers))?;
        }
    }
    Ok(table)
}
