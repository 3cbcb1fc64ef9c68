//! A guiding centre in a field from a table, beside the same field from formulas.
//!
//! The functions of the field are splines through their values on a grid. Their first derivatives, which the
//! motion depends on, are of the order 3 in the distances of the grid for cubic splines, and of the order 5
//! for quintic ones.

use crate::vocabulary::*;

const Q: f64 = 2.0;
const MU: f64 = 6e-5;
const VELOCITY: f64 = 4e-3;
/// The distances from the magnetic axis at which bananas begin that are compared: the error of a spline
/// along an orbit depends on where that lies between the points of the grid.
const RADII: [f64; 12] = [0.19, 0.195, 0.198, 0.202, 0.206, 0.209, 0.214, 0.218, 0.221, 0.225, 0.231, 0.235];
const H: f64 = 60.0;
/// Steps of the orbit that is compared: two bounces of the banana.
const COMPARED: u64 = 200;
const EARLY: u64 = 2000;
const GRIDS: [usize; 14] = [8, 9, 11, 13, 15, 18, 21, 25, 29, 34, 40, 47, 55, 64];
const COARSE: usize = 12;

/// The intervals across the section with the root mean square of how far the orbits are at most from those
/// of the formulas, and the power of their number by which that falls.
type Differences = (Points, f64);

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let steps = job.choose(1_000_000, 10_000);
    let exact = TokamakInClass { q: Q, mu: MU };
    let paths = each(RADII, |r| path(&exact, TokamakInClassState { r, theta: 0.0, phi: 0.0, u: VELOCITY }))?;
    let by_cubic = |n| TabulatedTokamak::sampled(Q, MU, n, |axes, of| Ok(Spline::sample(axes, of)?));
    let by_quintic = |n| TabulatedTokamak::sampled(Q, MU, n, |axes, f| Ok(Spline::sample_quintic(axes, f)?));
    let (cubic, quintic) = (differences(&paths, by_cubic)?, differences(&paths, by_quintic)?);
    // The relative energy error in the coarse table.
    let coarse = by_cubic(COARSE)?;
    let mut run = Problem::new(&coarse, start(0.2)).run(OneStep::midpoint(), H)?;
    let (begin, span) = (run.energy(), Span::of(steps, H, EARLY));
    let named = ("cubic splines", solid(GREEN));
    let series = job.series(named, &mut run, span, |run, _| [(run.energy() - begin) / begin]).whole()?;
    let both = [("cubic splines", &cubic.0), ("quintic splines", &quintic.0)];
    let curves = both.map(|(name, of_grids)| ([name], [], of_grids.iter().copied()));
    let table = curve_table("spline,intervals,difference", curves);
    job.publish(figure(&cubic, &quintic, &series, span.end), table)?;
    let quantity = format!("cubic, {COARSE} intervals: max|ΔH| over all / over {EARLY} steps");
    let kept = "the energy of a table is kept as that of a formula is";
    claims([
        beyond("orbits in a table tend to those of the formulas as the splines do")
            .near("order in the distances of the grid, cubic", cubic.1, [3.0, 0.3])
            .near("order in the distances of the grid, quintic", quintic.1, [5.0, 0.3]),
        beyond(kept).at_most(quantity, series.kept[0].growth(), 1.02),
    ])
}

/// r and u, which go to and fro, along the orbit.
fn path<S: ProperlyDegenerate>(system: &S, start: S::State<f64>) -> Result<Points> {
    let mut run = Problem::new(system, start).run(OneStep::midpoint(), H)?;
    Ok(course(&mut run, COMPARED, |run| [run.q()[0], run.q()[3]])?.into_iter().skip(1).collect())
}

fn start(r: f64) -> TabulatedTokamakState {
    TabulatedTokamakState { r, theta: 0.0, phi: 0.0, u: VELOCITY }
}

/// How far two orbits are apart, in units of the width of the banana and of the velocity at the start.
fn difference(path: &[[f64; 2]], orbit: &[[f64; 2]]) -> f64 {
    let radii = || orbit.iter().map(|[r, _]| *r);
    let width = largest(radii()) - least(radii());
    largest(path.iter().zip(orbit).map(|(found, expected)| {
        larger((found[0] - expected[0]).abs() / width, (found[1] - expected[1]).abs() / VELOCITY)
    }))
}

fn differences<F: ScalarField<2>>(
    orbits: &[Points],
    sampled: impl Fn(usize) -> Result<TabulatedTokamak<F>>,
) -> Result<Differences> {
    let of_grids = each(GRIDS, |n| {
        let system = sampled(n)?;
        let paths = each(RADII, |r| path(&system, start(r)))?;
        let squares = paths.iter().zip(orbits).map(|(path, orbit)| difference(path, orbit).powi(2));
        Ok([n as f64, mean(squares).sqrt()])
    })?;
    let falls = order(of_grids.iter().map(|&[n, apart]| (n, apart))).context("differences that fall")?;
    Ok((of_grids.into(), -falls))
}

fn figure(cubic: &Differences, quintic: &Differences, energy: &Series<1>, end: f64) -> Figure {
    let slope = |(of_grids, _): &Differences, order: i32| {
        let [n, apart] = of_grids[GRIDS.len() - 1];
        [of_grids[0][0], n].map(|at| [at, apart * (n / at).powi(order)]).to_vec()
    };
    let n = ("intervals of the grid across the section", [6.0, 80.0]);
    let title = "Distance from the orbits in the field of formulas";
    let falls = Panel::loglog(title, n, ("difference, relative", [1e-13, 1e-2]))
        .line(slope(cubic, 3), dashed(BLUE).width(1.0))
        .line(slope(quintic, 5), dashed(VERMILLION).width(1.0))
        .dots(cubic.0.clone(), 4.0, BLUE)
        .labelled(format!("cubic: order {:.1}", cubic.1))
        .dots(quintic.0.clone(), 4.0, VERMILLION)
        .labelled(format!("quintic: order {:.1}", quintic.1));
    let title = format!("Relative error of the energy, cubic splines of {COARSE} intervals");
    let axis = ("largest |Δ*H*/*H*| of each interval", [1e-7, 1e-3]);
    let error = Panel::semilog(title, ("time *t*", [0.0, end]), axis)
        .line(energy.kept[0].magnitude(), energy.stroke);
    Figure::of(format!(
        "*q* = {Q}, *μ* = {MU}, bananas from *R* = 1.19 to 1.235, *h* = {H}, one-step midpoint"
    ))
    .row(430.0, vec![falls, error.weight(1.35)])
    .footer("Dashed: orders 3 and 5 of the first derivatives.")
}
