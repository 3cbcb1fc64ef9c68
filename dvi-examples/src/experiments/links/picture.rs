//! The figure and the table.

use anyhow::Result;

use super::{ANGLE, H, LINKS, Measured, Series};
use crate::deviation::Deviation;
use crate::figure::{
    Axis, BLUE, Colour, Corner, Figure, GREEN, PURPLE, Panel, SEQUENCE, Stroke, VERMILLION,
};
use crate::output::{Table, number};

impl Measured {
    fn all(&self) -> [(&Series, Colour, f64); 4] {
        let Self { rattle, trapezoid, midpoint, rk4, .. } = self;
        [(trapezoid, GREEN, 6.0), (midpoint, PURPLE, 3.5), (rattle, BLUE, 1.4), (rk4, VERMILLION, 1.8)]
    }
}

pub(super) fn figure(measured: &Measured) -> Figure {
    Figure::new(
        format!("A pendulum of {LINKS} links, each rod a constraint"),
        format!(
            "Length, mass and *g* are 1. Released at rest with angles that grow from 0 to {ANGLE} along the pendulum; *h* = {H}."
        ),
    )
    .row(390.0, vec![pendulum(measured), energy(measured)])
    .row(330.0, vec![lengths(measured), velocities(measured)])
    .footer(
        "RK4 solves the equations of motion with the accelerations at each state. The potential is linear: the three other methods \
         take the same steps.",
    )
}

fn pendulum(measured: &Measured) -> Panel {
    let axes = [Axis::linear("*x*"), Axis::linear("*y*")];
    let [x, y] = axes;
    let empty = Panel::new("The pendulum over half a swing", x, y.within(-1.02, 0.02)).equal();
    let instants = measured.instants.iter().zip([0, 2, 3, 5, 6, 7].map(|i| SEQUENCE[i]));
    let panel = instants.fold(empty, |panel, ((t, shape), colour)| {
        let line = std::iter::once([0.0; 2]).chain(shape.iter().copied()).collect();
        panel.line(line, Stroke::solid(colour).width(1.2)).labelled(format!("*t* = {t:.1}")).dots(
            shape.clone(),
            2.0,
            colour,
        )
    });
    panel.legend_at(Corner::Beside)
}

fn energy(measured: &Measured) -> Panel {
    over_time(measured, ["Energy", "largest |*E* − *E*(0)|"], [1e-9, 1e-3], |series| &series.energy)
}

fn lengths(measured: &Measured) -> Panel {
    let labels = ["Lengths of the rods", "largest relative deviation"];
    over_time(measured, labels, [1e-16, 1.0], |series| &series.length).without_legend()
}

fn velocities(measured: &Measured) -> Panel {
    let labels = ["Velocities along the rods", "largest difference at the ends"];
    over_time(measured, labels, [1e-18, 1e-2], |series| &series.along).without_legend()
}

fn over_time(
    measured: &Measured,
    [title, label]: [&str; 2],
    [low, high]: [f64; 2],
    of: fn(&Series) -> &Deviation,
) -> Panel {
    let axes =
        (Axis::linear("time *t*").within(0.0, measured.end), Axis::logarithmic(label).within(low, high));
    let panel = measured.all().into_iter().fold(
        Panel::new(title, axes.0, axes.1),
        |panel, (series, colour, width)| {
            let stroke = Stroke::solid(colour).width(width);
            panel.line(of(series).envelope.magnitude(), stroke).labelled(series.name)
        },
    );
    panel.legend_at(Corner::BottomRight)
}

pub(super) fn table(measured: &Measured) -> Result<Table> {
    let mut table = Table::new(&["method", "t", "energy", "length", "velocity_along"])?;
    for (series, ..) in measured.all() {
        let [energy, length, along] =
            [&series.energy, &series.length, &series.along].map(|deviation| deviation.envelope.magnitude());
        for ((energy, length), along) in energy.into_iter().zip(length).zip(along) {
            let numbers = [energy[0], energy[1], length[1], along[1]].map(number);
            table.row([series.name.to_owned()].into_iter().chain(numbers))?;
        }
    }
    Ok(table)
}
