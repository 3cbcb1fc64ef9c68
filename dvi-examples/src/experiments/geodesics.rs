//! Long runs along geodesics, beside RK4 on the entries of the states, and what is claimed of them.

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
        named: Named<'_>,
        mut later: impl FnMut() -> Result<S, StepError>,
        of: impl Fn(&S) -> [f64; N],
    ) -> Result<Series<N>> {
        let span = Span { end: self.end(), early: self.end(), intervals: 300 };
        Ok(self.job.watch(named, span, (self.h, self.every), || later().map(|state| of(&state)))?)
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
            Ok(system.state_of(y))
        };
        let mut run = Integrator::new(&system, Geodesic::trapezoid(), self.h, start.clone())?;
        let along = || {
            run.take_steps(self.every)?;
            Ok(run.state())
        };
        let by_rk4 = self.watch(("RK4", solid(VERMILLION)), by_rk4, &of)?;
        Ok([by_rk4, self.watch((name, solid(BLUE)), along, &of)?])
    }

    pub fn flat_energy(self, claim: Claim, run: &str, energy: &Envelope, predicted: f64) -> Claim {
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

pub fn order_claim<S: OnManifold<12>>(
    body: &str,
    (system, start): (S, S::State<f64>),
    steps: [f64; 3],
    [end, fine]: [f64; 2],
) -> Result<Claim> {
    let begin = system.entries(&start);
    let [exact, double] = [fine, 2.0 * fine].map(|h| rk4_to(begin, end, h, |y| system.motion(y)));
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
    /// The largest |E − E(0)|, what h²g makes of it, and the largest difference of both.
    largest: f64,
    pub predicted: f64,
    rest: f64,
}

impl Shadow {
    /// By E and g, from the start on.
    pub fn of(h: f64, all: impl IntoIterator<Item = [f64; 2]>) -> Self {
        let (mut begin, mut shadow) = (None, Self { h, largest: 0.0, predicted: 0.0, rest: 0.0 });
        for now in all {
            let [change, rise] = difference(now, *begin.get_or_insert(now));
            let predicted = h * h * rise;
            shadow.largest = larger(shadow.largest, change.abs());
            shadow.predicted = larger(shadow.predicted, predicted.abs());
            shadow.rest = larger(shadow.rest, (change - predicted).abs());
        }
        shadow
    }
}

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
