//! The harmonic oscillator, solved exactly at any step (Kosmas & Vlachos, eqs. 12–15).
//!
//! With interpolation fitted to u = ωh, every rule gives the recursion q_{k+1} = 2 cos(u) q_k − q_{k−1},
//! where sin u ≠ 0 and S = Σ w cos((1 − 2c)u) ≠ 0. The momentum is s·v with s = uS/sin u: a run that starts
//! from a velocity has a wrong amplitude for ever, unless the weights are fitted too. With displacements of
//! interior nodes (section 6) the recursion is not exact: they do not vanish on the fitted oscillator.

use dvi_core::methods::Method;

use crate::vocabulary::*;

const SYSTEM: Spring = Spring { k: 1.0 };
/// Where the phase is 45°: an error of the velocity shows as well as one of the position.
const START: SpringState = SpringState { x: 1.0, dot_x: 1.0 };
/// u from 0.1 to 3.
const STEPS: u32 = 30;
const FEW: u64 = 1000;
/// √3 π/2: the two-point Gauss rule has S = cos(u/√3) = 0 there.
const RESONANCE: f64 = 2.720_699_046_35;
/// Four of the eight rules are drawn; the others lie among them, and are in the table.
const SHOWN: [(usize, Colour); 4] = [(0, BLUE), (1, SLATE), (2, VERMILLION), (5, INK)];

/// A rule, with max |q_k − exact orbit through q_0 and q_1|, and p/v by the first step of a run.
type Row = (&'static str, Quadrature, Points, Points);

/// A run from given position and velocity: max |q_k − exact|.
type Given = Line<&'static str>;

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
    let rows = each(rules, |(name, rule)| {
        Ok((name, rule, curve(|u| recursion_error(rule, u, many))?, curve(|u| momentum_factor(rule, u))?))
    })?;
    let [midpoint, trapezoid, simpson] = [0, 1, 2].map(|rule| rules[rule].1);
    let both = |rule| Variational { fitting: Fitting::PhaseAndMomentum, ..fitted(rule) };
    let given = [
        ("midpoint, linear", dashed(BLUE), errors(Variational::new(midpoint))?),
        ("Verlet, linear", dashed(SLATE), errors(Variational::new(trapezoid))?),
        ("Simpson, linear", dashed(VERMILLION), errors(Variational::new(simpson))?),
        ("midpoint, phase", solid(BLUE), errors(fitted(midpoint))?),
        ("Simpson, phase", solid(VERMILLION), errors(fitted(simpson))?),
        ("midpoint, phase and *p*", solid(GREEN), errors(both(midpoint))?),
        ("Simpson, phase and *p*", solid(PURPLE), errors(both(simpson))?),
    ];
    let of_rules = rows.iter().flat_map(|(name, _, recursion, factor)| {
        [(["recursion error", name], [], recursion.clone()), (["momentum factor", name], [], factor.clone())]
    });
    let curves = given.iter().map(|(name, _, all)| (["error from velocities", *name], [], all.clone()));
    job.publish(figure(&rows, &given, many), curve_table("quantity,rule,u,value", of_rules.chain(curves)))?;
    // Numbers of independent programs.
    let [midpoint, simpson] = [0, 2].map(|rule| at_one(&rows[rule].3));
    let references = vec![
        Check::new("midpoint at u = 1: s", midpoint, Bound::Near(1.188_395_105_778, 1e-11)),
        Check::new("Simpson at u = 1: s", simpson, Bound::Near(1.006_294_275_830, 1e-11)),
    ];
    Ok(Outcome { claims: claims(&rows, &given)?, references, notes: vec![] })
}

/// A number that is measured at each u, and what it is at u = 1.
fn curve(measured: impl Fn(f64) -> Result<f64>) -> Result<Points> {
    (1..=STEPS).map(|k| f64::from(k) * 0.1).map(|u| Ok([u, measured(u)?])).collect()
}

fn at_one(curve: &Points) -> Option<f64> {
    curve.iter().find(|[u, _]| *u == 1.0).map(|[_, value]| *value)
}

fn fitted(rule: Quadrature) -> Variational<Constant> {
    Variational::new(rule).phase_fitted(Constant(1.0))
}

/// How far a run of step `u` is from the exact orbit through its first two points.
fn recursion_error(rule: Quadrature, u: f64, steps: u64) -> Result<f64> {
    let q = course(&mut Integrator::new(&SYSTEM, fitted(rule), u, START)?, steps, |run| run.q()[0])?;
    let sine_part = (q[1] - START.x * u.cos()) / u.sin();
    Ok(largest(q.iter().enumerate().skip(1).map(|(k, q)| {
        let (sin, cos) = (k as f64 * u).sin_cos();
        (q - START.x * cos - sine_part * sin).abs()
    })))
}

/// s, from the first step of a run through the origin: q_1 = (v/s) sin u.
fn momentum_factor(rule: Quadrature, u: f64) -> Result<f64> {
    let mut run = Integrator::new(&SYSTEM, fitted(rule), u, SpringState { x: 0.0, dot_x: 1.0 })?;
    run.advance()?;
    Ok(u.sin() / run.q()[0])
}

fn errors<F: Frequency + Copy>(method: Variational<F>) -> Result<Points> {
    curve(|u| {
        let (mut run, mut largest) = (Integrator::new(&SYSTEM, method, u, START)?, 0.0f64);
        // Beyond its limit of stability, Verlet goes on to infinity.
        while run.steps() < FEW && largest < 1e3 {
            run.advance()?;
            let (sin, cos) = run.time().sin_cos();
            largest = larger(largest, (run.q()[0] - START.x * cos - START.dot_x * sin).abs());
        }
        Ok(largest)
    })
}

/// By how much a step of `u` turns the oscillator too far: 2 cos θ is (q_0 + q_2)/q_1.
fn phase_error(method: impl Method<Spring, f64>, u: f64) -> Result<f64> {
    let q = course(&mut Integrator::new(&SYSTEM, method, u, START)?, 2, |run| run.q()[0])?;
    Ok((((q[0] + q[2]) / (2.0 * q[1])).acos() - u).abs())
}

/// S = Σ w cos((1 − 2c)u)
fn strength(rule: &Quadrature, u: f64) -> f64 {
    rule.nodes().iter().zip(rule.weights()).map(|(c, w)| w * ((1.0 - 2.0 * c) * u).cos()).sum()
}

/// s = uS/sin u
fn formula(rule: &Quadrature, u: f64) -> f64 {
    strength(rule, u) * u / u.sin()
}

/// S sin u, by which a step divides, and rounding with it.
fn condition(rule: &Quadrature, u: f64) -> f64 {
    (strength(rule, u) * u.sin()).abs()
}

fn claims(rows: &[Row; 8], given: &[Given; 7]) -> Result<Vec<Claim>> {
    let [_, _, _, phase, _, both, simpson_both] = given.each_ref().map(|(_, _, errors)| errors);
    let most = |curve: &Points| largest(curve.iter().map(|[_, error]| *error));
    let well_placed = rows.iter().flat_map(|(_, rule, recursion, _)| {
        recursion.iter().filter(|[u, _]| condition(rule, *u) >= 0.1).map(|[_, error]| *error)
    });
    let defects = rows
        .iter()
        .flat_map(|(_, rule, _, factor)| factor.iter().map(|&[u, s]| (s / formula(rule, u) - 1.0).abs()));
    // With v = ω = 1, the error of the amplitude is 1 − 1/s.
    let expected = 1.0 - 1.0 / formula(&Quadrature::midpoint(), 1.0);
    let refused = match Integrator::new(&SYSTEM, fitted(Quadrature::gauss(2)?), RESONANCE, START) {
        Err(StartError::Starter(StepFailure::Resonance { cosine_sum, .. })) => cosine_sum.abs(),
        _ => f64::NAN,
    };
    let bent = Galerkin::<3>::new();
    let displaced = phase_error(bent.phase_fitted(Constant(1.0)), 0.5)?;
    let (share, gained) = (displaced * 13824.0 / 0.5f64.powi(7), phase_error(bent, 0.5)? / displaced);
    let weighted = "largest error of the recursion times |S sin u|, u = 0.1 … 3";
    let positions = "only the positions are: p = s·v with s = uS/sin u";
    let resonance = "where S = 0 the step does not exist, and a run is refused";
    Ok(vec![
        says("eqs. 13–15", "the phase-fitted family solves the oscillator exactly at any step")
            .each(rows, |claim, (name, rule, recursion, _)| {
                let errors = recursion.iter().map(|&[u, error]| error * condition(rule, u));
                claim.of(name).at_most(weighted, largest(errors), 1e-9)
            })
            .at_most("all rules: largest error where |S sin u| ≥ 0.1", largest(well_placed), 1e-9),
        beyond(positions).at_most("largest relative deviation from the formula", largest(defects), 1e-11),
        beyond("a start from velocities costs |v(1/s − 1)/ω|, unless weights are fitted too")
            .near("phase only, midpoint at u = 1: max|q − exact|", at_one(phase), [expected, 1e-4])
            .at_most("momenta too, midpoint: max|q − exact|", most(both), 1e-10)
            .at_most("momenta too, Simpson: max|q − exact|", most(simpson_both), 1e-10),
        beyond("with interior displacements (section 6) the phase of a step is fitted to u⁷/13824")
            .near("3 nodes, u = ½: phase error of a step · 13824/u⁷", share, [1.0, 0.05])
            .at_least("the same with linear interpolation / fitted", gained, 5.0),
        beyond(resonance).at_most("two-point Gauss at u = √3 π/2: |S| in the error", refused, 1e-10),
    ])
}

fn figure(rows: &[Row; 8], given: &[Given; 7], many: u64) -> Figure {
    let (u, error) = (("*u* = ω*h*", [0.0, 3.1]), "largest error of the position");
    let velocity = Panel::semilog(format!("From a velocity, {FEW} steps"), u, (error, [1e-16, 1e2]));
    let velocity = velocity.lines(given.clone()).legend_at(Corner::Beside).weight(1.6);
    let recursion = Panel::semilog(format!("Recursion, {many} steps"), u, (error, [1e-14, 1e-2]));
    let recursion = recursion.legend_at(Corner::TopLeft).each(SHOWN, |panel, (rule, colour)| {
        panel.dots(rows[rule].2.clone(), 2.5, colour).labelled(rows[rule].0)
    });
    let factor = Panel::linear("Momentum over velocity", u, ("*s* = *p*/*v*", [-1.0, 4.0]));
    let factor = factor.without_legend().each(SHOWN, |panel, (rule, colour)| {
        let curve = (1..310).map(|k| f64::from(k) * 0.01).map(|u| [u, formula(&rows[rule].1, u)]).collect();
        panel.line(curve, solid(colour).width(1.2)).dots(rows[rule].3.clone(), 3.0, colour)
    });
    Figure::of("Dashed: linear interpolation. Right: dots measured, lines *s* = *uS*/sin *u*")
        .row(460.0, vec![velocity, recursion, factor])
        .footer("Kosmas & Vlachos, section 3, but for the momentum. *S* = Σ*w* cos((1 − 2*c*)*u*).")
}
