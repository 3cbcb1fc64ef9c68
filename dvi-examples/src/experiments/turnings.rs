//! Where a height that goes up and down turns, between the steps of a run.

use super::geodesics::Shadow;
use crate::vocabulary::*;

/// The height, its rate, the energy E, and g of the energy E − h²g that steps keep.
#[derive(Clone, Copy)]
pub struct Sample {
    pub height: f64,
    pub rate: f64,
    pub energy: f64,
    pub shift: f64,
}

#[derive(Clone, Copy)]
pub struct Extreme {
    h: f64,
    count: usize,
    /// The mean of height − root, the largest magnitude, and what the energy E + h²(g − g(0)) makes of it.
    mean: f64,
    largest: f64,
    predicted: f64,
}

/// Up and down to a time: the lowest and the highest turnings of a run, against the roots at its start, and
/// its energy.
pub fn up_and_down<R: Run<Scalar = f64>>(
    mut run: R,
    end: f64,
    heights: &Heights,
    of: impl Fn(&R) -> Sample,
) -> Result<([Extreme; 2], Shadow)> {
    let h = run.step_size();
    let samples = course(&mut run, (end / h).round() as u64, of)?;
    let (found, roots) = (turnings(h, &samples), heights.extremes());
    let extremes = [0, 1].map(|side| {
        let (root, found) = (roots[side], &found[side]);
        let over_all = |of: &dyn Fn([f64; 2]) -> f64| mean(found.iter().copied().map(of));
        Extreme {
            h,
            count: found.len(),
            mean: over_all(&|[height, _]| height - root),
            largest: largest(found.iter().map(|[height, _]| (height - root).abs())),
            predicted: over_all(&|[_, g]| h * h * (g - samples[0].shift)) / heights.stiffness(root),
        }
    });
    Ok((extremes, Shadow::of(h, samples.iter().map(|sample| [sample.energy, sample.shift]))))
}

/// The lowest and the highest turnings between samples: the height, and g.
fn turnings(h: f64, samples: &[Sample]) -> [Points; 2] {
    let mut found = [vec![], vec![]];
    let turns = samples.iter().zip(&samples[1..]).filter(|(before, now)| before.rate * now.rate < 0.0);
    for (before, now) in turns {
        // The extreme of the cubic polynomial through both heights with both rates.
        let [first, square, cube] = hermite([before.height, before.rate], [now.height, now.rate], h);
        let root = (square * square - 3.0 * cube * first).max(0.0).sqrt();
        let s = first / (first.signum() * root - square);
        let height = before.height + s * (first + s * (square + s * cube));
        let g = before.shift + s * (now.shift - before.shift);
        found[usize::from(before.rate > 0.0)].push([height, g]);
    }
    found
}

pub fn turning_claim(what: &str, [coarse, middle, fine]: [&[Extreme; 2]; 3]) -> Claim {
    let [[low, high], [_, Extreme { h: half, .. }], [_, Extreme { h, .. }]] = [coarse, middle, fine];
    let square = low.h * low.h;
    let bound = 1.1 * larger(low.predicted.abs(), high.predicted.abs()) / square;
    let farthest = larger(low.largest, high.largest) / square;
    let distance = format!("distance from the root, h = {half} over h = {h}");
    beyond(format!(
        "{what} goes up and down between the roots of its cubic, up to a multiple of h², which follows \
         from the energy error in closed form"
    ))
    .each([0, 1], |claim, side: usize| {
        let (name, middle, fine) = (["lowest", "highest"][side], &middle[side], &fine[side]);
        let [predicted, found] = [fine.predicted, fine.mean].map(|height| height / (h * h));
        let claim = claim.of(name).at_least("turnings", fine.count as f64, 5.0);
        let claim = claim.of(format!("{name}, h = {h}"));
        let claim = claim.near("(height − root)/h²", found, [predicted, 0.02 * predicted.abs()]);
        claim.of(name).near(&distance, middle.mean / fine.mean, [4.0, 0.1])
    })
    .of(format!("h = {}", low.h))
    .at_most("largest distance of a turning from its root / h²", farthest, bound)
}

/// The coefficients of s, s² and s³ in the cubic through two values with their rates, for s from 0 to 1.
fn hermite(before: [f64; 2], after: [f64; 2], h: f64) -> [f64; 3] {
    let [first, last] = [h * before[1], h * after[1]];
    let rise = after[0] - before[0];
    [first, 3.0 * rise - 2.0 * first - last, first + last - 2.0 * rise]
}

/// The part of a step after which a value is zero that changes its sign in it, by values with their rates.
pub fn crossing(before: [f64; 2], after: [f64; 2], h: f64) -> f64 {
    let [first, square, cube] = hermite(before, after, h);
    let value = |s: f64| before[0] + s * (first + s * (square + s * cube));
    bisected([0.0, 1.0], |s| value(s) * before[0] > 0.0)
}
