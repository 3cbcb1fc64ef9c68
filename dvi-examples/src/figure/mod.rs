//! Figures for a talk: panels in rows, written as SVG and as PNG of the same picture.
//!
//! The SVG is written directly: what the experiments need is little (axes, lines, bands, dots), a dot
//! of a Poincaré section costs a dozen bytes in one long path where an element of its own costs ten
//! times as much, and the picture is the same on every machine because the fonts are carried along.
//!
//! No library that was looked at sets a variable in italics within a label, nor thins out long series. The
//! SVG of `plotters` has an element for each dot, at whole pixels. That of `kuva` 0.6 differs from run to
//! run, has 8.3 MB for `kepler-frequency` in place of 60 kB, and puts all that is below 10⁻¹⁰ on one line of
//! a logarithmic axis.

mod axis;
mod decimate;
mod mark;
mod palette;
mod panel;
mod raster;
mod svg;

use std::path::Path;

use anyhow::Result;

use crate::output::write_whole;

pub use axis::{Axis, at_most, scientific};
pub use decimate::thin;
pub use palette::*;
pub use panel::{Corner, Line, Panel, Points, Ranged};
pub use svg::{Anchor, Stroke, dashed, solid};
use svg::{Svg, number};

const WIDTH: f64 = 1200.0;
const MARGIN: f64 = 22.0;
const HEADER: f64 = 72.0;
const FOOTER: f64 = 30.0;

/// Rows of panels under a title.
#[derive(Clone, Debug, Default)]
pub struct Figure {
    title: String,
    subtitle: String,
    footer: String,
    key: Option<[String; 2]>,
    rows: Vec<(f64, Vec<Panel>)>,
}

impl Figure {
    /// A figure that gets its title later.
    pub fn of(subtitle: impl Into<String>) -> Self {
        Self { subtitle: subtitle.into(), ..Self::default() }
    }

    /// Gives it this title if it has none.
    pub fn titled(self, title: &str) -> Self {
        if self.title.is_empty() { Self { title: title.to_owned(), ..self } } else { self }
    }

    /// Adds a row of panels, `height` units high; a figure is 1200 wide.
    pub fn row(mut self, height: f64, panels: Vec<Panel>) -> Self {
        self.rows.push((height, panels));
        self
    }

    /// Adds a row of panels that have one legend: beside the last, which is wider by the factor `weight`.
    pub fn row_with_legend(self, height: f64, mut panels: Vec<Panel>, weight: f64) -> Self {
        if let Some(last) = panels.pop() {
            panels = panels.into_iter().map(Panel::without_legend).collect();
            panels.push(last.legend_at(Corner::Beside).weight(weight));
        }
        self.row(height, panels)
    }

    /// Small print: the source, and what the reader should be warned of.
    pub fn footer(self, text: impl Into<String>) -> Self {
        Self { footer: text.into(), ..self }
    }

    /// Explains the colours of [`SEQUENCE`], from its first to its last.
    pub fn sequence_key(self, from: impl Into<String>, to: impl Into<String>) -> Self {
        Self { key: Some([from.into(), to.into()]), ..self }
    }

    pub fn svg(&self) -> String {
        let height = HEADER + self.rows.iter().map(|(height, _)| height).sum::<f64>() + FOOTER;
        let mut svg = Svg::new(WIDTH, height, &self.title);
        // Bold letters are about 0.7 as wide as high.
        let size = (WIDTH / (0.7 * self.title.chars().count() as f64)).min(20.0);
        let style = format!(" style=\"font-size:{}px\"", number(size));
        svg.text_with("strong", [MARGIN, 36.0], &self.title, &style);
        svg.text("muted", [MARGIN, 59.0], &self.subtitle);
        self.draw_key(&mut svg);
        let mut top = HEADER;
        for (height, panels) in &self.rows {
            let total: f64 = panels.iter().map(|panel| panel.weight).sum();
            let mut left = MARGIN;
            for panel in panels {
                let width = (WIDTH - 2.0 * MARGIN) * panel.weight / total;
                panel.draw(&mut svg, [left, top, width, *height]);
                left += width;
            }
            top += height;
        }
        svg.text("small", [MARGIN, height - 13.0], &self.footer);
        svg.finish()
    }

    fn draw_key(&self, svg: &mut Svg) {
        let Some([from, to]) = &self.key else { return };
        let (right, y, step) = (WIDTH - MARGIN - 90.0, 55.0, 18.0);
        let left = right - step * SEQUENCE.len() as f64;
        for (i, &colour) in SEQUENCE.iter().enumerate() {
            let x = number(left + step * i as f64);
            svg.stroke(&format!("M{x} {y}h{}", step + 0.5), solid(colour).width(12.0));
        }
        svg.text("end", [left - 8.0, y + 4.5], from);
        svg.text("", [right + 8.0, y + 4.5], to);
    }

    /// Writes `name.svg` and `name.png` into the folder.
    pub fn save(&self, folder: &Path, name: &str) -> Result<()> {
        let svg = self.svg();
        write_whole(&folder.join(format!("{name}.svg")), svg.as_bytes())?;
        write_whole(&folder.join(format!("{name}.png")), &raster::png(&svg)?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample() -> Figure {
        let wave = (0..20_000).map(|i| [f64::from(i) * 0.01, 1e-3 * (f64::from(i) * 0.3).sin()]).collect();
        let dots = (0..5_000).map(|i| [f64::from(i).cos(), f64::from(i).sin()]).collect();
        let left = Panel::new("Left", Axis::linear("time *t*"), Axis::linear("*H* < 1 & more"))
            .line(wave, solid(BLUE))
            .labelled("a wave");
        let right = Panel::new("Right", Axis::linear("*x*"), Axis::linear("*y*"))
            .dots(dots, 1.0, PURPLE)
            .equal()
            .labelled("a circle");
        Figure::of("and more")
            .titled("A title")
            .row(400.0, vec![left, right])
            .sequence_key("first", "last")
            .footer("source")
    }

    #[test]
    fn the_png_shows_text_and_data() {
        let png = raster::png(&sample().svg()).expect("drawable");
        let image = resvg::tiny_skia::Pixmap::decode_png(&png).expect("a PNG");
        assert_eq!((image.width(), image.height()), (2400, 1004));
        let dark = |x: std::ops::Range<u32>, y: std::ops::Range<u32>| {
            let pixels = y.flat_map(|y| x.clone().map(move |x| (x, y)));
            pixels.filter(|&(x, y)| image.pixel(x, y).is_some_and(|p| p.red() < 128)).count()
        };
        assert!(dark(40..400, 30..80) > 200, "the title is missing");
        assert!(dark(1300..2300, 250..800) > 1000, "the dots are missing");
    }

    #[test]
    fn a_figure_without_data_is_still_a_figure() {
        let empty = Panel::new("Empty", Axis::linear("*x*"), Axis::logarithmic("*y*"))
            .line(vec![[f64::NAN, 1.0]], solid(BLUE))
            .line(vec![[1.0, 2.0], [1.5, 1e40], [2.0, 3.0]], solid(BLUE))
            .band(vec![[1.0, -1.0, f64::INFINITY]], BLUE)
            .dots(vec![], 1.0, PURPLE);
        let svg = Figure::of("").row(300.0, vec![empty]).svg();
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
        assert!(raster::png(&svg).is_ok());
    }
}
