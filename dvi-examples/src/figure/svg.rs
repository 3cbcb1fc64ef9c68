//! An SVG document under construction: paths, text and clipped groups, nothing more.

use std::fmt::Write as _;

use super::palette::{Colour, INK, PAPER};

/// Where a text hangs on its point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    Start,
    Middle,
    End,
}

/// A line of text; `*…*` sets italics, as variables want.
#[derive(Clone, Copy, Debug)]
pub(super) struct Label<'a> {
    pub(super) text: &'a str,
    pub(super) at: [f64; 2],
    pub(super) size: f64,
    pub(super) anchor: Anchor,
    pub(super) colour: Colour,
    pub(super) bold: bool,
    /// A white rim that keeps the text readable on top of data.
    pub(super) halo: bool,
    pub(super) upright: bool,
}

impl<'a> Label<'a> {
    pub(super) fn new(text: &'a str, at: [f64; 2], size: f64) -> Self {
        let colour = INK;
        Self { text, at, size, anchor: Anchor::Start, colour, bold: false, halo: false, upright: true }
    }
}

/// How a path is drawn.
#[derive(Clone, Copy, Debug)]
pub struct Stroke {
    colour: Colour,
    width: f64,
    opacity: f64,
    dash: &'static str,
}

impl Stroke {
    pub const fn solid(colour: Colour) -> Self {
        Self { colour, width: 1.8, opacity: 1.0, dash: "" }
    }

    pub const fn dashed(colour: Colour) -> Self {
        Self { dash: " stroke-dasharray=\"7 5\"", ..Self::solid(colour) }
    }

    pub const fn width(self, width: f64) -> Self {
        Self { width, ..self }
    }

    pub(super) fn at_least(self, width: f64) -> Self {
        self.width(self.width.max(width))
    }

    pub const fn opacity(self, opacity: f64) -> Self {
        Self { opacity, ..self }
    }

    /// The colour, for marks that belong to the line.
    pub fn colour(self) -> Colour {
        self.colour
    }
}

#[derive(Debug)]
pub(super) struct Svg {
    text: String,
    clips: usize,
}

impl Svg {
    pub(super) fn new(width: f64, height: f64, title: &str) -> Self {
        let text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}\" height=\"{h}\" viewBox=\"0 0 {w} {h}\" \
             font-family=\"DejaVu Sans, Verdana, sans-serif\" stroke-linejoin=\"round\">\n\
             <title>{}</title>\n<rect width=\"100%\" height=\"100%\" fill=\"{}\"/>\n",
            escape(&title.replace('*', "")),
            PAPER.0,
            w = number(width),
            h = number(height),
        );
        Self { text, clips: 0 }
    }

    pub(super) fn stroke(&mut self, path: &str, stroke: Stroke) {
        self.path(path, stroke, stroke.dash);
    }

    /// Round dots, one for each `M x yh0` of the path.
    pub(super) fn dots(&mut self, path: &str, stroke: Stroke) {
        self.path(path, stroke, " stroke-linecap=\"round\"");
    }

    fn path(&mut self, path: &str, Stroke { colour, width, opacity, .. }: Stroke, more: &str) {
        if !path.is_empty() {
            let (colour, width, opacity) = (colour.0, number(width), number(opacity));
            self.line(&format!(
                "<path d=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\" \
                 stroke-opacity=\"{opacity}\"{more}/>"
            ));
        }
    }

    pub(super) fn fill(&mut self, path: &str, colour: Colour, opacity: f64) {
        if path.is_empty() {
            return;
        }
        let (colour, opacity) = (colour.0, number(opacity));
        self.line(&format!("<path d=\"{path}\" fill=\"{colour}\" fill-opacity=\"{opacity}\"/>"));
    }

    pub(super) fn label(&mut self, label: Label<'_>) {
        let anchor = match label.anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let [x, y] = label.at.map(number);
        let mut attributes = format!(
            "x=\"{x}\" y=\"{y}\" font-size=\"{}\" text-anchor=\"{anchor}\" fill=\"{}\"",
            number(label.size),
            label.colour.0
        );
        if label.bold {
            attributes.push_str(" font-weight=\"bold\"");
        }
        if label.halo {
            attributes.push_str(" stroke=\"#ffffff\" stroke-width=\"4\" paint-order=\"stroke\"");
        }
        if !label.upright {
            let _ = write!(attributes, " transform=\"rotate(-90 {x} {y})\"");
        }
        self.line(&format!("<text {attributes} xml:space=\"preserve\">{}</text>", italics(label.text)));
    }

    /// Opens a group that shows nothing outside of the rectangle; [`close`](Self::close) ends it.
    pub(super) fn open_clipped(&mut self, [x, y, width, height]: [f64; 4]) {
        self.clips += 1;
        let id = self.clips;
        let [x, y, width, height] = [x, y, width, height].map(number);
        self.line(&format!(
            "<clipPath id=\"clip{id}\"><rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"/></clipPath>"
        ));
        self.line(&format!("<g clip-path=\"url(#clip{id})\">"));
    }

    pub(super) fn close(&mut self) {
        self.line("</g>");
    }

    pub(super) fn finish(mut self) -> String {
        self.line("</svg>");
        self.text
    }

    fn line(&mut self, line: &str) {
        self.text.push_str(line);
        self.text.push('\n');
    }
}

/// A coordinate with two decimals at most: a hundredth of a pixel is below what any screen shows.
pub(super) fn number(value: f64) -> String {
    let mut text = format!("{value:.2}");
    if text.contains('.') {
        text.truncate(text.trim_end_matches('0').trim_end_matches('.').len());
    }
    if text == "-0" { "0".into() } else { text }
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

fn italics(text: &str) -> String {
    let pieces = text.split('*').enumerate().map(|(i, piece)| match i % 2 {
        0 => escape(piece),
        _ => format!("<tspan font-style=\"italic\">{}</tspan>", escape(piece)),
    });
    pieces.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_round_to_a_hundredth() {
        let shown = [1.0, 2.5, 100.0, -0.001, 0.126, f64::from(1 << 20)].map(number);
        assert_eq!(shown, ["1", "2.5", "100", "0", "0.13", "1048576"]);
    }

    #[test]
    fn markup_becomes_italics_and_everything_else_is_escaped() {
        assert_eq!(italics("*H* < 2 & 3"), "<tspan font-style=\"italic\">H</tspan> &lt; 2 &amp; 3");
    }
}
