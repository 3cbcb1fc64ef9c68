//! The figure and the table.

use anyhow::Result;

use super::orbit::Orbit;
use super::{ELLIPSE, H, Measured, ORBITS};
use crate::figure::{Axis, Figure, Panel, SEQUENCE};
use crate::output::{Table, number};

pub(super) fn figure(measured: &Measured) -> Figure {
    let key = Axis::linear("polar angle of the impact / π").within(-1.0, 1.0);
    let panel = |title: String, orbits: &[Orbit]| {
        let axes = (key.clone(), Axis::linear("velocity along the curve").within(-1.0, 1.0));
        let empty = Panel::new(title, axes.0, axes.1);
        orbits.iter().enumerate().fold(empty, |panel, (number, orbit)| {
            let colour = SEQUENCE[number * (SEQUENCE.len() - 1) / (ORBITS as usize - 1)];
            panel.dots(orbit.section.clone(), 0.7, colour)
        })
    };
    Figure::new(
        "Billiards in an ellipse and in a rounded square",
        format!("{ORBITS} orbits of a free particle of speed 1, *h* = {H}: the first 3000 impacts of each."),
    )
    .row(
        470.0,
        vec![
            panel(format!("Ellipse with half axes {} and {}", ELLIPSE.a, ELLIPSE.b), &measured.ellipse),
            panel("*x*⁴ + *y*⁴ = 1".into(), &measured.square),
        ],
    )
    .sequence_key("centre", "edge")
    .footer("The velocity is the component along the curve after the impact, positive anticlockwise. Colours: where the orbit begins on the *x* axis.")
}

pub(super) fn table(measured: &Measured) -> Result<Table> {
    let mut table = Table::new(&["curve", "orbit", "angle", "velocity_along"])?;
    for (curve, orbits) in [("ellipse", &measured.ellipse), ("rounded square", &measured.square)] {
        for (orbit, Orbit { section, .. }) in orbits.iter().enumerate() {
            for point in section.iter().take(300) {
                let numbers = [orbit as f64, point[0], point[1]].map(number);
                table.row([curve.to_owned()].into_iter().chain(numbers))?;
            }
        }
    }
    Ok(table)
}
