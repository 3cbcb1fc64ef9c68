//! Rowley & Marsden 2002, Fig. 3: trajectories of two leapfrogging pairs, and what becomes of them under
//! RK2 at the step that VE2 can take.

use crate::claim::larger;
use anyhow::Result;
use dvi_core::methods::Method;
use dvi_core::prelude::*;

use crate::claim::{Bound, Claim};
use crate::figure::{
    Axis, BLUE, Corner, Envelope, Figure, Fill, GREEN, Panel, SLATE, Stroke, VERMILLION, scientific,
};
use crate::gallery::{Experiment, Outcome};
use crate::job::Job;
use crate::models::{self, Case, FourVortices};
use crate::output::Table;

pub const EXPERIMENT: Experiment = Experiment {
    name: "fig3-leapfrogging",
    title: "Trajectories of two leapfrogging pairs",
    share: 1.0,
    run,
};

/// How long the trajectories are that the figure shows.
const SHOWN: f64 = 200.0;

struct Series {
    /// The first points of each vortex.
    trajectories: [Vec<[f64; 2]>; 4],
    /// The distance of vortices 1 and 2.
    distance: Envelope,
    /// Times at which one of vortices 1 and 2 overtakes the other.
    overtakings: Vec<f64>,
    end: f64,
    /// The largest coordinate at the end.
    extent: f64,
    /// The largest deviation from mirror symmetry about y = 0.
    asymmetry: f64,
    /// The error that ended the run early.
    failure: Option<StepError>,
}

fn run(job: &Job<'_>) -> Result<Outcome> {
    let end = job.choose(2e5, 2e4);
    job.expect(2 * (end / 2.0) as u64 + (SHOWN / 0.5) as u64);
    let start = Start::RungeKutta(RungeKutta::midpoint());
    let ve2 = series(job, Sigma { start, ..Sigma::leapfrog() }, 2.0, end)?;
    let rk2 = series(job, RungeKutta::midpoint(), 2.0, end)?;
    let exact = series(job, Gauss::<3>::new(), 0.5, SHOWN)?;
    job.publish(EXPERIMENT.name, figure(&ve2, &rk2, &exact), table(&ve2)?)?;
    let last = rk2.overtakings.last().copied().unwrap_or(0.0);
    let note = format!(
        "RK2 at h = 2: the last overtaking is at t = {last}. The mirror symmetry breaks by rounding, so this \
         time is not reproducible from machine to machine; that the pairs come apart is."
    );
    let failures = [("VE2", &ve2), ("RK2", &rk2)].into_iter().filter_map(|(name, series)| {
        series.failure.map(|error| format!("{name} at h = 2 ended early: {error}."))
    });
    let notes = [note].into_iter().chain(failures).collect();
    Ok(Outcome { claims: claims(job, &ve2, &rk2), references: vec![], notes })
}

fn series(job: &Job<'_>, method: impl Method<FourVortices, f64>, h: f64, end: f64) -> Result<Series> {
    let Case { vortices, start } = models::leapfrogging();
    let mut run = Integrator::new(&vortices, method, h, start)?;
    let mut series = Series {
        trajectories: Default::default(),
        distance: Envelope::new(end, 500),
        overtakings: vec![0.0],
        end,
        extent: 0.0,
        asymmetry: 0.0,
        failure: None,
    };
    let steps = (end / h) as u64;
    let mut lead = 0.0;
    series.note(0.0, run.q(), &mut lead);
    series.failure = job.repeat_until_lost(steps, || {
        run.advance()?;
        series.note(run.time(), run.q(), &mut lead);
        Ok(())
    });
    series.extent = run.q().iter().fold(0.0, |extent, q| larger(q.abs(), extent));
    Ok(series)
}

impl Series {
    /// Notes a state; `lead` is the sign of x₁ − x₂ in the state before.
    fn note(&mut self, t: f64, q: &[f64], lead: &mut f64) {
        let (x, y) = q.split_at(4);
        if t <= SHOWN {
            (0..4).for_each(|j| self.trajectories[j].push([x[j], y[j]]));
        }
        self.distance.push(t, (x[0] - x[1]).hypot(y[0] - y[1]));
        self.asymmetry = larger(larger(self.asymmetry, (x[0] - x[2]).abs()), (y[0] + y[2]).abs());
        let now = (x[0] - x[1]).signum();
        if now * *lead < 0.0 {
            self.overtakings.push(t);
        }
        *lead = now;
    }

    fn longest_interval(&self) -> f64 {
        // A run that ended early has not overtaken since.
        let reached = self.distance.end().min(self.end);
        let times = self.overtakings.iter().chain([&reached]);
        let pairs = times.clone().zip(times.skip(1));
        pairs.map(|(before, after)| after - before).fold(0.0, larger)
    }
}

fn claims(job: &Job<'_>, ve2: &Series, rk2: &Series) -> Vec<Claim> {
    let infinite = if rk2.extent.is_finite() { 0.0 } else { 1.0 };
    vec![
        Claim::new("Fig. 3", "the two pairs leapfrog past each other")
            .check(
                "longest time between overtakings, VE2 at h = 2",
                ve2.longest_interval(),
                Bound::AtMost(36.0),
            )
            .check("largest deviation from mirror symmetry, VE2", ve2.asymmetry, Bound::AtMost(1e-3)),
        Claim::new("section 5", "RK2 blows up at h = 2")
            .check("infinite or undefined coordinates", job.only_full(infinite), Bound::AtLeast(1.0))
            .instead("the numbers stay finite, but the pairs come apart")
            .check(
                "longest time between overtakings, RK2 at h = 2",
                rk2.longest_interval(),
                Bound::AtLeast(200.0),
            )
            .check("largest coordinate at the end", rk2.extent, Bound::AtMost(1e6)),
    ]
}

fn figure(ve2: &Series, rk2: &Series, exact: &Series) -> Figure {
    // Mirror partners have one colour: 1 and 3, 2 and 4.
    let colours = [BLUE, VERMILLION, BLUE, VERMILLION];
    let place = |name: &str| Axis::linear(format!("*{name}*   [*L*]"));
    let mut paths =
        Panel::new("Trajectories: VE2 with *h* = 2 (dots) on accurate ones (lines)", place("x"), place("y"))
            .equal();
    for j in 0..4 {
        paths = paths.line(exact.trajectories[j].clone(), Stroke::solid(colours[j]).opacity(0.55));
        if j < 2 {
            paths = paths.labelled(format!("vortex {} and its image {}", j + 1, j + 3));
        }
        paths = paths.dots(ve2.trajectories[j].clone(), 1.9, colours[j]).discs(
            ve2.trajectories[j].iter().take(1).copied().collect(),
            colours[j],
            Fill::Hollow,
        );
    }
    let time = Axis::linear("time *t*   [*L*²/Γ]").within(0.0, ve2.end);
    let distance = Panel::new(
        "Distance of vortices 1 and 2 (range and mean)",
        time,
        Axis::logarithmic("|*z*₁ − *z*₂|   [*L*]"),
    )
    .band(rk2.distance.band(), SLATE)
    .line(rk2.distance.mean(), Stroke::solid(SLATE))
    .labelled("RK2, *h* = 2")
    .band(ve2.distance.band(), GREEN)
    .line(ve2.distance.mean(), Stroke::solid(GREEN))
    .labelled("VE2, *h* = 2");
    Figure::new(
        "Two leapfrogging pairs with *h* = 2: trajectories, and the distance of two vortices with VE2 and RK2",
        format!(
            "Up to *t* = {}: the longest time without overtaking is {:.0} with VE2 and {:.0} with RK2",
            scientific(ve2.distance.end()),
            ve2.longest_interval(),
            rk2.longest_interval()
        ),
    )
    .row(400.0, vec![paths.legend_at(Corner::Beside)])
    .row(300.0, vec![distance.legend_at(Corner::Beside)])
    .footer("Γ = 1 above, Γ = −1 below. After Rowley & Marsden 2002, Fig. 3. Γ and *L*: units of circulation and length.")
}

fn table(ve2: &Series) -> Result<Table> {
    let mut table = Table::new(&["step", "x1", "y1", "x2", "y2", "x3", "y3", "x4", "y4"])?;
    for k in 0..ve2.trajectories[0].len() {
        let places = ve2.trajectories.iter().flat_map(|trajectory| trajectory[k]);
        table.row([k as f64].into_iter().chain(places))?;
    }
    Ok(table)
}
