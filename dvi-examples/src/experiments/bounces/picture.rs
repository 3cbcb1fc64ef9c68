//! The figure and the table.

use anyhow::Result;

use super::{FLOOR, Measured, STEPS, Series};
use crate::figure::{Axis, BLUE, Colour, Corner, Figure, GREEN, Panel, SKY, SLATE, Stroke, VERMILLION};
use crate::output::{Table, number};

pub(super) fn figure(measured: &Measured) -> Figure {
    Figure::new(
        "A particle that bounces on a curved floor",
        format!(
            "Mass and *g* are 1; a valley that narrows with the height; floor *y* = {} cos *x*. Trapezoidal rule, divided at each impact.",
            FLOOR.a
        ),
    )
    .row(380.0, vec![path(measured), energy(measured)])
    .row(300.0, vec![walks(measured)])
    .footer(
        "“Discrete energy”: both flights of an impact have the same one (Fetecau, Marsden, Ortiz & West 2003). “Energy at the impact”: *E* is \
         kept at the point of impact, as it is by RK4.",
    )
}

fn path(measured: &Measured) -> Panel {
    let floor = (-60..=60).map(|i| f64::from(i) * 0.025).map(|x| [x, FLOOR.a * x.cos()]).collect();
    Panel::new("The path up to *t* = 20", Axis::linear("*x*"), Axis::linear("*y*"))
        .equal()
        .line(floor, Stroke::solid(SLATE).width(2.0))
        .line(measured.path.clone(), Stroke::solid(BLUE).width(0.9))
        .dots(measured.impacts.clone(), 2.6, VERMILLION)
}

fn all(measured: &Measured) -> [(&Series, Colour, bool); 5] {
    let Measured { variational, reflecting, rk4, .. } = measured;
    [
        (rk4, VERMILLION, false),
        (&variational[0], BLUE, false),
        (&variational[1], SKY, true),
        (&reflecting[0], GREEN, false),
        (&reflecting[1], GREEN, true),
    ]
}

fn energy(measured: &Measured) -> Panel {
    let axes = (
        Axis::linear("time *t*").within(0.0, measured.end),
        Axis::logarithmic("largest |*E* − *E*(0)|").within(1e-5, 1e4),
    );
    all(measured)
        .into_iter()
        .fold(Panel::new("Energy", axes.0, axes.1), |panel, (series, colour, dashed)| {
            let stroke = if dashed { Stroke::dashed(colour) } else { Stroke::solid(colour) };
            panel
                .line(series.energy.envelope.magnitude(), stroke.width(1.2))
                .labelled(format!("{}, *h* = {}", series.name, series.h))
        })
        .legend_at(Corner::TopLeft)
        .weight(1.6)
}

fn walks(measured: &Measured) -> Panel {
    let axes = (Axis::logarithmic("bounces"), Axis::logarithmic("root mean square of *E* − *E*(0)"));
    let [variational, fine, reflecting] = &measured.walks;
    let guide = |scale: f64| [8.0_f64, 2048.0].map(|n| [n, scale * n.sqrt()]).to_vec();
    let first = variational.points.first().map_or(f64::NAN, |[n, deviation]| 2.0 * deviation / n.sqrt());
    let [coarse_step, fine_step] = STEPS;
    Panel::new("Many starts", axes.0, axes.1)
        .line(variational.points.clone(), Stroke::solid(BLUE))
        .labelled(format!("discrete energy, *h* = {coarse_step}"))
        .line(fine.points.clone(), Stroke::dashed(SKY))
        .labelled(format!("discrete energy, *h* = {fine_step}"))
        .line(reflecting.points.clone(), Stroke::solid(GREEN))
        .labelled(format!("energy at the impact, *h* = {coarse_step}"))
        .line(guide(first), Stroke::dashed(SLATE).width(1.0))
        .labelled("square root of the number of bounces")
        .legend_at(Corner::Beside)
}

pub(super) fn table(measured: &Measured) -> Result<Table> {
    let mut table = Table::new(&["kept", "h", "t", "largest_energy_error"])?;
    for (series, ..) in all(measured) {
        for point in series.energy.envelope.magnitude() {
            let numbers = [series.h, point[0], point[1]].map(number);
            table.row([series.name.to_owned()].into_iter().chain(numbers))?;
        }
    }
    Ok(table)
}
