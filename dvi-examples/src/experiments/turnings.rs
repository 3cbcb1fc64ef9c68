//! Where a height that goes up and down turns, between the steps of a run.

use crate::models::Heights;
use crate::vocabulary::*;

/// The turnings of a run with steps of one length.
#[derive(Clone, Debug)]
pub struct Turnings {
    h: f64,
    last: Option<Sample>,
    /// The lowest and the highest ones.
    found: [Vec<Turning>; 2],
}

/// The height, its rate, and g of the energy E − h²g that steps keep.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    pub height: f64,
    pub rate: f64,
    pub shift: f64,
}

#[derive(Clone, Copy, Debug)]
struct Turning {
    height: f64,
    shift: f64,
}

/// How far the turnings of one side are from the root of the cubic.
#[derive(Clone, Copy, Debug)]
pub struct Extreme {
    pub h: f64,
    pub count: usize,
    /// The mean of height − root, the largest magnitude, and what the energy E + h²(g − g(0)) there makes of
    /// it.
    pub mean: f64,
    pub largest: f64,
    pub predicted: f64,
}

impl Turnings {
    pub fn new(h: f64) -> Self {
        Self { h, last: None, found: [Vec::new(), Vec::new()] }
    }

    /// Adds a point of the run, one step after the point before.
    pub fn push(&mut self, sample: Sample) {
        if let Some(before) = self.last.replace(sample)
            && before.rate * sample.rate < 0.0
        {
            let is_high = before.rate > 0.0;
            self.found[usize::from(is_high)].push(self.between(before, sample));
        }
    }

    /// The extreme of the cubic polynomial through both heights with both rates.
    fn between(&self, before: Sample, after: Sample) -> Turning {
        let [first, square, cube] =
            hermite([before.height, before.rate], [after.height, after.rate], self.h);
        let root = (square * square - 3.0 * cube * first).max(0.0).sqrt();
        let s = first / (first.signum() * root - square);
        Turning {
            height: before.height + s * (first + s * (square + s * cube)),
            shift: before.shift + s * (after.shift - before.shift),
        }
    }

    /// Against the roots at the start, of which g is `shift`: of the lowest and of the highest turnings.
    pub fn against(&self, heights: &Heights, shift: f64) -> [Extreme; 2] {
        let roots = heights.extremes();
        [0, 1].map(|side| {
            let (root, found) = (roots[side], &self.found[side]);
            let mean = |of: &dyn Fn(&Turning) -> f64| found.iter().map(of).sum::<f64>() / found.len() as f64;
            let energy = |turning: &Turning| self.h * self.h * (turning.shift - shift);
            Extreme {
                h: self.h,
                count: found.len(),
                mean: mean(&|turning| turning.height - root),
                largest: largest(found.iter().map(|turning| (turning.height - root).abs())),
                predicted: mean(&energy) / heights.stiffness(root),
            }
        })
    }
}

/// The claim that `what` turns at the roots, by the lowest and highest turnings of runs with three steps,
/// each half of the one before.
pub fn claim(what: &str, [coarse, middle, fine]: [&[Extreme; 2]; 3]) -> Claim {
    let text = format!(
        "{what} goes up and down between the roots of its cubic, up to a multiple of h², which follows \
         from the energy error in closed form"
    );
    let [low, high] = coarse;
    let square = low.h * low.h;
    let bound = 1.1 * larger(low.predicted.abs(), high.predicted.abs()) / square;
    beyond(text)
        .each(
            ["lowest", "highest"].into_iter().zip(middle.iter().zip(fine)),
            |claim, (name, (middle, fine))| {
                let predicted = fine.predicted / (fine.h * fine.h);
                let distance = format!("distance from the root, h = {} over h = {}", middle.h, fine.h);
                let over_square = fine.mean / (fine.h * fine.h);
                claim
                    .of(name)
                    .at_least("turnings", fine.count as f64, 5.0)
                    .of(format!("{name}, h = {}", fine.h))
                    .near("(height − root)/h²", over_square, [predicted, 0.02 * predicted.abs()])
                    .of(name)
                    .near(distance, middle.mean / fine.mean, [4.0, 0.1])
            },
        )
        .at_most(
            format!("h = {}: largest distance of a turning from its root / h²", low.h),
            larger(low.largest, high.largest) / square,
            bound,
        )
}

/// The coefficients of s, s² and s³ in the cubic polynomial through two values with their rates, a step of
/// length `h` apart, for s from 0 to 1.
fn hermite(before: [f64; 2], after: [f64; 2], h: f64) -> [f64; 3] {
    let [first, last] = [h * before[1], h * after[1]];
    let rise = after[0] - before[0];
    [first, 3.0 * rise - 2.0 * first - last, first + last - 2.0 * rise]
}

/// The part of a step of length `h` after which a value is zero that changes its sign in it: each of both
/// points is a value with its rate.
pub fn crossing(before: [f64; 2], after: [f64; 2], h: f64) -> f64 {
    let [first, square, cube] = hermite(before, after, h);
    let value = |s: f64| before[0] + s * (first + s * (square + s * cube));
    let [mut low, mut high] = [0.0, 1.0];
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if value(middle) * before[0] > 0.0 { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_zero_of_a_sine_is_found_between_the_steps() {
        let at = |t: f64| [t.sin(), t.cos()];
        let part = crossing(at(3.1), at(3.2), 0.1);
        assert!((3.1 + 0.1 * part - std::f64::consts::PI).abs() < 1e-8);
    }

    #[test]
    fn turnings_of_a_sine_are_found_between_the_steps() {
        let mut turnings = Turnings::new(0.1);
        for k in 0..400 {
            let t = f64::from(k) * 0.1 + 0.03;
            turnings.push(Sample { height: t.sin(), rate: t.cos(), shift: 0.0 });
        }
        for (side, found) in turnings.found.iter().enumerate() {
            assert_eq!(found.len(), [6, 7][side]);
            let expected = [-1.0, 1.0][side];
            assert!(found.iter().all(|turning| (turning.height - expected).abs() < 1e-6), "{found:?}");
        }
    }
}
