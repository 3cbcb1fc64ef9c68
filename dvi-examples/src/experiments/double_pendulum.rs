//! The double pendulum: chaos, with a mass matrix that depends on the angles.
//!
//! The variational step is implicit here, p0 = −D₁L_d(q0, q1), and the compiler has differentiated what it
//! needs. Beside it stands the classical Runge–Kutta method on equations of motion written by hand.

use anyhow::Result;
use dvi_core::methods::Method;
use dvi_core::prelude::*;

use crate::claim::{BEYOND, Bound, Claim};
use crate::deviation::Deviation;
use crate::figure::{Axis, BLUE, Corner, Figure, GREEN, Panel, SEQUENCE, Stroke, VERMILLION, at_most};
use crate::gallery::{Experiment, Outcome};
use crate::job::Job;
use crate::models::{DoublePendulum, DoublePendulumState};
use crate::output::{Table, number};

pub const EXPERIMENT: Experiment = Experiment {
    name: "double-pendulum",
    title: "A chaotic double pendulum, variational against RK4",
    share: 5.0,
    run,
};

const SYSTEM: DoublePendulum = DoublePendulum { length: 1.0, g: 9.81 };
/// Both rods horizontal, at rest.
const START: [f64; 2] = [std::f64::consts::FRAC_PI_2, std::f64::consts::FRAC_PI_2];
const H: f64 = 0.01;
/// How long the path is drawn.
const SHOWN: f64 = 12.0;
/// How long the beginning is with which the whole is compared.
const EARLY: f64 = 100.0;

/// What one run leaves.
struct Series {
    name: &'static str,
    /// E − E(0).
    error: Deviation,
    /// [t, E − E(0)], and the angles, in the beginning.
    beginning: Vec<[f64; 2]>,
    angles: Vec<[f64; 2]>,
}

fn run(job: &Job<'_>) -> Result<Outcome> {
    let end = job.choose(1e4, 1e3);
    let steps = (end / H).round() as u64;
    job.expect(3 * steps);
    let all = [
        variational(job, "variational, midpoint", Variational::midpoint(), steps)?,
        variational(job, "variational, Simpson", Variational::simpson(), steps)?,
        runge_kutta(job, steps)?,
    ];
    job.publish(EXPERIMENT.name, figure(&all, end), table(&all)?)?;
    Ok(Outcome { claims: claims(&all), references: vec![], notes: vec![] })
}

fn variational<M>(job: &Job<'_>, name: &'static str, method: M, steps: u64) -> Result<Series>
where
    M: Method<DoublePendulum, f64>,
{
    let [a, b] = START;
    let start = DoublePendulumState { a, b, dot_a: 0.0, dot_b: 0.0 };
    let mut run = Integrator::new(&SYSTEM, method, H, start)?;
    let mut series = Series::new(name, steps);
    job.repeat(steps, || {
        run.advance()?;
        series.note(run.time(), run.energy(), [run.q()[0], run.q()[1]]);
        Ok(())
    })?;
    Ok(series)
}

/// The classical Runge–Kutta method on (a, b, a', b').
fn runge_kutta(job: &Job<'_>, steps: u64) -> Result<Series> {
    let mut z = [START[0], START[1], 0.0, 0.0];
    let mut series = Series::new("RK4, by hand", steps);
    let mut step = 0;
    job.repeat(steps, || {
        let k1 = motion(z);
        let k2 = motion(moved(z, 0.5 * H, k1));
        let k3 = motion(moved(z, 0.5 * H, k2));
        let k4 = motion(moved(z, H, k3));
        z = std::array::from_fn(|i| z[i] + H / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
        step += 1;
        series.note(f64::from(step) * H, energy(z), [z[0], z[1]]);
        Ok(())
    })?;
    Ok(series)
}

fn moved(z: [f64; 4], h: f64, k: [f64; 4]) -> [f64; 4] {
    std::array::from_fn(|i| z[i] + h * k[i])
}

/// a'' and b'' of two unit masses on rods of equal length, solved from 2a'' + b'' cos δ + b'² sin δ + 2(g/l)
/// sin a = 0 and b'' + a'' cos δ − a'² sin δ + (g/l) sin b = 0, δ = a − b.
fn motion([a, b, da, db]: [f64; 4]) -> [f64; 4] {
    let (sin, cos) = (a - b).sin_cos();
    let gravity = SYSTEM.g / SYSTEM.length;
    let first = -db * db * sin - 2.0 * gravity * a.sin();
    let second = da * da * sin - gravity * b.sin();
    let determinant = 2.0 - cos * cos;
    [da, db, (first - cos * second) / determinant, (2.0 * second - cos * first) / determinant]
}

fn energy([a, b, da, db]: [f64; 4]) -> f64 {
    let DoublePendulum { length, g } = SYSTEM;
    length * length * (da * da + 0.5 * db * db + da * db * (a - b).cos())
        - g * length * (2.0 * a.cos() + b.cos())
}

impl Series {
    fn new(name: &'static str, steps: u64) -> Self {
        Self {
            name,
            error: Deviation::new(steps as f64 * H, 400, EARLY),
            beginning: Vec::new(),
            angles: vec![START],
        }
    }

    fn note(&mut self, t: f64, energy: f64, angles: [f64; 2]) {
        let error = energy - energy_at_rest();
        self.error.push(t, error);
        if t <= SHOWN {
            self.beginning.push([t, error]);
            self.angles.push(angles);
        }
    }
}

fn energy_at_rest() -> f64 {
    energy([START[0], START[1], 0.0, 0.0])
}

fn claims(all: &[Series; 3]) -> Vec<Claim> {
    let [midpoint, simpson, rk4] = all;
    let bounded = Claim::new(BEYOND, "the variational energy error stays bounded over a long chaotic run")
        .check("midpoint: max|ΔE| over all / to t = 100", midpoint.error.growth(), Bound::AtMost(3.0))
        .check("Simpson: max|ΔE| over all / to t = 100", simpson.error.growth(), Bound::AtMost(3.0));
    let drifts = Claim::new(BEYOND, "RK4 loses energy steadily at the same step").check(
        "RK4: |ΔE| at the end / max|ΔE| to t = 100",
        rk4.error.last.abs() / rk4.error.largest_early,
        Bound::AtLeast(5.0),
    );
    vec![bounded, drifts]
}

fn figure(all: &[Series; 3], end: f64) -> Figure {
    let place = |label| Axis::linear(label).within(-2.1, 2.1);
    let path: Vec<[f64; 2]> = all[1].angles.iter().map(|q| SYSTEM.lower_mass(q)).collect();
    let part = path.len().div_ceil(SEQUENCE.len()).max(1);
    let empty = Panel::new("Path of the lower mass", place("*x*   [m]"), place("*y*   [m]")).equal();
    let path = SEQUENCE.into_iter().enumerate().fold(empty, |panel, (i, colour)| {
        // One point more, so that the parts join.
        let points = path.iter().skip(i * part).take(part + 1).copied().collect();
        panel.line(points, Stroke::solid(colour).width(1.5))
    });
    let time = Axis::linear("time *t*   [s]").within(0.0, end);
    let label = "largest |*E* − *E*(0)| of each interval   [J]";
    let energy = Panel::new("Error of the energy", time, Axis::logarithmic(label)).weight(1.35);
    let strokes = [Stroke::solid(GREEN), Stroke::solid(BLUE), Stroke::dashed(VERMILLION)];
    let energy = all.iter().zip(strokes).fold(energy, |panel, (series, stroke)| {
        panel.line(series.error.envelope.magnitude(), stroke).labelled(series.name)
    });
    let told: Vec<String> =
        all.iter().map(|series| format!("{} {}", series.name, at_most(series.error.largest))).collect();
    Figure::new(
        "A chaotic double pendulum: a path, and the energy errors of three methods",
        format!("Masses of 1 kg, rods of 1 m, released with both rods horizontal; *h* = {H} s"),
    )
    .row(470.0, vec![path, energy.legend_at(Corner::BottomRight)])
    .sequence_key("path: 0 s", format!("{SHOWN} s"))
    .footer(format!("The path is that of Simpson's rule. Largest |Δ*E*| in J: {}.", told.join("; ")))
}

fn table(all: &[Series; 3]) -> Result<Table> {
    let mut table = Table::new(&["method", "t", "lowest", "mean", "highest"])?;
    for Series { name, error, .. } in all {
        for row in error.envelope.rows() {
            let numbers = row.map(number);
            table.row([(*name).to_owned()].into_iter().chain(numbers))?;
        }
    }
    Ok(table)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_equations_by_hand_conserve_the_energy() {
        let z = [0.3, -1.1, 2.0, -0.7];
        let rate = |h: f64| (energy(moved(z, h, motion(z))) - energy(moved(z, -h, motion(z)))) / (2.0 * h);
        assert!(rate(1e-5).abs() < 1e-6, "{}", rate(1e-5));
    }
}
