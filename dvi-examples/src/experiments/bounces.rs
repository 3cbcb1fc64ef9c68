//! A particle that bounces on a curved floor: what its energy does over 10⁵ bounces.
//!
//! A step in which the particle reaches the floor is divided there. At the impact either the discrete energy
//! is kept, which makes the steps symplectic (Fetecau, Marsden, Ortiz & West 2003), or the energy at the
//! point of impact. The discrete energies of two flights of different lengths differ by terms of the order
//! h² from the same energy, so the first changes it at each bounce, by amounts that add up as in a random
//! walk.

use dvi_core::discrete::{Trapezoid, Unfitted};

use super::rk4::rk4;
use crate::models::{Bouncer, BouncerState};
use crate::vocabulary::*;

const FLOOR: Bouncer = Bouncer { a: 0.8 };
const START: BouncerState = BouncerState { x: 0.3, y: 1.8, dot_x: 0.4, dot_y: 0.0 };
/// The lengths of the steps of long runs.
const STEPS: [f64; 2] = [0.02, 0.01];
/// RK4 takes four forces a step.
const RK4_STEP: f64 = 4.0 * STEPS[0];
/// Up to here the particle comes down some hundred times.
const EARLY: f64 = 200.0;
/// The time at which the order is measured, the numbers of steps, and that of the reference.
const ORDER_TIME: f64 = 6.0;
const ORDER_STEPS: [u64; 4] = [150, 300, 600, 1200];
const FINE: u64 = 4000;
/// So many step lengths near each of them: where in a step the impacts are changes the error.
const NEARBY: u64 = 6;
/// Numbers of bounces, each twice the one before, after which the change of the energy is looked at.
const DOUBLINGS: u32 = 9;
const FIRST: u64 = 8;

/// A long run, with what is kept at impacts.
struct Bounces {
    name: &'static str,
    h: f64,
    stroke: Stroke,
    /// E − E(0).
    energy: Deviation,
    bounces: u64,
    /// Bounces at which no impulse keeps the discrete energy.
    grazing: u64,
}

/// The number of bounces, and the root mean square of E − E(0) there.
type Walk = Vec<[f64; 2]>;

fn trapezoid(collision: Collision) -> Impacts<Variational<Unfitted, Trapezoid>> {
    Impacts { collision, ..Impacts::new(Variational::trapezoid()) }
}

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let end = job.choose(200_000.0, 1000.0);
    job.expect(STEPS.iter().map(|h| 2 * (end / h) as u64).sum::<u64>() + (end / RK4_STEP) as u64);
    let ([coarse, fine], [discrete, at_impact]) = (STEPS, [Collision::Variational, Collision::Reflection]);
    let all = [
        Bounces::rk4(job, end)?,
        Bounces::new(job, discrete, coarse, Stroke::solid(BLUE), end)?,
        Bounces::new(job, discrete, fine, Stroke::dashed(SKY), end)?,
        Bounces::new(job, at_impact, coarse, Stroke::solid(GREEN), end)?,
        Bounces::new(job, at_impact, fine, Stroke::dashed(GREEN), end)?,
    ];
    let walks = each([(discrete, coarse), (discrete, fine), (at_impact, coarse)], |(collision, h)| {
        walk(job, collision, h)
    })?;
    let rows = all.iter().flat_map(|Bounces { name, h, energy, .. }| {
        energy.envelope.magnitude().into_iter().map(move |[t, error]| ([*name], [*h, t, error]))
    });
    let table = Table::of(&["kept", "h", "t", "largest_energy_error"], rows)?;
    job.publish(figure(&all, &walks, end)?, table)?;
    Ok(vec![
        flat(job, &all),
        walks_at_random(job, &all, &walks),
        loses(job, &all[0]),
        order_of_states()?,
        back()?,
    ]
    .into())
}

impl Bounces {
    fn empty(name: &'static str, h: f64, stroke: Stroke, end: f64) -> Self {
        Self {
            name,
            h,
            stroke: stroke.width(1.2),
            energy: Deviation::new(end, 300, EARLY),
            bounces: 0,
            grazing: 0,
        }
    }

    fn new(job: &Job<'_>, collision: Collision, h: f64, stroke: Stroke, end: f64) -> Result<Self> {
        let name = match collision {
            Collision::Variational => "discrete energy",
            Collision::Reflection => "energy at the impact",
        };
        let mut found = Self::empty(name, h, stroke, end);
        let mut run = Integrator::new(&FLOOR, trapezoid(collision), h, START)?;
        let begin = run.energy();
        job.follow(&mut run, (end / h) as u64, |run| found.energy.push(run.time(), run.energy() - begin))?;
        (found.bounces, found.grazing) = (run.memory().total(), run.memory().grazing());
        Ok(found)
    }

    /// RK4 between impacts, which are found by bisection and keep the energy.
    fn rk4(job: &Job<'_>, end: f64) -> Result<Self> {
        let mut found = Self::empty("RK4", RK4_STEP, Stroke::solid(VERMILLION), end);
        let mut y = entries(START);
        let (begin, mut steps) = (FLOOR.energy_at(y), 0_u32);
        let after = |y: &[f64; 4], h: f64| {
            rk4(y, h, |&[x, y, u, w]| {
                let [f, g] = FLOOR.acceleration([x, y]);
                [u, w, f, g]
            })
        };
        let gap = |[x, y, ..]: [f64; 4]| Bouncer::above([x, y], FLOOR.a).0;
        job.repeat((end / RK4_STEP) as u64, || {
            let mut left = RK4_STEP;
            while gap(after(&y, left)) < 0.0 {
                let [mut open, mut closed] = [0.0, left];
                loop {
                    let middle = 0.5 * (open + closed);
                    if middle <= open || middle >= closed {
                        break;
                    }
                    if gap(after(&y, middle)) >= 0.0 { open = middle } else { closed = middle }
                }
                left -= open;
                let [x, height, u, w] = after(&y, open);
                let (_, normal) = Bouncer::above([x, height], FLOOR.a);
                let squared = normal[0] * normal[0] + normal[1] * normal[1];
                let change = 2.0 * (u * normal[0] + w * normal[1]) / squared;
                y = [x, height, u - change * normal[0], w - change * normal[1]];
                found.bounces += 1;
            }
            y = after(&y, left);
            steps += 1;
            found.energy.push(f64::from(steps) * RK4_STEP, FLOOR.energy_at(y) - begin);
            Ok(())
        })?;
        Ok(found)
    }
}

/// How the change of the energy grows with the number of bounces, over many starts.
fn walk(job: &Job<'_>, collision: Collision, h: f64) -> Result<Walk> {
    let starts = job.choose(60, 6);
    let mut squares = [0.0; DOUBLINGS as usize];
    for k in 0..starts {
        let start = BouncerState { x: 0.3 + 0.011 * f64::from(k), ..START };
        let mut run = Integrator::new(&FLOOR, trapezoid(collision), h, start)?;
        let begin = run.energy();
        for (doubling, square) in (0..DOUBLINGS).zip(&mut squares) {
            while run.memory().total() < FIRST << doubling {
                run.advance()?;
            }
            *square += (run.energy() - begin).powi(2) / f64::from(starts);
        }
    }
    let bounces = (0..DOUBLINGS).map(|doubling| (FIRST << doubling) as f64);
    Ok(bounces.zip(squares).map(|(n, square): (f64, f64)| [n, square.sqrt()]).collect())
}

fn flat(job: &Job<'_>, [.., coarse, fine]: &[Bounces; 5]) -> Claim {
    let text = format!(
        "with the energy kept at each impact, the energy error of a particle on a curved floor is less \
         than three times as large over 10⁵ bounces as up to t = {EARLY}, and less than a third with half \
         the step"
    );
    beyond(text)
        .at_least("bounces", job.only_full(coarse.bounces as f64), 1e5)
        .at_most("h = 0.02: max|ΔE|", job.only_full(coarse.energy.largest), 1.2e-3)
        .at_most("h = 0.01: max|ΔE|", job.only_full(fine.energy.largest), 2e-4)
        .each([coarse, fine], |claim, run| {
            let quantity = format!("h = {}: max|ΔE| over all / up to t = {EARLY}", run.h);
            claim.at_most(quantity, job.only_full(run.energy.growth()), 3.0)
        })
        .at_least("max|ΔE|, h = 0.02 over h = 0.01", coarse.energy.largest / fine.energy.largest, 3.0)
}

fn walks_at_random(
    job: &Job<'_>,
    [_, coarse, fine, ..]: &[Bounces; 5],
    [variational, half, reflecting]: &[Walk; 3],
) -> Claim {
    let exponent = |walk: &Walk| job.only_full(order(walk.iter().map(|&[n, deviation]| (n, deviation))));
    let last = |walk: &Walk| walk.last().map_or(f64::NAN, |point| point[1]);
    let over = |other: &Walk| job.only_full(last(variational) / last(other));
    let grazing = job.only_full((coarse.grazing + fine.grazing) as f64);
    let text = "with the discrete energy kept at each impact the energy walks at random: its change grows \
                with the square root of the number of bounces, and has a quarter of the size with half the \
                step";
    beyond(text)
        .near("exponent of the root mean square of ΔE", exponent(variational), [0.5, 0.1])
        .at_most("the same where the energy is kept", exponent(reflecting), 0.2)
        .at_least(
            "root mean square after 2048 bounces, over that where the energy is kept",
            over(reflecting),
            20.0,
        )
        .near("root mean square after 2048 bounces, over that with half the step", over(half), [4.0, 1.2])
        .at_most("discrete energy, h = 0.02: max|ΔE|", job.only_full(coarse.energy.largest), 0.05)
        .at_most("discrete energy, h = 0.01: max|ΔE|", job.only_full(fine.energy.largest), 0.0125)
        .at_most(
            "bounces that graze so that no impulse keeps the discrete energy, of both runs",
            grazing,
            20.0,
        )
}

fn loses(job: &Job<'_>, rk4: &Bounces) -> Claim {
    beyond(
        "RK4 with impacts that keep the energy, and as many forces as with h = 0.02, loses energy all \
            the time",
    )
    .at_least("RK4: max|ΔE|", job.only_full(rk4.energy.largest), 0.01)
    .at_least(
        format!("RK4: max|ΔE| over all / up to t = {EARLY}"),
        job.only_full(rk4.energy.growth()),
        100.0,
    )
}

fn entries(BouncerState { x, y, dot_x, dot_y }: BouncerState) -> [f64; 4] {
    [x, y, dot_x, dot_y]
}

fn order_of_states() -> Result<Claim> {
    fn after(method: impl Method<Bouncer, f64>, steps: u64) -> Result<[f64; 4]> {
        Ok(entries(up_to(&FLOOR, method, ORDER_TIME / steps as f64, START, ORDER_TIME)?))
    }
    let expected = after(Impacts::reflecting(Galerkin::<5>::new()), FINE)?;
    let counts = || {
        ORDER_STEPS.into_iter().flat_map(|steps| (0..NEARBY).map(move |n| steps + steps * n / (2 * NEARBY)))
    };
    let error = |steps: u64, end: [f64; 4]| (ORDER_TIME / steps as f64, apart(&end, &expected));
    let [discrete, at_impact] = each([Collision::Variational, Collision::Reflection], |collision| {
        order_of(counts(), |steps| Ok(error(steps, after(trapezoid(collision), steps)?)))
    })?;
    let galerkin = order_of(counts(), |steps| {
        Ok(error(steps, after(Impacts::reflecting(Galerkin::<3>::new()), steps)?))
    })?;
    Ok(beyond(format!(
        "the state at t = {ORDER_TIME}, after several bounces, is of the order of the method between impacts"
    ))
    .near("discrete energy, trapezoid", discrete, [2.0, 0.25])
    .near("energy at the impact, trapezoid", at_impact, [2.0, 0.15])
    .near("energy at the impact, Galerkin with 3 nodes", galerkin, [4.0, 0.25]))
}

fn back() -> Result<Claim> {
    let [discrete, at_impact] = each([Collision::Variational, Collision::Reflection], |collision| {
        let (method, h) = (trapezoid(collision), STEPS[0]);
        let steps = (ORDER_TIME / h).round() as u64;
        let mut run = Integrator::new(&FLOOR, method, h, START)?;
        run.take_steps(steps)?;
        let mut back = Integrator::resume(&FLOOR, method, &run.checkpoint().with_step_size(-h))?;
        back.take_steps(steps)?;
        Ok(apart(&entries(back.state()), &entries(START)))
    })?;
    Ok(beyond("the way back is the way there, bounces among it")
        .at_most("discrete energy: largest difference from the start", discrete, 1e-11)
        .at_most("energy at the impact: the same", at_impact, 1e-11))
}

fn figure(all: &[Bounces; 5], [variational, fine, reflecting]: &[Walk; 3], end: f64) -> Result<Figure> {
    let lines = all
        .iter()
        .map(|run| (format!("{}, *h* = {}", run.name, run.h), run.stroke, run.energy.envelope.magnitude()));
    let axis = Axis::logarithmic("largest |*E* − *E*(0)|").within(1e-5, 1e4);
    let energy =
        Panel::new("Energy", Axis::time(end), axis).lines(lines).legend_at(Corner::TopLeft).weight(1.6);
    let scale = variational.first().map_or(f64::NAN, |[n, deviation]| 2.0 * deviation / n.sqrt());
    let guide = [8.0_f64, 2048.0].map(|n| [n, scale * n.sqrt()]).to_vec();
    let [h, shorter] = STEPS;
    let walks = Panel::new(
        "Many starts",
        Axis::logarithmic("bounces"),
        Axis::logarithmic("root mean square of *E* − *E*(0)"),
    )
    .line(variational.clone(), Stroke::solid(BLUE))
    .labelled(format!("discrete energy, *h* = {h}"))
    .line(fine.clone(), Stroke::dashed(SKY))
    .labelled(format!("discrete energy, *h* = {shorter}"))
    .line(reflecting.clone(), Stroke::solid(GREEN))
    .labelled(format!("energy at the impact, *h* = {h}"))
    .line(guide, Stroke::dashed(SLATE).width(1.0))
    .labelled("square root of the number of bounces")
    .legend_at(Corner::Beside);
    Ok(Figure::new(
        "A particle that bounces on a curved floor",
        format!(
            "Mass and *g* are 1; a valley that narrows with the height; floor *y* = {} cos *x*. \
             Trapezoidal rule, divided at each impact.",
            FLOOR.a
        ),
    )
    .row(380.0, vec![path()?, energy])
    .row(300.0, vec![walks])
    .footer(
        "“Discrete energy”: both flights of an impact have the same one (Fetecau, Marsden, Ortiz & West \
         2003). “Energy at the impact”: *E* is kept at the point of impact, as it is by RK4.",
    ))
}

/// The path up to t = 20, and the points of impact.
fn path() -> Result<Panel> {
    let mut run = Integrator::new(&FLOOR, trapezoid(Collision::Reflection), STEPS[1], START)?;
    let (mut path, mut impacts) = (vec![[START.x, START.y]], Vec::new());
    while run.time() < 20.0 {
        run.advance()?;
        impacts.extend(run.memory().impacts().iter().map(|impact| [impact.q()[0], impact.q()[1]]));
        path.extend(run.memory().impacts().iter().map(|impact| [impact.q()[0], impact.q()[1]]));
        path.push(place(&run));
    }
    let floor = (-60..=60).map(|i| f64::from(i) * 0.025).map(|x| [x, FLOOR.a * x.cos()]).collect();
    Ok(Panel::plane("The path up to *t* = 20", "*x*", "*y*")
        .line(floor, Stroke::solid(SLATE).width(2.0))
        .line(path, Stroke::solid(BLUE).width(0.9))
        .dots(impacts, 2.6, VERMILLION))
}
