//! A spherical pendulum by unit vectors, along great circles, and the same by a constraint.
//!
//! Its height goes up and down between the roots of a cubic polynomial, while it goes around the vertical.
//! Steps along great circles stay on the sphere without a projection (Lee, Leok & McClamroch 2009); RATTLE
//! takes the chord in place of the arc and finds the force that keeps the length.

use super::geodesics::*;
use super::turnings::*;
use crate::vocabulary::*;

const PENDULUM: SphericalPendulum = SphericalPendulum { gravity: 1.0 };
const CONSTRAINED: ConstrainedPendulum = ConstrainedPendulum { gravity: 1.0 };
/// The step of the long runs, and so many steps from one look at the integrals to the next.
const H: f64 = 0.05;
const EVERY: u64 = 4;
/// The steps with which turnings and both methods are compared, the longest first.
const STEPS: [f64; 3] = [0.1, 0.05, 0.025];
/// The time at which the order is measured, and the step of the reference.
const ORDER_TIME: f64 = 8.0;
const FINE: f64 = 2e-3;
const DRAWN: f64 = 37.0;

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let long = Long { job, steps: job.choose(10_000_000, 8_000), every: EVERY, h: H };
    job.expect(3 * long.steps / EVERY);
    let before = PENDULUM.heights(&begin());
    // E − E(0), |s|² − 1, and the relative change of the angular momentum about the vertical.
    let kept = |state: &SphericalPendulumState| {
        let now = PENDULUM.heights(state);
        [now.energy - before.energy, dot(state.s, state.s) - 1.0, now.vertical / before.vertical - 1.0]
    };
    let (arcs, chords) = (arcs(), chords());
    let mut run = chords.run(Rattle::default(), H)?;
    let later = || {
        run.take_steps(EVERY)?;
        Ok(run.state().into())
    };
    let [rk4, great_circles] = long.both("great circles", PENDULUM, &begin(), kept)?;
    let all = [rk4, long.watch(("RATTLE", solid(GREEN)), later, kept)?, great_circles];
    let columns = "method,t,largest_energy_error,largest_change_of_length,largest_change_of_momentum";
    job.publish(figure(&all, long)?, magnitude_table(columns, &all))?;
    let end = job.choose(400.0, 25.0);
    let by_arcs = each(STEPS, |h| {
        let run = arcs.run(Geodesic::trapezoid(), h)?;
        up_and_down(run, end, &before, |run| sample(run, PENDULUM.shift(&run.state())))
    })?;
    let by_chords = each(STEPS, |h| {
        let run = chords.run(Rattle::default(), h)?;
        up_and_down(run, end, &before, |run| sample(run, CONSTRAINED.shift(&run.state().into())))
    })?;
    let [rk4, chords, arcs] = all.each_ref().map(|series| &series.kept);
    // The largest that h²g makes of it, by the runs with the same step.
    let [by_arc, by_chord] = [&by_arcs, &by_chords].map(|runs| runs[1].1.predicted);
    let flat =
        beyond("the energy errors of a spherical pendulum have no trend, by great circles and by RATTLE");
    let flat = long.flat_energy(flat, "great circles", &arcs[0], by_arc);
    claims([
        turning_claim("a spherical pendulum", by_arcs.each_ref().map(|(extremes, _)| extremes)),
        rounding(long, arcs, chords),
        long.flat_energy(flat, "RATTLE", &chords[0], by_chord),
        shadow_claim("great circles", &by_arcs.map(|(_, energy)| energy)),
        shadow_claim("RATTLE", &by_chords.map(|(_, energy)| energy)),
        loses(job, rk4, arcs),
        order_of_places()?,
    ])
}

fn sample(run: &impl Run<Scalar = f64>, shift: f64) -> Sample {
    Sample { height: run.q()[2], rate: run.v()[2], energy: run.energy(), shift }
}

/// The motion by unit vectors, and by a constraint.
fn arcs() -> Problem<'static, SphericalPendulum> {
    Problem::new(&PENDULUM, begin())
}

fn chords() -> Problem<'static, ConstrainedPendulum> {
    let SphericalPendulumState { s, dot_s } = begin();
    Problem::new(&CONSTRAINED, ConstrainedPendulumState { s, dot_s })
}

/// At an angle from the direction downwards, with its rate and the rate around the vertical.
fn begin() -> SphericalPendulumState {
    SphericalPendulum::hanging(0.8, [0.3, 0.35])
}

fn rounding(long: Long<'_>, arcs: &[Envelope; 3], chords: &[Envelope; 3]) -> Claim {
    let text = "unit vectors have the length one to a few units of rounding for the whole run; the \
                momentum about the vertical is kept up to errors no larger than a unit of rounding times \
                the square root of the number of steps, and by RATTLE up to what the errors of the length \
                add up to over the steps";
    let momentum = "largest relative change of the momentum about the vertical";
    let (steps, bound) = (long.steps as f64, long.random_walk());
    beyond(text)
        .at_least("steps", long.job.only_full(steps), 1e7)
        .at_most("great circles: largest ||s|² − 1|", arcs[1].largest, FEW_UNITS)
        .at_most("RATTLE: largest ||s|² − 1|", chords[1].largest, bound)
        .at_most(format!("great circles: {momentum}"), arcs[2].largest, bound)
        .at_most(format!("RATTLE: {momentum}"), chords[2].largest, steps * chords[1].largest)
}

fn loses(job: &Job<'_>, [energy, length, vertical]: &[Envelope; 3], arcs: &[Envelope; 3]) -> Claim {
    let text =
        "RK4 on s and its rate leaves the sphere, and loses energy and momentum in proportion to the time";
    let over = |kept: usize, factor: f64| factor * arcs[kept].largest;
    let (momentum, trend) = (job.only_full(vertical.largest), "last tenth of the time over the first");
    beyond(text)
        .at_least("RK4: largest ||s|² − 1|", job.only_full(length.largest), over(1, 1e6))
        .at_least("RK4: largest relative change of the momentum", momentum, over(2, 1e3))
        .near(format!("RK4: change of the momentum, {trend}"), job.only_full(vertical.trend()), [10.0, 1.0])
        .at_least("RK4: max|ΔE|", job.only_full(energy.largest), over(0, 10.0))
        .near(format!("RK4: max|ΔE|, {trend}"), job.only_full(energy.trend()), [10.0, 1.0])
}

fn order_of_places() -> Result<Claim> {
    let text = "the place of a spherical pendulum is of second order by great circles and by RATTLE, which \
                differ by a term of the order h², and of fourth by Suzuki's composition";
    let [fine, double] = [FINE, 2.0 * FINE].map(|h| {
        let [x, y, z, ..] = rk4_to(PENDULUM.entries(&begin()), ORDER_TIME, h, |y| PENDULUM.motion(y));
        [x, y, z]
    });
    let (arcs, chords, simple) = (arcs(), chords(), Geodesic::trapezoid());
    let arc = |h| Ok(arcs.up_to(simple, h, ORDER_TIME)?.s);
    let composed = |h| Ok(arcs.up_to(Composition::suzuki(simple), h, ORDER_TIME)?.s);
    let chord = |h| Ok(chords.up_to(Rattle::default(), h, ORDER_TIME)?.s);
    let order = |place: &dyn Fn(f64) -> Result<[f64; 3]>, from: &dyn Fn(f64) -> Result<[f64; 3]>| {
        order_of(STEPS, |h| Ok((h, length(difference(place(h)?, from(h)?)))))
    };
    let exact = |_| Ok(fine);
    let at_end = format!("order at t = {ORDER_TIME}");
    Ok(beyond(text)
        .at_most("distance of two references", length(difference(fine, double)), 1e-9)
        .near(format!("great circles: {at_end}"), order(&arc, &exact)?, [2.0, 0.05])
        .near(format!("Suzuki's composition: {at_end}"), order(&composed, &exact)?, [4.0, 0.1])
        .near(format!("RATTLE: {at_end}"), order(&chord, &exact)?, [2.0, 0.05])
        .near("order of the distance of great circles and RATTLE", order(&arc, &chord)?, [2.0, 0.05]))
}

fn figure(all: &[Series<3>; 3], long: Long<'_>) -> Result<Figure> {
    let path = course(&mut arcs().run(Geodesic::trapezoid(), H)?, (DRAWN / H) as u64, place)?;
    let path = Panel::plane("The path", "*x*", "*y*").line(path, solid(BLUE).width(1.2));
    let path = between_heights(path, &PENDULUM.heights(&begin()));
    let energy = [(0, ["Energy", "largest |*E* − *E*(0)|"], [1e-11, 10.0])];
    let others = [
        (1, ["Length", "||*s*|² − 1|"], [1e-17, 10.0]),
        (2, ["Momentum about the vertical", "largest relative change"], [1e-17, 10.0]),
    ];
    let energy = long.panels(all, &energy).into_iter().map(|panel| panel.weight(1.4));
    let subtitle = format!(
        "The path is from above, up to *t* = {DRAWN}; the roots of the cubic are the circles. *h* = {H}"
    );
    Ok(Figure::of(subtitle)
        .row(400.0, [path].into_iter().chain(energy).collect())
        .row(300.0, long.panels(all, &others)))
}
