//! Orders of convergence over σ, on z' = iz and on four vortices (Rowley & Marsden 2002, section 4.1).
//!
//! Each run starts from two points of the exact orbit, so that the starting step does not show.

use crate::vocabulary::*;

const ROOT_3: f64 = 1.732_050_807_568_877_2;
/// (3 − √3)/6, of fourth order on linear equations, and its mirror image.
const SPECIAL: f64 = (3.0 - ROOT_3) / 6.0;
const MIRRORED: f64 = (3.0 + ROOT_3) / 6.0;
/// (3 − √3)/2, what the paper prints at the end of section 4.1.
const PRINTED: f64 = (3.0 - ROOT_3) / 2.0;
const SIGMAS: [f64; 13] = [0.0, 0.1, SPECIAL, 0.3, 0.4, 0.5, 0.6, PRINTED, 0.7, MIRRORED, 0.85, 0.9, 1.0];
const DRAWN: [(f64, &str, Colour); 4] = [
    (0.0, "σ = 0", BLUE),
    (SPECIAL, "σ = (3 − √3)/6", INK),
    (0.5, "σ = ½", VERMILLION),
    (PRINTED, "σ = (3 − √3)/2", GREEN),
];
const END: f64 = 4.0;

/// σ, (h, error) on the linear equation and on the vortices, and the orders by the finer half of the steps.
type Row = (f64, [Vec<(f64, f64)>; 2], [f64; 2]);

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let case = models::chaotic();
    let end = Problem::new(&case.vortices, case.start).up_to(Gauss::<3>::new(), 1e-3, END)?;
    let steps = |coarsest: f64| (0..6).map(move |k| coarsest / f64::from(1 << k));
    let rows = each(SIGMAS, |sigma| -> Result<Row> {
        let linear = steps(0.2).map(|h| Ok((h, linear_error(sigma, h)?))).collect::<Result<_>>()?;
        let vortices = steps(0.05).map(|h| Ok((h, vortex_error(&case, &end, sigma, h)?)));
        let errors: [Vec<_>; 2] = [linear, vortices.collect::<Result<_>>()?];
        let orders = errors.each_ref().map(|all| order(all[3..].iter().copied()).unwrap_or(f64::NAN));
        Ok((sigma, errors, orders))
    })?;
    let curves = rows.iter().flat_map(|(sigma, errors, orders)| {
        ["linear", "vortices"].into_iter().zip(errors).zip(orders).map(move |((problem, errors), order)| {
            ([problem], [*sigma], errors.iter().map(move |(h, error)| [*h, *error, *order]))
        })
    });
    job.publish(figure(&rows), curve_table("problem,sigma,h,error,fitted_order", curves))?;
    let notes = rows.iter().map(|(sigma, _, [linear, vortices])| {
        format!("σ = {sigma:.4}: order {linear:.3} linear, {vortices:.3} vortices.")
    });
    let at = |problem: usize, at| rows.iter().find(|(sigma, ..)| *sigma == at).map(|row| row.2[problem]);
    let (linear, vortices) = (|sigma| at(0, sigma), |sigma| at(1, sigma));
    let from_two = |problem: usize, exceptions: &[f64]| {
        let others = rows.iter().filter(|(sigma, ..)| !exceptions.contains(sigma));
        largest(others.map(|(.., orders)| (orders[problem] - 2.0).abs()))
    };
    let (second, fourth) = ([2.0, 0.02], [4.0, 0.02]);
    let special = "σ = (3 − √3)/6 is fourth-order accurate";
    let claims = vec![
        says("section 4.1", "second order for every σ except (3 − √3)/6")
            .at_most("largest |order − 2| of the others, linear", from_two(0, &[SPECIAL]), 0.02)
            .instead("on linear equations (3 + √3)/6 is an exception too; on vortices there is none")
            .near("order on z' = iz, σ = (3 + √3)/6", linear(MIRRORED), fourth)
            .at_most("largest |order − 2| of the rest, linear", from_two(0, &[SPECIAL, MIRRORED]), 0.02)
            .at_most("largest |order − 2| of all σ, vortices", from_two(1, &[]), 0.02),
        says("section 4.1, on x' = λx", special).near("order on z' = iz", linear(SPECIAL), fourth),
        beyond("the fourth order is for linear equations only")
            .near("order on vortices, σ = (3 − √3)/6", vortices(SPECIAL), second)
            .near("order on vortices, σ = (3 + √3)/6", vortices(MIRRORED), second),
        says("section 4.1", "the scheme with σ = (3 − √3)/2 is the most accurate")
            .near("order on z' = iz, σ = (3 − √3)/2", linear(PRINTED), fourth)
            .instead("a misprint of (3 − √3)/6")
            .near("order on z' = iz, σ = (3 − √3)/2", linear(PRINTED), second)
            .near("order on z' = iz, σ = (3 − √3)/6", linear(SPECIAL), fourth),
    ];
    Ok(Outcome { claims, references: vec![], notes: notes.collect() })
}

/// |z − e^{it}| at t = 10.
fn linear_error(sigma: f64, h: f64) -> Result<f64> {
    let exact = |t: f64| RotationState { x: t.cos(), y: t.sin() };
    let rotation = Rotation { omega: 1.0 };
    let mut run = Integrator::from_two_points(&rotation, Sigma::new(sigma), h, exact(0.0), exact(h))?;
    run.take_steps((10.0 / h).round() as u64)?;
    let end = exact(run.time());
    Ok(distance(place(&run), [end.x, end.y]))
}

/// The largest error of a coordinate of the four vortices of Fig. 5 at the end.
fn vortex_error(Case { vortices, start }: &Case, end: &FourPoints, sigma: f64, h: f64) -> Result<f64> {
    let second = Problem::new(vortices, *start).up_to(Gauss::<3>::new(), h / 4.0, h)?;
    let mut run = Integrator::from_two_points(vortices, Sigma::new(sigma), h, *start, second)?;
    run.take_steps((END / h).round() as u64)?;
    Ok(apart(run.q(), end.x.iter().chain(&end.y)))
}

fn figure(rows: &[Row]) -> Figure {
    let errors = |problem: usize, value: fn(f64, f64) -> f64| {
        DRAWN.map(|(sigma, name, colour)| {
            let row = rows.iter().filter(|row| row.0 == sigma);
            let points = row.flat_map(|row| &row.1[problem]).map(|&(h, error)| [h, value(h, error)]);
            (name, solid(colour), points.collect())
        })
    };
    let slope = |panel: Panel, order: i32, [h, error]: [f64; 2]| {
        let line = panel.line(vec![[h, error], [h * 5.0, error * 5f64.powi(order)]], dashed(SLATE));
        line.note([h * 1.15, error * 0.9], Anchor::Start, SLATE, format!("slope {order}"))
    };
    let (h, error) = (Axis::logarithmic("step *h*"), Axis::logarithmic("error at the end"));
    let linear = Panel::new("Linear: *z*' = i*z*, *t* = 10", h, error).marked(errors(0, |_, error| error));
    let linear = slope(slope(linear, 2, [0.0125, 3e-3]), 4, [0.025, 2e-9]);
    // Error/h², which second order makes flat: the curves of the errors themselves lie on each other.
    let (h, y) =
        (Axis::logarithmic("step *h*").within([1e-3, 0.1]), Axis::linear("error at the end / *h*²"));
    let vortices = Panel::new("Four vortices, *t* = 4", h, y).marked(errors(1, |h, error| error / (h * h)));
    let orders = |problem| rows.iter().map(|row| [row.0, row.2[problem]]).collect::<Vec<_>>();
    let over_sigma = Panel::linear("Order over σ", ("σ", [-0.05, 1.05]), ("fitted order", [1.0, 5.0]))
        .discs(orders(0), SLATE)
        .labelled("linear")
        .dots(orders(1), 2.2, VERMILLION)
        .labelled("four vortices")
        .note([SPECIAL, 4.15], Anchor::Middle, SLATE, "(3 − √3)/6")
        .note([MIRRORED, 4.15], Anchor::Middle, SLATE, "(3 + √3)/6")
        .note([PRINTED, 2.15], Anchor::Middle, SLATE, "(3 − √3)/2");
    let vortices = vortices.legend_at(Corner::Beside).weight(1.35);
    Figure::of("From two exact starting values; orders fitted to the three shortest steps")
        .row(430.0, vec![linear.without_legend(), vortices, over_sigma])
        .footer("Rowley & Marsden 2002, section 4.1.")
}
