//! A pendulum of 50 links, by constraints: each rod is an equation, and no angle occurs.
//!
//! Positions stay on the constraints and velocities along them to rounding, and the energy does not drift
//! (Wendlandt & Marsden 1997; Leimkuhler & Skeel 1994). RK4 on the equations of motion with the
//! accelerations at each state does neither. The potential is linear, so that RATTLE and the constrained
//! steps of the trapezoidal and of the midpoint rule are one method.

use crate::vocabulary::*;

/// How many links there are, and the angle of the last one at the start.
const LINKS: usize = 50;
const ANGLE: f64 = 0.5;
const PENDULUM: Links = Links { n: LINKS };
const H: f64 = 0.01;
const COUNTED: [usize; 3] = [25, 50, 100];

/// E − E(0), the largest relative deviation of the length of a rod, and the largest difference of the
/// velocities of its ends along it; its path is that of the free end.
type Motion = Series<3>;

fn trapezoid() -> impl Method<Links, f64> + Copy {
    Constrained::new(Trapezoid)
}

fn midpoint() -> impl Method<Links, f64> + Copy {
    Constrained::new(Midpoint)
}

fn bent(links: &Links) -> Problem<'_, Links> {
    Problem::new(links, links.bent(ANGLE))
}

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let span = Span { end: job.choose(300.0, 6.0), early: 5.0, intervals: 300 };
    job.expect(4 * span.steps(H));
    let pendulum = bent(&PENDULUM);
    let constrained = [
        (("constrained trapezoid", solid(GREEN).width(6.0)), pendulum.any(trapezoid(), H)?),
        (("constrained midpoint", solid(PURPLE).width(3.5)), pendulum.any(midpoint(), H)?),
        (("RATTLE", solid(BLUE).width(1.4)), pendulum.any(Rattle::default(), H)?),
    ];
    let [trapezoid, midpoint, rattle] = each(constrained, |(named, mut run)| {
        let begin = run.energy();
        job.series(named, &mut run, span, |run, tips| {
            let state = run.state();
            tips.push(state.r[LINKS - 1]);
            deviations(run.energy() - begin, &state)
        })
        .whole()
    })?;
    let all = [trapezoid, midpoint, rattle, rk4(job, span)?];
    job.publish(figure(&all, span.end)?, magnitude_table("method,t,energy,length,velocity_along", &all))?;
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
    claims([
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
    ])
}

fn deviations(energy: f64, LinksState { r, dot_r }: &LinksState) -> [f64; 3] {
    let from_before = |of: &[[f64; 2]], i| if i == 0 { of[0] } else { difference(of[i], of[i - 1]) };
    let rods = (0..LINKS).map(|i| [r, dot_r].map(|of| from_before(of, i)));
    let [length, along] = stretched(PENDULUM.rod(), rods);
    [energy, length, along]
}

fn rk4(job: &Job<'_>, span: Span) -> Result<Motion> {
    let mut run = Accelerations::new(&PENDULUM, H, &PENDULUM.bent(ANGLE))?;
    let begin = run.energy()?;
    job.watch(("RK4", solid(VERMILLION)), span, (H, 1), || {
        run.step()?;
        Ok(deviations(run.energy()? - begin, &run.state()))
    })
}

fn order_of_positions() -> Result<Claim> {
    let by_rk4 = |h| Ok(Accelerations::new(&PENDULUM, h, &PENDULUM.bent(ANGLE))?.up_to(2.0)?.r);
    let [fine, double] = each([0.00125, 0.0025], by_rk4)?;
    let error = |q: &[f64]| farthest(&points(&q[..LINKS], &q[LINKS..]), &fine);
    let errors = bent(&PENDULUM).errors(2.0, &[100, 200, 400, 800], error);
    Ok(beyond("the positions are of second order, against RK4 with half the shortest step")
        .at_most("largest distance of the masses of two references", farthest(&fine, &double), 3e-8)
        .near("trapezoid: order at t = 2", errors.order(trapezoid())?, [2.0, 0.05])
        .near("midpoint: order at t = 2", errors.order(midpoint())?, [2.0, 0.05])
        .near("RATTLE: order at t = 2", errors.order(Rattle::default())?, [2.0, 0.05]))
}

fn work(job: &Job<'_>) -> Result<Claim> {
    let steps = job.choose(1000, 10);
    let of_newton = |n| -> Result<[f64; 2]> {
        let (links, h) = (Links { n }, 0.005);
        Ok([bent(&links).iterations(trapezoid(), h, steps)?, bent(&links).iterations(midpoint(), h, steps)?])
    };
    let newton = each(COUNTED, of_newton)?;
    let [few, many] =
        each([COUNTED[0], COUNTED[2]], |n| bent(&Links { n }).iterations(Rattle::default(), 0.005, steps))?;
    let text = "in a step of length 0.005 Newton's method takes three iterations with 25, 50 and 100 links, \
                and RATTLE at most one more with 100 than with 25";
    Ok(beyond(text)
        .each([("trapezoid", 0), ("midpoint", 1)], |claim, (name, rule): (_, usize)| {
            claim.of(name).each(COUNTED.into_iter().zip(&newton), |claim, (links, iterations)| {
                let quantity = format!("iterations of a step with {links} links");
                claim.near(quantity, job.only_full(iterations[rule]), [3.0, 0.15])
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
    let axes = (Axis::linear("*x*"), Axis::linear("*y*").within([-1.02, 0.02]));
    let shapes = shapes(bent(&PENDULUM).run(trapezoid(), H)?, 250.0, |state| state.r)?;
    let half_a_swing = Panel::new("The pendulum over half a swing", axes.0, axes.1).equal();
    let half_a_swing = half_a_swing.each(shapes, |panel, (t, colour, line)| {
        let masses = line[1..].to_vec();
        let rods = panel.line(line, solid(colour).width(1.2)).labelled(format!("*t* = {t:.1}"));
        rods.dots(masses, 2.0, colour)
    });
    let subtitle = format!(
        "Released at rest with angles that grow from 0 to {ANGLE} along the pendulum; *h* = {H}. The three \
         constrained methods take the same steps."
    );
    let figure = Figure::of(subtitle).row(390.0, vec![half_a_swing.legend_at(Corner::Beside), energy]);
    Ok(figure.row(330.0, vec![lengths.without_legend(), along.without_legend()]))
}
