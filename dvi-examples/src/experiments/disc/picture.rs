//! The figure and the table.

use anyhow::Result;

use super::growth::{Growth, STARTS};
use super::sleigh::{STEPS, Sleigh};
use super::{FINE, H, Measured, RATES, circle};
use crate::figure::{
    AMBER, Axis, BLUE, Colour, Corner, Figure, GREEN, PURPLE, Panel, SLATE, Stroke, VERMILLION,
};
use crate::output::{Table, number};

pub(super) fn figure(measured: &Measured) -> Figure {
    Figure::new(
        "A disc that rolls upright, and a sleigh on a blade: constraints of velocities",
        format!(
            "Midpoint rule with the principle of Lagrange and d'Alembert, *h* = {H}. Mass and radius are 1; the disc begins with *θ*' = {} \
             and *φ*' = {}.",
            RATES[0], RATES[1]
        ),
    )
    .row(320.0, vec![free(measured), springs(measured), magnet(measured), sleigh(measured)])
    .row(330.0, vec![energy(measured), turning(measured)])
    .footer(format!(
        "Above: the points of contact, from *t* = 0 to 16, 60, 60 and 7. Energy: the mean over {STARTS} starts of the largest |*E* − *E*(0)| up \
         to time *t*. RK4 solves the equations from which the constraints are eliminated."
    ))
}

fn plane(title: &str) -> Panel {
    Panel::new(title, Axis::linear("*x*"), Axis::linear("*y*")).equal()
}

fn free(measured: &Measured) -> Panel {
    let exact = (0..=400).map(|i| circle(f64::from(i) * 0.04)).collect();
    let every: Vec<[f64; 2]> = measured.paths[0].iter().step_by(4).copied().collect();
    let panel = Panel::new("Free", Axis::linear("*x*"), Axis::linear("*y*").within(-1.0, 9.0)).equal();
    panel
        .line(exact, Stroke::solid(SLATE).width(1.2))
        .labelled("circle")
        .dots(every, 2.2, GREEN)
        .labelled("every 4th step")
}

fn springs(measured: &Measured) -> Panel {
    plane("On equal springs").line(measured.paths[1].clone(), Stroke::solid(BLUE).width(1.2))
}

fn magnet(measured: &Measured) -> Panel {
    plane("With a magnet").line(measured.paths[2].clone(), Stroke::solid(VERMILLION).width(1.2))
}

fn sleigh(measured: &Measured) -> Panel {
    let Sleigh { motion, path, .. } = &measured.sleigh;
    let until = |path: &[[f64; 2]], h: f64| path.iter().take((7.0 / h) as usize).copied().collect();
    plane("Sleigh")
        .line(until(motion, FINE), Stroke::solid(SLATE).width(1.2))
        .labelled("motion")
        .dots(until(path, STEPS[0]), 2.0, PURPLE)
        .labelled("steps")
        .legend_at(Corner::BottomRight)
}

fn energy(measured: &Measured) -> Panel {
    let axes = (Axis::logarithmic("time *t*"), Axis::logarithmic("largest |*E* − *E*(0)|"));
    all(measured)
        .into_iter()
        .fold(Panel::new("Energy", axes.0, axes.1), |panel, (name, h, Growth(points), colour, dashed)| {
            let stroke = if dashed { Stroke::dashed(colour) } else { Stroke::solid(colour) };
            let label = if h == H { name.to_owned() } else { format!("{name}, *h* = {h}") };
            panel.line(points.clone(), stroke).labelled(label)
        })
        .legend_at(Corner::Beside)
        .weight(1.4)
}

fn all(measured: &Measured) -> [(&'static str, f64, &Growth, Colour, bool); 5] {
    [
        ("magnet", H, &measured.magnet, VERMILLION, false),
        ("magnet", H / 2.0, &measured.magnet_half, AMBER, false),
        ("magnet, RK4", H, &measured.magnet_rk4, VERMILLION, true),
        ("springs", H, &measured.springs, BLUE, false),
        ("springs, RK4", H, &measured.springs_rk4, BLUE, true),
    ]
}

fn turning(measured: &Measured) -> Panel {
    let axes = (Axis::linear("time *t*"), Axis::logarithmic("|*ω*|"));
    Panel::new("Rate of rotation of the sleigh", axes.0, axes.1)
        .line(measured.sleigh.turning_of_motion.clone(), Stroke::solid(SLATE).width(1.2))
        .labelled("motion")
        .dots(measured.sleigh.turning.clone(), 2.0, PURPLE)
        .labelled(format!("steps, *h* = {}", STEPS[0]))
}

pub(super) fn table(measured: &Measured) -> Result<Table> {
    let mut table = Table::new(&["series", "h", "t", "largest_energy_error"])?;
    for (name, h, Growth(points), ..) in all(measured) {
        for point in points {
            let numbers = [h, point[0], point[1]].map(number);
            table.row([name.to_owned()].into_iter().chain(numbers))?;
        }
    }
    Ok(table)
}
