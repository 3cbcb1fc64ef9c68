//! What a panel can show, and how each of them becomes a path.

use std::collections::HashSet;
use std::fmt::Write as _;

use super::axis::Scale;
use super::decimate::by_column;
use super::palette::Colour;
use super::svg::{Stroke, Svg, number};

#[derive(Clone, Debug)]
pub(super) enum Mark {
    Line(Vec<[f64; 2]>, Stroke),
    /// The area between `low` and `high`, as [x, low, high].
    Band(Vec<[f64; 3]>, Colour),
    /// A dot at each point, of one stroke on top of the other.
    Dots(Vec<[f64; 2]>, Vec<Stroke>),
}

/// The part of the page that shows the data.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    pub(super) x: Scale,
    pub(super) y: Scale,
}

impl Frame {
    /// The pixel of a point, if it is on the page or not far from it: renderers do not take any number.
    pub(super) fn place(&self, [x, y]: [f64; 2]) -> Option<[f64; 2]> {
        const FAR: f64 = 1e4;
        let pixel = [self.x.place(x), self.y.place(y)];
        pixel.iter().all(|coordinate| coordinate.abs() < FAR).then_some(pixel)
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
            Mark::Line(points, _) | Mark::Dots(points, _) => points.clone(),
            Mark::Band(edges, _) => edges.iter().flat_map(|&[x, low, high]| [[x, low], [x, high]]).collect(),
        }
    }

    pub(super) fn draw(&self, svg: &mut Svg, frame: &Frame) {
        match self {
            Mark::Line(points, stroke) => {
                let pixels: Vec<_> = points.iter().map(|&point| frame.place(point)).collect();
                for run in pixels.split(Option::is_none) {
                    svg.stroke(&polyline(by_column(run.iter().flatten().copied().collect())), *stroke);
                }
            }
            Mark::Band(edges, colour) => {
                let edge =
                    |&[x, low, high]: &[f64; 3]| Some((frame.place([x, low])?, frame.place([x, high])?));
                let (low, high): (Vec<_>, Vec<_>) = edges.iter().filter_map(edge).unzip();
                svg.fill(&polyline(low.into_iter().chain(high.into_iter().rev())), *colour);
            }
            Mark::Dots(points, strokes) => {
                let path = dots(points, frame);
                strokes.iter().for_each(|stroke| svg.stroke(&path, stroke.round()));
            }
        }
    }

    /// A sample of the mark for the legend, around the given point.
    pub(super) fn draw_sample(&self, svg: &mut Svg, [x, y]: [f64; 2]) {
        let (left, right) = (x - 13.0, x + 13.0);
        match self {
            Mark::Line(_, stroke) => svg.stroke(&polyline([[left, y], [right, y]]), stroke.at_least(1.8)),
            Mark::Band(_, colour) => {
                let (above, below) = (y - 5.0, y + 5.0);
                let corners = [[left, above], [right, above], [right, below], [left, below]];
                svg.fill(&polyline(corners), *colour);
            }
            Mark::Dots(_, strokes) => {
                let large = |stroke: &Stroke| stroke.round().at_least(5.0).opacity(1.0);
                strokes.iter().for_each(|stroke| svg.stroke(&dot([x, y]), large(stroke)));
            }
        }
    }
}

fn polyline(points: impl IntoIterator<Item = [f64; 2]>) -> String {
    let mut path = String::new();
    for [x, y] in points {
        let command = if path.is_empty() { 'M' } else { 'L' };
        let _ = write!(path, "{command}{} {}", number(x), number(y));
    }
    path
}

fn dot([x, y]: [f64; 2]) -> String {
    format!("M{} {}h0.01", number(x), number(y))
}

/// One dot for each half pixel that is hit: more would change the size of the file and not the picture.
fn dots(points: &[[f64; 2]], frame: &Frame) -> String {
    let [left, top, width, height] = frame.rectangle();
    let mut taken = HashSet::new();
    let is_shown = |&[x, y]: &[f64; 2]| {
        let inside = (left..=left + width).contains(&x) && (top..=top + height).contains(&y);
        inside && taken.insert(((2.0 * x).round() as i64, (2.0 * y).round() as i64))
    };
    points.iter().filter_map(|&point| frame.place(point)).filter(is_shown).map(dot).collect()
}
