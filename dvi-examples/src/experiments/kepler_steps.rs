//! Kosmas & Vlachos, Fig. 2: “the phase fitting decreases close to one third the number of integration
//! steps”.
//!
//! A phase-fitted run over one period has a largest energy error; how many steps does a linear rule need for
//! the same? The answer depends on what is compared: the rule of the reference, and whether both runs choose
//! their steps by (23), as printed, or keep them fixed. Each reading is shown.

use dvi_core::discrete::{FrequencyIn, Unfitted};
use rayon::prelude::*;

use super::kepler::{Course, fixed, follow, osculating};
use crate::models::Orbit;
use crate::vocabulary::*;

const ECCENTRICITIES: [f64; 4] = [0.2, 0.5, 0.8, 0.95];
/// The eccentricity of the paper.
const HIGH: f64 = 0.95;
const THIRD: f64 = 1.0 / 3.0;
/// Of a factor 1000, down to 10⁻⁴.
const BISECTIONS: u32 = 17;

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

pub fn run(job: &Job<'_>) -> Result<Outcome> {
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
    let columns = ["steps", "e", "reference", "energy_error", "fitted", "linear", "ratio"];
    let rows = compared.iter().map(|c| {
        let how = if c.steps == Steps::Fixed { "fixed" } else { "controlled" };
        ([how, &c.e.to_string(), c.reference].map(str::to_owned), [c.energy, c.fitted, c.linear, c.ratio()])
    });
    job.publish(figure(&compared), Table::of(&columns, rows)?)?;
    Ok(Outcome { claims: claims(&compared), references: references(&compared), notes: notes(&compared) })
}

fn compare(job: &Job<'_>, steps: Steps, e: f64, fineness: f64) -> Result<Vec<Comparison>> {
    let reading = match steps {
        Steps::Fixed => Reading::Variational,
        Steps::Controlled => Reading::LeftFrozen,
    };
    let fitted = course(job, steps, Curvature(reading), Quadrature::simpson(), e, fineness);
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

/// The ratios with the given choice of steps, at the given eccentricity, against midpoint and trapezoid or,
/// if `simpson`, against linear Simpson; `None` if there are none.
fn ratios(all: &[Comparison], steps: Steps, e: f64, simpson: bool) -> Option<Ratios> {
    let is_asked =
        |c: &&Comparison| c.steps == steps && c.e == e && (c.reference == "Simpson, linear") == simpson;
    let ratios: Vec<f64> = all.iter().filter(is_asked).map(Comparison::ratio).collect();
    (!ratios.is_empty()).then(|| Ratios {
        least: ratios.iter().copied().fold(f64::INFINITY, f64::min),
        most: largest(ratios.iter().copied()),
        count: ratios.len(),
        above: ratios.iter().filter(|&&ratio| ratio > THIRD).count(),
    })
}

fn claims(all: &[Comparison]) -> Vec<Claim> {
    let most = |steps, e, simpson| ratios(all, steps, e, simpson).map(|ratios| ratios.most);
    let least = |steps, e, simpson| ratios(all, steps, e, simpson).map(|ratios| ratios.least);
    let above =
        ratios(all, Steps::Controlled, HIGH, false).map(|ratios| ratios.above as f64 / ratios.count as f64);
    let [printed, fixed] = [Steps::Controlled, Steps::Fixed];
    let two = "against midpoint and trapezoid";
    vec![
        Claim::new(
            "section 5",
            "at e = 0.95, close to one third of the steps of a method of the same order",
        )
        .at_least(format!("(23) as printed, {two}: smallest ratio"), least(printed, HIGH, false), 0.25)
        .at_most("the same: largest ratio", most(printed, HIGH, false), 0.42),
        Claim::new("section 7", "less than one third of the steps")
            .at_most(
                format!("(23) as printed, e = 0.95, {two}: largest ratio"),
                most(printed, HIGH, false),
                THIRD,
            )
            .instead(
                "with (23) as printed most ratios are above one third; with fixed steps all are below it, \
                 against midpoint and trapezoid; against linear Simpson none is at e = 0.95",
            )
            .at_least("(23) as printed, e = 0.95: share of the ratios above one third", above, 0.5)
            .at_most(format!("fixed steps, e = 0.95, {two}: largest ratio"), most(fixed, HIGH, false), THIRD)
            .at_least(
                "fixed steps, e = 0.95, against linear Simpson: smallest ratio",
                least(fixed, HIGH, true),
                THIRD,
            ),
        beyond("what is saved depends on the orbit")
            .at_least(
                format!("(23) as printed, e = 0.8, {two}: largest ratio"),
                most(printed, 0.8, false),
                1.0,
            )
            .at_most(
                "fixed steps, e = 0.2, against linear Simpson: largest ratio",
                most(fixed, 0.2, true),
                THIRD,
            ),
    ]
}

/// Brackets around what earlier runs have found.
fn references(all: &[Comparison]) -> Vec<Check> {
    let checks = [
        (Steps::Controlled, HIGH, false, [0.28, 0.42]),
        (Steps::Controlled, 0.8, false, [0.2, 1.1]),
        (Steps::Controlled, HIGH, true, [0.45, 0.92]),
        (Steps::Fixed, HIGH, false, [0.27, 0.32]),
        (Steps::Fixed, HIGH, true, [0.45, 0.55]),
        (Steps::Fixed, 0.2, true, [0.15, 0.25]),
    ];
    let check = |(steps, e, simpson, [low, high]): (Steps, f64, bool, [f64; 2])| {
        let how = if steps == Steps::Fixed { "fixed steps" } else { "(23) as printed" };
        let against = if simpson { "linear Simpson" } else { "midpoint and trapezoid" };
        let ratios = ratios(all, steps, e, simpson);
        [("smallest", ratios.map(|r| r.least)), ("largest", ratios.map(|r| r.most))].map(|(which, ratio)| {
            let name = format!("{how}, e = {e}, against {against}: {which} ratio");
            Check::new(name, ratio, Bound::Within(low, high))
        })
    };
    checks.into_iter().flat_map(check).collect()
}

fn notes(all: &[Comparison]) -> Vec<String> {
    let line = |c: &Comparison| {
        let how = match c.steps {
            Steps::Fixed => "fixed steps, (19) in the discrete Lagrangian",
            Steps::Controlled => "(23) as printed, (19) left-frozen",
        };
        let Comparison { e, reference, energy, fitted, linear, .. } = c;
        let ratio = c.ratio();
        format!(
            "e = {e}, {how}, max|ΔE| = {energy:.2e}: {fitted:.0} steps per period against {linear:.0} of \
             {reference}: {ratio:.3}."
        )
    };
    all.iter().filter(|c| c.e == HIGH).map(line).collect()
}

fn figure(all: &[Comparison]) -> Figure {
    let of = |reference: &'static str, steps: Steps| {
        all.iter().filter(move |c| c.reference == reference && c.steps == steps)
    };
    let at_high = |reference| of(reference, Steps::Controlled).filter(|c| c.e == HIGH);
    let fitted: Vec<_> = at_high(REFERENCES[0].0).map(|c| [c.energy, c.fitted]).collect();
    let title = format!("Steps over one period, *e* = {HIGH}, both with (23)");
    let steps = Panel::new(title, Axis::logarithmic("max|*E* − *E*(0)|"), Axis::logarithmic("steps"))
        .line(fitted.clone(), Stroke::solid(VERMILLION))
        .discs(fitted, VERMILLION, Fill::Solid)
        .labelled("phase-fitted")
        .each(REFERENCES, |panel, (reference, _, colour)| {
            let points: Vec<_> = at_high(reference).map(|c| [c.energy, c.linear]).collect();
            let line = panel.line(points.clone(), Stroke::dashed(colour));
            line.discs(points, colour, Fill::Hollow).labelled(reference)
        });
    let compared = |title: &str, steps: Steps| {
        let e = Axis::names("eccentricity", ECCENTRICITIES.iter().map(f64::to_string).collect());
        let place =
            |e: f64| ECCENTRICITIES.iter().position(|x| *x == e).map_or(f64::NAN, |place| place as f64);
        Panel::new(title, e, Axis::linear("steps, phase-fitted / linear").within(0.0, 1.7))
            .line(vec![[-0.6, THIRD], [3.6, THIRD]], Stroke::dashed(SLATE).width(1.2))
            .labelled("one third")
            .each(
                REFERENCES.into_iter().zip([-0.18, 0.0, 0.18]),
                |panel, ((reference, _, colour), aside)| {
                    let points = of(reference, steps).map(|c| [place(c.e) + aside, c.ratio()]).collect();
                    panel.discs(points, colour, Fill::Hollow).labelled(format!("against {reference}"))
                },
            )
    };
    // What was found against midpoint and trapezoid at the eccentricity of the paper.
    let [printed, fixed] =
        [("with (23)", Steps::Controlled), ("with fixed steps", Steps::Fixed)].map(|(name, steps)| {
            let found = ratios(all, steps, HIGH, false).map(|Ratios { least, most, count, above }| {
                format!("{name} {least:.3} to {most:.3}, {above} of {count} above one third")
            });
            found.unwrap_or_else(|| format!("{name} none"))
        });
    let controlled = compared("Both with (23) as printed", Steps::Controlled);
    Figure::new(
        "“One third of the steps”: phase-fitted Simpson against linear rules, for equal energy error",
        format!("Ratios at *e* = {HIGH}, against midpoint and trapezoid: {printed}; {fixed}"),
    )
    .row(430.0, vec![steps, controlled, compared("Both with fixed steps", Steps::Fixed).without_legend()])
    .footer(
        "After Kosmas & Vlachos, Fig. 2. Frequency (19): left-frozen with (23), in the discrete \
             Lagrangian with fixed steps.",
    )
}
