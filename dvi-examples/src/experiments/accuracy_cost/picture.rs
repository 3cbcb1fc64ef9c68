//! The figure: a column for each problem, with evaluations counted all, and those counted once that can be
//! made together.

use super::problems::{GAUSS_4, GAUSS_8, GAUSS_16, KAHAN_LI, RK4, SECOND};
use super::{Course, Measured, Series};
use crate::figure::{
    AMBER, Axis, BLUE, Corner, Figure, GREEN, INK, PURPLE, Panel, SLATE, Stroke, VERMILLION,
};

fn stroke(name: &str) -> Stroke {
    match name {
        SECOND => Stroke::solid(SLATE),
        RK4 => Stroke::dashed(INK),
        KAHAN_LI => Stroke::solid(GREEN),
        GAUSS_4 => Stroke::solid(AMBER),
        GAUSS_8 => Stroke::solid(VERMILLION),
        GAUSS_16 => Stroke::solid(BLUE),
        _ => Stroke::solid(PURPLE),
    }
}

/// How the work of a run is counted.
type Work = fn(&Course) -> u64;

pub(super) fn figure(all: &[Measured]) -> Figure {
    let row = |label: &str, work: Work| -> Vec<Panel> {
        let last = all.len().saturating_sub(1);
        let panels = all.iter().enumerate().map(|(i, measured)| {
            let panel = panel(measured, label, work);
            if i == last { panel.legend_at(Corner::Beside).weight(1.35) } else { panel.without_legend() }
        });
        panels.collect()
    };
    Figure::new(
        "Accuracy against cost: largest error of the energy over evaluations of the gradient",
        "Order 2 is the midpoint rule (σ = ½) on vortices and Störmer–Verlet else, and Kahan–Li 8 is composed of these",
    )
    .row(360.0, row("evaluations", Course::evaluations))
    .row(360.0, row("evaluations, all stages of a step at once", Course::in_turn))
    .footer(
        "Steps of one length. Gauss 4, 8, 16: collocation with 2, 4, 8 stages; in lanes its stages are evaluated at once, in the lower row they count once. \
         Hairer, Lubich & Wanner 2006.",
    )
}

fn panel(measured: &Measured, label: &str, work: Work) -> Panel {
    let x = Axis::logarithmic(label).within(2e3, 4e6);
    let y = Axis::logarithmic("max|Δ*H*| / |*H*|").within(1e-16, 1.0);
    let empty = Panel::new(measured.problem.title.clone(), x, y);
    measured.series.iter().fold(empty, |panel, Series { name, courses }| {
        let points: Vec<_> = courses.iter().map(|course| [work(course) as f64, course.error]).collect();
        let stroke = stroke(name);
        panel.line(points.clone(), stroke).labelled(*name).dots(points, 2.2, stroke.colour())
    })
}
