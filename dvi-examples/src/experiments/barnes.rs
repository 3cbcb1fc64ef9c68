//! Barnes's phase flows (Second-Order Dynamical Systems, 1997, problems 6 and 7): leapfrog on x'' = −x, x
//! and −sin x, and a circle of points carried along.
//!
//! The step is symplectic: in the plane, it preserves area. Of a polygon it preserves the area exactly if it
//! is linear; where it bends the sides, the corners alone leave a deficit that falls like n⁻².

use crate::vocabulary::*;

const STEPS: usize = 32;
/// Until when phase curves are followed (the pendulum from (3, 0) has the period 16.16), and circles; and
/// where the values of the independent programs are.
const END: usize = 17;
const CARRIED: usize = 4;
const COMPARED: usize = 8;
const STARTS: [(f64, Colour); 3] = [(1.0, BLUE), (2.0, GREEN), (3.0, VERMILLION)];
/// Corners of the polygon; the first number is Barnes's.
const CORNERS: [usize; 4] = [100, 200, 400, 800];
/// Of a regular polygon of 100 corners and radius ½, 100/8 sin(2π/100).
const AREA: f64 = 0.784_881_494_116_417_2;

/// How a point moves in the (x, v) plane up to a time, step by step.
type Flow = (&'static str, fn([f64; 2], end: usize) -> Result<Points>, fn([f64; 2]) -> f64);

const FLOWS: [Flow; 3] = [
    ("*a* = −*x*", |start, end| orbit(&Spring { k: 1.0 }, start, end), |[x, v]| (v * v + x * x) / 2.0),
    ("*a* = +*x*", |start, end| orbit(&Spring { k: -1.0 }, start, end), |[x, v]| (v * v - x * x) / 2.0),
    ("*a* = −sin *x*", |start, end| orbit(&Pendulum {}, start, end), |[x, v]| v * v / 2.0 - x.cos()),
];

fn orbit<S: RegularLagrangian>(system: &S, [x, v]: [f64; 2], end: usize) -> Result<Points> {
    let mut run =
        Problem::new(system, system.state_of([x, v])).run(Variational::trapezoid(), 1.0 / STEPS as f64)?;
    Ok(course(&mut run, (end * STEPS) as u64, |run| [run.q()[0], run.v()[0]])?)
}

/// A regular polygon about (0, 1) at t = 0, 1, …, of whose corners `orbit` returns all steps.
pub fn carried(corners: usize, orbit: impl Fn([f64; 2]) -> Result<Points>) -> Result<Vec<Points>> {
    let angles = (0..corners).map(|j| (TAU * j as f64 / corners as f64).sin_cos());
    let orbits = angles.map(|(sin, cos)| orbit([0.5 * cos, 1.0 + 0.5 * sin])).collect::<Result<Vec<_>>>()?;
    let times = (0..orbits[0].len()).step_by(STEPS);
    Ok(times.map(|step| orbits.iter().map(|orbit| orbit[step]).collect()).collect())
}

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let curves = each(FLOWS, |(_, orbit, _)| each(STARTS, |(x, _)| orbit([x, 0.0], END)))?;
    let circles = each(FLOWS, |(_, orbit, _)| carried(CORNERS[0], |start| orbit(start, CARRIED)))?;
    let refined = each(CORNERS, |corners| carried(corners, |start| (FLOWS[2].1)(start, CARRIED)))?;
    job.publish(figure(&curves, &circles), table(&curves, &circles))?;
    let claims = claims(&curves, &circles, &refined);
    Ok(Outcome { claims, references: references(&curves, &circles[2]), notes: vec![] })
}

fn claims(curves: &[[Points; 3]; 3], circles: &[Vec<Points>; 3], refined: &[Vec<Points>; 4]) -> Vec<Claim> {
    // Relative to the size of the terms.
    let contours = |flow: usize| {
        let energy = FLOWS[flow].2;
        largest(curves[flow].iter().zip(STARTS).map(|(curve, (x, _))| {
            let initial = energy(curve[0]);
            largest(curve.iter().map(|&point| (energy(point) - initial).abs())) / (x * x)
        }))
    };
    let changes = |flow: usize| largest(circles[flow].iter().map(|polygon| (area(polygon) - AREA).abs()));
    let deficits = refined.each_ref().map(|circles| area(&circles[0]) - area(&circles[CARRIED]));
    let falls = order(CORNERS.map(|n| 1.0 / n as f64).into_iter().zip(deficits));
    vec![
        says("Barnes, section 6.3", "the phase curves are contours of the total energy")
            .at_most("a = −x: max|ΔE|/x(0)²", contours(0), 2e-4)
            .at_most("a = −sin x: max|ΔE|/x(0)²", contours(2), 2e-4),
        beyond("the linear flows leave the area of a polygon of 100 points as it is")
            .at_most("a = −x: largest change up to t = 4", changes(0), 1e-12)
            .at_most("a = +x: largest change up to t = 4", changes(1), 1e-12),
        beyond("under the pendulum the polygon, not the flow, loses area")
            .at_least("deficit of 100 corners at t = 4", deficits[0], 1e-6)
            .near("order in 1/n of the deficit at t = 4", falls, [2.0, 0.01]),
    ]
}

/// Numbers of independent programs.
fn references(curves: &[[Points; 3]; 3], pendulum: &[Points]) -> Vec<Check> {
    let ends = [
        (0, 0, [-0.145_822_118_200_617_4, -0.989_190_052_844_622]),
        (1, 0, [1_489.994_111_581_187, 1_490.175_648_915_25]),
        (2, 1, [1.944_208_266_518_613, 0.320_490_725_558_128_6]),
    ];
    let orbits = ends.map(|(flow, start, exact): (usize, usize, [f64; 2])| {
        let end = curves[flow][start][COMPARED * STEPS];
        let errors = [0, 1].map(|i| (end[i] - exact[i]).abs() / exact[i].abs().max(1.0));
        let (name, x) = (FLOWS[flow].0.replace('*', ""), STARTS[start].0);
        let quantity = format!("{name} from ({x}, 0) at t = 8: deviation from independent programs");
        Check::new(quantity, largest(errors), Bound::AtMost(1e-12))
    });
    orbits.into_iter().chain(areas("pendulum", pendulum)).collect()
}

/// Areas of the polygon of 100 corners under the pendulum, by independent programs.
pub fn areas(name: &str, pendulum: &[Points]) -> [Check; 2] {
    [(2, 0.784_858_871_043), (4, 0.784_780_953_139)].map(|(t, exact)| {
        let quantity = format!("{name}: area of 100 corners at t = {t}");
        Check::new(quantity, area(&pendulum[t]), Bound::Near(exact, 1e-12))
    })
}

fn figure(curves: &[[Points; 3]; 3], circles: &[Vec<Points>; 3]) -> Figure {
    let plane = |flow: usize, what: &str, x: [f64; 2], v: [f64; 2]| {
        Panel::window(format!("{}: {what}", FLOWS[flow].0), ("position *x*", x), ("velocity *v*", v))
    };
    let portrait = |flow: usize, x: [f64; 2], v: [f64; 2]| {
        let all = curves[flow].iter().zip(STARTS);
        plane(flow, "phase curves", x, v).each(all, |panel, (curve, (x, colour))| {
            let panel = panel.line(curve.clone(), solid(colour)).dots(vec![[x, 0.0]], 3.5, colour);
            panel.note([x - 0.12, 0.2], Anchor::End, colour, format!("({x}, 0)"))
        })
    };
    let circle = |flow: usize, x: [f64; 2], v: [f64; 2]| {
        let times = circles[flow].iter().zip([0, 2, 4, 6, 7].map(|i| SEQUENCE[i])).enumerate();
        let empty = plane(flow, "circle of 100 points", x, v).legend_at(Corner::TopLeft);
        empty.each(times, |panel, (t, (circle, colour))| {
            let panel = panel.line(closed(circle), solid(colour)).labelled(format!("*t* = {t}"));
            panel.dots(circle.clone(), 1.3, colour)
        })
    };
    let (wide, narrow) = ([-3.6, 3.6], [-2.3, 2.3]);
    let above = vec![portrait(0, wide, wide), portrait(1, [0.0, 7.2], [-1.2, 6.0]), portrait(2, wide, wide)];
    let carried = vec![
        circle(0, narrow, narrow).without_legend(),
        circle(1, [-0.9, 6.9], [-0.2, 7.6]),
        circle(2, [-1.6, 3.0], narrow).without_legend(),
    ];
    Figure::of(format!("Kick–drift–kick with *h* = 1/32; above to *t* = {END}, below a circle about (0, 1)"))
        .row(400.0, above)
        .row(400.0, carried)
        .footer("After Barnes 1997, Second-Order Dynamical Systems, problems 6 and 7.")
}

fn table(curves: &[[Points; 3]; 3], circles: &[Vec<Points>; 3]) -> Result<Table> {
    let rows = FLOWS.iter().zip(curves).zip(circles).flat_map(|(((name, ..), curves), circles)| {
        let orbits = curves.iter().zip(STARTS).flat_map(|(curve, (x, _))| {
            let points = curve.iter().enumerate();
            points.map(move |(k, point)| (format!("from ({x}, 0)"), k as f64 / 32.0, point))
        });
        let polygons = circles.iter().zip(0..).flat_map(|(circle, t)| {
            circle.iter().map(move |point| ("circle".to_owned(), f64::from(t), point))
        });
        orbits.chain(polygons).map(move |(curve, t, [x, v])| ([(*name).to_owned(), curve], [t, *x, *v]))
    });
    Table::of("flow,curve,t,x,v", rows)
}
