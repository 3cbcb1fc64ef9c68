//! The pendulum in phase-space form, L = p x' − H: what one-step schemes are where α = p dx.
//!
//! There the trapezoidal scheme is leapfrog, kick–drift–kick, and the midpoint scheme is the implicit
//! midpoint rule. Both preserve area.

use std::f64::consts::TAU;

use anyhow::Result;
use dvi_core::methods::Method;
use dvi_core::prelude::*;

use crate::claim::{BEYOND, Bound, Check, Claim, larger};
use crate::deviation::Deviation;
use crate::figure::{
    Axis, BLUE, Corner, Figure, GREEN, Panel, SEQUENCE, Stroke, VERMILLION, at_most, scientific,
};
use crate::gallery::{Experiment, Outcome};
use crate::job::Job;
use crate::models::{
    Pendulum, PendulumState, PhasePendulum, PhasePendulumState, SymmetricPendulum, SymmetricPendulumState,
};
use crate::output::{Table, number};

pub const EXPERIMENT: Experiment = Experiment {
    name: "phase-space",
    title: "The pendulum in phase-space form, by one-step schemes",
    share: 1.0,
    run,
};

/// The step of long runs, and their start.
const H: f64 = 0.2;
const START: f64 = 2.0;
/// Steps of the beginning, with which the whole is compared.
const EARLY: u64 = 1000;
/// The step of the circle that is carried along, and until when it is: those of the experiment `barnes`.
const FINE: f64 = 1.0 / 32.0;
const CARRIED: usize = 8;

/// The points of a circle, carried along to t = 0, 1, …
type Circles = Vec<Vec<[f64; 2]>>;

/// What one long run leaves.
struct Series {
    name: &'static str,
    error: Deviation,
}

fn run(job: &Job<'_>) -> Result<Outcome> {
    let steps = job.choose(1_000_000, 20_000);
    job.expect(3 * steps);
    let all = [
        series(job, "one step, midpoint", OneStep::midpoint(), steps)?,
        series(job, "one step, trapezoid", OneStep::trapezoid(), steps)?,
        series(job, "RK4", RungeKutta::classical(), steps)?,
    ];
    let leapfrog = circles(OneStep::trapezoid(), 100)?;
    let claims = vec![flat(&all), same_schemes()?, areas()?, periods()?];
    let area_at = |t: usize| area(&leapfrog[t]);
    let references = vec![
        Check::new(
            "trapezoid: area of 100 corners at t = 2",
            area_at(2),
            Bound::Near(0.784_858_871_043, 1e-12),
        ),
        Check::new(
            "trapezoid: area of 100 corners at t = 4",
            area_at(4),
            Bound::Near(0.784_780_953_139, 1e-12),
        ),
    ];
    job.publish(EXPERIMENT.name, figure(&all, &leapfrog, steps as f64 * H), table(&all, &leapfrog)?)?;
    Ok(Outcome { claims, references, notes: vec![] })
}

fn series<M: Method<PhasePendulum, f64>>(
    job: &Job<'_>,
    name: &'static str,
    method: M,
    steps: u64,
) -> Result<Series> {
    let mut run = Integrator::new(&PhasePendulum {}, method, H, PhasePendulumState { x: START, p: 0.0 })?;
    let energy = run.energy();
    let error = Deviation::new(steps as f64 * H, 400, EARLY as f64 * H);
    let mut series = Series { name, error };
    job.repeat(steps, || {
        run.advance()?;
        series.error.push(run.time(), run.energy() - energy);
        Ok(())
    })?;
    Ok(series)
}

/// A regular polygon about (0, 1) at t = 0, 1, …
fn circles<M: Method<PhasePendulum, f64> + Copy>(method: M, corners: usize) -> Result<Circles> {
    let mut circles = vec![Vec::new(); CARRIED + 1];
    for j in 0..corners {
        let (sin, cos) = (TAU * j as f64 / corners as f64).sin_cos();
        let start = PhasePendulumState { x: 0.5 * cos, p: 1.0 + 0.5 * sin };
        let mut run = Integrator::new(&PhasePendulum {}, method, FINE, start)?;
        for circle in &mut circles {
            circle.push([run.q()[0], run.q()[1]]);
            run.take_steps(32)?;
        }
    }
    Ok(circles)
}

/// The area of a polygon, by Gauss's formula.
fn area(polygon: &[[f64; 2]]) -> f64 {
    let next = polygon.iter().cycle().skip(1);
    polygon.iter().zip(next).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>() / 2.0
}

fn flat(all: &[Series; 3]) -> Claim {
    let text = "the energy error of one-step schemes is no larger in the whole run than in its beginning";
    all.iter().fold(Claim::new(BEYOND, text), |claim, series| {
        let bound = if series.name == "RK4" { Bound::AtLeast(5.0) } else { Bound::AtMost(1.001) };
        let quantity = format!("{}: max|ΔH| over all / over {EARLY} steps", series.name);
        claim.check(quantity, series.error.growth(), bound)
    })
}

/// Points (x, p) of some hundred steps by two schemes: the largest distance.
fn same_schemes() -> Result<Claim> {
    const STEPS: u64 = 500;
    fn orbit<S: Lagrangian, M: Method<S, f64>>(
        system: &S,
        method: M,
        start: S::State<f64>,
        place: impl Fn(&Integrator<'_, S, M>) -> [f64; 2],
    ) -> Result<Vec<[f64; 2]>> {
        let mut run = Integrator::new(system, method, H, start)?;
        let mut orbit = Vec::new();
        for _ in 0..STEPS {
            run.advance()?;
            orbit.push(place(&run));
        }
        Ok(orbit)
    }
    let apart = |one: &[[f64; 2]], other: &[[f64; 2]]| {
        one.iter().zip(other).map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1])).fold(0.0, larger)
    };
    let start = PhasePendulumState { x: START, p: 0.0 };
    let system = PhasePendulum {};
    let trapezoid = orbit(&system, OneStep::trapezoid(), start, |run| [run.q()[0], run.q()[1]])?;
    let midpoint = orbit(&system, OneStep::midpoint(), start, |run| [run.q()[0], run.q()[1]])?;
    let start = PendulumState { x: START, dot_x: 0.0 };
    let verlet =
        orbit(&Pendulum {}, Variational::trapezoid(), start, |run| [run.q()[0], run.memory().p()[0]])?;
    let start = SymmetricPendulumState { x: START, p: 0.0 };
    let two_step = orbit(&SymmetricPendulum {}, Sigma::midpoint(), start, |run| [run.q()[0], run.q()[1]])?;
    let start = PhasePendulumState { x: START, p: 0.0 };
    let gauss = orbit(&system, Gauss::<1>::new(), start, |run| [run.q()[0], run.q()[1]])?;
    Ok(Claim::new(
        BEYOND,
        "with α = p dx the trapezoidal scheme is leapfrog and the midpoint one is implicit midpoint",
    )
    .check(
        "500 steps: trapezoid from Störmer–Verlet on L(x, x')",
        apart(&trapezoid, &verlet),
        Bound::AtMost(1e-11),
    )
    .check("500 steps: midpoint from Gauss of one stage", apart(&midpoint, &gauss), Bound::AtMost(1e-11))
    .check(
        "500 steps: midpoint from σ = ½ with ½(p dx − x dp)",
        apart(&midpoint, &two_step),
        Bound::AtMost(1e-11),
    )
    .check("500 steps: trapezoid from midpoint", apart(&trapezoid, &midpoint), Bound::AtLeast(1e-3)))
}

/// A polygon loses area where its sides bend, by n⁻²; a flow that loses area does not get better with n.
fn areas() -> Result<Claim> {
    const CORNERS: [usize; 4] = [100, 200, 400, 800];
    fn order<M: Method<PhasePendulum, f64> + Copy>(method: M) -> Result<Option<f64>> {
        let lost = |corners: usize| -> Result<(f64, f64)> {
            let circles = circles(method, corners)?;
            Ok((1.0 / corners as f64, area(&circles[0]) - area(&circles[4])))
        };
        Ok(convergence_order(&CORNERS.into_iter().map(lost).collect::<Result<Vec<_>>>()?))
    }
    Ok(Claim::new(BEYOND, "the polygon and not the scheme loses area")
        .check(
            "midpoint: order in 1/n of what is lost at t = 4",
            order(OneStep::midpoint())?,
            Bound::Near(2.0, 0.01),
        )
        .check(
            "trapezoid: order in 1/n of what is lost at t = 4",
            order(OneStep::trapezoid())?,
            Bound::Near(2.0, 0.01),
        ))
}

/// The period of the pendulum from rest at x: 2π/M(1, cos ½x), with the arithmetic–geometric mean M.
fn period(x: f64) -> f64 {
    let (mut a, mut b) = (1.0, (x / 2.0).cos());
    for _ in 0..10 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    TAU / a
}

/// Where a hundred steps lead that are a hundredth of the period each, against the start.
fn periods() -> Result<Claim> {
    fn order<M: Method<PhasePendulum, f64> + Copy>(method: M) -> Result<Option<f64>> {
        let error = |steps: u64| -> Result<(f64, f64)> {
            let h = period(START) / steps as f64;
            let mut run =
                Integrator::new(&PhasePendulum {}, method, h, PhasePendulumState { x: START, p: 0.0 })?;
            run.take_steps(steps)?;
            Ok((h, (run.q()[0] - START).hypot(run.q()[1])))
        };
        Ok(convergence_order(&[100, 150, 200].into_iter().map(error).collect::<Result<Vec<_>>>()?))
    }
    Ok(Claim::new(BEYOND, "the period comes out as the elliptic integral says, to the order of the scheme")
        .check(
            "midpoint: order of the error after a period",
            order(OneStep::midpoint())?,
            Bound::Near(2.0, 0.02),
        )
        .check(
            "trapezoid: order of the error after a period",
            order(OneStep::trapezoid())?,
            Bound::Near(2.0, 0.02),
        )
        .check(
            "Gauss of order 4: order of the error after a period",
            order(OneStepGauss::<2>::new())?,
            Bound::Near(4.0, 0.05),
        ))
}

fn figure(all: &[Series; 3], leapfrog: &Circles, end: f64) -> Figure {
    let plane = Panel::new(
        "A circle of 100 points, by the trapezoidal scheme",
        Axis::linear("angle *x*").within(-3.6, 3.6),
        Axis::linear("momentum *p*").within(-2.8, 4.4),
    );
    let energy = |p: f64, x: f64| p * p / 2.0 - x.cos();
    let contour = |level: f64, sign: f64| -> Vec<[f64; 2]> {
        let xs = (-720..=720).map(|k| f64::from(k) / 200.0).filter(|&x| energy(0.0, x) <= level);
        xs.map(|x| [x, sign * (2.0 * (level + x.cos())).sqrt()]).collect()
    };
    let plane = [0.0, 1.0, 2.0]
        .into_iter()
        .flat_map(|level| [contour(level, 1.0), contour(level, -1.0)])
        .fold(plane.equal(), |plane, contour| {
            plane.line(contour, Stroke::solid(SEQUENCE[0]).width(0.6).opacity(0.4))
        });
    let plane = leapfrog.iter().enumerate().step_by(2).fold(plane, |plane, (t, circle)| {
        let colour = SEQUENCE[t.min(7)];
        let closed = circle.iter().chain(circle.first()).copied().collect();
        let text = format!("*t* = {t}: area {:.6}", area(circle));
        plane.line(closed, Stroke::solid(colour)).labelled(text).dots(circle.clone(), 1.3, colour)
    });
    let time = Axis::linear("time *t*   [1/*ω*₀]").within(0.0, end);
    let empty = Panel::new(
        "Error of the energy",
        time,
        Axis::logarithmic("largest |*H* − *H*(0)| of each interval").within(1e-4, 10.0),
    );
    let strokes = [Stroke::solid(BLUE), Stroke::solid(GREEN), Stroke::dashed(VERMILLION)];
    let energy = all.iter().zip(strokes).fold(empty.weight(1.2), |panel, (series, stroke)| {
        panel.line(series.error.envelope.magnitude(), stroke).labelled(series.name)
    });
    Figure::new(
        "The pendulum in phase-space form: an area carried along, and the energy errors of three methods",
        format!("*H* = ½*p*² − cos *x*; left *h* = 1/32, right *h* = {H} from ({START}, 0)"),
    )
    .row(500.0, vec![plane, energy.legend_at(Corner::TopRight)])
    .footer(format!(
        "Largest |Δ*H*| of one step: midpoint {}, trapezoid {}. RK4 at the end: {}.",
        at_most(all[0].error.largest),
        at_most(all[1].error.largest),
        scientific(all[2].error.largest)
    ))
}

fn table(all: &[Series; 3], leapfrog: &Circles) -> Result<Table> {
    let mut table = Table::new(&["series", "t", "x or lowest ΔH", "p or highest ΔH"])?;
    for Series { name, error, .. } in all {
        for [t, low, _, high] in error.envelope.rows() {
            table.row([(*name).to_owned(), number(t), number(low), number(high)])?;
        }
    }
    for (t, circle) in leapfrog.iter().enumerate() {
        for [x, p] in circle {
            table.row(["circle".to_owned(), t.to_string(), number(*x), number(*p)])?;
        }
    }
    Ok(table)
}
