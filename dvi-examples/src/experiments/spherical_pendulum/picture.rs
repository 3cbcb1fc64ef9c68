//! The figure and the table.

use std::f64::consts::TAU;

use anyhow::Result;

use super::{DRAWN, H, Measured, PENDULUM, Series, begin};
use crate::deviation::Deviation;
use crate::experiments::drifts::Drifts;
use crate::figure::{Axis, BLUE, Colour, Figure, GREEN, Panel, SLATE, Stroke, VERMILLION, scientific};
use crate::output::{Table, number};

pub(super) fn figure(measured: &Measured) -> Figure {
    Figure::new(
        "A spherical pendulum",
        format!("Mass, length and *g* are 1; unit vectors along great circles, trapezoidal rule, and a constraint by RATTLE, *h* = {H}."),
    )
    .row(
        400.0,
        vec![
            path(measured),
            long(measured, ["Energy", "largest |*E* − *E*(0)|"], [1e-11, 10.0], |series| &series.energy).weight(1.4),
        ],
    )
    .row(
        300.0,
        vec![
            long(measured, ["Length", "||*s*|² − 1|"], [1e-17, 10.0], |series| &series.length).without_legend(),
            long(measured, ["Momentum about the vertical", "largest relative change"], [1e-17, 10.0], |series| {
                &series.vertical
            })
            .without_legend(),
        ],
    )
    .footer(format!(
        "The path is from above, up to *t* = {DRAWN}; the roots of the cubic are the circles. The others: {} steps.",
        scientific(measured.steps as f64)
    ))
}

fn path(measured: &Measured) -> Panel {
    let radii = PENDULUM.heights(&begin()).extremes().map(|height| (1.0 - height * height).sqrt());
    let circle = |radius: f64| {
        (0..=200)
            .map(|k| TAU * f64::from(k) / 200.0)
            .map(|phi| [radius * phi.cos(), radius * phi.sin()])
            .collect()
    };
    let panel = Panel::new("The path", Axis::linear("*x*"), Axis::linear("*y*"))
        .equal()
        .line(measured.path.clone(), Stroke::solid(BLUE).width(1.2));
    radii
        .into_iter()
        .fold(panel, |panel, radius| panel.line(circle(radius), Stroke::dashed(SLATE).width(1.0)))
}

fn all(measured: &Measured) -> [(&Series, Colour); 3] {
    let Measured { rk4, rattle, geodesic, .. } = measured;
    [(rk4, VERMILLION), (rattle, GREEN), (geodesic, BLUE)]
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
    let columns =
        ["method", "t", "largest_energy_error", "largest_change_of_length", "largest_change_of_momentum"];
    let mut table = Table::new(&columns)?;
    for (series, _) in all(measured) {
        let [energy, length, vertical] =
            [&series.energy, &series.length, &series.vertical].map(|of| of.envelope.magnitude());
        for ((energy, length), vertical) in energy.into_iter().zip(length).zip(vertical) {
            let numbers = [energy[0], energy[1], length[1], vertical[1]].map(number);
            table.row([series.name.to_owned()].into_iter().chain(numbers))?;
        }
    }
    Ok(table)
}
