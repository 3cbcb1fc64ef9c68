//! A panel of what should be conserved, over the time of long runs.

use crate::deviation::Deviation;
use crate::figure::{Axis, Colour, Corner, Panel, Stroke};

/// Largest magnitudes over time, on a logarithmic axis.
#[derive(Clone, Copy, Debug)]
pub struct Drifts<'a> {
    pub title: &'a str,
    pub label: &'a str,
    pub range: [f64; 2],
    /// The end of the runs.
    pub end: f64,
}

impl Drifts<'_> {
    /// A line for each run: its name, its colour, and what it has kept.
    pub fn panel<'s>(&self, runs: impl IntoIterator<Item = (&'s str, Colour, &'s Deviation)>) -> Panel {
        let [low, high] = self.range;
        let time = Axis::linear("time *t*").within(0.0, self.end);
        let panel = Panel::new(self.title, time, Axis::logarithmic(self.label).within(low, high));
        let lines = runs.into_iter().fold(panel, |panel, (name, colour, kept)| {
            panel.line(kept.envelope.magnitude(), Stroke::solid(colour)).labelled(name)
        });
        lines.legend_at(Corner::BottomRight)
    }
}
