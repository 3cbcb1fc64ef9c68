//! What a panel can show, and how each of them becomes a path.

use std::collections::HashSet;
use std::fmt::Write as _;

use super::axis::{Axis, Scale};
use super::decimate::by_column;
use super::palette::{Colour, PAPER};
use super::svg::{Stroke, Svg, number};

#[derive(Clone, Debug)]
pub(super) enum Mark {
    /// Points joined in their order.
    Line(Vec<[f64; 2]>, Stroke),
    /// The area between `low` and `high`, as [x, low, high].
    Band(Vec<[f64; 3]>, Colour),
    /// Small dots of one radius.
    Dots(Vec<[f64; 2]>, f64, Colour),
    /// Discs with a white rim, filled or hollow.
    Discs(Vec<[f64; 2]>, Colour, Fill),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fill {
    Solid,
    Hollow,
}

/// The part of the page that shows the data.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    pub(super) x: Scale,
    pub(super) y: Scale,
}

impl Frame {
    pub(super) fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.x.place(x), self.y.place(y)]
    }

    /// Whether a pixel is on the page or not far from it: renderers do not take any number.
    fn is_near(&self, [x, y]: [f64; 2]) -> bool {
        const FAR: f64 = 1e4;
        x.abs() < FAR && y.abs() < FAR
    }

    pub(super) fn rectangle(&self) -> [f64; 4] {
        let ([left, right], [bottom, top]) = (self.x.pixels, self.y.pixels);
        [left, top, right - left, bottom - top]
    }
}

impl Mark {
    /// The points that decide the range of the axes.
    pub(super) fn corners(&self) -> Vec<[f64; 2]> {
        match self {
            Mark::Line(points, _) | Mark::Dots(points, ..) | Mark::Discs(points, ..) => points.clone(),
            Mark::Band(edges, _) => edges.iter().flat_map(|&[x, low, high]| [[x, low], [x, high]]).collect(),
        }
    }

    pub(super) fn draw(&self, svg: &mut Svg, frame: &Frame, [x, y]: [&Axis; 2]) {
        let visible = |point: &[f64; 2]| x.shows(point[0]) && y.shows(point[1]);
        match self {
            Mark::Line(points, stroke) => {
                let drawable = |point: &[f64; 2]| visible(point) && frame.is_near(frame.place(*point));
                for run in points.split(|point| !drawable(point)).filter(|run| !run.is_empty()) {
                    let run = by_column(run.iter().map(|&point| frame.place(point)));
                    svg.stroke(&polyline(&run), *stroke);
                }
            }
            Mark::Band(edges, colour) => {
                let shown = |edge: &&[f64; 3]| visible(&[edge[0], edge[1]]) && visible(&[edge[0], edge[2]]);
                let edges: Vec<_> = edges.iter().filter(shown).copied().collect();
                svg.fill(&outline(&edges, frame), *colour, 0.3);
            }
            Mark::Dots(points, radius, colour) => {
                let path = dots(points.iter().filter(|point| visible(point)), frame);
                svg.dots(&path, Stroke::solid(*colour).width(2.0 * radius).opacity(0.8));
            }
            Mark::Discs(points, colour, fill) => {
                let path = dots(points.iter().filter(|point| visible(point)), frame);
                svg.dots(&path, Stroke::solid(PAPER).width(12.0));
                disc(svg, &path, *colour, *fill);
            }
        }
    }

    /// A sample of the mark for the legend, around the given point.
    pub(super) fn draw_sample(&self, svg: &mut Svg, [x, y]: [f64; 2]) {
        let [left, right, above, x, y] = [x - 13.0, x + 13.0, y - 5.0, x, y].map(number);
        let dot = format!("M{x} {y}h0.01");
        match self {
            Mark::Line(_, stroke) => svg.stroke(&format!("M{left} {y}H{right}"), stroke.at_least(1.8)),
            Mark::Band(_, colour) => {
                svg.fill(&format!("M{left} {above}H{right}v10H{left}Z"), *colour, 0.3);
            }
            Mark::Dots(_, radius, colour) => {
                svg.dots(&dot, Stroke::solid(*colour).width((2.0 * radius).max(5.0)));
            }
            Mark::Discs(_, colour, fill) => disc(svg, &dot, *colour, *fill),
        }
    }
}

fn disc(svg: &mut Svg, path: &str, colour: Colour, fill: Fill) {
    svg.dots(path, Stroke::solid(colour).width(9.0));
    if fill == Fill::Hollow {
        svg.dots(path, Stroke::solid(PAPER).width(5.0));
    }
}

fn polyline(points: &[[f64; 2]]) -> String {
    let mut path = String::with_capacity(12 * points.len());
    for (i, &[x, y]) in points.iter().enumerate() {
        let command = if i == 0 { 'M' } else { 'L' };
        let _ = write!(path, "{command}{} {}", number(x), number(y));
    }
    path
}

fn outline(edges: &[[f64; 3]], frame: &Frame) -> String {
    let there = edges.iter().map(|&[x, low, _]| frame.place([x, low]));
    let back = edges.iter().rev().map(|&[x, _, high]| frame.place([x, high]));
    let path = polyline(&there.chain(back).collect::<Vec<_>>());
    if path.is_empty() { path } else { path + "Z" }
}

/// One dot for each half pixel that is hit: more would change the size of the file and not the picture.
fn dots<'a>(points: impl Iterator<Item = &'a [f64; 2]>, frame: &Frame) -> String {
    let [left, top, width, height] = frame.rectangle();
    let (mut path, mut taken) = (String::new(), HashSet::new());
    for &point in points {
        let [x, y] = frame.place(point);
        let inside = (left..=left + width).contains(&x) && (top..=top + height).contains(&y);
        let cell = ((2.0 * x).round() as i64, (2.0 * y).round() as i64);
        if inside && taken.insert(cell) {
            let _ = write!(path, "M{} {}h0.01", number(x), number(y));
        }
    }
    path
}
