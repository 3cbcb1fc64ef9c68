//! How long the run of Rowley & Marsden's Fig. 2 lasts, and what carries it.
//!
//! Two leapfrogging pairs are mirror images of each other, and so is each step of VE2, up to rounding. While
//! the symmetry lasts, the parasitic mode of σ = 0 has nothing to grow from; rounding breaks it slowly. With
//! one vortex displaced there is no symmetry, and the motion is lost within the paper's time.

use crate::claim::larger;
use anyhow::Result;
use dvi_core::prelude::*;

use crate::claim::{Bound, Claim};
use crate::figure::{Axis, BLUE, Colour, Corner, Figure, Panel, SLATE, Stroke, VERMILLION, scientific};
use crate::gallery::{Experiment, Outcome};
use crate::job::Job;
use crate::models::{self, Case};
use crate::output::{Table, number};

pub const EXPERIMENT: Experiment = Experiment {
    name: "fig2-symmetry",
    title: "How long the run of Fig. 2 lasts, and its mirror symmetry",
    share: 5.0,
    run,
};

const H: f64 = 2.0;
/// The paper's time.
const PAPER: f64 = 2e5;
/// How far vortex 1 is displaced.
const DISPLACEMENT: [f64; 2] = [0.05, 0.035];
/// An energy error that says that the motion is lost, some fifteen times that of the paper's run.
const LOST: f64 = 0.05;
/// Intervals of a decade of time.
const PER_DECADE: f64 = 40.0;
/// States are read every so many steps; an odd number, so that no phase of the motion is preferred.
const STRIDE: u64 = 37;

struct Series {
    name: String,
    colour: Colour,
    /// [t, largest asymmetry, largest |H − H(0)|] of each interval of the logarithm of time.
    rows: Vec<[f64; 3]>,
    /// When |H − H(0)| exceeds `LOST`, or the run ends with an error; infinite if neither happens.
    lost: f64,
    end: f64,
    failure: Option<StepError>,
}

fn run(job: &Job<'_>) -> Result<Outcome> {
    let end = job.choose(1.2e8, PAPER);
    job.expect((end / H) as u64 + (PAPER / H) as u64);
    let symmetric = series(job, "as in the paper", BLUE, [0.0; 2], end)?;
    let [x, y] = DISPLACEMENT;
    let name = format!("vortex 1 displaced by ({x}, {y})");
    let displaced = series(job, &name, VERMILLION, DISPLACEMENT, PAPER)?;
    let all = [symmetric, displaced];
    job.publish(EXPERIMENT.name, figure(&all), table(&all)?)?;
    let [symmetric, displaced] = &all;
    let mut notes: Vec<String> = all.iter().map(Series::ending).collect();
    notes.push(
        "How rounding breaks the symmetry differs from program to program, and so does the time at which the \
         symmetric run breaks up."
            .to_owned(),
    );
    Ok(Outcome { claims: claims(job, symmetric, displaced), references: vec![], notes })
}

fn series(job: &Job<'_>, name: &str, colour: Colour, [dx, dy]: [f64; 2], end: f64) -> Result<Series> {
    let Case { vortices, mut start } = models::leapfrogging();
    start.x[0] += dx;
    start.y[0] += dy;
    // The run is to go on until its energy is lost, so the limit of the parasitic mode is off.
    let second_point = Start::RungeKutta(RungeKutta::midpoint());
    let method = Sigma { start: second_point, parasitic_limit: None, ..Sigma::leapfrog() };
    let mut run = Integrator::new(&vortices, method, H, start)?;
    let initial = run.energy();
    let mut series =
        Series { name: name.to_owned(), colour, rows: Vec::new(), lost: f64::INFINITY, end, failure: None };
    let mut interval = i64::MIN;
    let strides = (end / H) as u64 / STRIDE;
    let mut done = 0;
    // A run that is lost tells nothing more.
    while done < strides && series.lost.is_infinite() && !job.is_stopping() {
        if let Err(error) = run.take_steps(STRIDE) {
            (series.lost, series.failure) = (run.time(), Some(error));
            break;
        }
        done += 1;
        if done % 1000 == 0 {
            job.proceed(1000 * STRIDE);
        }
        let (t, error) = (run.time(), (run.energy() - initial).abs());
        let current = (t.log10() * PER_DECADE).floor() as i64;
        if current > interval {
            interval = current;
            series.rows.push([t, 0.0, 0.0]);
        }
        if let Some([_, largest_asymmetry, largest_error]) = series.rows.last_mut() {
            *largest_asymmetry = larger(*largest_asymmetry, asymmetry(run.q()));
            *largest_error = larger(*largest_error, error);
        }
        if error.is_nan() || error > LOST {
            series.lost = t;
        }
    }
    if done < strides && series.lost.is_infinite() {
        job.cut_short();
    }
    job.proceed((strides - done) * STRIDE);
    Ok(series)
}

/// The largest difference between a vortex and the mirror image of its partner.
fn asymmetry(q: &[f64]) -> f64 {
    let (x, y) = q.split_at(4);
    let pair = |i: usize, j: usize| larger((x[i] - x[j]).abs(), (y[i] + y[j]).abs());
    larger(pair(0, 2), pair(1, 3))
}

impl Series {
    /// The largest value of a column up to time `t`.
    fn largest(&self, column: usize, t: f64) -> f64 {
        self.rows.iter().filter(|row| row[0] <= t).map(|row| row[column]).fold(0.0, larger)
    }

    /// How the run ended, in words.
    fn ending(&self) -> String {
        let Self { name, lost, end, failure, .. } = self;
        match failure {
            Some(error) => format!("{name}: ended at t = {}, {error}.", scientific(*lost)),
            None if lost.is_finite() => format!("{name}: |ΔH| exceeds {LOST} at t = {}.", scientific(*lost)),
            None => format!("{name}: |ΔH| stays below {LOST} up to t = {}.", scientific(*end)),
        }
    }
}

fn claims(job: &Job<'_>, symmetric: &Series, displaced: &Series) -> Vec<Claim> {
    let lost = format!("time at which |ΔH| exceeds {LOST}");
    let longest = symmetric.end;
    let all_time = job.only_full(symmetric.lost);
    let growth = symmetric.largest(1, PAPER) / symmetric.largest(1, 0.1 * PAPER);
    vec![
        Claim::new("Fig. 2", "with VE2 the Hamiltonian remains close to its initial value for all time")
            .check(&lost, all_time, Bound::AtLeast(longest))
            .instead(
                "it does for the paper's time, carried by the mirror symmetry of its initial data; rounding breaks \
                 the symmetry, and later the motion breaks up",
            )
            .check(&lost, all_time, Bound::Within(PAPER, longest))
            .check("asymmetry up to t = 2·10⁵ / up to t = 2·10⁴", growth, Bound::AtLeast(10.0))
            .check(
                "asymmetry when it is lost",
                job.only_full(symmetric.largest(1, f64::INFINITY)),
                Bound::AtLeast(0.1),
            ),
        Claim::new(
            crate::claim::BEYOND,
            "with vortex 1 displaced by (0.05, 0.035) the motion is lost within the paper's time",
        )
        .check(format!("displaced: {lost}"), displaced.lost, Bound::AtMost(PAPER)),
    ]
}

fn figure(all: &[Series; 2]) -> Figure {
    let end = all[0].end;
    let panel = |title: &str, label: &str, column: usize| {
        let time = Axis::logarithmic("time *t*   [*L*²/Γ]").within(10.0, end);
        let range = if column == 1 { [1e-16, 1e4] } else { [1e-4, 0.2] };
        let value = Axis::logarithmic(label).within(range[0], range[1]);
        let panel = all.iter().fold(Panel::new(title, time, value), |panel, series| {
            let points = series.rows.iter().map(|row| [row[0], row[column]]).collect();
            panel.line(points, Stroke::solid(series.colour)).labelled(&series.name)
        });
        panel
            .line(vec![[PAPER, range[0]], [PAPER, range[1]]], Stroke::dashed(SLATE).width(1.2))
            .labelled("the paper's time")
            .legend_at(Corner::BottomRight)
    };
    let [symmetric, displaced] = all;
    Figure::new(
        "Two leapfrogging pairs with VE2, *h* = 2: mirror symmetry and energy over time",
        format!("{}; {}", short(symmetric, "symmetric"), short(displaced, "displaced")),
    )
    .row(
        450.0,
        vec![
            panel("Distance from mirror symmetry", "largest in each interval   [*L*]", 1),
            panel("Energy", "largest |*H* − *H*(0)| in each interval   [Γ²]", 2).without_legend(),
        ],
    )
    .footer(format!(
        "The run of Rowley & Marsden 2002, Fig. 2. A run is drawn until |Δ*H*| exceeds {LOST} or it ends by itself."
    ))
}

/// When a run was lost.
fn short(series: &Series, name: &str) -> String {
    let verb = if series.failure.is_some() { "ended by an error" } else { "lost" };
    if series.lost.is_finite() {
        format!("{name}: {verb} at *t* = {}", scientific(series.lost))
    } else {
        format!("{name}: not lost up to *t* = {}", scientific(series.rows.last().map_or(0.0, |row| row[0])))
    }
}

fn table(all: &[Series; 2]) -> Result<Table> {
    let mut table = Table::new(&["run", "t", "asymmetry", "energy_error"])?;
    for series in all {
        for row in &series.rows {
            table.row([series.name.clone()].into_iter().chain(row.map(number)))?;
        }
    }
    Ok(table)
}
