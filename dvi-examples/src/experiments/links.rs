//! A pendulum of 50 links, by constraints: each rod is an equation, and no angle occurs.
//!
//! Positions stay on the constraints and velocities along them to rounding, and the energy does not drift
//! (Wendlandt & Marsden 1997; Leimkuhler & Skeel 1994). RK4 on the equations of motion with the
//! accelerations at each state does neither. The potential is linear, so that RATTLE and the constrained
//! steps of the trapezoidal and of the midpoint rule are one method, which three codes compute.

use dvi_core::discrete::{Midpoint, Trapezoid, Unfitted};

use super::rk4::Accelerations;
use crate::models::{Links, LinksState};
use crate::vocabulary::*;

/// How many links there are.
const LINKS: usize = 50;
/// The angle of the last link at the start.
const ANGLE: f64 = 0.5;
const PENDULUM: Links = Links { n: LINKS };
const H: f64 = 0.01;
/// The end of the beginning, with which the whole is compared.
const EARLY: f64 = 5.0;
/// The length of the steps whose iterations are compared, and the numbers of links.
const COUNTED: f64 = 0.005;
const COUNTED_LINKS: [usize; 3] = [25, 50, 100];
/// The time at which the order is measured, the steps, and that of the reference.
const ORDER_TIME: f64 = 2.0;
const ORDER_STEPS: [f64; 4] = [0.02, 0.01, 0.005, 0.0025];
const FINE: f64 = 0.00125;

type Shape = Vec<[f64; 2]>;

/// E − E(0), the largest relative deviation of the length of a rod, and the largest difference of the
/// velocities of its ends along it; and the free end after each step.
type Motion = (Series<3>, Shape);

fn trapezoid() -> Constrained<Variational<Unfitted, Trapezoid>> {
    Constrained::new(Variational::trapezoid())
}

fn midpoint() -> Constrained<Variational<Unfitted, Midpoint>> {
    Constrained::new(Variational::midpoint())
}

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let end = job.choose(300.0, 6.0);
    job.expect(4 * (end / H).round() as u64);
    let solid = Stroke::solid;
    let all = [
        constrained(job, "constrained trapezoid", solid(GREEN).width(6.0), trapezoid(), end)?,
        constrained(job, "constrained midpoint", solid(PURPLE).width(3.5), midpoint(), end)?,
        constrained(job, "RATTLE", solid(BLUE).width(1.4), Rattle::default(), end)?,
        rk4(job, end)?,
    ];
    let series = || all.iter().map(|(series, _)| series);
    let table = magnitude_table(&["method", "t", "energy", "length", "velocity_along"], series())?;
    let panel = |labels, range, quantity| {
        over_time(labels, end, range, series(), quantity).legend_at(Corner::BottomRight)
    };
    let energy = panel(["Energy", "largest |*E* − *E*(0)|"], [1e-9, 1e-3], 0);
    let lengths = panel(["Lengths of the rods", "largest relative deviation"], [1e-16, 1.0], 1);
    let along = panel(["Velocities along the rods", "largest difference at the ends"], [1e-18, 1e-2], 2);
    let figure = Figure::new(
        format!("A pendulum of {LINKS} links, each rod a constraint"),
        format!(
            "Length, mass and *g* are 1. Released at rest with angles that grow from 0 to {ANGLE} along \
             the pendulum; *h* = {H}."
        ),
    )
    .row(390.0, vec![half_a_swing()?, energy])
    .row(330.0, vec![lengths.without_legend(), along.without_legend()])
    .footer(
        "RK4 solves the equations of motion with the accelerations at each state. The potential is linear: \
         the three other methods take the same steps.",
    );
    job.publish(figure, table)?;
    Ok(vec![
        constraints(job, &all),
        energies(job, &all),
        one_method(&all),
        order_of_positions()?,
        work(job)?,
    ]
    .into())
}

/// The deviations at a state.
fn deviations(energy: f64, LinksState { x, y, dot_x, dot_y }: &LinksState) -> [f64; 3] {
    let (mut before, mut length, mut along) = ([0.0; 4], 0.0, 0.0);
    for i in 0..LINKS {
        let here = [x[i], y[i], dot_x[i], dot_y[i]];
        let [x, y, dot_x, dot_y] = std::array::from_fn(|k| here[k] - before[k]);
        let found = f64::hypot(x, y);
        length = larger(length, (found / PENDULUM.rod() - 1.0).abs());
        along = larger(along, ((x * dot_x + y * dot_y) / found).abs());
        before = here;
    }
    [energy, length, along]
}

fn tip(LinksState { x, y, .. }: &LinksState) -> [f64; 2] {
    [x[LINKS - 1], y[LINKS - 1]]
}

fn constrained(
    job: &Job<'_>,
    name: &str,
    stroke: Stroke,
    method: impl Method<Links, f64>,
    end: f64,
) -> Result<Motion> {
    let mut run = Integrator::new(&PENDULUM, method, H, PENDULUM.bent(ANGLE))?;
    let (begin, mut tips) = (run.energy(), Shape::new());
    let kept =
        job.keep(&mut run, (end / H).round() as u64, Span { end, early: EARLY, intervals: 300 }, |run| {
            let state = run.state();
            tips.push(tip(&state));
            deviations(run.energy() - begin, &state)
        })?;
    Ok((Series::new(name, stroke, kept), tips))
}

fn rk4(job: &Job<'_>, end: f64) -> Result<Motion> {
    let mut run = Accelerations::new(&PENDULUM, H, &PENDULUM.bent(ANGLE))?;
    let (begin, mut kept) = (run.energy()?, Span { end, early: EARLY, intervals: 300 }.deviations());
    let (mut steps, mut lost) = (0, Ok(()));
    let mut step = || -> Result<(), StartError> {
        run.step()?;
        steps += 1;
        note(&mut kept, f64::from(steps) * H, deviations(run.energy()? - begin, &run.state()));
        Ok(())
    };
    job.repeat((end / H).round() as u64, || {
        if lost.is_ok() {
            lost = step();
        }
        Ok(())
    })?;
    lost?;
    Ok((Series::new("RK4", Stroke::solid(VERMILLION), kept), Shape::new()))
}

/// The largest of a number over the constrained methods.
fn of_constrained(all: &[Motion; 4], value: impl Fn(&[Deviation; 3]) -> f64) -> f64 {
    largest(all[..3].iter().map(|(series, _)| value(&series.kept)))
}

fn constraints(job: &Job<'_>, all: &[Motion; 4]) -> Claim {
    let [_, length, along] = &all[3].0.kept;
    let text = format!(
        "{LINKS} links, released at rest with angles up to {ANGLE}, h = {H}: constrained steps keep each \
         rod and the velocities along it to rounding, RK4 does not"
    );
    let [lengths, velocities] = [1, 2].map(|k| of_constrained(all, |kept| kept[k].largest));
    let deviation = "largest relative deviation of the length of a rod";
    beyond(text)
        .at_most(format!("constrained: {deviation}"), lengths, 2e-14)
        .at_most("constrained: largest velocity along a rod", velocities, 1e-15)
        .at_least(format!("RK4: {deviation}"), job.only_full(length.largest), 0.05)
        .at_least("RK4: the same, over that up to t = 5", job.only_full(length.growth()), 100.0)
        .at_least("RK4: largest velocity along a rod", along.largest, 5e-7)
}

fn energies(job: &Job<'_>, all: &[Motion; 4]) -> Claim {
    let [energy, ..] = &all[3].0.kept;
    let growth = format!("max|ΔE| over all / up to t = {EARLY}");
    beyond(
        "the energy error of constrained steps is as large in the beginning as in all of the run, that \
            of RK4 grows",
    )
    .at_most("constrained: max|ΔE|", of_constrained(all, |[energy, ..]| energy.largest), 1.5e-6)
    .at_most(format!("constrained: {growth}"), of_constrained(all, |[energy, ..]| energy.growth()), 1.05)
    .at_least("RK4: max|ΔE|", job.only_full(energy.largest), 5e-5)
    .at_least(format!("RK4: {growth}"), job.only_full(energy.growth()), 100.0)
}

fn one_method([trapezoid, midpoint, rattle, _]: &[Motion; 4]) -> Claim {
    let text = "the potential is linear, and so the constrained trapezoid, the constrained midpoint rule \
                and RATTLE take the same steps";
    beyond(text).each([("midpoint", midpoint), ("RATTLE", rattle)], |claim, (name, other)| {
        let quantity = format!("trapezoid and {name}: largest distance of the free ends");
        claim.at_most(quantity, farthest(&trapezoid.1, &other.1), 2e-12)
    })
}

/// Where the masses are.
fn shape(LinksState { x, y, .. }: &LinksState) -> Shape {
    x.iter().zip(y).map(|(&x, &y)| [x, y]).collect()
}

fn order_of_positions() -> Result<Claim> {
    let start = || PENDULUM.bent(ANGLE);
    let [fine, double] = each([FINE, 2.0 * FINE], |h| {
        Ok(shape(&Accelerations::new(&PENDULUM, h, &start())?.up_to(ORDER_TIME)?))
    })?;
    fn error(method: impl Method<Links, f64>, h: f64, expected: &[[f64; 2]]) -> Result<(f64, f64)> {
        let end = up_to(&PENDULUM, method, h, PENDULUM.bent(ANGLE), ORDER_TIME)?;
        Ok((h, farthest(&shape(&end), expected)))
    }
    let orders = [
        ("trapezoid", order_of(ORDER_STEPS, |h| error(trapezoid(), h, &fine))?),
        ("midpoint", order_of(ORDER_STEPS, |h| error(midpoint(), h, &fine))?),
        ("RATTLE", order_of(ORDER_STEPS, |h| error(Rattle::default(), h, &fine))?),
    ];
    Ok(beyond("the positions are of second order, against RK4 with half the shortest step")
        .at_most("largest distance of the masses of two references", farthest(&fine, &double), 3e-8)
        .each(orders, |claim, (name, order)| claim.of(name).near("order at t = 2", order, [2.0, 0.05])))
}

fn work(job: &Job<'_>) -> Result<Claim> {
    fn of(method: impl Method<Links, f64>, n: usize, steps: u64) -> Result<f64> {
        iterations(&Links { n }, method, COUNTED, Links { n }.bent(ANGLE), steps)
    }
    let steps = job.choose(1000, 10);
    let newton = [
        ("trapezoid", each(COUNTED_LINKS, |n| of(trapezoid(), n, steps))?),
        ("midpoint", each(COUNTED_LINKS, |n| of(midpoint(), n, steps))?),
    ];
    let [few, _, many] = each(COUNTED_LINKS, |n| of(Rattle::default(), n, steps))?;
    let text = format!(
        "in a step of length {COUNTED} Newton's method takes three iterations with 25, 50 and 100 links, \
         and RATTLE at most one more with 100 than with 25"
    );
    Ok(beyond(text)
        .each(newton, |claim, (name, all)| {
            claim.each(COUNTED_LINKS.into_iter().zip(all), |claim, (links, iterations)| {
                let quantity = format!("iterations of a step with {links} links");
                claim.of(name).near(quantity, job.only_full(iterations), [3.0, 0.15])
            })
        })
        .at_most("RATTLE: iterations of a step with 100 links", job.only_full(many), 4.0)
        .at_most("RATTLE: the same less those with 25", job.only_full(many - few), 1.1))
}

/// The pendulum at equal times over half a swing.
fn half_a_swing() -> Result<Panel> {
    let mut run = Integrator::new(&PENDULUM, trapezoid(), H, PENDULUM.bent(ANGLE))?;
    let axes = (Axis::linear("*x*"), Axis::linear("*y*").within(-1.02, 0.02));
    let mut panel = Panel::new("The pendulum over half a swing", axes.0, axes.1).equal();
    for (k, colour) in [0, 2, 3, 5, 6, 7].map(|i| SEQUENCE[i]).into_iter().enumerate() {
        if k > 0 {
            run.take_steps(50)?;
        }
        let masses = shape(&run.state());
        let line = std::iter::once([0.0; 2]).chain(masses.iter().copied()).collect();
        let drawn =
            panel.line(line, Stroke::solid(colour).width(1.2)).labelled(format!("*t* = {:.1}", run.time()));
        panel = drawn.dots(masses, 2.0, colour);
    }
    Ok(panel.legend_at(Corner::Beside))
}
