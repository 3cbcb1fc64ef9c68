//! What is printed and written: tables, a CSV of all points, and a figure for each problem.

use std::path::Path;

use anyhow::Result;
use dvi_examples::figure::{
    AMBER, Axis, BLUE, Colour, Corner, Figure, GREEN, INK, PURPLE, Panel, SKY, SLATE, Stroke, VERMILLION,
    dashed, solid,
};
use dvi_examples::output::Table;

use crate::measure::Point;
use crate::problem::Problem;
use crate::problems::{GAUSS_16, REFERENCE};

/// Bounds of the error for which the table has the smallest cost.
const BOUNDS: [f64; 3] = [1e-6, 1e-10, 1e-13];

/// The points of a problem, in the order of their methods.
pub(crate) struct Measured<'a> {
    pub(crate) problem: &'a Problem,
    pub(crate) points: Vec<Point>,
}

impl Measured<'_> {
    /// The names of the methods, in order.
    fn methods(&self) -> Vec<&str> {
        let mut names: Vec<&str> = self.points.iter().map(|point| point.method.as_str()).collect();
        names.dedup();
        names
    }

    /// The fastest run of a method that keeps the energy to `bound`.
    pub(crate) fn fastest(&self, method: &str, bound: f64) -> Option<&Point> {
        let within = self.points.iter().filter(|point| point.method == method && point.error <= bound);
        within.min_by(|a, b| a.milliseconds.total_cmp(&b.milliseconds))
    }

    /// How long `method` takes in units of `other`.
    pub(crate) fn ratio(&self, method: &str, other: &str, bound: f64) -> Option<f64> {
        let [time, of] =
            [method, other].map(|name| self.fastest(name, bound).map(|point| point.milliseconds));
        Some(time? / of?)
    }

    /// Milliseconds to hold each bound, in brackets in units of the reference, and evaluations.
    pub(crate) fn print(&self) {
        let Problem { title, error, .. } = self.problem;
        let bounds = BOUNDS.map(|bound| format!("{bound:e}")).join(" | ");
        println!("\n| {title}: ms to hold max {error} (× {REFERENCE}); evaluations | {bounds} |");
        println!("|---|---|---|---|");
        for method in self.methods() {
            let cells = BOUNDS.map(|bound| self.cell(method, bound)).join(" | ");
            println!("| {method} | {cells} |");
        }
    }

    fn cell(&self, method: &str, bound: f64) -> String {
        let Some(point) = self.fastest(method, bound) else { return "–".into() };
        let ratio = self.ratio(method, REFERENCE, bound).map(|ratio| format!(" (×{ratio:.2})"));
        let evaluations = point.evaluations.map(|count| format!("; {:.0}k", count as f64 / 1e3));
        let [ratio, evaluations] = [ratio, evaluations].map(|text| text.unwrap_or_default());
        format!("{:.3}{ratio}{evaluations}", point.milliseconds)
    }

    /// Writes `accuracy-<problem>.svg` and `.png`.
    pub(crate) fn draw(&self, folder: &Path) -> Result<()> {
        let x = Axis::logarithmic("milliseconds");
        let y = Axis::logarithmic(format!("max {}", self.problem.error)).within([1e-16, 1e-2]);
        let colours = [SLATE, SKY, GREEN, PURPLE, AMBER, BLUE, INK];
        let mut panel = Panel::new("", x, y).legend_at(Corner::Beside);
        for (i, method) in self.methods().into_iter().enumerate() {
            let emphasised = method == GAUSS_16;
            let stroke = if emphasised { solid(VERMILLION).width(3.4) } else { stroke(i, colours) };
            let points = self.points.iter().filter(|point| point.method == method);
            let points: Vec<[f64; 2]> = points.map(|point| [point.milliseconds, point.error]).collect();
            panel = panel.line(points.clone(), stroke).labelled(method).dots(points, 2.4, stroke.colour());
        }
        let Problem { title, name, .. } = self.problem;
        let subtitle = "Medians of interleaved runs; the energy is looked at after each step of a run that \
                        is not timed";
        let figure = Figure::of(subtitle).titled(&format!("Accuracy against cost: {title}"));
        figure.row(620.0, vec![panel]).save(folder, &format!("accuracy-{name}"))
    }
}

/// Solid lines first, then dashed ones in the same colours.
fn stroke(i: usize, colours: [Colour; 7]) -> Stroke {
    let colour = colours[i % colours.len()];
    if i < colours.len() { solid(colour) } else { dashed(colour) }
}

/// Writes `accuracy.csv` with all points.
pub(crate) fn write(all: &[Measured<'_>], folder: &Path) -> Result<()> {
    let columns = "problem,method,steps_or_tolerance,milliseconds,energy_error,evaluations";
    let rows = all.iter().flat_map(|Measured { problem, points }| {
        points.iter().map(|Point { method, knob, milliseconds, error, evaluations }| {
            let evaluations = evaluations.map(|count| count as f64);
            ([problem.name, method], [Some(*knob), Some(*milliseconds), Some(*error), evaluations])
        })
    });
    Table::of(columns, rows)?.save(folder, "accuracy")
}
