//! The words that experiments are written in.

pub use std::f64::consts::{FRAC_PI_2, PI, SQRT_2, TAU};

pub use anyhow::{Context as _, Result, bail, ensure};
pub use dvi_core::discrete::{Frequency, Interval, Rule as _};
pub use dvi_core::fast_sum::FastSum;
pub use dvi_core::field::{ScalarField, Spline};
pub use dvi_core::methods::VariableStep;
pub use dvi_core::prelude::*;
pub use dvi_core::{ProperlyDegenerate, Separable, Space as _, rotations};
pub use rayon::prelude::*;

pub use crate::alternating::AlternatingComponent;
pub use crate::claim::{Bound, Check, Claim, beyond, claims, says};
pub use crate::envelope::*;
pub use crate::figure::{
    AMBER, Anchor, Axis, BLUE, Colour, Corner, Figure, GREEN, INK, Line, PURPLE, Panel, Points, SEQUENCE,
    SKY, SLATE, Stroke, VERMILLION, at_most, dashed, scientific, solid, thin,
};
pub use crate::gallery::Outcome;
pub use crate::job::Job;
pub use crate::numbers::*;
pub use crate::output::Table;
pub use crate::rk4::*;
pub use crate::runs::*;
pub use crate::series::*;
pub use dvi_examples::models::{self, *};
pub use dvi_examples::osculating::{CentreSpeed, Osculating};
