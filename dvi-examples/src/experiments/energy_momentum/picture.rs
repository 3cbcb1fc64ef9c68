//! The figure and the table.

use anyhow::Result;

use super::series::{BEGINNING, Series, Step};
use super::{Measured, ON_ORBIT, ON_SPRING, ORBIT};
use crate::figure::{
    Axis, BLUE, Corner, Figure, Fill, GREEN, PURPLE, Panel, SLATE, Stroke, VERMILLION, scientific,
};
use crate::output::{Table, number};

/// The runs that are drawn: those with the longest steps.
fn drawn(measured: &Measured) -> [(&Series, Stroke); 4] {
    let ([spring, ..], [kepler, ..]) = (&measured.spring, &measured.kepler);
    [
        (&spring.mean, Stroke::solid(VERMILLION)),
        (&kepler.mean, Stroke::solid(PURPLE)),
        (&spring.kept, Stroke::solid(BLUE)),
        (&kepler.kept, Stroke::solid(GREEN)),
    ]
}

fn label(series: &Series) -> String {
    format!("{}, {}", series.system, series.name)
}

pub(super) fn figure(measured: &Measured) -> Figure {
    Figure::new(
        "Steps of such a length that the discrete energy stays the same",
        format!(
            "variational midpoint rule; a spring with *V* = *r*²/2 + *r*⁴/4, first step {}, and a Kepler orbit of eccentricity {}, first \
             step {}; “one length” is the mean of the other run",
            ON_SPRING[0], ORBIT.e, ON_ORBIT[0]
        ),
    )
    .row(370.0, vec![discrete(measured), energy(measured)])
    .row(350.0, vec![lengths(measured), equation(measured)])
    .footer(format!(
        "The scheme of Kane, Marsden & Ortiz 1999. With the trapezoidal rule on the spring it ends after {} steps, at *t* = {:.2}: \
         no length within reach gives the discrete energy *e* of the first step.",
        measured.ending.steps, measured.ending.time
    ))
}

fn discrete(measured: &Measured) -> Panel {
    let axis = Axis::logarithmic("largest |*E*_d − *e*| of many steps").within(1e-16, 1.0);
    let panel = Panel::new("Discrete energy", Axis::linear("number of the step"), axis);
    drawn(measured)
        .into_iter()
        .fold(panel, |panel, (series, stroke)| panel.line(series.discrete.envelope.magnitude(), stroke))
}

fn energy(measured: &Measured) -> Panel {
    let panel = Panel::new("Energy at the points of the run", time(), Axis::linear("*E* − *E*(0)"));
    drawn(measured)
        .into_iter()
        .fold(panel, |panel, (series, stroke)| panel.line(over_time(series, |step| step.energy), stroke))
}

fn lengths(measured: &Measured) -> Panel {
    let panel = Panel::new("Length of the steps", time(), Axis::linear("*h*").within(0.0, 0.22));
    drawn(measured).into_iter().fold(panel, |panel, (series, stroke)| {
        panel.line(over_time(series, |step| step.length), stroke).labelled(label(series))
    })
}

fn time() -> Axis {
    Axis::linear("time *t*").within(0.0, BEGINNING)
}

fn over_time(series: &Series, value: impl Fn(&Step) -> f64) -> Vec<[f64; 2]> {
    series.beginning.iter().map(|step| [step.t, value(step)]).collect()
}

/// The lengths up to which the step equation is drawn.
const SHOWN: f64 = 0.25;

fn equation(measured: &Measured) -> Panel {
    let ending = &measured.ending;
    let thousandfold = |[h, defect]: [f64; 2]| [h, 1e3 * defect];
    let within = |curve: &[[f64; 2]]| -> Vec<[f64; 2]> {
        curve.iter().copied().filter(|[h, _]| *h <= SHOWN).map(thousandfold).collect()
    };
    let axis = Axis::linear("10³ (*E*_d(*h*) − *e*)").within(-10.0, 16.0);
    Panel::new("The equation for *h*, trapezoidal rule", Axis::linear("*h*").within(0.0, SHOWN), axis)
        .line(vec![[0.0, 0.0], [SHOWN, 0.0]], Stroke::solid(SLATE).width(1.0))
        .line(within(&ending.last.curve), Stroke::dashed(BLUE))
        .labelled("at the last step")
        .discs(vec![[ending.length, 0.0]], BLUE, Fill::Solid)
        .labelled(format!("its length, {:.3}", ending.length))
        .line(within(&ending.failed.curve), Stroke::solid(VERMILLION))
        .labelled("where the run ends")
        .discs(vec![thousandfold([ending.best, ending.defect])], VERMILLION, Fill::Hollow)
        .labelled(format!("nearest to zero, {}", scientific(ending.defect)))
        .legend_at(Corner::TopLeft)
}

pub(super) fn table(measured: &Measured) -> Result<Table> {
    let mut table = Table::new(&["run", "quantity", "over", "at", "value"])?;
    let mut add = |run: &str, [quantity, over]: [&str; 2], points: Vec<[f64; 2]>| {
        points.into_iter().try_for_each(|[at, value]| {
            table.row([run, quantity, over].map(str::to_owned).into_iter().chain([at, value].map(number)))
        })
    };
    for (series, _) in drawn(measured) {
        let run = label(series);
        add(&run, ["largest_discrete_energy_defect", "step"], series.discrete.envelope.magnitude())?;
        add(&run, ["energy_change", "t"], over_time(series, |step| step.energy))?;
        add(&run, ["length", "t"], over_time(series, |step| step.length))?;
    }
    let ending = &measured.ending;
    for (name, sought) in [("trapezoid, last step", &ending.last), ("trapezoid, no step", &ending.failed)] {
        add(name, ["discrete_energy_defect", "h"], sought.curve.iter().copied().step_by(20).collect())?;
    }
    Ok(table)
}
