//! Long runs along geodesics, beside RK4 on the entries of the states, what is claimed of them, and where a
//! height that goes up and down turns, between their steps.

use super::rk4::{rk4, rk4_to};
use crate::vocabulary::*;

/// What a few operations leave that are not repeated, as those of a matrix of products.
pub const FEW_UNITS: f64 = 8.0 * f64::EPSILON;

/// A long run that is looked at every so many steps.
#[derive(Clone, Copy)]
pub struct Long<'a> {
    pub job: &'a Job<'a>,
    pub steps: u64,
    pub every: u64,
    pub h: f64,
}

impl Long<'_> {
    pub fn end(self) -> f64 {
        self.steps as f64 * self.h
    }

    /// The standard deviation of a sum of so many independent errors of one unit of rounding.
    pub fn random_walk(self) -> f64 {
        f64::EPSILON * (self.steps as f64).sqrt()
    }

    /// How far quantities are from their start, as `of` says of the states that `later` comes to.
    pub fn watch<S, const N: usize>(
        self,
        (name, stroke): Named<'_>,
        mut later: impl FnMut() -> Result<S, StepError>,
        of: impl Fn(&S) -> [f64; N],
    ) -> Result<Series<N>> {
        let mut kept = Span { end: self.end(), early: self.end(), intervals: 300 }.deviations();
        let mut done = 0_u64;
        self.job.repeat(self.steps / self.every, || {
            done += self.every;
            note(&mut kept, done as f64 * self.h, of(&later()?));
            Ok(())
        })?;
        Ok(Series::new(name, stroke, kept))
    }

    /// The same by RK4 on the entries of the states, and along geodesics.
    pub fn both<const D: usize, S: OnManifold<D>, const N: usize>(
        self,
        name: &str,
        system: S,
        start: &S::State<f64>,
        of: impl Fn(&S::State<f64>) -> [f64; N],
    ) -> Result<[Series<N>; 2]> {
        let mut y = system.entries(start);
        let by_rk4 = || {
            y = (0..self.every).fold(y, |y, _| rk4(&y, self.h, |y| system.motion(y)));
            Ok(system.state(&y))
        };
        let mut run = Integrator::new(&system, Geodesic::trapezoid(), self.h, start.clone())?;
        let along = || {
            run.take_steps(self.every)?;
            Ok(run.state())
        };
        let by_rk4 = self.watch(("RK4", solid(VERMILLION)), by_rk4, &of)?;
        Ok([by_rk4, self.watch((name, solid(BLUE)), along, &of)?])
    }

    /// The checks that the energy error of a run is no larger than predicted, and has no trend.
    pub fn flat_energy(self, claim: Claim, run: &str, energy: &Deviation, predicted: f64) -> Claim {
        let trend = format!("{run}: max|ΔE|, last tenth of the time over the first");
        let claim = claim.at_most(format!("{run}: max|ΔE|"), energy.largest, 1.02 * predicted);
        claim.near(trend, self.job.only_full(energy.trend()), [1.0, 0.01])
    }

    /// Panels of quantities over time, by their titles, labels, and ranges; only the first has a legend.
    pub fn panels<const N: usize>(
        self,
        all: &[Series<N>],
        quantities: &[(usize, [&str; 2], [f64; 2])],
    ) -> Vec<Panel> {
        let panel = |&(quantity, labels, range)| {
            let panel = over_time(labels, self.end(), range, all, quantity).legend_at(Corner::BottomRight);
            if quantity == 0 { panel } else { panel.without_legend() }
        };
        quantities.iter().map(panel).collect()
    }
}

pub fn between_heights(panel: Panel, heights: &Heights) -> Panel {
    let radii = heights.extremes().map(|height| (1.0 - height * height).sqrt());
    panel.each(radii, |panel, radius| panel.line(circle([0.0; 2], radius), dashed(SLATE).width(1.0)))
}

/// The entries of a state after time `end`, by RK4 with short steps.
pub fn reference<const D: usize, S: OnManifold<D>>(
    system: S,
    start: &S::State<f64>,
    [end, h]: [f64; 2],
) -> [f64; D] {
    rk4_to(system.entries(start), end, h, |y| system.motion(y))
}

/// The claim that R and ω of a body are of second order, and of fourth by a composition.
pub fn order_claim<S: OnManifold<12>>(
    body: &str,
    (system, start): (S, S::State<f64>),
    steps: [f64; 3],
    [end, fine]: [f64; 2],
) -> Result<Claim> {
    let [exact, double] = [fine, 2.0 * fine].map(|h| reference(system, &start, [end, h]));
    let (motion, simple) = (Problem::new(&system, start), Geodesic::trapezoid());
    let error = |state| apart(&system.entries(&state), &exact);
    let second = order_of(steps, |h| Ok((h, error(motion.up_to(simple, h, end)?))))?;
    let fourth = order_of(steps, |h| Ok((h, error(motion.up_to(Composition::suzuki(simple), h, end)?))))?;
    Ok(beyond(format!(
        "R and ω of {body} are of second order, and of fourth by Suzuki's composition, against RK4 with \
         short steps"
    ))
    .at_most("largest difference of two references", apart(&exact, &double), 1e-9)
    .near(format!("geodesics: order at t = {end}"), second, [2.0, 0.05])
    .near(format!("Suzuki's composition: order at t = {end}"), fourth, [4.0, 0.1]))
}

/// The energy of a run beside what backward error analysis says of it: steps of length h keep E − h²g up to
/// terms of the order h⁴, for a function g that the model knows.
#[derive(Clone, Copy)]
pub struct Shadow {
    h: f64,
    /// E and g at the start.
    begin: [f64; 2],
    /// The largest |E − E(0)|, what h²g makes of it, and the largest difference of both.
    largest: f64,
    pub predicted: f64,
    rest: f64,
}

impl Shadow {
    pub fn new(h: f64, energy: f64, shift: f64) -> Self {
        Self { h, begin: [energy, shift], largest: 0.0, predicted: 0.0, rest: 0.0 }
    }

    pub fn push(&mut self, energy: f64, shift: f64) {
        let (change, predicted) = (energy - self.begin[0], self.h * self.h * (shift - self.begin[1]));
        self.largest = larger(self.largest, change.abs());
        self.predicted = larger(self.predicted, predicted.abs());
        self.rest = larger(self.rest, (change - predicted).abs());
    }
}

/// The claim that the energy error is as predicted, of runs with several steps, the longest first.
pub fn shadow_claim(method: &str, runs: &[Shadow]) -> Claim {
    let order = |error: fn(&Shadow) -> f64| order(runs.iter().map(|run| (run.h, error(run))));
    let ratio = runs.last().map(|run| run.largest / run.predicted);
    beyond(format!(
        "{method}: backward error analysis gives the energy error in closed form, h² times a function of \
         the state, and the rest is of the order h⁴"
    ))
    .of(method)
    .near("order of max|ΔE|", order(|run| run.largest), [2.0, 0.05])
    .near("max|ΔE| / the predicted one, shortest step", ratio, [1.0, 0.01])
    .near("order of the largest |ΔE − prediction|", order(|run| run.rest), [4.0, 0.1])
}

#[derive(Default)]
struct Turnings {
    last: Option<Sample>,
    /// The lowest and the highest ones: the height, and g.
    found: [Vec<[f64; 2]>; 2],
}

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

/// Up and down to a time: the lowest and the highest turnings of a run, and its energy.
pub fn up_and_down<R: Run<Scalar = f64>>(
    mut run: R,
    end: f64,
    heights: &Heights,
    start: Sample,
    of: impl Fn(&R) -> Sample,
) -> Result<([Extreme; 2], Shadow)> {
    let (h, mut turnings) = (run.step_size(), Turnings::default());
    let mut shadow = Shadow::new(h, start.energy, start.shift);
    for _ in 0..(end / h).round() as u64 {
        run.advance()?;
        let sample = of(&run);
        shadow.push(sample.energy, sample.shift);
        turnings.push(h, sample);
    }
    Ok((turnings.against(h, heights, start.shift), shadow))
}

impl Turnings {
    fn push(&mut self, h: f64, now: Sample) {
        if let Some(before) = self.last.replace(now)
            && before.rate * now.rate < 0.0
        {
            // The extreme of the cubic polynomial through both heights with both rates.
            let [first, square, cube] = hermite([before.height, before.rate], [now.height, now.rate], h);
            let root = (square * square - 3.0 * cube * first).max(0.0).sqrt();
            let s = first / (first.signum() * root - square);
            let height = before.height + s * (first + s * (square + s * cube));
            let g = before.shift + s * (now.shift - before.shift);
            self.found[usize::from(before.rate > 0.0)].push([height, g]);
        }
    }

    /// Against the roots at the start, of which g is `shift`: of the lowest and of the highest turnings.
    fn against(&self, h: f64, heights: &Heights, shift: f64) -> [Extreme; 2] {
        let roots = heights.extremes();
        [0, 1].map(|side| {
            let (root, found) = (roots[side], &self.found[side]);
            let mean = |of: &dyn Fn([f64; 2]) -> f64| {
                found.iter().copied().map(of).sum::<f64>() / found.len() as f64
            };
            Extreme {
                h,
                count: found.len(),
                mean: mean(&|[height, _]| height - root),
                largest: largest(found.iter().map(|[height, _]| (height - root).abs())),
                predicted: mean(&|[_, g]| h * h * (g - shift)) / heights.stiffness(root),
            }
        })
    }
}

/// The claim that `what` turns at the roots, by runs with three steps, each half of the one before.
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
        assert!((3.1 + 0.1 * crossing(at(3.1), at(3.2), 0.1) - std::f64::consts::PI).abs() < 1e-8);
    }

    #[test]
    fn turnings_of_a_sine_are_found_between_the_steps() {
        let mut turnings = Turnings::default();
        for k in 0..400 {
            let t = f64::from(k) * 0.1 + 0.03;
            turnings.push(0.1, Sample { height: t.sin(), rate: t.cos(), energy: 0.5, shift: 0.0 });
        }
        for (side, found) in turnings.found.iter().enumerate() {
            assert_eq!(found.len(), [6, 7][side]);
            assert!(found.iter().all(|[height, _]| (height - [-1.0, 1.0][side]).abs() < 1e-6), "{found:?}");
        }
    }
}
