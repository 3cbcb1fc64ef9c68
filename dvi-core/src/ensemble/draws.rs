//! Random initial conditions and parameters that can be drawn again.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use rand_distr::{Distribution, StandardNormal};

/// Random numbers for the members of an ensemble. Those of member k depend on the seed and on k, and on
/// nothing else: they are the k-th stream of a generator, ChaCha with 8 rounds.
///
/// ```
/// use dvi_core::ensemble::Draws;
///
/// let draws = Draws::new(7);
/// let points: Vec<[f64; 2]> = draws.take(1000, |draw| [draw.normal(0.0, 0.1), draw.uniform(-1.0, 1.0)]).collect();
/// let mut again = draws.member(500);
/// assert_eq!(points[500], [again.normal(0.0, 0.1), again.uniform(-1.0, 1.0)]);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Draws {
    seed: u64,
}

impl Draws {
    /// The random numbers of a seed.
    pub fn new(seed: u64) -> Self {
        Self { seed }
    }

    /// Those of one member, from the first on.
    pub fn member(self, number: u64) -> Draw {
        // Not the numbers that a method with the same seed has.
        let mut key = *b"\0\0\0\0\0\0\0\0dvi ensemble draws 1\0\0\0\0";
        key[..8].copy_from_slice(&self.seed.to_le_bytes());
        let mut generator = ChaCha8Rng::from_seed(key);
        generator.set_stream(number);
        Draw { generator }
    }

    /// What `of` makes of those of each of the members 0, 1, …, `count` − 1.
    pub fn take<T>(self, count: u64, mut of: impl FnMut(&mut Draw) -> T) -> impl Iterator<Item = T> {
        (0..count).map(move |number| of(&mut self.member(number)))
    }
}

/// The random numbers of one member, one after the other.
///
/// ```
/// use dvi_core::ensemble::Draws;
///
/// // The numbers of member 3 of seed 7: the same whenever they are drawn.
/// let mut draw = Draws::new(7).member(3);
/// let mean = (0..10_000).map(|_| draw.normal(1.0, 0.1)).sum::<f64>() / 1e4;
/// assert!((mean - 1.0).abs() < 4e-3); // four standard deviations of a mean
/// ```
#[derive(Clone, Debug)]
pub struct Draw {
    generator: ChaCha8Rng,
}

impl Draw {
    /// A number that is uniformly distributed from `low` to below `high`. Rounding may make it `high`, where
    /// few numbers lie between; and `high` − `low` must be a number.
    pub fn uniform(&mut self, low: f64, high: f64) -> f64 {
        // 53 bits, as many as a number has.
        let unit = (self.generator.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
        low + (high - low) * unit
    }

    /// A number that is normally distributed, with this mean and standard deviation.
    pub fn normal(&mut self, mean: f64, deviation: f64) -> f64 {
        let standard: f64 = StandardNormal.sample(&mut self.generator);
        mean + deviation * standard
    }
}
