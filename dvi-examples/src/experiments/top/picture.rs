//! The figure and the table.

use std::f64::consts::TAU;

use anyhow::Result;

use super::{CURVES, Curve, DRAWN, H, LEANING, Measured, SPINNING, Series};
use crate::deviation::Deviation;
use crate::experiments::drifts::Drifts;
use crate::figure::{Axis, BLUE, Colour, Figure, Panel, SLATE, Stroke, VERMILLION, scientific};
use crate::output::{Table, number};

pub(super) fn figure(measured: &Measured) -> Figure {
    Figure::new(
        "The top of Lagrange",
        format!(
            "Moments of inertia 1 and 0.5, weight 1, *ω*₃ = {SPINNING}; rotation matrices along geodesics of SO(3), trapezoidal rule."
        ),
    )
    .row(380.0, measured.curves.iter().map(curve).collect())
    .row(
        300.0,
        vec![
            long(measured, ["Energy", "largest |*E* − *E*(0)|"], [1e-11, 10.0], |series| &series.energy),
            long(measured, ["Orthogonality", "max |*R*ᵀ*R* − 1|"], [1e-17, 10.0], |series| &series.defect).without_legend(),
        ],
    )
    .footer(format!(
        "Above: the axis from above, up to *t* = {DRAWN}, from {LEANING} off the vertical with the precession {}, {} and {}. The roots of the \
         cubic are the circles. Below: {} steps with *h* = {H}.",
        signed(CURVES[0].0),
        signed(CURVES[1].0),
        signed(CURVES[2].0),
        scientific(measured.steps as f64)
    ))
}

fn signed(value: f64) -> String {
    value.to_string().replace('-', "−")
}

fn curve(curve: &Curve) -> Panel {
    let radii = curve.extremes.map(|height| (1.0 - height * height).sqrt());
    let circle = |radius: f64| {
        (0..=200)
            .map(|k| TAU * f64::from(k) / 200.0)
            .map(|phi| [radius * phi.cos(), radius * phi.sin()])
            .collect()
    };
    let axis = |name: &str| Axis::linear(name).within(-0.9, 0.9);
    let panel = Panel::new(title(curve.name), axis("*x*"), axis("*y*")).equal();
    radii
        .into_iter()
        .fold(panel, |panel, radius| panel.line(circle(radius), Stroke::dashed(SLATE).width(1.0)))
        .line(curve.path.clone(), Stroke::solid(BLUE).width(1.4))
}

fn title(name: &str) -> String {
    let mut letters = name.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

fn all(measured: &Measured) -> [(&Series, Colour); 2] {
    [(&measured.rk4, VERMILLION), (&measured.geodesic, BLUE)]
}

fn long(
    measured: &Measured,
    [title, label]: [&str; 2],
    range: [f64; 2],
    of: fn(&Series) -> &Deviation,
) -> Panel {
    let drifts = Drifts { title, label, range, end: measured.steps as f64 * H };
    drifts.panel(all(measured).map(|(series, colour)| (series.name, colour, of(series))))
}

pub(super) fn table(measured: &Measured) -> Result<Table> {
    let mut table = Table::new(&["method", "t", "largest_energy_error", "largest_defect"])?;
    for (series, _) in all(measured) {
        let rows = series.energy.envelope.magnitude().into_iter().zip(series.defect.envelope.magnitude());
        for ([t, energy], [_, defect]) in rows {
            let numbers = [t, energy, defect].map(number);
            table.row([series.name.to_owned()].into_iter().chain(numbers))?;
        }
    }
    Ok(table)
}
