//! Kosmas & Vlachos, Fig. 2: “the phase fitting decreases close to one third the number of integration
//! steps”.
//!
//! A phase-fitted run over one period has a largest energy error; how many steps does a linear rule need for
//! the same? The answer depends on what is compared: the rule of the reference, and whether both runs choose
//! their steps by (23), as printed, or keep them fixed. Each reading is shown.

use crate::claim::larger;
use anyhow::{Context as _, Result};
use dvi_core::discrete::{FrequencyIn, Unfitted};
use dvi_core::prelude::*;
use rayon::prelude::*;

use super::kepler::{Course, fixed, follow, osculating};
use crate::claim::{BEYOND, Bound, Check, Claim};
use crate::figure::{Axis, BLUE, Colour, Corner, Figure, Fill, GREEN, Panel, SLATE, Stroke, VERMILLION};
use crate::gallery::{Experiment, Outcome};
use crate::job::Job;
use crate::models::Orbit;
use crate::output::{Table, number};

pub const EXPERIMENT: Experiment =
    Experiment { name: "kepler-steps", title: "One third of the steps, in each reading", share: 25.0, run };

const ECCENTRICITIES: [f64; 4] = [0.2, 0.5, 0.8, 0.95];
/// The eccentricity of the paper.
const HIGH: f64 = 0.95;

/// How the steps of a run are chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Steps {
    /// All of one length; phase fitting takes (19) as a part of L_d.
    Fixed,
    /// By (23) as printed; phase fitting takes (19) at the left end of a step.
    Controlled,
}

/// Simpson's rule, phase-fitted, against a linear rule.
struct Comparison {
    steps: Steps,
    e: f64,
    reference: &'static str,
    /// The largest energy error that both have.
    energy: f64,
    /// The numbers of steps over one period.
    fitted: f64,
    linear: f64,
}

const REFERENCES: [(&str, Quadrature, Colour); 3] = [
    ("midpoint", Quadrature::midpoint(), BLUE),
    ("trapezoid", Quadrature::trapezoid(), GREEN),
    ("Simpson, linear", Quadrature::simpson(), SLATE),
];

/// How fine the phase-fitted runs are: steps per period, or the reciprocal of the tolerance.
fn finenesses(steps: Steps, e: f64) -> [f64; 3] {
    match steps {
        Steps::Fixed if e > 0.9 => [2000.0, 8000.0, 32_000.0],
        Steps::Fixed => [500.0, 2000.0, 8000.0],
        Steps::Controlled => [1e2, 1e3, 1e4],
    }
}

/// Of a factor 1000, down to 10⁻⁴.
const BISECTIONS: u32 = 17;

fn run(job: &Job<'_>) -> Result<Outcome> {
    let count = job.choose(3, 2);
    let eccentricities = job.choose(&ECCENTRICITIES[..], &ECCENTRICITIES[3..]);
    let mut cases = Vec::new();
    for steps in [Steps::Fixed, Steps::Controlled] {
        for &e in eccentricities {
            cases.extend(finenesses(steps, e)[..count].iter().map(|&fineness| (steps, e, fineness)));
        }
    }
    job.expect(cases.len() as u64 * (1 + 3 * u64::from(BISECTIONS + 1)));
    let compared = cases.into_par_iter().map(|(steps, e, fineness)| compare(job, steps, e, fineness));
    let compared: Vec<Comparison> = compared.collect::<Result<Vec<_>>>()?.into_iter().flatten().collect();
    job.publish(EXPERIMENT.name, figure(&compared), table(&compared)?)?;
    Ok(Outcome { claims: claims(&compared), references: references(&compared), notes: notes(&compared) })
}

fn compare(job: &Job<'_>, steps: Steps, e: f64, fineness: f64) -> Result<Vec<Comparison>> {
    let fitted = match steps {
        Steps::Fixed => {
            course(job, steps, Curvature(Reading::Variational), Quadrature::simpson(), e, fineness)
        }
        Steps::Controlled => {
            course(job, steps, Curvature(Reading::LeftFrozen), Quadrature::simpson(), e, fineness)
        }
    };
    let fitted = fitted.with_context(|| format!("the phase-fitted run at e = {e}"))?;
    let needed = |&(reference, rule, _): &(&'static str, Quadrature, Colour)| {
        let linear = steps_for(job, fitted.energy, fineness, |fineness| {
            course(job, steps, Unfitted, rule, e, fineness)
        })?;
        Ok(Comparison { steps, e, reference, energy: fitted.energy, fitted: fitted.steps, linear })
    };
    REFERENCES.iter().map(needed).collect()
}

/// One period.
fn course<F: FrequencyIn<f64> + Copy>(
    job: &Job<'_>,
    steps: Steps,
    frequency: F,
    rule: Quadrature,
    e: f64,
    fineness: f64,
) -> Result<Course> {
    let (method, orbit) = (Variational::new(rule).phase_fitted(frequency), Orbit { e });
    match steps {
        Steps::Fixed => follow(job, &mut fixed(method, orbit, fineness.round())?, 1, |_| ()),
        Steps::Controlled => follow(job, &mut osculating(method, orbit, 1.0 / fineness)?, 1, |_| ()),
    }
}

/// The number of steps for which the energy error is `target`, by bisection around a guess.
fn steps_for(job: &Job<'_>, target: f64, guess: f64, run: impl Fn(f64) -> Result<Course>) -> Result<f64> {
    let (mut low, mut high) = (guess / 30.0, guess * 30.0);
    for _ in 0..BISECTIONS {
        if job.is_stopping() {
            job.cut_short();
            break;
        }
        let middle = (low * high).sqrt();
        // Very coarse runs may fail: they are too coarse.
        if run(middle).is_ok_and(|course| course.energy <= target) { high = middle } else { low = middle }
    }
    Ok(run(high)?.steps)
}

impl Comparison {
    fn ratio(&self) -> f64 {
        self.fitted / self.linear
    }
}

/// The ratios of one reading.
#[derive(Clone, Copy)]
struct Ratios {
    least: f64,
    most: f64,
    /// How many there are, and how many of them are above one third.
    count: usize,
    above: usize,
}

const THIRD: f64 = 1.0 / 3.0;

/// The ratios with the given choice of steps, at the given eccentricity, against midpoint and trapezoid or,
/// if `simpson`, against linear Simpson; `None` if there are none.
fn ratios(all: &[Comparison], steps: Steps, e: f64, simpson: bool) -> Option<Ratios> {
    let is_asked =
        |c: &&Comparison| c.steps == steps && c.e == e && (c.reference == "Simpson, linear") == simpson;
    let ratios: Vec<f64> = all.iter().filter(is_asked).map(Comparison::ratio).collect();
    (!ratios.is_empty()).then(|| Ratios {
        least: ratios.iter().copied().fold(f64::INFINITY, f64::min),
        most: ratios.iter().copied().fold(0.0, larger),
        count: ratios.len(),
        above: ratios.iter().filter(|&&ratio| ratio > THIRD).count(),
    })
}

fn claims(all: &[Comparison]) -> Vec<Claim> {
    let of = |steps, e, simpson| ratios(all, steps, e, simpson);
    let printed = of(Steps::Controlled, HIGH, false);
    let lower = of(Steps::Controlled, 0.8, false);
    let fixed = of(Steps::Fixed, HIGH, false);
    let simpson = of(Steps::Fixed, HIGH, true);
    let low = of(Steps::Fixed, 0.2, true);
    let most = |ratios: Option<Ratios>| ratios.map(|ratios| ratios.most);
    let least = |ratios: Option<Ratios>| ratios.map(|ratios| ratios.least);
    let third = Bound::AtMost(THIRD);
    vec![
        Claim::new("section 5", "at e = 0.95, close to one third of the steps of a method of the same order")
            .check("(23) as printed, against midpoint and trapezoid: smallest ratio", least(printed), Bound::AtLeast(0.25))
            .check("the same: largest ratio", most(printed), Bound::AtMost(0.42)),
        Claim::new("section 7", "less than one third of the steps")
            .check("(23) as printed, e = 0.95, against midpoint and trapezoid: largest ratio", most(printed), third)
            .instead(
                "with (23) as printed most ratios are above one third; with fixed steps all are below it, against \
                 midpoint and trapezoid; against linear Simpson none is at e = 0.95",
            )
            .check(
                "(23) as printed, e = 0.95: share of the ratios above one third",
                printed.map(|ratios| ratios.above as f64 / ratios.count as f64),
                Bound::AtLeast(0.5),
            )
            .check("fixed steps, e = 0.95, against midpoint and trapezoid: largest ratio", most(fixed), third)
            .check("fixed steps, e = 0.95, against linear Simpson: smallest ratio", least(simpson), Bound::AtLeast(THIRD)),
        Claim::new(BEYOND, "what is saved depends on the orbit")
            .check("(23) as printed, e = 0.8, against midpoint and trapezoid: largest ratio", most(lower), Bound::AtLeast(1.0))
            .check("fixed steps, e = 0.2, against linear Simpson: largest ratio", most(low), third),
    ]
}

/// Brackets around what earlier runs have found.
fn references(all: &[Comparison]) -> Vec<Check> {
    let check = |steps: Steps, e: f64, simpson: bool, [low, high]: [f64; 2]| {
        let how = if steps == Steps::Fixed { "fixed steps" } else { "(23) as printed" };
        let against = if simpson { "linear Simpson" } else { "midpoint and trapezoid" };
        let ratios = ratios(all, steps, e, simpson);
        let name = |which: &str| format!("{how}, e = {e}, against {against}: {which} ratio");
        let bound = Bound::Within(low, high);
        [
            Check::new(name("smallest"), ratios.map(|r| r.least), bound),
            Check::new(name("largest"), ratios.map(|r| r.most), bound),
        ]
    };
    let checks = [
        check(Steps::Controlled, HIGH, false, [0.28, 0.42]),
        check(Steps::Controlled, 0.8, false, [0.2, 1.1]),
        check(Steps::Controlled, HIGH, true, [0.45, 0.92]),
        check(Steps::Fixed, HIGH, false, [0.27, 0.32]),
        check(Steps::Fixed, HIGH, true, [0.45, 0.55]),
        check(Steps::Fixed, 0.2, true, [0.15, 0.25]),
    ];
    checks.into_iter().flatten().collect()
}

fn notes(all: &[Comparison]) -> Vec<String> {
    let line = |c: &Comparison| {
        let how = if c.steps == Steps::Fixed {
            "fixed steps, (19) in the discrete Lagrangian"
        } else {
            "(23) as printed, (19) left-frozen"
        };
        format!(
            "e = {}, {how}, max|ΔE| = {:.2e}: {:.0} steps per period against {:.0} of {}: {:.3}.",
            c.e,
            c.energy,
            c.fitted,
            c.linear,
            c.reference,
            c.ratio()
        )
    };
    all.iter().filter(|c| c.e == HIGH).map(line).collect()
}

/// What was found against midpoint and trapezoid at the eccentricity of the paper.
fn subtitle(all: &[Comparison]) -> String {
    let told = |name: &str, steps: Steps| {
        let found = ratios(all, steps, HIGH, false).map(|Ratios { least, most, count, above }| {
            format!("{name} {least:.3} to {most:.3}, {above} of {count} above one third")
        });
        found.unwrap_or_default()
    };
    let (printed, fixed) = (told("with (23)", Steps::Controlled), told("with fixed steps", Steps::Fixed));
    format!("Ratios at *e* = {HIGH}, against midpoint and trapezoid: {printed}; {fixed}")
}

fn figure(all: &[Comparison]) -> Figure {
    let steps = Panel::new(
        format!("Steps over one period, *e* = {HIGH}, both with (23)"),
        Axis::logarithmic("max|*E* − *E*(0)|"),
        Axis::logarithmic("steps"),
    );
    let of = |reference: &'static str, steps: Steps| {
        all.iter().filter(move |c| c.reference == reference && c.steps == steps)
    };
    let at_high = |reference| of(reference, Steps::Controlled).filter(|c| c.e == HIGH);
    let fitted: Vec<_> = at_high(REFERENCES[0].0).map(|c| [c.energy, c.fitted]).collect();
    let steps = steps
        .line(fitted.clone(), Stroke::solid(VERMILLION))
        .discs(fitted, VERMILLION, Fill::Solid)
        .labelled("phase-fitted");
    let steps = REFERENCES.iter().fold(steps, |panel, &(reference, _, colour)| {
        let points: Vec<_> = at_high(reference).map(|c| [c.energy, c.linear]).collect();
        panel
            .line(points.clone(), Stroke::dashed(colour))
            .discs(points, colour, Fill::Hollow)
            .labelled(reference)
    });
    let compared = |title: &str, steps: Steps| {
        let e = Axis::names("eccentricity", ECCENTRICITIES.iter().map(f64::to_string).collect());
        let third = vec![[-0.6, THIRD], [3.6, THIRD]];
        let panel = Panel::new(title, e, Axis::linear("steps, phase-fitted / linear").within(0.0, 1.7))
            .line(third, Stroke::dashed(SLATE).width(1.2))
            .labelled("one third");
        REFERENCES.iter().zip([-0.18, 0.0, 0.18]).fold(panel, |panel, (&(reference, _, colour), aside)| {
            let place =
                |e: f64| ECCENTRICITIES.iter().position(|x| *x == e).unwrap_or_default() as f64 + aside;
            let points = of(reference, steps).map(|c| [place(c.e), c.ratio()]).collect();
            panel.discs(points, colour, Fill::Hollow).labelled(format!("against {reference}"))
        })
    };
    Figure::new(
        "“One third of the steps”: phase-fitted Simpson against linear rules, for equal energy error",
        subtitle(all),
    )
    .row(430.0, vec![
        steps.legend_at(Corner::TopRight),
        compared("Both with (23) as printed", Steps::Controlled).legend_at(Corner::TopRight),
        compared("Both with fixed steps", Steps::Fixed).without_legend(),
    ])
    .footer("After Kosmas & Vlachos, Fig. 2. Frequency (19): left-frozen with (23), in the discrete Lagrangian with fixed steps.")
}

fn table(all: &[Comparison]) -> Result<Table> {
    let mut table = Table::new(&["steps", "e", "reference", "energy_error", "fitted", "linear", "ratio"])?;
    for c in all {
        let how = if c.steps == Steps::Fixed { "fixed" } else { "controlled" };
        let numbers = [c.energy, c.fitted, c.linear, c.ratio()].map(number);
        table.row([how.to_owned(), number(c.e), c.reference.to_owned()].into_iter().chain(numbers))?;
    }
    Ok(table)
}
