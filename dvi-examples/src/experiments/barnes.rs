//! Barnes's phase flows (Second-Order Dynamical Systems, 1997, problems 6 and 7): leapfrog on x'' = −x, x
//! and −sin x, and a circle of points carried along.
//!
//! The step is symplectic: in the plane, it preserves area. Of a polygon it preserves the area exactly if it
//! is linear; where it bends the sides, the corners alone leave a deficit that falls like n⁻².

use crate::models::{Pendulum, PendulumState, Spring, SpringState};
use crate::vocabulary::*;

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
        orbit: |job, [x, dot_x], end| orbit(job, &Spring { k: 1.0 }, SpringState { x, dot_x }, end),
        energy: |[x, v]| (v * v + x * x) / 2.0,
    },
    Flow {
        name: "*a* = +*x*",
        orbit: |job, [x, dot_x], end| orbit(job, &Spring { k: -1.0 }, SpringState { x, dot_x }, end),
        energy: |[x, v]| (v * v - x * x) / 2.0,
    },
    Flow {
        name: "*a* = −sin *x*",
        orbit: |job, [x, dot_x], end| orbit(job, &Pendulum {}, PendulumState { x, dot_x }, end),
        energy: |[x, v]| v * v / 2.0 - x.cos(),
    },
];

/// Kick, drift, kick.
fn orbit<S: RegularLagrangian>(job: &Job<'_>, system: &S, start: S::State<f64>, end: u32) -> Result<Curve> {
    let mut run = Integrator::new(system, Variational::trapezoid(), H, start)?;
    // The mass is one: velocities are momenta.
    let mut curve = vec![[run.q()[0], run.memory().p()[0]]];
    job.follow(&mut run, steps(end), |run| curve.push([run.q()[0], run.memory().p()[0]]))?;
    Ok(curve)
}

/// The number of steps to time `end`.
fn steps(end: u32) -> u64 {
    u64::from(end) * 32
}

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let carried = CORNERS.iter().sum::<usize>() as u64;
    job.expect(9 * steps(END) + (2 * CORNERS[0] as u64 + carried) * steps(CARRIED));
    let curves =
        each([0, 1, 2], |flow: usize| each(STARTS, |(x, _)| (FLOWS[flow].orbit)(job, [x, 0.0], END)))?;
    let circles = each([0, 1, 2], |flow: usize| carry(job, &FLOWS[flow], CORNERS[0]))?;
    let refined = each([1, 2, 3], |n: usize| carry(job, &FLOWS[2], CORNERS[n]))?;
    job.publish(figure(&curves, &circles), table(&curves, &circles)?)?;
    if job.was_interrupted() {
        return Ok(Outcome::default());
    }
    let claims = claims(&curves, &circles, &refined);
    Ok(Outcome { claims, references: references(&curves, &circles[2]), notes: vec![] })
}

/// A regular polygon about (0, 1) at t = 0, 1, …, carried by the flow.
fn carry(job: &Job<'_>, flow: &Flow, corners: usize) -> Result<Vec<Curve>> {
    let mut circles = vec![Vec::with_capacity(corners); CARRIED as usize + 1];
    for j in 0..corners {
        let (sin, cos) = (TAU * j as f64 / corners as f64).sin_cos();
        let orbit = (flow.orbit)(job, [0.5 * cos, 1.0 + 0.5 * sin], CARRIED)?;
        for (circle, &point) in circles.iter_mut().zip(orbit.iter().step_by(32)) {
            circle.push(point);
        }
    }
    Ok(circles)
}

fn claims(curves: &[[Curve; 3]; 3], circles: &[Vec<Curve>; 3], refined: &[Vec<Curve>; 3]) -> Vec<Claim> {
    // Relative to the size of the terms.
    let contours = |flow: usize| {
        let energy = FLOWS[flow].energy;
        let departure = |curve: &Curve| {
            let initial = energy(curve[0]);
            largest(curve.iter().map(|&p| (energy(p) - initial).abs()))
        };
        largest(curves[flow].iter().zip(STARTS).map(|(curve, (x, _))| departure(curve) / (x * x)))
    };
    let changes = |flow: usize| largest(circles[flow].iter().map(|polygon| (area(polygon) - AREA).abs()));
    let deficit = |circles: &Vec<Curve>| area(&circles[0]) - area(&circles[CARRIED as usize]);
    let deficits = [&circles[2]].into_iter().chain(refined).map(deficit);
    let falls = order(CORNERS.iter().map(|&n| 1.0 / n as f64).zip(deficits));
    vec![
        Claim::new("Barnes, section 6.3", "the phase curves are contours of the total energy")
            .at_most("a = −x: max|ΔE|/x(0)²", contours(0), 2e-4)
            .at_most("a = −sin x: max|ΔE|/x(0)²", contours(2), 2e-4),
        beyond("the linear flows leave the area of a polygon of 100 points as it is")
            .at_most("a = −x: largest change up to t = 4", changes(0), 1e-12)
            .at_most("a = +x: largest change up to t = 4", changes(1), 1e-12),
        beyond("under the pendulum the polygon, not the flow, loses area")
            .at_least("deficit of 100 corners at t = 4", deficit(&circles[2]), 1e-6)
            .near("order in 1/n of the deficit at t = 4", falls, [2.0, 0.01]),
    ]
}

/// Numbers of independent programs.
fn references(curves: &[[Curve; 3]; 3], pendulum: &[Curve]) -> Vec<Check> {
    let ends = [
        (0, 0, [-0.145_822_118_200_617_4, -0.989_190_052_844_622]),
        (1, 0, [1_489.994_111_581_187, 1_490.175_648_915_25]),
        (2, 1, [1.944_208_266_518_613, 0.320_490_725_558_128_6]),
    ];
    let orbits = ends.map(|(flow, start, exact): (usize, usize, [f64; 2])| {
        let end = curves[flow][start].get(steps(COMPARED) as usize).copied().unwrap_or([f64::NAN; 2]);
        let error = |i: usize| (end[i] - exact[i]).abs() / exact[i].abs().max(1.0);
        let (name, x) = (FLOWS[flow].name.replace('*', ""), STARTS[start].0);
        let quantity = format!("{name} from ({x}, 0) at t = 8: deviation from independent programs");
        Check::new(quantity, larger(error(0), error(1)), Bound::AtMost(1e-12))
    });
    let areas = [(2, 0.784_858_871_043), (4, 0.784_780_953_139)].map(|(t, exact)| {
        let quantity = format!("pendulum: area of 100 corners at t = {t}");
        Check::new(quantity, area(&pendulum[t]), Bound::Near(exact, 1e-12))
    });
    orbits.into_iter().chain(areas).collect()
}

fn figure(curves: &[[Curve; 3]; 3], circles: &[Vec<Curve>; 3]) -> Figure {
    let plane = |title: String, [x, v]: [[f64; 2]; 2]| {
        let position = Axis::linear("position *x*").within(x[0], x[1]);
        Panel::new(title, position, Axis::linear("velocity *v*").within(v[0], v[1])).equal()
    };
    let windows = [[[-3.6, 3.6], [-3.6, 3.6]], [[0.0, 7.2], [-1.2, 6.0]], [[-3.6, 3.6], [-3.6, 3.6]]];
    let portraits = FLOWS.iter().zip(curves).zip(windows).map(|((flow, curves), window)| {
        let empty = plane(format!("{}: phase curves", flow.name), window);
        empty.each(curves.iter().zip(STARTS), |panel, (curve, (x, colour))| {
            let panel = panel.line(curve.clone(), Stroke::solid(colour)).dots(vec![[x, 0.0]], 3.5, colour);
            panel.note([x - 0.12, 0.2], Anchor::End, colour, format!("({x}, 0)"))
        })
    });
    let windows = [[[-2.3, 2.3], [-2.3, 2.3]], [[-0.9, 6.9], [-0.2, 7.6]], [[-1.6, 3.0], [-2.3, 2.3]]];
    let carried = FLOWS.iter().zip(circles).zip(windows).map(|((flow, circles), window)| {
        let empty = plane(format!("{}: circle of 100 points", flow.name), window);
        let times = circles.iter().zip([0, 2, 4, 6, 7].map(|i| SEQUENCE[i])).enumerate();
        empty.legend_at(Corner::TopLeft).each(times, |panel, (t, (circle, colour))| {
            let panel = panel.line(closed(circle), Stroke::solid(colour)).labelled(format!("*t* = {t}"));
            panel.dots(circle.clone(), 1.3, colour)
        })
    });
    // The legend of the middle one is that of all.
    let carried = carried.enumerate().map(|(i, panel)| if i == 1 { panel } else { panel.without_legend() });
    Figure::new(
        "Leapfrog on three flows: phase curves, and a circle carried along",
        format!(
            "Kick–drift–kick with *h* = 1/32; above from (1, 0), (2, 0), (3, 0) to *t* = {END}, below \
                 a circle about (0, 1)"
        ),
    )
    .row(400.0, portraits.collect())
    .row(400.0, carried.collect())
    .footer(
        "*a* = +*x* leaves the windows as eᵗ. After Barnes 1997, Second-Order Dynamical Systems, \
             problems 6 and 7.",
    )
}

fn table(curves: &[[Curve; 3]; 3], circles: &[Vec<Curve>; 3]) -> Result<Table> {
    let rows = FLOWS.iter().zip(curves).zip(circles).flat_map(|((Flow { name, .. }, curves), circles)| {
        let row = |curve: String, t: f64, [x, v]: [f64; 2]| ([(*name).to_owned(), curve], [t, x, v]);
        let orbits = curves.iter().zip(STARTS).flat_map(move |(curve, (x, _))| {
            let points = curve.iter().enumerate();
            points.map(move |(k, &point)| row(format!("from ({x}, 0)"), k as f64 * H, point))
        });
        let polygons = circles.iter().enumerate().flat_map(move |(t, circle)| {
            circle.iter().map(move |&point| row("circle".to_owned(), t as f64, point))
        });
        orbits.chain(polygons)
    });
    Table::of(&["flow", "curve", "t", "x", "v"], rows)
}
