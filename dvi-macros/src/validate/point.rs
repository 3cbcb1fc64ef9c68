//! The points at which a system is checked.
//!
//! Everything that a formula takes from outside is a number drawn from the text of the formulas, so that
//! the same source gives the same points in every build. An array needs no storage: an entry is drawn
//! from its name and its indices.

use std::ops::Range;

use rustc_hash::FxHashMap as HashMap;

use crate::model::{Model, Shape};
use crate::symbolic::{Atom, Index, Weight};

/// What is drawn for a coordinate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Variable {
    Position,
    Velocity,
}

/// The entries along which a direction goes; elsewhere it is zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Support<'a> {
    All,
    /// Those blocks for which this holds.
    Blocks(&'a [bool]),
    /// About half of the entries of each block, drawn by a number, and their other half.
    Half(u64),
    OtherHalf(u64),
    /// A single entry of a block.
    Entry(usize, i64),
    /// No coordinate, but a single constraint: a declared one, and a member of it.
    Constraint(usize, i64),
}

/// Two directions of displacement, both for positions and for velocities.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Directions<'a> {
    pub(super) first: Support<'a>,
    pub(super) second: Support<'a>,
}

impl Directions<'_> {
    pub(super) const ALL: Self = Self { first: Support::All, second: Support::All };
}

/// Which side of a comparison of the formulas is taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Branches {
    AsCompared,
    /// Each the other way round, so that the other side is checked too.
    Exchanged,
}

#[derive(Clone, Debug)]
pub(super) struct Point {
    seed: u64,
    /// The values of the sizes of the model, in its order.
    sizes: Vec<i64>,
    /// Long ranges are visited at this many of their values.
    pub(super) most_visited: i64,
    pub(super) branches: Branches,
    /// All velocities are zero.
    is_at_rest: bool,
    /// Positions, velocities and the time are drawn with these numbers.
    draws: [u64; 3],
    parameters: HashMap<String, f64>,
}

/// Sizes of arrays to try, one after the other: small and different, then equal, then larger.
const SIZES: [[i64; 4]; 8] =
    [[3, 4, 2, 5], [4, 3, 5, 2], [3; 4], [2, 3, 4, 5], [6, 5, 7, 6], [5; 4], [9; 4], [17; 4]];

/// Intervals that values are drawn from.
const INTERVALS: [(f64, f64); 10] = [
    (0.2, 0.9),
    (-0.9, 0.9),
    (1.1, 2.5),
    (-2.0, 2.0),
    (0.3, 1.6),
    (-0.3, 0.3),
    (2.5, 7.0),
    (-6.0, 6.0),
    (0.02, 0.2),
    (8.0, 40.0),
];

/// A number from a number (Steele, Lea & Flood 2014, splitmix64).
pub(super) fn mix(seed: u64) -> u64 {
    let mut z = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

pub(super) fn mix_text(seed: u64, text: &str) -> u64 {
    text.bytes().fold(mix(seed), |hash, byte| mix(hash ^ u64::from(byte)))
}

/// Uniform in 0..1.
fn unit(hash: u64) -> f64 {
    (hash >> 11) as f64 / (1_u64 << 53) as f64
}

fn within((low, high): (f64, f64), hash: u64) -> f64 {
    low + (high - low) * unit(hash)
}

/// Of either sign, and not small.
fn signed(hash: u64) -> f64 {
    within((0.5, 1.5), hash) * if hash & 1 == 0 { 1.0 } else { -1.0 }
}

impl Point {
    /// Trial number `attempt` with the sizes number `sizes`.
    pub(super) fn new(model: &Model, seed: u64, attempt: u64, sizes: usize, branches: Branches) -> Self {
        let seed = mix(seed ^ mix(attempt));
        let choice = SIZES[sizes % SIZES.len()];
        let sizes = model.sizes.iter().enumerate().map(|(number, size)| {
            let field = size.text.strip_suffix(".len()");
            let literal = model.parameters.iter().find_map(|parameter| match &parameter.shape {
                Shape::Array(Some(length), _) if Some(parameter.text.as_str()) == field => Some(*length),
                _ => None,
            });
            literal.unwrap_or(choice[number % choice.len()])
        });
        let sizes: Vec<i64> = sizes.collect();
        // A field of type `usize` is a size and a number.
        let counts = model.sizes.iter().zip(&sizes).map(|(size, value)| (size.text.clone(), *value as f64));
        Self {
            seed,
            parameters: counts.collect(),
            sizes,
            most_visited: 5,
            branches,
            is_at_rest: false,
            draws: [1, 2, 3],
        }
    }

    pub(super) fn seed(&self) -> u64 {
        self.seed
    }

    /// The same system somewhere else: other positions, velocities and time, or some of them.
    pub(super) fn elsewhere(&self, positions: bool, velocities: bool, time: bool) -> Self {
        let moved = [positions, velocities, time];
        let mut other = self.clone();
        for (draw, _) in other.draws.iter_mut().zip(moved).filter(|(_, moved)| *moved) {
            *draw += 10;
        }
        other
    }

    /// The same point with all velocities zero.
    pub(super) fn at_rest(&self) -> Self {
        Self { is_at_rest: true, ..self.clone() }
    }

    pub(super) fn size(&self, number: usize) -> Option<i64> {
        self.sizes.get(number).copied()
    }

    /// The value of a size of the model, which no bound index stands in.
    pub(super) fn length(&self, index: &Index) -> Option<i64> {
        index.value(&|atom| match atom {
            Atom::Size(size) => self.size(size.0 as usize),
            _ => None,
        })
    }

    /// The values of `lower..upper` that are visited: of a long range the first ones.
    pub(super) fn visited(&self, lower: i64, upper: i64) -> Range<i64> {
        first_of(lower..upper, self.most_visited)
    }

    fn interval(&self, kind: u64, block: usize) -> (f64, f64) {
        let choice = mix(self.seed ^ mix(100 + kind) ^ mix(1000 + block as u64));
        INTERVALS[choice as usize % INTERVALS.len()]
    }

    pub(super) fn variable(&self, kind: Variable, block: usize, index: i64) -> f64 {
        let (number, draw) = match kind {
            Variable::Position => (0, self.draws[0]),
            Variable::Velocity if self.is_at_rest => return 0.0,
            Variable::Velocity => (1, self.draws[1]),
        };
        let hash = mix(self.seed ^ mix(draw) ^ mix(mix(number + 7 * block as u64) ^ index as u64));
        within(self.interval(number, block), hash)
    }

    pub(super) fn time(&self) -> f64 {
        within((0.1, 1.9), mix(self.seed ^ mix(self.draws[2]) ^ 31))
    }

    /// An entry of a parameter, by its name.
    pub(super) fn parameter(&self, name: &str, indices: &[i64]) -> f64 {
        if let (Some(count), []) = (self.parameters.get(name), indices) {
            return *count;
        }
        let named = mix_text(self.seed, name);
        let hash = indices.iter().fold(mix(named), |hash, index| mix(hash ^ *index as u64));
        let interval = match mix(named ^ 5) % 4 {
            0 => (0.1, 0.9),
            1 => (1.0, 3.0),
            _ => (0.4, 1.6),
        };
        within(interval, hash)
    }

    /// The component of a direction; the second one is another draw.
    pub(super) fn direction(&self, support: Support<'_>, is_second: bool, block: usize, index: i64) -> f64 {
        let half = |number: u64| mix(mix(number) ^ mix(index as u64)) & 1 == 0;
        let counts = match support {
            Support::All => true,
            Support::Blocks(holds) => holds[block],
            Support::Half(number) => half(number),
            Support::OtherHalf(number) => !half(number),
            Support::Entry(only, at) => return f64::from(u8::from(block == only && index == at)),
            Support::Constraint(..) => false,
        };
        let hash = mix(self.seed ^ mix(50 + u64::from(is_second)) ^ mix(mix(block as u64) ^ index as u64));
        if counts { signed(hash) } else { 0.0 }
    }

    /// The component of the first direction in the row of a constraint.
    pub(super) fn row(&self, support: Support<'_>, constraint: usize, member: i64) -> f64 {
        match support {
            Support::All => signed(mix(self.seed ^ mix(60) ^ mix(mix(constraint as u64) ^ member as u64))),
            Support::Constraint(only, at) => f64::from(u8::from(constraint == only && member == at)),
            Support::Blocks(_) | Support::Half(_) | Support::OtherHalf(_) | Support::Entry(..) => 0.0,
        }
    }

    pub(super) fn weight(&self, weight: Weight) -> f64 {
        within((-1.5, 1.5), mix(self.seed ^ mix(70 + weight as u64)))
    }
}

/// The values of a range, of which at most so many are visited.
pub(super) fn first_of(range: Range<i64>, most: i64) -> Range<i64> {
    range.start..range.end.min(range.start.saturating_add(most))
}
