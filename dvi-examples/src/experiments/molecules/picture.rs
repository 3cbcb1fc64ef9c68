//! The figure and the table.

use anyhow::Result;

use super::claims::BOUND;
use super::scan::Scan;
use super::{BETA, H, H_SPRINGS, MOLECULES, Measured, SOFT, STIFF, Series};
use crate::figure::{Axis, BLUE, Corner, Figure, Fill, GREEN, Panel, SLATE, Stroke, VERMILLION, scientific};
use crate::output::{Table, number};

pub(super) fn figure(measured: &Measured) -> Figure {
    Figure::new(
        format!("A chain of {MOLECULES} rigid molecules by RATTLE, and with springs in place of the rods"),
        format!(
            "Atoms of mass 1, sides of length 1, and between molecules the potential of Morse with depth 1 and *β* = {BETA}; *h* = {H} \
             with rods, {H_SPRINGS} with springs of *k* = 10⁴."
        ),
    )
    .row(400.0, vec![chain(measured), lengths(measured)])
    .row(310.0, vec![energy(measured), bonds(measured)])
    .footer(format!(
        "The longest step that keeps the energy to 1 % is {:.3} with rods, {:.4} and {:.4} with springs. The chain moves away from the \
         origin: rounding of coordinates grows with the distance.",
        measured.scans[0].longest(BOUND),
        measured.scans[1].longest(BOUND),
        measured.scans[2].longest(BOUND),
    ))
}

fn chain(measured: &Measured) -> Panel {
    let (t, atoms) = &measured.instant;
    let title = format!("The chain at *t* = {t:.0}, about its centre of mass");
    let mut panel = Panel::new(title, Axis::linear("*x*"), Axis::linear("*y*")).equal();
    for m in 1..MOLECULES {
        for [a, b] in [[3 * m - 2, 3 * m], [3 * m - 1, 3 * m + 1]] {
            panel = panel.line(vec![atoms[a], atoms[b]], Stroke::dashed(SLATE).width(1.0));
        }
    }
    for triangle in atoms.chunks_exact(3) {
        let closed = [triangle[0], triangle[1], triangle[2], triangle[0]];
        panel = panel.line(closed.to_vec(), Stroke::solid(BLUE).width(2.4));
    }
    panel.discs(atoms.clone(), BLUE, Fill::Solid)
}

fn lengths(measured: &Measured) -> Panel {
    let empty = Panel::new(
        "Energy error over the length of the steps",
        Axis::logarithmic("step *h*").within(0.0022, 0.2),
        Axis::logarithmic("largest |*E*/*E*(0) − 1|").within(1e-5, 1.0),
    );
    let [rods, soft, stiff] = &measured.scans;
    let all = [
        (stiff, VERMILLION, "springs, *k* = 10⁵", 4.0),
        (soft, GREEN, "springs, *k* = 10⁴", 2.6),
        (rods, BLUE, "rods", 1.4),
    ];
    let panel = all.into_iter().fold(empty, |panel, (Scan(errors), colour, name, width)| {
        let drawn = errors.iter().map(|&[h, error]| [h, error.min(1e6)]).collect();
        panel.line(drawn, Stroke::solid(colour).width(width)).labelled(name)
    });
    panel
        .line(vec![[0.0022, BOUND], [0.2, BOUND]], Stroke::dashed(SLATE).width(1.2))
        .labelled("one hundredth")
        .legend_at(Corner::BottomRight)
}

fn all(measured: &Measured) -> [(&Series, Stroke); 2] {
    [(&measured.springs, Stroke::solid(GREEN)), (&measured.rods, Stroke::solid(BLUE))]
}

fn energy(measured: &Measured) -> Panel {
    let axes =
        (Axis::linear("time *t*").within(0.0, measured.end), Axis::logarithmic("largest |*E*/*E*(0) − 1|"));
    let panel = Panel::new("Energy", axes.0, axes.1.within(1e-5, 1.0));
    all(measured).into_iter().fold(panel, |panel, (series, stroke)| {
        let name = format!("{}, *h* = {}", series.name, series.h);
        panel.line(series.energy.envelope.magnitude(), stroke).labelled(name)
    })
}

fn bonds(measured: &Measured) -> Panel {
    let axes =
        (Axis::linear("time *t*").within(0.0, measured.end), Axis::logarithmic("largest |length − 1|"));
    let panel = Panel::new("Sides of the triangles", axes.0, axes.1.within(1e-16, 1e-1));
    let panel = all(measured)
        .into_iter()
        .fold(panel, |panel, (series, stroke)| panel.line(series.bonds.envelope.magnitude(), stroke));
    let most = scientific(measured.rods.bonds.largest);
    panel.caption(Corner::BottomRight, format!("rods: at most {most}"))
}

pub(super) fn table(measured: &Measured) -> Result<Table> {
    let mut table = Table::new(&["series", "k", "h", "t", "energy", "length"])?;
    for (series, k) in [(&measured.rods, f64::INFINITY), (&measured.springs, SOFT)] {
        let (energy, length) = (series.energy.envelope.magnitude(), series.bonds.envelope.magnitude());
        for (energy, length) in energy.into_iter().zip(length) {
            let numbers = [k, series.h, energy[0], energy[1], length[1]].map(number);
            table.row(["over time".to_owned()].into_iter().chain(numbers))?;
        }
    }
    for (Scan(errors), k) in measured.scans.iter().zip([f64::INFINITY, SOFT, STIFF]) {
        for [h, error] in errors {
            let numbers = [number(k), number(*h), String::new(), number(*error), String::new()];
            table.row(["over step".to_owned()].into_iter().chain(numbers))?;
        }
    }
    Ok(table)
}
