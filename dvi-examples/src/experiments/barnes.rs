//! Barnes's phase flows (Second-Order Dynamical Systems, 1997, problems 6 and 7): leapfrog on x'' = −x, x
//! and −sin x, and a circle of points carried along.
//!
//! The step is symplectic: in the plane, it preserves area. Of a polygon it preserves the area exactly if it
//! is linear; where it bends the sides, the corners alone leave a deficit that falls like n⁻².

use crate::claim::larger;
use anyhow::Result;
use dvi_core::RegularLagrangian;
use dvi_core::prelude::*;

use crate::claim::{BEYOND, Bound, Check, Claim};
use crate::figure::{
    Anchor, Axis, BLUE, Colour, Corner, Figure, GREEN, Panel, SEQUENCE, Stroke, VERMILLION,
};
use crate::gallery::{Experiment, Outcome};
use crate::job::Job;
use crate::models::{Pendulum, PendulumState, Spring, SpringState};
use crate::output::{Table, number};

pub const EXPERIMENT: Experiment = Experiment {
    name: "barnes",
    title: "Barnes's phase flows, and a circle carried along",
    share: 1.0,
    run,
};

const H: f64 = 1.0 / 32.0;
/// Until when phase curves are followed: the pendulum from (3, 0) has the period 16.16.
const END: u32 = 17;
/// Where the values of the independent programs are.
const COMPARED: u32 = 8;
/// Until when the circle is.
const CARRIED: u32 = 4;
const STARTS: [(f64, Colour); 3] = [(1.0, BLUE), (2.0, GREEN), (3.0, VERMILLION)];
/// Corners of the polygon; the first number is Barnes's.
const CORNERS: [usize; 4] = [100, 200, 400, 800];
/// Of a regular polygon of 100 corners and radius ½, 100/8 sin(2π/100).
const AREA: f64 = 0.784_881_494_116_417_2;

/// Points (x, v) at t = 0, 1, …, or at every step.
type Curve = Vec<[f64; 2]>;

/// A flow: how a point moves in the (x, v) plane.
struct Flow {
    name: &'static str,
    /// The orbit of (x, v) to time `end`, step by step.
    orbit: fn(&Job<'_>, [f64; 2], end: u32) -> Result<Curve>,
    energy: fn([f64; 2]) -> f64,
}

const FLOWS: [Flow; 3] = [
    Flow {
        name: "*a* = −*x*",
        orbit: |job, p, end| orbit(job, &Spring { k: 1.0 }, spring(p), end),
        energy: |[x, v]| (v * v + x * x) / 2.0,
    },
    Flow {
        name: "*a* = +*x*",
        orbit: |job, p, end| orbit(job, &Spring { k: -1.0 }, spring(p), end),
        energy: |[x, v]| (v * v - x * x) / 2.0,
    },
    Flow {
        name: "*a* = −sin *x*",
        orbit: |job, [x, dot_x], end| orbit(job, &Pendulum {}, PendulumState { x, dot_x }, end),
        energy: |[x, v]| v * v / 2.0 - x.cos(),
    },
];

fn spring([x, dot_x]: [f64; 2]) -> SpringState {
    SpringState { x, dot_x }
}

/// Kick, drift, kick.
fn orbit<S: RegularLagrangian>(job: &Job<'_>, system: &S, start: S::State<f64>, end: u32) -> Result<Curve> {
    let mut run = Integrator::new(system, Variational::trapezoid(), H, start)?;
    // The mass is one: velocities are momenta.
    let mut curve = vec![[run.q()[0], run.memory().p()[0]]];
    job.repeat(steps(end), || {
        run.advance()?;
        curve.push([run.q()[0], run.memory().p()[0]]);
        Ok(())
    })?;
    Ok(curve)
}

/// The number of steps to time `end`.
fn steps(end: u32) -> u64 {
    u64::from(end) * 32
}

fn run(job: &Job<'_>) -> Result<Outcome> {
    let carried = CORNERS.iter().sum::<usize>() as u64;
    job.expect(9 * steps(END) + (2 * CORNERS[0] as u64 + carried) * steps(CARRIED));
    let curves: Vec<Vec<Curve>> = FLOWS
        .iter()
        .map(|flow| STARTS.iter().map(|&(x, _)| (flow.orbit)(job, [x, 0.0], END)).collect())
        .collect::<Result<_>>()?;
    let circles: Vec<Vec<Curve>> =
        FLOWS.iter().map(|flow| carry(job, flow, CORNERS[0])).collect::<Result<_>>()?;
    let refined: Vec<Vec<Curve>> =
        CORNERS[1..].iter().map(|&n| carry(job, &FLOWS[2], n)).collect::<Result<_>>()?;
    job.publish(EXPERIMENT.name, figure(&curves, &circles), table(&curves, &circles)?)?;
    if job.was_interrupted() {
        return Ok(Outcome::default());
    }
    let (claims, references) = judged(&curves, &circles, &refined);
    Ok(Outcome { claims, references, notes: vec![] })
}

/// A regular polygon about (0, 1) at t = 0, 1, …, carried by the flow.
fn carry(job: &Job<'_>, flow: &Flow, corners: usize) -> Result<Vec<Curve>> {
    let mut circles = vec![Vec::with_capacity(corners); CARRIED as usize + 1];
    for j in 0..corners {
        let (sin, cos) = (std::f64::consts::TAU * j as f64 / corners as f64).sin_cos();
        let orbit = (flow.orbit)(job, [0.5 * cos, 1.0 + 0.5 * sin], CARRIED)?;
        for (circle, &point) in circles.iter_mut().zip(orbit.iter().step_by(32)) {
            circle.push(point);
        }
    }
    Ok(circles)
}

/// The area of a polygon, by Gauss's formula.
fn area(polygon: &[[f64; 2]]) -> f64 {
    let next = polygon.iter().cycle().skip(1);
    polygon.iter().zip(next).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>() / 2.0
}

fn judged(
    curves: &[Vec<Curve>],
    circles: &[Vec<Curve>],
    refined: &[Vec<Curve>],
) -> (Vec<Claim>, Vec<Check>) {
    let contours = |flow: usize| {
        let energy = FLOWS[flow].energy;
        let departure = |curve: &Curve| {
            let initial = energy(curve[0]);
            curve.iter().map(|&p| (energy(p) - initial).abs()).fold(0.0, larger)
        };
        // Relative to the size of the terms.
        curves[flow].iter().zip(STARTS).map(|(curve, (x, _))| departure(curve) / (x * x)).fold(0.0, larger)
    };
    let phase_curves =
        Claim::new("Barnes, section 6.3", "the phase curves are contours of the total energy")
            .check("a = −x: max|ΔE|/x(0)²", contours(0), Bound::AtMost(2e-4))
            .check("a = −sin x: max|ΔE|/x(0)²", contours(2), Bound::AtMost(2e-4));
    let ends = [
        (0, 0, [-0.145_822_118_200_617_4, -0.989_190_052_844_622]),
        (1, 0, [1_489.994_111_581_187, 1_490.175_648_915_25]),
        (2, 1, [1.944_208_266_518_613, 0.320_490_725_558_128_6]),
    ];
    let mut references: Vec<Check> = ends
        .map(|(flow, start, exact)| {
            let end = curves[flow][start].get(steps(COMPARED) as usize).copied().unwrap_or([f64::NAN; 2]);
            let error = |i: usize| (end[i] - exact[i]).abs() / exact[i].abs().max(1.0);
            let name = FLOWS[flow].name.replace('*', "");
            let quantity = format!(
                "{name} from ({}, 0) at t = 8: deviation from independent programs",
                STARTS[start].0
            );
            Check::new(quantity, larger(error(0), error(1)), Bound::AtMost(1e-12))
        })
        .to_vec();
    references.push(Check::new(
        "pendulum: area of 100 corners at t = 2",
        area(&circles[2][2]),
        Bound::Near(0.784_858_871_043, 1e-12),
    ));
    references.push(Check::new(
        "pendulum: area of 100 corners at t = 4",
        area(&circles[2][4]),
        Bound::Near(0.784_780_953_139, 1e-12),
    ));
    let changes =
        |flow: usize| circles[flow].iter().map(|polygon| (area(polygon) - AREA).abs()).fold(0.0, larger);
    let deficit = |circles: &Vec<Curve>| area(&circles[0]) - area(&circles[CARRIED as usize]);
    let deficits = [&circles[2]].into_iter().chain(refined).map(deficit);
    let deficits: Vec<_> = CORNERS.iter().map(|&n| 1.0 / n as f64).zip(deficits).collect();
    let linear = Claim::new(BEYOND, "the linear flows leave the area of a polygon of 100 points as it is")
        .check("a = −x: largest change up to t = 4", changes(0), Bound::AtMost(1e-12))
        .check("a = +x: largest change up to t = 4", changes(1), Bound::AtMost(1e-12));
    let bent = Claim::new(BEYOND, "under the pendulum the polygon, not the flow, loses area")
        .check("deficit of 100 corners at t = 4", deficit(&circles[2]), Bound::AtLeast(1e-6))
        .check("order in 1/n of the deficit at t = 4", convergence_order(&deficits), Bound::Near(2.0, 0.01));
    (vec![phase_curves, linear, bent], references)
}

fn figure(curves: &[Vec<Curve>], circles: &[Vec<Curve>]) -> Figure {
    let windows = [([-3.6, 3.6], [-3.6, 3.6]), ([0.0, 7.2], [-1.2, 6.0]), ([-3.6, 3.6], [-3.6, 3.6])];
    let portraits = (0..3).map(|flow| {
        let (x, v) = windows[flow];
        let panel = plane(format!("{}: phase curves", FLOWS[flow].name), x, v);
        curves[flow].iter().zip(STARTS).fold(panel, |panel, (curve, (x, colour))| {
            panel.line(curve.clone(), Stroke::solid(colour)).dots(vec![[x, 0.0]], 3.5, colour).note(
                [x - 0.12, 0.2],
                Anchor::End,
                colour,
                format!("({x}, 0)"),
            )
        })
    });
    let windows = [([-2.3, 2.3], [-2.3, 2.3]), ([-0.9, 6.9], [-0.2, 7.6]), ([-1.6, 3.0], [-2.3, 2.3])];
    let carried = (0..3).map(|flow| {
        let (x, v) = windows[flow];
        let title = format!("{}: circle of 100 points", FLOWS[flow].name);
        circles[flow].iter().enumerate().fold(plane(title, x, v), |panel, (t, circle)| {
            let closed = circle.iter().chain(circle.first()).copied().collect();
            let colour = SEQUENCE[2 * t.min(3)];
            let colour = if t == 4 { SEQUENCE[7] } else { colour };
            let panel = panel.line(closed, Stroke::solid(colour)).labelled(format!("*t* = {t}"));
            panel.dots(circle.clone(), 1.3, colour)
        })
    });
    let carried: Vec<Panel> = carried.collect();
    let carried = carried.into_iter().enumerate().map(|(flow, panel)| match flow {
        1 => panel.legend_at(Corner::TopLeft),
        _ => panel.without_legend(),
    });
    Figure::new(
        "Leapfrog on three flows: phase curves, and a circle carried along",
        format!("Kick–drift–kick with *h* = 1/32; above from (1, 0), (2, 0), (3, 0) to *t* = {END}, below a circle about (0, 1)"),
    )
    .row(400.0, portraits.collect())
    .row(400.0, carried.collect())
    .footer("*a* = +*x* leaves the windows as eᵗ. After Barnes 1997, Second-Order Dynamical Systems, problems 6 and 7.")
}

fn plane(title: String, x: [f64; 2], v: [f64; 2]) -> Panel {
    let position = Axis::linear("position *x*").within(x[0], x[1]);
    Panel::new(title, position, Axis::linear("velocity *v*").within(v[0], v[1])).equal()
}

fn table(curves: &[Vec<Curve>], circles: &[Vec<Curve>]) -> Result<Table> {
    let mut table = Table::new(&["flow", "curve", "t", "x", "v"])?;
    for (flow, Flow { name, .. }) in FLOWS.iter().enumerate() {
        let mut row = |curve: &str, t: f64, [x, v]: [f64; 2]| {
            table.row([name.replace('*', ""), curve.to_owned(), number(t), number(x), number(v)])
        };
        for (curve, (x, _)) in curves[flow].iter().zip(STARTS) {
            for (k, &point) in curve.iter().enumerate() {
                row(&format!("from ({x}, 0)"), k as f64 * H, point)?;
            }
        }
        for (t, circle) in circles[flow].iter().enumerate() {
            circle.iter().try_for_each(|&point| row("circle", t as f64, point))?;
        }
    }
    Ok(table)
}
