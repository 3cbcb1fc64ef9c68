//! The parasitic mode of the two-step map: the part of an orbit that alternates from step to step.
//!
//! It decides whether a run can be used. The energy of Fig. 2 does not show it, because that motion is
//! protected by its mirror symmetry. Beyond the paper.

use crate::claim::larger;
use anyhow::Result;
use dvi_core::prelude::*;

use crate::claim::{BEYOND, Bound, Check, Claim};
use crate::figure::{Axis, BLUE, Colour, Corner, Figure, Fill, GREEN, INK, Panel, Stroke, VERMILLION, thin};
use crate::gallery::{Experiment, Outcome};
use crate::job::Job;
use crate::models::{self, Case};
use crate::output::{Table, number};

pub const EXPERIMENT: Experiment = Experiment {
    name: "parasitic",
    title: "Growth of the parasitic mode (beyond the paper)",
    share: 1.0,
    run,
};

const COLOURS: [Colour; 4] = [BLUE, GREEN, VERMILLION, INK];
/// Energy errors above this mean that the motion is lost.
const LOST: f64 = 0.1;

struct Series {
    motion: &'static str,
    sigma: f64,
    h: f64,
    /// [t, amplitude of the alternating component, |H − H(0)| so far].
    points: Vec<[f64; 3]>,
    /// When the run ended, and the error that ended it early.
    end: f64,
    failure: Option<StepError>,
}

fn run(job: &Job<'_>) -> Result<Outcome> {
    // The sum of t/h over the runs below.
    job.expect(48_000 + 27_000);
    let (leapfrogging, chaotic) = (models::leapfrogging(), models::chaotic());
    let series = |motion, case, runs: [(f64, f64); 4], end: f64| {
        runs.into_iter()
            .map(|(sigma, h)| series(job, (motion, case), sigma, h, end))
            .collect::<Result<Vec<_>>>()
    };
    let runs = [(0.25, 0.5), (0.25, 0.25), (0.25, 0.125), (0.5, 0.5)];
    let leapfrogging = series("leapfrogging", &leapfrogging, runs, 3000.0)?;
    let runs = [(0.0, 0.1), (0.0, 0.05), (0.0, 0.02), (0.5, 0.1)];
    let chaotic = series("chaotic", &chaotic, runs, 300.0)?;
    job.publish(
        EXPERIMENT.name,
        figure(&leapfrogging, &chaotic),
        table(leapfrogging.iter().chain(&chaotic))?,
    )?;
    let notes = notes(leapfrogging.iter().chain(&chaotic));
    Ok(Outcome { claims: claims(&leapfrogging, &chaotic), references: references(&leapfrogging), notes })
}

fn series(
    job: &Job<'_>,
    (motion, Case { vortices, start }): (&'static str, &Case),
    sigma: f64,
    h: f64,
    end: f64,
) -> Result<Series> {
    // The Runge–Kutta start leaves a parasitic mode of size h³, which then does what it does.
    let method = Sigma {
        start: Start::RungeKutta(RungeKutta::midpoint()),
        parasitic_limit: None,
        ..Sigma::new(sigma)
    };
    let mut run = Integrator::new(vortices, method, h, *start)?;
    let initial = run.energy();
    let (mut filter, mut points, mut largest) = (AlternatingComponent::new(vortices), Vec::new(), 0.0f64);
    let steps = (end / h) as u64;
    let failure = job.repeat_until_lost(steps, || {
        run.advance()?;
        largest = larger(largest, (run.energy() - initial).abs());
        points.extend(filter.amplitude(run.q()).map(|amplitude| [run.time(), amplitude, largest]));
        Ok(())
    });
    Ok(Series { motion, sigma, h, points, end: run.time(), failure })
}

impl Series {
    fn name(&self) -> String {
        format!("σ = {}, *h* = {}", self.sigma, self.h)
    }

    fn first_above(&self, column: usize, level: f64) -> Option<[f64; 3]> {
        self.points.iter().find(|point| point[column] > level).copied()
    }

    /// The exponential rate of growth between two amplitudes.
    fn rate(&self) -> Option<f64> {
        let [t0, a0, _] = self.first_above(1, 1e-4)?;
        let [t1, a1, _] = self.first_above(1, 1e-2)?;
        Some((a1 / a0).ln() / (t1 - t0))
    }

    /// When the energy error says that the motion is lost, or the run itself; infinite if neither does.
    fn lost(&self) -> f64 {
        let ended = if self.failure.is_some() { self.end } else { f64::INFINITY };
        self.first_above(2, LOST).map_or(ended, |point| point[0].min(ended))
    }

    /// The largest amplitude of the last tenth, over that of the first.
    fn growth(&self) -> f64 {
        let part = self.points.len() / 10;
        let largest = |points: &[[f64; 3]]| points.iter().map(|point| point[1]).fold(0.0, larger);
        largest(&self.points[self.points.len() - part..]) / largest(&self.points[..part])
    }
}

fn claims(leapfrogging: &[Series], chaotic: &[Series]) -> Vec<Claim> {
    let quarter = || leapfrogging.iter().filter(|series| series.sigma == 0.25);
    let explicit = || chaotic.iter().filter(|series| series.sigma == 0.0);
    let plain = |series: &Series| series.name().replace('*', "");
    let halves = || leapfrogging.iter().chain(chaotic).filter(|series| series.sigma == 0.5);
    let energy = |series: &Series| series.points.last().map_or(f64::NAN, |point| point[2]);
    let lost = Claim::new(
        BEYOND,
        "with σ = 0 the chaotic motion of Fig. 5 is lost at each of the steps tried, with σ = ½ not",
    );
    let lost = explicit().fold(lost, |claim, series| {
        claim.check(
            format!("time of |ΔH| > {LOST} or of an error that ends the run, {}", plain(series)),
            series.lost(),
            Bound::AtMost(300.0),
        )
    });
    let lost = halves().filter(|series| series.motion == "chaotic").fold(lost, |claim, series| {
        claim.check(format!("max|ΔH| to t = 300, {}", plain(series)), energy(series), Bound::AtMost(1e-4))
    });
    let grows = Claim::new(BEYOND, "for σ = ¼ the parasitic mode grows at a rate that does not depend on h");
    let reference = quarter().next().and_then(Series::rate);
    let grows = quarter().skip(1).fold(grows, |claim, series| {
        claim.check(
            format!("rate on the leapfrogging pairs, {}, over that of the largest h", plain(series)),
            series.rate().zip(reference).map(|(rate, first)| rate / first),
            Bound::Near(1.0, 0.1),
        )
    });
    let stays = Claim::new(BEYOND, "for σ = ½ it neither grows nor decays");
    let stays = halves().fold(stays, |claim, series| {
        claim.check(
            format!("late over early amplitude, {}, {}", series.motion, plain(series)),
            series.growth(),
            Bound::Near(1.0, 0.2),
        )
    });
    vec![lost, grows, stays]
}

/// The rate that independent programs have found.
fn references(leapfrogging: &[Series]) -> Vec<Check> {
    let quarter = leapfrogging.iter().filter(|series| series.sigma == 0.25);
    let rate = |series: &Series| {
        let quantity = format!("rate on the leapfrogging pairs, {}", series.name().replace('*', ""));
        Check::new(quantity, series.rate(), Bound::Near(7e-3, 7e-4))
    };
    quarter.map(rate).collect()
}

/// The runs that ended early, with the words of their errors.
fn notes<'a>(all: impl Iterator<Item = &'a Series>) -> Vec<String> {
    let note = |series: &Series| {
        let name = series.name().replace('*', "");
        let Series { motion, end, .. } = series;
        series.failure.map(|error| format!("{motion}, {name}: ended at t = {end}, {error}."))
    };
    all.filter_map(note).collect()
}

fn figure(leapfrogging: &[Series], chaotic: &[Series]) -> Figure {
    let amplitude =
        || Axis::logarithmic("amplitude of the alternating component   [*L*]").within(1e-9, 30.0);
    let left = panel("Leapfrogging pairs", amplitude(), leapfrogging, 1);
    let middle = panel("Chaotic motion", amplitude(), chaotic, 1);
    let energy = Axis::logarithmic("largest |*H* − *H*(0)| so far   [Γ²]").within(1e-9, 30.0);
    let right = panel("Chaotic motion: energy", energy, chaotic, 2).without_legend();
    Figure::new(
        "The parasitic mode of the two-step map: the part of an orbit that alternates from step to step",
        "All runs start with a step of RK2, which leaves a parasitic mode of size *h*³",
    )
    .row(460.0, vec![left, middle, right])
    .footer("A circle: the run ended there with an error. Data of Rowley & Marsden 2002, Figs. 2 and 5. Γ and *L*: units of circulation and length.")
}

fn panel(title: &str, value: Axis, all: &[Series], column: usize) -> Panel {
    let empty = Panel::new(title, Axis::linear("time *t*   [*L*²/Γ]"), value).legend_at(Corner::BottomRight);
    all.iter().zip(COLOURS).fold(empty, |panel, (series, colour)| {
        let points = series.points.iter().map(|point| [point[0], point[column]]).collect();
        let panel = panel.line(points, Stroke::solid(colour).width(1.4)).labelled(series.name());
        // Where an error ended the run.
        let ends = series.points.last().filter(|_| series.failure.is_some());
        panel.discs(ends.map(|point| [point[0], point[column]]).into_iter().collect(), colour, Fill::Hollow)
    })
}

fn table<'a>(all: impl Iterator<Item = &'a Series>) -> Result<Table> {
    let mut table = Table::new(&["motion", "sigma", "h", "t", "amplitude", "largest_energy_error"])?;
    for Series { motion, sigma, h, points, .. } in all {
        for [t, amplitude, error] in thin(points, 1000) {
            let numbers = [*sigma, *h, t, amplitude, error].map(number);
            table.row([(*motion).to_owned()].into_iter().chain(numbers))?;
        }
    }
    Ok(table)
}
