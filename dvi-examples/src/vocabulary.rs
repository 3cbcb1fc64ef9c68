//! The words that experiments are written in.

pub use std::f64::consts::{PI, TAU};

pub use anyhow::{Context as _, Result};
pub use dvi_core::methods::Method;
pub use dvi_core::prelude::*;

pub use crate::claim::{Bound, Check, Claim, beyond, claims, says};
pub use crate::deviation::*;
pub use crate::figure::{
    AMBER, Anchor, Axis, BLUE, Colour, Corner, Envelope, Figure, Fill, GREEN, INK, PURPLE, Panel, Points,
    SEQUENCE, SKY, SLATE, Stroke, VERMILLION, at_most, scientific, thin,
};
pub use crate::gallery::Outcome;
pub use crate::job::Job;
pub use crate::numbers::*;
pub use crate::output::Table;
pub use crate::runs::*;
pub use dvi_examples::models::{self, *};

/// A line of that colour.
pub const fn solid(colour: Colour) -> Stroke {
    Stroke::solid(colour)
}

/// A dashed line of that colour.
pub const fn dashed(colour: Colour) -> Stroke {
    Stroke::dashed(colour)
}
