//! The harmonic oscillator, solved exactly at any step (Kosmas & Vlachos, eqs. 12–15).
//!
//! With interpolation fitted to u = ωh, every rule gives the recursion q_{k+1} = 2 cos(u) q_k − q_{k−1},
//! where sin u ≠ 0 and S = Σ w cos((1 − 2c)u) ≠ 0. The momentum is s·v with s = uS/sin u: a run that starts
//! from a velocity has a wrong amplitude for ever, unless the weights are fitted too.

use crate::claim::larger;
use anyhow::Result;
use dvi_core::discrete::{Frequency, FrequencyIn, Rule};
use dvi_core::prelude::*;
use rayon::prelude::*;

use crate::claim::{BEYOND, Bound, Check, Claim};
use crate::figure::{
    Anchor, Axis, BLUE, Colour, Corner, Figure, GREEN, INK, PURPLE, Panel, SLATE, Stroke, VERMILLION,
    at_most,
};
use crate::gallery::{Experiment, Outcome};
use crate::job::Job;
use crate::models::{Spring, SpringState};
use crate::output::{Table, number};

pub const EXPERIMENT: Experiment =
    Experiment { name: "oscillator", title: "The harmonic oscillator, exact at any step", share: 10.0, run };

const SYSTEM: Spring = Spring { k: 1.0 };
/// Where the phase is 45°: an error of the velocity shows as well as one of the position.
const START: SpringState = SpringState { x: 1.0, dot_x: 1.0 };
/// u from 0.1 to 3.
const STEPS: u32 = 30;
/// Runs from given velocities take that many steps.
const FEW: u64 = 1000;
/// √3 π/2: the two-point Gauss rule has S = cos(u/√3) = 0 there.
const RESONANCE: f64 = 2.720_699_046_35;

/// The rules that the figure shows.
const SHOWN: [(&str, Colour); 4] =
    [("midpoint", BLUE), ("trapezoid", SLATE), ("Simpson", VERMILLION), ("Gauss, 2 nodes", INK)];

/// A number for each u.
type Curve = Vec<[f64; 2]>;

/// What is measured of one rule.
struct Row {
    name: &'static str,
    /// max |q_k − exact orbit through q_0 and q_1|.
    recursion: Curve,
    /// p/v by the first step of a run.
    defect: Curve,
}

/// A run from given position and velocity: max |q_k − exact|.
struct Errors {
    name: &'static str,
    stroke: Stroke,
    errors: Curve,
}

fn run(job: &Job<'_>) -> Result<Outcome> {
    let many = job.choose(100_000, 10_000);
    let rules = rules()?;
    job.expect(u64::from(STEPS) * (rules.len() as u64 * (many + 1) + 7 * FEW));
    let row = |&(name, rule): &(&'static str, Quadrature)| {
        let recursion = grid().map(|u| Ok([u, recursion_error(job, rule, u, many)?]));
        let recursion = recursion.collect::<Result<_>>()?;
        let defect = grid().map(|u| Ok([u, momentum_factor(job, rule, u)?])).collect::<Result<_>>()?;
        Ok(Row { name, recursion, defect })
    };
    let rows: Vec<Row> = rules.par_iter().map(row).collect::<Result<_>>()?;
    let all = from_velocities(job)?;
    job.publish(EXPERIMENT.name, figure(&rules, &rows, &all, many), table(&rows, &all)?)?;
    if job.was_interrupted() {
        return Ok(Outcome::default());
    }
    Ok(Outcome { claims: claims(&rows, &all)?, references: references(&rows), notes: vec![] })
}

fn grid() -> impl Iterator<Item = f64> {
    (1..=STEPS).map(|k| f64::from(k) * 0.1)
}

fn rules() -> Result<Vec<(&'static str, Quadrature)>> {
    Ok(vec![
        ("midpoint", Quadrature::midpoint()),
        ("trapezoid", Quadrature::trapezoid()),
        ("Simpson", Quadrature::simpson()),
        ("Lobatto, 4 nodes", Quadrature::lobatto(4)?),
        ("Lobatto, 5 nodes", Quadrature::lobatto(5)?),
        ("Gauss, 2 nodes", Quadrature::gauss(2)?),
        ("Gauss, 3 nodes", Quadrature::gauss(3)?),
        ("Gauss, 5 nodes", Quadrature::gauss(5)?),
    ])
}

/// The rule fitted to the oscillator.
fn fitted(rule: Quadrature) -> Variational<Constant> {
    Variational::new(rule).phase_fitted(Constant(1.0))
}

/// How far a run of step `u` is from the exact orbit through its first two points.
fn recursion_error(job: &Job<'_>, rule: Quadrature, u: f64, steps: u64) -> Result<f64> {
    let mut run = Integrator::new(&SYSTEM, fitted(rule), u, START)?;
    let (sin, cos) = u.sin_cos();
    let (mut sine_part, mut k, mut largest) = (0.0, 0, 0.0f64);
    job.repeat(steps, || {
        run.advance()?;
        let q = run.q()[0];
        k += 1;
        if k == 1 {
            sine_part = (q - START.x * cos) / sin;
        }
        let (sin, cos) = (f64::from(k) * u).sin_cos();
        largest = larger(largest, (q - START.x * cos - sine_part * sin).abs());
        Ok(())
    })?;
    Ok(largest)
}

/// s, from the first step of a run through the origin: q_1 = (v/s) sin u.
fn momentum_factor(job: &Job<'_>, rule: Quadrature, u: f64) -> Result<f64> {
    let mut run = Integrator::new(&SYSTEM, fitted(rule), u, SpringState { x: 0.0, dot_x: 1.0 })?;
    job.repeat(1, || run.advance())?;
    Ok(u.sin() / run.q()[0])
}

/// The errors of linear and of fitted interpolation from the same position and velocity.
fn from_velocities(job: &Job<'_>) -> Result<Vec<Errors>> {
    let linear = Variational::new;
    let both = |rule| Variational { fitting: Fitting::PhaseAndMomentum, ..fitted(rule) };
    let [midpoint, trapezoid, simpson] =
        [Quadrature::midpoint(), Quadrature::trapezoid(), Quadrature::simpson()];
    Ok(vec![
        Errors::of(job, "midpoint, linear", Stroke::dashed(BLUE), linear(midpoint))?,
        Errors::of(job, "Verlet, linear", Stroke::dashed(SLATE), linear(trapezoid))?,
        Errors::of(job, "Simpson, linear", Stroke::dashed(VERMILLION), linear(simpson))?,
        Errors::of(job, "midpoint, phase", Stroke::solid(BLUE), fitted(midpoint))?,
        Errors::of(job, "Simpson, phase", Stroke::solid(VERMILLION), fitted(simpson))?,
        Errors::of(job, "midpoint, phase and *p*", Stroke::solid(GREEN), both(midpoint))?,
        Errors::of(job, "Simpson, phase and *p*", Stroke::solid(PURPLE), both(simpson))?,
    ])
}

impl Errors {
    fn of<F>(job: &Job<'_>, name: &'static str, stroke: Stroke, method: Variational<F>) -> Result<Self>
    where
        F: FrequencyIn<f64> + Frequency + Copy,
    {
        let error = |u: f64| {
            let mut run = Integrator::new(&SYSTEM, method, u, START)?;
            let mut largest = 0.0f64;
            job.repeat(FEW, || {
                // Beyond its limit of stability, Verlet goes on to infinity.
                if largest < 1e3 {
                    run.advance()?;
                    let (sin, cos) = run.time().sin_cos();
                    largest = larger(largest, (run.q()[0] - START.x * cos - START.dot_x * sin).abs());
                }
                Ok(())
            })?;
            Ok([u, largest])
        };
        Ok(Self { name, stroke, errors: grid().map(error).collect::<Result<_>>()? })
    }
}

/// S = Σ w cos((1 − 2c)u).
fn strength(rule: &Quadrature, u: f64) -> f64 {
    let terms = rule.nodes().iter().zip(rule.weights());
    terms.map(|(c, w)| w * ((1.0 - 2.0 * c) * u).cos()).sum()
}

/// s = uS/sin u.
fn formula(rule: &Quadrature, u: f64) -> f64 {
    strength(rule, u) * u / u.sin()
}

/// What rounding is multiplied by: a step divides by S and by sin u.
fn condition(rule: &Quadrature, u: f64) -> f64 {
    (strength(rule, u) * u.sin()).abs()
}

/// The largest error of all recursions away from the resonances.
fn well_placed(rows: &[Row], rules: &[(&str, Quadrature)]) -> f64 {
    let pairs = rows.iter().zip(rules);
    let errors = pairs.flat_map(|(row, (_, rule))| {
        row.recursion.iter().filter(|[u, _]| condition(rule, *u) >= 0.1).map(|[_, error]| *error)
    });
    errors.fold(0.0, larger)
}

/// Numbers of independent programs.
fn references(rows: &[Row]) -> Vec<Check> {
    let at_one = |row: usize| rows[row].defect.iter().find(|[u, _]| *u == 1.0).map(|[_, s]| *s);
    vec![
        Check::new("midpoint at u = 1: s", at_one(0), Bound::Near(1.188_395_105_778, 1e-11)),
        Check::new("Simpson at u = 1: s", at_one(2), Bound::Near(1.006_294_275_830, 1e-11)),
    ]
}

fn claims(rows: &[Row], all: &[Errors]) -> Result<Vec<Claim>> {
    let largest = |curve: &Curve| curve.iter().map(|[_, y]| *y).fold(0.0, larger);
    let exact =
        Claim::new("eqs. 13–15", "the phase-fitted family solves the oscillator exactly at any step");
    let rules = rules()?;
    let mut exact = exact;
    for (row, (name, rule)) in rows.iter().zip(&rules) {
        let weighted = row.recursion.iter().map(|&[u, error]| error * condition(rule, u));
        let weighted = weighted.fold(0.0, larger);
        let quantity = format!("{name}: largest error of the recursion times |S sin u|, u = 0.1 … 3");
        exact = exact.check(quantity, weighted, Bound::AtMost(1e-9));
    }
    let well = well_placed(rows, &rules);
    let exact = exact.check("all rules: largest error where |S sin u| ≥ 0.1", well, Bound::AtMost(1e-9));
    let mut deviation = 0.0f64;
    for (row, (_, rule)) in rows.iter().zip(&rules) {
        let relative = row.defect.iter().map(|&[u, s]| (s / formula(rule, u) - 1.0).abs());
        deviation = relative.fold(deviation, larger);
    }
    let momenta = Claim::new(BEYOND, "only the positions are: p = s·v with s = uS/sin u").check(
        "largest relative deviation from the formula",
        deviation,
        Bound::AtMost(1e-11),
    );
    let at = |name: &str| all.iter().find(|errors| errors.name == name).map(|errors| &errors.errors);
    // With v = ω = 1, the error of the amplitude is 1 − 1/s.
    let amplitude = at("midpoint, phase").and_then(|curve| curve.iter().find(|[u, _]| *u == 1.0));
    let amplitudes =
        Claim::new(BEYOND, "a start from velocities costs |v(1/s − 1)/ω|, unless weights are fitted too")
            .check(
                "phase only, midpoint at u = 1: max|q − exact|",
                amplitude.map(|[_, error]| *error),
                Bound::Near(1.0 - 1.0 / formula(&Quadrature::midpoint(), 1.0), 1e-4),
            )
            .check(
                "momenta too, midpoint: max|q − exact|",
                at("midpoint, phase and *p*").map(largest),
                Bound::AtMost(1e-10),
            )
            .check(
                "momenta too, Simpson: max|q − exact|",
                at("Simpson, phase and *p*").map(largest),
                Bound::AtMost(1e-10),
            );
    Ok(vec![exact, momenta, amplitudes, resonance()?])
}

fn resonance() -> Result<Claim> {
    let refused = match Integrator::new(&SYSTEM, fitted(Quadrature::gauss(2)?), RESONANCE, START) {
        Err(StartError::Starter(StepFailure::Resonance { cosine_sum, .. })) => Some(cosine_sum),
        _ => None,
    };
    Ok(Claim::new(BEYOND, "where S = 0 the step does not exist, and a run is refused").check(
        "two-point Gauss at u = √3 π/2: |S| in the error",
        refused.map_or(f64::NAN, f64::abs),
        Bound::AtMost(1e-10),
    ))
}

fn figure(rules: &[(&str, Quadrature)], rows: &[Row], all: &[Errors], many: u64) -> Figure {
    let u = || Axis::linear("*u* = ω*h*").within(0.0, 3.1);
    let error = || Axis::logarithmic("largest error of the position");
    let title = format!("From a velocity, {FEW} steps");
    let given = all.iter().fold(Panel::new(title, u(), error().within(1e-16, 1e2)), |panel, errors| {
        panel.line(errors.errors.clone(), errors.stroke).labelled(errors.name)
    });
    let title = format!("Recursion, {many} steps");
    let recursion = Panel::new(title, u(), error().within(1e-14, 1e-2));
    // Four of the eight rules; the others lie among them, and are in the table.
    let recursion = SHOWN.into_iter().fold(recursion, |panel, (name, colour)| {
        let errors = rows.iter().find(|row| row.name == name).map(|row| row.recursion.clone());
        panel.dots(errors.unwrap_or_default(), 2.5, colour).labelled(name)
    });
    let recursion = recursion
        .note([std::f64::consts::FRAC_PI_2, 3e-8], Anchor::Middle, SLATE, "*S* = 0,")
        .note([std::f64::consts::FRAC_PI_2, 6e-9], Anchor::Middle, SLATE, "trapezoid")
        .note([2.5, 3e-7], Anchor::Middle, INK, "*S* = 0, Gauss");
    let factor = Panel::new("Momentum over velocity", u(), Axis::linear("*s* = *p*/*v*").within(-1.0, 4.0));
    let factor = SHOWN.into_iter().fold(factor, |panel, (name, colour)| {
        let measured = rows.iter().find(|row| row.name == name).map(|row| row.defect.clone());
        let rule = rules.iter().find(|(rule, _)| *rule == name).map(|(_, rule)| rule);
        let curve = rule.map(|rule| (1..310).map(|k| f64::from(k) * 0.01).map(|u| [u, formula(rule, u)]));
        let curve = curve.map(Iterator::collect).unwrap_or_default();
        let panel = panel.line(curve, Stroke::solid(colour).width(1.2)).labelled(name);
        panel.dots(measured.unwrap_or_default(), 3.0, colour)
    });
    Figure::new(
        "The harmonic oscillator at steps up to *u* = ω*h* = 3, with and without phase fitting",
        format!(
            "Phase-fitted recursion: errors up to {}, where |*S* sin *u*| ≥ 0.1, over {many} steps; dashed: linear interpolation",
            at_most(well_placed(rows, rules))
        ),
    )
    .row(
        460.0,
        vec![
            given.legend_at(Corner::Beside).weight(1.6),
            recursion.legend_at(Corner::TopLeft),
            factor.legend_at(Corner::TopLeft),
        ],
    )
    .footer("Kosmas & Vlachos, section 3; the momentum is not in the paper. *S* = Σ*w* cos((1 − 2*c*)*u*); a step divides by it. Right: dots measured, lines *s* = *uS*/sin *u*.")
}

fn table(rows: &[Row], all: &[Errors]) -> Result<Table> {
    let mut table = Table::new(&["quantity", "rule", "u", "value"])?;
    let series = rows.iter().flat_map(|row| {
        [("recursion error", row.name, &row.recursion), ("momentum factor", row.name, &row.defect)]
    });
    let series =
        series.chain(all.iter().map(|errors| ("error from velocities", errors.name, &errors.errors)));
    for (quantity, name, curve) in series {
        for [u, value] in curve {
            table.row([quantity.to_owned(), name.to_owned(), number(*u), number(*value)])?;
        }
    }
    Ok(table)
}
