//! Kosmas & Vlachos, Fig. 2: “the phase fitting decreases close to one third the number of integration
//! steps”.
//!
//! A phase-fitted run over one period has a largest energy error; how many steps does a linear rule need for
//! the same? The answer depends on what is compared: the rule of the reference, and whether both runs choose
//! their steps by (23), as printed, or keep them fixed. Each reading is shown.

use super::equal_errors::*;
use crate::vocabulary::*;

const ECCENTRICITIES: [f64; 4] = [0.2, 0.5, 0.8, 0.95];
/// The eccentricity of the paper.
const HIGH: f64 = 0.95;
const THIRD: f64 = 1.0 / 3.0;

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let (count, orbits) = job.choose((3, &ECCENTRICITIES[..]), (2, &ECCENTRICITIES[3..]));
    let cases = [Fixed, Controlled].into_iter().flat_map(|steps| orbits.iter().map(move |&e| (steps, e)));
    let of_each = |(steps, e)| finenesses(steps, e).into_iter().take(count).map(move |of| (steps, e, of));
    let cases: Vec<_> = cases.flat_map(of_each).collect();
    let compared = cases.into_par_iter().map(|(steps, e, fine)| equal_errors(job, steps, e, fine));
    let all: Vec<Comparison> = compared.collect::<Result<Vec<_>>>()?.into_iter().flatten().collect();
    let rows = all.iter().map(|c| {
        let how = if c.steps == Fixed { "fixed" } else { "controlled" };
        ([how, &c.e.to_string(), c.reference].map(str::to_owned), [c.energy, c.fitted, c.linear, c.ratio()])
    });
    job.publish(figure(&all), Table::of("steps,e,reference,energy_error,fitted,linear,ratio", rows))?;
    let notes = all.iter().filter(|c| c.e == HIGH).map(|c| {
        let how = match c.steps {
            Fixed => "fixed steps, (19) in the discrete Lagrangian",
            Controlled => "(23) as printed, (19) left-frozen",
        };
        let (Comparison { e, reference, energy, fitted, linear, .. }, ratio) = (c, c.ratio());
        format!(
            "e = {e}, {how}, max|ΔE| = {energy:.2e}: {fitted:.0} steps per period against {linear:.0} of \
             {reference}: {ratio:.3}."
        )
    });
    Ok(Outcome { claims: claims(&all), references: references(&all), notes: notes.collect() })
}

/// The ratios against midpoint and trapezoid or, if `simpson`, against linear Simpson.
fn ratios(all: &[Comparison], steps: Steps, e: f64, simpson: bool) -> Vec<f64> {
    let is_asked = |c: &&Comparison| c.steps == steps && c.e == e && (c.reference == SIMPSON) == simpson;
    all.iter().filter(is_asked).map(Comparison::ratio).collect()
}

/// The smallest and the largest of some ratios, if there are any.
fn extremes(all: &[f64]) -> [Option<f64>; 2] {
    [least(all.iter().copied()), largest(all.iter().copied())].map(|r| (!all.is_empty()).then_some(r))
}

fn claims(all: &[Comparison]) -> Vec<Claim> {
    let of = |steps, e, simpson| extremes(&ratios(all, steps, e, simpson));
    let at_high = ratios(all, Controlled, HIGH, false);
    let ([low, high], two) = (extremes(&at_high), "against midpoint and trapezoid");
    let above = at_high.iter().filter(|&&ratio| ratio > THIRD).count();
    let share = low.map(|_| above as f64 / at_high.len() as f64);
    vec![
        says("section 5", "at e = 0.95, close to one third of the steps of a method of the same order")
            .at_least(format!("(23) as printed, {two}: smallest ratio"), low, 0.25)
            .at_most("the same: largest ratio", high, 0.42),
        says("section 7", "less than one third of the steps")
            .at_most(format!("(23) as printed, e = 0.95, {two}: largest ratio"), high, THIRD)
            .instead(
                "with (23) as printed most ratios are above one third; with fixed steps all are below it, \
                 against midpoint and trapezoid; against linear Simpson none is at e = 0.95",
            )
            .of("(23) as printed, e = 0.95")
            .at_least("share of the ratios above one third", share, 0.5)
            .of(format!("fixed steps, e = 0.95, {two}"))
            .at_most("largest ratio", of(Fixed, HIGH, false)[1], THIRD)
            .of("fixed steps, e = 0.95, against linear Simpson")
            .at_least("smallest ratio", of(Fixed, HIGH, true)[0], THIRD),
        beyond("what is saved depends on the orbit")
            .of(format!("(23) as printed, e = 0.8, {two}"))
            .at_least("largest ratio", of(Controlled, 0.8, false)[1], 1.0)
            .of("fixed steps, e = 0.2, against linear Simpson")
            .at_most("largest ratio", of(Fixed, 0.2, true)[1], THIRD),
    ]
}

/// Brackets around what earlier runs have found.
fn references(all: &[Comparison]) -> Vec<Check> {
    let checks = [
        (Controlled, HIGH, false, [0.28, 0.42]),
        (Controlled, 0.8, false, [0.2, 1.1]),
        (Controlled, HIGH, true, [0.45, 0.92]),
        (Fixed, HIGH, false, [0.27, 0.32]),
        (Fixed, HIGH, true, [0.45, 0.55]),
        (Fixed, 0.2, true, [0.15, 0.25]),
    ];
    let check = |(steps, e, simpson, [low, high]): (Steps, f64, bool, [f64; 2])| {
        let how = if steps == Fixed { "fixed steps" } else { "(23) as printed" };
        let against = if simpson { "linear Simpson" } else { "midpoint and trapezoid" };
        let found = extremes(&ratios(all, steps, e, simpson));
        ["smallest", "largest"].into_iter().zip(found).map(move |(which, ratio)| {
            let name = format!("{how}, e = {e}, against {against}: {which} ratio");
            Check::new(name, ratio, Bound::Within(low, high))
        })
    };
    checks.into_iter().flat_map(check).collect()
}

fn figure(all: &[Comparison]) -> Figure {
    let of = |reference: &'static str, steps: Steps| {
        all.iter().filter(move |c| c.reference == reference && c.steps == steps)
    };
    let at_high = |reference| of(reference, Controlled).filter(|c| c.e == HIGH);
    let fitted = at_high("midpoint").map(|c| [c.energy, c.fitted]).collect();
    let title = format!("Steps over one period, *e* = {HIGH}, both with (23)");
    let steps = Panel::new(title, Axis::logarithmic("max|*E* − *E*(0)|"), Axis::logarithmic("steps"))
        .marked([("phase-fitted", solid(VERMILLION), fitted)])
        .marked(REFERENCES.map(|(reference, _, colour)| {
            (reference, dashed(colour), at_high(reference).map(|c| [c.energy, c.linear]).collect())
        }));
    let compared = |title: &str, steps: Steps| {
        let e = Axis::names("eccentricity", ECCENTRICITIES.iter().map(f64::to_string).collect());
        let beside = REFERENCES.into_iter().zip([-0.18, 0.0, 0.18]);
        let place = |e: f64| ECCENTRICITIES.iter().position(|x| *x == e).map_or(f64::NAN, |k| k as f64);
        Panel::new(title, e, Axis::linear("steps, phase-fitted / linear").within([0.0, 1.7]))
            .guide([[-0.6, THIRD], [3.6, THIRD]], "one third")
            .each(beside, |panel, ((reference, _, colour), aside)| {
                let points = of(reference, steps).map(|c| [place(c.e) + aside, c.ratio()]).collect();
                panel.rings(points, colour).labelled(format!("against {reference}"))
            })
    };
    let controlled = compared("Both with (23) as printed", Controlled);
    Figure::of("Phase-fitted Simpson; (19) is left-frozen with (23), a part of L_d with fixed steps")
        .row(430.0, vec![steps, controlled, compared("Both with fixed steps", Fixed).without_legend()])
}
