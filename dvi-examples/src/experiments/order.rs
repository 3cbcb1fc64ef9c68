//! Orders of convergence over σ, on z' = iz and on four vortices (Rowley & Marsden 2002, section 4.1).
//!
//! Each run starts from two points of the exact orbit, so that the starting step does not show.

use crate::models::{self, Case, Rotation, RotationState};
use crate::vocabulary::*;

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
/// When the runs with vortices end.
const END: f64 = 4.0;

/// What is measured with one σ: the linear equation, and the vortices.
struct Row {
    sigma: f64,
    /// (h, error)
    errors: [Vec<(f64, f64)>; 2],
    /// By the finer half of the steps; NaN if there is none.
    orders: [f64; 2],
}

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let steps = |coarsest: f64| (0..6).map(move |k| coarsest / f64::from(1 << k));
    let count = |time: f64, coarsest| steps(coarsest).map(|h| (time / h) as u64).sum::<u64>();
    job.expect(4000 + SIGMAS.len() as u64 * (count(10.0, 0.2) + count(END, 0.05)));
    let case = models::chaotic();
    let mut exact = Integrator::new(&case.vortices, Gauss::<3>::new(), 1e-3, case.start)?;
    job.repeat(4000, || exact.advance())?;
    let rows = each(SIGMAS, |sigma| {
        let linear =
            steps(0.2).map(|h| Ok((h, linear_error(job, sigma, h)?))).collect::<Result<Vec<_>>>()?;
        let vortices = steps(0.05).map(|h| Ok((h, vortex_error(job, &case, exact.q(), sigma, h)?)));
        let errors = [linear, vortices.collect::<Result<_>>()?];
        let orders = errors.each_ref().map(|all| order(all[3..].iter().copied()).unwrap_or(f64::NAN));
        Ok(Row { sigma, errors, orders })
    })?;
    let table = rows.iter().flat_map(|Row { sigma, errors, orders }| {
        ["linear", "vortices"].into_iter().zip(errors).zip(orders).flat_map(
            move |((problem, errors), order)| {
                errors.iter().map(move |(h, error)| ([problem], [*sigma, *h, *error, *order]))
            },
        )
    });
    job.publish(figure(&rows), Table::of(&["problem", "sigma", "h", "error", "fitted_order"], table)?)?;
    let notes = rows.iter().map(|Row { sigma, orders: [linear, vortices], .. }| {
        format!("σ = {sigma:.4}: order {linear:.3} linear, {vortices:.3} vortices.")
    });
    Ok(Outcome { claims: claims(&rows), references: vec![], notes: notes.collect() })
}

/// |z − e^{it}| at t = 10.
fn linear_error(job: &Job<'_>, sigma: f64, h: f64) -> Result<f64> {
    let exact = |t: f64| RotationState { x: t.cos(), y: t.sin() };
    let rotation = Rotation { omega: 1.0 };
    let mut run = Integrator::from_two_points(&rotation, Sigma::new(sigma), h, exact(0.0), exact(h))?;
    job.repeat((10.0 / h).round() as u64, || run.advance())?;
    let (end, state) = (exact(run.time()), run.state());
    Ok((state.x - end.x).hypot(state.y - end.y))
}

/// The largest error of a coordinate of the four vortices of Fig. 5 at the end.
fn vortex_error(job: &Job<'_>, case: &Case, end: &[f64], sigma: f64, h: f64) -> Result<f64> {
    let Case { vortices, start } = case;
    let mut exact = Integrator::new(vortices, Gauss::<3>::new(), h / 4.0, *start)?;
    let second = exact.nth(3).context("a run does not end by itself")??;
    let mut run = Integrator::from_two_points(vortices, Sigma::new(sigma), h, *start, second)?;
    job.repeat((END / h).round() as u64, || run.advance())?;
    Ok(apart(run.q(), end))
}

fn claims(rows: &[Row]) -> Vec<Claim> {
    let at = |sigma: f64, problem: usize| {
        rows.iter().find(|row| row.sigma == sigma).map(|row| row.orders[problem])
    };
    let (linear, vortices) = (|sigma| at(sigma, 0), |sigma| at(sigma, 1));
    let farthest_from_two = |problem: usize, exceptions: &[f64]| {
        let others = rows.iter().filter(|row| !exceptions.contains(&row.sigma));
        largest(others.map(|row| (row.orders[problem] - 2.0).abs()))
    };
    let (second, fourth) = ([2.0, 0.02], [4.0, 0.02]);
    vec![
        Claim::new("section 4.1", "second order for every σ except (3 − √3)/6")
            .at_most("largest |order − 2| of the others, linear", farthest_from_two(0, &[SPECIAL]), 0.02)
            .instead("on linear equations (3 + √3)/6 is an exception too; on vortices there is none")
            .near("order on z' = iz, σ = (3 + √3)/6", linear(MIRRORED), fourth)
            .at_most(
                "largest |order − 2| of the rest, linear",
                farthest_from_two(0, &[SPECIAL, MIRRORED]),
                0.02,
            )
            .at_most("largest |order − 2| of all σ, vortices", farthest_from_two(1, &[]), 0.02),
        Claim::new("section 4.1, on x' = λx", "σ = (3 − √3)/6 is fourth-order accurate").near(
            "order on z' = iz",
            linear(SPECIAL),
            fourth,
        ),
        beyond("the fourth order is for linear equations only")
            .near("order on vortices, σ = (3 − √3)/6", vortices(SPECIAL), second)
            .near("order on vortices, σ = (3 + √3)/6", vortices(MIRRORED), second),
        Claim::new("section 4.1", "the scheme with σ = (3 − √3)/2 is the most accurate")
            .near("order on z' = iz, σ = (3 − √3)/2", linear(PRINTED), fourth)
            .instead("a misprint of (3 − √3)/6")
            .near("order on z' = iz, σ = (3 − √3)/2", linear(PRINTED), second)
            .near("order on z' = iz, σ = (3 − √3)/6", linear(SPECIAL), fourth),
    ]
}

fn figure(rows: &[Row]) -> Figure {
    let errors = |panel: Panel, problem: usize, value: fn(f64, f64) -> f64| {
        panel.each(DRAWN, |panel, (sigma, name, colour)| {
            let row = rows.iter().filter(|row| row.sigma == sigma);
            let points = row.flat_map(|row| &row.errors[problem]).map(|&(h, error)| [h, value(h, error)]);
            let points: Vec<_> = points.collect();
            panel.line(points.clone(), Stroke::solid(colour)).labelled(name).discs(
                points,
                colour,
                Fill::Hollow,
            )
        })
    };
    let slope = |panel: Panel, order: i32, [h, error]: [f64; 2]| {
        let end = [h * 5.0, error * 5f64.powi(order)];
        let line = panel.line(vec![[h, error], end], Stroke::dashed(SLATE));
        line.note([h * 1.15, error * 0.9], Anchor::Start, SLATE, format!("slope {order}"))
    };
    let error = Axis::logarithmic("error at the end");
    let linear = Panel::new("Linear: *z*' = i*z*, *t* = 10", Axis::logarithmic("step *h*"), error);
    let linear = slope(slope(errors(linear, 0, |_, error| error), 2, [0.0125, 3e-3]), 4, [0.025, 2e-9]);
    // Error/h², which second order makes flat: the curves of the errors themselves lie on each other.
    let (h, ratio) =
        (Axis::logarithmic("step *h*").within(1e-3, 0.1), Axis::linear("error at the end / *h*²"));
    let vortices = errors(Panel::new("Four vortices, *t* = 4", h, ratio), 1, |h, error| error / (h * h));
    let orders =
        |problem: usize| rows.iter().map(|row| [row.sigma, row.orders[problem]]).collect::<Vec<_>>();
    let order = Axis::linear("fitted order").within(1.0, 5.0);
    let over_sigma = Panel::new("Order over σ", Axis::linear("σ").within(-0.05, 1.05), order)
        .discs(orders(0), SLATE, Fill::Solid)
        .labelled("linear")
        .dots(orders(1), 2.2, VERMILLION)
        .labelled("four vortices")
        .note([SPECIAL, 4.15], Anchor::Middle, SLATE, "(3 − √3)/6")
        .note([MIRRORED, 4.15], Anchor::Middle, SLATE, "(3 + √3)/6")
        .note([PRINTED, 2.15], Anchor::Middle, SLATE, "(3 − √3)/2");
    let [linear_range, vortex_range] = [0, 1].map(|problem| {
        let low = orders(problem).iter().map(|point| point[1]).fold(f64::INFINITY, f64::min);
        format!("{low:.3} to {:.3}", largest(orders(problem).iter().map(|point| point[1])))
    });
    Figure::new(
        "Orders of convergence of the σ-family, on a linear equation and on four vortices",
        format!(
            "From two exact starting values; orders fitted over 13 values of σ: linear {linear_range}, \
             vortices {vortex_range}"
        ),
    )
    .row(430.0, vec![linear.without_legend(), vortices.legend_at(Corner::Beside).weight(1.35), over_sigma])
    .footer("Rowley & Marsden 2002, section 4.1.")
}
