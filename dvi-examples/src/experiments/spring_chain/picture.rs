//! The figure and the table.

use anyhow::Result;

use super::{BETAS, CHAIN, COMPARED, Exchange, H, LONG, Measured, NAMES, OMEGA, Series, expected_speed};
use crate::deviation::Deviation;
use crate::figure::{
    AMBER, Axis, BLUE, Colour, Corner, Figure, GREEN, PURPLE, Panel, SLATE, Stroke, VERMILLION,
};
use crate::output::{Table, number};

impl Measured {
    fn all(&self) -> [(&Series, Colour); 5] {
        let [verlet, twelfth, sixth, quarter] = &self.newmark;
        [(&self.rk4, VERMILLION), (verlet, BLUE), (twelfth, GREEN), (sixth, AMBER), (quarter, PURPLE)]
    }
}

pub(super) fn figure(measured: &Measured) -> Figure {
    let m = CHAIN.m;
    Figure::new(
        format!("Newmark's method on a chain of {m} stiff springs, ω = {OMEGA}, between soft ones"),
        format!("Masses are 1; at the start all energy is in the first pair, *E* ≈ 2. *h* = {H}, so that *hω* = {}.", H * OMEGA),
    )
    .row(
        300.0,
        vec![
            exchange(measured, &measured.exchanges[0], exchange_title(0), true),
            exchange(measured, &measured.exchanges[1], exchange_title(1), false),
            exchange(measured, &measured.exchanges[3], exchange_title(3), false),
            exchange(measured, &measured.long, format!("β = 1/4, *h* = {LONG}"), false),
        ],
    )
    .row(330.0, vec![energy(measured), sum(measured)])
    .footer(
        "Above: energies of the three stiff springs, means over units of time, on those of the motion (grey, Gauss's method of order 8). \
         In brackets: the speed of the exchange by the formula.",
    )
}

fn exchange_title(k: usize) -> String {
    format!("{} ({:.2})", NAMES[k], expected_speed(BETAS[k], H))
}

fn exchange(measured: &Measured, shown: &Exchange, title: String, legend: bool) -> Panel {
    let axes = (
        Axis::linear("time *t*").within(0.0, COMPARED),
        Axis::linear("energies of the stiff springs").within(0.0, 1.7),
    );
    let empty = Panel::new(title, axes.0, axes.1);
    let grey = (0..3).fold(empty, |panel, j| {
        panel.line(measured.motion.points(j), Stroke::solid(SLATE).width(3.0).opacity(0.35))
    });
    let colours = [BLUE, GREEN, VERMILLION];
    let panel = (0..3).fold(grey, |panel, j| {
        let panel = panel.line(shown.points(j), Stroke::solid(colours[j]).width(1.4));
        panel.labelled(["first", "second", "third"][j])
    });
    if legend { panel } else { panel.without_legend() }
}

fn energy(measured: &Measured) -> Panel {
    let label = ["Energy", "largest |*E* − *E*(0)|"];
    over_time(measured, label, [1e-4, 10.0], |series| &series.energy).without_legend()
}

fn sum(measured: &Measured) -> Panel {
    let label = ["Sum *I* of the energies of the stiff springs", "largest |*I* − *I*(0)|"];
    over_time(measured, label, [1e-2, 10.0], |series| &series.sum).legend_at(Corner::Beside).weight(1.25)
}

fn over_time(
    measured: &Measured,
    [title, label]: [&str; 2],
    [low, high]: [f64; 2],
    of: fn(&Series) -> &Deviation,
) -> Panel {
    let axes =
        (Axis::linear("time *t*").within(0.0, measured.end), Axis::logarithmic(label).within(low, high));
    measured.all().into_iter().fold(Panel::new(title, axes.0, axes.1), |panel, (series, colour)| {
        panel.line(of(series).envelope.magnitude(), Stroke::solid(colour)).labelled(series.name)
    })
}

pub(super) fn table(measured: &Measured) -> Result<Table> {
    let mut table = Table::new(&["series", "h", "t", "energy_error", "first", "second", "third"])?;
    for (series, _) in measured.all() {
        for [t, error] in series.energy.envelope.magnitude() {
            let numbers = [number(H), number(t), number(error)];
            let none = [const { String::new() }; 3];
            table.row([series.name.to_owned()].into_iter().chain(numbers).chain(none))?;
        }
    }
    let newmark = NAMES.into_iter().zip(&measured.exchanges).map(|(name, exchange)| (name, H, exchange));
    let others = [("motion", 0.0, &measured.motion), (NAMES[3], LONG, &measured.long)];
    for (name, h, Exchange(means)) in newmark.chain(others) {
        for (k, mean) in means.iter().enumerate() {
            let cells = [number(h), number(k as f64 + 0.5), String::new()];
            table.row([name.to_owned()].into_iter().chain(cells).chain(mean.map(number)))?;
        }
    }
    Ok(table)
}
