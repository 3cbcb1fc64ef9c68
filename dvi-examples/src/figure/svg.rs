//! An SVG document under construction: paths, text and clipped parts, nothing more. How kinds of text look
//! is said by `figure.css`.

use super::palette::{Colour, PAPER};

/// Where a text hangs on its point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    Start,
    Middle,
    End,
}

impl Anchor {
    /// The classes of a text that is readable on top of data.
    pub(super) fn rimmed(self) -> &'static str {
        match self {
            Anchor::Start => "rim",
            Anchor::Middle => "rim middle",
            Anchor::End => "rim end",
        }
    }
}

/// How a path is drawn.
#[derive(Clone, Copy, Debug)]
pub struct Stroke {
    colour: Colour,
    width: f64,
    opacity: f64,
    more: &'static str,
}

pub const fn solid(colour: Colour) -> Stroke {
    Stroke { colour, width: 1.8, opacity: 1.0, more: "" }
}

pub const fn dashed(colour: Colour) -> Stroke {
    Stroke { more: " stroke-dasharray=\"7 5\"", ..solid(colour) }
}

impl Stroke {
    pub const fn width(self, width: f64) -> Self {
        Self { width, ..self }
    }

    pub(super) fn at_least(self, width: f64) -> Self {
        self.width(self.width.max(width))
    }

    /// With round ends, which make a dot of a line without a length.
    pub(super) fn round(self) -> Self {
        Self { more: " stroke-linecap=\"round\"", ..self }
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
pub(super) struct Svg(String);

impl Svg {
    pub(super) fn new(width: f64, height: f64, title: &str) -> Self {
        let (style, title) = (include_str!("figure.css"), escape(&title.replace('*', "")));
        let [width, height] = [width, height].map(number);
        Self(format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" xml:space=\"preserve\">\n\
             <title>{title}</title>\n<style>\n{style}</style>\n\
             <rect width=\"100%\" height=\"100%\" fill=\"{}\"/>\n",
            PAPER.0
        ))
    }

    pub(super) fn stroke(&mut self, path: &str, Stroke { colour, width, opacity, more }: Stroke) {
        if !path.is_empty() {
            let (colour, width, opacity) = (colour.0, number(width), number(opacity));
            self.line(&format!(
                "<path d=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\" \
                 stroke-opacity=\"{opacity}\"{more}/>"
            ));
        }
    }

    pub(super) fn fill(&mut self, path: &str, colour: Colour) {
        if !path.is_empty() {
            self.line(&format!("<path d=\"{path}\" fill=\"{}\" fill-opacity=\"0.3\"/>", colour.0));
        }
    }

    /// A line of text of some classes of the style sheet; `*…*` sets italics, as variables want.
    pub(super) fn text(&mut self, classes: &str, at: [f64; 2], words: &str) {
        self.text_with(classes, at, words, "");
    }

    /// The same with more attributes, which begin with a space.
    pub(super) fn text_with(&mut self, classes: &str, at: [f64; 2], words: &str, more: &str) {
        if !words.is_empty() {
            let ([x, y], words) = (at.map(number), italics(words));
            self.line(&format!("<text class=\"{classes}\" x=\"{x}\" y=\"{y}\"{more}>{words}</text>"));
        }
    }

    /// Opens a part that shows nothing outside of the rectangle; [`close`](Self::close) ends it.
    pub(super) fn open(&mut self, rectangle: [f64; 4]) {
        let [x, y, width, height] = rectangle.map(number);
        self.line(&format!(
            "<svg x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"{x} {y} {width} {height}\">"
        ));
    }

    pub(super) fn close(&mut self) {
        self.line("</svg>");
    }

    pub(super) fn finish(mut self) -> String {
        self.close();
        self.0
    }

    fn line(&mut self, line: &str) {
        self.0 += line;
        self.0.push('\n');
    }
}

/// A coordinate with two decimals at most: a hundredth of a pixel is below what any screen shows.
pub(super) fn number(value: f64) -> String {
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.into() }
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

fn italics(text: &str) -> String {
    let pieces = text.split('*').enumerate().map(|(i, piece)| match i % 2 {
        0 => escape(piece),
        _ => format!("<tspan>{}</tspan>", escape(piece)),
    });
    pieces.collect()
}
