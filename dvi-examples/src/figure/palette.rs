//! Colours that stay apart for colour-blind eyes and in print.

/// A colour as SVG writes it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Colour(pub &'static str);

// Okabe & Ito 2008, the ones with enough contrast on white.
pub const BLUE: Colour = Colour("#0072b2");
pub const VERMILLION: Colour = Colour("#d55e00");
pub const GREEN: Colour = Colour("#009e73");
pub const PURPLE: Colour = Colour("#b0609a");
pub const AMBER: Colour = Colour("#e69f00");
pub const SKY: Colour = Colour("#56b4e9");

pub const INK: Colour = Colour("#1f2328");
pub const SLATE: Colour = Colour("#57606a");
pub const GRID: Colour = Colour("#e8eaed");
pub const PAPER: Colour = Colour("#ffffff");

/// A sequence for quantities with an order: matplotlib's “plasma” without its yellow end, which would
/// vanish on white.
#[rustfmt::skip]
pub const SEQUENCE: [Colour; 8] = [
    Colour("#0d0887"),
    Colour("#46039f"),
    Colour("#7201a8"),
    Colour("#9c179e"),
    Colour("#bd3786"),
    Colour("#d8576b"),
    Colour("#ed7953"),
    Colour("#fb9f3a"),
];
