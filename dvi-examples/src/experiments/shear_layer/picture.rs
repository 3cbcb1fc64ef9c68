//! The figure and the table.

use anyhow::Result;

use super::{H, Measured, SHOWN, TOLERANCE};
use crate::figure::{
    Axis, BLUE, Corner, Figure, Fill, GREEN, Panel, SEQUENCE, SLATE, Stroke, VERMILLION, scientific,
};
use crate::models::VortexBlobsState;
use crate::output::{Table, number};

pub(super) fn figure(measured: &Measured) -> Figure {
    let n = measured.layer.blobs();
    let figure = Figure::new(
        format!("A shear layer of {} {:03} vortex blobs rolls up", n / 1000, n % 1000),
        format!(
            "Gauss collocation of order 6, *h* = {H}, with a fast sum of tolerance {}",
            scientific(TOLERANCE)
        ),
    )
    .sequence_key("from below", "from above");
    let mut snapshots = measured.snapshots.iter().zip(SHOWN).zip([1.0, 1.7, 1.0]);
    let mut next =
        || snapshots.next().map(|((state, steps), weight)| snapshot(measured, state, steps).weight(weight));
    let early: Vec<Panel> = next().into_iter().collect();
    let late: Vec<Panel> = [next(), next()].into_iter().flatten().collect();
    [(370.0, early), (560.0, late)]
        .into_iter()
        .filter(|(_, panels)| !panels.is_empty())
        .fold(figure, |figure, (height, panels)| figure.row(height, panels))
        .row(330.0, vec![kept(measured), cost(measured)])
        .footer(format!(
            "Velocities differ by 1 across the layer, the waves on it have the length 1. Relative error of the forces: {} at the start, {} at \
             the end.",
            scientific(measured.errors[0]),
            scientific(measured.errors[1])
        ))
}

/// The blobs, in the colours of their rows.
fn snapshot(measured: &Measured, state: &VortexBlobsState, steps: u64) -> Panel {
    let rows = measured.layer.rows;
    let radius = if rows > 20 { 0.3 } else { 1.0 };
    let title = format!("*t* = {}", steps as f64 * H);
    let plane = Panel::new(title, Axis::linear("*x*"), Axis::linear("*y*"));
    SEQUENCE.into_iter().enumerate().fold(plane.equal(), |plane, (number, colour)| {
        let blobs = state.x.iter().zip(&state.y).enumerate();
        let of_colour = blobs.filter(|(blob, _)| blob % rows * SEQUENCE.len() / rows == number);
        plane.dots(of_colour.map(|(_, (x, y))| [*x, *y]).collect(), radius, colour)
    })
}

fn kept(measured: &Measured) -> Panel {
    Panel::new(
        "What is kept",
        Axis::linear("time *t*").within(0.0, SHOWN[2] as f64 * H),
        Axis::logarithmic("relative change"),
    )
    .line(measured.energy.envelope.magnitude(), Stroke::solid(BLUE))
    .labelled("*H*")
    .line(measured.impulse.envelope.magnitude(), Stroke::solid(GREEN))
    .labelled("ΣΓ*z*")
    .line(measured.angular.envelope.magnitude(), Stroke::solid(VERMILLION))
    .labelled("ΣΓ|*z*|²")
    .legend_at(Corner::Beside)
}

fn cost(measured: &Measured) -> Panel {
    let per_blob = |of: fn(&(u64, u64, u64)) -> u64| -> Vec<[f64; 2]> {
        measured
            .operations
            .iter()
            .map(|counts| [counts.0 as f64, of(counts) as f64 / counts.0 as f64])
            .collect()
    };
    let panel = Panel::new(
        "What an evaluation takes for each blob",
        Axis::logarithmic("number of blobs"),
        Axis::logarithmic("for each blob"),
    )
    .line(per_blob(|(blobs, ..)| blobs * (blobs - 1)), Stroke::solid(SLATE))
    .labelled("all pairs");
    [
        ("pairs nearby", per_blob(|(_, pairs, _)| *pairs), BLUE),
        ("products of groups", per_blob(|(.., products)| *products), VERMILLION),
    ]
    .into_iter()
    .fold(panel, |panel, (name, points, colour)| {
        panel.line(points.clone(), Stroke::solid(colour)).labelled(name).discs(points, colour, Fill::Solid)
    })
    .legend_at(Corner::Beside)
}

pub(super) fn table(measured: &Measured) -> Result<Table> {
    let mut table = Table::new(&["quantity", "t_or_blobs", "value"])?;
    let series = [("ΔH/H", &measured.energy), ("ΔΣΓz", &measured.impulse), ("ΔΣΓ|z|²", &measured.angular)];
    for (name, deviation) in series {
        for [t, value] in deviation.envelope.magnitude() {
            table.row([name.to_owned(), number(t), number(value)])?;
        }
    }
    for (blobs, pairs, products) in &measured.operations {
        for (name, value) in [("pairs", pairs), ("products", products)] {
            table.row([name.to_owned(), blobs.to_string(), value.to_string()])?;
        }
    }
    Ok(table)
}
