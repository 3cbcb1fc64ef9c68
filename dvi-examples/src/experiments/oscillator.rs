//! The harmonic oscillator, solved exactly at any step (Kosmas & Vlachos, eqs. 12–15).
//!
//! With interpolation fitted to u = ωh, every rule gives the recursion q_{k+1} = 2 cos(u) q_k − q_{k−1},
//! where sin u ≠ 0 and S = Σ w cos((1 − 2c)u) ≠ 0. The momentum is s·v with s = uS/sin u: a run that starts
//! from a velocity has a wrong amplitude for ever, unless the weights are fitted too.

use std::f64::consts::FRAC_PI_2;

use dvi_core::discrete::{Frequency, FrequencyIn, Rule as _};
use rayon::prelude::*;

use crate::models::{Spring, SpringState};
use crate::vocabulary::*;

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
    rule: Quadrature,
    /// max |q_k − exact orbit through q_0 and q_1|.
    recursion: Curve,
    /// p/v by the first step of a run.
    defect: Curve,
}

/// A run from given position and velocity: max |q_k − exact|.
type Errors = (&'static str, Stroke, Curve);

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let many = job.choose(100_000, 10_000);
    let rules = [
        ("midpoint", Quadrature::midpoint()),
        ("trapezoid", Quadrature::trapezoid()),
        ("Simpson", Quadrature::simpson()),
        ("Lobatto, 4 nodes", Quadrature::lobatto(4)?),
        ("Lobatto, 5 nodes", Quadrature::lobatto(5)?),
        ("Gauss, 2 nodes", Quadrature::gauss(2)?),
        ("Gauss, 3 nodes", Quadrature::gauss(3)?),
        ("Gauss, 5 nodes", Quadrature::gauss(5)?),
    ];
    job.expect(u64::from(STEPS) * (rules.len() as u64 * (many + 1) + 7 * FEW));
    let row = |&(name, rule): &(&'static str, Quadrature)| {
        let recursion = curve(|u| recursion_error(job, rule, u, many))?;
        Ok(Row { name, rule, recursion, defect: curve(|u| momentum_factor(job, rule, u))? })
    };
    let rows: Vec<Row> = rules.par_iter().map(row).collect::<Result<_>>()?;
    let all = from_velocities(job)?;
    let of_rules = rows.iter().flat_map(|Row { name, recursion, defect, .. }| {
        [("recursion error", *name, recursion), ("momentum factor", name, defect)]
    });
    let given = all.iter().map(|(name, _, errors)| ("error from velocities", *name, errors));
    let cells = of_rules
        .chain(given)
        .flat_map(|(what, name, curve)| curve.iter().map(move |row| ([what, name], *row)));
    job.publish(figure(&rows, &all, many), Table::of(&["quantity", "rule", "u", "value"], cells)?)?;
    if job.was_interrupted() {
        return Ok(Outcome::default());
    }
    // Numbers of independent programs.
    let at_one = |row: usize| rows[row].defect.iter().find(|[u, _]| *u == 1.0).map(|[_, s]| *s);
    let references = vec![
        Check::new("midpoint at u = 1: s", at_one(0), Bound::Near(1.188_395_105_778, 1e-11)),
        Check::new("Simpson at u = 1: s", at_one(2), Bound::Near(1.006_294_275_830, 1e-11)),
    ];
    Ok(Outcome { claims: claims(&rows, &all)?, references, notes: vec![] })
}

/// A number that is measured at each u.
fn curve(measured: impl Fn(f64) -> Result<f64>) -> Result<Curve> {
    (1..=STEPS).map(|k| f64::from(k) * 0.1).map(|u| Ok([u, measured(u)?])).collect()
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
    job.follow(&mut run, steps, |run| {
        let q = run.q()[0];
        k += 1;
        if k == 1 {
            sine_part = (q - START.x * cos) / sin;
        }
        let (sin, cos) = (f64::from(k) * u).sin_cos();
        largest = larger(largest, (q - START.x * cos - sine_part * sin).abs());
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
fn from_velocities(job: &Job<'_>) -> Result<[Errors; 7]> {
    let linear = Variational::new;
    let both = |rule| Variational { fitting: Fitting::PhaseAndMomentum, ..fitted(rule) };
    let [midpoint, trapezoid, simpson] =
        [Quadrature::midpoint(), Quadrature::trapezoid(), Quadrature::simpson()];
    Ok([
        ("midpoint, linear", Stroke::dashed(BLUE), errors(job, linear(midpoint))?),
        ("Verlet, linear", Stroke::dashed(SLATE), errors(job, linear(trapezoid))?),
        ("Simpson, linear", Stroke::dashed(VERMILLION), errors(job, linear(simpson))?),
        ("midpoint, phase", Stroke::solid(BLUE), errors(job, fitted(midpoint))?),
        ("Simpson, phase", Stroke::solid(VERMILLION), errors(job, fitted(simpson))?),
        ("midpoint, phase and *p*", Stroke::solid(GREEN), errors(job, both(midpoint))?),
        ("Simpson, phase and *p*", Stroke::solid(PURPLE), errors(job, both(simpson))?),
    ])
}

fn errors<F: FrequencyIn<f64> + Frequency + Copy>(job: &Job<'_>, method: Variational<F>) -> Result<Curve> {
    curve(|u| {
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
        Ok(largest)
    })
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

impl Row {
    /// What rounding is multiplied by: a step divides by S and by sin u.
    fn condition(&self, u: f64) -> f64 {
        (strength(&self.rule, u) * u.sin()).abs()
    }
}

/// The largest error of all recursions away from the resonances.
fn well_placed(rows: &[Row]) -> f64 {
    let all = rows.iter().flat_map(|row| row.recursion.iter().filter(|[u, _]| row.condition(*u) >= 0.1));
    largest(all.map(|[_, error]| *error))
}

fn claims(rows: &[Row], all: &[Errors]) -> Result<Vec<Claim>> {
    let defects =
        rows.iter().flat_map(|row| row.defect.iter().map(|&[u, s]| (s / formula(&row.rule, u) - 1.0).abs()));
    let at = |name: &str| all.iter().find(|errors| errors.0 == name).map(|errors| &errors.2);
    let most = |name: &str| at(name).map(|curve| largest(curve.iter().map(|[_, error]| *error)));
    // With v = ω = 1, the error of the amplitude is 1 − 1/s.
    let amplitude = at("midpoint, phase").and_then(|curve| curve.iter().find(|[u, _]| *u == 1.0));
    let expected = 1.0 - 1.0 / formula(&Quadrature::midpoint(), 1.0);
    let refused = match Integrator::new(&SYSTEM, fitted(Quadrature::gauss(2)?), RESONANCE, START) {
        Err(StartError::Starter(StepFailure::Resonance { cosine_sum, .. })) => cosine_sum.abs(),
        _ => f64::NAN,
    };
    Ok(vec![
        Claim::new("eqs. 13–15", "the phase-fitted family solves the oscillator exactly at any step")
            .each(rows, |claim, row| {
                let name = row.name;
                let weighted = largest(row.recursion.iter().map(|&[u, error]| error * row.condition(u)));
                let quantity = "largest error of the recursion times |S sin u|, u = 0.1 … 3";
                claim.of(name).at_most(quantity, weighted, 1e-9)
            })
            .at_most("all rules: largest error where |S sin u| ≥ 0.1", well_placed(rows), 1e-9),
        beyond("only the positions are: p = s·v with s = uS/sin u").at_most(
            "largest relative deviation from the formula",
            largest(defects),
            1e-11,
        ),
        beyond("a start from velocities costs |v(1/s − 1)/ω|, unless weights are fitted too")
            .near(
                "phase only, midpoint at u = 1: max|q − exact|",
                amplitude.map(|[_, error]| *error),
                [expected, 1e-4],
            )
            .at_most("momenta too, midpoint: max|q − exact|", most("midpoint, phase and *p*"), 1e-10)
            .at_most("momenta too, Simpson: max|q − exact|", most("Simpson, phase and *p*"), 1e-10),
        beyond("where S = 0 the step does not exist, and a run is refused").at_most(
            "two-point Gauss at u = √3 π/2: |S| in the error",
            refused,
            1e-10,
        ),
    ])
}

fn figure(rows: &[Row], all: &[Errors], many: u64) -> Figure {
    let u = || Axis::linear("*u* = ω*h*").within(0.0, 3.1);
    let error = || Axis::logarithmic("largest error of the position");
    // Four of the eight rules; the others lie among them, and are in the table.
    let shown = || {
        SHOWN.iter().filter_map(|&(name, colour)| Some((rows.iter().find(|row| row.name == name)?, colour)))
    };
    let given = Panel::new(format!("From a velocity, {FEW} steps"), u(), error().within(1e-16, 1e2));
    let given = given.lines(all.iter().map(|(name, stroke, errors)| (*name, *stroke, errors.clone())));
    let recursion = Panel::new(format!("Recursion, {many} steps"), u(), error().within(1e-14, 1e-2))
        .each(shown(), |panel, (row, colour)| {
            panel.dots(row.recursion.clone(), 2.5, colour).labelled(row.name)
        })
        .note([FRAC_PI_2, 3e-8], Anchor::Middle, SLATE, "*S* = 0,")
        .note([FRAC_PI_2, 6e-9], Anchor::Middle, SLATE, "trapezoid")
        .note([2.5, 3e-7], Anchor::Middle, INK, "*S* = 0, Gauss");
    let factor = Panel::new("Momentum over velocity", u(), Axis::linear("*s* = *p*/*v*").within(-1.0, 4.0));
    let factor = factor.each(shown(), |panel, (row, colour)| {
        let curve = (1..310).map(|k| f64::from(k) * 0.01).map(|u| [u, formula(&row.rule, u)]).collect();
        let panel = panel.line(curve, Stroke::solid(colour).width(1.2)).labelled(row.name);
        panel.dots(row.defect.clone(), 3.0, colour)
    });
    let [recursion, factor] = [recursion, factor].map(|panel| panel.legend_at(Corner::TopLeft));
    Figure::new(
        "The harmonic oscillator at steps up to *u* = ω*h* = 3, with and without phase fitting",
        format!(
            "Phase-fitted recursion: errors up to {}, where |*S* sin *u*| ≥ 0.1, over {many} steps; \
             dashed: linear interpolation",
            at_most(well_placed(rows))
        ),
    )
    .row(460.0, vec![given.legend_at(Corner::Beside).weight(1.6), recursion, factor])
    .footer(
        "Kosmas & Vlachos, section 3; the momentum is not in the paper. *S* = Σ*w* cos((1 − 2*c*)*u*); \
             a step divides by it. Right: dots measured, lines *s* = *uS*/sin *u*.",
    )
}
