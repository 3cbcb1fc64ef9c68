//! Where a height that goes up and down turns, between the steps of a run.

use super::shadow::Shadow;
use crate::vocabulary::*;

struct Turnings {
    h: f64,
    last: Option<Sample>,
    /// The lowest and the highest ones: the height, and g.
    found: [Vec<[f64; 2]>; 2],
}

/// The height, its rate, the energy E, and g of the energy E − h²g that steps keep.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    pub height: f64,
    pub rate: f64,
    pub energy: f64,
    pub shift: f64,
}

/// How far the turnings of one side are from the root of the cubic.
#[derive(Clone, Copy, Debug)]
pub struct Extreme {
    h: f64,
    count: usize,
    /// The mean of height − root, the largest magnitude, and what the energy E + h²(g − g(0)) there makes of
    /// it.
    mean: f64,
    largest: f64,
    predicted: f64,
}

/// Up and down with steps of length `h` up to a time, each of which `next` takes: the lowest and the highest
/// turnings, and the energy.
pub fn up_and_down(
    [h, end]: [f64; 2],
    heights: &Heights,
    start: Sample,
    mut next: impl FnMut() -> Result<Sample, StepError>,
) -> Result<([Extreme; 2], Shadow)> {
    let mut turnings = Turnings { h, last: None, found: [Vec::new(), Vec::new()] };
    let mut shadow = Shadow::new(h, start.energy, start.shift);
    for _ in 0..(end / h).round() as u64 {
        let sample = next()?;
        shadow.push(sample.energy, sample.shift);
        turnings.push(sample);
    }
    Ok((turnings.against(heights, start.shift), shadow))
}

impl Turnings {
    fn push(&mut self, sample: Sample) {
        if let Some(before) = self.last.replace(sample)
            && before.rate * sample.rate < 0.0
        {
            self.found[usize::from(before.rate > 0.0)].push(self.between(before, sample));
        }
    }

    /// The extreme of the cubic polynomial through both heights with both rates.
    fn between(&self, before: Sample, after: Sample) -> [f64; 2] {
        let [first, square, cube] =
            hermite([before.height, before.rate], [after.height, after.rate], self.h);
        let root = (square * square - 3.0 * cube * first).max(0.0).sqrt();
        let s = first / (first.signum() * root - square);
        let height = before.height + s * (first + s * (square + s * cube));
        [height, before.shift + s * (after.shift - before.shift)]
    }

    /// Against the roots at the start, of which g is `shift`: of the lowest and of the highest turnings.
    fn against(&self, heights: &Heights, shift: f64) -> [Extreme; 2] {
        let roots = heights.extremes();
        [0, 1].map(|side| {
            let (root, found) = (roots[side], &self.found[side]);
            let mean = |of: &dyn Fn([f64; 2]) -> f64| {
                found.iter().copied().map(of).sum::<f64>() / found.len() as f64
            };
            Extreme {
                h: self.h,
                count: found.len(),
                mean: mean(&|[height, _]| height - root),
                largest: largest(found.iter().map(|[height, _]| (height - root).abs())),
                predicted: mean(&|[_, g]| self.h * self.h * (g - shift)) / heights.stiffness(root),
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
    let [[low, high], [_, Extreme { h: half, .. }], [_, Extreme { h, .. }]] = [coarse, middle, fine];
    let square = low.h * low.h;
    let bound = 1.1 * larger(low.predicted.abs(), high.predicted.abs()) / square;
    let farthest = larger(low.largest, high.largest) / square;
    let distance = format!("distance from the root, h = {half} over h = {h}");
    beyond(text)
        .each([0, 1], |claim, side: usize| {
            let (name, middle, fine) = (["lowest", "highest"][side], &middle[side], &fine[side]);
            let [predicted, found] = [fine.predicted, fine.mean].map(|height| height / (h * h));
            let claim = claim.of(name).at_least("turnings", fine.count as f64, 5.0);
            let claim = claim.of(format!("{name}, h = {h}"));
            let claim = claim.near("(height − root)/h²", found, [predicted, 0.02 * predicted.abs()]);
            claim.of(name).near(&distance, middle.mean / fine.mean, [4.0, 0.1])
        })
        .at_most(format!("h = {}: largest distance of a turning from its root / h²", low.h), farthest, bound)
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
        let mut turnings = Turnings { h: 0.1, last: None, found: [Vec::new(), Vec::new()] };
        for k in 0..400 {
            let t = f64::from(k) * 0.1 + 0.03;
            turnings.push(Sample { height: t.sin(), rate: t.cos(), energy: 0.5, shift: 0.0 });
        }
        for (side, found) in turnings.found.iter().enumerate() {
            assert_eq!(found.len(), [6, 7][side]);
            let expected = [-1.0, 1.0][side];
            assert!(found.iter().all(|[height, _]| (height - expected).abs() < 1e-6), "{found:?}");
        }
    }
}
