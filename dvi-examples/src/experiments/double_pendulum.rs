//! The double pendulum: chaos, with a mass matrix that depends on the angles.
//!
//! The variational step is implicit here, p0 = −D₁L_d(q0, q1), and the compiler has differentiated what it
//! needs. Beside it stands the classical Runge–Kutta method on equations of motion written by hand.

use std::f64::consts::FRAC_PI_2;

use super::rk4::rk4;
use crate::models::{DoublePendulum, DoublePendulumState};
use crate::vocabulary::*;

const SYSTEM: DoublePendulum = DoublePendulum { length: 1.0, g: 9.81 };
/// Both rods horizontal, at rest: (a, b, a', b').
const START: [f64; 4] = [FRAC_PI_2, FRAC_PI_2, 0.0, 0.0];
const H: f64 = 0.01;
/// How long the path is drawn.
const SHOWN: f64 = 12.0;
/// How long the beginning is with which the whole is compared.
const EARLY: f64 = 100.0;

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let end = job.choose(1e4, 1e3);
    let steps = (end / H).round() as u64;
    job.expect(3 * steps);
    let span = Span { end: steps as f64 * H, early: EARLY, intervals: 400 };
    let (midpoint, _) = variational(job, Variational::midpoint(), steps, span)?;
    let (simpson, angles) = variational(job, Variational::simpson(), steps, span)?;
    let (mut by_rk4, mut y, mut step) = (span.deviations(), START, 0);
    job.repeat(steps, || {
        y = rk4(&y, H, |y| SYSTEM.motion(y));
        step += 1;
        note(&mut by_rk4, f64::from(step) * H, [SYSTEM.energy_of(&y) - SYSTEM.energy_of(&START)]);
        Ok(())
    })?;
    let all = [
        Series::new("variational, midpoint", Stroke::solid(GREEN), midpoint),
        Series::new("variational, Simpson", Stroke::solid(BLUE), simpson),
        Series::new("RK4, by hand", Stroke::dashed(VERMILLION), by_rk4),
    ];
    let rows = all.iter().flat_map(|Series { name, kept: [error], .. }| ranges([name], &error.envelope));
    let table = Table::of(&["method", "t", "lowest", "mean", "highest"], rows)?;
    job.publish(figure(&all, &angles, end), table)?;
    let [midpoint, simpson, rk4] = all.each_ref().map(|series| &series.kept[0]);
    let growth = rk4.last.abs() / rk4.largest_early;
    Ok(vec![
        beyond("the variational energy error stays bounded over a long chaotic run")
            .at_most("midpoint: max|ΔE| over all / to t = 100", midpoint.growth(), 3.0)
            .at_most("Simpson: max|ΔE| over all / to t = 100", simpson.growth(), 3.0),
        beyond("RK4 loses energy steadily at the same step").at_least(
            "RK4: |ΔE| at the end / max|ΔE| to t = 100",
            growth,
            5.0,
        ),
    ]
    .into())
}

/// E − E(0), and the angles in the beginning.
fn variational(
    job: &Job<'_>,
    method: impl Method<DoublePendulum, f64>,
    steps: u64,
    span: Span,
) -> Result<([Deviation; 1], Vec<[f64; 2]>)> {
    let [a, b, dot_a, dot_b] = START;
    let mut run = Integrator::new(&SYSTEM, method, H, DoublePendulumState { a, b, dot_a, dot_b })?;
    let mut angles = vec![[a, b]];
    let error = job.keep(&mut run, steps, span, |run| {
        if run.time() <= SHOWN {
            angles.push([run.q()[0], run.q()[1]]);
        }
        [run.energy() - SYSTEM.energy_of(&START)]
    })?;
    Ok((error, angles))
}

fn figure(all: &[Series<1>; 3], angles: &[[f64; 2]], end: f64) -> Figure {
    let place = |label| Axis::linear(label).within(-2.1, 2.1);
    let path: Vec<[f64; 2]> = angles.iter().map(|q| SYSTEM.lower_mass(q)).collect();
    let part = path.len().div_ceil(SEQUENCE.len()).max(1);
    let empty = Panel::new("Path of the lower mass", place("*x*   [m]"), place("*y*   [m]")).equal();
    let path = empty.each(SEQUENCE.into_iter().enumerate(), |panel, (i, colour)| {
        // One point more, so that the parts join.
        let points = path.iter().skip(i * part).take(part + 1).copied().collect();
        panel.line(points, Stroke::solid(colour).width(1.5))
    });
    let time = Axis::linear("time *t*   [s]").within(0.0, end);
    let label = "largest |*E* − *E*(0)| of each interval   [J]";
    let energy = Panel::new("Error of the energy", time, Axis::logarithmic(label)).lines(magnitudes(all, 0));
    let told = all.each_ref().map(|series| format!("{} {}", series.name, at_most(series.kept[0].largest)));
    Figure::new(
        "A chaotic double pendulum: a path, and the energy errors of three methods",
        format!("Masses of 1 kg, rods of 1 m, released with both rods horizontal; *h* = {H} s"),
    )
    .row(470.0, vec![path, energy.weight(1.35).legend_at(Corner::BottomRight)])
    .sequence_key("path: 0 s", format!("{SHOWN} s"))
    .footer(format!("The path is that of Simpson's rule. Largest |Δ*E*| in J: {}.", told.join("; ")))
}
