//! The figure and the table.

use anyhow::Result;

use super::{FINE, GAMMA, LONG, Measured, Runs, Series};
use crate::figure::{
    Axis, BLUE, Colour, Corner, Figure, Fill, GREEN, PURPLE, Panel, SLATE, Stroke, VERMILLION,
};
use crate::output::{Table, number};

const COLOURS: [Colour; 4] = [BLUE, GREEN, PURPLE, VERMILLION];

fn strokes() -> [Stroke; 4] {
    let [midpoint, trapezoid, newmark, rk4] = COLOURS.map(Stroke::solid);
    [midpoint.width(2.4), trapezoid, newmark, rk4]
}

pub(super) fn figure(measured: &Measured) -> Figure {
    let long = &measured.steps[0];
    let row = |left: Panel, right: Panel| vec![left, right];
    Figure::new(
        "A particle with friction: what the energy loses, and what methods add to that",
        format!(
            "*V* = *r*²(*r*² − 1)², *γ* = {GAMMA}, from (1.2, 0) with velocity (0, 0.5); *h* = {LONG} but for the last \
             panel; energies are means over time"
        ),
    )
    .row(400.0, row(decay(measured), deviation(measured, long)))
    .row(330.0, row(angular_momentum(measured, long), rates(measured)))
    .footer(format!(
        "After Kane, Marsden, Ortiz & West 2000. The reference is Gauss's method of order 8, *h* = {FINE}. With Heun's \
         method and the explicit midpoint rule the energy is doubled at *t* = {} and {}.",
        doubled(&measured.heun),
        doubled(&measured.explicit_midpoint)
    ))
}

fn doubled(series: &Series) -> String {
    series.doubled.map_or("∞".to_owned(), |t| format!("{t:.1}"))
}

fn time(measured: &Measured) -> Axis {
    Axis::linear("time *t*").within(0.0, measured.end)
}

fn decay(measured: &Measured) -> Panel {
    let reference: Vec<[f64; 2]> =
        measured.reference.energies.iter().zip(1..).map(|(e, n)| [f64::from(n) * FINE, *e]).collect();
    let panel = Panel::new("Energy", time(measured), Axis::linear("*E*").within(0.0, 0.45))
        .line(reference, Stroke::solid(SLATE).width(5.0).opacity(0.4))
        .labelled("reference");
    let panel = measured.steps[0].all().into_iter().zip(strokes()).fold(panel, |panel, (series, stroke)| {
        panel.line(series.energy.mean(), stroke).labelled(series.name)
    });
    panel
        .line(measured.conservative.rk4.energy.mean(), Stroke::dashed(VERMILLION))
        .labelled("RK4 without friction")
}

fn deviation(measured: &Measured, runs: &Runs) -> Panel {
    let magnitude = |series: &Series| {
        series.error.envelope.mean().into_iter().map(|[t, mean]| [t, mean.abs()]).collect::<Vec<_>>()
    };
    let axis = Axis::logarithmic("relative, |mean| over 50 units of time").within(1e-3, 2.0);
    let panel = Panel::new("Deviation of the energy", time(measured), axis);
    let panel =
        runs.all().into_iter().zip(strokes()).fold(panel, |panel, (series, stroke)| {
            panel.line(magnitude(series), stroke).labelled(series.name)
        });
    panel.legend_at(Corner::BottomRight)
}

fn angular_momentum(measured: &Measured, runs: &Runs) -> Panel {
    let axis = Axis::logarithmic("largest |*l*/(*l*(0) exp(−*γt*)) − 1|").within(1e-13, 1.0);
    let panel = Panel::new("Angular momentum", time(measured), axis);
    runs.all()
        .into_iter()
        .zip(strokes())
        .fold(panel, |panel, (series, stroke)| panel.line(series.momentum.envelope.magnitude(), stroke))
}

fn rates(measured: &Measured) -> Panel {
    let panel = Panel::new(
        "Error of the rate of decay",
        Axis::logarithmic("step *h*").within(0.02, 0.25),
        Axis::logarithmic("|error| of the rate of *E*   [*γ*]"),
    );
    (0..4).fold(panel, |panel, method| {
        let points = measured.steps.iter().map(|runs| {
            let series = runs.all()[method];
            [series.case.h, series.excess().abs()]
        });
        let points: Vec<_> = points.collect();
        panel.line(points.clone(), strokes()[method]).discs(points, COLOURS[method], Fill::Solid)
    })
}

pub(super) fn table(measured: &Measured) -> Result<Table> {
    let mut table =
        Table::new(&["method", "gamma", "h", "t", "mean_energy_deviation", "mean_momentum_deviation"])?;
    for Series { name, case, error, momentum, .. } in measured.all() {
        for (energy, momentum) in error.envelope.mean().into_iter().zip(momentum.envelope.mean()) {
            let numbers = [case.gamma, case.h, energy[0], energy[1], momentum[1]];
            table.row([name.replace('*', "")].into_iter().chain(numbers.map(number)))?;
        }
    }
    Ok(table)
}
