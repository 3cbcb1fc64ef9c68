//! Long runs along geodesics, beside RK4 on the entries of the states, and what is claimed of them.

use crate::vocabulary::*;

use super::rk4::{rk4, rk4_up_to};

/// What a few operations leave that are not repeated: the errors of a matrix of products, or of the square
/// of a length.
pub const FEW_UNITS: f64 = 8.0 * f64::EPSILON;

/// A long run that is looked at every so many steps.
#[derive(Clone, Copy, Debug)]
pub struct Long {
    pub steps: u64,
    pub every: u64,
    pub h: f64,
}

impl Long {
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
        job: &Job<'_>,
        mut later: impl FnMut() -> Result<S, StepError>,
        of: impl Fn(&S) -> [f64; N],
    ) -> Result<[Deviation; N]> {
        let mut kept = Span { end: self.end(), early: self.end(), intervals: 300 }.deviations();
        let mut done = 0_u64;
        job.repeat(self.steps / self.every, || {
            let state = later()?;
            done += self.every;
            note(&mut kept, done as f64 * self.h, of(&state));
            Ok(())
        })?;
        Ok(kept)
    }

    pub fn along_geodesics<const D: usize, S: OnManifold<D>, const N: usize>(
        self,
        job: &Job<'_>,
        name: &str,
        system: S,
        start: &S::State<f64>,
        of: impl Fn(&S::State<f64>) -> [f64; N],
    ) -> Result<Series<N>> {
        let mut run = Integrator::new(&system, Geodesic::trapezoid(), self.h, start.clone())?;
        let later = || {
            run.take_steps(self.every)?;
            Ok(run.state())
        };
        Ok(Series::new(name, Stroke::solid(BLUE), self.watch(job, later, of)?))
    }

    /// The same by RK4 on the entries.
    pub fn by_rk4<const D: usize, S: OnManifold<D>, const N: usize>(
        self,
        job: &Job<'_>,
        system: S,
        start: &S::State<f64>,
        of: impl Fn(&S::State<f64>) -> [f64; N],
    ) -> Result<Series<N>> {
        let mut y = S::entries(start);
        let later = || {
            y = (0..self.every).fold(y, |y, _| rk4(&y, self.h, |y| system.motion(y)));
            Ok(S::state(&y))
        };
        Ok(Series::new("RK4", Stroke::solid(VERMILLION), self.watch(job, later, of)?))
    }
}

/// Panels of quantities over time, by their titles, labels, and lowest values; only the first has a legend.
pub fn panels<const N: usize>(
    end: f64,
    all: &[Series<N>],
    quantities: &[(usize, [&str; 2], [f64; 2])],
) -> Vec<Panel> {
    let panel = |&(quantity, labels, range)| {
        let panel = over_time(labels, end, range, all, quantity).legend_at(Corner::BottomRight);
        if quantity == 0 { panel } else { panel.without_legend() }
    };
    quantities.iter().map(panel).collect()
}

/// The circles of the heights between which something moves, from above.
pub fn between_heights(panel: Panel, heights: &Heights) -> Panel {
    let radii = heights.extremes().map(|height| (1.0 - height * height).sqrt());
    panel.each(radii, |panel, radius| panel.line(circle([0.0; 2], radius), Stroke::dashed(SLATE).width(1.0)))
}

/// The entries of a state after time `end`, by RK4 with short steps.
pub fn reference<const D: usize, S: OnManifold<D>>(
    system: S,
    start: &S::State<f64>,
    end: f64,
    h: f64,
) -> [f64; D] {
    rk4_up_to(S::entries(start), end, h, |y| system.motion(y))
}

/// The claim that R and ω of a body are of second order, and of fourth by a composition, at a time, for
/// steps of these lengths, against RK4 with short steps.
pub fn order_claim<S: OnManifold<12>>(
    body: &str,
    system: S,
    start: &S::State<f64>,
    end: f64,
    steps: [f64; 3],
    fine: f64,
) -> Result<Claim> {
    let [exact, double] = [fine, 2.0 * fine].map(|h| reference(system, start, end, h));
    let error = |state: S::State<f64>| apart(&S::entries(&state), &exact);
    let simple = |h| up_to(&system, Geodesic::trapezoid(), h, start.clone(), end);
    let composed = |h| up_to(&system, Composition::suzuki(Geodesic::trapezoid()), h, start.clone(), end);
    let text = format!(
        "R and ω of {body} are of second order, and of fourth by Suzuki's composition, against RK4 with \
         short steps"
    );
    let [second, fourth] = [
        order_of(steps, |h| Ok((h, error(simple(h)?))))?,
        order_of(steps, |h| Ok((h, error(composed(h)?))))?,
    ];
    Ok(beyond(text)
        .at_most("largest difference of two references", apart(&exact, &double), 1e-9)
        .near(format!("geodesics: order at t = {end}"), second, [2.0, 0.05])
        .near(format!("Suzuki's composition: order at t = {end}"), fourth, [4.0, 0.1]))
}

/// The checks that the energy error of a run is no larger than predicted, and has no trend.
pub fn flat_energy(job: &Job<'_>, claim: Claim, run: &str, energy: &Deviation, predicted: f64) -> Claim {
    let trend = format!("{run}: max|ΔE|, last tenth of the time over the first");
    let claim = claim.at_most(format!("{run}: max|ΔE|"), energy.largest, 1.02 * predicted);
    claim.near(trend, job.only_full(energy.trend()), [1.0, 0.01])
}
