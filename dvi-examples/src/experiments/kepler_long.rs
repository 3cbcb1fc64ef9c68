//! Kosmas & Vlachos, Fig. 3: energy and position over 10⁵ periods of an orbit with e = 0.95.
//!
//! The phase-fitted method is run as the paper has it, frequency (19) left-frozen and steps by (23) as printed,
//! and in the reading that preserves what can be preserved: the frequency r^(−3/2) as a part of the discrete
//! Lagrangian, and reversible steps in proportion to r^(3/2). Verlet, with the same steps, stands beside them.

use std::f64::consts::TAU;

use anyhow::Result;
use dvi_core::prelude::*;
use rayon::prelude::*;

use super::kepler::{Course, Run, follow, osculating, reversible};
use crate::claim::{BEYOND, Bound, Claim};
use crate::figure::{
    AMBER, Axis, BLUE, Colour, Corner, Figure, GREEN, Panel, SLATE, Stroke, VERMILLION, scientific,
};
use crate::gallery::{Experiment, Outcome};
use crate::job::Job;
use crate::models::Orbit;
use crate::output::Table;

pub const EXPERIMENT: Experiment =
    Experiment { name: "kepler-long", title: "A Kepler orbit with e = 0.95 over 10⁵ periods", run };

const ORBIT: Orbit = Orbit { e: 0.95 };
/// The parameter of the reversible step control.
const EPSILON: f64 = 0.02;
/// The tolerance of (23); at 0.03 the orbit soon breaks up.
const TOLERANCE: f64 = 0.01;
/// After so many periods of steps by (23) there is nothing left of the orbit.
const LOST: u64 = 1000;
/// Intervals of a decade of time.
const PER_DECADE: f64 = 40.0;

const CONTENDERS: [(&str, Colour); 4] = [
    ("Verlet", SLATE),
    ("Simpson, left-frozen (19), steps by (23)", AMBER),
    ("Simpson, left-frozen (19), reversible steps", GREEN),
    ("Lobatto-4, variational √(|*a*|/|*q*|), reversible", VERMILLION),
];

/// What one run leaves: the largest errors in each interval of the logarithm of time.
struct Series {
    name: &'static str,
    colour: Colour,
    /// [t/period, |E − E(0)|, position error].
    rows: Vec<[f64; 3]>,
    course: Course,
    /// max |E − E(0)| over the first hundred periods.
    early: f64,
    failure: Option<anyhow::Error>,
}

fn run(job: &Job<'_>) -> Result<Outcome> {
    let periods = job.choose(100_000, 300);
    job.expect(3 * periods + periods.min(LOST));
    let simpson = Variational::simpson();
    let frozen = simpson.phase_fitted(Curvature(Reading::LeftFrozen));
    let lobatto = Variational::new(Quadrature::lobatto(4)?).phase_fitted(Radial(Reading::Variational));
    let all: Vec<Series> = (0..CONTENDERS.len())
        .into_par_iter()
        .map(|contender| {
            let record = |run: &mut dyn FnMut(&mut Series)| {
                let mut series = Series::new(contender);
                run(&mut series);
                series
            };
            Ok(match contender {
                0 => {
                    let mut run = reversible(Variational::trapezoid(), ORBIT, EPSILON)?;
                    record(&mut |series| series.follow(job, &mut run, periods))
                }
                1 => {
                    let mut run = osculating(frozen, ORBIT, TOLERANCE)?;
                    record(&mut |series| series.follow(job, &mut run, periods.min(LOST)))
                }
                2 => {
                    let mut run = reversible(frozen, ORBIT, EPSILON)?;
                    record(&mut |series| series.follow(job, &mut run, periods))
                }
                _ => {
                    let mut run = reversible(lobatto, ORBIT, EPSILON)?;
                    record(&mut |series| series.follow(job, &mut run, periods))
                }
            })
        })
        .collect::<Result<_>>()?;
    job.publish(EXPERIMENT.name, figure(&all, periods), table(&all)?)?;
    Ok(Outcome { claims: claims(job, &all), notes: notes(&all) })
}

impl Series {
    fn new(contender: usize) -> Self {
        let (name, colour) = CONTENDERS[contender];
        Self { name, colour, rows: Vec::new(), course: Course::default(), early: 0.0, failure: None }
    }

    fn follow(&mut self, job: &Job<'_>, run: &mut impl Run, periods: u64) {
        let mut interval = i64::MIN;
        let (mut energy, mut position) = (0.0f64, 0.0f64);
        let course = follow(job, run, periods, |sample| {
            let (time, error) = (sample.t / TAU, ORBIT.error(sample.t, &sample.q));
            let current = ((time.max(0.1)).log10() * PER_DECADE).floor() as i64;
            if current > interval {
                interval = current;
                self.rows.push([10f64.powf((current as f64 + 0.5) / PER_DECADE), 0.0, 0.0]);
            }
            if let Some([_, largest_energy, largest_position]) = self.rows.last_mut() {
                *largest_energy = largest_energy.max(sample.energy.abs());
                *largest_position = largest_position.max(error);
            }
            energy = energy.max(sample.energy.abs());
            position = position.max(error);
            if time <= 100.0 {
                self.early = energy;
            }
        });
        self.course = Course { energy, position, ..Course::default() };
        match course {
            Ok(course) => self.course = Course { position, ..course },
            Err(failure) => self.failure = Some(failure),
        }
    }
}

fn claims(job: &Job<'_>, all: &[Series]) -> Vec<Claim> {
    let [verlet, paper, frozen, lobatto] = all else { return Vec::new() };
    vec![
        Claim::new("Fig. 3", "over 10⁵ periods energy and position error keep in stable limits")
            .check(
                "left-frozen, reversible steps: max|ΔE| over all / over 100 periods",
                job.only_full(frozen.course.energy / frozen.early),
                Bound::AtMost(2.0),
            )
            .check(
                "left-frozen, reversible steps: largest position error",
                job.only_full(frozen.course.position),
                Bound::AtMost(0.1),
            )
            .instead(
                "left-frozen, the energy drifts whatever chooses the steps, and the position error is stable \
                 only because it saturates at the size of the orbit",
            )
            .check(
                "left-frozen, reversible steps: max|ΔE| over all / over 100 periods",
                job.only_full(frozen.course.energy / frozen.early),
                Bound::AtLeast(10.0),
            )
            .check(
                "left-frozen, (23) as printed: max|ΔE| within 1000 periods",
                job.only_full(paper.course.energy),
                Bound::AtLeast(0.5),
            )
            .check(
                "left-frozen, reversible steps: largest position error",
                job.only_full(frozen.course.position),
                Bound::AtLeast(1.9),
            ),
        Claim::new(BEYOND, "variational and reversible, phase fitting keeps the energy without drift")
            .check("Lobatto-4: max|ΔE| over 100 periods", lobatto.early, Bound::Within(9.4e-8, 9.6e-8))
            .check("Lobatto-4: max|ΔE| over all", lobatto.course.energy, Bound::AtMost(1e-7))
            .check("Lobatto-4: steps per period", lobatto.course.steps, Bound::Within(460.0, 468.0))
            .check("Verlet: max|ΔE| over 100 periods", verlet.early, Bound::Near(1.542e-3, 1e-6)),
    ]
}

fn notes(all: &[Series]) -> Vec<String> {
    let line = |series: &Series| {
        let name = series.name.replace('*', "");
        match &series.failure {
            Some(error) => format!("{name}: ended early, {error}."),
            None => format!(
                "{name}: {:.0} steps and {:.0} evaluations per period; max|ΔE| {:.3e} over the first 100 periods, \
                 {:.3e} over all; position error up to {:.3}.",
                series.course.steps,
                series.course.evaluations,
                series.early,
                series.course.energy,
                series.course.position
            ),
        }
    };
    all.iter().map(line).collect()
}

fn figure(all: &[Series], periods: u64) -> Figure {
    let time = || Axis::logarithmic("time *t*   [periods]").within(0.1, periods as f64);
    let panel = |title: &str, axis: Axis, column: usize| {
        all.iter().fold(Panel::new(title, time(), axis), |panel, series| {
            let points = series.rows.iter().map(|row| [row[0], row[column]]).collect();
            panel.line(points, Stroke::solid(series.colour).width(1.6)).labelled(series.name)
        })
    };
    let energy = panel("Energy", Axis::logarithmic("largest |*E* − *E*(0)|   [μ/*a*]").within(1e-9, 1e6), 1);
    let position = panel(
        "Position",
        Axis::logarithmic("largest distance from the exact one   [*a*]").within(1e-9, 1e6),
        2,
    )
    .line(vec![[0.1, 2.0], [periods as f64, 2.0]], Stroke::dashed(BLUE).width(1.2))
    .without_legend();
    let best = all.last().map_or(f64::NAN, |series| series.course.energy);
    Figure::new(
        format!("10⁵ periods at *e* = 0.95: |Δ*E*| ≤ {} without drift; position errors saturate", scientific(best)),
        "Largest error in each interval of time; dashed: the diameter of the orbit",
    )
    .row(470.0, vec![energy.legend_at(Corner::TopLeft), position])
    .footer("After Kosmas & Vlachos, Fig. 3. Reversible: 464 steps per period; by (23), tolerance 0.01: about three times as many.")
}

fn table(all: &[Series]) -> Result<Table> {
    let mut table = Table::new(&["method", "periods", "energy_error", "position_error"])?;
    for series in all {
        for row in &series.rows {
            let numbers = row.map(|number| number.to_string());
            table.row([series.name.replace('*', "")].into_iter().chain(numbers))?;
        }
    }
    Ok(table)
}
