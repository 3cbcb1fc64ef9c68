//! A pendulum of 50 links, by constraints: each rod is an equation, and no angle occurs.
//!
//! Positions stay on the constraints and velocities along them to rounding, and the energy does not drift
//! (Wendlandt & Marsden 1997; Leimkuhler & Skeel 1994). RK4 on the equations of motion with the
//! accelerations at each state does neither. The potential is linear, so that RATTLE and the constrained
//! steps of the trapezoidal and of the midpoint rule are one method, which three codes compute.

use super::rk4::Accelerations;
use crate::vocabulary::*;

/// How many links there are, and the angle of the last one at the start.
const LINKS: usize = 50;
const ANGLE: f64 = 0.5;
const PENDULUM: Links = Links { n: LINKS };
const H: f64 = 0.01;
/// The numbers of links that iterations are counted with.
const COUNTED: [usize; 3] = [25, 50, 100];

/// E − E(0), the largest relative deviation of the length of a rod, and the largest difference of the
/// velocities of its ends along it; its path is that of the free end.
type Motion = Series<3>;

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let end = job.choose(300.0, 6.0);
    job.expect(4 * (end / H).round() as u64);
    let (trapezoid, midpoint) =
        (Constrained::new(Variational::trapezoid()), Constrained::new(Variational::midpoint()));
    let solid = Stroke::solid;
    let all = [
        constrained(job, ("constrained trapezoid", solid(GREEN).width(6.0)), trapezoid, end)?,
        constrained(job, ("constrained midpoint", solid(PURPLE).width(3.5)), midpoint, end)?,
        constrained(job, ("RATTLE", solid(BLUE).width(1.4)), Rattle::default(), end)?,
        rk4(job, end)?,
    ];
    let table = magnitude_table(&["method", "t", "energy", "length", "velocity_along"], &all)?;
    job.publish(figure(&all, end)?, table)?;
    let [energy, length, along] = &all[3].kept;
    let of_constrained = |k: usize| largest(all[..3].iter().map(|series| series.kept[k].largest));
    let growth = largest(all[..3].iter().map(|series| series.kept[0].growth()));
    let deviation = "largest relative deviation of the length of a rod";
    let kept = "50 links, released at rest with angles up to 0.5, h = 0.01: constrained steps keep each rod \
                and the velocities along it to rounding, RK4 does not";
    let energies = "the energy error of constrained steps is as large in the beginning as in all of the \
                    run, that of RK4 grows";
    let one = "the potential is linear, and so the constrained trapezoid, the constrained midpoint rule and \
               RATTLE take the same steps";
    Ok(vec![
        beyond(kept)
            .at_most(format!("constrained: {deviation}"), of_constrained(1), 2e-14)
            .at_most("constrained: largest velocity along a rod", of_constrained(2), 1e-15)
            .at_least(format!("RK4: {deviation}"), job.only_full(length.largest), 0.05)
            .at_least("RK4: the same, over that up to t = 5", job.only_full(length.growth()), 100.0)
            .at_least("RK4: largest velocity along a rod", along.largest, 5e-7),
        beyond(energies)
            .at_most("constrained: max|ΔE|", of_constrained(0), 1.5e-6)
            .at_most("constrained: max|ΔE| over all / up to t = 5", growth, 1.05)
            .at_least("RK4: max|ΔE|", job.only_full(energy.largest), 5e-5)
            .at_least("RK4: max|ΔE| over all / up to t = 5", job.only_full(energy.growth()), 100.0),
        beyond(one).each([("midpoint", &all[1]), ("RATTLE", &all[2])], |claim, (name, other)| {
            let quantity = format!("trapezoid and {name}: largest distance of the free ends");
            claim.at_most(quantity, farthest(&all[0].path, &other.path), 2e-12)
        }),
        order_of_positions()?,
        work(job)?,
    ]
    .into())
}

/// The deviations at a state.
fn deviations(energy: f64, LinksState { x, y, dot_x, dot_y }: &LinksState) -> [f64; 3] {
    let ends = (0..LINKS).map(|i| [x[i], y[i], dot_x[i], dot_y[i]]);
    let before = [[0.0; 4]].into_iter().chain(ends.clone());
    let [length, along] =
        stretched(PENDULUM.rod(), ends.zip(before).map(|(end, before)| difference(end, before)));
    [energy, length, along]
}

fn constrained(
    job: &Job<'_>,
    named: Named<'_>,
    method: impl Method<Links, f64>,
    end: f64,
) -> Result<Motion> {
    let mut run = Integrator::new(&PENDULUM, method, H, PENDULUM.bent(ANGLE))?;
    let (begin, span) = (run.energy(), Span { end, early: 5.0, intervals: 300 });
    Ok(job.series(named, &mut run, (end / H).round() as u64, span, |run, tips| {
        let state = run.state();
        tips.push([state.x[LINKS - 1], state.y[LINKS - 1]]);
        deviations(run.energy() - begin, &state)
    })?)
}

fn rk4(job: &Job<'_>, end: f64) -> Result<Motion> {
    let mut run = Accelerations::new(&PENDULUM, H, &PENDULUM.bent(ANGLE))?;
    let (begin, mut kept) = (run.energy()?, Span { end, early: 5.0, intervals: 300 }.deviations());
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
    Ok(Series::new("RK4", Stroke::solid(VERMILLION), kept))
}

/// Where the masses are.
fn shape(LinksState { x, y, .. }: LinksState) -> Vec<[f64; 2]> {
    points(&x, &y)
}

fn order_of_positions() -> Result<Claim> {
    let [fine, double] = each([0.00125, 0.0025], |h| {
        Ok(shape(Accelerations::new(&PENDULUM, h, &PENDULUM.bent(ANGLE))?.up_to(2.0)?))
    })?;
    let error = |q: &[f64]| farthest(&points(&q[..LINKS], &q[LINKS..]), &fine);
    let (start, counts) = (PENDULUM.bent(ANGLE), [100, 200, 400, 800]);
    let trapezoid = Constrained::new(Variational::trapezoid());
    let trapezoid = order_at(&PENDULUM, trapezoid, &start, 2.0, counts, error)?;
    let midpoint = Constrained::new(Variational::midpoint());
    let midpoint = order_at(&PENDULUM, midpoint, &start, 2.0, counts, error)?;
    let rattle = order_at(&PENDULUM, Rattle::default(), &start, 2.0, counts, error)?;
    Ok(beyond("the positions are of second order, against RK4 with half the shortest step")
        .at_most("largest distance of the masses of two references", farthest(&fine, &double), 3e-8)
        .near("trapezoid: order at t = 2", trapezoid, [2.0, 0.05])
        .near("midpoint: order at t = 2", midpoint, [2.0, 0.05])
        .near("RATTLE: order at t = 2", rattle, [2.0, 0.05]))
}

fn work(job: &Job<'_>) -> Result<Claim> {
    let steps = job.choose(1000, 10);
    fn of(method: impl Method<Links, f64> + Clone, steps: u64) -> Result<[f64; 3]> {
        each(COUNTED, |n| iterations(&Links { n }, method.clone(), 0.005, Links { n }.bent(ANGLE), steps))
    }
    let newton = [
        ("trapezoid", of(Constrained::new(Variational::trapezoid()), steps)?),
        ("midpoint", of(Constrained::new(Variational::midpoint()), steps)?),
    ];
    let [few, _, many] = of(Rattle::default(), steps)?;
    let text = "in a step of length 0.005 Newton's method takes three iterations with 25, 50 and 100 links, \
                and RATTLE at most one more with 100 than with 25";
    Ok(beyond(text)
        .each(newton, |claim, (name, all)| {
            claim.of(name).each(COUNTED.into_iter().zip(all), |claim, (links, iterations)| {
                let quantity = format!("iterations of a step with {links} links");
                claim.near(quantity, job.only_full(iterations), [3.0, 0.15])
            })
        })
        .at_most("RATTLE: iterations of a step with 100 links", job.only_full(many), 4.0)
        .at_most("RATTLE: the same less those with 25", job.only_full(many - few), 1.1))
}

fn figure(all: &[Motion; 4], end: f64) -> Result<Figure> {
    let panel = |labels, range, quantity| {
        over_time(labels, end, range, all, quantity).legend_at(Corner::BottomRight)
    };
    let energy = panel(["Energy", "largest |*E* − *E*(0)|"], [1e-9, 1e-3], 0);
    let lengths = panel(["Lengths of the rods", "largest relative deviation"], [1e-16, 1.0], 1);
    let along = panel(["Velocities along the rods", "largest difference at the ends"], [1e-18, 1e-2], 2);
    let run =
        Integrator::new(&PENDULUM, Constrained::new(Variational::trapezoid()), H, PENDULUM.bent(ANGLE))?;
    let axes = (Axis::linear("*x*"), Axis::linear("*y*").within(-1.02, 0.02));
    let half_a_swing = Panel::new("The pendulum over half a swing", axes.0, axes.1).equal().each(
        shapes(run, 250.0, shape)?,
        |panel, (t, colour, line)| {
            let masses = line[1..].to_vec();
            let rods = panel.line(line, Stroke::solid(colour).width(1.2)).labelled(format!("*t* = {t:.1}"));
            rods.dots(masses, 2.0, colour)
        },
    );
    let subtitle = format!(
        "Released at rest with angles that grow from 0 to {ANGLE} along the pendulum; *h* = {H}. The three \
         constrained methods take the same steps."
    );
    let figure = Figure::of(subtitle).row(390.0, vec![half_a_swing.legend_at(Corner::Beside), energy]);
    Ok(figure.row(330.0, vec![lengths.without_legend(), along.without_legend()]))
}
