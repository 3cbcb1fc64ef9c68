//! A guiding centre in a field from a table, beside the same field from formulas.
//!
//! The functions of the field are splines through their values on a grid. Their first derivatives, which the
//! motion depends on, are of the order 3 in the distances of the grid for cubic splines, and of the order 5
//! for quintic ones.

use dvi_core::ProperlyDegenerate;
use dvi_core::field::{ScalarField, Spline};

use crate::models::{TabulatedTokamak, TabulatedTokamakState, TokamakInClass, TokamakInClassState};
use crate::vocabulary::*;

const Q: f64 = 2.0;
const MU: f64 = 6e-5;
const VELOCITY: f64 = 4e-3;
/// The bananas that are compared begin at these distances from the magnetic axis: how large the error of a
/// spline is along an orbit depends on where that lies between the points of the grid.
const RADII: [f64; 12] = [0.19, 0.195, 0.198, 0.202, 0.206, 0.209, 0.214, 0.218, 0.221, 0.225, 0.231, 0.235];
/// The one whose energy is watched.
const RADIUS: f64 = 0.2;
const H: f64 = 60.0;
/// Steps of the orbit that is compared: two bounces of the banana.
const COMPARED: u64 = 200;
/// Steps of the beginning, with which the energy of the whole is compared.
const EARLY: u64 = 2000;
/// The intervals of the grid across the section.
const GRIDS: [usize; 14] = [8, 9, 11, 13, 15, 18, 21, 25, 29, 34, 40, 47, 55, 64];
/// Of the table in the long run.
const COARSE: usize = 12;

/// One kind of spline on all grids.
struct Differences {
    name: &'static str,
    /// The intervals across the section, and the root mean square of how far the orbits are at most from
    /// those of the formulas.
    of_grids: Vec<(f64, f64)>,
    /// By which power of their number it falls.
    order: f64,
}

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let steps = job.choose(1_000_000, 10_000);
    job.expect(steps);
    let exact = TokamakInClass { q: Q, mu: MU };
    let orbits =
        each(RADII, |r| path(&exact, TokamakInClassState { r, theta: 0.0, phi: 0.0, u: VELOCITY }))?;
    let by_cubic =
        |n| TabulatedTokamak::sampled(Q, MU, n, |axes, function| Ok(Spline::sample(axes, function)?));
    let by_quintic = |n| {
        TabulatedTokamak::sampled(Q, MU, n, |axes, function| Ok(Spline::sample_quintic(axes, function)?))
    };
    let (cubic, quintic) = (
        differences("cubic splines", &orbits, by_cubic)?,
        differences("quintic splines", &orbits, by_quintic)?,
    );
    // The relative energy error in the coarse table.
    let coarse = by_cubic(COARSE)?;
    let mut run = Integrator::new(&coarse, OneStep::midpoint(), H, start(RADIUS))?;
    let begin = run.energy();
    let span = Span { end: steps as f64 * H, early: EARLY as f64 * H, intervals: 400 };
    let [energy] = job.keep(&mut run, steps, span, |run| [(run.energy() - begin) / begin])?;
    let rows = [&cubic, &quintic].into_iter().flat_map(|Differences { name, of_grids, .. }| {
        of_grids.iter().map(move |&(n, apart)| ([*name], [n, apart]))
    });
    let table = Table::of(&["spline", "intervals", "difference"], rows)?;
    job.publish(figure(&cubic, &quintic, &energy, span.end), table)?;
    let quantity = format!("cubic, {COARSE} intervals: max|ΔH| over all / over {EARLY} steps");
    Ok(vec![
        beyond("orbits in a table tend to those of the formulas as the splines do")
            .near("order in the distances of the grid, cubic", cubic.order, [3.0, 0.3])
            .near("order in the distances of the grid, quintic", quintic.order, [5.0, 0.3]),
        beyond("the energy of a table is kept as that of a formula is").at_most(
            quantity,
            energy.growth(),
            1.02,
        ),
    ]
    .into())
}

/// r and u, which go to and fro, along the orbit.
fn path<S: ProperlyDegenerate>(system: &S, start: S::State<f64>) -> Result<Vec<[f64; 2]>> {
    let mut run = Integrator::new(system, OneStep::midpoint(), H, start)?;
    let path = course(&mut run, COMPARED, |run| [run.q()[0], run.q()[3]])?;
    Ok(path.into_iter().skip(1).collect())
}

fn start(r: f64) -> TabulatedTokamakState {
    TabulatedTokamakState { r, theta: 0.0, phi: 0.0, u: VELOCITY }
}

/// How far two orbits are apart at most, in units of the width of the banana and of the velocity at the
/// start.
fn difference(path: &[[f64; 2]], orbit: &[[f64; 2]]) -> f64 {
    let radii = || orbit.iter().map(|[r, _]| *r);
    let width = radii().fold(f64::MIN, f64::max) - radii().fold(f64::MAX, f64::min);
    largest(path.iter().zip(orbit).map(|(found, expected)| {
        larger((found[0] - expected[0]).abs() / width, (found[1] - expected[1]).abs() / VELOCITY)
    }))
}

fn differences<F: ScalarField<2>>(
    name: &'static str,
    orbits: &[Vec<[f64; 2]>],
    sampled: impl Fn(usize) -> Result<TabulatedTokamak<F>>,
) -> Result<Differences> {
    let of_grid = |n| {
        let system = sampled(n)?;
        let mut squares = 0.0;
        for (orbit, r) in orbits.iter().zip(RADII) {
            squares += difference(&path(&system, start(r))?, orbit).powi(2);
        }
        Ok((n as f64, (squares / RADII.len() as f64).sqrt()))
    };
    let of_grids = GRIDS.into_iter().map(of_grid).collect::<Result<Vec<_>>>()?;
    let falls = order(of_grids.iter().copied()).context("differences that fall")?;
    Ok(Differences { name, of_grids, order: -falls })
}

fn figure(cubic: &Differences, quintic: &Differences, energy: &Deviation, end: f64) -> Figure {
    let points = |of: &Differences| of.of_grids.iter().map(|&(n, apart)| [n, apart]).collect::<Vec<_>>();
    // A straight line of this slope through the last point.
    let slope = |of: &Differences, order: i32| {
        let ends = [0, GRIDS.len() - 1].map(|grid| of.of_grids[grid].0);
        let (n, apart) = of.of_grids[GRIDS.len() - 1];
        ends.map(|at| [at, apart * (n / at).powi(order)]).to_vec()
    };
    let n = Axis::logarithmic("intervals of the grid across the section").within(6.0, 80.0);
    let apart = Axis::logarithmic("difference, relative").within(1e-13, 1e-2);
    let falls = Panel::new("Distance from the orbits in the field of formulas", n, apart)
        .line(slope(cubic, 3), Stroke::dashed(BLUE).width(1.0))
        .line(slope(quintic, 5), Stroke::dashed(VERMILLION).width(1.0))
        .dots(points(cubic), 4.0, BLUE)
        .labelled(format!("cubic: order {:.1}", cubic.order))
        .dots(points(quintic), 4.0, VERMILLION)
        .labelled(format!("quintic: order {:.1}", quintic.order));
    let title = format!("Relative error of the energy, cubic splines of {COARSE} intervals");
    let axis = Axis::logarithmic("largest |Δ*H*/*H*| of each interval").within(1e-7, 1e-3);
    let error =
        Panel::new(title, Axis::time(end), axis).line(energy.envelope.magnitude(), Stroke::solid(GREEN));
    let (first, last) = (1.0 + RADII[0], 1.0 + RADII[RADII.len() - 1]);
    Figure::new(
        "A guiding centre in a field from a table",
        format!(
            "*q* = {Q}, *μ* = {MU}, bananas from *R* = {first:.2} to {last:.3}, *h* = {H}, one-step midpoint"
        ),
    )
    .row(430.0, vec![falls, error.weight(1.35)])
    .footer(format!(
        "Dashed: orders 3 and 5 of the first derivatives. Largest |Δ*H*/*H*|: {}.",
        at_most(energy.largest)
    ))
}
