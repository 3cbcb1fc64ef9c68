//! The figure and the table.

use anyhow::Result;

use super::{
    ANGLE, COARSE_BEAMS, COARSE_RODS, DEFLECTION, ELEMENTS, H, MANY_SEGMENTS, MODES, Measured, SEGMENTS,
    SHORT, Series, period,
};
use crate::figure::{
    AMBER, Axis, BLUE, Colour, Corner, Figure, Fill, GREEN, PURPLE, Panel, SEQUENCE, SLATE, Stroke,
    VERMILLION,
};
use crate::output::{Table, number};

pub(super) fn figure(measured: &Measured) -> Figure {
    Figure::new(
        "A clamped beam: small deflections by finite elements, large ones by an elastic rod",
        format!(
            "Newmark's method, *β* = 1/4. Mass, length and bending stiffness are 1; released at rest, the beam with the deflection \
             {DEFLECTION} of its end, the rod with the angle {ANGLE}."
        ),
    )
    .row(370.0, vec![beam(measured), rod(measured)])
    .row(350.0, vec![energy(measured), frequencies(measured)])
    .footer(format!(
        "A period of the first mode is {:.3}. The steps are {:.4} on the beam and {H} on the rod, but for the shorter ones that are named.",
        period(),
        measured.beam.h,
    ))
}

fn instants(empty: Panel, shapes: &[(f64, Vec<[f64; 2]>)]) -> Panel {
    shapes.iter().zip([0, 2, 3, 5, 6, 7].map(|i| SEQUENCE[i])).fold(empty, |panel, ((t, shape), colour)| {
        panel.line(shape.clone(), Stroke::solid(colour)).labelled(format!("*t* = {t:.2}"))
    })
}

fn beam(measured: &Measured) -> Panel {
    let title = format!("{ELEMENTS} elements, half a period");
    let empty = Panel::new(title, Axis::linear("place along the beam"), Axis::linear("deflection"));
    instants(empty, &measured.shapes[0]).legend_at(Corner::Beside)
}

fn rod(measured: &Measured) -> Panel {
    let title = format!("{SEGMENTS} segments, half a period");
    let empty = Panel::new(title, Axis::linear("*x*"), Axis::linear("*y*")).equal();
    instants(empty, &measured.shapes[1]).legend_at(Corner::Beside)
}

fn all(measured: &Measured) -> [(String, &Series, Colour); 4] {
    [
        (format!("rod, {MANY_SEGMENTS} segments"), &measured.many, VERMILLION),
        (format!("the same, *h* = {SHORT}"), &measured.many_short, AMBER),
        (format!("rod, {SEGMENTS} segments"), &measured.rod, GREEN),
        (format!("beam, {ELEMENTS} elements"), &measured.beam, BLUE),
    ]
}

fn energy(measured: &Measured) -> Panel {
    let axes = (
        Axis::linear("time *t*, in periods of the first mode").within(0.0, measured.periods[1]),
        Axis::logarithmic("largest |*E*/*E*(0) − 1|").within(1e-16, 1.0),
    );
    let panel = all(measured).into_iter().fold(
        Panel::new("Energy", axes.0, axes.1),
        |panel, (name, series, colour)| {
            let points =
                series.energy.envelope.magnitude().into_iter().map(|[t, error]| [t / period(), error]);
            panel.line(points.collect(), Stroke::solid(colour)).labelled(name)
        },
    );
    panel.legend_at(Corner::Beside)
}

fn frequencies(measured: &Measured) -> Panel {
    let axes = (
        Axis::logarithmic("elements or segments *n*").within(6.0, 130.0),
        Axis::logarithmic("relative error of the frequency"),
    );
    let colours = [BLUE, GREEN, PURPLE];
    let points = |sizes: [usize; 4], errors: &[[f64; MODES]; 4], k: usize| -> Vec<[f64; 2]> {
        sizes.into_iter().zip(errors).map(|(n, errors)| [n as f64, errors[k].abs()]).collect()
    };
    let panel = (0..MODES).fold(Panel::new("Frequencies", axes.0, axes.1), |panel, k| {
        let beams = points(COARSE_BEAMS, &measured.of_beams, k);
        let rods = points(COARSE_RODS, &measured.of_rods, k);
        panel
            .line(beams.clone(), Stroke::solid(colours[k]))
            .labelled(format!("mode {}, elements", k + 1))
            .discs(beams, colours[k], Fill::Solid)
            .line(rods.clone(), Stroke::dashed(colours[k]))
            .labelled(format!("mode {}, segments", k + 1))
            .discs(rods, colours[k], Fill::Hollow)
    });
    let slope = |n: f64, error: f64, order: i32| vec![[n, error], [2.0 * n, error / 2f64.powi(order)]];
    panel
        .line(slope(14.0, 1e-8, 4), Stroke::solid(SLATE).width(1.2))
        .labelled("orders 4 and 2")
        .line(slope(50.0, 1.5e-2, 2), Stroke::solid(SLATE).width(1.2))
        .legend_at(Corner::Beside)
}

pub(super) fn table(measured: &Measured) -> Result<Table> {
    let mut table = Table::new(&["series", "h", "t", "energy_error"])?;
    for (name, series, _) in all(measured) {
        for [t, error] in series.energy.envelope.magnitude() {
            table.row([name.replace('*', "")].into_iter().chain([series.h, t, error].map(number)))?;
        }
    }
    Ok(table)
}
