//! Orders of convergence over σ, on z' = iz and on four vortices (Rowley & Marsden 2002, section 4.1).
//!
//! Each run starts from two points of the exact orbit, so that the starting step does not show.

use crate::claim::larger;
use anyhow::{Context as _, Result};
use dvi_core::prelude::*;

use crate::claim::{BEYOND, Bound, Claim};
use crate::figure::{
    Anchor, Axis, BLUE, Colour, Corner, Figure, Fill, GREEN, INK, Panel, SLATE, Stroke, VERMILLION,
};
use crate::gallery::{Experiment, Outcome};
use crate::job::Job;
use crate::models::{self, Case, Rotation, RotationState};
use crate::output::{Table, number};

pub const EXPERIMENT: Experiment = Experiment {
    name: "order",
    title: "Orders of convergence over σ, linear and vortices",
    share: 1.0,
    run,
};

const ROOT_3: f64 = 1.732_050_807_568_877_2;
/// (3 − √3)/6, of fourth order on linear equations, and its mirror image.
const SPECIAL: f64 = (3.0 - ROOT_3) / 6.0;
const MIRRORED: f64 = (3.0 + ROOT_3) / 6.0;
/// (3 − √3)/2, what the paper prints at the end of section 4.1.
const PRINTED: f64 = (3.0 - ROOT_3) / 2.0;
const SIGMAS: [f64; 13] = [0.0, 0.1, SPECIAL, 0.3, 0.4, 0.5, 0.6, PRINTED, 0.7, MIRRORED, 0.85, 0.9, 1.0];
/// Those whose errors are drawn.
const DRAWN: [(f64, &str, Colour); 4] = [
    (0.0, "σ = 0", BLUE),
    (SPECIAL, "σ = (3 − √3)/6", INK),
    (0.5, "σ = ½", VERMILLION),
    (PRINTED, "σ = (3 − √3)/2", GREEN),
];

/// Errors on one problem, as (h, error), and the order that they show.
struct Convergence {
    errors: Vec<(f64, f64)>,
    order: f64,
}

struct Row {
    sigma: f64,
    linear: Convergence,
    vortices: Convergence,
}

fn run(job: &Job<'_>) -> Result<Outcome> {
    let steps = |coarsest: f64| (0..6).map(move |k| coarsest / f64::from(1 << k));
    let count = |time: f64, coarsest| steps(coarsest).map(|h| (time / h) as u64).sum::<u64>();
    job.expect(4000 + SIGMAS.len() as u64 * (count(10.0, 0.2) + count(Vortices::END, 0.05)));
    let problem = Vortices::new(job)?;
    let row = |sigma: f64| {
        let linear = steps(0.2).map(|h| Ok((h, linear_error(job, sigma, h)?))).collect::<Result<_>>()?;
        let vortices = steps(0.05).map(|h| Ok((h, problem.error(job, sigma, h)?))).collect::<Result<_>>()?;
        Ok(Row { sigma, linear: Convergence::of(linear), vortices: Convergence::of(vortices) })
    };
    let rows = SIGMAS.into_iter().map(row).collect::<Result<Vec<_>>>()?;
    job.publish(EXPERIMENT.name, figure(&rows), table(&rows)?)?;
    let orders = |row: &Row| {
        let Row { sigma, linear, vortices } = row;
        format!("σ = {sigma:.4}: order {:.3} linear, {:.3} vortices.", linear.order, vortices.order)
    };
    Ok(Outcome { claims: claims(&rows), references: vec![], notes: rows.iter().map(orders).collect() })
}

impl Convergence {
    /// With the order of the finer half of the steps; NaN if there is none.
    fn of(errors: Vec<(f64, f64)>) -> Self {
        let order = convergence_order(&errors[errors.len() / 2..]).unwrap_or(f64::NAN);
        Self { errors, order }
    }
}

/// |z − e^{it}| at t = 10.
fn linear_error(job: &Job<'_>, sigma: f64, h: f64) -> Result<f64> {
    let rotation = Rotation { omega: 1.0 };
    let exact = |t: f64| RotationState { x: t.cos(), y: t.sin() };
    let mut run = Integrator::from_two_points(&rotation, Sigma::new(sigma), h, exact(0.0), exact(h))?;
    let steps = (10.0 / h).round() as u64;
    job.repeat(steps, || run.advance())?;
    let (end, state) = (exact(run.time()), run.state());
    Ok((state.x - end.x).hypot(state.y - end.y))
}

/// The four vortices of Fig. 5 up to t = 4, with an accurate end.
struct Vortices {
    case: Case,
    end: Vec<f64>,
}

impl Vortices {
    const END: f64 = 4.0;

    fn new(job: &Job<'_>) -> Result<Self> {
        let case = models::chaotic();
        let mut exact = Integrator::new(&case.vortices, Gauss::<3>::new(), 1e-3, case.start)?;
        job.repeat(4000, || exact.advance())?;
        let end = exact.q().to_vec();
        Ok(Self { case, end })
    }

    /// The largest error of a coordinate at the end.
    fn error(&self, job: &Job<'_>, sigma: f64, h: f64) -> Result<f64> {
        let Case { vortices, start } = &self.case;
        let mut exact = Integrator::new(vortices, Gauss::<3>::new(), h / 4.0, *start)?;
        let second = exact.nth(3).context("a run does not end by itself")??;
        let mut run = Integrator::from_two_points(vortices, Sigma::new(sigma), h, *start, second)?;
        let steps = (Self::END / h).round() as u64;
        job.repeat(steps, || run.advance())?;
        Ok(run.q().iter().zip(&self.end).fold(0.0, |largest, (q, exact)| larger((q - exact).abs(), largest)))
    }
}

fn claims(rows: &[Row]) -> Vec<Claim> {
    let at = |sigma: f64| rows.iter().find(|row| row.sigma == sigma);
    let linear = |sigma: f64| at(sigma).map(|row| row.linear.order);
    let vortices = |sigma: f64| at(sigma).map(|row| row.vortices.order);
    let farthest_from_two = |exceptions: &[f64], order: fn(&Row) -> f64| {
        let others = rows.iter().filter(|row| !exceptions.contains(&row.sigma));
        others.map(|row| (order(row) - 2.0).abs()).fold(0.0, larger)
    };
    let by_linear = |exceptions: &[f64]| farthest_from_two(exceptions, |row| row.linear.order);
    let by_vortices = farthest_from_two(&[], |row| row.vortices.order);
    let (second, fourth) = (Bound::Near(2.0, 0.02), Bound::Near(4.0, 0.02));
    vec![
        Claim::new("section 4.1", "second order for every σ except (3 − √3)/6")
            .check("largest |order − 2| of the others, linear", by_linear(&[SPECIAL]), Bound::AtMost(0.02))
            .instead("on linear equations (3 + √3)/6 is an exception too; on vortices there is none")
            .check("order on z' = iz, σ = (3 + √3)/6", linear(MIRRORED), fourth)
            .check(
                "largest |order − 2| of the rest, linear",
                by_linear(&[SPECIAL, MIRRORED]),
                Bound::AtMost(0.02),
            )
            .check("largest |order − 2| of all σ, vortices", by_vortices, Bound::AtMost(0.02)),
        Claim::new("section 4.1, on x' = λx", "σ = (3 − √3)/6 is fourth-order accurate").check(
            "order on z' = iz",
            linear(SPECIAL),
            fourth,
        ),
        Claim::new(BEYOND, "the fourth order is for linear equations only")
            .check("order on vortices, σ = (3 − √3)/6", vortices(SPECIAL), second)
            .check("order on vortices, σ = (3 + √3)/6", vortices(MIRRORED), second),
        Claim::new("section 4.1", "the scheme with σ = (3 − √3)/2 is the most accurate")
            .check("order on z' = iz, σ = (3 − √3)/2", linear(PRINTED), fourth)
            .instead("a misprint of (3 − √3)/6")
            .check("order on z' = iz, σ = (3 − √3)/2", linear(PRINTED), second)
            .check("order on z' = iz, σ = (3 − √3)/6", linear(SPECIAL), fourth),
    ]
}

fn figure(rows: &[Row]) -> Figure {
    let linear = error_panel("Linear: *z*' = i*z*, *t* = 10", rows, |row| &row.linear);
    let linear = slope(slope(linear, 2, [0.0125, 3e-3]), 4, [0.025, 2e-9]).without_legend();
    let vortices = divided_panel("Four vortices, *t* = 4", rows).legend_at(Corner::Beside).weight(1.35);
    let orders = |of: fn(&Row) -> f64| rows.iter().map(|row| [row.sigma, of(row)]).collect::<Vec<_>>();
    let order = Axis::linear("fitted order").within(1.0, 5.0);
    let over_sigma = Panel::new("Order over σ", Axis::linear("σ").within(-0.05, 1.05), order)
        .discs(orders(|row| row.linear.order), SLATE, Fill::Solid)
        .labelled("linear")
        .dots(orders(|row| row.vortices.order), 2.2, VERMILLION)
        .labelled("four vortices")
        .note([SPECIAL, 4.15], Anchor::Middle, SLATE, "(3 − √3)/6")
        .note([MIRRORED, 4.15], Anchor::Middle, SLATE, "(3 + √3)/6")
        .note([PRINTED, 2.15], Anchor::Middle, SLATE, "(3 − √3)/2");
    Figure::new(
        "Orders of convergence of the σ-family, on a linear equation and on four vortices",
        format!(
            "From two exact starting values; orders fitted over 13 values of σ: linear {}, vortices {}",
            range(rows, |row| row.linear.order),
            range(rows, |row| row.vortices.order)
        ),
    )
    .row(430.0, vec![linear, vortices, over_sigma])
    .footer("Rowley & Marsden 2002, section 4.1.")
}

/// The smallest and the largest of the orders, in words.
fn range(rows: &[Row], order: fn(&Row) -> f64) -> String {
    let orders = rows.iter().map(order);
    let [low, high] = orders.fold([f64::INFINITY, 0.0f64], |[low, high], x| [low.min(x), larger(high, x)]);
    format!("{low:.3} to {high:.3}")
}

/// Error/h², which second order makes flat: the curves of the errors themselves lie on each other.
fn divided_panel(title: &str, rows: &[Row]) -> Panel {
    let ratio = Axis::linear("error at the end / *h*²");
    let empty = Panel::new(title, Axis::logarithmic("step *h*").within(1e-3, 0.1), ratio);
    DRAWN.into_iter().fold(empty, |panel, (sigma, name, colour)| {
        let row = rows.iter().filter(|row| row.sigma == sigma);
        let errors = row.flat_map(|row| &row.vortices.errors);
        let points: Vec<_> = errors.map(|&(h, error)| [h, error / (h * h)]).collect();
        panel.line(points.clone(), Stroke::solid(colour)).labelled(name).discs(points, colour, Fill::Hollow)
    })
}

fn error_panel(title: &str, rows: &[Row], problem: fn(&Row) -> &Convergence) -> Panel {
    let empty = Panel::new(title, Axis::logarithmic("step *h*"), Axis::logarithmic("error at the end"));
    DRAWN.into_iter().fold(empty, |panel, (sigma, name, colour)| {
        let row = rows.iter().filter(|row| row.sigma == sigma);
        let points: Vec<_> =
            row.flat_map(|row| &problem(row).errors).map(|&(h, error)| [h, error]).collect();
        panel.line(points.clone(), Stroke::solid(colour)).discs(points, colour, Fill::Hollow).labelled(name)
    })
}

/// A guide to the eye, of the slope that an order has.
fn slope(panel: Panel, order: i32, [h, error]: [f64; 2]) -> Panel {
    let end = [h * 5.0, error * 5f64.powi(order)];
    let line = panel.line(vec![[h, error], end], Stroke::dashed(SLATE));
    line.note([h * 1.15, error * 0.9], Anchor::Start, SLATE, format!("slope {order}"))
}

fn table(rows: &[Row]) -> Result<Table> {
    let mut table = Table::new(&["problem", "sigma", "h", "error", "fitted_order"])?;
    for Row { sigma, linear, vortices } in rows {
        for (problem, Convergence { errors, order }) in [("linear", linear), ("vortices", vortices)] {
            for (h, error) in errors {
                let numbers = [*sigma, *h, *error, *order].map(number);
                table.row([problem.to_owned()].into_iter().chain(numbers))?;
            }
        }
    }
    Ok(table)
}
